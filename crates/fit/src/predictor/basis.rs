//! The directions in which pictures of trees differ most: principal components of features.
//!
//! Pearson 1901. By subspace iteration (Rutishauser 1969), written here since what is learnt has the same bits on every
//! platform.

use crate::posterior::dot;
use rayon::prelude::*;

/// Steps after which directions that matter have long settled.
const STEPS: usize = 60;

/// Features as coordinates along the directions in which they vary most.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Basis {
    /// The mean of each feature.
    pub(super) means: Vec<f64>,
    /// Orthonormal directions, that of the largest variance about first.
    pub(super) directions: Vec<Vec<f64>>,
}

impl Basis {
    /// The `count` main directions of `rows`, which are of one length; fewer if rows are shorter.
    pub(super) fn learn(mut rows: Vec<Vec<f64>>, count: usize) -> Self {
        let width = rows.first().map_or(0, Vec::len);
        let parts = 1.0 / rows.len().max(1) as f64;
        let means: Vec<f64> =
            (0..width).map(|i| rows.iter().map(|row| row[i]).sum::<f64>() * parts).collect();
        rows.par_iter_mut()
            .for_each(|row| row.iter_mut().zip(&means).for_each(|(value, mean)| *value -= mean));
        let columns: Vec<Vec<f64>> =
            (0..width).into_par_iter().map(|i| rows.iter().map(|row| row[i]).collect()).collect();
        let covariance: Vec<Vec<f64>> = columns
            .par_iter()
            .map(|column| columns.iter().map(|other| dot(column, other) * parts).collect())
            .collect();
        // Rows of the unit matrix, each with a little of all others: none is orthogonal to a direction that is wanted.
        let mut directions: Vec<Vec<f64>> = (0..count.min(width))
            .map(|i| (0..width).map(|j| f64::from(i == j) + 1.0 / (1 + i + j) as f64).collect())
            .collect();
        for _ in 0..STEPS {
            orthonormalize(&mut directions);
            directions.par_iter_mut().for_each(|direction| {
                *direction = covariance.iter().map(|row| dot(row, direction)).collect()
            });
        }
        orthonormalize(&mut directions);
        Self { means, directions }
    }

    /// The coordinates of `features`.
    pub(super) fn coordinates(&self, features: &[f64]) -> Vec<f64> {
        let own: Vec<f64> = features.iter().zip(&self.means).map(|(value, mean)| value - mean).collect();
        self.directions.iter().map(|direction| dot(direction, &own)).collect()
    }
}

/// Gram and Schmidt's, in order; directions that depend on earlier ones become zero.
fn orthonormalize(directions: &mut [Vec<f64>]) {
    for i in 0..directions.len() {
        let (done, rest) = directions.split_at_mut(i);
        let own = &mut rest[0];
        let before = dot(own, own);
        for other in done {
            let along = dot(own, other);
            own.iter_mut().zip(other).for_each(|(value, other)| *value -= along * *other);
        }
        let square = dot(own, own);
        let scale = if square > before * TINY { 1.0 / square.sqrt() } else { 0.0 };
        own.iter_mut().for_each(|value| *value *= scale);
    }
}

/// Less than this part of a direction is rounding.
const TINY: f64 = 1e-24;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Stream;

    #[test]
    fn the_directions_are_those_of_the_largest_variance() {
        let rows = (0..3000).map(|row| {
            let mut stream = Stream::at(5, 1, row, 0);
            let [a, b, c] = std::array::from_fn(|_| stream.normal());
            // Along (3, 4, 0) / 5 a deviation of 10, along (-4, 3, 0) / 5 of 3, along z of 0.1.
            vec![6.0 * a - 2.4 * b + 1.0, 8.0 * a + 1.8 * b - 2.0, 0.1 * c]
        });
        let basis = Basis::learn(rows.collect(), 2);
        let [first, second] = &basis.directions[..] else { panic!("{basis:?}") };
        assert!((dot(first, &[0.6, 0.8, 0.0]).abs() - 1.0).abs() < 1e-3, "{first:?}");
        assert!((dot(second, &[-0.8, 0.6, 0.0]).abs() - 1.0).abs() < 1e-3, "{second:?}");
        assert!((basis.means[0] - 1.0).abs() < 0.5 && dot(first, second).abs() < 1e-12);
        let at = basis.coordinates(&[basis.means[0] + 0.6, basis.means[1] + 0.8, basis.means[2]]);
        assert!((at[0].abs() - 1.0).abs() < 1e-3 && at[1].abs() < 1e-2, "{at:?}");
        let flat = Basis::learn(vec![vec![1.0, 2.0]; 4], 5);
        assert_eq!((flat.directions.len(), flat.coordinates(&[4.0, 4.0])), (2, vec![0.0, 0.0]));
    }
}
