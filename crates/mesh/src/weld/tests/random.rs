//! Skins of thousands of random settings.

use super::sound::{check_apart, check_outwards, check_sound, pieces};
use super::*;
use glam::{DVec3, dvec3};
use pleach_tree::conformance::at_ends_or_between;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use rayon::prelude::*;

/// Calls `check` with a number and what `strategy` draws for it, on all threads, `count` times.
fn for_each<S: Strategy + Sync>(cases: u64, strategy: &S, check: impl Fn(u64, S::Value) + Sync) {
    (0..cases).into_par_iter().for_each(|case| {
        let mut seed = [0; 32];
        seed[..8].copy_from_slice(&case.to_le_bytes());
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
        let drawn = strategy.new_tree(&mut TestRunner::new_with_rng(Config::default(), rng)).unwrap();
        if std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| check(case, drawn.current()))).is_err() {
            panic!("in case {case}");
        }
    });
}

/// Everything that a skin promises; the slow half of it for every twentieth case.
fn check_skin(tree: &Tree, settings: &WeldSettings, case: u64) {
    let block = surface(tree, settings).unwrap();
    check_sound(&block, settings.cell);
    assert_eq!(pieces(&block), 1);
    if case.is_multiple_of(20) {
        check_apart(&block);
        let shape = Shape::new(tree, settings, &vec![true; tree.stems.len()]).unwrap();
        check_outwards(&block, &shape.stems, settings.cell);
    }
}

/// A stylised tree of numbers at the ends of their ranges or between.
fn stylised(drawn: &[(u32, f64)], seed: u64) -> Tree {
    let species = pleach_generators::preset("stylised_oak").unwrap();
    let space = species.generator.space().clone();
    let params = space.check(at_ends_or_between(&space, drawn)).unwrap();
    pleach_tree::Species { params, ..species }.grow_bare(seed).unwrap()
}

/// Welds `tree` with all of its roots with this many `cells` along its longest side.
fn check_stylised(tree: &Tree, fillet: f64, cells: f64, case: u64) {
    let extent = Bounds::new(tree, Parts::ALL).map_or(0.0, |b| (b.max - b.min).max_element());
    let cell = (extent / cells).max(1e-3);
    check_skin(tree, &WeldSettings { fillet, parts: Parts::ALL, ..WeldSettings::new(cell) }, case);
}

/// Stylised trees of any numbers, the ends of their ranges more often than others: the settings for which
/// the modifier that Lorite (2021) used left holes. Every sixth in small cells, the others in large ones.
#[test]
fn skins_of_stylised_trees_are_sound() {
    let slots = pleach_generators::preset("stylised_oak").unwrap().generator.space().slots().count();
    let drawn = prop::collection::vec((0_u32..4, 0.0_f64..=1.0), slots);
    let strategy = (drawn, 0_u64..1000, 0.0_f64..4.0, 0.0_f64..1.0);
    for_each(3000, &strategy, |case, (drawn, seed, fillet, fine)| {
        let cells = if case.is_multiple_of(6) { 12.0 + 28.0 * fine } else { 4.0 + 8.0 * fine };
        // Half of them as they are, half with soft corners.
        let fillet = if case % 4 < 2 { 0.0 } else { fillet };
        check_stylised(&stylised(&drawn, seed), fillet, cells, case);
    });
}

/// A tree that once had turned faces.
#[test]
fn the_skin_of_an_old_failure_is_sound() {
    let mut drawn = [(0, 0.0); 22];
    (drawn[1].0, drawn[3].0, drawn[4].0) = (2, 2, 1);
    drawn[5] = (2, 0.08655289097828131);
    check_stylised(&stylised(&drawn, 387), 0.0, 12.0, 0);
}

/// Up to six stems through a place in any directions, some without a length, some a hundred times as thick
/// at one end as at the other.
#[test]
fn skins_of_crosses_are_sound() {
    let end = || (-1.0_f64..1.0, -1.0_f64..1.0, -1.0_f64..1.0, -3.0_f64..0.0, 0_u32..8);
    let strategy = (prop::collection::vec(end(), 2..8), 0.0_f64..4.0, 0.04_f64..0.2);
    for_each(1500, &strategy, |case, (ends, fillet, cell)| {
        let mut tree = Tree::default();
        for (i, &(x, y, z, thickness, kind)) in ends.iter().enumerate() {
            let parent = (i > 0).then_some(0);
            let to = if kind == 0 { DVec3::ZERO } else { dvec3(x, y, z) };
            tree.stems.push(pleach_plant::Stem {
                parent,
                level: u16::from(i > 0),
                kind: if i == 0 { StemKind::Trunk } else { StemKind::Branch },
                number: i as u32,
                offset: 0.0,
                first_knot: 2 * i as u32,
                knot_count: 2,
            });
            for (point, radius) in [(DVec3::ZERO, 0.01), (to, 0.5 * 10_f64.powf(thickness))] {
                let third = (to - point) / 3.0;
                let knot =
                    pleach_plant::Knot { point, handle_in: point - third, handle_out: point + third, radius };
                tree.knots.push(knot);
            }
        }
        check_skin(&tree, &WeldSettings { fillet, ..WeldSettings::new(cell) }, case);
    });
}
