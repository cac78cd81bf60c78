//! The bush in everything that pleach does with a family: nothing in pleach knows its name.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use binary_bush::BinaryBushes;
use pleach::{
    Budget, Candidate, Control, Family, FitProblem, FitSettings, Goal, GoalSettings, GoalView, Palette,
    Parts, Species, SpeciesDoc, View,
};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// A species that comes with the family.
fn bush(name: &str) -> Species {
    let (_, text) = BinaryBushes.presets().iter().find(|(known, _)| *known == name).unwrap();
    SpeciesDoc::parse(name, text).unwrap().species(&BinaryBushes).unwrap()
}

mod conformance {
    use super::BinaryBushes;

    pleach_tree::conformance!(BinaryBushes);
}

#[test]
fn it_is_drawn() {
    let tree = bush("low").grow(1).unwrap();
    assert_eq!((tree.stems.len(), tree.leaves.len()), (511, 256));
    let picture = pleach::silhouette(&tree, View::FRONT, 64);
    assert!(picture.ink() > 150, "{}", picture.to_ascii());
    assert!(pleach::Bounds::new(&tree, Parts::LEAFY).unwrap().max.z > 0.5);
}

#[test]
fn it_is_fitted() {
    // A picture of a low bush, with an angle that no candidate has.
    let mut values = bush("low").params.values().to_vec();
    values[2] = 45.0;
    let params = bush("low").generator.space().check(values).unwrap();
    let tree = Species { params, ..bush("low") }.grow(1).unwrap();
    let goal = Goal::from_bitmap(pleach::silhouette(&tree, View::FRONT, 128)).unwrap();
    let height = pleach::Bounds::new(&tree, Parts::LEAFY).unwrap().max.z;

    // The first guess chooses among species of all families.
    let view = GoalView::new(goal.bitmap.clone(), View::FRONT, goal.frame(height));
    let problem = FitProblem::new(pleach::species("palm").unwrap(), view);
    let candidates = vec![bush("broom"), bush("low"), pleach::species("palm").unwrap()];
    let search = FitSettings { budget: Budget::evaluations(1000), ..FitSettings::default() };
    let settings =
        GoalSettings { search, ..GoalSettings::new(candidates.into_iter().map(Candidate::from).collect()) };
    let stop = AtomicBool::new(false);
    let fitted = pleach::fit_goal(&problem, &settings, Control::new(&|| Duration::ZERO, &stop)).unwrap();

    let guess = fitted.guess.as_ref().unwrap();
    assert_eq!(guess.names[0].0, "low", "{:?}", guess.names);
    assert_eq!(fitted.species().unwrap().generator.family(), "binary-bush");
    let (before, after) = (guess.nearest[0].score.cost, fitted.best.score.cost);
    assert!(after < 0.9 * before, "{after} after {before}");
    let angle = fitted.species().unwrap().params.values()[2];
    assert!((42.0..48.0).contains(&angle), "{angle}");
}

#[test]
fn it_is_blended() {
    let between = pleach::mix(vec![bush("low"), bush("broom")], &[0.5, 0.5], "between").unwrap();
    let angle = between.params.values()[2];
    assert!((20.0..32.0).contains(&angle), "{angle}");
    // What a blend writes, the family reads.
    let text = between.to_toml(&[]);
    let read = SpeciesDoc::parse("between", &text).unwrap().species(&BinaryBushes).unwrap();
    assert_eq!(read.params, between.params);
}

#[test]
fn it_is_exported() {
    let species = bush("broom");
    let mut glb = std::io::Cursor::new(Vec::new());
    pleach::write_glb(&mut glb, "broom", &species.grow(1).unwrap(), &Palette::new(&species.appearance, None))
        .unwrap();
    let bytes = glb.into_inner();
    assert!(bytes.starts_with(b"glTF") && bytes.len() > 10_000, "{}", bytes.len());
}

/// The page that walks through the file quotes it as it is.
#[test]
fn the_documentation_quotes_the_code() {
    let page = include_str!("../../../docs/a-generator.md");
    let code = [include_str!("../src/lib.rs"), include_str!("whole.rs")].concat().replace("    ", "");
    let listings: Vec<&str> =
        page.split("```rust\n").skip(1).map(|rest| rest.split("```").next().unwrap()).collect();
    assert!(listings.len() >= 4);
    for listing in listings {
        assert!(code.contains(listing.replace("    ", "").trim()), "not in the code:\n{listing}");
    }
}
