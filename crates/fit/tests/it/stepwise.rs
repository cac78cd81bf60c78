//! A fit that its caller drives has the bits of one that is made in one call.

use pleach_fit::{
    Budget, Candidate, Control, Evaluate as _, FitProblem, FitSettings, Fitted, GoalSettings, GoalView,
    GuessLibrary, Stepwise, StopReason, evaluator, fit_goal,
};
use pleach_silhouette::{Frame, View, silhouette};
use pleach_tree::Parts;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

const EVALUATIONS: u64 = 90;

fn asked() -> (FitProblem, GoalSettings) {
    let known = ["palm", "lombardy_poplar"].map(|name| pleach_generators::preset(name).unwrap());
    let tree = known[1].grow(7).unwrap();
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 64, 64);
    let goal = GoalView::new(silhouette(&tree, View::FRONT, 64), View::FRONT, frame);
    let search = FitSettings { budget: Budget::evaluations(EVALUATIONS), ..FitSettings::default() };
    let problem = FitProblem::new(known[0].clone(), goal);
    (problem, GoalSettings { search, ..GoalSettings::new(known.map(Candidate::from).into()) })
}

fn stepped(workers: usize) -> Fitted {
    let (problem, settings) = asked();
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    let control = || Control::new(&clock, &stop);
    let mut fit = Stepwise::begin(&problem, &settings, GuessLibrary::new(), control()).unwrap();
    let elsewhere = evaluator(&fit.prepared().problem, &fit.prepared().settings).unwrap();
    let mut seconds = 0;
    while fit.ended(Duration::from_secs(seconds)).is_none() {
        let batch = fit.ask(workers);
        // Scored one by one, and the last first.
        let mut scores: Vec<_> = batch
            .genomes
            .iter()
            .rev()
            .flat_map(|one| elsewhere.scores(std::slice::from_ref(one), batch.max_size))
            .collect();
        scores.reverse();
        // Time passes by leaps: it decides how large batches are, and nothing else.
        seconds += u64::from(scores.len() % 2 == 0);
        let _ = fit.tell(&scores, Duration::from_secs(seconds));
    }
    fit.finish(control()).unwrap()
}

#[test]
fn steps_have_the_bits_of_one_call_for_any_number_of_workers() {
    let (problem, settings) = asked();
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    let whole = fit_goal(&problem, &settings, Control::new(&clock, &stop)).unwrap();
    for workers in [1, 3] {
        let steps = stepped(workers);
        assert_eq!(steps.best, whole.best, "{workers}");
        assert_eq!(steps.outcome.best, whole.outcome.best);
        assert_eq!((steps.outcome.evaluations, steps.outcome.stop), (EVALUATIONS, StopReason::Evaluations));
        let rows = |fitted: &Fitted| -> Vec<_> {
            let history = fitted.outcome.history.iter();
            history.map(|row| (row.evaluations, row.best_cost.to_bits(), row.likeness)).collect()
        };
        assert_eq!(rows(&steps), rows(&whole));
        let fresh = |fitted: &Fitted| fitted.assessment.as_ref().unwrap().held_out;
        assert_eq!(fresh(&steps), fresh(&whole));
    }
}

#[test]
fn what_is_stopped_early_is_judged_all_the_same() {
    let (problem, settings) = asked();
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    let control = || Control::new(&clock, &stop);
    let mut fit = Stepwise::begin(&problem, &settings, GuessLibrary::new(), control()).unwrap();
    assert!(fit.best().is_none() && fit.likeness().is_none());
    let elsewhere = evaluator(&fit.prepared().problem, &fit.prepared().settings).unwrap();
    let batch = fit.ask(2);
    let scores = elsewhere.scores(&batch.genomes, batch.max_size);
    let _ = fit.tell(&scores, Duration::from_secs(1));
    assert_eq!(fit.evaluations(), scores.len() as u64);
    assert!(fit.used(Duration::from_secs(1)).unwrap() < 1.0);
    let fitted = fit.finish(control()).unwrap();
    assert_eq!(fitted.outcome.stop, StopReason::Interrupted);
    assert!(fitted.assessment.is_some());
    // Nobody has scored anything: nothing grew.
    let nothing = Stepwise::begin(&problem, &settings, GuessLibrary::new(), control()).unwrap();
    assert!(nothing.finish(control()).is_err());
}
