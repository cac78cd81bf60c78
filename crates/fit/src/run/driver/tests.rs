//! The driver on functions whose minimum is known.

use super::drive;
use crate::control::{
    Budget, CheckpointSettings, Clock, Control, CostModel, Observer, Outcome, Progress, Reserve, Row,
    StopReason,
};
use crate::error::FitError;
use crate::method::Optimizer;
use crate::run::checkpoint::CheckpointError;
use crate::run::fingerprint::Fingerprint;
use crate::run::settings::FitSettings;
use crate::space::{Freedom, SearchSpace, TreeSeed};
use crate::testing::{Function, choice, flagged, integer, params, real};
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Distance from a needle in a mixed space.
fn needle(values: &[f64]) -> f64 {
    let wrong = f64::from(u8::from(values[3] != 3.0)) + f64::from(u8::from(values[1] > 0.0));
    0.01 + (values[0] - 0.7).abs() + (values[1] + 30.0).abs() / 90.0 + (values[2] - 7.0).abs() / 9.0 + wrong
}

const NEEDLE: Function = Function(needle);

fn space() -> SearchSpace {
    let list = vec![real("a", 0.0, 1.0), flagged("f", 90.0), integer("n", 0, 9), choice("c")];
    let freedom = Freedom::default();
    SearchSpace::from_params(params(list), &[0.0, 0.0, 0.0, 0.0], &freedom, TreeSeed::Any).unwrap()
}

fn settings(name: &str, budget: Budget) -> FitSettings {
    FitSettings { optimizer: name.parse().unwrap(), budget, ..FitSettings::default() }
}

fn still() -> Duration {
    Duration::ZERO
}

fn run(settings: &FitSettings, checkpoint: Option<CheckpointSettings>) -> Result<Outcome, FitError> {
    let stop = AtomicBool::new(false);
    let control = Control { checkpoint, ..Control::new(&still, &stop) };
    drive(
        &NEEDLE,
        space(),
        settings,
        &settings.optimizer,
        Fingerprint::default().with("settings", &settings.seed),
        control,
    )
}

#[test]
fn every_optimizer_keeps_its_budget_exactly() {
    for name in Optimizer::NAMES {
        for evaluations in [0, 1, 19, 333] {
            let outcome = run(&settings(name, Budget::evaluations(evaluations)), None).unwrap();
            assert_eq!(outcome.evaluations, evaluations, "{name}");
            assert_eq!(outcome.stop, StopReason::Evaluations);
            assert_eq!(outcome.best.is_some(), evaluations > 0);
            assert_eq!(outcome.history.len() as u64, outcome.generations);
        }
        let three = Budget { generations: Some(3), ..Budget::default() };
        let outcome = run(&settings(name, three), None).unwrap();
        assert_eq!((outcome.generations, outcome.stop), (3, StopReason::Generations));
    }
}

#[test]
fn threads_change_nothing() {
    for name in Optimizer::NAMES {
        let settings = settings(name, Budget::evaluations(400));
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| run(&settings, None).unwrap())
        };
        let alone = on(1);
        assert_eq!((on(2), on(7)), (alone.clone(), alone), "{name}");
    }
}

#[test]
fn a_run_stopped_anywhere_goes_on_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    for name in Optimizer::NAMES {
        let whole = run(&settings(name, Budget::evaluations(400)), None).unwrap();
        for cuts in [vec![1], vec![17], vec![50, 51, 170], vec![399]] {
            let path = folder.path().join("checkpoint");
            let file = CheckpointSettings { resume: false, ..CheckpointSettings::new(path) };
            let mut resume = false;
            for cut in cuts.iter().copied().chain([400]) {
                let file = CheckpointSettings { resume, ..file.clone() };
                let part = run(&settings(name, Budget::evaluations(cut)), Some(file)).unwrap();
                resume = true;
                if cut == 400 {
                    assert_eq!(part, whole, "{name} cut at {cuts:?}");
                }
            }
        }
    }
}

#[test]
fn the_stop_flag_the_clock_and_the_target_end_a_run() {
    let stop = AtomicBool::new(true);
    let settings = settings("random", Budget::default());
    let run = |budget, clock: &dyn Clock, stop: &AtomicBool| {
        let settings = FitSettings { budget, ..settings.clone() };
        drive(
            &NEEDLE,
            space(),
            &settings,
            &settings.optimizer,
            Fingerprint::default(),
            Control::new(clock, stop),
        )
        .unwrap()
    };
    assert_eq!(run(Budget::default(), &still, &stop).stop, StopReason::Interrupted);
    let ticks = Mutex::new(0);
    let clock = || {
        *ticks.lock().unwrap() += 1;
        Duration::from_millis(*ticks.lock().unwrap())
    };
    let go = AtomicBool::new(false);
    let outcome = run(Budget::timeout(Duration::from_millis(200)), &clock, &go);
    assert_eq!(outcome.stop, StopReason::Timeout);
    assert!(outcome.elapsed >= Duration::from_millis(200) && outcome.evaluations > 0);
    // The reserve is what the cost model says for an evaluation of one tick, up to its bound.
    let elapsed = |max: u64, serial: f64| {
        let cost = CostModel { fixed: Duration::from_millis(10), serial, parallel: 0.0 };
        let reserve = Reserve { max: Duration::from_millis(max), cost };
        let budget = Budget { reserve: Some(reserve), ..Budget::timeout(Duration::from_secs(1)) };
        *ticks.lock().unwrap() = 0;
        let outcome = run(budget, &clock, &go);
        assert_eq!(outcome.stop, StopReason::Timeout);
        outcome.elapsed.as_millis()
    };
    let (little, much, all) = (elapsed(500, 20.0), elapsed(500, 190.0), elapsed(500, 5000.0));
    assert!((970..1000).contains(&little), "{little}");
    assert!((800..850).contains(&much), "{much}");
    assert!((500..550).contains(&all), "{all}");
    // A bare function has an intersection over union of zero.
    let target = Budget { target_iou: Some(0.0), ..Budget::default() };
    assert_eq!(run(target, &still, &go).stop, StopReason::TargetIou);
}

#[test]
fn a_checkpoint_of_other_settings_is_refused_and_a_bad_folder_is_told_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let file = CheckpointSettings { resume: true, ..CheckpointSettings::new(folder.path().join("c")) };
    let first = settings("random", Budget::evaluations(10));
    run(&first, Some(file.clone())).unwrap();
    let other = FitSettings { seed: 2, ..first.clone() };
    let error = run(&other, Some(file.clone())).unwrap_err();
    assert!(matches!(error, FitError::Checkpoint(CheckpointError::OtherRun { .. })), "{error}");
    let nowhere = CheckpointSettings::new(folder.path().join("no/such"));
    let error = run(&first, Some(nowhere)).unwrap_err();
    assert!(matches!(error, FitError::Checkpoint(CheckpointError::Io { .. })), "{error}");
}

#[test]
fn a_panic_while_scoring_is_an_error() {
    let stop = AtomicBool::new(false);
    let objective = Function(|values| if values[2] == 7.0 { panic!("seven") } else { values[0] });
    let settings = settings("evolution", Budget::evaluations(400));
    let fingerprint = Fingerprint::default();
    let error =
        drive(&objective, space(), &settings, &settings.optimizer, fingerprint, Control::new(&still, &stop));
    assert_eq!(error.unwrap_err().to_string(), "scoring a tree panicked: seven");
}

#[derive(Default)]
struct Log {
    rows: Vec<Row>,
    last: u64,
}

impl Observer for Log {
    fn progress(&mut self, progress: &Progress<'_>) {
        assert!(progress.evaluations >= self.last);
        self.last = progress.evaluations;
    }

    fn generation(&mut self, row: &Row) {
        self.rows.push(*row);
    }
}

#[test]
fn observers_see_every_generation_of_a_resumed_run() {
    let folder = tempfile::tempdir().unwrap();
    let mut seen = Log::default();
    let mut outcome = None;
    for (resume, evaluations) in [(false, 120), (true, 300)] {
        seen = Log::default();
        let stop = AtomicBool::new(false);
        let path = folder.path().join("checkpoint");
        let control = Control {
            observers: vec![&mut seen],
            checkpoint: Some(CheckpointSettings { resume, ..CheckpointSettings::new(path) }),
            ..Control::new(&still, &stop)
        };
        let settings = settings("hewitt", Budget::evaluations(evaluations));
        outcome = Some(
            drive(&NEEDLE, space(), &settings, &settings.optimizer, Fingerprint::default(), control).unwrap(),
        );
    }
    let outcome = outcome.unwrap();
    assert_eq!(seen.rows, outcome.history);
    assert_eq!(seen.last, 300);
    assert!(seen.rows.windows(2).all(|w| w[0].best_cost >= w[1].best_cost));
}

/// States that were changed in a few places, with a checksum that is right: the run goes on or refuses.
#[test]
fn forged_states_are_refused_or_searched_on_from() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    let file = CheckpointSettings { resume: true, ..CheckpointSettings::new(path.clone()) };
    let mut draws = crate::space::Stream::at(7, 0, 0, 0);
    let (mut refused, mut taken) = (0, 0);
    // In the middle of a generation and between two.
    for (name, evaluations) in Optimizer::NAMES.into_iter().flat_map(|name| [(name, 407), (name, 620)]) {
        let _ = std::fs::remove_file(&path);
        run(&settings(name, Budget::evaluations(evaluations)), Some(file.clone())).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let end = bytes.iter().position(|byte| *byte == b'\n').unwrap();
        for _ in 0..400 {
            let mut body = bytes[end + 1..].to_vec();
            for _ in 0..1 + draws.below(3) {
                let at = draws.below(body.len());
                match draws.below(4) {
                    0 => body[at] = draws.bits() as u8,
                    1 => body[at] ^= 1 << draws.below(8),
                    2 => drop(body.drain(at..(at + 8).min(body.len()))),
                    _ => drop(body.splice(at..at, [0xff; 9])),
                }
            }
            std::fs::write(&path, crate::run::checkpoint::sealed("forged", &body)).unwrap();
            match run(&settings(name, Budget::evaluations(evaluations + 60)), Some(file.clone())) {
                Ok(_) => taken += 1,
                Err(FitError::Checkpoint(_)) => refused += 1,
                Err(error) => panic!("{name}: {error}"),
            }
        }
    }
    assert!(refused > 1000 && taken > 100, "{refused} refused, {taken} taken");
}
