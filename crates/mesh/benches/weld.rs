//! Welding: stylised trees with their roots, and a tree of thin twigs.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_mesh::weld::{WeldSettings, surface};
use pleach_tree::Parts;
use std::hint::black_box;

fn skins(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("weld");
    group.sample_size(20);
    let soft = WeldSettings { fillet: 1.0, parts: Parts::ALL, ..WeldSettings::new(0.12) };
    let cases = [
        ("stylised_dead", soft),
        ("stylised_oak", soft),
        ("stylised_willow", soft),
        ("acer", WeldSettings::new(0.02)),
    ];
    for (name, settings) in cases {
        let species = pleach_generators::preset(name).expect("a built-in species");
        let tree = species.grow_bare(1).expect("it grows");
        group.bench_function(name, |b| {
            b.iter(|| black_box(surface(&tree, &settings)).expect("it can be welded"));
        });
    }
    group.finish();
}

criterion_group!(benches, skins);
criterion_main!(benches);
