//! The margin that keeps whole numbers moving (Hamano, Saito, Nomura and Shirakawa 2022, §4).
//!
//! A normal distribution that has become narrower than a cell would draw one whole number for ever.
//! So the chance of leaving the cell of the mean is kept above a bound on both sides: by moving the
//! mean where there is a neighbour on one side only, and by scaling the coordinate besides where there
//! are two.

use super::normal::{tail, tail_at};

/// What is corrected: the mean of a coordinate, and the factor on its spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Marginal {
    pub(super) mean: f64,
    pub(super) factor: f64,
}

/// Corrects the marginal distribution of a coordinate whose spread is `spread` times its factor and
/// whose mean lies in `cell`, so that no neighbour has a chance below `alpha`, of two neighbours below
/// half of it each.
pub(super) fn corrected(at: Marginal, spread: f64, cell: (f64, f64), alpha: f64) -> Marginal {
    let Marginal { mean, factor } = at;
    let deviation = spread * factor;
    if deviation.is_nan() || deviation <= 0.0 {
        return at;
    }
    let (low, high) = cell;
    match (low.is_finite(), high.is_finite()) {
        (false, false) => at,
        (true, false) => Marginal { mean: mean.min(low + deviation * tail_at(alpha)), factor },
        (false, true) => Marginal { mean: mean.max(high - deviation * tail_at(alpha)), factor },
        (true, true) => {
            let half = 0.5 * alpha;
            let below = tail((mean - low).max(0.0) / deviation);
            let above = tail((high - mean).max(0.0) / deviation);
            if below >= half && above >= half {
                return at;
            }
            // What the neighbours get, the others give in proportion to what they have too much.
            let raised = [below, above, 1.0 - below - above].map(|p| p.max(half));
            let sum: f64 = raised.iter().sum();
            let slope = (1.0 - sum) / (sum - 3.0 * half);
            let [to_low, to_high] =
                [raised[0], raised[1]].map(|p| tail_at((p + slope * (p - half)).max(half)));
            let reach = to_low + to_high;
            Marginal {
                mean: (low * to_high + high * to_low) / reach,
                factor: (high - low) / (spread * reach),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_keep_their_chance() {
        let alpha = 0.01;
        for (mean, spread) in [(0.5, 1e-3), (0.41, 1e-3), (0.5, 0.05), (0.59, 0.02)] {
            let at = Marginal { mean, factor: 1.0 };
            let Marginal { mean, factor } = corrected(at, spread, (0.4, 0.6), alpha);
            let below = tail((mean - 0.4) / (spread * factor));
            let above = tail((0.6 - mean) / (spread * factor));
            assert!(below.min(above) > 0.5 * alpha - 1e-5, "{mean} {factor}: {below} {above}");
        }
        let end = corrected(Marginal { mean: 0.0, factor: 1.0 }, 1e-3, (f64::NEG_INFINITY, 0.2), alpha);
        assert!((tail((0.2 - end.mean) / 1e-3) - alpha).abs() < 1e-5);
        let wide = Marginal { mean: 0.5, factor: 1.0 };
        assert_eq!(corrected(wide, 0.2, (0.4, 0.6), alpha), wide);
    }
}
