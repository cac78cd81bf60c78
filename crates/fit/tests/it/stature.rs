//! Weber and Penn's trees that stand otherwise: how they read, and how a first guess finds them.

use pleach_fit::{Candidate, Contradictions, FitProblem, FitSettings, GoalView, GuessLibrary, GuessSettings};
use pleach_reading::{Reader, Reading};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Foliage, Parts, Species, Stature, Tree};
use std::sync::atomic::AtomicBool;

/// A species with other numbers.
fn with_values(species: &Species, values: Vec<f64>) -> Species {
    Species { params: species.generator.space().check(values).unwrap(), ..species.clone() }
}

/// A known species with some numbers set.
fn standing(name: &str, set: &[(&str, f64)]) -> Species {
    let species = pleach_generators::preset(name).unwrap();
    let mut values = species.params.values().to_vec();
    for (pattern, value) in set {
        for slot in species.generator.space().select(pattern).unwrap() {
            values[slot.index()] = *value;
        }
    }
    with_values(&species, values)
}

fn picture(tree: &Tree, parts: Parts) -> (Bitmap, Frame) {
    let frame = Frame::automatic(tree, &View::FRONT, parts, 256, 256);
    let mut picture = Bitmap::default();
    Rasterizer::new().draw(tree, &View::FRONT, &frame, parts, &mut picture);
    (picture, frame)
}

#[test]
fn a_leaning_trunk_reads_as_it_leans() {
    for name in ["quaking_aspen", "black_tupelo", "silver_birch", "douglas_fir", "lombardy_poplar"] {
        let slope = |lean: f64| {
            let tree = standing(name, &[("lean", lean)]).grow(3).unwrap();
            let frame = Frame::automatic(&tree, &View::FRONT, Parts::STEMS, 512, 512);
            let read = Reading::from_skeleton(&tree, &View::FRONT, &frame, Parts::STEMS);
            read.lean_deg.unwrap().to_radians().tan()
        };
        // Trunks of these species bend by chance: a lean adds to the slope of an upright tree.
        for lean in [-20.0, 8.0, 15.0] {
            let added = (slope(lean) - slope(0.0)).atan().to_degrees();
            assert!((added - lean).abs() < 1.0, "{name}: {added}° instead of {lean}°");
        }
    }
}

/// What is read of a picture, as a generator takes it.
fn read(picture: &Bitmap) -> Stature {
    let mut reading = Reading::default();
    Reader::new().read(picture, &mut reading);
    Stature {
        lean: reading.lean_deg,
        bare_height: reading.bare_height,
        crown: Some([reading.crown.left.clone(), reading.crown.right.clone()]),
        ..Stature::default()
    }
}

/// The area that is in one of two outlines alone, over that of the first.
fn apart(one: &Stature, other: &Stature) -> f64 {
    let sides = |stature: &Stature| stature.crown.clone().unwrap().concat();
    let (one, other) = (sides(one), sides(other));
    let area: f64 = one.iter().map(|side| side.max(0.0)).sum();
    one.iter().zip(&other).map(|(a, b)| (a - b).abs()).sum::<f64>() / area
}

#[test]
fn adapted_trees_lean_and_reach_as_the_goal_does() {
    let stands =
        [("lean", 14.0), ("side", 0.5), ("outline[0]", 1.6), ("outline[1]", 1.4), ("outline[3]", 0.6)];
    for name in ["black_tupelo", "silver_birch", "quaking_aspen"] {
        let goal = read(&picture(&standing(name, &stands).grow(5).unwrap(), Parts::LEAFY).0);
        let mut species = pleach_generators::preset(name).unwrap();
        let mut before = f64::NAN;
        for step in 0..2 {
            let grown = read(&picture(&species.grow(2).unwrap(), Parts::LEAFY).0);
            if step == 0 {
                before = apart(&goal, &grown);
            }
            let mut values = species.params.values().to_vec();
            species.generator.adapt(&mut values, &goal, &grown);
            species.generator.space().repair(&mut values);
            species = with_values(&species, values);
        }
        let grown = read(&picture(&species.grow(2).unwrap(), Parts::LEAFY).0);
        let (lean, wanted) = (grown.lean.unwrap(), goal.lean.unwrap());
        assert!((lean - wanted).abs() <= 3.0, "{name}: {lean}° instead of {wanted}°");
        let after = apart(&goal, &grown);
        // A tree of the goal's very numbers and another seed is no nearer, or hardly.
        let own = read(&picture(&standing(name, &stands).grow(2).unwrap(), Parts::LEAFY).0);
        let own = apart(&goal, &own);
        assert!(after < 1.15 * own, "{name}: outlines {after} apart, and {own} from another seed");
        assert!(after < 0.8 * before, "{name}: outlines {after} apart instead of {before}");
    }
}

#[test]
fn a_first_guess_leans_as_the_goal_does() {
    let tree = standing("black_tupelo", &[("lean", 14.0)]).grow(3).unwrap();
    let (goal, frame) = picture(&tree, Parts::LEAFY);
    let tupelo = pleach_generators::preset("black_tupelo").unwrap();
    let slot = tupelo.generator.space().select("lean").unwrap()[0].index();
    let problem = FitProblem {
        foliage: Foliage::All,
        ..FitProblem::new(tupelo.clone(), GoalView::new(goal, View::FRONT, frame))
    };
    let guess = |contradictions| {
        let guess =
            GuessSettings { variants: 0, keep: 20, contradictions, race: None, ..GuessSettings::default() };
        let (candidates, stop) = ([Candidate::from(tupelo.clone())], AtomicBool::new(false));
        let settings = FitSettings::default();
        GuessLibrary::new().first_guess(&problem, &settings, &candidates, &guess, &stop, |_, _| ()).unwrap()
    };
    let upright = guess(Contradictions::Ignored);
    assert!(upright.nearest.iter().all(|one| one.values[slot] == 0.0));
    let leaning = guess(Contradictions::Counted);
    let first = &leaning.nearest[0];
    assert!((first.values[slot] - 14.0).abs() <= 3.0, "{}°", first.values[slot]);
    assert!(first.score.cost < upright.nearest[0].score.cost);
}
