//! Where a tree stands in its picture: ground row and axis column.

use crate::bitmap::Bitmap;

/// Where a place came from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// Read off the ink.
    Detected,
    /// Read off the ink, and moved to the picture's bottom edge or middle, since it was close to it.
    Snapped,
    /// Set by hand.
    Given,
}

/// Part of the picture's size within which a place snaps to the bottom edge or the middle.
const SNAP: f64 = 0.02;
/// Part of the tree's height above the ground in which the trunk is looked for.
const FOOT: f64 = 0.05;
/// Part of the foot's rows that a column of the trunk has ink in.
const SUPPORT: f64 = 0.7;
/// Widest gap within a clump of stems, as a part of the wider stem beside it.
const GAP: f64 = 0.25;

/// Whether places that are close to the picture's bottom edge or its middle are taken to be there: where the
/// picture's own margins mean something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Snapping {
    On,
    Off,
}

/// Ground row in pixels from the top: the bottom edge of the lowest ink, or, with snapping, of the picture if that
/// is within 2 % of its height.
pub(super) fn ground(ink: &Bitmap, ink_bottom: u32, snapping: Snapping) -> (f64, Origin) {
    let (found, edge) = (f64::from(ink_bottom) + 1.0, f64::from(ink.height()));
    let snaps = snapping == Snapping::On && edge - found <= SNAP * edge;
    if snaps { (edge, Origin::Snapped) } else { (found, Origin::Detected) }
}

/// Axis column in pixels from the left: the middle of the trunk just above `ground` (a row of
/// pixels), or, with snapping, of the picture if that is within 2 % of its width.
pub(super) fn axis(
    ink: &Bitmap,
    ink_box: (u32, u32, u32, u32),
    ground: u32,
    snapping: Snapping,
) -> (f64, Origin) {
    let middle = f64::from(ink.width()) / 2.0;
    let found = trunk(ink, ink_box, ground);
    let snaps = snapping == Snapping::On && (found - middle).abs() <= SNAP * f64::from(ink.width());
    if snaps { (middle, Origin::Snapped) } else { (found, Origin::Detected) }
}

/// The middle of the trunk.
///
/// Twigs of weeping trees and of firs reach the ground too, farther out, thinner, and not in every
/// row. So the columns that have ink in most rows of the foot form runs, those of a clump (bamboo)
/// are joined, and of these the one wins that is widest for its distance from the middle of all ink.
fn trunk(ink: &Bitmap, (left, top, right, _): (u32, u32, u32, u32), ground: u32) -> f64 {
    let bottom = ground.min(ink.height()).max(top + 1);
    let rows = ((f64::from(bottom - top) * FOOT).ceil() as u32).clamp(1, bottom - top);
    let mut support = vec![0_u32; ink.width() as usize];
    for y in bottom - rows..bottom {
        for x in ink.ink_in_row(y) {
            support[x as usize] += 1;
        }
    }
    let (mut moment, mut total) = (0.0, 0.0);
    for y in top..bottom {
        for x in ink.ink_in_row(y) {
            moment += f64::from(x) + 0.5;
            total += 1.0;
        }
    }
    let center = if total > 0.0 { moment / total } else { f64::from(left + right + 1) / 2.0 };
    let reach = 0.2 * f64::from(right - left + 1).max(8.0);
    let least = (f64::from(rows) * SUPPORT).ceil() as u32;
    let mut best: Option<(f64, f64)> = None;
    for (from, to) in clumps(&support, least) {
        let at = (from + to) / 2.0;
        let off = (at - center) / reach;
        let merit = (to - from) / (1.0 + off * off);
        if best.is_none_or(|(most, _)| merit > most) {
            best = Some((merit, at));
        }
    }
    best.map_or_else(|| weighted_middle(&support).unwrap_or(center), |(_, at)| at)
}

/// Left and right edges of the runs of columns with at least this support, joined across narrow gaps.
fn clumps(support: &[u32], least: u32) -> Vec<(f64, f64)> {
    let mut found: Vec<(f64, f64)> = Vec::new();
    let mut start = 0;
    let mut last_width = 0.0;
    for run in support.chunk_by(|a, b| (*a >= least) == (*b >= least)) {
        if run[0] >= least {
            let (from, width) = (start as f64, run.len() as f64);
            match found.last_mut() {
                Some(last) if from - last.1 <= GAP * width.max(last_width) => last.1 = from + width,
                _ => found.push((from, from + width)),
            }
            last_width = width;
        }
        start += run.len();
    }
    found
}

/// Mean column by support; `None` without support.
fn weighted_middle(support: &[u32]) -> Option<f64> {
    let total: f64 = support.iter().map(|&s| f64::from(s)).sum();
    let moment: f64 = support.iter().zip(0..).map(|(&s, x)| f64::from(s) * (f64::from(x) + 0.5)).sum();
    (total > 0.0).then(|| moment / total)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stands(ink: &Bitmap) -> (f64, f64) {
        let bounds = ink.ink_box().unwrap();
        let (ground, _) = ground(ink, bounds.3, Snapping::On);
        (ground, axis(ink, bounds, bounds.3 + 1, Snapping::On).0)
    }

    #[test]
    fn a_trunk_off_the_middle_is_found() {
        // A round crown that leans to the right of its trunk, with a margin below.
        let ink = Bitmap::from_fn(200, 200, |x, y| {
            let (dx, dy) = (f64::from(x) - 100.0, f64::from(y) - 70.0);
            dx.hypot(dy) < 50.0 || ((60..66).contains(&x) && (80..180).contains(&y))
        });
        assert_eq!(stands(&ink), (180.0, 63.0));
    }

    #[test]
    fn a_clump_of_stems_stands_in_its_middle() {
        let ink = Bitmap::from_fn(100, 100, |x, y| {
            y > 10 && ((30..39).contains(&x) || (41..48).contains(&x))
                || ((20..80).contains(&x) && (5..40).contains(&y))
        });
        assert_eq!(stands(&ink).1, 39.0);
    }

    #[test]
    fn twigs_that_reach_the_ground_are_no_trunk() {
        // A weeping crown: thin strands all around, most of them down to the ground.
        let ink = Bitmap::from_fn(200, 200, |x, y| {
            let strand = x.is_multiple_of(7) && x > 20 && x < 180 && y > 40 && (x * y) % 13 != 0;
            let crown = (30..170).contains(&x) && (20..60).contains(&y);
            strand || crown || ((85..95).contains(&x) && y > 50)
        });
        let (ground, axis) = stands(&ink);
        assert_eq!(ground, 200.0);
        assert!((axis - 90.0).abs() <= 1.0, "{axis}");
    }

    #[test]
    fn close_to_the_usual_places_means_there() {
        let ink = Bitmap::from_fn(100, 100, |x, y| (50..54).contains(&x) && y < 99);
        assert_eq!(stands(&ink), (100.0, 50.0));
        assert_eq!(ground(&ink, 98, Snapping::On).1, Origin::Snapped);
        assert_eq!(ground(&ink, 90, Snapping::On), (91.0, Origin::Detected));
        let bounds = ink.ink_box().unwrap();
        assert_eq!(ground(&ink, 98, Snapping::Off), (99.0, Origin::Detected));
        assert_eq!(axis(&ink, bounds, 99, Snapping::Off), (52.0, Origin::Detected));
    }
}
