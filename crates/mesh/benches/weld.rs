//! Welding: the five settings of Lorite 2021, Table 4.1, and a tree of thin twigs.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_mesh::weld::{WeldSettings, surface};
use pleach_tree::{Parts, Tree};
use std::hint::black_box;

/// Trunks, branches, leaves and randomness; all have sixteen roots.
const SETTINGS: [[f64; 4]; 5] =
    [[1., 1., 0., 0.], [2., 8., 2., 0.], [4., 20., 15., 0.], [4., 48., 48., 0.], [4., 48., 48., 1.]];

/// A tree of about the counts of a setting.
fn stylised([trunks, branches, leaves, randomness]: [f64; 4]) -> Option<Tree> {
    let species = pleach_generators::preset("stylised_oak")?;
    let space = species.generator.space();
    let mut values = space.defaults();
    let numbers = [
        ("trunks", trunks),
        ("root_quantity", 100.0),
        ("branch_quantity", 100.0 * branches / trunks / 12.0),
        ("leaves_quantity", 100.0 * leaves / branches),
        ("dead_branches", 0.0),
        ("trunk_randomness", randomness),
        ("root_randomness", randomness),
        ("branch_randomness", randomness),
        ("leaves_randomness", randomness),
    ];
    for (name, value) in numbers {
        values[space.find(name)?.0] = value;
    }
    let params = space.check(values).ok()?;
    pleach_tree::Species { params, ..species }.grow_bare(1).ok()
}

fn skins(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("weld");
    group.sample_size(20);
    let settings = WeldSettings { fillet: 1.0, parts: Parts::ALL, ..WeldSettings::new(0.12) };
    for (i, setting) in SETTINGS.into_iter().enumerate() {
        let Some(tree) = stylised(setting) else { continue };
        group.bench_function(format!("stylised/{}", i + 1), |b| {
            b.iter(|| black_box(surface(&tree, &settings)));
        });
    }
    if let Some(tree) = pleach_generators::preset("acer").and_then(|acer| acer.grow_bare(1).ok()) {
        group.bench_function("acer/20mm", |b| b.iter(|| black_box(surface(&tree, &WeldSettings::new(0.02)))));
    }
    group.finish();
}

criterion_group!(benches, skins);
criterion_main!(benches);
