//! Principal components, through `linfa-reduction`.
//!
//! The library's own numbers are used where they are right: mean, axes and singular values. Its
//! explained variance is not (it divides by the number of components less one), so variances come
//! from the singular values, σ² / (n − 1), and are compared with the total variance of the data. No
//! whitening, after which its inverse is wrong. And its decomposition (LOBPCG) is only for a few axes
//! of a large matrix: of fourteen axes of fifteen rows it loses one without a word (explained variance
//! 0.944 of 1). So the matrix is enlarged by rows at the mean and columns of zeros, which change
//! neither axes nor singular values; then 14 axes of the species agree with numpy's to 1e-9.

use crate::error::{BlendError, DecompositionFault};
use linfa::DatasetBase;
use linfa::traits::Fit;
use linfa_reduction::Pca as LinfaPca;
use ndarray::Array2;
use pleach_tree::math;

/// Axes along which rows of numbers vary most, at right angles to each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Pca {
    mean: Vec<f64>,
    axes: Vec<Vec<f64>>,
    variances: Vec<f64>,
    total: f64,
}

/// Most axes that are looked for.
const MAX_AXES: usize = 32;

/// The library's decomposition is right where a matrix has this many rows and columns an axis.
const ROOM: usize = 6;

/// An axis whose variance is below this part of the first one's is rounding error.
const MIN_VARIANCE: f64 = 1e-10;

impl Pca {
    /// Fits all axes, at most one fewer than there are rows, and at most 32. A missing value (`None`) stands at its
    /// column's mean: it adds nothing to any variance or covariance. A column without any value is
    /// all 0.
    ///
    /// The sign of an axis is arbitrary; here its largest loading is positive.
    ///
    /// # Errors
    /// Fewer than two rows, rows that are all alike, or a value that is not finite.
    ///
    /// # Panics
    /// If rows differ in length.
    pub fn fit(rows: &[&[Option<f64>]]) -> Result<Self, BlendError> {
        let (count, width) = (rows.len(), rows.first().map_or(0, |row| row.len()));
        if count < 2 {
            return Err(BlendError::TooFew { found: count });
        }
        let mean: Vec<f64> =
            (0..width).map(|column| mean(rows.iter().filter_map(|row| row[column]))).collect();
        let value = |r: usize, c: usize| rows[r][c].unwrap_or(mean[c]);
        // The library panics at these.
        if mean.iter().any(|v| !v.is_finite()) {
            return Err(BlendError::Decomposition(DecompositionFault::NotFinite));
        }
        let cells = (0..count).flat_map(|r| (0..width).map(move |c| (r, c)));
        let centered: f64 = cells.map(|(r, c)| math::powi(value(r, c) - mean[c], 2)).sum();
        if centered == 0.0 {
            return Err(BlendError::Decomposition(DecompositionFault::AllAlike));
        }
        let wanted = (count - 1).min(width).min(MAX_AXES);
        let room = ROOM * wanted;
        let roomy = Array2::from_shape_fn((count.max(room), width.max(room)), |(r, c)| {
            match (r < count, c < width) {
                (_, false) => 0.0,
                (true, true) => value(r, c) - mean[c],
                (false, true) => 0.0,
            }
        });
        let fitted = LinfaPca::params(wanted)
            .fit(&DatasetBase::from(roomy))
            .map_err(|_| BlendError::Decomposition(DecompositionFault::Solver))?;

        let freedom = (count - 1) as f64;
        let first = fitted.singular_values().first().copied().unwrap_or(0.0);
        let mut axes = Vec::new();
        let mut variances = Vec::new();
        for (axis, &sigma) in fitted.components().rows().into_iter().zip(fitted.singular_values()) {
            if sigma * sigma <= MIN_VARIANCE * first * first {
                break;
            }
            let largest = axis.iter().fold(0.0_f64, |most, &l| if l.abs() > most.abs() { l } else { most });
            let sign = largest.signum();
            axes.push(axis.iter().take(width).map(|l| sign * l).collect());
            variances.push(sigma * sigma / freedom);
        }
        Ok(Self { mean, axes, variances, total: centered / freedom })
    }

    /// The mean of the rows: one number a column.
    #[must_use]
    pub fn mean(&self) -> &[f64] {
        &self.mean
    }

    /// The axes, the longest spread first: unit vectors with one loading a column.
    #[must_use]
    pub fn axes(&self) -> &[Vec<f64>] {
        &self.axes
    }

    /// Variance along each axis, divided by rows less one.
    #[must_use]
    pub fn variances(&self) -> &[f64] {
        &self.variances
    }

    /// The part of the total variance that each axis explains; all together they explain 1.
    #[must_use]
    pub fn explained(&self) -> Vec<f64> {
        self.variances.iter().map(|v| v / self.total).collect()
    }

    /// The coordinate of `row` on axis number `axis`; 0 on an axis that there is not. Missing values
    /// stand at the mean.
    #[must_use]
    pub fn coordinate(&self, axis: usize, row: &[Option<f64>]) -> f64 {
        let Some(loadings) = self.axes.get(axis) else { return 0.0 };
        let terms = row.iter().zip(&self.mean).zip(loadings);
        terms.filter_map(|((value, mean), loading)| value.map(|v| (v - mean) * loading)).sum()
    }

    /// How much column number `column` changes over one unit of axis number `axis`.
    #[must_use]
    pub fn loading(&self, axis: usize, column: usize) -> f64 {
        self.axes.get(axis).map_or(0.0, |axis| axis[column])
    }

    /// The row at these coordinates on the first axes: mean and axes, nothing of the rest.
    #[must_use]
    pub fn back(&self, coordinates: &[f64]) -> Vec<f64> {
        let mut row = self.mean.clone();
        for (axis, coordinate) in self.axes.iter().zip(coordinates) {
            row.iter_mut().zip(axis).for_each(|(value, loading)| *value += coordinate * loading);
        }
        row
    }
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0_f64), |(sum, count), v| (sum + v, count + 1.0));
    sum / count.max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fit(rows: &[Vec<f64>]) -> Pca {
        let rows: Vec<Vec<Option<f64>>> =
            rows.iter().map(|r| r.iter().copied().map(Some).collect()).collect();
        Pca::fit(&rows.iter().map(Vec::as_slice).collect::<Vec<_>>()).unwrap()
    }

    #[test]
    fn four_points_by_hand() {
        // Points (2, 0), (−2, 0), (0, 1), (0, −1), moved by (5, 7) and turned so that the long side
        // lies along (3, 4)/5. Sums of squares 8 and 2, so variances 8/3 and 2/3: 80 % and 20 %.
        let turn = |a: f64, b: f64| vec![5.0 + (3.0 * a - 4.0 * b) / 5.0, 7.0 + (4.0 * a + 3.0 * b) / 5.0];
        let pca = fit(&[turn(2.0, 0.0), turn(-2.0, 0.0), turn(0.0, 1.0), turn(0.0, -1.0)]);
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} is not {b}");
        close(pca.mean()[0], 5.0);
        close(pca.mean()[1], 7.0);
        close(pca.variances()[0], 8.0 / 3.0);
        close(pca.variances()[1], 2.0 / 3.0);
        close(pca.explained()[0], 0.8);
        close(pca.explained()[1], 0.2);
        close(pca.axes()[0][0], 0.6);
        close(pca.axes()[0][1], 0.8);
        close(pca.axes()[1][0], 0.8);
        close(pca.axes()[1][1], -0.6);
        close(pca.coordinate(0, &[Some(8.0), Some(11.0)]), 5.0);
        let back = pca.back(&[5.0, 0.0]);
        close(back[0], 8.0);
        close(back[1], 11.0);
    }

    #[test]
    fn agrees_with_scikit_learn() {
        // scikit-learn 1.9.1, numpy 2.4.6:
        //   x = np.array([[((7*i*i + 3*i*j + 5*j) % 11) / 2 for j in range(5)] for i in range(6)])
        //   p = sklearn.decomposition.PCA().fit(x); p.explained_variance_; p.explained_variance_ratio_;
        //   p.components_ with signs so that the largest is positive. Row 2 is all 3, so the rank is 4.
        let rows: Vec<Vec<f64>> = (0..6_u32)
            .map(|i| (0..5_u32).map(|j| f64::from((7 * i * i + 3 * i * j + 5 * j) % 11) / 2.0).collect())
            .collect();
        let pca = fit(&rows);
        let close = |a: &[f64], b: &[f64]| {
            assert_eq!(a.len(), b.len());
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-10), "{a:?} is not {b:?}");
        };
        close(pca.variances(), &[5.034546734888768, 3.759643434169008, 2.68519989748133, 0.0456099334608945]);
        close(
            &pca.explained(),
            &[0.4368370268883963, 0.32621635003635635, 0.23298914511768587, 0.0039574779575613445],
        );
        close(
            &pca.axes()[0],
            &[
                0.7277119204002247,
                -0.10277377018519496,
                -0.584407504503218,
                0.2065002914768596,
                -0.275133442841163,
            ],
        );
        close(
            &pca.axes()[1],
            &[
                0.034720636458312276,
                0.7492249804289828,
                0.18500092317978886,
                -0.0672135152011986,
                -0.6314375724503927,
            ],
        );
    }

    #[test]
    fn a_missing_value_stands_at_the_mean() {
        let rows = [vec![Some(1.0), Some(4.0)], vec![Some(3.0), None], vec![Some(5.0), Some(8.0)]];
        let missing = Pca::fit(&rows.iter().map(Vec::as_slice).collect::<Vec<_>>()).unwrap();
        assert_eq!(missing, fit(&[vec![1.0, 4.0], vec![3.0, 6.0], vec![5.0, 8.0]]));
        assert_eq!(missing.coordinate(0, &[Some(3.0), None]), 0.0);
    }

    #[test]
    fn few_rows_have_few_axes() {
        let pca = fit(&[vec![0.0, 0.0, 0.0], vec![3.0, 4.0, 0.0]]);
        assert_eq!(pca.axes().len(), 1);
        assert!((pca.explained()[0] - 1.0).abs() < 1e-12);
        assert_eq!(pca.coordinate(1, &[Some(1.0), Some(1.0), Some(1.0)]), 0.0);
        // Three points on a line: the second axis is rounding error and is not kept.
        assert_eq!(fit(&[vec![0.0, 0.0], vec![1.0, 3.0], vec![2.0, 6.0]]).axes().len(), 1);
    }

    #[test]
    fn what_has_no_axes_is_told() {
        let one = [Some(1.0)];
        let nan = [Some(f64::NAN)];
        assert_eq!(Pca::fit(&[&one]), Err(BlendError::TooFew { found: 1 }));
        for (other, fault) in [(&one, DecompositionFault::AllAlike), (&nan, DecompositionFault::NotFinite)] {
            assert_eq!(Pca::fit(&[&one, other]), Err(BlendError::Decomposition(fault)));
        }
    }
}
