//! How many times as fast as tiny-skia trees are drawn: as searches draw them and at full detail, the fifteen species,
//! in alternation on one thread.
//!
//! `cargo run --release -p pleach-silhouette --example against_tiny_skia [SIZE…]`; tiny-skia fills the same shapes, once
//! a pixel and without anti-aliasing.

#![allow(clippy::print_stdout, reason = "printing is what it is for")]

#[path = "../tests/support/referee.rs"]
mod referee;

use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::Parts;
use std::time::Instant;

const SPECIES: [&str; 15] = [
    "acer",
    "apple",
    "balsam_fir",
    "bamboo",
    "black_oak",
    "black_tupelo",
    "douglas_fir",
    "european_larch",
    "hill_cherry",
    "lombardy_poplar",
    "palm",
    "quaking_aspen",
    "silver_birch",
    "small_pine",
    "weeping_willow",
];
/// Each is drawn so many times, and the shortest counts.
const ROUNDS: usize = 9;

fn main() {
    let sizes: Vec<u32> =
        std::env::args().skip(1).map(|size| size.parse().expect("a number of pixels")).collect();
    for size in if sizes.is_empty() { vec![256, 1024] } else { sizes } {
        println!(
            "{size} pixels: milliseconds in searches, times as fast as tiny-skia; the same at full detail"
        );
        let (mut in_searches, mut in_full) = (Vec::new(), Vec::new());
        for name in SPECIES {
            let tree =
                pleach_generators::preset(name).expect("a known species").grow(1).expect("a species grows");
            let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, size, size);
            let mut drawers = [Rasterizer::for_searches(Detail::Half), Rasterizer::new()];
            let mut picture = Bitmap::default();
            let mut best = [f64::INFINITY; 3];
            for _ in 0..ROUNDS {
                for (best, drawer) in best.iter_mut().zip(&mut drawers) {
                    let draw = || drawer.draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
                    *best = best.min(milliseconds(draw));
                }
                let fill = || drop(referee::filled(&tree, &View::FRONT, &frame, Parts::LEAFY, 1));
                best[2] = best[2].min(milliseconds(fill));
            }
            let [search, full, skia] = best;
            in_searches.push(skia / search);
            in_full.push(skia / full);
            println!("{name:16} {search:8.2} {:6.1} {full:8.2} {:6.1}", skia / search, skia / full);
        }
        for (what, ratios) in [("in searches", &mut in_searches), ("at full detail", &mut in_full)] {
            ratios.sort_by(f64::total_cmp);
            println!("{what}: least {:.1}, median {:.1}", ratios[0], ratios[ratios.len() / 2]);
        }
    }
}

fn milliseconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64() * 1e3
}
