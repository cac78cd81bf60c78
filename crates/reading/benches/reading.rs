//! Readings of the picture of a candidate, 256 × 256, and of a picture of a megapixel.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_reading::{Reader, Reading};
use pleach_silhouette::{View, silhouette};
use std::hint::black_box;

fn readings(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("reading");
    group.sample_size(20);
    for name in ["acer", "silver_birch", "douglas_fir"] {
        let Some(species) = pleach_generators::preset(name) else { continue };
        let Ok(tree) = species.grow(1) else { continue };
        for size in [256, 1000] {
            let picture = silhouette(&tree, View::FRONT, size);
            let (mut reader, mut reading) = (Reader::new(), Reading::default());
            group.bench_function(format!("{name}_{size}"), |b| {
                b.iter(|| reader.read(black_box(&picture), &mut reading));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, readings);
criterion_main!(benches);
