//! Pieces of ink, and holes in them.

use crate::bitmap::Bitmap;
use std::cmp::Reverse;
use std::collections::VecDeque;

/// Visits the pixels of the piece that holds `start`, and marks them in `seen`; diagonal neighbours
/// belong together if `diagonal`.
///
/// Runs of a row wait in a queue, each once: in pictures of hundreds of megapixels, a stack of pixels took gigabytes.
fn flood(
    inside: impl Fn(u32, u32) -> bool,
    start: (u32, u32),
    diagonal: bool,
    seen: &mut Bitmap,
    mut visit: impl FnMut(u32, u32),
) {
    let (width, height) = (seen.width(), seen.height());
    let reach = u32::from(diagonal);
    let mut run = |x: u32, y: u32, seen: &mut Bitmap| {
        let (mut first, mut end) = (x, x + 1);
        while first > 0 && !seen.get(first - 1, y) && inside(first - 1, y) {
            first -= 1;
        }
        while end < width && !seen.get(end, y) && inside(end, y) {
            end += 1;
        }
        for x in first..end {
            seen.set(x, y, true);
            visit(x, y);
        }
        (first, end, y)
    };
    let mut runs = VecDeque::from([run(start.0, start.1, seen)]);
    while let Some((first, end, y)) = runs.pop_front() {
        for row in [y.checked_sub(1), (y + 1 < height).then_some(y + 1)].into_iter().flatten() {
            let mut x = first.saturating_sub(reach);
            while x < (end + reach).min(width) {
                if !seen.get(x, row) && inside(x, row) {
                    let found = run(x, row, seen);
                    runs.push_back(found);
                    x = found.1;
                }
                x += 1;
            }
        }
    }
}

/// The ink without pieces of fewer than `least` pixels.
pub(crate) fn without_specks(ink: &Bitmap, least: u64) -> Bitmap {
    let mut seen = Bitmap::new(ink.width(), ink.height());
    let mut out = ink.clone();
    let mut piece = Vec::new();
    for y in 0..ink.height() {
        for x in ink.ink_in_row(y) {
            if seen.get(x, y) {
                continue;
            }
            piece.clear();
            flood(
                |x, y| ink.get(x, y),
                (x, y),
                true,
                &mut seen,
                |x, y| {
                    // Large ones stay, and need not be remembered.
                    if (piece.len() as u64) < least {
                        piece.push((x, y));
                    }
                },
            );
            if (piece.len() as u64) < least {
                piece.iter().for_each(|&(x, y)| out.set(x, y, false));
            }
        }
    }
    out
}

/// Ink with all that lies within `reach` pixels of it, in rows and columns.
pub(crate) fn widened(ink: &Bitmap, reach: u32) -> Bitmap {
    let (width, height) = (ink.width(), ink.height());
    let mut across = Bitmap::new(width, height);
    for y in 0..height {
        let mut free = 0;
        for x in ink.ink_in_row(y) {
            for x in free.max(x.saturating_sub(reach))..width.min(x + reach + 1) {
                across.set(x, y, true);
            }
            free = x + reach + 1;
        }
    }
    let mut out = Bitmap::new(width, height);
    // The lowest row that a column is set up to.
    let mut free = vec![0; width as usize];
    for y in 0..height {
        for x in across.ink_in_row(y) {
            let set = &mut free[x as usize];
            for y in (*set).max(y.saturating_sub(reach))..height.min(y + reach + 1) {
                out.set(x, y, true);
            }
            *set = y + reach + 1;
        }
    }
    out
}

/// The pieces of `grounds` with ink in them: where the first ink is, in rows from the top, and how much there is.
fn inked(ink: &Bitmap, grounds: &Bitmap) -> Vec<((u32, u32), u64)> {
    let mut seen = Bitmap::new(ink.width(), ink.height());
    let mut found = Vec::new();
    for y in 0..ink.height() {
        for x in ink.ink_in_row(y) {
            if !seen.get(x, y) {
                let mut count = 0;
                let visit = |x, y| count += u64::from(ink.get(x, y));
                flood(|x, y| grounds.get(x, y), (x, y), true, &mut seen, visit);
                found.push(((x, y), count));
            }
        }
    }
    found
}

/// The pieces of ink: where each begins, in rows from the top; its first column and row and its last ones; and its ink.
pub(crate) fn boxes(ink: &Bitmap) -> Vec<((u32, u32), (u32, u32, u32, u32), u64)> {
    let mut seen = Bitmap::new(ink.width(), ink.height());
    let mut found = Vec::new();
    for y in 0..ink.height() {
        for x in ink.ink_in_row(y) {
            if !seen.get(x, y) {
                let (mut around, mut count) = ((x, y, x, y), 0);
                flood(
                    |x, y| ink.get(x, y),
                    (x, y),
                    true,
                    &mut seen,
                    |x, y| {
                        let (left, top, right, bottom) = around;
                        around = (left.min(x), top.min(y), right.max(x), bottom.max(y));
                        count += 1;
                    },
                );
                found.push(((x, y), around, count));
            }
        }
    }
    found
}

/// Of the pieces of `grounds`, the one that holds `start`, or else the one with the most ink: its
/// ink. `None` if `start` lies outside `grounds`, or there is no ink.
pub(crate) fn piece(ink: &Bitmap, grounds: &Bitmap, start: Option<(u32, u32)>) -> Option<Bitmap> {
    let start = match start {
        Some((x, y)) => grounds.get(x, y).then_some((x, y))?,
        // Of equal ones the first.
        None => inked(ink, grounds).into_iter().min_by_key(|(_, count)| Reverse(*count))?.0,
    };
    let size = || Bitmap::new(ink.width(), ink.height());
    let (mut seen, mut out) = (size(), size());
    flood(|x, y| grounds.get(x, y), start, true, &mut seen, |x, y| out.set(x, y, ink.get(x, y)));
    Some(out)
}

/// The ink of all pieces of `grounds` that hold a pixel of `starts`.
pub(crate) fn pieces_at(ink: &Bitmap, grounds: &Bitmap, starts: &Bitmap) -> Bitmap {
    let size = || Bitmap::new(ink.width(), ink.height());
    let (mut seen, mut out) = (size(), size());
    for y in 0..ink.height() {
        for x in starts.ink_in_row(y) {
            if grounds.get(x, y) && !seen.get(x, y) {
                flood(|x, y| grounds.get(x, y), (x, y), true, &mut seen, |x, y| out.set(x, y, ink.get(x, y)));
            }
        }
    }
    out
}

/// Ink of the pieces of `grounds`, most first.
pub(crate) fn sizes(ink: &Bitmap, grounds: &Bitmap) -> Vec<u64> {
    let mut sizes: Vec<u64> = inked(ink, grounds).into_iter().map(|(_, count)| count).collect();
    sizes.sort_unstable_by_key(|&size| Reverse(size));
    sizes
}

/// Makes ink of paper that ink surrounds, where that is at most `most` pixels; returns how many.
pub(crate) fn fill_holes(ink: &mut Bitmap, most: u64) -> u64 {
    if most == 0 {
        return 0;
    }
    let (width, height) = (ink.width(), ink.height());
    let mut seen = ink.clone();
    let mut hole = Vec::new();
    let mut filled = 0;
    for y in 0..height {
        for x in 0..width {
            if seen.get(x, y) {
                continue;
            }
            hole.clear();
            let (mut size, mut open) = (0_u64, false);
            flood(
                |_, _| true,
                (x, y),
                false,
                &mut seen,
                |x, y| {
                    size += 1;
                    open |= x == 0 || y == 0 || x + 1 == width || y + 1 == height;
                    if size <= most {
                        hole.push((x, y));
                    }
                },
            );
            if !open && size <= most {
                hole.iter().for_each(|&(x, y)| ink.set(x, y, true));
                filled += size;
            }
        }
    }
    filled
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn specks_go_and_twigs_stay() {
        let ink = Bitmap::from_ascii("#..#.....\n.#.......\n..#...##.\n......##.");
        let expected = Bitmap::from_ascii("#........\n.#.......\n..#...##.\n......##.");
        assert_eq!(without_specks(&ink, 3), expected);
        assert_eq!(without_specks(&ink, 1), ink);
    }

    #[test]
    fn widening_reaches_as_far_as_it_says() {
        for (reach, spots) in [(0, vec![(3, 4)]), (2, vec![(0, 0), (9, 9), (5, 4)]), (20, vec![(1, 1)])] {
            let ink = Bitmap::from_fn(10, 10, |x, y| spots.contains(&(x, y)));
            let expected = Bitmap::from_fn(10, 10, |x, y| {
                spots.iter().any(|s| s.0.abs_diff(x) <= reach && s.1.abs_diff(y) <= reach)
            });
            assert_eq!(widened(&ink, reach), expected);
        }
    }

    #[test]
    fn near_pieces_belong_together_and_far_ones_do_not() {
        let ink = Bitmap::from_ascii("##.##....#\n##.##.....\n.........#");
        let grounds = widened(&ink, 1);
        let big = Bitmap::from_ascii("##.##.....\n##.##.....\n..........");
        assert_eq!(piece(&ink, &grounds, None), Some(big.clone()));
        assert_eq!(piece(&ink, &grounds, Some((3, 0))), Some(big));
        let small = Bitmap::from_ascii(".........#\n..........\n.........#");
        assert_eq!(piece(&ink, &grounds, Some((9, 2))), Some(small));
        assert_eq!(piece(&ink, &grounds, Some((6, 2))), None);
        assert_eq!(piece(&Bitmap::new(9, 9), &Bitmap::new(9, 9), None), None);
        assert_eq!(sizes(&ink, &grounds), [8, 2]);
        assert_eq!(sizes(&Bitmap::new(9, 9), &Bitmap::new(9, 9)), Vec::<u64>::new());
    }

    #[test]
    fn small_holes_are_filled_and_the_sky_is_not() {
        let mut ink = Bitmap::from_ascii("######\n#.##.#\n####.#\n####..\n.#####");
        assert_eq!(fill_holes(&mut ink, 2), 1);
        assert_eq!(ink, Bitmap::from_ascii("######\n####.#\n####.#\n####..\n.#####"));
        let mut ring = Bitmap::from_ascii("####\n#..#\n####");
        assert_eq!(fill_holes(&mut ring, 1), 0);
        assert_eq!(fill_holes(&mut ring, 0), 0);
        assert_eq!(fill_holes(&mut ring, 2), 2);
    }
}
