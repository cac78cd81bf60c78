//! A fit that its caller drives has the bits of one that is made in one call.

use pleach_fit::{
    Budget, Candidate, Control, Evaluate as _, FitProblem, FitSettings, Fitted, GoalSettings, GoalView,
    GuessLibrary, GuessSettings, Guessing, RaceCriterion, RaceSettings, Stepwise, StepwiseRace, StopReason,
    evaluator, fit_goal,
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

/// Candidates of three generators, one of which stays out of the second round or not.
fn asked_of_families(criterion: RaceCriterion) -> (FitProblem, GoalSettings) {
    let known =
        ["palm", "coffey_whorls", "stylised_twins"].map(|name| pleach_generators::preset(name).unwrap());
    let (problem, settings) = asked();
    let race = RaceSettings { evaluations: 40, criterion, ..RaceSettings::default() };
    let guess =
        Guessing::Compare(GuessSettings { race: Some(race), variants: 2, ..GuessSettings::default() });
    let candidates = known.map(Candidate::from).into();
    (
        problem,
        GoalSettings { guess, search: settings.search, assessment: None, ..GoalSettings::new(candidates) },
    )
}

/// A search of a race, and its least cost.
#[derive(Debug)]
struct Ran {
    species: String,
    number: usize,
    count: usize,
    best: f64,
}

/// The search after a race whose every search is scored elsewhere, and the names of those that ran.
fn raced(criterion: RaceCriterion, workers: usize, legs: usize) -> (Stepwise, Vec<Ran>) {
    let (problem, settings) = asked_of_families(criterion);
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    let control = || Control::new(&clock, &stop);
    let mut race = StepwiseRace::begin(&problem, &settings, GuessLibrary::new(), control()).unwrap();
    assert!(race.ask(workers).genomes.is_empty() && race.best().is_none() && race.leg().is_none());
    let mut ran = Vec::new();
    while let Some(leg) = race.next_leg(Duration::ZERO).unwrap() {
        let elsewhere = evaluator(leg.problem, &leg.settings).unwrap();
        ran.push(Ran {
            species: leg.species.to_owned(),
            number: leg.number,
            count: leg.count,
            best: f64::INFINITY,
        });
        if ran.len() > legs {
            break;
        }
        loop {
            let batch = race.ask(workers);
            if batch.genomes.is_empty() {
                break;
            }
            race.tell(&elsewhere.scores(&batch.genomes, batch.max_size), Duration::ZERO);
            assert!(race.used().is_some_and(|used| used > 0.0));
            ran.last_mut().unwrap().best = race.best().unwrap().score.cost;
        }
    }
    (race.finish(control()).unwrap(), ran)
}

#[test]
fn a_race_in_steps_has_the_bits_of_one_call() {
    for criterion in [RaceCriterion::Origin, RaceCriterion::Cost] {
        let (problem, settings) = asked_of_families(criterion);
        let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
        let whole = Stepwise::begin(&problem, &settings, GuessLibrary::new(), Control::new(&clock, &stop));
        let whole = whole.unwrap();
        let guess = |fit: &Stepwise| fit.prepared().guess.clone().unwrap();
        for workers in [1, 3] {
            let (steps, ran) = raced(criterion, workers, usize::MAX);
            assert_eq!(guess(&steps).runners, guess(&whole).runners);
            assert_eq!(guess(&steps).start(), guess(&whole).start());
            assert_eq!(guess(&steps).references, guess(&whole).references);
            let placed = |fit: &Stepwise| fit.prepared().problem.goals[0].registered;
            assert_eq!(placed(&steps), placed(&whole));
            // All three run at first.
            let first: Vec<_> = ran.iter().take(3).map(|ran| (ran.number, ran.count)).collect();
            assert_eq!(first, [(1, 3), (2, 3), (3, 3)], "{ran:?}");
        }
        assert!(guess(&whole).runners.iter().any(|runner| runner.reached < runner.guessed));
    }
}

#[test]
fn a_race_may_be_ended_early() {
    let (fit, ran) = raced(RaceCriterion::Cost, 1, 1);
    assert_eq!(ran.len(), 2);
    let guess = fit.prepared().guess.as_ref().unwrap();
    assert_eq!(guess.runners.len(), 3);
    let costs: Vec<f64> = guess.runners.iter().map(|runner| runner.reached).collect();
    assert!(costs.is_sorted(), "{costs:?}");
    let searched = guess.runners.iter().filter(|runner| runner.reached < runner.guessed).count();
    assert!(searched <= 1, "{:?}", guess.runners);
    // In the second round, which begins from the same lists as the first, all that the first has found stays.
    let (fit, ran) = raced(RaceCriterion::Cost, 1, 3);
    assert_eq!((ran.len(), ran[3].number), (4, 1), "{ran:?}");
    let runners = &fit.prepared().guess.as_ref().unwrap().runners;
    assert!(ran[..3].iter().any(|one| runners.iter().any(|runner| one.best < runner.guessed)), "{ran:?}");
    for one in &ran[..3] {
        let runner = runners.iter().find(|runner| runner.species == one.species).unwrap();
        assert_eq!(runner.reached, one.best.min(runner.guessed), "{runner:?}");
    }
}

#[test]
fn candidates_of_one_generator_do_not_race() {
    let (problem, settings) = asked();
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    let control = || Control::new(&clock, &stop);
    let mut race = StepwiseRace::begin(&problem, &settings, GuessLibrary::new(), control()).unwrap();
    assert!(race.next_leg(Duration::ZERO).unwrap().is_none());
    let steps = race.finish(control()).unwrap();
    let whole = Stepwise::begin(&problem, &settings, GuessLibrary::new(), control()).unwrap();
    assert_eq!(steps.prepared().settings, whole.prepared().settings);
}
