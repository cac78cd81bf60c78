//! How many branches grow from each of a trunk's three segments (Lorite 2021, §3.5.4, Appendix B).

use pleach_tree::Key;

/// Most branches of a segment.
pub(super) const MAX_OF_SEGMENT: u32 = 4;
/// Segments of a trunk, the top one first: most branches grow there.
pub(super) const SEGMENTS: u32 = 3;
/// Most branches of a trunk.
pub(super) const MAX_OF_TRUNK: u32 = SEGMENTS * MAX_OF_SEGMENT;

/// The numbers that the next segment may have when `rest` branches are left and `after` segments follow.
///
/// The report draws from 1 to 4 until it meets one of them; drawing among them is the same.
fn allowed(rest: u32, after: u32) -> std::ops::RangeInclusive<u32> {
    rest.saturating_sub(MAX_OF_SEGMENT * after).max(1)..=rest.min(MAX_OF_SEGMENT)
}

/// The branches of each segment, the top one first, where a trunk has `count`, at most
/// [`MAX_OF_TRUNK`]. Draws index 0 to 2 of `purpose`.
pub(super) fn deal(count: u32, key: Key, purpose: u32) -> [u32; SEGMENTS as usize] {
    let mut dealt = [0; SEGMENTS as usize];
    let mut rest = count;
    for segment in 0..SEGMENTS {
        if rest == 0 {
            break;
        }
        let allowed = allowed(rest, SEGMENTS - 1 - segment);
        let (least, most) = (*allowed.start(), *allowed.end());
        let drawn = least + (key.unit(purpose, segment) * f64::from(most - least + 1)) as u32;
        dealt[segment as usize] = drawn;
        rest -= drawn;
    }
    dealt
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every outcome with one over its chance.
    fn outcomes(count: u32) -> Vec<(Vec<u32>, u32)> {
        let mut found = Vec::new();
        fn go(rest: u32, after: u32, so_far: &[u32], odds: u32, found: &mut Vec<(Vec<u32>, u32)>) {
            if rest == 0 {
                found.push((so_far.to_vec(), odds));
                return;
            }
            let choices: Vec<u32> = allowed(rest, after).collect();
            for &n in &choices {
                let next: Vec<u32> = so_far.iter().copied().chain([n]).collect();
                go(rest - n, after.wrapping_sub(1), &next, odds * choices.len() as u32, found);
            }
        }
        go(count, SEGMENTS - 1, &[], 1, &mut found);
        found
    }

    #[test]
    fn chances_are_those_of_the_loop_in_the_appendix() {
        let expected: [(u32, &[(&[u32], u32)]); 4] = [
            (2, &[(&[1, 1], 2), (&[2], 2)]),
            (
                5,
                &[
                    (&[1, 1, 3], 16),
                    (&[1, 2, 2], 16),
                    (&[1, 3, 1], 16),
                    (&[1, 4], 16),
                    (&[2, 1, 2], 12),
                    (&[2, 2, 1], 12),
                    (&[2, 3], 12),
                    (&[3, 1, 1], 8),
                    (&[3, 2], 8),
                    (&[4, 1], 4),
                ],
            ),
            (
                9,
                &[
                    (&[1, 4, 4], 4),
                    (&[2, 3, 4], 8),
                    (&[2, 4, 3], 8),
                    (&[3, 2, 4], 12),
                    (&[3, 3, 3], 12),
                    (&[3, 4, 2], 12),
                    (&[4, 1, 4], 16),
                    (&[4, 2, 3], 16),
                    (&[4, 3, 2], 16),
                    (&[4, 4, 1], 16),
                ],
            ),
            (12, &[(&[4, 4, 4], 1)]),
        ];
        for (count, expected) in expected {
            let expected: Vec<(Vec<u32>, u32)> =
                expected.iter().map(|(dealt, odds)| (dealt.to_vec(), *odds)).collect();
            assert_eq!(outcomes(count), expected);
        }
    }

    #[test]
    fn every_branch_is_dealt_and_means_are_those_of_the_loop() {
        for (count, means) in [(4, [2.5, 1.125, 0.375]), (7, [2.5, 2.5, 2.0]), (9, [2.5, 3.25, 3.25])] {
            let n = 20_000;
            let mut sums = [0.0; 3];
            for seed in 0..n {
                let dealt = deal(count, Key::root(seed), 0);
                assert_eq!(dealt.iter().sum::<u32>(), count);
                assert!(dealt.iter().all(|&d| d <= MAX_OF_SEGMENT));
                (0..3).for_each(|i| sums[i] += f64::from(dealt[i]));
            }
            let found = sums.map(|sum| sum / n as f64);
            assert!((0..3).all(|i| (found[i] - means[i]).abs() < 0.05), "{count}: {found:?}");
        }
    }
}
