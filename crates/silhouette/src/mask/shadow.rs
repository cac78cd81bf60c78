//! The shadow that a tree throws on the ground.
//!
//! A shadow stands out from the ground as the tree does, and it touches the trunk. But it has the ground's own hue and
//! is only darker, it is wide and flat, and it lies low.

use crate::bitmap::Bitmap;
use crate::pieces;
use std::ops::Range;

/// Lightness of a shadow as parts of the ground's, in Oklab: the cube root of the light that is left, since the sky
/// lights a shadow, too.
const DARKER: [f64; 2] = [0.5, 0.97];
/// A shadow differs in hue from darkened ground by less than this, in the ground's spreads.
const SAME_HUE: f64 = 2.0;
/// Runs of a row that are shadow, as a part of the width of all that stands out: more than a trunk.
const MIN_RUN: f64 = 0.05;
/// A shadow is at least this wide, as a part of the same.
const MIN_WIDTH: f64 = 0.12;
/// It is at least so many times as wide as high.
const MIN_ASPECT: f64 = 1.5;
/// It covers at least this part of the box around it.
const MIN_FILL: f64 = 0.15;
/// It lies in this lowest part of the height of all that stands out.
const LOW: f64 = 0.4;
/// A trunk is at most so wide above its shadow, as a part of the width of all that stands out.
const MAX_TRUNK: f64 = 0.2;
/// Pieces of a shadow lie nearer to each other than this part of the shorter side, and its soft rim is no wider.
const NEAR: f64 = 0.006;

/// Whether a colour is the ground's in the shade. `spreads` says how far a difference of colours is.
pub(super) fn is_shade(color: [f64; 3], ground: [f64; 3], spreads: impl Fn([f64; 3]) -> f64) -> bool {
    let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let darker = dot(color, ground) / dot(ground, ground).max(1e-9);
    (DARKER[0]..=DARKER[1]).contains(&darker)
        && spreads(std::array::from_fn(|i| color[i] - darker * ground[i])) < SAME_HUE
}

/// The shadows on the ground, of what stands out and of the pixels that have the ground's colour in the shade.
pub(super) fn on_ground(ink: &Bitmap, shade: &Bitmap) -> Bitmap {
    let (width, height) = (ink.width(), ink.height());
    let mut found = Bitmap::new(width, height);
    let Some((left, top, right, bottom)) = ink.ink_box() else { return found };
    let across = f64::from(right + 1 - left);
    let min_run = ((MIN_RUN * across).ceil() as u32).max(3);
    let highest = bottom - (LOW * f64::from(bottom - top)) as u32;
    let near = ((NEAR * f64::from(width.min(height))).round() as u32).max(1);

    let grounds = pieces::widened(&wide_runs(shade, min_run), near);
    for (start, (left, top, right, bottom), area) in pieces::boxes(&grounds) {
        let (wide, high) = (f64::from(right + 1 - left), f64::from(bottom + 1 - top));
        let is_shadow = top >= highest
            && wide >= MIN_WIDTH * across
            && wide >= MIN_ASPECT * high
            && area as f64 >= MIN_FILL * wide * high;
        if is_shadow && let Some(piece) = pieces::piece(&grounds, &grounds, Some(start)) {
            let around = pieces::widened(&piece, near);
            let first = around.ink_box().map_or(top, |found| found.1);
            let trunk = trunk(ink, shade, first, (MAX_TRUNK * across) as u32);
            let is_trunk = |x, y| trunk.as_ref().is_some_and(|(run, last)| y <= *last && run.contains(&x));
            for y in first..height {
                for x in around.ink_in_row(y).filter(|&x| shade.get(x, y) && !is_trunk(x, y)) {
                    found.set(x, y, true);
                }
            }
        }
    }
    // What throws a shadow stands out, too.
    if 2 * found.intersection(ink) > ink.ink() { Bitmap::new(width, height) } else { found }
}

/// The runs of rows that are at least so long.
fn wide_runs(shade: &Bitmap, least: u32) -> Bitmap {
    let mut out = Bitmap::new(shade.width(), shade.height());
    for y in 0..shade.height() {
        for run in runs(shade, y).filter(|run| run.end - run.start >= least) {
            run.for_each(|x| out.set(x, y, true));
        }
    }
    out
}

/// Where a trunk of the ground's own hue comes down into a shadow: its columns, and its last row.
///
/// It is the run of ink above the shadow that is widest and nearest below the middle of what is higher up.
fn trunk(ink: &Bitmap, shade: &Bitmap, top: u32, max_width: u32) -> Option<(Range<u32>, u32)> {
    let above = top.checked_sub(1)?;
    let (mut sum, mut count) = (0.0, 0.0_f64);
    for x in (0..top).flat_map(|y| ink.ink_in_row(y)) {
        sum += f64::from(x);
        count += 1.0;
    }
    let middle = sum / count.max(1.0);
    let worth = |run: &Range<u32>| {
        f64::from(run.end - run.start) - (f64::from(run.start + run.end) / 2.0 - middle).abs()
    };
    let run = runs(ink, above)
        .filter(|run| run.end - run.start <= max_width)
        .max_by(|a, b| worth(a).total_cmp(&worth(b)))?;
    // Down to what is surely trunk, if some is.
    let lowest = |is: &dyn Fn(u32, u32) -> bool| {
        (top..ink.height()).rev().find(|&y| run.clone().any(|x| ink.get(x, y) && is(x, y)))
    };
    let last = lowest(&|x, y| !shade.get(x, y)).or_else(|| lowest(&|_, _| true))?;
    Some((run, last))
}

/// The runs of ink of a row.
fn runs(ink: &Bitmap, y: u32) -> impl Iterator<Item = Range<u32>> + '_ {
    let mut at = 0;
    std::iter::from_fn(move || {
        let start = (at..ink.width()).find(|&x| ink.get(x, y))?;
        at = (start..ink.width()).find(|&x| !ink.get(x, y)).unwrap_or(ink.width());
        Some(start..at)
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::{SIDE, chance, iou, noise, scene, sky_and_lawn, wall};
    use super::super::{Mask, MaskOptions, Photo, PixelBox};
    use super::*;

    /// A crown on a trunk of the ground's hue, and what the trunk throws to the right.
    #[test]
    fn what_is_flat_and_low_is_a_shadow_and_a_trunk_is_not() {
        let is_crown = |x: u32, y: u32| (40..100).contains(&x) && (10..80).contains(&y);
        let is_trunk = |x: u32, y: u32| (67..72).contains(&x) && (80..140).contains(&y);
        let is_shadow = |x: u32, y: u32| (67..150).contains(&x) && (118..136).contains(&y);
        let ink = Bitmap::from_fn(160, 160, |x, y| is_crown(x, y) || is_trunk(x, y) || is_shadow(x, y));
        let shade = Bitmap::from_fn(160, 160, |x, y| is_trunk(x, y) || is_shadow(x, y));
        let found = on_ground(&ink, &shade);
        assert_eq!(
            found,
            Bitmap::from_fn(160, 160, |x, y| is_shadow(x, y) && !is_trunk(x, y)),
            "{}",
            found.ink()
        );
        // What is as high as it is wide is none, nor is what lies high, nor what is all that there is.
        let tall = Bitmap::from_fn(160, 160, |x, y| (80..130).contains(&x) && (100..140).contains(&y));
        let high = Bitmap::from_fn(160, 160, |x, y| (40..100).contains(&x) && (60..70).contains(&y));
        for other in [&tall, &high] {
            let mut all = ink.clone();
            all.unite(other);
            assert_eq!(on_ground(&all, other).ink(), 0);
        }
        let alone = Bitmap::from_fn(160, 160, is_shadow);
        assert_eq!(on_ground(&alone, &alone).ink(), 0);
    }

    #[test]
    fn shade_is_the_grounds_colour_and_darker() {
        let spreads =
            |difference: [f64; 3]| difference.iter().map(|d| (d / 0.02).powi(2)).sum::<f64>().sqrt();
        let ground = [0.7, -0.05, 0.08];
        let darker = |share: f64| ground.map(|v| share * v);
        let is = |color| is_shade(color, ground, spreads);
        assert!([0.55, 0.7, 0.9].into_iter().all(|share| is(darker(share))));
        assert!(!is(ground) && !is(darker(0.3)) && !is(darker(1.2)) && !is([0.5, 0.05, 0.08]));
    }

    /// Trees before a wall with a floor, and on a lawn, that throw a shadow on it; by themselves, from a box close around
    /// the tree, and from one around the shadow, too.
    #[test]
    fn a_shadow_on_the_ground_is_not_tree() {
        for species in ["quaking_aspen", "acer", "silver_birch"] {
            for behind in [wall, sky_and_lawn] {
                let shaded = |x: u32, y: u32| {
                    let (along, down) = (f64::from(x) - 190.0, f64::from(y) - 0.9 * f64::from(SIDE));
                    let is_dark =
                        (along / 62.0).powi(2) + (down / 9.0).powi(2) < 1.0 && chance(x, y, 91) < 0.97;
                    behind(x, y).map(|v| if is_dark { 0.6 * v } else { v })
                };
                let drawn = scene(species, 3.0, shaded);
                let (left, top, right, bottom) = drawn.truth.ink_box().unwrap();
                let region = PixelBox { x: left, y: top, width: right + 1 - left, height: bottom + 1 - top };
                // All of the shadow, too.
                let (end, foot) = (SIDE - 2, (0.95 * f64::from(SIDE)) as u32);
                let wide =
                    PixelBox { x: left - 4, y: top - 4, width: end + 4 - left, height: foot + 4 - top };
                for region in [None, Some(region), Some(wide)] {
                    let options = MaskOptions { region, ..MaskOptions::default() };
                    let mask = Mask::from_photo(&drawn.photo, &options).unwrap();
                    let found = iou(&mask.bitmap, &drawn.truth);
                    assert!(found > 0.85, "{species}, {region:?}: {found:.3}");
                }
            }
        }
    }

    /// A grey post before a pale wall is darker than that, and all of it stays.
    #[test]
    fn a_grey_tree_stays() {
        let photo = Photo::from_fn(120, 120, |x, y| {
            let is_tree = (20..100).contains(&x) && (15..60).contains(&y) || (56..64).contains(&x) && y < 110;
            let light = if is_tree && y >= 15 { 120.0 } else { 225.0 } + noise(x, y, 93);
            [light as u8, light as u8, light as u8, 255]
        });
        let mask = Mask::from_photo(&photo, &MaskOptions::default()).unwrap();
        assert_eq!(mask.bitmap.ink(), 80 * 45 + 8 * 50);
    }
}
