//! Noise: isolated pixels anywhere, and small pieces far from the tree.

use crate::bitmap::Bitmap;
use crate::pieces::{widened, without_specks};

/// Isolated: at most this many of the 8 neighbors have the same value.
const ALONE: usize = 1;
/// Smallest piece that is kept, in pixels after widening by [`REACH`]: a line of five pixels has 21. Pieces that touch
/// after widening count as one, such as those of a hairline with holes.
const MIN_PIECE: u64 = 20;
const REACH: u32 = 1;
/// Rows without ink between a tree and what is not of it, as a part of the tree's height.
const GAP: f64 = 0.04;
/// What is not of the tree has at most this part of the ink.
const STRAY: f64 = 0.001;

/// `ink` without pixels that differ from almost all around them, specks on the paper and holes in the tree, and
/// without small pieces far from all else. Twigs stay, since their pixels have neighbors; ends of hairlines lose a
/// pixel.
pub(super) fn cleaned(ink: &Bitmap) -> Bitmap {
    let ink = without_lone_pixels(ink);
    let tree = without_specks(&widened(&ink, REACH), MIN_PIECE);
    Bitmap::from_fn(ink.width(), ink.height(), |x, y| ink.get(x, y) && tree.get(x, y))
}

fn without_lone_pixels(ink: &Bitmap) -> Bitmap {
    Bitmap::from_fn(ink.width(), ink.height(), |x, y| {
        let here = ink.get(x, y);
        let (columns, rows) = (
            x.saturating_sub(1)..=(x + 1).min(ink.width() - 1),
            y.saturating_sub(1)..=(y + 1).min(ink.height() - 1),
        );
        let alike =
            rows.flat_map(|y| columns.clone().map(move |x| (x, y))).filter(|&(x, y)| ink.get(x, y) == here);
        // The pixel itself is among them.
        if alike.take(ALONE + 2).count() <= ALONE + 1 { !here } else { here }
    })
}

/// The first and the last row of the tree in `ink`, whose ink lies from row `top` to `bottom`: without a few pixels
/// far above it or far below.
pub(super) fn rows(ink: &Bitmap, top: u32, bottom: u32) -> (u32, u32) {
    let most = (ink.ink() as f64 * STRAY) as usize;
    let of_rows: Vec<usize> = (top..=bottom).map(|y| ink.ink_in_row(y).count()).collect();
    let gap = ((f64::from(bottom - top + 1) * GAP).ceil() as usize).max(2);
    let above = stray(of_rows.iter().copied(), gap, most);
    let below = stray(of_rows.iter().rev().copied(), gap, most);
    (top + above as u32, bottom - below as u32)
}

/// How many rows come before the tree, given the ink in each.
fn stray(rows: impl Iterator<Item = usize>, gap: usize, most: usize) -> usize {
    let (mut ink, mut empty, mut before) = (0, 0, 0);
    for (row, inked) in rows.enumerate() {
        if inked == 0 {
            empty += 1;
            continue;
        }
        if empty >= gap {
            before = row;
        }
        ink += inked;
        if ink > most {
            break;
        }
        empty = 0;
    }
    before
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lone_pixels_and_lone_holes_go_and_twigs_stay() {
        let ink =
            Bitmap::from_ascii("#......\n..###..\n..#.#..\n..###..\n......#\n...#...\n...#...\n...#...");
        let clean =
            Bitmap::from_ascii(".......\n..###..\n..###..\n..###..\n.......\n.......\n...#...\n.......");
        assert_eq!(without_lone_pixels(&ink).to_ascii(), clean.to_ascii());
        assert_eq!(
            without_lone_pixels(&Bitmap::from_ascii("##\n##")).to_ascii(),
            Bitmap::from_ascii("##\n##").to_ascii()
        );
    }

    #[test]
    fn small_pieces_go_unless_they_continue_others() {
        let ink = Bitmap::from_ascii(
            "###.........\n............\n............\n............\n###.#####...\n....#####...\n............",
        );
        let clean = Bitmap::from_ascii(
            "............\n............\n............\n............\n###.#####...\n....#####...\n............",
        );
        let found = cleaned(&ink);
        // The ends of a line are no line.
        assert!(!found.get(1, 0) && found.get(1, 4) && found.get(6, 5));
        assert!(found.differing(&clean) <= 2, "{}", found.to_ascii());
    }

    #[test]
    fn a_few_pixels_far_off_are_not_of_the_tree() {
        let tree = |x: u32, y: u32| (40..60).contains(&x) && (50..150).contains(&y);
        let with =
            |extra: &[(u32, u32)]| Bitmap::from_fn(100, 200, |x, y| tree(x, y) || extra.contains(&(x, y)));
        let found = |extra: &[(u32, u32)]| {
            let ink = with(extra);
            let (_, top, _, bottom) = ink.ink_box().unwrap();
            rows(&ink, top, bottom)
        };
        assert_eq!(found(&[]), (50, 149));
        assert_eq!(found(&[(3, 10)]), (50, 149));
        assert_eq!(found(&[(3, 10), (90, 190)]), (50, 149));
        // A tip that is close, and a piece that is large, are of the tree.
        assert_eq!(found(&[(50, 48)]), (48, 149));
        let piece: Vec<(u32, u32)> = (0..9).map(|i| (45 + i, 30)).collect();
        assert_eq!(found(&piece), (30, 149));
    }
}
