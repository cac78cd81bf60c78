//! A whole fit in one call.

use crate::common::goal_of;
use pleach_fit::{
    AssessmentSettings, Budget, Candidate, CheckpointSettings, Control, CostModel, Deadline, FitError,
    FitProblem, FitSettings, Fitted, GoalSettings, GuessLibrary, Guessing, Identifiability,
    IndividualSettings, Observer, ObserverError, PosteriorSettings, PreparedSearch, Progress, Start,
    StopReason, fit, fit_goal, fit_goal_with,
};
use pleach_tree::{Foliage, Limits, Species};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

fn settings(evaluations: u64) -> GoalSettings {
    let known = ["palm", "bamboo", "small_pine"].map(|name| pleach_generators::preset(name).unwrap());
    let search = FitSettings { budget: Budget::evaluations(evaluations), ..FitSettings::default() };
    GoalSettings { search, ..GoalSettings::new(known.map(Candidate::from).into()) }
}

fn still() -> Duration {
    Duration::ZERO
}

fn run(problem: &FitProblem, settings: &GoalSettings) -> Fitted {
    fit_goal(problem, settings, Control::new(&still, &AtomicBool::new(false))).unwrap()
}

/// What an observer has seen, and the step at which it raises the flag.
struct Steps<'a> {
    seen: Vec<&'static str>,
    raise_at: &'static str,
    stop: &'a AtomicBool,
}

impl Steps<'_> {
    fn step(&mut self, name: &'static str) {
        if self.seen.last() != Some(&name) {
            self.seen.push(name);
        }
        if name == self.raise_at {
            self.stop.store(true, Ordering::Relaxed);
        }
    }
}

impl Observer for Steps<'_> {
    fn guessing(&mut self, done: usize, all: usize) {
        assert!(done <= all);
        self.step("guessing");
    }

    fn nearest(&mut self, species: &Species, foliage: Foliage) {
        assert_eq!((species.name.as_str(), foliage), ("palm", Foliage::All));
        self.step("nearest");
    }

    fn prepared(&mut self, prepared: &PreparedSearch) -> Result<(), ObserverError> {
        assert_eq!(prepared.problem.start.name, prepared.guess.as_ref().unwrap().nearest[0].name);
        self.step("prepared");
        if self.raise_at == "refused" { Err("no room".into()) } else { Ok(()) }
    }

    fn progress(&mut self, _: &Progress<'_>) {
        self.step("progress");
    }

    fn assessing(&mut self) {
        self.step("assessing");
    }

    fn learning(&mut self, done: usize, all: usize) {
        assert!(done <= all);
        self.step("learning");
    }
}

fn watched(raise_at: &'static str) -> (Result<Fitted, FitError>, Vec<&'static str>) {
    watched_with(&settings(120), raise_at)
}

fn watched_with(
    settings: &GoalSettings,
    raise_at: &'static str,
) -> (Result<Fitted, FitError>, Vec<&'static str>) {
    let stop = AtomicBool::new(false);
    let mut steps = Steps { seen: Vec::new(), raise_at, stop: &stop };
    let control = Control { observers: vec![&mut steps], ..Control::new(&still, &stop) };
    let result = fit_goal(&goal_of("palm", 4, 64), settings, control);
    (result, steps.seen)
}

#[test]
fn a_posterior_is_learnt_in_the_end_and_is_all_or_nothing() {
    let how = PosteriorSettings { trees: 130, samples: 1, ..PosteriorSettings::default() };
    let settings = GoalSettings { posterior: Some(how), ..settings(60) };
    let (whole, seen) = watched_with(&settings, "");
    assert_eq!(seen, ["guessing", "nearest", "prepared", "progress", "assessing", "learning"]);
    let whole = whole.unwrap();
    let found = whole.posterior.unwrap();
    assert_eq!((found.trees + found.failures, found.samples.len()), (130, 1));
    let (interrupted, _) = watched_with(&settings, "learning");
    let interrupted = interrupted.unwrap();
    assert!(interrupted.posterior.is_none() && interrupted.outcome.stop == StopReason::Interrupted);
    assert_eq!((interrupted.best, interrupted.assessment.is_some()), (whole.best, true));
}

#[test]
fn every_step_is_told_and_each_can_be_the_last() {
    let (whole, seen) = watched("");
    let whole = whole.unwrap();
    assert_eq!(seen, ["guessing", "nearest", "prepared", "progress", "assessing"]);
    assert!(whole.assessment.is_some() && whole.outcome.stop == StopReason::Evaluations);

    for at in ["guessing", "nearest", "prepared"] {
        let (result, seen) = watched(at);
        assert!(matches!(result, Err(FitError::Interrupted)), "{at}");
        assert!(!seen.contains(&"assessing"));
    }
    // What was found until then is kept, and what is half judged is not.
    for at in ["progress", "assessing"] {
        let (result, _) = watched(at);
        if at == "progress" {
            assert!(matches!(result, Err(FitError::Interrupted)), "before the first tree");
            continue;
        }
        let fitted = result.unwrap();
        assert!(fitted.assessment.is_none() && fitted.outcome.stop == StopReason::Interrupted);
        assert_eq!(fitted.best, whole.best);
    }
    let (result, seen) = watched("refused");
    assert_eq!(result.unwrap_err().to_string(), "no room");
    assert_eq!(seen, ["guessing", "nearest", "prepared"]);
}

#[test]
fn the_search_is_the_same_as_by_hand_and_the_library_changes_nothing() {
    let problem = goal_of("palm", 4, 64);
    let settings = settings(150);
    let whole = run(&problem, &settings);
    let by_hand =
        fit(&whole.problem, &whole.settings, Control::new(&still, &AtomicBool::new(false))).unwrap();
    assert_eq!(by_hand, whole.outcome);
    assert!(matches!(&whole.settings.start, Start::Lists(lists) if lists.len() > 1));
    assert_eq!(whole.species().unwrap().name, "palm");

    let mut library = GuessLibrary::new();
    for round in 0..3 {
        if round == 2 {
            // What was kept is of no use, and nothing is kept.
            library = library.for_one_goal();
        }
        let stop = AtomicBool::new(false);
        let again = fit_goal_with(&problem, &settings, &mut library, Control::new(&still, &stop)).unwrap();
        assert_eq!(format!("{again:?}"), format!("{whole:?}"));
    }
    // A guess that is known already comes to the same.
    let known = GoalSettings { guess: Guessing::Known(Box::new(whole.guess.clone().unwrap())), ..settings };
    assert_eq!(format!("{:?}", run(&problem, &known)), format!("{whole:?}"));
}

#[test]
fn without_a_guess_the_problem_is_as_it_is() {
    let problem = goal_of("palm", 4, 64);
    let plain = GoalSettings { guess: Guessing::Off, assessment: None, ..settings(60) };
    let fitted = run(&problem, &plain);
    assert!(fitted.guess.is_none() && fitted.assessment.is_none() && fitted.references().is_none());
    assert_eq!(fitted.settings.start, Start::Random);
    assert_eq!(fitted.outcome.stop, StopReason::Evaluations);

    let nothing = Limits { stems: 0, ..Limits::DEFAULT };
    let search = FitSettings { limits: nothing, ..plain.search.clone() };
    let stop = AtomicBool::new(false);
    let plain = GoalSettings { search, ..plain };
    let error = fit_goal(&problem, &plain, Control::new(&still, &stop)).unwrap_err();
    assert!(matches!(error, FitError::NothingGrew { evaluations: 60 }), "{error}");
}

/// The assessment has its share of the time; what is left in the end is for this very tree.
#[test]
fn a_late_assessment_does_less_and_reports_it() {
    let problem = goal_of("palm", 4, 64);
    let timed = |judging: f64, individual: f64, after: Option<f64>| {
        let plain = GoalSettings { guess: Guessing::Off, candidates: Vec::new(), ..settings(60) };
        let search = FitSettings {
            start: Start::Lists(vec![problem.start.params.values().to_vec()]),
            budget: Budget { timeout: Some(Duration::from_secs(1000)), ..Budget::evaluations(60) },
            ..plain.search.clone()
        };
        let time = |seconds: f64| Duration::from_secs_f64(seconds);
        let assessment = AssessmentSettings { time: Some(time(judging)), ..AssessmentSettings::default() };
        let takes_rest = after.is_some();
        let individual = IndividualSettings { takes_rest, ..IndividualSettings::time(time(individual)) };
        let none = CostModel::default();
        let deadline = after.map(|after| Deadline { after: time(after), result: none, further: none });
        let settings = GoalSettings {
            search,
            assessment: Some(assessment),
            individual: Some(individual),
            deadline,
            ..plain
        };
        let stop = AtomicBool::new(false);
        let ticks = std::sync::atomic::AtomicU64::new(0);
        // A hundredth of a second from look to look.
        let clock = || Duration::from_millis(10 * ticks.fetch_add(1, Ordering::Relaxed));
        fit_goal(&problem, &settings, Control::new(&clock, &stop)).unwrap()
    };
    let not_tried = |fitted: &Fitted| {
        let profiles = &fitted.assessment.as_ref().unwrap().profiles;
        profiles.iter().filter(|profile| profile.seen == Identifiability::NotTried).count()
    };
    let seeds = |fitted: &Fitted| fitted.assessment.as_ref().unwrap().held_out.unwrap().count;
    let (short, long) = (timed(0.02, 1.0, None), timed(100.0, 1.0, None));
    assert!((2..16).contains(&seeds(&short)) || rayon::current_num_threads() > 7, "{}", seeds(&short));
    assert!(not_tried(&short) > 0);
    assert_eq!((seeds(&long), not_tried(&long)), (16, 0));
    assert!(!long.as_expected.is_empty());
    // What is left makes the search for this very tree longer, if it is to.
    let (alone, with_rest) = (timed(5.0, 1.0, None), timed(5.0, 1.0, Some(10.0)));
    let trees = |fitted: &Fitted| fitted.individuals[0].trees;
    assert!(trees(&with_rest) > 2 * trees(&alone), "{} {}", trees(&alone), trees(&with_rest));
}

/// A fit that is interrupted in its search and resumed makes its guess again, and counts its time once.
#[test]
fn a_resumed_fit_ends_as_one_that_was_not_interrupted() {
    let problem = goal_of("palm", 4, 64);
    let folder = tempfile::tempdir().unwrap();
    let file = CheckpointSettings::new(folder.path().join("checkpoint"));
    let resumed = CheckpointSettings { resume: true, ..file.clone() };
    let whole = run(&problem, &settings(200));
    let mut parts = Vec::new();
    for (evaluations, checkpoint) in [(90, file), (200, resumed)] {
        let stop = AtomicBool::new(false);
        let ticks = std::sync::atomic::AtomicU64::new(0);
        let clock = || Duration::from_secs(ticks.fetch_add(1, Ordering::Relaxed) + 1000);
        let control = Control { checkpoint: Some(checkpoint), ..Control::new(&clock, &stop) };
        parts.push(fit_goal(&problem, &settings(evaluations), control).unwrap());
    }
    let last = parts.pop().unwrap();
    assert_eq!((last.best, last.outcome.evaluations), (whole.best, 200));
    // The thousand seconds before the search are those of the first part.
    assert_eq!(last.outcome.before_search, parts[0].outcome.before_search);
    let elapsed = last.outcome.elapsed.as_secs();
    assert!((1000..1900).contains(&elapsed), "{elapsed}");
}

/// The search is the same; only which of its last bests is taken differs, and not of the dissertation's algorithm.
#[test]
fn other_seeds_choose_among_the_last_bests() {
    let problem = goal_of("palm", 4, 64);
    let fitted = |optimizer: &str, seed, validates| {
        let plain = settings(200);
        let optimizer = optimizer.parse().unwrap();
        let search = FitSettings { optimizer, seed, start: Start::Random, ..plain.search.clone() };
        run(&problem, &GoalSettings { search, validates, guess: Guessing::Off, assessment: None, ..plain })
    };
    let mut others = 0;
    for seed in 1..5 {
        let (last, kind) = (fitted("evolution", seed, false), fitted("evolution", seed, true));
        assert_eq!(last.outcome, kind.outcome);
        assert_eq!(Some(&last.best), last.outcome.best.as_ref());
        assert!(kind.best == last.best || kind.outcome.finalists.contains(&kind.best));
        others += u32::from(kind.best != last.best);
    }
    assert!(others > 0, "it is always the last");
    let published = fitted("hewitt", 1, true);
    assert!(!published.outcome.finalists.is_empty());
    assert_eq!(Some(published.best), published.outcome.best);
}
