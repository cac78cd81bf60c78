//! From where a picture was taken is found by the way.

use crate::common::goal_of;
use pleach_fit::{
    Azimuth, Budget, Control, FitProblem, FitSettings, Freedom, GoalView, Optimizer, Outcome, Placement,
    Start, Unknown, fit, placements,
};
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::Parts;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Pixels a side.
const SIZE: u32 = 96;

/// A tree from the front, and from `azimuth` degrees in a frame that is off as `off` says.
fn two_views(azimuth: f64, off: Placement, unknown: Unknown) -> FitProblem {
    let species = pleach_generators::preset("acer").unwrap();
    let tree = species.grow(1).unwrap();
    let mut problem = goal_of("acer", 1, SIZE);
    let view = View::degrees(azimuth, 0.0);
    let frame = Frame::automatic(&tree, &view, Parts::LEAFY, SIZE, SIZE);
    let mut goal = Bitmap::default();
    Rasterizer::for_searches(Detail::Half).draw(&tree, &view, &off.frame(&frame), Parts::LEAFY, &mut goal);
    // What is told of the direction is 10 degrees off.
    let view = View::degrees(azimuth - 10.0, 0.0);
    problem.goals.push(GoalView { unknown, ..GoalView::new(goal, view, frame) });
    problem
}

/// Everything of the tree is known but what its second picture shows.
fn only_nuisances(optimizer: &str, evaluations: u64, problem: &FitProblem) -> FitSettings {
    FitSettings {
        optimizer: optimizer.parse().unwrap(),
        budget: Budget::evaluations(evaluations),
        start: Start::Lists(vec![problem.start.params.values().to_vec()]),
        freedom: Freedom { free: Vec::new(), fix: groups(problem) },
        ..FitSettings::default()
    }
}

fn groups(problem: &FitProblem) -> Vec<String> {
    let space = problem.start.generator.space();
    space.slots().map(|slot| space.slot_name(slot)).collect()
}

fn run(problem: &FitProblem, settings: &FitSettings) -> Outcome {
    let (clock, stop) = (|| Duration::ZERO, AtomicBool::new(false));
    fit(problem, settings, Control::new(&clock, &stop)).unwrap()
}

#[test]
fn a_known_tree_tells_from_where_it_is_seen() {
    let unknown = Unknown { azimuth: Azimuth::Any, frame: false };
    let problem = two_views(40.0, Placement::KNOWN, unknown);
    for optimizer in ["evolution", "cma", "de"] {
        let best = run(&problem, &only_nuisances(optimizer, 300, &problem)).best.unwrap();
        assert_eq!(best.genome.values, problem.start.params.values(), "the tree is not touched");
        let found = placements(&problem.goals, &best.genome.nuisances);
        assert_eq!(found[0], Placement::KNOWN);
        let azimuth = found[1].azimuth.unwrap();
        assert!((azimuth - 40.0).abs() < 3.0, "{optimizer}: {azimuth}, cost {}", best.score.cost);
    }
}

#[test]
fn a_frame_that_is_off_is_found_too() {
    let off = Placement { azimuth: None, scale: 1.12, offset: [0.06, -0.04] };
    let problem = two_views(40.0, off, Unknown { azimuth: Azimuth::Within(15.0), frame: true });
    let best = run(&problem, &only_nuisances("evolution", 800, &problem)).best.unwrap();
    let found = placements(&problem.goals, &best.genome.nuisances)[1];
    assert!((found.azimuth.unwrap() - 40.0).abs() < 4.0, "{found:?}");
    assert!((found.scale - off.scale).abs() < 0.02, "{found:?}");
    for (found, off) in found.offset.iter().zip(off.offset) {
        assert!((found - off).abs() < 0.015, "{found} for {off}");
    }
}

#[test]
fn every_optimizer_searches_them_on_any_number_of_threads() {
    let problem = two_views(200.0, Placement::KNOWN, Unknown { azimuth: Azimuth::Any, frame: true });
    for name in Optimizer::NAMES {
        let settings = FitSettings {
            optimizer: name.parse().unwrap(),
            budget: Budget::evaluations(80),
            start: Start::Lists(vec![problem.start.params.values().to_vec()]),
            ..FitSettings::default()
        };
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| run(&problem, &settings))
        };
        let one = on(1);
        assert_eq!(one, on(3), "{name}");
        let [azimuth, scale, right, down] = one.best.unwrap().genome.nuisances[..] else {
            panic!("four numbers are not known");
        };
        assert!((0.0..=360.0).contains(&azimuth) && (0.8..=1.2).contains(&scale));
        assert!(right.abs() <= 0.1 && down.abs() <= 0.1);
    }
}

/// Where every number of the tree is free as well, some twelve times as many as those of the frame.
#[test]
#[ignore = "nightly: a search of 1500 trees"]
fn a_frame_that_is_off_is_found_beside_all_numbers_of_the_tree() {
    let off = Placement { azimuth: None, scale: 1.12, offset: [0.06, -0.04] };
    let problem = two_views(40.0, off, Unknown { azimuth: Azimuth::Within(15.0), frame: true });
    let (mut errors, mut turns) = (Vec::new(), Vec::new());
    for seed in 0..6 {
        let settings = FitSettings {
            seed,
            budget: Budget::evaluations(1500),
            start: Start::Lists(vec![problem.start.params.values().to_vec()]),
            ..FitSettings::default()
        };
        let best = run(&problem, &settings).best.unwrap();
        let found = placements(&problem.goals, &best.genome.nuisances)[1];
        assert!((found.offset[0] - 0.06).abs() < 0.02, "{found:?}");
        errors.push((found.scale - off.scale).abs());
        turns.push((found.azimuth.unwrap() - 40.0).abs());
        println!("{:.3} {found:?}", best.score.cost);
    }
    // A tree that has changed to fit the wrong scale keeps it in some searches: of fourteen seeds, one stayed at 1
    // and another at 1.0025.
    errors.sort_by(f64::total_cmp);
    assert!(errors[0] < 0.02 && errors[2] < 0.06, "{errors:?}");
    // One search of the six ends six degrees off.
    turns.sort_by(f64::total_cmp);
    assert!(turns[4] < 5.0 && turns[5] < 8.0, "{turns:?}");
}
