//! Promises about species files.

use super::{SEED, all, read};
use crate::species::Family;
use crate::species::{SpeciesDoc, check_name};

/// The species that come with a family can be read, and name it; they have different names.
///
/// # Panics
/// If the promise is broken, like all of this suite.
pub fn files_name_their_family(family: &dyn Family) {
    let mut names: Vec<&str> = Vec::new();
    for ((name, text), species) in family.presets().iter().zip(all(family)) {
        assert_eq!(check_name(name), Ok(()), "{name}");
        assert!(!names.contains(name), "{name} comes twice");
        names.push(name);
        assert_eq!(species.generator.family(), family.name(), "{name}");
        let doc = SpeciesDoc::parse(name, text);
        let said = doc.as_ref().map(|doc| doc.text("generator").map(|said| said.map(str::to_owned)));
        assert_eq!(said, Ok(Ok(Some(family.name().to_owned()))), "{name} says its generator");
    }
}

/// A mistake in a file is reported once, with its place, together with all other mistakes.
///
/// # Panics
/// If the promise is broken.
pub fn one_mistake_is_one_issue(family: &dyn Family) {
    for (name, text) in family.presets() {
        let wrong = format!("no_such_key = 1\n\"nor such a key\" = 1\n{text}");
        let issues = SpeciesDoc::parse(name, &wrong).and_then(|doc| doc.species(family)).map(|s| s.name);
        let places = issues.map_err(|error| error.issues.iter().map(|i| (i.line, i.column)).collect());
        assert_eq!(places, Err(vec![(1, 1), (2, 1)]), "{name}");
    }
}

/// Names that are known to be wrong are not parameters, and the error says what would be right.
///
/// # Panics
/// If the promise is broken.
pub fn misplaced_names_are_told(family: &dyn Family) {
    for (name, right) in family.misplaced() {
        assert!(family.keys().iter().all(|key| key.name != *name), "{name} is a key");
        for species in all(family) {
            assert!(species.generator.space().find(name).is_none(), "{name} is a parameter");
        }
        for (preset, text) in family.presets() {
            let wrong = SpeciesDoc::parse(preset, &format!("{name} = 1\n{text}"));
            let told = wrong.and_then(|doc| doc.species(family)).map(|s| s.name).map_err(|e| e.to_string());
            assert!(told.as_ref().is_err_and(|told| told.contains(right)), "{name} in {preset}: {told:?}");
        }
    }
}

/// Written and read back, a species is the same.
///
/// # Panics
/// If the promise is broken.
pub fn written_files_are_read_back(family: &dyn Family) {
    for species in all(family) {
        let name = &species.name;
        let text = species.to_toml(&["a comment".to_owned()]);
        let again = read(family, &text);
        assert_eq!(*name, again.name);
        assert_eq!(species.description, again.description, "{name}");
        assert_eq!(species.params, again.params, "{name}: parameters survive the file");
        assert_eq!(species.tree_seed, again.tree_seed, "{name}");
        assert_eq!(species.foliage, again.foliage, "{name}");
        assert_eq!(species.appearance, again.appearance, "{name}: its looks survive the file");
        assert_eq!(species.generator.model(), again.generator.model(), "{name}: its model survives the file");
        for group in species.generator.space().groups() {
            let headings = text.lines().filter(|line| line.strip_prefix("# ") == Some(group)).count();
            assert_eq!(headings, 1, "{name}: one heading for {group}");
        }
        assert!(species.grow(SEED) == again.grow(SEED), "{name}: the file grows the same tree");
    }
}

/// Two generators are the same model if, and only if, they have the same structure.
///
/// # Panics
/// If the promise is broken.
pub fn models_are_told_apart_by_structure(family: &dyn Family) {
    let species = all(family);
    for one in &species {
        assert_eq!(one.generator.model().family(), family.name(), "{}", one.name);
        for other in &species {
            let same_model = one.generator.model() == other.generator.model();
            let same_structure = one.generator.structure() == other.generator.structure();
            assert_eq!(same_model, same_structure, "{} and {}", one.name, other.name);
        }
    }
}
