//! A goal's own tree, stem by stem.

use crate::common::goal_of;
use pleach_fit::{FitError, FitProblem, FoundIndividual, Genome, GoalView, IndividualSettings, individuals};
use pleach_silhouette::score::blurred_iou;
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::{Foliage, Parts};
use std::cell::Cell;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

static GO: AtomicBool = AtomicBool::new(false);

/// The problem of a tree that the species grows from another seed, and the genome of the species itself.
fn start(species: &str) -> (FitProblem, Genome) {
    let problem = goal_of(species, 5, 96);
    let genome = Genome::new(problem.start.params.values().to_vec(), 1);
    (problem, genome)
}

fn found(problem: &FitProblem, genome: &Genome, settings: IndividualSettings) -> FoundIndividual {
    individuals(problem, genome, settings, &|| Duration::ZERO, &GO, |_| ()).unwrap().remove(0)
}

/// Everything that is the same on every machine.
fn bits(found: &FoundIndividual) -> String {
    let FoundIndividual { species, score, trees, trials, .. } = found;
    format!("{} {score:?} {trees} {trials}", species.to_toml(&[]))
}

#[test]
fn trees_of_the_kind_come_to_lie_on_the_goal_and_look_more_like_it() {
    for species in ["hill_cherry", "palm", "acer", "coffey_winter_oak", "stylised_oak"] {
        let (problem, genome) = start(species);
        let found = found(&problem, &genome, IndividualSettings::trees(120));
        let (before, after) = (found.before, found.score);
        assert!(after.cost < 0.8 * before.cost, "{species}: {before:?} {after:?}");
        assert!(after.iou > before.iou + 0.05, "{species}: {before:?} {after:?}");
        assert!(after.likeness > before.likeness, "{species}: {before:?} {after:?}");
        assert!(found.trees == 120 && found.trials > 120 && !found.individual().is_empty());
        // The tree in the file is the tree that was scored: drawn as a whole, not stem by stem.
        let one = &found.species;
        assert_eq!(one.tree_seed, Some(1));
        let read = pleach_generators::read_text("one.toml", &one.to_toml(&[])).unwrap();
        let tree = read.grow(1).unwrap();
        let mut drawn = Bitmap::default();
        let GoalView { goal, view, frame, .. } = &problem.goals[0];
        Rasterizer::for_searches(Detail::Half).draw(&tree, view, frame, Parts::LEAFY, &mut drawn);
        let shared = drawn.intersection(goal);
        let iou = shared as f64 / (drawn.ink() + goal.ink() - shared) as f64;
        assert!((iou - after.iou).abs() < 1e-9, "{species}: {iou} {after:?}");
        // Other seeds are of the kind.
        assert!(read.grow(2).unwrap() == problem.start.grow(2).unwrap());
    }
}

#[test]
fn threads_change_nothing() {
    let (problem, genome) = start("acer");
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| bits(&found(&problem, &genome, IndividualSettings::trees(64))))
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(5));
}

#[test]
fn what_costs_less_in_all_views_is_kept() {
    let (mut problem, genome) = start("hill_cherry");
    let tree = problem.start.grow(5).unwrap();
    let side = View::degrees(90.0, 0.0);
    let frame = Frame::automatic(&tree, &side, Parts::LEAFY, 96, 96);
    let mut goal = Bitmap::default();
    Rasterizer::with_detail(Detail::Half).draw(&tree, &side, &frame, Parts::LEAFY, &mut goal);
    problem.goals.push(GoalView::new(goal, side, frame));
    let found = found(&problem, &genome, IndividualSettings::trees(80));
    assert!(found.score.cost < 0.9 * found.before.cost, "{:?} {:?}", found.before, found.score);
}

#[test]
fn bare_trees_have_individuals_too() {
    let (mut problem, genome) = start("acer");
    let tree = problem.start.grow_bare(5).unwrap();
    let frame = problem.goals[0].frame;
    let mut goal = Bitmap::default();
    Rasterizer::with_detail(Detail::Half).draw(&tree, &View::FRONT, &frame, Parts::BARE, &mut goal);
    problem.goals = vec![GoalView::new(goal, View::FRONT, frame)];
    problem.foliage = Foliage::None;
    let found = found(&problem, &genome, IndividualSettings::trees(80));
    assert!(found.score.iou > found.before.iou, "{:?} {:?}", found.before, found.score);
}

#[test]
fn there_are_no_more_draws_than_are_asked_for() {
    let (problem, genome) = start("hill_cherry");
    let few = IndividualSettings { max_stems: 7, ..IndividualSettings::trees(80) };
    let found = found(&problem, &genome, few);
    assert!((1..=7).contains(&found.individual().len()), "{}", found.individual().len());
}

#[test]
fn stems_without_addresses_have_no_draws() {
    let (problem, genome) = start("broom_shrub");
    let none = individuals(&problem, &genome, IndividualSettings::trees(8), &|| Duration::ZERO, &GO, |_| ());
    assert!(none.unwrap().is_empty());
}

/// One picture leaves the depth of a tree open.
#[test]
fn several_trees_on_one_goal_differ_from_the_trunk_up() {
    let (problem, genome) = start("acer");
    let three = IndividualSettings { count: 3, ..IndividualSettings::trees(180) };
    let mut told = Vec::new();
    let all = individuals(&problem, &genome, three, &|| Duration::ZERO, &GO, |p| told.push(*p)).unwrap();
    assert_eq!(all.len(), 3);
    assert!(told.windows(2).all(|w| w[0].used <= w[1].used + 1e-12 && w[0].number <= w[1].number));
    assert!(all.windows(2).all(|w| w[0].score.cost <= w[1].score.cost), "the best first");
    let goal = &problem.goals[0];
    let side = |found: &FoundIndividual| {
        let (tree, mut drawn) = (found.species.grow(1).unwrap(), Bitmap::default());
        Rasterizer::new().draw(&tree, &View::degrees(90.0, 0.0), &goal.frame, Parts::LEAFY, &mut drawn);
        drawn
    };
    for (i, one) in all.iter().enumerate() {
        assert!(one.score.iou > one.before.iou, "{:?} {:?}", one.before, one.score);
        assert!(one.trees >= 60 && one.individual().len() <= IndividualSettings::MAX_STEMS);
        let sides = all[..i].iter().map(|other| blurred_iou(&side(one), &side(other), 1.5));
        assert!(sides.into_iter().all(|shared| shared < 0.9), "they are one tree");
    }
    // The first is the one that is found alone.
    let alone = found(&problem, &genome, IndividualSettings::trees(60));
    assert!(all.iter().any(|one| bits(one) == bits(&alone)));
}

/// By the clock, by the flag, and told of on the way.
#[test]
fn it_ends_when_it_should() {
    let (problem, genome) = start("acer");
    let calls = Cell::new(0);
    let clock = || {
        calls.set(calls.get() + 1);
        Duration::from_millis(100 * calls.get())
    };
    let mut told = Vec::new();
    let two = IndividualSettings::time(Duration::from_secs(2));
    let found = individuals(&problem, &genome, two, &clock, &GO, |progress| told.push(*progress));
    let found = found.unwrap().remove(0);
    assert!((16..400).contains(&found.trees), "{} trees", found.trees);
    assert!(told.windows(2).all(|w| w[0].trees < w[1].trees && w[0].used <= w[1].used));
    assert_eq!((told[0].trees, told.last().unwrap().used), (0, 1.0));

    let stop = AtomicBool::new(true);
    let stopped = individuals(&problem, &genome, two, &clock, &stop, |_| ());
    assert!(matches!(stopped, Err(FitError::Interrupted)));
}
