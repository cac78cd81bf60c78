//! The first guess: names, starts and heights.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::goal_of;
use pleach_fit::{
    Candidate, FirstGuess, FitError, FitProblem, FitSettings, GuessSettings, TreeSeed, first_guess,
};
use std::sync::atomic::AtomicBool;

/// Nobody asks these to stop.
static GO: AtomicBool = AtomicBool::new(false);

const NAMES: [&str; 5] = ["acer", "bamboo", "lombardy_poplar", "palm", "small_pine"];

fn candidates() -> Vec<Candidate> {
    let values = |name: &str| pleach_generators::preset(name).unwrap().params.values().to_vec();
    NAMES.iter().map(|name| Candidate { name: (*name).to_owned(), values: values(name) }).collect()
}

fn guess(problem: &FitProblem, settings: &FitSettings) -> FirstGuess {
    let few = GuessSettings { variants: 3, ..GuessSettings::default() };
    first_guess(problem, settings, &candidates(), &few, &GO, |_, _| ()).unwrap()
}

#[test]
fn trees_of_other_seeds_and_sizes_are_named() {
    for name in ["bamboo", "lombardy_poplar", "small_pine"] {
        let mut problem = goal_of(name, 31, 128);
        // Half as high as the species is: the size of a tree cannot be seen.
        problem.goals[0].frame.metres_per_pixel *= 0.5;
        let found = guess(&problem, &FitSettings::default());
        assert_eq!(found.names[0].0, name, "{:?}", found.names);
        assert!((found.names.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-9);
        assert!(found.nearest.windows(2).all(|w| w[0].score.cost <= w[1].score.cost));

        // What is returned is of the goal's height as it stands.
        let frame = problem.goals[0].frame;
        let top = f64::from(problem.goals[0].goal.ink_box().unwrap().1);
        let goal_height = (frame.ground_row - top) * frame.metres_per_pixel;
        let species = pleach_generators::preset(name).unwrap();
        let params = species.generator.space().check(found.nearest[0].values.clone()).unwrap();
        let tree = pleach_tree::Species { params, ..species }.grow(1).unwrap();
        let height = pleach_tree::stats::Bounds::of(&tree, true).unwrap().max.z;
        assert!((height / goal_height - 1.0).abs() < 0.02, "{name}: {height} m, the goal {goal_height} m");
    }
}

#[test]
fn threads_change_nothing_and_progress_is_told() {
    let problem = goal_of("palm", 3, 64);
    let settings = FitSettings { tree_seed: TreeSeed::Any, ..FitSettings::default() };
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut told = Vec::new();
        let few = GuessSettings { variants: 5, ..GuessSettings::default() };
        let found = pool.install(|| {
            first_guess(&problem, &settings, &candidates(), &few, &GO, |done, all| told.push((done, all)))
        });
        (found.unwrap(), told)
    };
    let one = run(1);
    assert!(one == run(3));
    assert_eq!(one.1, [(32, 40), (40, 40)]);
}

#[test]
fn nothing_to_guess_from_is_an_error() {
    let problem = goal_of("palm", 3, 64);
    let none = first_guess(&problem, &FitSettings::default(), &[], &GuessSettings::default(), &GO, |_, _| ());
    assert!(matches!(none, Err(FitError::NoStart)));
    let foreign = [Candidate { name: "of another generator".to_owned(), values: vec![1.0] }];
    let wrong =
        first_guess(&problem, &FitSettings::default(), &foreign, &GuessSettings::default(), &GO, |_, _| ());
    assert!(matches!(wrong, Err(FitError::Space(_))));
}

#[test]
fn asked_to_stop_there_is_no_guess() {
    let problem = goal_of("palm", 3, 64);
    let stop = AtomicBool::new(false);
    // Raised once the first batch is done.
    let raise = |_, _| stop.store(true, std::sync::atomic::Ordering::Relaxed);
    let stopped = first_guess(
        &problem,
        &FitSettings::default(),
        &candidates(),
        &GuessSettings::default(),
        &stop,
        raise,
    );
    assert!(matches!(stopped, Err(FitError::Interrupted)));
}
