//! Eigenvalues and eigenvectors of a covariance, by plain arithmetic alone, so that they are the same bits on every
//! processor.
//!
//! Jacobi's method, cyclic by rows (Golub and Van Loan 2013, *Matrix Computations*, §8.5). From one generation to
//! another the basis changes little: in the former one the matrix is nearly diagonal, and a few sweeps are enough.

/// Sweeps after which it gives up; from any start it takes about ten.
const MAX_SWEEPS: usize = 60;
/// An entry beside the diagonal that is at most this part of its two diagonal entries' geometric mean is zero.
const ZERO: f64 = 1e-15;

/// The eigenvalues of the symmetric `matrix` of `n` rows, and its eigenvectors as the columns of a matrix. `basis` is
/// any orthonormal matrix; the nearer it is to the eigenvectors, the sooner they are found.
///
/// `None` where a number is not finite, or an eigenvalue not above zero.
pub(super) fn eigen(matrix: &[f64], basis: &[f64], n: usize) -> Option<(Vec<f64>, Vec<f64>)> {
    // Rows are next to each other in memory, so the vectors are turned as rows.
    let mut vectors = transposed(basis, n);
    let half = product(&vectors, matrix, n);
    let mut turned = product(&half, basis, n);
    for _ in 0..MAX_SWEEPS {
        let mut has_ended = true;
        for p in 0..n {
            for q in p + 1..n {
                let (a, b, c) = (turned[p * n + p], turned[q * n + q], turned[p * n + q]);
                if !(a > 0.0 && b > 0.0 && c.is_finite()) {
                    return None;
                }
                if c.abs() <= ZERO * (a * b).sqrt() {
                    continue;
                }
                has_ended = false;
                let (cosine, sine) = rotation(a, b, c);
                rotate_rows(&mut turned, n, (p, q), (cosine, sine));
                rotate_columns(&mut turned, n, (p, q), (cosine, sine));
                (turned[p * n + q], turned[q * n + p]) = (0.0, 0.0);
                rotate_rows(&mut vectors, n, (p, q), (cosine, sine));
            }
        }
        if has_ended {
            let values: Vec<f64> = (0..n).map(|i| turned[i * n + i]).collect();
            let is_usable = values.iter().all(|value| *value > 0.0 && value.is_finite());
            return is_usable.then(|| (values, transposed(&vectors, n)));
        }
    }
    None
}

/// Cosine and sine of the rotation that makes the entry `c` between the diagonal entries `a` and `b` zero, the smaller
/// of the two.
fn rotation(a: f64, b: f64, c: f64) -> (f64, f64) {
    let tau = (b - a) / (2.0 * c);
    let tangent = 1.0 / (tau.abs() + (1.0 + tau * tau).sqrt());
    let tangent = if tau < 0.0 { -tangent } else { tangent };
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    (cosine, tangent * cosine)
}

fn rotate_rows(matrix: &mut [f64], n: usize, (p, q): (usize, usize), (cosine, sine): (f64, f64)) {
    let (upper, lower) = matrix.split_at_mut(q * n);
    for (x, y) in upper[p * n..(p + 1) * n].iter_mut().zip(&mut lower[..n]) {
        (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
    }
}

fn rotate_columns(matrix: &mut [f64], n: usize, (p, q): (usize, usize), (cosine, sine): (f64, f64)) {
    for row in matrix.chunks_exact_mut(n) {
        (row[p], row[q]) = (cosine * row[p] - sine * row[q], sine * row[p] + cosine * row[q]);
    }
}

fn transposed(matrix: &[f64], n: usize) -> Vec<f64> {
    (0..n * n).map(|at| matrix[at % n * n + at / n]).collect()
}

fn product(left: &[f64], right: &[f64], n: usize) -> Vec<f64> {
    let mut product = vec![0.0; n * n];
    for (row, factors) in product.chunks_exact_mut(n.max(1)).zip(left.chunks_exact(n.max(1))) {
        for (factor, other) in factors.iter().zip(right.chunks_exact(n)) {
            row.iter_mut().zip(other).for_each(|(sum, value)| *sum += factor * value);
        }
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Stream;

    fn identity(n: usize) -> Vec<f64> {
        (0..n * n).map(|at| f64::from(u8::from(at % n == at / n))).collect()
    }

    /// A covariance of `n` numbers whose scales differ by up to `10^digits`.
    fn covariance(n: usize, digits: i32) -> Vec<f64> {
        let mut draws = Stream::at(5, 0, 0, 0);
        let rows: Vec<f64> = (0..n * n).map(|_| draws.normal()).collect();
        let mut matrix = product(&rows, &transposed(&rows, n), n);
        for (at, entry) in matrix.iter_mut().enumerate() {
            let scale = |i: usize| pleach_tree::math::pow(10.0, f64::from(digits) * i as f64 / n as f64);
            *entry *= scale(at / n) * scale(at % n);
        }
        matrix
    }

    #[test]
    fn vectors_are_orthonormal_and_put_the_matrix_together_again() {
        for (n, digits) in [(1, 0), (2, 0), (7, 3), (40, 0), (87, 2)] {
            let matrix = covariance(n, digits);
            let (values, vectors) = eigen(&matrix, &identity(n), n).unwrap();
            let unit = product(&transposed(&vectors, n), &vectors, n);
            assert!(unit.iter().zip(identity(n)).all(|(a, b)| (a - b).abs() < 1e-12), "{n}");
            let scaled: Vec<f64> =
                vectors.iter().enumerate().map(|(at, entry)| entry * values[at % n]).collect();
            let again = product(&scaled, &transposed(&vectors, n), n);
            let size = values.iter().copied().fold(0.0, f64::max);
            assert!(again.iter().zip(&matrix).all(|(a, b)| (a - b).abs() < 1e-12 * size), "{n}");
            // From its own vectors it finds the same values.
            let (same, _) = eigen(&matrix, &vectors, n).unwrap();
            assert!(same.iter().zip(&values).all(|(a, b)| (a - b).abs() < 1e-12 * size), "{n}");
        }
        assert_eq!(eigen(&[], &[], 0), Some((Vec::new(), Vec::new())));
    }

    #[test]
    fn what_is_no_covariance_is_refused() {
        for matrix in [[1.0, 2.0, 2.0, 1.0], [1.0, f64::NAN, f64::NAN, 1.0], [0.0, 0.0, 0.0, 1.0]] {
            assert_eq!(eigen(&matrix, &identity(2), 2), None, "{matrix:?}");
        }
        assert_eq!(eigen(&[-1.0], &[1.0], 1), None);
    }
}
