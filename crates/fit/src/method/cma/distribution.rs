//! The normal distribution, and how a generation moves it (Hansen 2016, §3 and appendix A).

use super::eigen::eigen;
use super::margin::{Marginal, corrected};
use super::strategy::Strategy;
use pleach_tree::math;
use serde::{Deserialize, Serialize};

/// Mean m, step σ, covariance C and the factors A that the margin has put on coordinates: a sample is
/// m + σ A B D z, where C = B D² Bᵀ and z is standard normal. Matrices are lists of rows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Distribution {
    pub(super) mean: Vec<f64>,
    pub(super) sigma: f64,
    factors: Vec<f64>,
    covariance: Vec<f64>,
    basis: Vec<f64>,
    roots: Vec<f64>,
    path_sigma: Vec<f64>,
    path_c: Vec<f64>,
    generation: u64,
    /// The generation of which the basis and the roots are.
    decomposed: u64,
}

/// σ is at most this, in widths of the unit cube.
const WIDEST: f64 = 1.0;
/// The step in every direction, and the quotient of the longest and the shortest, beyond which a
/// search has ended.
const MIN_STEP: f64 = 1e-9;
const MAX_CONDITION: f64 = 1e7;

impl Distribution {
    /// A ball around `mean`.
    pub(super) fn new(mean: Vec<f64>, sigma: f64) -> Self {
        let n = mean.len();
        let mut unit = vec![0.0; n * n];
        (0..n).for_each(|i| unit[i * n + i] = 1.0);
        Self {
            mean,
            sigma,
            factors: vec![1.0; n],
            covariance: unit.clone(),
            basis: unit,
            roots: vec![1.0; n],
            path_sigma: vec![0.0; n],
            path_c: vec![0.0; n],
            generation: 0,
            decomposed: 0,
        }
    }

    /// Whether this can be a distribution over `n` numbers that has learnt from at most `generations`.
    pub(super) fn suits(&self, n: usize, generations: u64) -> bool {
        let vectors = [&self.mean, &self.factors, &self.roots, &self.path_sigma, &self.path_c];
        let matrices = [&self.covariance, &self.basis];
        vectors.iter().all(|vector| vector.len() == n)
            && matrices.iter().all(|matrix| matrix.len() == n * n)
            && vectors.into_iter().chain(matrices).flatten().all(|number| number.is_finite())
            && self.sigma.is_finite()
            && self.decomposed <= self.generation
            && self.generation <= generations
    }

    /// B D z: the step of the standard normal `z` before σ and A.
    fn step(&self, z: &[f64]) -> Vec<f64> {
        let scaled: Vec<f64> = z.iter().zip(&self.roots).map(|(z, root)| z * root).collect();
        turned(&self.basis, &scaled)
    }

    /// The sample of `z`.
    pub(super) fn sample(&self, z: &[f64]) -> Vec<f64> {
        let step = self.step(z).into_iter().zip(&self.factors);
        step.zip(&self.mean).map(|((y, factor), mean)| mean + self.sigma * factor * y).collect()
    }

    /// Learns from samples by their `zs`, best first; the last `failed` of them have no cost.
    pub(super) fn learn(&mut self, zs: &[&[f64]], failed: usize, strategy: &Strategy) {
        let n = self.mean.len();
        let weights = weights(strategy, zs.len() - failed);
        let steps: Vec<Vec<f64>> = zs.iter().map(|z| self.step(z)).collect();
        let mut mean_step = vec![0.0; n];
        let mut mean_z = vec![0.0; n];
        for (i, weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
            for j in 0..n {
                mean_step[j] += weight * steps[i][j];
                mean_z[j] += weight * zs[i][j];
            }
        }
        for ((mean, factor), step) in self.mean.iter_mut().zip(&self.factors).zip(&mean_step) {
            *mean += self.sigma * factor * step;
        }

        self.generation += 1;
        let Strategy { mass, c_sigma, d_sigma, c_c, c_1, c_mu, chi, .. } = *strategy;
        let gain = (c_sigma * (2.0 - c_sigma) * mass).sqrt();
        for (path, new) in self.path_sigma.iter_mut().zip(turned(&self.basis, &mean_z)) {
            *path = (1.0 - c_sigma) * *path + gain * new;
        }
        let length = self.path_sigma.iter().map(|p| p * p).sum::<f64>().sqrt();
        let age = 2.0 * self.generation as f64;
        let settled = (1.0 - math::pow(1.0 - c_sigma, age)).sqrt();
        let is_steady = length / settled < (1.4 + 2.0 / (n as f64 + 1.0)) * chi;
        let gain = if is_steady { (c_c * (2.0 - c_c) * mass).sqrt() } else { 0.0 };
        for (path, new) in self.path_c.iter_mut().zip(&mean_step) {
            *path = (1.0 - c_c) * *path + gain * new;
        }
        self.sigma = (self.sigma * math::exp(c_sigma / d_sigma * (length / chi - 1.0))).min(WIDEST);

        // A path that was held back is made up for.
        let held = if is_steady { 0.0 } else { c_1 * c_c * (2.0 - c_c) };
        let keep = 1.0 + held - c_1 - c_mu * weights.iter().sum::<f64>();
        let outer = |matrix: &mut [f64], weight: f64, y: &[f64]| {
            for (row, a) in matrix.chunks_exact_mut(n).zip(y) {
                row.iter_mut().zip(y).for_each(|(c, b)| *c += weight * a * b);
            }
        };
        self.covariance.iter_mut().for_each(|c| *c *= keep);
        if n > 0 {
            outer(&mut self.covariance, c_1, &self.path_c);
        }
        for ((weight, y), z) in weights.iter().zip(&steps).zip(zs).filter(|((w, _), _)| **w != 0.0) {
            let squares: f64 = z.iter().map(|z| z * z).sum();
            let weight = if *weight < 0.0 { weight * n as f64 / squares.max(1e-12) } else { *weight };
            outer(&mut self.covariance, c_mu * weight, y);
        }
        // The basis changes slowly: decomposing it again every few generations is enough (appendix B.2).
        let often = 0.5 / (n.max(1) as f64 * (c_1 + c_mu));
        if (self.generation - self.decomposed) as f64 > often {
            self.decompose();
        }
    }

    fn decompose(&mut self) {
        self.decomposed = self.generation;
        let Some((values, vectors)) = eigen(&self.covariance, &self.basis, self.mean.len()) else {
            return self.forget_covariance();
        };
        self.roots = values.iter().map(|value| value.sqrt()).collect();
        self.basis = vectors;
    }

    /// Back to a ball: rounding has made the matrix useless.
    fn forget_covariance(&mut self) {
        let ball = Self::new(std::mem::take(&mut self.mean), self.sigma);
        let Self { generation, decomposed, .. } = *self;
        *self = Self { generation, decomposed, ..ball };
    }

    /// Keeps a chance of `alpha` for the neighbours of whole numbers; `cell` gives the cell in which a
    /// coordinate lies.
    pub(super) fn keep_margin(&mut self, alpha: f64, cell: impl Fn(usize, f64) -> Option<(f64, f64)>) {
        let n = self.mean.len();
        for j in 0..n {
            if let Some(cell) = cell(j, self.mean[j]) {
                let spread = self.sigma * self.covariance[j * n + j].max(0.0).sqrt();
                let at = Marginal { mean: self.mean[j], factor: self.factors[j] };
                let Marginal { mean, factor } = corrected(at, spread, cell, alpha);
                self.mean[j] = mean;
                self.factors[j] = factor;
            }
        }
    }

    /// Whether there is nothing to be gained any more: the steps have become too short, or the
    /// ellipsoid too thin for its numbers.
    pub(super) fn is_spent(&self) -> bool {
        let longest = self.roots.iter().copied().fold(0.0, f64::max);
        let shortest = self.roots.iter().copied().fold(f64::INFINITY, f64::min);
        let is_fine = self.sigma * longest > MIN_STEP && longest < MAX_CONDITION * shortest;
        !self.roots.is_empty() && !is_fine
    }
}

/// The weights of a generation of which the best `grown` have a cost: the others count as bad ones but
/// never as good ones.
fn weights(strategy: &Strategy, grown: usize) -> Vec<f64> {
    let mut weights = strategy.weights.clone();
    let good: f64 = weights.iter().take(grown).filter(|w| **w > 0.0).sum();
    for (i, weight) in weights.iter_mut().enumerate().filter(|(_, weight)| **weight > 0.0) {
        *weight = if i < grown && good > 0.0 { *weight / good } else { 0.0 };
    }
    weights
}

/// The product of a square matrix and `vector`.
fn turned(matrix: &[f64], vector: &[f64]) -> Vec<f64> {
    let rows = matrix.chunks_exact(vector.len().max(1));
    rows.map(|row| row.iter().zip(vector).map(|(b, v)| b * v).sum()).collect()
}
