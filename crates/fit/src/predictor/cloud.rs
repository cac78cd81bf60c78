//! Where the pictures of trees around one species lie among all pictures.

use super::packed::Packed;
use pleach_tree::math;
use serde::{Deserialize, Serialize};

/// The middle of their coordinates, how far they spread along each, and how far they are from the middle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Cloud {
    middle: Packed,
    spread: Packed,
    /// The distance within which so many percent of them are, from 0 to 100; empty without pictures.
    distances: Vec<f32>,
}

/// Part of the largest spread that every spread has at least: along a direction in which trees hardly differ another
/// picture is not infinitely far away.
const MIN_SPREAD: f64 = 0.02;

impl Cloud {
    pub(super) fn learn(rows: &[Vec<f64>]) -> Self {
        let (width, count) = (rows.first().map_or(0, Vec::len), rows.len() as f64);
        let mean = |of: &dyn Fn(&[f64]) -> f64| rows.iter().map(|row| of(row)).sum::<f64>() / count;
        let middle: Vec<f64> = (0..width).map(|at| mean(&|row| row[at])).collect();
        let middle = Packed::new(&middle);
        // Of what is stored.
        let own: Vec<f64> = middle.numbers().collect();
        let spread = (0..width).map(|at| mean(&|row| square(row[at] - own[at])).sqrt());
        let mut cloud =
            Self { middle, spread: Packed::new(&spread.collect::<Vec<_>>()), distances: Vec::new() };
        let mut distances: Vec<f32> = rows.iter().map(|row| cloud.distance(row) as f32).collect();
        distances.sort_by(f32::total_cmp);
        if let Some(last) = distances.len().checked_sub(1) {
            cloud.distances = (0..=100).map(|percent| distances[last * percent / 100]).collect();
        }
        cloud
    }

    /// Root mean square over all coordinates, in spreads.
    fn distance(&self, row: &[f64]) -> f64 {
        let sum: f64 = self.apart(row).map(|(apart, _)| square(apart)).sum();
        (sum / row.len().max(1) as f64).sqrt()
    }

    /// How far `row` is from the middle along each coordinate, in spreads, and the spread.
    fn apart(&self, row: &[f64]) -> impl Iterator<Item = (f64, f64)> {
        let largest = self.spread.numbers().fold(0.0, f64::max);
        let least = (MIN_SPREAD * largest).max(f64::MIN_POSITIVE);
        row.iter().zip(self.middle.numbers()).zip(self.spread.numbers()).map(move |((at, middle), spread)| {
            let spread = spread.max(least);
            ((at - middle) / spread, spread)
        })
    }

    /// The logarithm of the density of its trees at `row`, as if each coordinate were normal and none depended on
    /// another; up to a constant that is the same for all clouds of that many coordinates.
    pub(super) fn log_density(&self, row: &[f64]) -> f64 {
        -self.apart(row).map(|(apart, spread)| 0.5 * square(apart) + math::ln(spread)).sum::<f64>()
    }

    /// The share of its trees that are at least as far from the middle as `row`.
    pub(super) fn share_as_far(&self, row: &[f64]) -> f64 {
        let own = self.distance(row) as f32;
        let nearer = self.distances.iter().filter(|&&distance| distance < own).count();
        if self.distances.is_empty() { 0.0 } else { 1.0 - nearer as f64 / self.distances.len() as f64 }
    }

    /// Whether it is one of pictures with `width` coordinates.
    pub(super) fn is_of(&self, width: usize) -> bool {
        let of = |one: &Packed| one.len() == width && one.is_finite();
        // Nothing was learnt, and then there are no numbers either.
        let is_empty = self.middle.len() == 0 && self.distances.is_empty();
        is_empty || (of(&self.middle) && of(&self.spread) && self.distances.iter().all(|one| one.is_finite()))
    }
}

fn square(number: f64) -> f64 {
    number * number
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_far_from_all_is_strange() {
        let rows: Vec<Vec<f64>> =
            (0..400).map(|n| vec![f64::from(n % 20), 3.0 + f64::from(n / 20) / 10.0]).collect();
        let cloud = Cloud::learn(&rows);
        assert!(cloud.is_of(2) && !cloud.is_of(3));
        assert!(cloud.share_as_far(&[9.5, 3.95]) > 0.9);
        assert!((0.1..0.9).contains(&cloud.share_as_far(&[3.0, 3.5])));
        assert_eq!(cloud.share_as_far(&[9.5, 8.0]), 0.0);
        let empty = Cloud::learn(&[]);
        assert!(empty.is_of(2));
        assert_eq!(empty.share_as_far(&[0.0, 0.0]), 0.0);
    }
}
