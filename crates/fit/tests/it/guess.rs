//! The first guess: names, starts and heights.

use crate::common::goal_of;
use crate::pole::pole;
use pleach_fit::{
    Candidate, FirstGuess, FitError, FitProblem, FitSettings, GoalView, GuessLibrary, GuessSettings,
    TreeSeed, first_guess,
};
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::{Foliage, Parts};
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering;

/// Nobody asks these to stop.
static GO: AtomicBool = AtomicBool::new(false);

const NAMES: [&str; 5] = ["acer", "bamboo", "lombardy_poplar", "palm", "small_pine"];

fn candidates() -> Vec<Candidate> {
    NAMES.iter().map(|name| Candidate { species: pleach_generators::preset(name).unwrap() }).collect()
}

/// All that a guess says, to the last digit.
fn bits(guess: &FirstGuess) -> String {
    format!("{guess:?}")
}

fn guess(problem: &FitProblem, settings: &FitSettings) -> FirstGuess {
    let few = GuessSettings { variants: 3, ..GuessSettings::default() };
    first_guess(problem, settings, &candidates(), &few, &GO, |_, _| ()).unwrap()
}

#[test]
fn trees_of_other_seeds_and_sizes_are_named() {
    for name in ["bamboo", "lombardy_poplar", "small_pine"] {
        let mut problem = goal_of(name, 31, 128);
        // Half as high as the species is: the size of a tree cannot be seen.
        problem.goals[0].frame.meters_per_pixel *= 0.5;
        let found = guess(&problem, &FitSettings::default());
        assert_eq!(found.names[0].0, name, "{:?}", found.names);
        assert!((found.names.iter().map(|(_, share)| share).sum::<f64>() - 1.0).abs() < 1e-9);
        assert!(found.nearest.windows(2).all(|w| w[0].score.cost <= w[1].score.cost));

        // What is returned is of the goal's height as it stands.
        let frame = problem.goals[0].frame;
        let top = f64::from(problem.goals[0].goal.ink_box().unwrap().1);
        let goal_height = (frame.ground_row - top) * frame.meters_per_pixel;
        let species = pleach_generators::preset(name).unwrap();
        let params = species.generator.space().check(found.nearest[0].values.clone()).unwrap();
        let tree = pleach_tree::Species { params, ..species }.grow(1).unwrap();
        let height = pleach_tree::Bounds::new(&tree, Parts::LEAFY).unwrap().max.z;
        assert!((height / goal_height - 1.0).abs() < 0.02, "{name}: {height} m, the goal {goal_height} m");
    }
}

#[test]
fn threads_change_nothing_and_progress_is_told() {
    let problem = goal_of("palm", 3, 64);
    let settings = FitSettings { tree_seed: TreeSeed::Any, ..FitSettings::default() };
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let mut told = Vec::new();
        let few = GuessSettings { variants: 5, ..GuessSettings::default() };
        let found = pool.install(|| {
            first_guess(&problem, &settings, &candidates(), &few, &GO, |done, all| told.push((done, all)))
        });
        (bits(&found.unwrap()), told)
    };
    let one = run(1);
    assert!(one == run(3));
    assert_eq!(one.1, [(32, 40), (40, 40)]);
}

#[test]
fn nothing_to_guess_from_is_an_error() {
    let problem = goal_of("palm", 3, 64);
    let none = first_guess(&problem, &FitSettings::default(), &[], &GuessSettings::default(), &GO, |_, _| ());
    assert!(matches!(none, Err(FitError::NoStart)));
}

#[test]
fn asked_to_stop_there_is_no_guess() {
    let problem = goal_of("palm", 3, 64);
    let stop = AtomicBool::new(false);
    // Raised once the first batch is done.
    let raise = |_, _| stop.store(true, Ordering::Relaxed);
    let stopped = first_guess(
        &problem,
        &FitSettings::default(),
        &candidates(),
        &GuessSettings::default(),
        &stop,
        raise,
    );
    assert!(matches!(stopped, Err(FitError::Interrupted)));
}

/// A picture of `name` without leaves.
fn bare(name: &str, seed: u64, size: u32) -> FitProblem {
    let mut problem = goal_of(name, seed, size);
    let tree = pleach_generators::preset(name).unwrap().grow(seed).unwrap();
    let goal = &mut problem.goals[0];
    goal.frame = Frame::automatic(&tree, &View::FRONT, Parts::BARE, size, size);
    let mut picture = Bitmap::default();
    Rasterizer::for_searches(Detail::Half).draw(&tree, &View::FRONT, &goal.frame, Parts::BARE, &mut picture);
    goal.goal = picture;
    problem
}

/// Goals of several species, sizes and heights after each other: what a library keeps changes nothing.
#[test]
fn a_library_serves_many_goals_and_gives_the_bits_of_a_fresh_one() {
    let mut taller = goal_of("acer", 8, 96);
    taller.goals[0].frame.meters_per_pixel *= 1.7;
    let goals = [goal_of("palm", 3, 96), taller, bare("acer", 9, 96), goal_of("small_pine", 5, 64)];
    let settings = FitSettings::default();
    let how = GuessSettings { variants: 2, seeds: 2, detect_leaves: true, ..GuessSettings::default() };
    let mut library = GuessLibrary::new();
    let mut told = Vec::new();
    for problem in &goals {
        let mut steps = 0;
        let kept =
            library.first_guess(problem, &settings, &candidates(), &how, &GO, |_, _| steps += 1).unwrap();
        told.push(steps);
        let fresh = first_guess(problem, &settings, &candidates(), &how, &GO, |_, _| ()).unwrap();
        assert_eq!(bits(&kept), bits(&fresh));
    }
    // Twenty trees are one step; a goal of another size in pixels has them drawn again.
    assert_eq!(told, [1, 1, 1, 1]);
    // Asked to stop, a library that has its trees stops as well, and works again after.
    let stop = AtomicBool::new(true);
    let stopped = library.first_guess(&goals[0], &settings, &candidates(), &how, &stop, |_, _| ());
    assert!(matches!(stopped, Err(FitError::Interrupted)));
    let again = library.first_guess(&goals[0], &settings, &candidates(), &how, &GO, |_, _| ()).unwrap();
    let fresh = first_guess(&goals[0], &settings, &candidates(), &how, &GO, |_, _| ()).unwrap();
    assert_eq!(bits(&again), bits(&fresh));
}

/// Of more than two dozen candidates the near ones alone are compared closely, other ones for each goal.
#[test]
fn what_is_near_one_goal_is_not_kept_for_the_next() {
    let girth = |number: u32| 0.005 * 1.15_f64.powi(number as i32);
    let name = |number: u32| format!("pole_{number}");
    let many: Vec<Candidate> =
        (0..30).map(|number| Candidate::from(pole(&name(number), 10.0, girth(number)))).collect();
    let goal = |number| {
        let tree = pole("goal", 20.0, girth(number)).grow(1).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 128, 128);
        let mut drawn = Bitmap::default();
        Rasterizer::for_searches(Detail::Half).draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut drawn);
        FitProblem::new(pole("start", 10.0, 0.1), GoalView::new(drawn, View::FRONT, frame))
    };
    let settings = FitSettings::default();
    let how = GuessSettings { variants: 2, ..GuessSettings::default() };
    let mut library = GuessLibrary::new();
    for number in [29, 22, 29] {
        let guess = |library: &mut GuessLibrary| {
            library.first_guess(&goal(number), &settings, &many, &how, &GO, |_, _| ()).unwrap()
        };
        let (kept, fresh) = (guess(&mut library), guess(&mut GuessLibrary::new()));
        assert_eq!(bits(&kept), bits(&fresh), "{number}");
        assert_eq!(kept.names[0].0, name(number));
    }
}

/// Goals from elsewhere than the front are named as well, and few trees are grown for their views.
#[test]
fn front_views_choose_what_is_compared_from_elsewhere() {
    let mut names = NAMES.to_vec();
    names.extend(["lombardy_poplar", "palm", "acer", "bamboo", "small_pine", "apple"]);
    names.sort_unstable();
    names.dedup();
    let many: Vec<Candidate> =
        names.iter().map(|name| Candidate::from(pleach_generators::preset(name).unwrap())).collect();
    let how = GuessSettings::default();
    for (name, azimuths) in
        [("palm", &[0.0, 90.0][..]), ("lombardy_poplar", &[35.0]), ("acer", &[120.0, 30.0])]
    {
        let tree = pleach_generators::preset(name).unwrap().grow(31).unwrap();
        let mut problem = goal_of(name, 31, 96);
        problem.goals.clear();
        for &azimuth in azimuths {
            let view = View::degrees(azimuth, 0.0);
            let frame = Frame::automatic(&tree, &view, Parts::LEAFY, 96, 96);
            let mut drawn = Bitmap::default();
            Rasterizer::for_searches(Detail::Half).draw(&tree, &view, &frame, Parts::LEAFY, &mut drawn);
            problem.goals.push(GoalView::new(drawn, view, frame));
        }
        let mut told = Vec::new();
        let tell = |done, all| told.push((done, all));
        let found = first_guess(&problem, &FitSettings::default(), &many, &how, &GO, tell).unwrap();
        assert_eq!(found.names[0].0, name, "{:?}", found.names);
        assert_eq!(found.names.len(), many.len());
        assert!(found.references.same_species.is_some() && found.references.other_species.is_some());
        assert_eq!(found.nearest[0].name, name);
        // Three species closely, of each what a first guess looks at.
        let closely = 3 * (how.seeds + how.variants) as usize;
        assert_eq!(told.last(), Some(&(closely, closely)));
        let mut library = GuessLibrary::new();
        for _ in 0..2 {
            let kept =
                library.first_guess(&problem, &FitSettings::default(), &many, &how, &GO, |_, _| ()).unwrap();
            assert_eq!(bits(&kept), bits(&found), "{name}");
        }
    }
}

#[test]
fn a_goal_shows_whether_it_has_leaves() {
    let how = GuessSettings { variants: 0, detect_leaves: true, ..GuessSettings::default() };
    let mut library = GuessLibrary::new();
    // Likeness alone sees a bare acer at 96 pixels and leaves on it at 160.
    for (name, size) in NAMES.map(|name| (name, 96)).into_iter().chain([("acer", 160)]) {
        for (problem, expected) in
            [(goal_of(name, 21, size), Foliage::All), (bare(name, 21, size), Foliage::None)]
        {
            // What the caller expects does not matter.
            for foliage in [Foliage::All, Foliage::None] {
                let problem = FitProblem { foliage, ..problem.clone() };
                let found = library
                    .first_guess(&problem, &FitSettings::default(), &candidates(), &how, &GO, |_, _| ())
                    .unwrap();
                assert_eq!(found.foliage, expected, "{name} {size}");
            }
        }
    }
}

#[test]
fn references_say_what_a_likeness_is_worth() {
    let problem = goal_of("lombardy_poplar", 31, 128);
    let settings = FitSettings::default();
    let found = guess(&problem, &settings).references;
    let (one, other) = (found.same_species.unwrap(), found.other_species.unwrap());
    assert_eq!(found.species.as_deref(), Some("lombardy_poplar"));
    assert!(one.likeness > 0.7 && one.likeness > other.likeness + 0.3, "{found:?}");
    assert!(one.iou > other.iou && found.best_ellipse.iou > 0.5, "{found:?}");
    // A shape like an ellipse overlaps best, and is not a tree.
    assert!(found.best_ellipse.likeness < one.likeness - 0.2, "{found:?}");

    // Without a first guess they are about the same, and without candidates there is the ellipse.
    let mut library = GuessLibrary::new();
    let cheap = library.references(&problem, &settings, &candidates(), &GO).unwrap();
    assert!((cheap.same_species.unwrap().likeness - one.likeness).abs() < 0.1, "{cheap:?}");
    assert_eq!((cheap.species, cheap.best_ellipse), (found.species, found.best_ellipse));
    let alone = library.references(&problem, &settings, &[], &GO).unwrap();
    assert_eq!((alone.same_species, alone.best_ellipse), (None, found.best_ellipse));
    let stop = AtomicBool::new(true);
    let stopped = library.references(&problem, &settings, &candidates(), &stop);
    assert!(matches!(stopped, Err(FitError::Interrupted)));
}
