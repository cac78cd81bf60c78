//! The drawings of known species that are built in are those of this version.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach::plan::{Origin, draw, library, plan, usual_start};
use pleach::{Drawings, FitSettings, GeneratorChoice, Species};

/// The species that a first guess compares with by default.
fn known() -> Vec<Species> {
    let generator = GeneratorChoice::default();
    let start = usual_start(generator).unwrap();
    let guess = Origin::Guess { detect_leaves: true };
    let plan = plan(guess, generator, &start, FitSettings::default()).unwrap();
    plan.candidates.into_iter().map(|candidate| candidate.species).collect()
}

fn drawings(species: impl IntoIterator<Item = Species>) -> Drawings {
    Drawings::from_bytes(draw(species).unwrap().leak()).unwrap()
}

/// All trees of the species that grow soon: what changes the trees of one changes those of others. If it fails,
/// `cargo run --release -p pleach --example draw_known_species` makes them anew.
#[test]
fn drawings_are_of_this_version() {
    let heavy = ["weeping_willow", "black_tupelo", "black_oak", "cherry", "sassafras", "silver_birch"];
    let (built_in, all) = (library().drawings().unwrap().clone(), known());
    let (slow, soon): (Vec<_>, Vec<_>) =
        all.into_iter().partition(|species| heavy.contains(&species.name.as_str()));
    assert_eq!((slow.len(), soon.len()), (6, 14));
    let drawn = drawings(soon);
    assert!(!drawn.is_empty() && drawn.are_within(&built_in));
    assert_eq!(built_in.len() * 14, drawn.len() * 20, "and none of others");
}

#[test]
fn drawings_of_another_tree_are_not_among_them() {
    let palm = pleach::species("palm").unwrap();
    let mut values = palm.params.values().to_vec();
    assert!(palm.generator.resize(&mut values, 1.1));
    let mut other = palm.clone();
    other.params.set(&values).unwrap();
    let built_in = library().drawings().unwrap().clone();
    assert!(drawings([palm]).are_within(&built_in));
    assert!(!drawings([other]).are_within(&built_in));
}

#[test]
fn bytes_that_are_no_drawings_are_refused() {
    assert!(Drawings::from_bytes(b"\xff\xff\xff\xff\xff\xff").is_err());
    assert!(Drawings::from_bytes(&[1]).is_err());
}
