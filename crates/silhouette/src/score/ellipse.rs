//! The best single ellipse: what a blob would score.
//!
//! IoU flatters blobs. A fit that does not beat one ellipse has found no tree, whatever its IoU.

use crate::bitmap::Bitmap;
use pleach_plant::math;

/// Columns or rows of the picture in which ellipses are tried.
const SIDE: u32 = 128;

/// A search whose ellipse is worse than a plain one by more than this has gone astray.
const MISSED: f64 = 0.01;

/// Numbers of an ellipse: centre, half axes and the angle of the first, in pixels and radians.
type Ellipse = [f64; 5];

/// The intersection over union of `goal` with the ellipse that fits it best, in 0..=1; 0 without ink.
#[must_use]
pub fn best_ellipse_iou(goal: &Bitmap) -> f64 {
    search(goal).map_or(0.0, |found| found.0)
}

/// The ellipse that fits `goal` best, filled; empty without ink.
#[must_use]
pub fn best_ellipse(goal: &Bitmap) -> Bitmap {
    let Some((_, [cx, cy, a, b, angle])) = search(goal) else {
        return Bitmap::new(goal.width(), goal.height());
    };
    let (sin, cos) = math::sin_cos(angle);
    Bitmap::from_fn(goal.width(), goal.height(), |x, y| {
        let (dx, dy) = (f64::from(x) + 0.5 - cx, f64::from(y) + 0.5 - cy);
        math::powi((dx * cos + dy * sin) / a, 2) + math::powi((dy * cos - dx * sin) / b, 2) <= 1.0
    })
}

/// The best ellipse and its intersection over union; `None` without ink.
///
/// Searched at 128 pixels by steps along each number, halved when none helps, from the moments of the
/// whole picture and of its upper parts; then polished on the picture itself. Where an ellipse that is
/// known without a search is clearly better, that is polished instead. Deterministic.
fn search(goal: &Bitmap) -> Option<(f64, Ellipse)> {
    let reduction = (goal.width().max(goal.height())).div_ceil(SIDE).max(1);
    let small = Rows::new(goal, reduction);
    let (mean, spread) = small.moments(1.0)?;
    let mut best = (0.0, [0.0; 5]);
    for part in [1.0, 0.8, 0.6] {
        let Some((mean, spread)) = small.moments(part) else { continue };
        for size in [1.2, 1.7, 2.2] {
            for tilt in [0.0, 0.35, -0.35] {
                let start = [mean[0], mean[1], size * spread[0], size * spread[1], tilt];
                let found = small.climb(start, [4.0, 4.0, 4.0, 4.0, 0.2], 0.05);
                if found.0 > best.0 {
                    best = found;
                }
            }
        }
    }
    // A tree may be one thin pole: an ellipse around its mean alone.
    let pole = small.climb([mean[0], mean[1], spread[0].max(1.0), 2.0 * spread[1], 0.0], [1.0; 5], 0.02);
    if pole.0 > best.0 {
        best = pole;
    }
    if reduction == 1 {
        return Some(small.at_least_plain(best, 0.05));
    }
    let scale = f64::from(reduction);
    let [x, y, a, b, angle] = best.1;
    let full = Rows::new(goal, 1);
    // The longest ellipse must not become too long by the last bit of a product.
    let axis = |a: f64| (a * scale).min(full.longest);
    let start = [x * scale, y * scale, axis(a), axis(b), angle];
    let polished = full.climb(start, [scale, scale, scale, scale, 0.02], 0.25);
    Some(full.at_least_plain(polished, 0.25))
}

/// Directions of steps: each number alone; one end of the upright axis with the other held; both axes.
const WAYS: [Ellipse; 8] = [
    [1.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 1.0],
    [0.0, 1.0, 0.0, 1.0, 0.0],
    [0.0, 1.0, 0.0, -1.0, 0.0],
    [0.0, 0.0, 1.0, 1.0, 0.0],
];

/// Ink before each column of each row: a span's ink is one subtraction.
struct Rows {
    width: usize,
    height: usize,
    /// Size of the picture in cells: the last column and row may be parts of one.
    edges: [f64; 2],
    /// Longest half axis. A pole is matched the better the longer the ellipse is, by less and less without
    /// end.
    longest: f64,
    before: Vec<f32>,
    ink: f64,
}

impl Rows {
    /// Ink of `goal` in cells of `reduction` pixels square, each 0 to 1.
    fn new(goal: &Bitmap, reduction: u32) -> Self {
        let (width, height) =
            (goal.width().div_ceil(reduction) as usize, goal.height().div_ceil(reduction) as usize);
        let mut cells = vec![0.0_f32; width * height];
        let share = 1.0 / (reduction * reduction) as f32;
        for y in 0..goal.height() {
            for x in goal.ink_in_row(y) {
                cells[(y / reduction) as usize * width + (x / reduction) as usize] += share;
            }
        }
        let ink = cells.iter().map(|&c| f64::from(c)).sum();
        let mut before = Vec::with_capacity((width + 1) * height);
        for row in cells.chunks_exact(width) {
            let mut sum = 0.0;
            before.push(0.0);
            before.extend(row.iter().map(|c| {
                sum += c;
                sum
            }));
        }
        let edges = [goal.width(), goal.height()].map(|side| f64::from(side) / f64::from(reduction));
        Self { width, height, edges, longest: 2.0 * (edges[0] + edges[1]), before, ink }
    }

    fn row(&self, y: usize) -> &[f32] {
        &self.before[y * (self.width + 1)..(y + 1) * (self.width + 1)]
    }

    /// Mean and standard deviation along x and y of the ink in the upper `part` of the inked rows.
    fn moments(&self, part: f64) -> Option<([f64; 2], [f64; 2])> {
        let inked = |y: &usize| self.row(*y)[self.width] > 0.0;
        let top = (0..self.height).find(inked)?;
        let bottom = (0..self.height).rfind(inked)?;
        let last = top + ((bottom - top) as f64 * part) as usize;
        let (mut n, mut sum, mut squares) = (0.0, [0.0; 2], [0.0; 2]);
        for y in top..=last {
            for (x, w) in self.row(y).windows(2).enumerate() {
                let ink = f64::from(w[1] - w[0]);
                let p = [x as f64 + 0.5, y as f64 + 0.5];
                n += ink;
                for k in 0..2 {
                    sum[k] += ink * p[k];
                    squares[k] += ink * p[k] * p[k];
                }
            }
        }
        let mean = sum.map(|s| s / n);
        let spread = [0, 1].map(|k| (squares[k] / n - mean[k] * mean[k]).max(0.25).sqrt());
        Some((mean, spread))
    }

    /// Intersection over union with an ellipse, cut off at the picture's edges as any picture is.
    fn iou(&self, &[cx, cy, a, b, angle]: &Ellipse) -> f64 {
        if a.min(b) < 0.3 || a.max(b) > self.longest {
            return 0.0;
        }
        let (sin, cos) = math::sin_cos(angle);
        // Of the quadratic form: p x² + 2 q x y + r y² = 1 about the centre.
        let p = math::powi(cos / a, 2) + math::powi(sin / b, 2);
        let q = sin * cos * (1.0 / (a * a) - 1.0 / (b * b));
        let r = math::powi(sin / a, 2) + math::powi(cos / b, 2);
        let reach = (p / (p * r - q * q)).sqrt();
        let first = (cy - reach).floor().max(0.0) as usize;
        let last = ((cy + reach).ceil().max(0.0) as usize).min(self.height);
        let (mut inside, mut area) = (0.0, 0.0);
        let edge = self.edges[0];
        for y in first..last {
            let dy = y as f64 + 0.5 - cy;
            let root = q * q * dy * dy - p * (r * dy * dy - 1.0);
            if root > 0.0 {
                let (middle, half) = (cx - q * dy / p, root.sqrt() / p);
                let row = self.row(y);
                let (from, to) = ((middle - half).clamp(0.0, edge), (middle + half).clamp(0.0, edge));
                inside += self.at(row, to) - self.at(row, from);
                area += (to - from) * (self.edges[1] - y as f64).min(1.0);
            }
        }
        if area > 0.0 { inside / (area + self.ink - inside) } else { 0.0 }
    }

    /// Climbs from `start` by steps along [`WAYS`], forwards and back, halving them until they are below
    /// `least` of their first size.
    fn climb(&self, start: Ellipse, steps: Ellipse, least: f64) -> (f64, Ellipse) {
        let mut best = (self.iou(&start), start);
        let mut size = 1.0;
        while size > least {
            let mut moved = false;
            for way in WAYS {
                for sign in [size, -size] {
                    let trial: Ellipse = std::array::from_fn(|k| best.1[k] + sign * way[k] * steps[k]);
                    let iou = self.iou(&trial);
                    if iou > best.0 {
                        best = (iou, trial);
                        moved = true;
                    }
                }
            }
            if !moved {
                size /= 2.0;
            }
        }
        best
    }

    /// Ink before `x`, in cells, of a row; parts of a cell count in proportion.
    fn at(&self, row: &[f32], x: f64) -> f64 {
        let i = (x as usize).min(self.width - 1);
        let part = (x - i as f64) / (self.edges[0] - i as f64).min(1.0);
        f64::from(row[i]) * (1.0 - part) + f64::from(row[i + 1]) * part
    }

    /// `found`, or the best of the ellipses that are known without a search, polished, if the search has
    /// missed one that is clearly better: that of the ink's moments, or a band across the picture.
    fn at_least_plain(&self, found: (f64, Ellipse), least: f64) -> (f64, Ellipse) {
        let plain = self.plain().into_iter().map(|ellipse| (self.iou(&ellipse), ellipse));
        let better = plain.fold(found, |best, other| if other.0 > best.0 { other } else { best });
        if better.0 > found.0 + MISSED {
            self.climb(better.1, [4.0, 4.0, 4.0, 4.0, 0.2], least)
        } else {
            found
        }
    }

    fn plain(&self) -> Vec<Ellipse> {
        let (mut n, mut sum, mut squares) = (0.0, [0.0; 2], [0.0; 3]);
        let (mut low, mut high) = ([f64::INFINITY; 2], [0.0_f64; 2]);
        for y in 0..self.height {
            for (x, w) in self.row(y).windows(2).enumerate() {
                let ink = f64::from(w[1] - w[0]);
                if ink > 0.0 {
                    let at = [x as f64, y as f64];
                    let p = at.map(|v| v + 0.5);
                    n += ink;
                    squares[0] += ink * p[0] * p[0];
                    squares[1] += ink * p[0] * p[1];
                    squares[2] += ink * p[1] * p[1];
                    for k in 0..2 {
                        sum[k] += ink * p[k];
                        low[k] = low[k].min(at[k]);
                        high[k] = high[k].max((at[k] + 1.0).min(self.edges[k]));
                    }
                }
            }
        }
        if n <= 0.0 {
            return Vec::new();
        }
        let mean = sum.map(|s| s / n);
        let (xx, yy) = (squares[0] / n - mean[0] * mean[0], squares[2] / n - mean[1] * mean[1]);
        let xy = squares[1] / n - mean[0] * mean[1];
        // Axes of the covariance; a filled ellipse has half axes of two standard deviations.
        let (middle, off) = (f64::midpoint(xx, yy), math::hypot((xx - yy) / 2.0, xy));
        let axis = |variance: f64| (2.0 * variance.max(0.0).sqrt()).clamp(0.5, self.longest);
        let moments =
            [mean[0], mean[1], axis(middle + off), axis(middle - off), 0.5 * math::atan2(2.0 * xy, xx - yy)];
        let center = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
        let half = [0, 1].map(|k| ((high[k] - low[k]) / 2.0).max(0.5));
        vec![
            moments,
            [center[0], center[1], self.longest, half[1], 0.0],
            [center[0], center[1], half[0], self.longest, 0.0],
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn an_ellipse_is_found_wherever_it_lies() {
        for (cx, cy, a, b, angle) in [
            (60.0, 70.0, 30.0, 40.0, 0.0_f64),
            (128.0, 90.0, 100.0, 25.0, 0.6),
            (200.0, 200.0, 12.0, 50.0, -0.4),
        ] {
            let (sin, cos) = angle.sin_cos();
            let goal = Bitmap::from_fn(256, 256, |x, y| {
                let (dx, dy) = (f64::from(x) + 0.5 - cx, f64::from(y) + 0.5 - cy);
                ((dx * cos + dy * sin) / a).powi(2) + ((dy * cos - dx * sin) / b).powi(2) <= 1.0
            });
            let found = best_ellipse_iou(&goal);
            assert!(found > 0.97, "{found} at {cx}, {cy}");
            let drawn = best_ellipse(&goal);
            let both = drawn.intersection(&goal) as f64;
            let iou = both / (drawn.ink() as f64 + goal.ink() as f64 - both);
            assert!((iou - found).abs() < 0.02, "drawn {iou}, found {found}");
        }
    }

    #[test]
    fn a_square_is_overlapped_as_well_as_geometry_allows() {
        // A circle of radius r on a square of side 2 shares πr² − 4 (r² acos(1/r) − √(r² − 1)) with it:
        // at best an IoU of 0.837, at r = 1.1.
        let square = Bitmap::from_fn(200, 200, |x, y| (50..150).contains(&x) && (50..150).contains(&y));
        let found = best_ellipse_iou(&square);
        assert!((0.834..0.839).contains(&found), "{found}");
    }

    #[test]
    fn the_search_for_a_pole_ends() {
        let pole = Bitmap::from_fn(256, 256, |x, y| (126..130).contains(&x) && y > 20);
        let found = best_ellipse_iou(&pole);
        assert!(found > 0.8, "{found}");
    }

    #[test]
    fn degenerate_goals_have_an_answer() {
        assert_eq!(best_ellipse_iou(&Bitmap::new(30, 30)), 0.0);
        assert_eq!(best_ellipse(&Bitmap::new(30, 20)), Bitmap::new(30, 20));
        let dot = Bitmap::from_fn(30, 30, |x, y| x == 3 && y == 3);
        assert!((0.0..=1.0).contains(&best_ellipse_iou(&dot)));
    }

    /// IoU of two pictures of one size.
    fn overlap(a: &Bitmap, b: &Bitmap) -> f64 {
        let both = a.intersection(b) as f64;
        both / (a.ink() as f64 + b.ink() as f64 - both)
    }

    /// A crown, a trunk and a strip of lawn from side to side, in parts of the picture's size.
    fn tree_on_lawn(width: u32, height: u32, crown: f64, lawn: f64, x: u32, y: u32) -> bool {
        let at = [f64::from(x) / f64::from(width) - 0.5, f64::from(y) / f64::from(height)];
        let gap = (x * 7919 + y * 104_729 + x * y * 31) % 11 < 3;
        let leaf = (at[0] / crown).hypot((at[1] - 0.4) / 0.3) < 1.0 && !gap;
        leaf || (at[0].abs() < 0.02 && at[1] > 0.4) || at[1] > 1.0 - lawn
    }

    #[test]
    fn bands_have_a_best_ellipse_at_sizes_that_are_no_multiples() {
        // The mask of a photograph with a wide crown, cut off at the sides, over a strip of lawn.
        for (width, height) in [(700, 740), (696, 738), (701, 733), (130, 259), (513, 513)] {
            let goal = Bitmap::from_fn(width, height, |x, y| tree_on_lawn(width, height, 4.0, 0.12, x, y));
            let found = best_ellipse_iou(&goal);
            assert!(found > 0.5, "{width} × {height}: {found}");
        }
    }

    /// What geometry gives without a search, drawn pixel by pixel: the ellipse of the ink's moments, and the
    /// band of rows, or of columns, that holds all ink.
    fn plain_ious(goal: &Bitmap) -> Vec<f64> {
        let (left, top, right, bottom) = goal.ink_box().unwrap();
        let (mut n, mut sums) = (0.0, [0.0; 5]);
        for y in 0..goal.height() {
            for x in goal.ink_in_row(y) {
                let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
                n += 1.0;
                sums.iter_mut().zip([x, y, x * x, x * y, y * y]).for_each(|(sum, term)| *sum += term);
            }
        }
        let [x, y, xx, xy, yy] = sums.map(|sum| sum / n);
        let (xx, xy, yy) = (xx - x * x, xy - x * y, yy - y * y);
        let determinant = (xx * yy - xy * xy).max(1e-9);
        let (width, height) = (goal.width(), goal.height());
        let moments = Bitmap::from_fn(width, height, |px, py| {
            let (dx, dy) = (f64::from(px) + 0.5 - x, f64::from(py) + 0.5 - y);
            (yy * dx * dx - 2.0 * xy * dx * dy + xx * dy * dy) / determinant <= 4.0
        });
        let rows = Bitmap::from_fn(width, height, |_, y| (top..=bottom).contains(&y));
        let columns = Bitmap::from_fn(width, height, |x, _| (left..=right).contains(&x));
        [moments, rows, columns].iter().map(|plain| overlap(plain, goal)).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

        #[test]
        fn no_plain_ellipse_or_band_is_better(
            width in 9_u32..420, height in 9_u32..420, crown in 0.1..0.8_f64, lawn in 0.0..0.3_f64,
        ) {
            let goal = Bitmap::from_fn(width, height, |x, y| tree_on_lawn(width, height, crown, lawn, x, y));
            prop_assume!(goal.ink() > 0);
            let found = best_ellipse_iou(&goal);
            for plain in plain_ious(&goal) {
                // The longest ellipses bulge a little where a band is straight.
                prop_assert!(found >= plain - 0.02, "{found} and {plain}");
            }
            let drawn = overlap(&best_ellipse(&goal), &goal);
            prop_assert!((drawn - found).abs() < 0.03, "drawn {drawn}, found {found}");
        }

        #[test]
        fn a_margin_of_a_few_pixels_changes_little(
            side in 256_u32..420, more in 1_u32..9, crown in 0.1..0.45_f64,
        ) {
            let paper = |margin: u32| {
                Bitmap::from_fn(side + margin, side + margin, |x, y| {
                    x < side && y < side && tree_on_lawn(side, side, crown, 0.0, x, y)
                })
            };
            let (bare, padded) = (best_ellipse_iou(&paper(0)), best_ellipse_iou(&paper(more)));
            prop_assert!((bare - padded).abs() < 0.02, "{bare} and {padded}");
        }
    }
}
