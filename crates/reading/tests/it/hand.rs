//! Every measure on pictures drawn by hand, whose numbers are known.

use pleach_reading::{Reading, annotate};
use pleach_silhouette::Bitmap;

/// Side of the pictures; the tree fills their height.
const SIDE: u32 = 240;

/// A picture by heights: `ink(x, y)` with x to the right of the middle and y up, both in heights.
fn draw(ink: impl Fn(f64, f64) -> bool) -> Bitmap {
    let side = f64::from(SIDE);
    Bitmap::from_fn(SIDE, SIDE, |x, y| {
        ink((f64::from(x) + 0.5) / side - 0.5, 1.0 - (f64::from(y) + 0.5) / side)
    })
}

/// Whether (x, y) is on a bar of this width from (x0, y0) to (x1, y1).
fn bar(x: f64, y: f64, (x0, y0): (f64, f64), (x1, y1): (f64, f64), width: f64) -> bool {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = (dx * dx + dy * dy).sqrt();
    let along = ((x - x0) * dx + (y - y0) * dy) / length;
    let across = ((x - x0) * dy - (y - y0) * dx) / length;
    (0.0..=length).contains(&along) && across.abs() <= width / 2.0
}

fn ball(x: f64, y: f64, (x0, y0): (f64, f64), radius: f64) -> bool {
    (x - x0) * (x - x0) + (y - y0) * (y - y0) <= radius * radius
}

fn is_near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value}, not {expected}");
}

fn lollipop() -> Bitmap {
    draw(|x, y| ball(x, y, (0.0, 0.75), 0.25) || x.abs() <= 0.03 && y < 0.75)
}

#[test]
fn a_leaning_trapezoid_is_one_leaning_trunk() {
    // Leans by 11° to the left and tapers from 0.08 to 0.02.
    let lean = -11_f64;
    let slope = lean.to_radians().tan();
    let reading = Reading::from_silhouette(&draw(|x, y| (x - slope * y).abs() <= 0.04 - 0.03 * y));
    assert_eq!(reading.feet.len(), 1);
    is_near(reading.feet[0].x, 0.0, 1e-9);
    // At 6.5 % of the height, at right angles to the axis.
    is_near(reading.feet[0].width, (0.08 - 0.06 * 0.065) * lean.to_radians().cos(), 0.003);
    is_near(reading.lean_deg.unwrap(), lean, 0.5);
    is_near(reading.bare_height.unwrap(), 1.0, 0.02);
    assert_eq!(reading.first_fork, None);
    let [x, y, width] = *reading.trunk.last().unwrap();
    assert!(y > 0.9);
    is_near(x, slope * y, 0.01);
    is_near(width, 0.08 - 0.06 * y, 0.01);
    assert!(reading.table()[1].1.contains("11° to the left"), "{reading}");
}

#[test]
fn two_trunks_are_two_feet_and_a_flare_is_none() {
    let two = draw(|x, y| (x.abs() - 0.15).abs() <= 0.02 && y < 0.6 || ball(x, y, (0.0, 0.7), 0.3));
    let reading = Reading::from_silhouette(&two);
    assert_eq!(reading.feet.len(), 2);
    is_near(reading.feet[0].x, -0.15, 0.005);
    is_near(reading.feet[1].x, 0.15, 0.005);
    is_near(reading.feet[1].width, 0.04, 0.005);
    // A flare of roots: wide at the ground.
    let flare = draw(|x, y| x.abs() <= 0.03 + 0.1 * (1.0 - y / 0.04).max(0.0) || ball(x, y, (0.0, 0.7), 0.3));
    let reading = Reading::from_silhouette(&flare);
    assert_eq!(reading.feet.len(), 1);
    is_near(reading.feet[0].width, 0.06, 0.008);
}

#[test]
fn a_y_forks_where_its_arms_meet() {
    let reading = Reading::from_silhouette(&draw(|x, y| {
        x.abs() <= 0.03 && y <= 0.4
            || bar(x, y, (0.0, 0.4), (-0.3, 1.0), 0.045)
            || bar(x, y, (0.0, 0.4), (0.3, 1.0), 0.045)
    }));
    is_near(reading.first_fork.unwrap(), 0.4, 0.03);
    is_near(reading.fork_x.unwrap(), 0.0, 0.01);
    is_near(reading.fork_arms_deg[0], -26.6, 3.0);
    is_near(reading.fork_arms_deg[1], 26.6, 3.0);
    is_near(reading.bare_height.unwrap(), 0.4, 0.05);
    assert!(reading.first_fork_confidence > 0.5, "{reading}");
    // A thin side branch is the end of the bare trunk, and not a fork.
    let reading =
        Reading::from_silhouette(&draw(|x, y| x.abs() <= 0.03 || bar(x, y, (0.0, 0.3), (0.4, 0.6), 0.015)));
    assert_eq!(reading.first_fork, None);
    is_near(reading.bare_height.unwrap(), 0.32, 0.03);
}

#[test]
fn a_lollipop_has_a_round_crown_without_gaps() {
    let reading = Reading::from_silhouette(&lollipop());
    is_near(reading.bare_height.unwrap(), 0.5, 0.02);
    is_near(reading.crown_widest.unwrap(), 0.75, 0.03);
    is_near(reading.crown_width.unwrap(), 0.5, 0.02);
    is_near(reading.asymmetry.unwrap(), 0.0, 0.01);
    is_near(reading.gap_share.unwrap(), 0.0, 0.02);
    assert_eq!((reading.clumps, reading.leaves), (1, true), "{reading}");
    assert_eq!((reading.crown.left.len(), reading.crown.right.len()), (33, 33));
    is_near(reading.crown.left[24], 0.25, 0.01);
    is_near(reading.crown.right[4], 0.03, 0.01);
    // A crown to the right of its trunk.
    let flag = draw(|x, y| x.abs() <= 0.03 || (-0.1..0.3).contains(&x) && (0.5..0.8).contains(&y));
    is_near(Reading::from_silhouette(&flag).asymmetry.unwrap(), 0.45, 0.05);
}

#[test]
fn gaps_are_measured_where_they_are() {
    // Slots of 2.5 % of the height through a crown of bars as wide.
    let comb = draw(|x, y| {
        x.abs() <= 0.02 && y < 0.5
            || x.abs() < 0.3
                && y >= 0.5
                && (!(0.53..=0.97).contains(&y) || (40.0 * (x + 0.4)) as i64 % 2 == 0)
    });
    let reading = Reading::from_silhouette(&comb);
    is_near(reading.gap_share.unwrap(), 0.42, 0.06);
    assert_eq!(reading.gap_by_height.len(), 16);
    is_near(reading.gap_by_height[0], 0.0, 0.0);
    is_near(reading.gap_by_height[12], 0.5, 0.06);
    assert!(reading.gap_sizes[2] > 0.9 * reading.gap_share.unwrap(), "{:?}", reading.gap_sizes);
    is_near(reading.gap_sizes.iter().sum(), reading.gap_share.unwrap(), 1e-9);
}

#[test]
fn foliage_that_hangs_to_the_ground_is_not_a_foot() {
    // A weeping crown: strands down to the ground, thinner than the trunk and not as steady.
    let willow = draw(|x, y| {
        let strand = ((x + 0.5) * 25.0).fract();
        let sways = 0.1 * ((y * 40.0) as i64 % 3) as f64;
        ball(x, y, (0.0, 0.7), 0.3)
            || x.abs() <= 0.03 && y < 0.7
            || x.abs() < 0.4 && x.abs() > 0.1 && y < 0.7 && strand > 0.55 + sways && strand < 0.85 + sways
    });
    let reading = Reading::from_silhouette(&willow);
    assert_eq!(reading.feet.len(), 1, "{reading}");
    is_near(reading.feet[0].width, 0.06, 0.008);
    assert!(reading.stroke_upright.unwrap() > 0.3, "{:?}", reading.stroke_upright);
}

#[test]
fn strokes_rise_or_hang() {
    let tree = |end: f64| {
        draw(move |x, y| {
            x.abs() <= 0.02
                || (0..7).any(|i| {
                    let from = 0.35 + 0.08 * f64::from(i);
                    bar(x.abs(), y, (0.0, from), (0.3, from + end), 0.012)
                })
        })
    };
    let rising = Reading::from_silhouette(&tree(0.15));
    is_near(rising.stroke_deg.unwrap(), 26.6, 6.0);
    is_near(rising.twig_fineness.unwrap(), 0.012, 0.004);
    assert!(!rising.leaves, "{rising}");
    assert_eq!(rising.leaf_size_px, None);
    is_near(Reading::from_silhouette(&tree(-0.15)).stroke_deg.unwrap(), -26.6, 6.0);
}

#[test]
fn wood_shows_the_trunk_that_foliage_hides() {
    let wood = draw(|x, y| {
        x.abs() <= 0.03 && y <= 0.5
            || bar(x, y, (0.0, 0.5), (-0.2, 0.9), 0.045)
            || bar(x, y, (0.0, 0.5), (0.2, 0.9), 0.045)
    });
    let tree = draw(|x, y| x.abs() <= 0.03 && y <= 0.5 || ball(x, y, (0.0, 0.6), 0.4));
    let hidden = Reading::from_silhouette(&tree);
    assert_eq!(hidden.first_fork, None);
    let seen = Reading::from_silhouette_with_wood(&tree, &wood).unwrap();
    is_near(seen.first_fork.unwrap(), 0.5, 0.04);
    is_near(seen.bare_height.unwrap(), 0.2, 0.05);
    assert_eq!(seen.crown, hidden.crown);
}

#[test]
fn the_same_tree_reads_the_same_wherever_it_stands() {
    let picture = lollipop();
    let moved = Bitmap::from_fn(400, 300, |x, y| x >= 37 && y >= 20 && picture.get(x - 37, y - 20));
    let (here, there) = (Reading::from_silhouette(&picture), Reading::from_silhouette(&moved));
    assert_eq!((&here.feet, &here.trunk, &here.crown), (&there.feet, &there.trunk, &there.crown));
    assert!(here.crown_confidence < there.crown_confidence, "the frame cuts it");
    // Twice as large, and reduced since it is larger than what is read as it is.
    let large = Bitmap::from_fn(2400, 2400, |x, y| picture.get(x / 10, y / 10));
    let large = Reading::from_silhouette(&large);
    is_near(large.feet[0].width, here.feet[0].width, 0.005);
    is_near(large.bare_height.unwrap(), here.bare_height.unwrap(), 0.01);
}

#[test]
fn drawings_show_what_was_read() {
    let picture = lollipop();
    let reading = Reading::from_silhouette(&picture);
    let drawing = annotate(&picture, &reading);
    assert_eq!((drawing.width(), drawing.height()), (SIDE, SIDE));
    assert_eq!(drawing.get(SIDE / 2, SIDE - 60), [0, 114, 178], "the axis");
    assert_eq!(drawing.get(SIDE / 2 + 3, SIDE - 1), [213, 94, 0], "the foot");
    assert_eq!(annotate(&Bitmap::new(9, 9), &Reading::default()).get(4, 8), [255; 3]);
}
