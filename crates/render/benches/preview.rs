//! Shaded pictures of a small tree and of the aspen.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_mesh::Palette;
use pleach_render::{Preview, PreviewSettings};
use std::hint::black_box;

fn pictures(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("preview");
    group.sample_size(10);
    for name in ["acer", "quaking_aspen"] {
        let Some(species) = pleach_generators::preset(name) else { continue };
        let Ok(tree) = species.grow(1) else { continue };
        let palette = Palette::new(&species.appearance, None);
        let settings = PreviewSettings { width: 512, height: 512, ..PreviewSettings::default() };
        group.bench_function(name, |b| {
            b.iter(|| black_box(Preview::new(&tree, &palette, 512).picture(&settings)));
        });
    }
    group.finish();
}

criterion_group!(benches, pictures);
criterion_main!(benches);
