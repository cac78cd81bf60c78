//! Draws of one change.

use pleach_tree::Key;
use pleach_tree::math;

/// Draws of one change, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Draws {
    key: Key,
    drawn: u32,
}

impl Draws {
    pub(super) const fn new(key: Key) -> Self {
        Self { key, drawn: 0 }
    }

    /// A uniform number in [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        let unit = self.key.unit(1, self.drawn);
        self.drawn = self.drawn.wrapping_add(1);
        unit
    }

    /// A uniform number between two.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    pub(super) fn chance(&mut self, chance: f64) -> bool {
        self.unit() < chance
    }

    /// A uniform number in `0..count`; 0 if there is nothing to draw from.
    pub(super) fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count.saturating_sub(1))
    }

    /// One of `list`, if there is one.
    pub(super) fn pick<'a, T>(&mut self, list: &'a [T]) -> Option<&'a T> {
        let number = self.below(list.len());
        list.get(number)
    }

    /// A normal number of mean 0 and variance 1 (Box and Muller 1958).
    pub(super) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * math::ln(1.0 - self.unit())).sqrt();
        radius * math::cos(std::f64::consts::TAU * self.unit())
    }
}

/// `value` to three digits, so that it can be read.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}
