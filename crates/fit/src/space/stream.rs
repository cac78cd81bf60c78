//! Draws for searches: a function of (seed, purpose, round, member) and of the number of draws made there.
//!
//! A search keeps no random generator between generations: its whole random state is the number of the generation.

use pleach_tree::Key;
use pleach_tree::math;

/// The draws for one member of a search.
#[derive(Clone, Debug)]
pub struct Stream {
    key: Key,
    drawn: u32,
}

impl Stream {
    /// The draws for `member` in `round` of the search with this `seed`. Callers number their purposes, so that draws
    /// for different purposes differ.
    #[must_use]
    pub fn at(seed: u64, lane: u32, round: u64, member: u32) -> Self {
        let key = Key::root(seed ^ 0x7365_6172_6368_0000).child(lane, (round >> 32) as u32);
        Self { key: key.child(1, round as u32).child(2, member), drawn: 0 }
    }

    /// 64 uniform bits.
    pub fn bits(&mut self) -> u64 {
        let bits = self.key.bits(0, self.drawn);
        self.drawn = self.drawn.wrapping_add(1);
        bits
    }

    /// A uniform number in [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// A uniform number in [−1, 1).
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// True with the probability `chance`.
    pub fn chance(&mut self, chance: f64) -> bool {
        self.unit() < chance
    }

    /// A uniform number in `0..count`.
    ///
    /// # Panics
    /// If `count` is 0: there is nothing to draw from.
    pub fn below(&mut self, count: usize) -> usize {
        assert!(count > 0, "nothing to draw from");
        // The bias is below count / 2^64.
        ((u128::from(self.bits()) * count as u128) >> 64) as usize
    }

    /// A normal number of mean 0 and variance 1 (Box and Muller 1958; the second is not kept).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * math::ln(1.0 - self.unit())).sqrt();
        radius * math::cos(std::f64::consts::TAU * self.unit())
    }

    /// A Cauchy number of median 0 and scale 1.
    pub fn cauchy(&mut self) -> f64 {
        math::tan(std::f64::consts::PI * (self.unit() - 0.5))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_of_the_address_matters() {
        let first = |seed, lane, round, member| Stream::at(seed, lane, round, member).bits();
        let base = first(1, 2, 3, 4);
        assert_eq!(base, first(1, 2, 3, 4));
        for other in [first(2, 2, 3, 4), first(1, 3, 3, 4), first(1, 2, 4, 4), first(1, 2, 3, 5)] {
            assert_ne!(base, other);
        }
        assert_ne!(first(1, 2, 1 << 32, 0), first(1, 2, 0, 0));
    }

    #[test]
    fn distributions_have_their_moments() {
        let mut stream = Stream::at(5, 0, 0, 0);
        let n = 100_000;
        let normals: Vec<f64> = (0..n).map(|_| stream.normal()).collect();
        let mean = normals.iter().sum::<f64>() / f64::from(n);
        let variance = normals.iter().map(|x| x * x).sum::<f64>() / f64::from(n);
        assert!(mean.abs() < 0.016 && (variance - 1.0).abs() < 0.025, "{mean} {variance}");
        let mut counts = [0_u32; 7];
        for _ in 0..70_000 {
            counts[stream.below(7)] += 1;
        }
        assert!(counts.iter().all(|c| c.abs_diff(10_000) < 500), "{counts:?}");
        // Half of all Cauchy numbers lie in [-1, 1].
        let inside = (0..n).filter(|_| stream.cauchy().abs() <= 1.0).count();
        assert!(inside.abs_diff(50_000) < 800, "{inside}");
    }
}
