//! The laws of chance: numbers between −1/2 and 1/2 that are mostly near 0.

use pleach_tree::Key;
use pleach_tree::random::Purpose;

/// How four uniform numbers become one that is bell-shaped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Noise {
    /// The geometric mean of the four less one half, √√(n₁n₂n₃n₄) − 0.5.
    ///
    /// Coffey 2025, Appendix, prints √(√(n₁n₂n₃n₄) − 0.5), which has no value in 94.8 % of draws and is
    /// never negative, and says that it spans (−0.5, 0.5) with its peak around 0. With the bar of the outer
    /// root ending earlier it does. The mean is (4/5)⁴ − 1/2 = −0.0904: parameters come out somewhat
    /// below their nominal values.
    #[default]
    GeometricMean,
    /// The mean of the four less one half: symmetric around 0.
    UniformMean,
}

impl Noise {
    /// Both, in the order of their numbers.
    pub const ALL: [Self; 2] = [Self::GeometricMean, Self::UniformMean];

    /// The name in species files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::GeometricMean => "geometric_mean",
            Self::UniformMean => "uniform_mean",
        }
    }

    /// The draw for `purpose` at `key`, in [−0.5, 0.5).
    #[must_use]
    pub fn draw(self, key: Key, purpose: Purpose) -> f64 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|index| key.unit(purpose, index));
        match self {
            Self::GeometricMean => (a * b * c * d).sqrt().sqrt() - 0.5,
            Self::UniformMean => (a + b + c + d) / 4.0 - 0.5,
        }
    }

    /// A number whose greatest departure from `nominal` is `deviation`.
    pub(crate) fn vary(self, nominal: f64, deviation: f64, key: Key, purpose: Purpose) -> f64 {
        if deviation == 0.0 { nominal } else { nominal + 2.0 * deviation * self.draw(key, purpose) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean, standard deviation, share above 0, least and greatest of many draws.
    fn figures(noise: Noise) -> [f64; 5] {
        let n = 200_000_u32;
        let draws: Vec<f64> = (0..n).map(|i| noise.draw(Key::root(u64::from(i)), 5)).collect();
        let mean = draws.iter().sum::<f64>() / f64::from(n);
        let variance = draws.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(n);
        let above = draws.iter().filter(|x| **x > 0.0).count() as f64 / f64::from(n);
        let (least, most) = draws.iter().fold((1.0_f64, -1.0_f64), |(a, b), &x| (a.min(x), b.max(x)));
        [mean, variance.sqrt(), above, least, most]
    }

    #[test]
    fn the_geometric_mean_leans_below_zero() {
        let [mean, deviation, above, least, most] = figures(Noise::GeometricMean);
        assert!((mean + 0.0904).abs() < 0.002, "{mean}");
        assert!((deviation - 0.172_507).abs() < 0.002, "{deviation}");
        assert!((above - 0.301_97).abs() < 0.005, "{above}");
        assert!((-0.5..-0.45).contains(&least) && (0.4..0.5).contains(&most), "{least} {most}");
    }

    #[test]
    fn the_uniform_mean_is_symmetric() {
        let [mean, deviation, above, least, most] = figures(Noise::UniformMean);
        assert!(mean.abs() < 0.002 && (deviation - 0.144_338).abs() < 0.002, "{mean} {deviation}");
        assert!((above - 0.5).abs() < 0.005, "{above}");
        assert!((-0.5..-0.4).contains(&least) && (0.4..0.5).contains(&most), "{least} {most}");
    }

    #[test]
    fn without_deviation_a_number_is_what_it_is_said_to_be() {
        let key = Key::root(3);
        assert_eq!(Noise::GeometricMean.vary(0.7, 0.0, key, 1), 0.7);
        let varied = Noise::GeometricMean.vary(0.7, 0.1, key, 1);
        assert!(varied != 0.7 && (0.6..0.8).contains(&varied), "{varied}");
    }
}
