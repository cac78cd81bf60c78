//! How much a mask is to be trusted.
//!
//! Nobody has the true silhouette of a photograph. But a mask that is wrong shows it: where something of
//! the background's own colours was taken for tree, a little other threshold takes much more or much less
//! of it; and houses, hills and clouds reach to the picture's edge, as trees that somebody took a picture
//! of seldom do.

use super::score::Foreground;
use crate::bitmap::Bitmap;

/// What speaks for and against a mask, each in 0..=1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Evidence {
    /// Of the ink near the tree if the threshold is lower, the part that stays if it is higher.
    firm: f64,
    /// Part of the picture's left, top and right edge that is ink.
    edge: f64,
    /// Part of the picture's width that is ink where the ground begins or the picture ends, beyond what
    /// trunks have.
    foot: f64,
    /// Part of what stood out that was dropped.
    dropped: f64,
    /// Whether it reaches both the left and the right edge: a wire, a fence, a hill, or a tree that is cut off twice.
    spans: bool,
}

/// Of what reaches from edge to edge, this part of the confidence is left.
const SPANNING: f64 = 0.65;

/// Part of the width that a trunk, or a low crown, may cover.
const TRUNK: f64 = 0.35;
/// How far above the horizon that is looked at, as a part of the height.
const ABOVE: f64 = 0.03;

/// Opacities from which on a pixel is firmly, or just so, what is opaque.
pub(super) const FIRM_OPACITY: u8 = 192;
pub(super) const LOOSE_OPACITY: u8 = 64;

impl Evidence {
    /// What there is of a mask that was made of `foreground`.
    pub(super) fn new(mask: &Bitmap, foreground: &Foreground) -> Self {
        let (width, height) = (mask.width(), mask.height());
        let part = |a: u64, b: u64| if b == 0 { 0.0 } else { a as f64 / b as f64 };
        let side = |x| (0..height).filter(|&y| mask.get(x, y)).count();
        let (left, right) = (side(0), side(width - 1));
        let row = |y| mask.ink_in_row(y).count();
        let edge = (left + right + row(0)) as f64 / f64::from(2 * height + width);
        let rim = foreground.horizon.map_or(0, |horizon| {
            let above = |x| (horizon.at(x, width) - ABOVE * f64::from(height)).max(0.0) as u32;
            (0..width).filter(|&x| mask.get(x, above(x))).count()
        });
        let foot = row(height - 1).max(rim) as f64 / f64::from(width);
        let standing_ink = foreground.ink.ink();
        Self {
            firm: part(foreground.firm.intersection(mask), foreground.loose.ink()),
            edge,
            foot: ((foot - TRUNK) / (1.0 - TRUNK)).max(0.0),
            dropped: part(standing_ink.saturating_sub(mask.intersection(&foreground.ink)), standing_ink),
            spans: left > 0 && right > 0,
        }
    }

    /// The same of a tree that somebody cut out: bushes are, too, and their feet are no hills.
    pub(super) const fn of_a_cutout(self) -> Self {
        Self { foot: 0.0, dropped: 0.0, spans: false, ..self }
    }

    /// The part that stays if the threshold is higher.
    pub(super) const fn firm(self) -> f64 {
        self.firm
    }

    /// All of it in one number, in 0..=1.
    pub(super) fn confidence(self) -> f64 {
        let against = 1.0 - (4.0 * self.edge).min(1.0);
        let narrow = 1.0 - (2.0 * self.foot).min(1.0);
        let within = if self.spans { SPANNING } else { 1.0 };
        (self.firm * against * narrow * within * (1.0 - self.dropped)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{SIDE, chance, cloudy, iou, mix, scene, sky, sky_and_lawn, wall, waves};
    use super::super::{DOUBTFUL, Mask, MaskOptions};

    fn part(v: u32) -> f64 {
        f64::from(v) / f64::from(SIDE)
    }

    /// White clouds with hard rims, as high as the crown.
    fn heaps(x: u32, y: u32) -> [f64; 3] {
        if waves(x, y, 35.0) + 0.4 * waves(y, x, 9.0) > 0.15 && y < 150 { [250.0; 3] } else { sky(x, y) }
    }

    fn bricks(x: u32, y: u32) -> [f64; 3] {
        let course = y / 10;
        let mortar = y % 10 < 2 || (x + course % 2 * 11) % 22 < 2;
        let tone = 0.8 + 0.4 * chance((x + course % 2 * 11) / 22, course, 61);
        if mortar { [200.0, 195.0, 185.0] } else { [150.0, 70.0, 50.0].map(|v| v * tone) }
    }

    /// A wooded hill behind the tree, whose rim rises to the middle of the picture.
    fn hill(x: u32, y: u32) -> [f64; 3] {
        let rim = 0.75 - 0.3 * (-(part(x) - 0.3).powi(2) / 0.05).exp();
        if part(y) > rim { mix([50.0, 80.0, 40.0], [80.0, 110.0, 50.0], chance(x, y, 62)) } else { sky(x, y) }
    }

    fn house(x: u32, y: u32) -> [f64; 3] {
        if part(x) > 0.62 && part(y) > 0.5 { [170.0, 60.0, 50.0] } else { sky_and_lawn(x, y) }
    }

    fn fog(x: u32, y: u32) -> [f64; 3] {
        mix([150.0, 155.0, 150.0], [170.0, 172.0, 168.0], part(y) + 0.1 * waves(x, y, 40.0))
    }

    fn wood(x: u32, y: u32) -> [f64; 3] {
        let light = 0.7 + 0.3 * waves(x, y, 7.0) + 0.2 * chance(x, y, 63);
        if part(y) > 0.3 + 0.1 * waves(x, 3, 20.0) {
            [60.0, 95.0, 45.0].map(|v| v * light)
        } else {
            sky(x, y)
        }
    }

    fn wire(x: u32, y: u32) -> [f64; 3] {
        if (part(y) - 0.3 - 0.1 * part(x)).abs() < 0.008 { [20.0; 3] } else { sky(x, y) }
    }

    fn sunset(x: u32, y: u32) -> [f64; 3] {
        mix([60.0, 70.0, 130.0], [250.0, 160.0, 80.0], part(y).powi(2) + 0.05 * waves(x, y, 50.0))
    }

    fn shade(x: u32, y: u32) -> [f64; 3] {
        let lawn = sky_and_lawn(x, y);
        let shadow = part(y) > 0.88 && (0.3..0.95).contains(&part(x));
        if shadow { lawn.map(|v| 0.4 * v) } else { lawn }
    }

    #[test]
    fn confidence_follows_what_is_true_of_a_mask() {
        type Scenery = (&'static str, fn(u32, u32) -> [f64; 3]);
        let scenes: [Scenery; 13] = [
            ("sky", sky),
            ("cloudy", cloudy),
            ("lawn", sky_and_lawn),
            ("wall", wall),
            ("heaps", heaps),
            ("bricks", bricks),
            ("hill", hill),
            ("house", house),
            ("fog", fog),
            ("wood", wood),
            ("wire", wire),
            ("sunset", sunset),
            ("shade", shade),
        ];
        let mut seen = Vec::new();
        for species in ["quaking_aspen", "acer", "palm", "small_pine", "silver_birch"] {
            for (name, background) in scenes {
                for grain in [4.0, 12.0] {
                    let scene = scene(species, grain, background);
                    let Ok(mask) = Mask::from_photo(&scene.photo, &MaskOptions::default()) else { continue };
                    let true_iou = iou(&mask.bitmap, &scene.truth);
                    assert!((0.0..=1.0).contains(&mask.confidence), "{species}, {name}, {grain}");
                    seen.push((true_iou, mask.confidence));
                }
            }
        }
        // Masks that are good come before masks that are bad.
        let of = |wanted: fn(f64) -> bool| -> Vec<f64> {
            seen.iter().filter(|s| wanted(s.0)).map(|s| s.1).collect()
        };
        let (good, bad) = (of(|iou| iou > 0.9), of(|iou| iou < 0.8));
        assert!(good.len() >= 50 && bad.len() >= 30, "{} good, {} bad", good.len(), bad.len());
        let pairs = good.iter().flat_map(|g| bad.iter().map(move |b| g > b));
        let right = pairs.clone().filter(|right| *right).count() as f64 / pairs.count() as f64;
        let correlation = pearson(&ranks(seen.iter().map(|s| s.0)), &ranks(seen.iter().map(|s| s.1)));
        assert!(right >= 0.95, "{right:.3} of the pairs are in order, rank correlation {correlation:.3}");
        assert!(correlation >= 0.8, "rank correlation {correlation:.3}");
        // Those called doubtful are not the good ones.
        let doubtful = |of: &[f64]| of.iter().filter(|c| **c < DOUBTFUL).count() as f64 / of.len() as f64;
        assert!(doubtful(&good) <= 0.02, "{:.3} of the good", doubtful(&good));
        assert!(doubtful(&bad) >= 0.8, "{:.3} of the bad", doubtful(&bad));
    }

    fn ranks(values: impl Iterator<Item = f64>) -> Vec<f64> {
        let values: Vec<f64> = values.collect();
        let below = |v: f64| values.iter().filter(|w| **w < v).count() as f64;
        let equal = |v: f64| values.iter().filter(|w| **w == v).count() as f64;
        values.iter().map(|&v| below(v) + equal(v) / 2.0).collect()
    }

    fn pearson(a: &[f64], b: &[f64]) -> f64 {
        let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
        let (ma, mb) = (mean(a), mean(b));
        let sum = |f: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(a, b)| f(a - ma, b - mb)).sum::<f64>();
        sum(&|a, b| a * b) / (sum(&|a, _| a * a) * sum(&|_, b| b * b)).sqrt()
    }
}
