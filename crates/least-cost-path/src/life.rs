//! How long branches live, and how light favours them.

use crate::numbers::Numbers;
use crate::purpose::LIFE;
use glam::{DVec3, dvec3};
use pleach_tree::Key;
use pleach_tree::trig::sin_cos;

/// How lifespans shrink from one generation to the next.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lifespans {
    /// Chance to end.
    pub(crate) end: f64,
    /// Whether any smaller number may be next, or only the next smaller one.
    pub(crate) any: bool,
}

impl Lifespans {
    /// The lifespan of an endpoint, with the draws of `key`, in the graph of a branch that has `life`
    /// left, at least 1.
    pub(crate) fn next(self, life: u32, key: Key) -> u32 {
        if key.unit(LIFE, 0) < self.end {
            0
        } else if self.any {
            (key.unit(LIFE, 1) * f64::from(life)) as u32
        } else {
            life.saturating_sub(1)
        }
    }
}

/// Light that falls from one direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Light {
    /// Towards the light.
    pub(crate) toward: DVec3,
    /// Half the range of endpoint numbers, over their mean.
    pub(crate) branching: f64,
    /// Largest number taken from lifespans.
    pub(crate) lifespan: u32,
}

/// A branch's share of the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Share {
    /// Taken from its lifespan.
    pub(crate) decrement: u32,
    /// Endpoints.
    pub(crate) count: usize,
}

impl Light {
    pub(crate) fn new(n: &Numbers) -> Option<Self> {
        let (rise, along) = sin_cos(n.light_elevation.to_radians());
        let (y, x) = sin_cos(n.light_azimuth.to_radians());
        let toward = dvec3(along * x, along * y, rise);
        let light = Self { toward, branching: n.light_branching, lifespan: n.light_lifespan as u32 };
        (light.branching > 0.0 || light.lifespan > 0).then_some(light)
    }

    /// Draws lifespans and numbers of endpoints, `count` in the mean, for the branches of a level. The
    /// branch nearest to the light gets the best of each.
    pub(crate) fn shares(&self, directions: &[DVec3], count: usize, key: Key) -> Vec<Share> {
        let all = 0..directions.len() as u32;
        let decrements =
            all.clone().map(|i| (key.unit(0, i) * f64::from(self.lifespan + 1)) as u32).collect();
        let drawn = |i| (count as f64 * (1.0 + self.branching * key.signed(1, i))).round().max(1.0) as usize;
        self.deal(directions, decrements, all.map(drawn).collect())
    }

    fn deal(&self, directions: &[DVec3], mut decrements: Vec<u32>, mut counts: Vec<usize>) -> Vec<Share> {
        decrements.sort_unstable();
        counts.sort_unstable_by(|a, b| b.cmp(a));
        let mut order: Vec<usize> = (0..directions.len()).collect();
        // The nearest first; a stable sort leaves ties in order.
        let toward = |i: usize| directions[i].dot(self.toward);
        order.sort_by(|&a, &b| toward(b).total_cmp(&toward(a)));
        let mut shares = vec![Share { decrement: 0, count: 0 }; directions.len()];
        for (rank, &branch) in order.iter().enumerate() {
            shares[branch] = Share { decrement: decrements[rank], count: counts[rank] };
        }
        shares
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generations_are_as_many_as_expected() {
        let published = [0.0, 1.0, 1.35, 1.548_333, 1.682_208, 1.781_276, 1.858_879];
        let lifespans = Lifespans { end: 0.3, any: true };
        for (life, expected) in published.into_iter().enumerate() {
            let runs = 40_000_u32;
            let mut generations = 0_u32;
            for run in 0..runs {
                let (mut left, mut key) = (life as u32, Key::root(u64::from(run)));
                while left > 0 {
                    generations += 1;
                    key = key.child(0, 0);
                    left = lifespans.next(left, key);
                }
            }
            let mean = f64::from(generations) / f64::from(runs);
            assert!((mean - expected).abs() < 0.02, "{life}: {mean}");
        }
        assert_eq!(Lifespans { end: 0.0, any: false }.next(3, Key::root(1)), 2);
    }

    #[test]
    fn light_is_dealt_out_as_worked_out() {
        let toward = dvec3(1.0, 0.0, 1.0).normalize();
        let branches = [DVec3::Z, dvec3(0.8, 0.0, 0.6), dvec3(-0.6, 0.0, 0.8), DVec3::Y];
        let light = Light { toward, branching: 0.5, lifespan: 3 };
        let shares = light.deal(&branches, vec![3, 1, 2, 1], vec![4, 7, 5, 6]);
        let told: Vec<(u32, usize)> = shares.iter().map(|s| (s.decrement, s.count)).collect();
        assert_eq!(told, [(1, 6), (1, 7), (2, 5), (3, 4)]);
        let many = vec![DVec3::Z; 1000];
        let shares = light.shares(&many, 4, Key::root(2));
        assert!(shares.iter().all(|s| s.decrement <= 3 && (2..=6).contains(&s.count)));
        assert!(shares.iter().any(|s| s.decrement == 3) && shares.iter().any(|s| s.count == 2));
    }
}
