//! Generators of two families: a goal chooses between them, and the search keeps to the one it chose.

use crate::common::goal_of;
use crate::pole::pole;
use pleach_fit::{
    Budget, Candidate, Control, Evaluator, FIT_LIMITS, FirstGuess, FitError, FitProblem, FitSettings, Fitted,
    Genome, GoalSettings, GoalView, GuessSettings, Objective, RaceSettings, Start, first_guess, fit_goal,
};
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::{Parts, Species};
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Two species of one family, and three of the other.
fn candidates() -> Vec<Candidate> {
    let trees = ["palm", "acer"].map(|name| pleach_generators::preset(name).unwrap());
    let poles = [("rod", 0.02), ("post", 0.1), ("drum", 0.4)].map(|(name, girth)| pole(name, 10.0, girth));
    trees.into_iter().chain(poles).map(Candidate::from).collect()
}

/// The front of a pole, as a goal of a fit that would begin with a palm.
fn goal_of_pole(species: &Species) -> FitProblem {
    let tree = species.grow(1).unwrap();
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 64, 64);
    let mut goal = Bitmap::default();
    Rasterizer::for_searches(Detail::Half).draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
    FitProblem::new(pleach_generators::preset("palm").unwrap(), GoalView::new(goal, View::FRONT, frame))
}

fn guess(problem: &FitProblem) -> FirstGuess {
    let race = Some(RaceSettings { runners: 6, evaluations: 60, ..RaceSettings::default() });
    let few = GuessSettings { variants: 3, race, ..GuessSettings::default() };
    let go = AtomicBool::new(false);
    first_guess(problem, &FitSettings::default(), &candidates(), &few, &go, |_, _| ()).unwrap()
}

fn fitted(problem: &FitProblem) -> Fitted {
    let search = FitSettings { budget: Budget::evaluations(300), ..FitSettings::default() };
    let settings = GoalSettings { search, ..GoalSettings::new(candidates()) };
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    fit_goal(problem, &settings, Control::new(&clock, &stop)).unwrap()
}

#[test]
fn a_goal_chooses_its_family_and_starts_from_lists_of_it_alone() {
    let found = guess(&goal_of_pole(&pole("goal", 25.0, 0.09)));
    assert_eq!(found.names[0].0, "post");
    assert_eq!(found.species.name, "post");
    assert_eq!(found.species.generator.family(), "pole");
    assert!(found.nearest.iter().all(|guess| guess.values.len() == 2), "{:?}", found.nearest);
    // At the goal's height, and as near as its nearest list.
    assert!((found.species.params.values()[0] - 25.0).abs() < 1.0, "{:?}", found.species.params);
    assert_eq!(found.species.params.values(), found.nearest[0].values);

    let found = guess(&goal_of("palm", 3, 64));
    assert_eq!((found.names[0].0.as_str(), found.species.generator.family()), ("palm", "weber-penn"));
    let slots = found.species.generator.space().len();
    assert!(found.nearest.iter().all(|guess| guess.values.len() == slots));
    let lists = found.raced.iter().chain(&found.nearest);
    assert_eq!(found.start(), Start::Lists(lists.map(|one| one.values.clone()).collect()));
}

/// Poles and trees are each searched for a while; what that has found starts the search.
#[test]
fn families_race() {
    let found = guess(&goal_of_pole(&pole("goal", 25.0, 0.2)));
    let families: Vec<&str> = found.runners.iter().map(|one| one.family).collect();
    assert_eq!(families, ["pole", "weber-penn"], "{:?}", found.runners);
    let [first, second] = &found.runners[..] else { unreachable!() };
    assert!(first.reached < first.guessed && first.reached < second.reached, "{:?}", found.runners);
    assert!(["post", "drum"].contains(&first.species.as_str()) && second.reached <= second.guessed);
    let raced = found.raced.as_ref().unwrap();
    assert_eq!(raced.score.cost, first.reached);
    assert!((raced.values[1] - 0.2).abs() < 0.05, "{raced:?}");
    assert!(
        found
            .names
            .iter()
            .filter(|(_, share)| *share > 0.0)
            .all(|(name, _)| ["rod", "post", "drum"].contains(&name.as_str()))
    );
}

/// Without a race, and with one generator, the nearest list decides as it stands.
#[test]
fn there_need_not_be_a_race() {
    let problem = goal_of_pole(&pole("goal", 25.0, 0.2));
    let go = AtomicBool::new(false);
    let of = |candidates: &[Candidate], race| {
        let how = GuessSettings { variants: 1, race, ..GuessSettings::default() };
        first_guess(&problem, &FitSettings::default(), candidates, &how, &go, |_, _| ()).unwrap()
    };
    let without = of(&candidates(), None);
    assert!(without.raced.is_none() && without.runners.iter().all(|one| one.guessed == one.reached));
    let poles = &candidates()[2..];
    let alone = of(poles, GuessSettings::default().race);
    assert!(alone.raced.is_none() && alone.runners.len() == 1);
}

#[test]
fn a_race_can_be_interrupted() {
    let problem = goal_of_pole(&pole("goal", 25.0, 0.2));
    let stop = AtomicBool::new(false);
    let how = GuessSettings { variants: 0, seeds: 1, ..GuessSettings::default() };
    // The last tree of the guess is grown, and the first generator has run.
    let raise = |done: usize, all: usize| {
        if (done, all) == (1, 2) {
            stop.store(true, std::sync::atomic::Ordering::Relaxed);
        }
    };
    let stopped = first_guess(&problem, &FitSettings::default(), &candidates(), &how, &stop, raise);
    assert!(matches!(stopped, Err(FitError::Interrupted)));
}

#[test]
fn the_search_is_over_the_generator_that_was_chosen() {
    let problem = goal_of_pole(&pole("goal", 25.0, 0.2));
    let Fitted { best, assessment, outcome, problem: fitted_problem, .. } = fitted(&problem);
    assert_eq!(fitted_problem.start.generator.family(), "pole");
    let [height, girth] = best.genome.values[..] else { panic!("a pole has two numbers") };
    assert!((height - 25.0).abs() < 1.5 && (girth - 0.2).abs() < 0.02, "{height} {girth}");
    assert!(best.score.iou > 0.95, "{:?} after {}", best.score, outcome.evaluations);
    // Poles of all seeds are the same.
    let judged = assessment.unwrap();
    assert_eq!(judged.held_out.unwrap().cost.sd, 0.0);
    assert!(judged.references.same_species.is_some() && judged.references.other_species.is_some());
    assert!(judged.profiles.iter().all(|profile| profile.slot.index() < 2));
}

#[test]
fn threads_change_nothing_among_families() {
    let problem = goal_of_pole(&pole("goal", 25.0, 0.2));
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| format!("{:?}", guess(&problem)))
    };
    assert_eq!(on(1), on(4));
}

#[test]
fn what_is_drawn_larger_scores_as_what_is_grown_larger() {
    let species = pleach_generators::preset("grammar_pine").unwrap();
    let tree = species.grow(3).unwrap();
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 128, 128);
    let mut goal = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
    let problem = FitProblem::new(species.clone(), GoalView::new(goal, View::FRONT, frame));
    let evaluator = Evaluator::new(&problem, Objective::Overlap, FIT_LIMITS).unwrap().with_height_matching();
    assert!(species.generator.grows_in_proportion());
    let structure = species.generator.variation().unwrap().own();
    for factor in [0.2, 0.7, 3.0] {
        let mut values = species.params.values().to_vec();
        assert!(species.generator.resize(&mut values, factor));
        let grown = Genome::new(values, 1);
        let drawn = Genome { structure: Some(structure.clone()), ..grown.clone() };
        let [grown, drawn] =
            [grown, drawn].map(|genome| evaluator.evaluate(&genome, &mut evaluator.workspace()));
        assert_eq!(grown.resized, drawn.resized);
        assert!((drawn.resized * factor - 1.0).abs() < 0.2, "{factor}: {drawn:?}");
        assert!(grown.iou > 0.5 && (grown.iou - drawn.iou).abs() < 0.002, "{grown:?} {drawn:?}");
        assert!((grown.cost - drawn.cost).abs() < 0.002, "{grown:?} {drawn:?}");
    }
}
