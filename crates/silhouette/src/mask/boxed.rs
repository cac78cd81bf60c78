//! How much a mask from a box that a person dragged is to be trusted.
//!
//! A cut is firm wherever it runs, right or wrong. What tells is whether the tree has colours of its own, whether it
//! spills out to the sides of the box, and whether its outline is fine: leaves and twigs differ from each other as
//! much as the tree does from what is behind it, and a hedge that was taken for tree has one long, smooth rim.

use super::clear_sky::apart;
use super::cut::Cut;
use super::pixel_box::PixelBox;
use crate::bitmap::Bitmap;
use pleach_plant::math;
use std::ops::Range;

/// Width of a box's rim, as a part of its longer side.
const RIM: f64 = 0.005;

/// A logistic model of whether the IoU with the truth is at least 0.85: of each number its mean, its deviation and its
/// weight. Fitted by ridge regression to the masks from boxes of the example `composites`, pictures 1000 to 1043 and
/// 1070 to 1112.
const MODEL: [[f64; 3]; 6] = [
    [0.0125, 0.0434, -0.588],
    [9.7639, 1.4038, 0.466],
    [0.1456, 0.0310, -0.673],
    [0.0608, 0.0127, 0.767],
    [0.8600, 0.1037, 0.593],
    [0.4230, 0.1450, -0.569],
];
const BIAS: f64 = 0.430;
/// Numbers count up to so many deviations from the mean.
const FARTHEST: f64 = 3.0;

/// What is seen of a mask, its box, and the colours on both sides of its outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boxed {
    /// Part of the box's left, upper and right side that the tree reaches, added up; sides that end with the picture
    /// are left out.
    rim: f64,
    /// How much more the tree's colours speak for tree than those of the rest of the box, as logarithms of likelihoods.
    distinct: f64,
    /// Mean difference in colour across the outline, and between neighbours within the tree, in Oklab.
    across: f64,
    within: f64,
    /// Part of the box that is tree.
    filled: f64,
}

impl Boxed {
    pub(super) fn new(cut: &Cut, mask: &Bitmap) -> Self {
        let region = &cut.region;
        let (distinct, across, within) = colors(cut);
        let area = f64::from(region.width) * f64::from(region.height);
        Self { rim: rim(region, mask), distinct, across, within, filled: mask.ink() as f64 / area.max(1.0) }
    }

    /// How likely the mask is a good one, in 0..=1; `firm` is the part of it that stays if the cut is a little stricter.
    pub(super) fn confidence(&self, firm: f64) -> f64 {
        let numbers = [self.rim, self.distinct, self.across, self.within, firm, self.filled];
        let term = |(number, [mean, deviation, weight]): (f64, [f64; 3])| {
            weight * ((number - mean) / deviation).clamp(-FARTHEST, FARTHEST)
        };
        let sum = BIAS + numbers.into_iter().zip(MODEL).map(term).sum::<f64>();
        1.0 / (1.0 + math::exp(-sum))
    }
}

/// See [`Boxed::rim`].
fn rim(region: &PixelBox, mask: &Bitmap) -> f64 {
    let near = (RIM * f64::from(region.width.max(region.height))).ceil() as u32;
    let (right, foot) = (region.x + region.width, region.y + region.height);
    let along = |columns: Range<u32>| {
        let rows = (region.y..foot).filter(|&y| columns.clone().any(|x| mask.get(x, y))).count();
        rows as f64 / f64::from(region.height)
    };
    let mut sum = 0.0;
    if region.x > near {
        sum += along(region.x..(region.x + near).min(right));
    }
    if right + near < mask.width() {
        sum += along(right.saturating_sub(near).max(region.x)..right);
    }
    if region.y > near {
        let rows = region.y..(region.y + near).min(foot);
        let columns = (region.x..right).filter(|&x| rows.clone().any(|y| mask.get(x, y))).count();
        sum += columns as f64 / f64::from(region.width);
    }
    sum
}

/// See [`Boxed::distinct`], [`Boxed::across`] and [`Boxed::within`].
fn colors(cut: &Cut) -> (f64, f64, f64) {
    let small = &cut.small;
    let (mut tree, mut rest) = (Mean::default(), Mean::default());
    let (mut across, mut within) = (Mean::default(), Mean::default());
    for y in 0..small.height {
        for x in 0..small.width {
            let i = small.index(x, y);
            let (px, py) = small.middle(x, y);
            if cut.region.contains(px, py) {
                let side = if cut.is_tree[i] { &mut tree } else { &mut rest };
                side.add(f64::from(cut.by_color(py, small.colors[i])));
            }
            for (a, b) in [(x + 1, y), (x, y + 1)] {
                if a < small.width && b < small.height {
                    let j = small.index(a, b);
                    let difference = f64::from(apart(small.colors[i], small.colors[j]));
                    match (cut.is_tree[i], cut.is_tree[j]) {
                        (true, true) => within.add(difference),
                        (false, false) => {}
                        _ => across.add(difference),
                    }
                }
            }
        }
    }
    (tree.mean() - rest.mean(), across.mean(), within.mean())
}

#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    sum: f64,
    count: f64,
}

impl Mean {
    fn add(&mut self, value: f64) {
        self.sum += value;
        self.count += 1.0;
    }

    fn mean(self) -> f64 {
        self.sum / self.count.max(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spilling_out_of_the_box_speaks_against_a_mask_and_colours_of_its_own_for_it() {
        let usual = Boxed { rim: 0.0, distinct: 9.8, across: 0.15, within: 0.06, filled: 0.42 };
        let confidence = usual.confidence(0.86);
        assert!((0.5..0.75).contains(&confidence), "{confidence}");
        assert!(Boxed { rim: 0.2, ..usual }.confidence(0.86) < confidence);
        assert!(Boxed { distinct: 12.0, ..usual }.confidence(0.86) > confidence);
        assert!(usual.confidence(0.5) < confidence);
    }

    #[test]
    fn sides_that_end_with_the_picture_do_not_count() {
        let mask = Bitmap::from_fn(100, 100, |x, y| x < 40 && (20..60).contains(&y));
        let at = |x| rim(&PixelBox { x, y: 10, width: 60, height: 80 }, &mask);
        assert_eq!((at(0), at(20)), (0.0, 0.5));
    }
}
