//! A logistic model.

use pleach_plant::math;

/// A probability as a function of numbers.
pub(super) struct Logistic<const N: usize> {
    pub(super) bias: f64,
    /// Of each number its mean, its deviation and its weight.
    pub(super) terms: [[f64; 3]; N],
}

/// Numbers are taken to be at most so many deviations from the mean.
const FARTHEST: f64 = 4.0;

impl<const N: usize> Logistic<N> {
    pub(super) fn probability(&self, numbers: &[f64; N]) -> f64 {
        let term = |(number, [mean, deviation, weight]): (&f64, &[f64; 3])| {
            weight * ((number - mean) / deviation).clamp(-FARTHEST, FARTHEST)
        };
        let sum: f64 = self.bias + numbers.iter().zip(&self.terms).map(term).sum::<f64>();
        1.0 / (1.0 + math::exp(-sum.clamp(-30.0, 30.0)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_probability_grows_with_what_speaks_for_it() {
        let model = Logistic { bias: 0.0, terms: [[1.0, 2.0, 1.0]] };
        assert_eq!(model.probability(&[1.0]), 0.5);
        assert!(model.probability(&[3.0]) > 0.7 && model.probability(&[1e9]) < 1.0);
    }
}
