//! Counts and sizes of the papers' trees: exact where they are exact, else the means of 100 seeds.

use pleach_lsystem::{Derivation, LSystem, LSystemFamily};
use pleach_tree::Bounds;
use pleach_tree::{Foliage, Limits, Parts, Tree};

/// The grammar of a species that comes with pleach.
pub(crate) fn system(name: &str) -> LSystem {
    let species = pleach_tree::species::preset(&LSystemFamily, name).unwrap_or_else(|| panic!("{name}"));
    let structure = species.generator.structure();
    let doc = pleach_tree::SpeciesDoc::parse(name, &structure).unwrap();
    LSystem::read(name, doc.text("grammar").unwrap().unwrap()).unwrap_or_else(|e| panic!("{e}"))
}

/// What one tree counts: symbols, F, stems, knots, leaves, height, width along x.
fn measure(system: &LSystem, seed: u64, steps: Option<usize>) -> [f64; 7] {
    let derived = system.derive(&Derivation { seed, steps, ..Derivation::default() }).unwrap();
    let mut tree = Tree::default();
    derived.grow(&Limits::DEFAULT, Foliage::All, &mut tree).unwrap();
    assert_eq!(tree.well_formed(), Ok(()));
    let bounds = Bounds::new(&tree, Parts::BARE).unwrap();
    let drawn = derived.count("F") + derived.count("G");
    let counts = [derived.len(), drawn, tree.stems.len(), tree.knots.len(), tree.leaves.len()];
    let [symbols, pieces, stems, knots, leaves] = counts.map(|n| n as f64);
    [symbols, pieces, stems, knots, leaves, bounds.max.z, bounds.max.x - bounds.min.x]
}

fn sample(system: &LSystem) -> Vec<[f64; 7]> {
    (0..100).map(|seed| measure(system, seed, None)).collect()
}

/// Means and deviations that another program measured over 100 other seeds; a deviation of 0 is exact to
/// the digits printed.
fn agree(name: &str, sample: &[[f64; 7]], table: [(f64, f64); 7]) {
    let columns = ["symbols", "F", "stems", "knots", "leaves", "height", "width"];
    for (i, (expected, deviation)) in table.into_iter().enumerate() {
        let mean = sample.iter().map(|m| m[i]).sum::<f64>() / sample.len() as f64;
        // Four standard errors of a difference of two means of 100.
        let slack = 4.0 * deviation * f64::sqrt(0.02) + 0.006;
        assert!(
            (mean - expected).abs() < slack,
            "{name}: {} is {mean}, expected {expected} ± {slack}",
            columns[i]
        );
    }
}

#[test]
fn the_palm() {
    let system = system("hewitt_palm");
    let sample = sample(&system);
    for [symbols, pieces, stems, knots, leaves, ..] in &sample {
        let (fronds, frond_pieces) = (stems - 1.0, pieces - 89.0);
        assert!((30.0..=36.0).contains(&fronds), "{fronds} fronds");
        assert_eq!(*leaves, 2.0 * frond_pieces);
        assert_eq!(*knots, 90.0 + fronds + frond_pieces);
        assert_eq!(*symbols, 274.0 + 6.0 * fronds + 5.0 * frond_pieces);
    }
    assert_eq!(measure(&system, 3, Some(90)), measure(&system, 3, Some(100)), "nothing changes at the end");
    let table =
        [(5722., 185.), (1139., 36.), (33.8, 1.1), (1173., 37.), (2101., 71.), (14.93, 0.3), (5.93, 0.22)];
    agree("palm", &sample, table);
}

#[test]
fn the_aspen() {
    let sample = sample(&system("hewitt_quaking_aspen"));
    for [symbols, pieces, stems, knots, ..] in &sample {
        let twigs = stems - 97.0;
        assert_eq!(*pieces, 320.0 + 3.0 * twigs);
        assert_eq!(*symbols, 1041.0 + 16.0 * twigs);
        assert_eq!(*knots, 417.0 + 4.0 * twigs);
    }
    let table = [
        (24265., 146.),
        (4675., 27.),
        (1549., 9.),
        (6223., 37.),
        (21664., 458.),
        (14.08, 0.74),
        (6.96, 0.24),
    ];
    agree("aspen", &sample, table);
}

#[test]
fn trees_that_are_not_printed() {
    let table =
        [(10170., 50.), (2042., 10.), (697., 3.), (2738., 13.), (32530., 166.), (22.97, 0.08), (6.0, 0.09)];
    agree("poplar", &sample(&system("hewitt_lombardy_poplar")), table);
    let table = [
        (17512., 922.),
        (3522., 185.),
        (2317., 123.),
        (5839., 307.),
        (55423., 2818.),
        (6.2, 0.02),
        (3.99, 0.22),
    ];
    agree("pine", &sample(&system("grammar_pine")), table);
    let table = [
        (4454., 2070.),
        (1045., 483.),
        (452., 211.),
        (1497., 694.),
        (4005., 1296.),
        (9.17, 0.24),
        (9.19, 0.77),
    ];
    agree("acer", &sample(&system("grammar_acer")), table);
}

#[test]
fn steens_tree() {
    let system = system("steen_tree");
    let means = [(1, 2.0), (2, 8.3), (3, 32.145), (4, 123.857), (5, 477.04)];
    let deviations = [0.01, 2.0, 7.0, 25.0, 74.0];
    for ((steps, mean), deviation) in means.into_iter().zip(deviations) {
        let n = 400;
        let sum: f64 = (0..n).map(|seed| measure(&system, seed, Some(steps))[1]).sum();
        let error = 4.5 * deviation / f64::sqrt(n as f64);
        assert!((sum / n as f64 - mean).abs() < error, "{} after {steps}, expected {mean}", sum / n as f64);
    }
    let height = (0..100).map(|seed| measure(&system, seed, None)[5]).sum::<f64>() / 100.0;
    assert!((height - 5.87).abs() < 0.3, "{height}");
}
