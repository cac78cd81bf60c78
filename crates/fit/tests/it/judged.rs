//! What is asked of a result: other seeds, and what the goal determines.

use crate::common::goal_of;
use pleach_fit::{
    Budget, Control, EvalWorkspace, Evaluator, FIT_LIMITS, FitError, FitProblem, FitSettings, Freedom,
    Genome, Identifiability, Interval, Objective, PosteriorNumber, Score, Scored, Start, TreeSeed, Until,
    fit, fresh_seeds, profile, settled, with_expected_numbers,
};
use pleach_tree::Slot;
use std::num::NonZeroU32;
use std::sync::atomic::AtomicBool;

/// Nobody asks these to stop.
static GO: AtomicBool = AtomicBool::new(false);

fn base(problem: &FitProblem) -> &[f64] {
    problem.start.params.values()
}

fn truth(problem: &FitProblem) -> Genome {
    Genome::new(base(problem).to_vec(), 1)
}

fn evaluate(evaluator: &Evaluator, genome: &Genome) -> Score {
    let mut memory: EvalWorkspace = evaluator.workspace();
    evaluator.evaluate(genome, &mut memory)
}

#[test]
fn several_seeds_are_judged_by_their_mean() {
    let problem = goal_of("acer", 1, 64);
    let one = Evaluator::new(&problem, Objective::Iou, FIT_LIMITS).unwrap();
    let cost = |seed| evaluate(&one, &Genome { tree_seed: seed, ..truth(&problem) }).cost;
    let mean = (cost(1) + cost(2) + cost(3)) / 3.0;
    assert!(cost(1) == 0.0 && mean > 0.1, "only the goal's own tree fits: {mean}");
    let three = Evaluator::new(&problem, Objective::Iou, FIT_LIMITS).unwrap();
    let three = three.with_seeds(NonZeroU32::new(3).unwrap());
    assert!((evaluate(&three, &truth(&problem)).cost - mean).abs() < 1e-12);
}

#[test]
fn other_seeds_of_the_truth_are_alike_but_not_the_same() {
    let problem = goal_of("lombardy_poplar", 1, 96);
    let fresh = fresh_seeds(&problem, Objective::Iou, FIT_LIMITS, &truth(&problem), 8, (&GO).into())
        .unwrap()
        .unwrap();
    assert_eq!(fresh.count, 8);
    assert!((0.6..0.95).contains(&fresh.iou.mean), "{fresh:?}");
    assert!(fresh.iou.sd > 0.001 && fresh.iou.sd < 0.1, "{fresh:?}");
    assert!((fresh.iou.mean + fresh.cost.mean - 1.0).abs() < 1e-12);
    // Trees that do not grow have no mean.
    let none = pleach_tree::Limits { stems: 3, ..FIT_LIMITS };
    assert_eq!(fresh_seeds(&problem, Objective::Iou, none, &truth(&problem), 8, (&GO).into()).unwrap(), None);
}

#[test]
fn heights_are_determined_and_what_is_not_read_is_not_seen() {
    let problem = goal_of("palm", 1, 96);
    let settings = FitSettings { objective: Objective::Iou, ..FitSettings::default() };
    let best = Scored { genome: truth(&problem), score: Score::from_cost(0.0) };
    let profiles = profile(&problem, &settings, &best, &[], 0.05, (&GO).into()).unwrap();
    let space = problem.start.generator.space();
    let seen = |name: &str| {
        let slot = space.select(name).unwrap()[0];
        profiles.iter().find(|profile| profile.slot == slot).unwrap().seen
    };
    assert_eq!(seen("g_scale"), Identifiability::Determined);
    // A palm has two levels.
    assert_eq!(seen("length[3]"), Identifiability::NotSeen);
    assert_eq!(seen("blossom_shape"), Identifiability::NotSeen);

    // A small move is tried only where a large one is seen.
    for profile in &profiles {
        let is_tried = profile.rises[0].iter().any(Option::is_some);
        let large = profile.rises[1].iter().flatten();
        let is_seen = large.clone().any(|rise| *rise > 0.05);
        assert!(is_seen || !is_tried || large.count() == 0, "{profile:?}");
    }
    assert!(profiles.iter().any(|profile| profile.rises[0] == [None; 2] && profile.rises[1][0].is_some()));

    // What was learnt of a number is not tried again.
    let slot = |name: &str| space.select(name).unwrap()[0];
    let interval = Interval { low: 1.0, median: 2.0, high: 3.0 };
    let (prior, posterior) = (interval, interval);
    let known = [PosteriorNumber { slot: slot("g_scale"), prior, posterior, shrunk: 0.3 }];
    let profiles = profile(&problem, &settings, &best, &known, 0.05, (&GO).into()).unwrap();
    let scale = profiles.iter().find(|profile| profile.slot == slot("g_scale")).unwrap();
    assert_eq!((scale.seen, scale.rises), (Identifiability::Loosely, [[None; 2]; 2]));
}

/// The numbers of `species` as what is expected, those of the goal's own tree as what was found.
fn expected_of(species: &str) -> (FitProblem, FitSettings, Scored, Vec<(Slot, f64)>) {
    // A goal of another seed: its very tree would stay as it is.
    let problem = goal_of("acer", 2, 64);
    let settings = FitSettings { objective: Objective::Balance, ..FitSettings::default() };
    let evaluator = Evaluator::new(&problem, Objective::Balance, FIT_LIMITS).unwrap();
    let genome = truth(&problem);
    let best = Scored { score: evaluate(&evaluator, &genome), genome };
    let other = pleach_generators::preset(species).unwrap();
    let space = problem.start.generator.space();
    let expected = space.slots().map(|slot| (slot, other.params.values()[slot.index()])).collect();
    (problem, settings, best, expected)
}

#[test]
fn what_makes_no_difference_is_as_expected_and_all_else_stays() {
    let (problem, settings, best, mut expected) = expected_of("acer");
    let space = problem.start.generator.space();
    let slot = |name: &str| space.select(name).unwrap()[0];
    // Blossoms that there are none of, and a height that the goal has not.
    let moved = [(slot("blossom_scale"), 0.123), (slot("g_scale"), 5.0)];
    for (slot, value) in moved {
        expected.iter_mut().find(|(of, _)| *of == slot).unwrap().1 = value;
    }
    let (kept, slots) = with_expected_numbers(&problem, &settings, &best, &expected, (&GO).into()).unwrap();
    assert_eq!(slots, [slot("blossom_scale")]);
    assert_eq!(kept.genome.values[slot("blossom_scale").index()], 0.123);
    assert_eq!(kept.genome.values[slot("g_scale").index()], base(&problem)[slot("g_scale").index()]);
    assert_eq!(kept.score.cost, best.score.cost);
    // In the other direction the height is what makes the trees like the goal.
    let mut genome = best.genome.clone();
    genome.values[slot("g_scale").index()] = 5.0;
    let evaluator = Evaluator::new(&problem, Objective::Balance, FIT_LIMITS).unwrap();
    let low = Scored { score: evaluate(&evaluator, &genome), genome };
    let own: Vec<_> = space.slots().map(|slot| (slot, base(&problem)[slot.index()])).collect();
    let (kept, slots) = with_expected_numbers(&problem, &settings, &low, &own, (&GO).into()).unwrap();
    assert_eq!((slots, &kept.genome), (vec![slot("g_scale")], &best.genome));
    assert!(kept.score.cost < low.score.cost && kept.score.likeness.is_some());
}

#[test]
fn the_very_tree_of_the_goal_stays_as_it_is() {
    let problem = goal_of("acer", 1, 64);
    let settings = FitSettings::default();
    let evaluator = Evaluator::new(&problem, settings.objective, FIT_LIMITS).unwrap();
    let genome = truth(&problem);
    let best = Scored { score: evaluate(&evaluator, &genome), genome };
    let space = problem.start.generator.space();
    let blossoms = (space.select("blossom_scale").unwrap()[0], 0.123);
    let (kept, slots) = with_expected_numbers(&problem, &settings, &best, &[blossoms], (&GO).into()).unwrap();
    assert_eq!((kept, slots), (best, Vec::new()));
}

#[test]
fn numbers_are_moved_no_farther_than_other_seeds_allow_on_any_number_of_threads() {
    let (problem, settings, best, expected) = expected_of("quaking_aspen");
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| with_expected_numbers(&problem, &settings, &best, &expected, (&GO).into()).unwrap())
    };
    let (kept, slots) = run(1);
    let differing = expected.iter().filter(|(slot, value)| base(&problem)[slot.index()] != *value).count();
    assert!(!slots.is_empty() && slots.len() < differing, "{} of {differing}", slots.len());
    assert!((kept.clone(), slots.clone()) == run(2) && (kept.clone(), slots) == run(8));
    let of = |genome: &Genome| {
        fresh_seeds(&problem, Objective::Balance, FIT_LIMITS, genome, 8, (&GO).into()).unwrap().unwrap()
    };
    let [before, after] = [&best.genome, &kept.genome].map(of);
    assert!(after.cost.mean < before.cost.mean + before.cost.sd, "{before:?} {after:?}");
}

#[test]
fn variations_of_size_are_searched_by_nobody_and_reported_as_not_seen() {
    let problem = goal_of("acer", 2, 64);
    let slots: Vec<Slot> = problem.start.generator.space().size_jitters().collect();
    assert!(slots.iter().any(|&slot| base(&problem)[slot.index()] != 0.0), "the species has them");
    let result = |freedom: Freedom, optimizer: &str| {
        let settings = FitSettings {
            optimizer: optimizer.parse().unwrap(),
            budget: Budget::evaluations(60),
            start: Start::Lists(vec![base(&problem).to_vec()]),
            freedom,
            ..FitSettings::default()
        };
        let clock = || std::time::Duration::ZERO;
        let stop = std::sync::atomic::AtomicBool::new(false);
        let best = fit(&problem, &settings, Control::new(&clock, &stop)).unwrap().best.unwrap();
        let kept: Vec<f64> = slots.iter().map(|&slot| best.genome.values[slot.index()]).collect();
        (kept, settled(&problem, &settings, &best.genome).unwrap(), settings, best)
    };
    let (kept, told, settings, best) = result(Freedom::default(), "evolution");
    assert!(kept.iter().all(|value| *value == 0.0) && told == slots, "{kept:?} {told:?}");
    let profiles = profile(&problem, &settings, &best, &[], 0.01, (&GO).into()).unwrap();
    let unseen = |slot| profiles.iter().any(|p| p.slot == slot && p.seen == Identifiability::NotSeen);
    assert!(slots.iter().all(|&slot| unseen(slot)));
    // Nor are they moved to where they are expected.
    let expected: Vec<_> = slots.iter().map(|&slot| (slot, base(&problem)[slot.index()])).collect();
    let (kept, moved) = with_expected_numbers(&problem, &settings, &best, &expected, (&GO).into()).unwrap();
    assert!(moved.is_empty() && slots.iter().all(|&slot| kept.genome.values[slot.index()] == 0.0));

    // The dissertation's algorithm searches them, and what is fixed stays.
    assert!(result(Freedom::default(), "hewitt").1.is_empty());
    let fixed = Freedom { free: Vec::new(), fix: vec!["g_scale_v".to_owned()] };
    let (kept, told, ..) = result(fixed, "evolution");
    assert_eq!(kept[0], base(&problem)[slots[0].index()]);
    assert!(!told.contains(&slots[0]), "{told:?}");
}

#[test]
fn asked_to_stop_nothing_is_judged() {
    let problem = goal_of("palm", 1, 64);
    let settings = FitSettings { objective: Objective::Iou, ..FitSettings::default() };
    let best = Scored { genome: truth(&problem), score: Score::from_cost(0.0) };
    let stop = AtomicBool::new(true);
    let fresh = fresh_seeds(&problem, Objective::Iou, FIT_LIMITS, &truth(&problem), 8, (&stop).into());
    assert!(matches!(fresh, Err(FitError::Interrupted)));
    let profiled = profile(&problem, &settings, &best, &[], 0.05, (&stop).into());
    assert!(matches!(profiled, Err(FitError::Interrupted)));
    let own: Vec<_> = [(problem.start.generator.space().slots().next().unwrap(), 1.0)].into();
    let moved = with_expected_numbers(&problem, &settings, &best, &own, (&stop).into());
    assert!(matches!(moved, Err(FitError::Interrupted)));
    // If it is late, all stays as it is.
    let clock = || std::time::Duration::from_secs(9);
    let late = Until::from(&GO).or_late(&clock, Some(std::time::Duration::from_secs(1)));
    let (kept, moved) = with_expected_numbers(&problem, &settings, &best, &own, late).unwrap();
    assert_eq!((kept, moved), (best, Vec::new()));
}

/// Pipes and beads are nobody's trees: stems taper as the start's do, or at most to a point.
#[test]
fn nothing_is_searched_that_nobody_would_draw() {
    let problem = goal_of("palm", 1, 64);
    let space = problem.start.generator.space();
    let slot = |name: &str| space.select(name).unwrap()[0];
    // A palm's trunk has rings and its fronds are long: fits that start there keep both.
    assert!(
        base(&problem)[slot("taper[0]").index()] > 2.0 && base(&problem)[slot("leaf_scale").index()] > 0.5
    );
    let acer = pleach_generators::preset("acer").unwrap().params.values().to_vec();
    let most = |start: &[f64], optimizer: &str| {
        let settings = FitSettings {
            optimizer: optimizer.parse().unwrap(),
            budget: Budget::evaluations(150),
            // The second list may be anything: it is brought into the range of the first.
            start: Start::Lists(vec![start.to_vec(), base(&problem).to_vec()]),
            tree_seed: TreeSeed::Fixed(1),
            ..FitSettings::default()
        };
        let problem = problem.with_values(start.to_vec()).unwrap();
        let (clock, stop) = (|| std::time::Duration::ZERO, AtomicBool::new(false));
        let best = fit(&problem, &settings, Control::new(&clock, &stop)).unwrap().best.unwrap();
        let profiles = profile(&problem, &settings, &best, &[], 0.02, (&GO).into()).unwrap();
        assert!(profiles.iter().any(|p| p.slot == slot("taper[1]")));
        let tapers = space.select("taper").unwrap().into_iter().map(|slot| best.genome.values[slot.index()]);
        tapers.fold(0.0, f64::max)
    };
    for optimizer in ["evolution", "cma", "de"] {
        assert!(most(&acer, optimizer) <= 1.0, "{optimizer}");
        assert!(most(base(&problem), optimizer) <= base(&problem)[slot("taper[0]").index()], "{optimizer}");
    }
}
