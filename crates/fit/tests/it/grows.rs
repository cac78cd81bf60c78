//! What a fit returns grows from other seeds than the one that was fitted.

use crate::common::goal_of;
use crate::pole::{Pole, pole};
use pleach_fit::{
    Budget, Candidate, Control, FitProblem, FitSettings, Fitted, Freedom, GoalSettings, GoalView, Guessing,
    Start, fit_goal,
};
use pleach_silhouette::{Frame, View, silhouette};
use pleach_tree::{
    CheckedParams, Conflict, Foliage, Generator, GrowError, Growth, ParamSpace, Parts, Species, Tree,
    Workspace,
};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

fn fitted(problem: &FitProblem, settings: &GoalSettings) -> Fitted {
    let clock = || Duration::ZERO;
    fit_goal(problem, settings, Control::new(&clock, &AtomicBool::new(false))).unwrap()
}

/// A search from the problem's own start, without a first guess.
fn from_start(problem: &FitProblem, evaluations: u64, fix: &[&str]) -> GoalSettings {
    let search = FitSettings {
        budget: Budget::evaluations(evaluations),
        start: Start::Lists(vec![problem.start.params.values().to_vec()]),
        freedom: Freedom { fix: fix.iter().map(|&name| name.to_owned()).collect(), ..Freedom::default() },
        ..FitSettings::default()
    };
    GoalSettings { search, guess: Guessing::Off, ..GoalSettings::new(Vec::new()) }
}

/// The seeds from 1 to 100 that do not grow.
fn failing(species: &Species) -> Vec<u64> {
    let fails =
        |&seed: &u64| species.grow_with(&Growth { foliage: Foliage::None, ..Growth::seed(seed) }).is_err();
    (1..=100).filter(fails).collect()
}

/// Poles of which every fifth seed has none where they are thicker than this.
#[derive(Debug)]
struct Brittle;

const TOO_THICK: f64 = 0.15;

impl Generator for Brittle {
    fn family(&self) -> &'static str {
        "brittle"
    }

    fn space(&self) -> &Arc<ParamSpace> {
        Pole.space()
    }

    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth<'_>,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError> {
        if params.values()[1] > TOO_THICK && growth.seed.is_multiple_of(5) {
            return Err(Conflict::NothingLeft { blame: pleach_tree::Blame(vec!["girth".to_owned()]) }.into());
        }
        Pole.grow(params, growth, workspace, tree)
    }
}

#[test]
fn a_best_that_does_not_grow_from_other_seeds_is_not_returned() {
    let thick = pole("goal", 10.0, 0.2).grow(1).unwrap();
    let frame = Frame::automatic(&thick, &View::FRONT, Parts::LEAFY, 64, 64);
    let goal = GoalView::new(silhouette(&thick, View::FRONT, 64), View::FRONT, frame);
    let start = Species { generator: Arc::new(Brittle), ..pole("start", 10.0, 0.1) };
    let problem = FitProblem::new(start, goal);
    for validates in [true, false] {
        let settings = GoalSettings { validates, ..from_start(&problem, 200, &[]) };
        let fitted = fitted(&problem, &settings);
        let last = &fitted.outcome.best.as_ref().unwrap().genome;
        assert!(last.values[1] > 0.17, "the search has found the goal: {:?}", last.values);
        assert_eq!(failing(&fitted.species().unwrap()), [0; 0], "{validates}");
        let girth = fitted.best.genome.values[1];
        assert!((0.1..=TOO_THICK).contains(&girth) && (validates || girth > 0.11), "{girth}");
        assert!(fitted.assessment.unwrap().held_out.is_some());
    }
}

#[test]
fn fits_of_known_species_grow_from_a_hundred_seeds() {
    let candidates = || ["acer", "palm", "bamboo"].map(|name| pleach_generators::preset(name).unwrap());
    for (name, seed) in [("acer", 11), ("palm", 11), ("bamboo", 11), ("lombardy_poplar", 3)] {
        let search = FitSettings { budget: Budget::evaluations(150), seed, ..FitSettings::default() };
        let settings = GoalSettings { search, ..GoalSettings::new(candidates().map(Candidate::from).into()) };
        let fitted = fitted(&goal_of(name, seed, 64), &settings);
        assert_eq!(failing(&fitted.species().unwrap()), [0; 0], "{name}");
    }
}

#[test]
fn fits_that_prune_grow_from_a_hundred_seeds() {
    // An acer whose trunk leans as far as searches let it, pruned by its envelope.
    let mut problem = goal_of("acer", 11, 64);
    let space = Arc::clone(problem.start.generator.space());
    let mut values = problem.start.params.values().to_vec();
    for (name, value) in [("curve_v[0]", 150.0), ("prune_ratio", 1.0), ("prune_width", 0.2)] {
        values[space.select(name).unwrap()[0].index()] = value;
    }
    problem.start.params = space.check(values).unwrap();
    let settings = from_start(&problem, 60, &["prune_ratio", "prune_width", "curve_v[0]"]);
    let fitted = fitted(&problem, &settings);
    assert_eq!(failing(&fitted.species().unwrap()), [0; 0]);
}
