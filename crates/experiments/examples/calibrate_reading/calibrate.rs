//! Logistic models, fitted by ridge regression.

use pleach_tree::math;
use std::fmt::Write as _;

/// Numbers, whether it is so, and the weight of the sample.
pub(super) type Sample = (Vec<f64>, f64, f64);

const RIDGE: f64 = 10.0;
/// Nothing that was measured is more certain than this.
const CERTAIN: f64 = 0.98;
/// As in the crate's models.
const FARTHEST: f64 = 4.0;

pub(super) struct Model {
    /// Mean and deviation of each number.
    scale: Vec<[f64; 2]>,
    /// The bias, then one per number.
    weights: Vec<f64>,
}

impl Model {
    /// The model for these samples, by Newton's method.
    pub(super) fn fit(samples: &[Sample]) -> Self {
        let count = samples[0].0.len();
        let all: f64 = samples.iter().map(|sample| sample.2).sum();
        let scale = (0..count)
            .map(|i| {
                let mean = samples.iter().map(|s| s.2 * s.0[i]).sum::<f64>() / all;
                let square =
                    samples.iter().map(|s| s.2 * (s.0[i] - mean) * (s.0[i] - mean)).sum::<f64>() / all;
                [rounded(mean), rounded(square.sqrt()).max(0.0001)]
            })
            .collect();
        let mut model = Self { scale, weights: vec![0.0; count + 1] };
        for _ in 0..40 {
            let mut matrix = vec![vec![0.0; count + 2]; count + 1];
            for (numbers, is_so, weight) in samples {
                let row = model.row(numbers);
                let p = logistic(row.iter().zip(&model.weights).map(|(a, b)| a * b).sum());
                let goal = 1.0 - CERTAIN + (2.0 * CERTAIN - 1.0) * is_so;
                let curve = weight * (p * (1.0 - p) + 1e-6);
                for (equation, own) in matrix.iter_mut().zip(&row) {
                    equation.iter_mut().zip(&row).for_each(|(to, other)| *to += curve * own * other);
                    equation[count + 1] += weight * (p - goal) * own;
                }
            }
            for (i, equation) in matrix.iter_mut().enumerate().skip(1) {
                equation[i] += RIDGE;
                equation[count + 1] += RIDGE * model.weights[i];
            }
            for (weight, step) in model.weights.iter_mut().zip(solve(matrix)) {
                *weight -= step;
            }
        }
        model
    }

    fn row(&self, numbers: &[f64]) -> Vec<f64> {
        let scaled = numbers.iter().zip(&self.scale);
        let scaled = scaled.map(|(number, [mean, dev])| ((number - mean) / dev).clamp(-FARTHEST, FARTHEST));
        std::iter::once(1.0).chain(scaled).collect()
    }

    pub(super) fn probability(&self, numbers: &[f64]) -> f64 {
        logistic(self.row(numbers).iter().zip(&self.weights).map(|(a, b)| a * b).sum())
    }

    /// The model as a constant in Rust.
    pub(super) fn source(&self, name: &str, what: &str) -> String {
        let count = self.scale.len();
        let mut text = format!(
            "\n/// {what}\npub(super) const {name}: Logistic<{count}> = Logistic {{\n    bias: {:.4},\n    terms: [\n",
            self.weights[0]
        );
        for ([mean, dev], weight) in self.scale.iter().zip(&self.weights[1..]) {
            let _ = writeln!(text, "        [{mean:.4}, {dev:.4}, {weight:.4}],");
        }
        text + "    ],\n};\n"
    }
}

fn rounded(number: f64) -> f64 {
    (number * 10_000.0).round() / 10_000.0
}

fn logistic(sum: f64) -> f64 {
    1.0 / (1.0 + math::exp(-sum.clamp(-30.0, 30.0)))
}

/// Solves linear equations, the right side of which is the last column (Gauss's elimination; no pivots, since the
/// matrix is positive definite).
fn solve(mut matrix: Vec<Vec<f64>>) -> Vec<f64> {
    let count = matrix.len();
    for i in 0..count {
        let pivot = matrix[i].clone();
        for row in &mut matrix[i + 1..] {
            let factor = row[i] / pivot[i];
            row.iter_mut().zip(&pivot).skip(i).for_each(|(to, from)| *to -= factor * from);
        }
    }
    let mut found = vec![0.0; count];
    for i in (0..count).rev() {
        let known: f64 = (i + 1..count).map(|j| matrix[i][j] * found[j]).sum();
        found[i] = (matrix[i][count] - known) / matrix[i][i];
    }
    found
}
