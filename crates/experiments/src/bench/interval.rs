//! Means with intervals.

use pleach_tree::Key;
use std::collections::BTreeMap;

/// Samples of a bootstrap.
const SAMPLES: u32 = 2000;
/// What is left out on either side of an interval that holds nine tenths.
const TAIL: f64 = 0.05;
/// Purpose of the draws.
const DRAWS: u32 = 1;

/// A mean, and the interval that holds it nine times in ten.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) mean: f64,
    pub(super) low: f64,
    pub(super) high: f64,
    /// Of how many values.
    pub(super) count: usize,
}

impl Interval {
    /// Of `values` with the names of their groups; `None` of no values.
    ///
    /// Groups are drawn with replacement, each with all of its values, and the mean of what was drawn is noted (the
    /// cluster bootstrap; Davison and Hinkley 1997, *Bootstrap Methods and their Application*, 3.8): goals of one group
    /// are alike, so they count less than as many that are not. The draws are the same each time.
    pub(super) fn new<'a>(values: impl IntoIterator<Item = (&'a str, f64)>) -> Option<Self> {
        let mut groups: BTreeMap<&str, (f64, usize)> = BTreeMap::new();
        for (group, value) in values {
            let (sum, count) = groups.entry(group).or_default();
            *sum += value;
            *count += 1;
        }
        let groups: Vec<(f64, usize)> = groups.into_values().collect();
        let mean = |drawn: &mut dyn Iterator<Item = (f64, usize)>| {
            let (sum, count) = drawn.fold((0.0, 0), |(sum, all), (one, count)| (sum + one, all + count));
            sum / count as f64
        };
        let count: usize = groups.iter().map(|(_, count)| count).sum();
        if count == 0 {
            return None;
        }
        let key = Key::root(0);
        let sample = |number: u32| {
            let draw = |place: u32| {
                let at = key.child(DRAWS, number).unit(DRAWS, place) * groups.len() as f64;
                groups[(at as usize).min(groups.len() - 1)]
            };
            mean(&mut (0..groups.len() as u32).map(draw))
        };
        let mut means: Vec<f64> = (0..SAMPLES).map(sample).collect();
        means.sort_by(f64::total_cmp);
        let at = |part: f64| means[((part * f64::from(SAMPLES)) as usize).min(means.len() - 1)];
        Some(Self { mean: mean(&mut groups.iter().copied()), low: at(TAIL), high: at(1.0 - TAIL), count })
    }

    /// Half of the width of the interval.
    pub(super) fn half(self) -> f64 {
        (self.high - self.low) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 6] = ["a", "b", "c", "d", "e", "f"];

    #[test]
    fn the_mean_lies_in_an_interval_as_wide_as_the_values_say() {
        // 0 and 1 alternately: the standard error of the mean of sixty is 0.0645, nine tenths are ± 0.106.
        let names: Vec<String> = (0..60).map(|number| number.to_string()).collect();
        let values = || names.iter().enumerate().map(|(at, name)| (name.as_str(), (at % 2) as f64));
        let found = Interval::new(values()).unwrap();
        assert_eq!((found.mean, found.count), (0.5, 60));
        assert!((found.half() - 0.106).abs() < 0.02, "{found:?}");
        assert_eq!(Interval::new(values()), Some(found));
        assert_eq!(Interval::new(std::iter::empty::<(&str, f64)>()), None);
        let one = Interval::new([("a", 0.7)]).unwrap();
        assert_eq!((one.mean, one.low, one.high), (0.7, 0.7, 0.7));
    }

    #[test]
    fn values_of_one_group_count_as_one() {
        let apart: Vec<(&str, f64)> = NAMES.iter().enumerate().map(|(at, name)| (*name, at as f64)).collect();
        let fourfold: Vec<(&str, f64)> = apart.iter().flat_map(|one| [*one; 4]).collect();
        let [one, four] = [&apart, &fourfold].map(|values| Interval::new(values.iter().copied()).unwrap());
        assert_eq!((one.mean, one.low, one.high), (four.mean, four.low, four.high));
        assert_eq!((one.count, four.count), (6, 24));
    }
}
