//! The strategy's constants: Hansen 2016, Table 1 and equations 49 to 58.

use pleach_tree::math;

/// Weights and learning rates for `dimensions` numbers and a population.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Strategy {
    /// One for each individual from best to worst; the positive ones add up to 1.
    pub(super) weights: Vec<f64>,
    /// Variance effective selection mass of the positive weights.
    pub(super) mass: f64,
    pub(super) c_sigma: f64,
    pub(super) d_sigma: f64,
    pub(super) c_c: f64,
    pub(super) c_1: f64,
    pub(super) c_mu: f64,
    /// Expected length of a standard normal vector.
    pub(super) chi: f64,
}

/// Individuals in a generation for `dimensions` numbers: equation 48.
pub(super) fn population(dimensions: usize) -> usize {
    4 + (3.0 * math::ln(dimensions.max(1) as f64)) as usize
}

impl Strategy {
    pub(super) fn new(dimensions: usize, population: usize) -> Self {
        let n = dimensions.max(1) as f64;
        let middle = math::ln((population as f64 + 1.0) / 2.0);
        let raw: Vec<f64> = (1..=population).map(|i| middle - math::ln(i as f64)).collect();
        let (good, bad) = raw.split_at(population / 2);
        let mass = |part: &[f64]| {
            math::powi(part.iter().sum::<f64>(), 2)
                / part.iter().map(|w| w * w).sum::<f64>().max(f64::MIN_POSITIVE)
        };
        let (mass_good, mass_bad) = (mass(good), mass(bad));
        let c_1 = 2.0 / (math::powi(n + 1.3, 2) + mass_good);
        let c_mu = (2.0 * (0.25 + mass_good + 1.0 / mass_good - 2.0) / (math::powi(n + 2.0, 2) + mass_good))
            .min(1.0 - c_1);
        let c_sigma = (mass_good + 2.0) / (n + mass_good + 5.0);
        let most_bad = (1.0 + c_1 / c_mu)
            .min(1.0 + 2.0 * mass_bad / (mass_good + 2.0))
            .min((1.0 - c_1 - c_mu) / (n * c_mu));
        let positive: f64 = raw.iter().filter(|w| **w > 0.0).sum();
        let negative: f64 = -raw.iter().filter(|w| **w < 0.0).sum::<f64>();
        let weights = raw.iter().map(|w| if *w >= 0.0 { w / positive } else { w * most_bad / negative });
        Self {
            weights: weights.collect(),
            mass: mass_good,
            c_sigma,
            d_sigma: 1.0 + 2.0 * (((mass_good - 1.0) / (n + 1.0)).sqrt() - 1.0).max(0.0) + c_sigma,
            c_c: (4.0 + mass_good / n) / (n + 4.0 + 2.0 * mass_good / n),
            c_1,
            c_mu,
            chi: n.sqrt() * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_what_the_tutorial_says() {
        assert_eq!(population(10), 10);
        let strategy = Strategy::new(10, 10);
        let positive: f64 = strategy.weights.iter().filter(|w| **w > 0.0).sum();
        assert!((positive - 1.0).abs() < 1e-12);
        assert!((strategy.mass - 3.167).abs() < 0.01, "{}", strategy.mass);
        assert!(strategy.weights.windows(2).all(|w| w[0] > w[1]));
        for n in [1, 2, 70] {
            for population in [4, 16, 500] {
                let Strategy { c_1, c_mu, c_sigma, c_c, .. } = Strategy::new(n, population);
                assert!([c_1, c_mu, c_sigma, c_c].iter().all(|c| (0.0..=1.0).contains(c)));
                assert!(c_1 + c_mu <= 1.0);
            }
        }
    }
}
