//! Ridge regression with the residual that every example would have if it had been left out.
//!
//! Hoerl and Kennard 1970; the residual of a left-out example, e / (1 − h), is exact (Allen 1974, *PRESS*). Written here
//! and not taken from a library, since results have the same bits on every platform.

use rayon::prelude::*;

/// Strengths that are tried, over the number of examples: each target has the one whose left-out residuals are least.
const STRENGTHS: [f64; 7] = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0];
/// Standard deviation below which a column tells nothing.
const LEAST: f64 = 1e-4;

/// A table of numbers, column by column.
#[derive(Clone, Debug)]
pub(crate) struct Columns {
    pub(crate) rows: usize,
    pub(crate) columns: Vec<Vec<f64>>,
}

impl Columns {
    /// The table of `rows`, which are of one length.
    pub(crate) fn from_rows(rows: &[Vec<f64>]) -> Self {
        let width = rows.first().map_or(0, Vec::len);
        let columns = (0..width).map(|column| rows.iter().map(|row| row[column]).collect()).collect();
        Self { rows: rows.len(), columns }
    }
}

/// What was learnt of one target.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    mean: f64,
    weights: Vec<f64>,
    /// Truth minus prediction of every example, as if it had been left out.
    pub(crate) residuals: Vec<f64>,
    /// By how much the squares of the residuals are smaller than those around the mean: at most 1, and 0 where the
    /// features tell nothing.
    pub(crate) explained: f64,
}

/// Targets as linear functions of features.
#[derive(Debug)]
pub(crate) struct Ridge {
    /// Number, mean and scale of every feature that varies.
    scales: Vec<(usize, f64, f64)>,
    pub(crate) targets: Vec<Target>,
    /// Of the features, for distances.
    factor: Option<Cholesky>,
    /// Distance of each example from all others.
    distances: Vec<f64>,
}

impl Ridge {
    /// Learns `targets` from `features`, which have as many rows.
    pub(crate) fn learn(features: Columns, targets: &Columns) -> Self {
        let standard = |(number, mut column): (usize, Vec<f64>)| {
            let (mean, deviation) = moments(&column);
            let scale = (deviation > LEAST).then_some(1.0 / deviation)?;
            column.iter_mut().for_each(|value| *value = (*value - mean) * scale);
            Some(((number, mean, scale), column))
        };
        let rows = features.rows;
        let count = rows as f64;
        let (scales, columns): (Vec<(usize, f64, f64)>, Vec<Vec<f64>>) =
            features.columns.into_iter().enumerate().filter_map(standard).unzip();
        let product =
            |(i, column): (usize, &Vec<f64>)| columns[..=i].iter().map(|c| dot(column, c)).collect();
        let gram: Vec<Vec<f64>> = columns.par_iter().enumerate().map(product).collect();
        let examples: Vec<Vec<f64>> =
            (0..rows).into_par_iter().map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        let centered: Vec<(f64, Vec<f64>)> = targets
            .columns
            .iter()
            .map(|target| {
                let (mean, _) = moments(target);
                (mean, target.iter().map(|value| value - mean).collect())
            })
            .collect();
        let mut best: Vec<Target> = centered
            .iter()
            .map(|(mean, target)| Target {
                mean: *mean,
                weights: vec![0.0; scales.len()],
                residuals: target.clone(),
                explained: 0.0,
            })
            .collect();
        let (mut farness, mut distances) = (None, Vec::new());
        for strength in STRENGTHS {
            let Some(factor) = Cholesky::new(&gram, strength * count) else { continue };
            let leverages: Vec<f64> = examples.par_iter().map(|row| factor.square(row)).collect();
            best.par_iter_mut().zip(&centered).for_each(|(best, (mean, target))| {
                let product: Vec<f64> = columns.iter().map(|column| dot(column, target)).collect();
                let weights = factor.solve(&product);
                let residuals: Vec<f64> = examples
                    .iter()
                    .zip(target.iter().zip(&leverages))
                    // The mean has a share of one part in each as well.
                    .map(|(row, (truth, h))| (truth - dot(row, &weights)) / (1.0 - h - 1.0 / count).max(TINY))
                    .collect();
                let explained = 1.0 - dot(&residuals, &residuals) / dot(target, target).max(TINY);
                if explained > best.explained {
                    *best = Target { mean: *mean, weights, residuals, explained };
                }
            });
            if strength == DISTANCE {
                // As if the example had been left out.
                distances = leverages.iter().map(|h| h / (1.0 - h).max(TINY)).collect();
                farness = Some(factor);
            }
        }
        Self { scales, targets: best, factor: farness, distances }
    }

    /// The prediction of each target for the row `asked` of features.
    pub(crate) fn predict(&self, asked: &[f64]) -> Vec<f64> {
        let asked = self.scaled(asked);
        self.targets.iter().map(|target| target.mean + dot(&asked, &target.weights)).collect()
    }

    /// The prediction of target number `number` as a sum: what it is where every feature is 0, and the weight of each of
    /// the `width` features.
    pub(crate) fn sum(&self, number: usize, width: usize) -> (f64, Vec<f64>) {
        let Target { mean, weights, .. } = &self.targets[number];
        let (mut constant, mut all) = (*mean, vec![0.0; width]);
        for (&(feature, center, scale), weight) in self.scales.iter().zip(weights) {
            all[feature] = weight * scale;
            constant -= weight * scale * center;
        }
        (constant, all)
    }

    /// The share of the examples that are at least as far from all others as `asked` is, in 0..=1: where it is 0,
    /// predictions are extrapolated.
    pub(crate) fn share_as_far(&self, asked: &[f64]) -> f64 {
        let Some(factor) = &self.factor else { return 0.0 };
        let own = factor.square(&self.scaled(asked));
        let farther = self.distances.iter().filter(|&&distance| distance >= own).count();
        farther as f64 / self.distances.len().max(1) as f64
    }

    fn scaled(&self, asked: &[f64]) -> Vec<f64> {
        self.scales.iter().map(|&(number, mean, scale)| (asked[number] - mean) * scale).collect()
    }
}

/// The strength by which distances are measured.
const DISTANCE: f64 = 0.1;

/// Keeps quotients finite.
const TINY: f64 = 1e-12;

/// Mean and standard deviation.
fn moments(values: &[f64]) -> (f64, f64) {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    let variance = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / count;
    (mean, variance.sqrt())
}

/// Σ a b, in eight sums side by side.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let mut lanes = [0.0; LANES];
    let (whole_a, rest_a) = a.as_chunks::<LANES>();
    let (whole_b, rest_b) = b.as_chunks::<LANES>();
    for (a, b) in whole_a.iter().zip(whole_b) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    lanes.iter().sum::<f64>() + rest_a.iter().zip(rest_b).map(|(a, b)| a * b).sum::<f64>()
}

/// The lower triangle L of L Lᵀ = A + strength.
#[derive(Debug)]
struct Cholesky(Vec<Vec<f64>>);

impl Cholesky {
    /// Of the symmetric matrix whose lower triangle is `matrix`; `None` if it is not positive definite.
    fn new(matrix: &[Vec<f64>], strength: f64) -> Option<Self> {
        let width = matrix.len();
        let mut lower: Vec<Vec<f64>> = matrix.to_vec();
        lower.iter_mut().enumerate().for_each(|(i, row)| row[i] += strength);
        for j in 0..width {
            let (done, rest) = lower.split_at_mut(j + 1);
            let row = &mut done[j];
            let square = row[j] - dot(&row[..j], &row[..j]);
            if square.is_nan() || square <= 0.0 {
                return None;
            }
            row[j] = square.sqrt();
            let row = &*row;
            rest.par_iter_mut().with_min_len(32).for_each(|below| {
                below[j] = (below[j] - dot(&below[..j], &row[..j])) / row[j];
            });
        }
        Some(Self(lower))
    }

    /// L⁻¹ b.
    fn forward(&self, b: &[f64]) -> Vec<f64> {
        let mut solved = Vec::with_capacity(b.len());
        for (row, &b) in self.0.iter().zip(b) {
            let i = solved.len();
            solved.push((b - dot(&row[..i], &solved)) / row[i]);
        }
        solved
    }

    /// bᵀ (L Lᵀ)⁻¹ b.
    fn square(&self, b: &[f64]) -> f64 {
        let half = self.forward(b);
        dot(&half, &half)
    }

    /// (L Lᵀ)⁻¹ b.
    fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut solved = self.forward(b);
        for i in (0..solved.len()).rev() {
            let value = solved[i] / self.0[i][i];
            solved[i] = value;
            for (known, &factor) in solved[..i].iter_mut().zip(&self.0[i]) {
                *known -= factor * value;
            }
        }
        solved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Stream;

    /// Rows of three features, of which the first two make the first target, and the second target is noise.
    fn table(rows: usize) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
        (0..rows)
            .map(|row| {
                let mut stream = Stream::at(3, 1, row as u64, 0);
                let x: Vec<f64> = (0..3).map(|_| stream.normal()).collect();
                let clear = 2.0 * x[0] - x[1] + 5.0 + 0.1 * stream.normal();
                (x, vec![clear, stream.normal()])
            })
            .unzip()
    }

    fn learn(features: &[Vec<f64>], targets: &[Vec<f64>]) -> Ridge {
        Ridge::learn(Columns::from_rows(features), &Columns::from_rows(targets))
    }

    #[test]
    fn what_follows_from_the_features_is_found_and_noise_is_not() {
        let (features, targets) = table(400);
        let ridge = learn(&features, &targets);
        let [clear, noise] = &ridge.targets[..] else { panic!() };
        let asked = [1.0, -1.0, 0.3];
        let means = ridge.predict(&asked);
        assert!((means[0] - 8.0).abs() < 0.05 && means[1].abs() < 0.15, "{means:?}");
        assert!(clear.explained > 0.99 && noise.explained < 0.02, "{clear:?} {noise:?}");
        let rms = (dot(&clear.residuals, &clear.residuals) / 400.0).sqrt();
        assert!((0.09..0.11).contains(&rms), "{rms}");
        assert!(ridge.share_as_far(&asked) > 0.2);
        assert_eq!(ridge.share_as_far(&[30.0, 0.0, 0.0]), 0.0);
    }

    #[test]
    fn a_left_out_residual_is_that_of_a_regression_without_the_example() {
        let (features, targets) = table(40);
        let all = learn(&features, &targets);
        for left_out in [0, 17] {
            let without = |rows: &[Vec<f64>]| {
                let others = rows.iter().enumerate().filter(|(i, _)| *i != left_out);
                others.map(|(_, row)| row.clone()).collect::<Vec<_>>()
            };
            let others = learn(&without(&features), &without(&targets));
            let expected = targets[left_out][0] - others.predict(&features[left_out])[0];
            let found = all.targets[0].residuals[left_out];
            // Columns are standardised with it or without it.
            assert!((found - expected).abs() < 0.02, "{found} for {expected}");
        }
    }

    #[test]
    fn features_without_variation_tell_nothing() {
        let targets: Vec<Vec<f64>> = (0..12).map(|i| vec![f64::from(i)]).collect();
        let ridge = learn(&vec![vec![1.0, 2.0]; 12], &targets);
        assert_eq!((ridge.predict(&[1.0, 2.0]), ridge.targets[0].explained), (vec![5.5], 0.0));
    }
}
