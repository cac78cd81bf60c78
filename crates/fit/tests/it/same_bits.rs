//! The same command gives the same bits: on any number of threads, interrupted anywhere.

use crate::common::goal_of;
use pleach_fit::{
    Budget, CheckpointSettings, Control, FitProblem, FitSettings, Optimizer, Outcome, StopReason, TreeSeed,
    fit,
};
use pleach_tree::Foliage;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::Duration;

fn settings(name: &str, evaluations: u64) -> FitSettings {
    FitSettings {
        optimizer: name.parse().expect("a known name"),
        budget: Budget::evaluations(evaluations),
        tree_seed: TreeSeed::Any,
        ..FitSettings::default()
    }
}

fn run(problem: &FitProblem, settings: &FitSettings, checkpoint: Option<CheckpointSettings>) -> Outcome {
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    fit(problem, settings, Control { checkpoint, ..Control::new(&clock, &stop) }).expect("a good problem")
}

#[test]
fn threads_change_nothing() {
    let problem = goal_of("palm", 1, 64);
    for name in Optimizer::NAMES {
        let settings = settings(name, 500);
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| run(&problem, &settings, None))
        };
        let one = on(1);
        assert!(one.best.as_ref().unwrap().score.iou > 0.1, "{name} finds something");
        for threads in [2, 8] {
            assert_eq!(on(threads), one, "{name} on {threads} threads");
        }
    }
}

#[test]
fn a_fit_killed_at_any_checkpoint_comes_to_the_same_end() {
    let problem = goal_of("palm", 1, 64);
    let folder = tempfile::tempdir().unwrap();
    for name in Optimizer::NAMES {
        let mut whole = run(&problem, &settings(name, 600), None);
        let path = folder.path().join(name);
        let file = CheckpointSettings {
            interval: Duration::ZERO,
            resume: true,
            ..CheckpointSettings::new(path.clone())
        };
        // A clock that runs makes batches of many sizes; a flag raised by it interrupts them.
        let mut parts = 0;
        let outcome = loop {
            parts += 1;
            let (ticks, stop) = (AtomicU64::new(0), AtomicBool::new(false));
            let clock = || {
                let tick = ticks.fetch_add(1, Ordering::Relaxed);
                if tick > 6 + 4 * parts {
                    stop.store(true, Ordering::Relaxed);
                }
                Duration::from_millis(7 * (tick % 5) + 35 * (tick / 5))
            };
            let control = Control { checkpoint: Some(file.clone()), ..Control::new(&clock, &stop) };
            let outcome = fit(&problem, &settings(name, 600), control).unwrap();
            if outcome.stop == StopReason::Interrupted {
                // As after `kill -9` while the next checkpoint was being written.
                std::fs::write(folder.path().join(format!("{name}.tmp")), b"pleach-checkp").unwrap();
                continue;
            }
            break outcome;
        };
        assert!(parts > 3, "{name} was interrupted {parts} times");
        let mut resumed = outcome;
        for outcome in [&mut whole, &mut resumed] {
            outcome.elapsed = Duration::ZERO;
            outcome.before_search = Duration::ZERO;
            outcome.history.iter_mut().for_each(|row| row.elapsed_s = 0.0);
        }
        assert_eq!(resumed, whole, "{name}");
    }
}

#[test]
fn another_goal_is_another_run() {
    let folder = tempfile::tempdir().unwrap();
    let file = CheckpointSettings { resume: true, ..CheckpointSettings::new(folder.path().join("c")) };
    let settings = settings("random", 20);
    run(&goal_of("palm", 1, 64), &settings, Some(file.clone()));
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    let control = Control { checkpoint: Some(file.clone()), ..Control::new(&clock, &stop) };
    let error = fit(&goal_of("palm", 1, 48), &settings, control).unwrap_err().to_string();
    assert!(error.contains("it differs in the goal's picture"), "{error}");

    // The same picture of a larger tree, and of one without leaves.
    let control = || Control { checkpoint: Some(file.clone()), ..Control::new(&clock, &stop) };
    let mut taller = goal_of("palm", 1, 64);
    taller.goals[0].frame.meters_per_pixel *= 1.2;
    let error = fit(&taller, &settings, control()).unwrap_err().to_string();
    assert!(error.ends_with("it differs in the tree's height (--height)"), "{error}");
    let bare = FitProblem { foliage: Foliage::None, ..goal_of("palm", 1, 64) };
    let error = fit(&bare, &settings, control()).unwrap_err().to_string();
    assert!(error.ends_with("it differs in leaves (--leaves)"), "{error}");
}
