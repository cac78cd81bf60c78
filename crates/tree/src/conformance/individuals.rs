//! Promises about single stems.

use super::{SEED, all, read};
use crate::growth::Growth;
use crate::param::Problem;
use crate::species::{Family, Species, SpeciesDoc};
use pleach_plant::{Draw, Individual, StemPath};
use pleach_plant::{Knot, Leaf, Tree};
use std::collections::BTreeMap;

/// Another draw of everything.
const OTHER: Draw = Draw { seed: 3, azimuth: 0.2, pitch: -0.1, length: 0.9 };
/// Stems of each tree that are given other draws, one at a time.
const STEMS: usize = 6;

/// What a stem is by itself: its knots, and the leaves and blossoms on it.
type Alone = (Vec<Knot>, Vec<(Leaf, bool)>);

/// All stems of a tree by their paths.
fn by_path(species: &Species, tree: &Tree) -> BTreeMap<StemPath, Alone> {
    let paths: Vec<StemPath> = (0..tree.stems.len()).map(|i| tree.path_of(i)).collect();
    let mut stems = BTreeMap::new();
    for (path, stem) in paths.iter().zip(&tree.stems) {
        let before = stems.insert(path.clone(), (tree.knots_of(stem).to_vec(), Vec::new()));
        assert!(before.is_none(), "{} has the stem {path} twice", species.name);
    }
    let leaves = tree.leaves.iter().map(|leaf| (leaf, false));
    for (leaf, is_blossom) in leaves.chain(tree.blossoms.iter().map(|blossom| (blossom, true))) {
        if let Some((_, on_it)) = stems.get_mut(&paths[leaf.stem as usize]) {
            on_it.push((Leaf { stem: 0, ..*leaf }, is_blossom));
        }
    }
    stems
}

fn grown(species: &Species, growth: &Growth<'_>) -> Tree {
    species.grow_with(growth).unwrap_or_else(|error| panic!("{} grows: {error}", species.name))
}

/// Every stem has another path, and other draws of a stem change that stem and what it carries, and nothing
/// else, on any number of threads. Without addresses there are no spreads, and draws change nothing.
///
/// # Panics
/// If the promise is broken.
pub fn draws_of_a_stem_are_its_own(family: &dyn Family) {
    for species in all(family) {
        let (name, tree) = (&species.name, grown(&species, &Growth::seed(SEED)));
        if species.generator.spreads(species.params.values()).is_empty() {
            let draws = individual([StemPath::trunk(0)]).draws();
            let same = grown(&species, &Growth { draws: Some(&draws), ..Growth::seed(SEED) });
            assert!(same == tree, "{name} has no spreads");
            continue;
        }
        let before = by_path(&species, &tree);
        for part in 0..STEMS {
            let stem = tree.path_of(part * (tree.stems.len() - 1) / (STEMS - 1));
            let draws = individual([stem.clone()]).draws();
            let growth = Growth { draws: Some(&draws), ..Growth::seed(SEED) };
            let other = grown(&species, &growth);
            assert_eq!(other.well_formed(), Ok(()), "{name} with other draws of {stem}");
            let parallel = grown(&species, &Growth { parallel: true, ..growth });
            assert!(other == parallel, "{name}: growing {stem} in parallel changes nothing");
            let after = by_path(&species, &other);
            assert_ne!(before.get(&stem), after.get(&stem), "{name}: other draws of {stem} are other draws");
            let elsewhere = |stems: &BTreeMap<StemPath, Alone>| {
                stems
                    .iter()
                    .filter(|(path, _)| !path.is_on(&stem))
                    .map(|(p, a)| (p.clone(), a.clone()))
                    .collect()
            };
            let (before, after): (Vec<_>, Vec<_>) = (elsewhere(&before), elsewhere(&after));
            assert!(before == after, "{name}: other draws of {stem} change other stems");
        }
    }
}

/// An individual is in the file of its species, which grows it from its own seed and the kind from all others.
///
/// # Panics
/// If the promise is broken.
pub fn individuals_are_read_back(family: &dyn Family) {
    for species in all(family) {
        let (name, values) = (&species.name, species.params.values());
        let stems = [StemPath::trunk(0), grown(&species, &Growth::seed(SEED)).path_of(0)];
        let individual = individual(stems);
        let one = species.with_individual(SEED, individual.clone());
        let text = one.to_toml(&[]);
        if species.generator.spreads(values).is_empty() {
            let error = SpeciesDoc::parse("again.toml", &text)
                .and_then(|doc| doc.species(family))
                .expect_err("refused");
            let has_no_addresses = |problem: &Problem| problem.to_string().contains("stems with addresses");
            assert!(error.issues.iter().any(|issue| has_no_addresses(&issue.problem)), "{name}: {error}");
            continue;
        }
        let again = read(family, &text);
        assert_eq!(again.to_toml(&[]), text, "{name}");
        let grow = |species: &Species, seed: u64| grown(species, &Growth::seed(seed));
        assert!(grow(&again, SEED) == grow(&one, SEED), "{name}: the same individual");
        assert!(grow(&one, SEED) != grow(&species, SEED), "{name}: is not what its seed grows");
        assert!(grow(&one, SEED + 1) == grow(&species, SEED + 1), "{name}: other seeds are of the kind");
        let kind = Species { tree_seed: Some(SEED), ..species.clone() };
        assert_eq!(one.kind().to_toml(&[]), kind.to_toml(&[]), "{name}");
    }
}

fn individual(stems: impl IntoIterator<Item = StemPath>) -> Individual {
    let mut individual = Individual::default();
    stems.into_iter().for_each(|stem| individual.set(stem, OTHER));
    individual
}
