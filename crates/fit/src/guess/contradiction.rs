//! What in a tree contradicts the goal, however alike the two look.

use pleach_reading::{Reader, Reading};
use pleach_silhouette::Bitmap;

/// Differences up to this size are found between trees of one species …
const FROM: f64 = 1.5;
/// … and those above this one say no more.
const UP_TO: f64 = 4.0;
/// Likeness that a difference of one more is worth; [`super::ranking`] takes a candidate of 0.08 less for e times less
/// probable.
const WORTH: f64 = 0.03;
/// A tree that contradicts the goal by so much more than another one is no start.
pub(super) const NO_START: f64 = 0.05;

/// How much of its likeness a tree with `picture`, and `trunks` where their number is known, is to lose beside a goal that
/// was read as `goal`: 0 where nothing contradicts it.
pub(super) fn contradiction(
    goal: &Reading,
    picture: &Bitmap,
    trunks: Option<u32>,
    reader: &mut Reader,
) -> f64 {
    let mut tree = Reading::default();
    reader.read(picture, &mut tree);
    let differences = goal.differences_from(&tree, trunks);
    let of_species = differences.iter().filter(|one| one.measure.is_of_species());
    of_species.map(|one| WORTH * one.confidence * (one.size.min(UP_TO) - FROM).max(0.0)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Canes beside each other, as wide as `width` of 256 pixels.
    fn canes(count: u32, width: u32) -> Bitmap {
        Bitmap::from_fn(256, 256, |x, y| {
            let (row, crown) = (y > 6 && y < 250, y < 120);
            let cane = (0..count).any(|i| x.abs_diff(128 + 16 * i - 8 * (count - 1)) * 2 < width);
            row && (cane || crown && x.abs_diff(128) < 90 && (x * 7 + y * 5) % 11 < 7)
        })
    }

    #[test]
    fn a_clump_of_canes_contradicts_a_single_trunk() {
        let (mut reader, mut goal) = (Reader::new(), Reading::default());
        reader.read(&canes(1, 10), &mut goal);
        assert!(contradiction(&goal, &canes(1, 11), None, &mut reader) < 1e-9);
        let clump = contradiction(&goal, &canes(8, 6), None, &mut reader);
        assert!(clump > NO_START, "{clump}");
        // Canes that are read as one, of a tree that is known to have more.
        let bundle = contradiction(&goal, &canes(1, 11), Some(9), &mut reader);
        assert!(bundle > NO_START, "{bundle}");
    }
}
