//! Recently successful factors and rates.

use crate::space::Stream;
use serde::{Deserialize, Serialize};

/// The success history of Tanabe and Fukunaga 2013, §III: means of the scale factors F and crossover rates CR that
/// made better children, one pair per generation; the oldest is overwritten.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct History {
    factors: Vec<f64>,
    rates: Vec<f64>,
    next: usize,
}

/// A success: the factor, the rate, and by how much the cost fell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Success {
    pub(super) factor: f64,
    pub(super) rate: f64,
    pub(super) gain: f64,
}

/// Spread of the draws around their means, of both numbers.
const SPREAD: f64 = 0.1;

impl History {
    /// `length` pairs of one half, where everything begins.
    pub(super) fn new(length: usize) -> Self {
        let length = length.max(1);
        Self { factors: vec![0.5; length], rates: vec![0.5; length], next: 0 }
    }

    /// Whether this can be a history of `length` pairs.
    pub(super) fn suits(&self, length: usize) -> bool {
        let length = length.max(1);
        let has_mean = |factor: &f64| factor.is_finite() && *factor > 0.0;
        self.next < length
            && (self.factors.len(), self.rates.len()) == (length, length)
            && self.factors.iter().all(has_mean)
    }

    /// A factor in (0, 1], Cauchy, and a rate in 0..=1, normal, around one of the pairs.
    pub(super) fn draw(&self, draws: &mut Stream) -> (f64, f64) {
        let pair = draws.below(self.factors.len());
        let rate = (self.rates[pair] + SPREAD * draws.normal()).clamp(0.0, 1.0);
        loop {
            let factor = self.factors[pair] + SPREAD * draws.cauchy();
            if factor > 0.0 {
                return (factor.min(1.0), rate);
            }
        }
    }

    /// Remembers the means of a generation's successes, weighted by what they gained: Lehmer's mean of
    /// the factors, which favours large ones, and the plain mean of the rates.
    pub(super) fn learn(&mut self, successes: &[Success]) {
        let sum = |of: fn(&Success) -> f64| successes.iter().map(|s| s.gain * of(s)).sum::<f64>();
        let total = sum(|_| 1.0);
        // Trials of equal cost replace their target too, and say nothing about the factors.
        if total > 0.0 {
            self.factors[self.next] = sum(|s| s.factor * s.factor) / sum(|s| s.factor);
            self.rates[self.next] = sum(|s| s.rate) / total;
            self.next = (self.next + 1) % self.factors.len();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_move_to_what_gained_most() {
        let mut history = History::new(1);
        history.learn(&[]);
        assert_eq!(history, History::new(1));
        let success = |factor, rate, gain| Success { factor, rate, gain };
        history.learn(&[success(0.2, 0.1, 1.0), success(0.8, 0.9, 3.0)]);
        assert!((history.rates[0] - 0.7).abs() < 1e-12);
        let lehmer = (0.04 + 3.0 * 0.64) / (0.2 + 3.0 * 0.8);
        assert!((history.factors[0] - lehmer).abs() < 1e-12);
        let mut draws = Stream::at(1, 0, 0, 0);
        for _ in 0..1000 {
            let (factor, rate) = history.draw(&mut draws);
            assert!(factor > 0.0 && factor <= 1.0 && (0.0..=1.0).contains(&rate));
        }
    }
}
