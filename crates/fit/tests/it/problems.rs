//! Problems that make no sense are errors, and parameters that make no tree are costs.

use crate::common::goal_of;
use pleach_fit::{
    Budget, Control, Evaluator, FIT_LIMITS, FitError, FitSettings, Freedom, Objective, ProblemError, Start,
    fit,
};
use pleach_silhouette::Bitmap;
use pleach_tree::Limits;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

fn attempt(
    problem: &pleach_fit::FitProblem,
    settings: &FitSettings,
) -> Result<pleach_fit::Outcome, FitError> {
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    fit(problem, settings, Control::new(&clock, &stop))
}

#[test]
fn goals_that_cannot_be_compared_with_are_named() {
    let good = goal_of("palm", 1, 32);
    let mut none = good.clone();
    none.goals.clear();
    let mut empty = good.clone();
    empty.goals[0].goal = Bitmap::new(32, 32);
    let mut other_size = good.clone();
    other_size.goals[0].goal = Bitmap::new(31, 32);
    let mut no_scale = good.clone();
    no_scale.goals[0].frame.meters_per_pixel = f64::NAN;
    let error = |problem| Evaluator::new(problem, Objective::Blend, FIT_LIMITS).unwrap_err();
    assert_eq!(error(&none), ProblemError::NoGoal);
    assert_eq!(error(&empty), ProblemError::EmptyGoal { index: 0 });
    assert_eq!(error(&other_size), ProblemError::FrameSize { index: 0, goal: (31, 32), frame: (32, 32) });
    assert!(matches!(error(&no_scale), ProblemError::Scale { .. }));
}

#[test]
fn settings_that_do_not_fit_the_generator_are_errors() {
    let problem = goal_of("palm", 1, 32);
    let budget = Budget::evaluations(5);
    let unknown = Freedom { free: vec!["lenght".to_owned()], ..Freedom::default() };
    let error = attempt(&problem, &FitSettings { freedom: unknown, budget, ..FitSettings::default() });
    let message = error.unwrap_err().to_string();
    assert!(message.contains("lenght") && message.contains("did you mean `length`"), "{message}");
    let short = FitSettings { start: Start::Lists(vec![vec![1.0]]), budget, ..FitSettings::default() };
    assert!(matches!(attempt(&problem, &short), Err(FitError::Space(_))));
    let none = FitSettings { start: Start::Lists(Vec::new()), budget, ..FitSettings::default() };
    assert!(matches!(attempt(&problem, &none), Err(FitError::NoStart)));
}

#[test]
fn what_does_not_grow_costs_infinity_and_the_fit_goes_on() {
    let problem = goal_of("palm", 1, 32);
    let limits = Limits { stems: 0, leaves: 0, knots: 0, work: 0 };
    for name in pleach_fit::Optimizer::NAMES {
        let settings = FitSettings {
            optimizer: name.parse().unwrap(),
            budget: Budget::evaluations(300),
            limits,
            ..FitSettings::default()
        };
        let outcome = attempt(&problem, &settings).unwrap();
        assert_eq!(outcome.evaluations, 300);
        assert_eq!(outcome.best.unwrap().score.cost, f64::INFINITY, "{name}");
    }
}

#[test]
fn the_truth_is_perfect_and_ends_the_fit() {
    let problem = goal_of("palm", 1, 64);
    let start = Start::Lists(vec![problem.start.params.values().to_vec()]);
    for objective in Objective::ALL {
        let budget = Budget::evaluations(500);
        let settings = FitSettings { start: start.clone(), objective, budget, ..FitSettings::default() };
        let outcome = attempt(&problem, &settings).unwrap();
        assert_eq!(outcome.stop, pleach_fit::StopReason::Perfect, "{objective}");
        let score = outcome.best.unwrap().score;
        assert_eq!((score.cost, score.iou, score.accuracy), (0.0, 1.0, 1.0));
    }
}
