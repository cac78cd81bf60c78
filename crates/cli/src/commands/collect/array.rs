//! Numbers as schedulers take them for arrays of jobs: `3,7-9`.

use std::collections::BTreeSet;

/// The numbers, from 1, of goals at these places, or with `shards` of the shards that they are in.
pub(super) fn numbers(places: impl Iterator<Item = usize>, shards: Option<u32>) -> String {
    let number = |place: usize| 1 + shards.map_or(place, |count| place % count as usize);
    let numbers: BTreeSet<usize> = places.map(number).collect();
    let mut ranges: Vec<(usize, usize)> = Vec::new();
    for number in numbers {
        match ranges.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => ranges.push((number, number)),
        }
    }
    let ranges = ranges.into_iter().map(|(first, last)| match last - first {
        0 => first.to_string(),
        _ => format!("{first}-{last}"),
    });
    ranges.collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_a_range() {
        assert_eq!(numbers([2, 6, 7, 8].into_iter(), None), "3,7-9");
        assert_eq!(numbers([0, 1].into_iter(), None), "1-2");
        assert_eq!(numbers([].into_iter(), None), "");
    }

    #[test]
    fn a_shard_is_named_once() {
        // Of nine goals in four shards, the first, fifth and ninth are in the first.
        assert_eq!(numbers([0, 4, 8, 2].into_iter(), Some(4)), "1,3");
    }
}
