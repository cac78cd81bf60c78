//! The rasteriser against tiny-skia on the same shapes, and the scores of a search.

#[path = "../tests/support/referee.rs"]
mod referee;

use criterion::{Criterion, criterion_group, criterion_main};
use pleach_silhouette::score::ScoreCard;
use pleach_silhouette::score::fast::{PreparedGoal, Scratch};
use pleach_silhouette::score::likeness::{self, Descriptor};
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::Parts;
use std::hint::black_box;

fn raster(c: &mut Criterion) {
    let species = pleach_generators::species("quaking_aspen").expect("a built-in species");
    let tree = species.grow(1).expect("it grows");
    for size in [256, 512] {
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, size, size);
        let mut out = Bitmap::default();
        for (name, detail) in [("full", Detail::Full), ("half", Detail::Half), ("draft", Detail::Draft)] {
            let mut rasterizer = Rasterizer::with_detail(detail);
            c.bench_function(&format!("aspen/{size}/{name}"), |b| {
                b.iter(|| rasterizer.draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut out));
            });
        }
        // The same polygons, once a pixel and without anti-aliasing, as tiny-skia fills them.
        c.bench_function(&format!("aspen/{size}/tiny-skia without anti-aliasing"), |b| {
            b.iter(|| referee::filled(&tree, &View::FRONT, &frame, Parts::LEAFY, 1));
        });
    }
}

/// Crowns whose blossoms are most of the work, as a search draws them.
fn blossoms(c: &mut Criterion) {
    for name in ["apple", "hill_cherry"] {
        let tree = pleach_generators::species(name).expect("a built-in species").grow(1).expect("it grows");
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
        let (mut rasterizer, mut out) = (Rasterizer::for_searches(Detail::Half), Bitmap::default());
        for (what, parts) in [("leafy", Parts::LEAFY), ("bare", Parts::BARE)] {
            c.bench_function(&format!("{name}/256/{what}"), |b| {
                b.iter(|| rasterizer.draw(&tree, &View::FRONT, &frame, parts, &mut out));
            });
        }
    }
}

fn score(c: &mut Criterion) {
    let draw = |name: &str| {
        let tree = pleach_generators::species(name).expect("built in").grow(1).expect("it grows");
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
        let mut out = Bitmap::default();
        Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut out);
        out
    };
    let (goal, picture) = (draw("quaking_aspen"), draw("black_oak"));
    let (prepared, mut scratch) = (PreparedGoal::new(&goal), Scratch::default());
    c.bench_function("score/search", |b| b.iter(|| prepared.overlaps(black_box(&picture), &mut scratch)));
    // What a search does for each tree; a willow is the most work, its curtain has the most runs.
    for name in ["black_oak", "weeping_willow"] {
        let (picture, mut scratch) = (draw(name), likeness::Scratch::default());
        let prepared = Descriptor::new(&goal, &mut scratch);
        c.bench_function(&format!("score/likeness/{name}"), |b| {
            b.iter(|| prepared.compare(&Descriptor::new(black_box(&picture), &mut scratch)));
        });
    }
    c.bench_function("score/card", |b| b.iter(|| ScoreCard::new(black_box(&picture), &goal)));
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(std::time::Duration::from_secs(2)).warm_up_time(std::time::Duration::from_millis(300));
    targets = raster, blossoms, score
}
criterion_main!(benches);
