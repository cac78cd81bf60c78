//! What the background looks like where the tree hides it.
//!
//! Colour is a smooth surface over the picture, of second degree in both directions: enough for a sky
//! that pales towards the horizon and for a wall in uneven light. It is fitted to pixels of the frame,
//! some of which may be tree: first a plane by least absolute deviations, which pay no heed to how far
//! off those are, then the surface by least squares over what lies close to it (Rousseeuw and Leroy,
//! "Robust Regression and Outlier Detection", 1987, chapter 1: a robust fit first, then a reweighted one).
//! A bent surface in the first step would rather bend into a crown than leave it out.
//!
//! Distances from the background are in units of the background's own spread
//! (Mahalanobis, "On the generalised distance in statistics", 1936): a cloudy sky varies from blue to
//! white, and so a white pixel is near, and a green one as different from it is far.

use super::oklab::Oklab;

/// A pixel of the background: where, from −1 to 1 in both directions, and its colour.
pub(super) type Sample = ([f64; 2], Oklab);

const TERMS: usize = 6;

/// Spread below which colours are taken for equal, in Oklab: what the eye can just tell.
const MIN_SPREAD: f64 = 0.02;
/// Rounds of reweighting, after which the surface does not move any more.
const ROUNDS: usize = 20;
/// Samples with residuals beyond this many medians are not background.
const OUTLYING: f64 = 5.0;
/// How much a term is damped: so little that it matters only where samples do not determine it.
const FREE: f64 = 1e-4;
/// So much that the term is zero.
const HELD: f64 = 1e9;

/// A smooth background with its spread.
#[derive(Clone, Debug)]
pub(super) struct Backdrop {
    surface: [[f64; TERMS]; 3],
    /// Lower triangle of the inverse of the covariance's Cholesky factor.
    whiten: [[f64; 3]; 3],
}

fn terms([x, y]: [f64; 2]) -> [f64; TERMS] {
    [1.0, x, y, x * y, x * x, y * y]
}

impl Backdrop {
    /// The background of these samples; `None` if there are too few.
    pub(super) fn fit(samples: &[Sample]) -> Option<Self> {
        if samples.len() < 2 * TERMS {
            return None;
        }
        let mut weights = vec![1.0; samples.len()];
        let mut surface = least_squares(samples, &weights, HELD)?;
        for _ in 0..ROUNDS {
            for (weight, sample) in weights.iter_mut().zip(samples) {
                *weight = 1.0 / norm(residual(&surface, sample)).max(1e-3);
            }
            surface = least_squares(samples, &weights, HELD)?;
        }
        // Once by the plane, then by a surface that knows better what is close.
        for _ in 0..2 {
            let mut sizes: Vec<f64> = samples.iter().map(|s| norm(residual(&surface, s))).collect();
            let far = OUTLYING * median(&mut sizes).max(MIN_SPREAD / 2.0);
            for (weight, sample) in weights.iter_mut().zip(samples) {
                *weight = f64::from(u8::from(norm(residual(&surface, sample)) <= far));
            }
            surface = least_squares(samples, &weights, FREE)?;
        }
        let mut covariance = [[0.0; 3]; 3];
        for (&weight, sample) in weights.iter().zip(samples) {
            let r = residual(&surface, sample);
            for i in 0..3 {
                for j in 0..3 {
                    covariance[i][j] += weight * r[i] * r[j];
                }
            }
        }
        let total: f64 = weights.iter().sum();
        for (i, row) in covariance.iter_mut().enumerate() {
            for v in row.iter_mut() {
                *v /= total;
            }
            row[i] += MIN_SPREAD * MIN_SPREAD;
        }
        Some(Self { surface, whiten: inverse_factor(covariance) })
    }

    /// The colour of the background at a place.
    pub(super) fn color(&self, at: [f64; 2]) -> [f64; 3] {
        color(&self.surface, at)
    }

    /// How far a difference of colours is, in spreads.
    pub(super) fn spreads(&self, difference: [f64; 3]) -> f64 {
        norm(self.whiten.map(|row| row.iter().zip(difference).map(|(w, d)| w * d).sum()))
    }
}

fn color(surface: &[[f64; TERMS]; 3], at: [f64; 2]) -> [f64; 3] {
    let t = terms(at);
    surface.map(|c| c.iter().zip(t).map(|(c, t)| c * t).sum())
}

fn residual(surface: &[[f64; TERMS]; 3], (at, seen): &Sample) -> [f64; 3] {
    let expected = color(surface, *at);
    std::array::from_fn(|i| f64::from(seen[i]) - expected[i])
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn median(values: &mut [f64]) -> f64 {
    let middle = values.len() / 2;
    *values.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// The surface with the least weighted sum of squares, by its normal equations; `bends` damps the terms
/// of second degree.
fn least_squares(samples: &[Sample], weights: &[f64], bends: f64) -> Option<[[f64; TERMS]; 3]> {
    let mut matrix = [[0.0; TERMS + 3]; TERMS];
    for ((at, seen), &weight) in samples.iter().zip(weights) {
        let t = terms(*at);
        for (row, ti) in matrix.iter_mut().zip(t) {
            let ti = weight * ti;
            for (m, tj) in row.iter_mut().zip(t) {
                *m += ti * tj;
            }
            for (m, c) in row[TERMS..].iter_mut().zip(seen) {
                *m += ti * f64::from(*c);
            }
        }
    }
    let total = matrix[0][0];
    for (i, row) in matrix.iter_mut().enumerate().skip(1) {
        row[i] += total * if i < 3 { FREE } else { bends };
    }
    // Gauss and Jordan; positive definite, so that no pivoting is needed.
    for i in 0..TERMS {
        let pivot = matrix[i][i];
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        let row = matrix[i].map(|v| v / pivot);
        for (k, other) in matrix.iter_mut().enumerate() {
            if k == i {
                *other = row;
            } else {
                let factor = other[i];
                for (o, r) in other.iter_mut().zip(row) {
                    *o -= factor * r;
                }
            }
        }
    }
    Some(std::array::from_fn(|c| std::array::from_fn(|t| matrix[t][TERMS + c])))
}

/// The inverse of the lower Cholesky factor of a positive definite matrix.
fn inverse_factor(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let a = m[0][0].sqrt();
    let b = m[1][0] / a;
    let c = (m[1][1] - b * b).sqrt();
    let d = m[2][0] / a;
    let e = (m[2][1] - d * b) / c;
    let f = (m[2][2] - d * d - e * e).sqrt();
    [
        [1.0 / a, 0.0, 0.0],
        [-b / (a * c), 1.0 / c, 0.0],
        [(b * e - c * d) / (a * c * f), -e / (c * f), 1.0 / f],
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples of a frame with a gradient, a share of it hidden by something dark.
    fn samples(hidden: usize) -> Vec<Sample> {
        (0..400)
            .map(|i| {
                let along = f64::from(i % 100) / 50.0 - 1.0;
                let at = [[along, -1.0], [along, 1.0], [-1.0, along], [1.0, along]][i as usize / 100];
                let tree = (i as usize % 100).abs_diff(50) * 2 < hidden;
                let light = 0.8 + 0.1 * at[1] - 0.05 * at[0] * at[0];
                (at, if tree { [0.3, -0.1, 0.1] } else { [light as f32, 0.0, -0.05] })
            })
            .collect()
    }

    #[test]
    fn a_gradient_is_seen_behind_what_hides_a_third_of_it() {
        for hidden in [0, 33] {
            let backdrop = Backdrop::fit(&samples(hidden)).unwrap();
            for at in [[0.0, 0.0], [0.9, -0.4], [-0.9, 0.9]] {
                let [light, _, b] = backdrop.color(at);
                let expected = 0.8 + 0.1 * at[1] - 0.05 * at[0] * at[0];
                assert!((light - expected).abs() < 0.01 && (b + 0.05).abs() < 0.01, "{hidden}: {light}");
            }
        }
        assert!(Backdrop::fit(&samples(0)[..11]).is_none());
    }

    #[test]
    fn what_varies_in_the_background_is_near_to_it() {
        let clouds: Vec<Sample> = samples(0)
            .into_iter()
            .enumerate()
            .map(|(i, (at, _))| (at, [0.8 + 0.02 * ((i * 7) % 11) as f32, 0.0, -0.05]))
            .collect();
        let backdrop = Backdrop::fit(&clouds).unwrap();
        assert!(3.0 * backdrop.spreads([0.1, 0.0, 0.0]) < backdrop.spreads([0.0, -0.1, 0.0]));
        // Without a spread of its own, a background has the eye's.
        let plain: Vec<Sample> = samples(0).into_iter().map(|(at, _)| (at, [0.5, 0.0, 0.0])).collect();
        let backdrop = Backdrop::fit(&plain).unwrap();
        assert!((backdrop.spreads([0.0, 0.06, 0.08]) - 5.0).abs() < 1e-6);
    }

    #[test]
    fn factors_invert() {
        let m = [[4.0, 1.0, 0.5], [1.0, 3.0, -0.2], [0.5, -0.2, 2.0]];
        let w = inverse_factor(m);
        // W M Wᵀ is the identity.
        for i in 0..3 {
            for j in 0..3 {
                let sum: f64 = (0..9).map(|k| w[i][k / 3] * m[k / 3][k % 3] * w[j][k % 3]).sum();
                assert!((sum - f64::from(u8::from(i == j))).abs() < 1e-12);
            }
        }
    }
}
