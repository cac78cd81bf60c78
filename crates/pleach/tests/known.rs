//! The drawings of known species that are built in are those of this version.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach::plan::{Origin, draw, library, library_with, plan, usual_start};
use pleach::{
    Bitmap, Candidate, Drawings, FitProblem, FitSettings, Foliage, Frame, GeneratorChoice, GoalView,
    GuessLibrary, GuessSettings, Parts, Rasterizer, Species, View,
};
use std::sync::atomic::AtomicBool;

/// The species that a first guess compares a picture in colour with.
fn known() -> Vec<Species> {
    let generator = GeneratorChoice::Trees;
    let start = usual_start(generator).unwrap();
    let guess = Origin::Guess { detect_leaves: true };
    let plan = plan(guess, generator, &start, FitSettings::default()).unwrap();
    plan.candidates.into_iter().map(|candidate| candidate.species).collect()
}

fn drawings(species: impl IntoIterator<Item = Species>) -> Drawings {
    Drawings::from_bytes(draw(species).unwrap().leak()).unwrap()
}

/// If it fails, `cargo run --release -p pleach --example draw_known_species` makes them again.
#[test]
fn drawings_are_of_this_version() {
    let (built_in, all) = (library().drawings().unwrap().clone(), known());
    assert_eq!(all.len(), 33);
    let drawn = drawings(all);
    assert_eq!((drawn.len(), built_in.len()), (462, 462));
    assert!(drawn.are_within(&built_in));
}

/// If it fails, `cargo run --release -p pleach --example learn_known_species` learns them again, in half an hour.
#[test]
fn every_known_species_is_learnt() {
    let all = known();
    let predictors = library().predictors().unwrap().clone();
    assert_eq!(predictors.species(), all.len());
    let goal = Bitmap::from_fn(64, 64, |x, y| (28..36).contains(&x) && y > 8);
    for foliage in [Foliage::All, Foliage::None] {
        for (species, values) in all.iter().zip(predictors.predict(&goal, foliage, &all)) {
            let values = values.unwrap_or_else(|| panic!("{} is not learnt", species.name));
            assert!(species.params.space().check(values).is_ok(), "{}", species.name);
        }
    }
}

#[test]
fn drawings_of_another_tree_are_not_among_them() {
    let aspen = pleach::species("quaking_aspen").unwrap();
    assert_eq!(known()[0].name, aspen.name, "variations depend on the place in the list");
    let mut values = aspen.params.values().to_vec();
    assert!(aspen.generator.resize(&mut values, 1.1));
    let mut other = aspen.clone();
    other.params.set(&values).unwrap();
    let built_in = library().drawings().unwrap().clone();
    assert!(drawings([aspen]).are_within(&built_in));
    assert!(!drawings([other]).are_within(&built_in));
}

/// What is drawn beforehand spares growing and changes nothing.
#[test]
fn a_first_guess_is_the_same_bits_with_drawings_and_without() {
    let species = pleach::species("palm").unwrap();
    let tree = species.grow(7).unwrap();
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
    let mut goal = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
    let problem = FitProblem::new(species, GoalView::new(goal, View::FRONT, frame));
    let candidates: Vec<Candidate> = known().into_iter().map(Candidate::from).collect();
    let how = GuessSettings { detect_leaves: true, ..GuessSettings::default() };
    let guess = |mut library: GuessLibrary| {
        let stop = AtomicBool::new(false);
        library.first_guess(&problem, &FitSettings::default(), &candidates, &how, &stop, |_, _| ()).unwrap()
    };
    let (with, without) = (guess(library()), guess(library_with(None)));
    assert_eq!(with.names[0].0, "palm");
    assert_eq!(format!("{with:?}"), format!("{without:?}"));
}

#[test]
fn bytes_that_are_no_drawings_are_refused() {
    assert!(Drawings::from_bytes(b"\xff\xff\xff\xff\xff\xff").is_err());
    assert!(Drawings::from_bytes(&[1]).is_err());
}
