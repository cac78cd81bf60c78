//! A drawn curve, turned about its axis; or several, one for each direction.

use glam::DVec3;
use pleach_tree::math;
use pleach_tree::trig::atan2;
use std::f64::consts::TAU;

/// Heights at which a curve of points is sampled.
pub(crate) const HEIGHTS: usize = 65;

/// Radius by height and direction: heights evenly from 0 to 1, directions evenly around from +x
/// towards +y; between them linear.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outline {
    /// Height by height, each with all directions.
    radii: Vec<f64>,
    directions: usize,
    widest: f64,
    content: f64,
}

impl Outline {
    /// The same in all directions, by its radii at even heights: at least two, none negative.
    pub(crate) fn of_radii(radii: &[f64]) -> Self {
        Self::by_direction(radii.to_vec(), 1)
    }

    /// Height by height, each with all `directions`.
    pub(crate) fn by_direction(radii: Vec<f64>, directions: usize) -> Self {
        let widest = radii.iter().copied().fold(0.0, f64::max);
        let mut outline = Self { radii, directions, widest, content: 0.0 };
        outline.content = outline.measure();
        outline
    }

    /// With radii multiplied by `factors` at even heights, and by what lies between.
    pub(crate) fn scaled(&self, factors: &[f64]) -> Self {
        let last = (self.heights() - 1) as f64;
        let factor = |row: usize| {
            let at = row as f64 / last * (factors.len() - 1) as f64;
            let low = (at as usize).min(factors.len() - 2);
            factors[low] + (factors[low + 1] - factors[low]) * (at - low as f64)
        };
        let rows = self.radii.chunks(self.directions).enumerate();
        let radii = rows.flat_map(|(row, radii)| radii.iter().map(move |r| r * factor(row))).collect();
        Self::by_direction(radii, self.directions)
    }

    fn heights(&self) -> usize {
        self.radii.len() / self.directions
    }

    /// The largest radius.
    pub(crate) const fn widest(&self) -> f64 {
        self.widest
    }

    /// Content where radius and height are 1.
    pub(crate) const fn content(&self) -> f64 {
        self.content
    }

    fn measure(&self) -> f64 {
        // Area between directions where the radius runs from a to b: ∫ r²/2 = step (a² + ab + b²)/6.
        let step = TAU / self.directions as f64;
        let area = |radius: &dyn Fn(usize) -> f64| {
            let sector = |d: usize| {
                let (a, b) = (radius(d), radius((d + 1) % self.directions));
                a * a + a * b + b * b
            };
            (0..self.directions).map(sector).sum::<f64>() * step / 6.0
        };
        let at = |h: usize, d: usize| self.radii[h * self.directions + d];
        let last = self.heights() - 1;
        // Simpson's rule is exact: areas are quadratic in height.
        let slab = |h: usize| {
            let low = area(&|d| at(h, d));
            let middle = area(&|d| (at(h, d) + at(h + 1, d)) / 2.0);
            (low + 4.0 * middle + area(&|d| at(h + 1, d))) / 6.0
        };
        (0..last).map(slab).sum::<f64>() / last as f64
    }

    /// The radius at the height and in the direction of `p`; 0 above and below.
    pub(crate) fn radius(&self, p: DVec3) -> f64 {
        if !(0.0..=1.0).contains(&p.z) {
            return 0.0;
        }
        let last = self.heights() - 1;
        let height = p.z * last as f64;
        let low = (height as usize).min(last - 1);
        let up = height - low as f64;
        let n = self.directions;
        let row = |d: usize| {
            let (a, b) = (self.radii[low * n + d], self.radii[(low + 1) * n + d]);
            a + (b - a) * up
        };
        if n == 1 {
            return row(0);
        }
        let turn = atan2(p.y, p.x) / TAU;
        let around = (if turn < 0.0 { turn + 1.0 } else { turn }) * n as f64;
        let first = (around as usize).min(n - 1);
        let (a, b) = (row(first), row((first + 1) % n));
        a + (b - a) * (around - first as f64)
    }

    /// Whether `p` is inside, where radius and height are 1.
    pub(crate) fn holds(&self, p: DVec3) -> bool {
        let across = p.truncate().length_squared();
        across <= self.widest * self.widest && across <= math::powi(self.radius(p), 2)
    }
}

/// Radii at [`HEIGHTS`] even heights of the straight `pieces` of a curve, from one point to another,
/// each a radius and a height from 0 to 1: the largest where several pass a height.
pub(crate) fn sampled(pieces: impl IntoIterator<Item = [[f64; 2]; 2]>) -> Vec<f64> {
    let last = (HEIGHTS - 1) as f64;
    let mut radii = vec![0.0_f64; HEIGHTS];
    for [[r0, h0], [r1, h1]] in pieces {
        // A little more, so that rounding leaves no row out between two pieces.
        let low = (h0.min(h1) * last - 1e-9).ceil().max(0.0) as usize;
        let high = ((h0.max(h1) * last + 1e-9).floor() as usize).min(HEIGHTS - 1);
        for (row, radius) in radii.iter_mut().enumerate().take(high + 1).skip(low) {
            let t = if h0 == h1 { 0.0 } else { ((row as f64 / last - h0) / (h1 - h0)).clamp(0.0, 1.0) };
            let here = if h0 == h1 { r0.max(r1) } else { r0 + (r1 - r0) * t };
            *radius = radius.max(here);
        }
    }
    radii
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;
    use std::f64::consts::PI;

    #[test]
    fn cones_and_cylinders_have_their_contents() {
        assert!((Outline::of_radii(&[1.0, 0.0]).content() - PI / 3.0).abs() < 1e-12);
        assert!((Outline::of_radii(&[1.0, 1.0, 1.0]).content() - PI).abs() < 1e-12);
        assert!((Outline::by_direction(vec![1.0; 8], 4).content() - PI).abs() < 1e-12);
    }

    #[test]
    fn directions_are_told_apart() {
        // East 1, north 0.5, west 0.25, south 0.5.
        let outline = Outline::by_direction([1.0, 0.5, 0.25, 0.5].repeat(2), 4);
        for (p, radius) in [
            (dvec3(1.0, 0.0, 0.5), 1.0),
            (dvec3(-1.0, 0.0, 0.5), 0.25),
            (dvec3(0.0, -1.0, 0.2), 0.5),
            (dvec3(1.0, 1.0, 0.2), 0.75),
            (dvec3(1.0, -1.0, 1.0), 0.75),
            (dvec3(1.0, 0.0, 1.1), 0.0),
        ] {
            assert!((outline.radius(p) - radius).abs() < 1e-9, "{p}");
        }
    }

    #[test]
    fn factors_are_by_height() {
        let scaled = Outline::by_direction(vec![1.0; 6], 2).scaled(&[1.0, 3.0]);
        assert_eq!(scaled.radii, [1.0, 1.0, 2.0, 2.0, 3.0, 3.0]);
    }

    #[test]
    fn curves_are_sampled_where_they_are_widest() {
        let radii = sampled([[[0.5, 0.0], [0.5, 0.5]], [[0.5, 0.5], [1.0, 0.25]], [[1.0, 0.25], [0.0, 1.0]]]);
        assert_eq!(radii.len(), HEIGHTS);
        assert!((radii[16] - 1.0).abs() < 1e-9 && (radii[0] - 0.5).abs() < 1e-9, "{radii:?}");
        assert!(radii[64].abs() < 1e-9);
    }
}
