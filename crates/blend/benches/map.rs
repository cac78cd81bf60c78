//! From a point of the map to parameters, and from parameters to a point.

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_blend::{BlendMap, Settings};
use pleach_tree::Species;
use std::hint::black_box;

fn points(criterion: &mut Criterion) {
    let species: Vec<Species> =
        pleach_generators::HEWITT_2017.iter().filter_map(|name| pleach_generators::preset(name)).collect();
    let one = species[7].clone();
    let map = BlendMap::new(species, Settings::default()).expect("the known species have a map");
    let middle = map.between(0, 1, 0.37).expect("two dots");
    let mut group = criterion.benchmark_group("map");
    group.bench_function("point to parameters", |b| b.iter(|| map.at(black_box(middle))));
    group.bench_function("parameters to point", |b| b.iter(|| map.locate(black_box(&one))));
    group.finish();
}

criterion_group!(benches, points);
criterion_main!(benches);
