//! The fast path against the referee, for the fifteen species, with leaves and without, and for curves with corners.
//!
//! At 256² the referee has 16 × 16 samples per pixel, at 512² 11 × 11.

#[path = "../support/referee.rs"]
mod support;

use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Parts, Tree};

/// One comparison, as facts.
struct Case {
    name: String,
    iou: f64,
    least_iou: f64,
    /// Ratio of one-bit ink to the referee's.
    ink: f64,
    /// Ratio of covered area to the referee's.
    coverage: f64,
}

fn compare(name: &str, tree: &Tree, parts: Parts, size: u32, fineness: u32) -> Case {
    let frame = Frame::automatic(tree, &View::FRONT, Parts::LEAFY, size, size);
    let mut rasterizer = Rasterizer::new();
    let (mut ours, mut samples) = (Bitmap::default(), Vec::new());
    rasterizer.draw(tree, &View::FRONT, &frame, parts, &mut ours);
    rasterizer.coverage(&mut samples);
    let covered = samples.iter().map(|&s| f64::from(s)).sum::<f64>() / f64::from(rasterizer.samples());
    let verdict = support::draw(tree, &View::FRONT, &frame, parts, fineness).unwrap();
    let both = ours.intersection(&verdict.bitmap) as f64;
    let union = (ours.ink() + verdict.bitmap.ink()) as f64 - both;
    let leafy = parts == Parts::LEAFY;
    Case {
        name: format!("{name} {} at {size}", if leafy { "leafy" } else { "bare" }),
        iou: both / union,
        least_iou: if leafy { 0.95 } else { 0.90 },
        ink: ours.ink() as f64 / verdict.bitmap.ink() as f64,
        coverage: covered / verdict.coverage,
    }
}

fn judge(sizes: (u32, u32), names: &[&str]) {
    let mut wrong = Vec::new();
    for name in names {
        let tree = pleach_generators::species(name).unwrap().grow(1).unwrap();
        for parts in [Parts::LEAFY, Parts::BARE] {
            let case = compare(name, &tree, parts, sizes.0, sizes.1);
            let Case { name, iou, least_iou, ink, coverage } = case;
            let line = format!("{name}: IoU {iou:.4}, ink {ink:.4}, coverage {coverage:.4}");
            if iou < least_iou || (ink - 1.0).abs() > 0.03 || (coverage - 1.0).abs() > 0.03 {
                wrong.push(line);
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

fn fifteen() -> Vec<&'static str> {
    pleach_generators::HEWITT_2017.to_vec()
}

// Four tests, so that two cores share them.
#[test]
fn first_half_at_256() {
    judge((256, 16), &fifteen()[..8]);
}

#[test]
fn second_half_at_256() {
    judge((256, 16), &fifteen()[8..]);
}

#[test]
fn first_half_at_512() {
    judge((512, 11), &fifteen()[..8]);
}

#[test]
fn second_half_at_512() {
    judge((512, 11), &fifteen()[8..]);
}

/// Stems that turn by up to 180 degrees at their knots. Some are thinner than a pixel, so that which pixels are
/// black is left to chance; the covered area is not.
#[test]
fn curves_with_corners_cover_what_they_should() {
    let mut wrong = Vec::new();
    for name in [
        "abop_hilbert",
        "abop_hilbert_space",
        "abop_sierpinski",
        "abop_gosper",
        "abop_dragon",
        "abop_koch_island",
        "abop_row_of_trees",
        "abop_plant_c",
        "abop_ternary_c",
    ] {
        let tree = pleach_generators::species(name).unwrap().grow(1).unwrap();
        for (size, fineness) in [(256, 16), (512, 11)] {
            let case = compare(name, &tree, Parts::BARE, size, fineness);
            if (case.coverage - 1.0).abs() > 0.03 {
                wrong.push(format!("{}: coverage {:.4}", case.name, case.coverage));
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}
