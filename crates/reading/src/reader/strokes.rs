//! Fine ink: twigs and leaves, how thin they are and where they point.

use super::grid::Grid;
use super::trace::Rows;

/// Ink in which a square of this part of the height fits is limb or mass.
const THICK: f64 = 0.016;
/// Length of the lines that are fitted into strokes, as a part of the height.
const LINE: f64 = 0.03;
/// Steps to the right and down of the lines, with the length of one.
const LINES: [((i32, i32), f64); 8] = [
    ((1, 0), 1.0),
    ((2, 1), 2.236),
    ((1, 1), 1.414),
    ((1, 2), 2.236),
    ((0, 1), 1.0),
    ((-1, 2), 2.236),
    ((-1, 1), 1.414),
    ((-2, 1), 2.236),
];
/// Elevations of these lines in degrees; positive rises to the right.
const ELEVATIONS: [f64; 8] = [0.0, -26.565, -45.0, -63.435, 90.0, 63.435, 45.0, 26.565];

/// What fine ink is like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Strokes {
    /// Ink of the crown in pixels.
    pub(crate) ink: f64,
    /// Part of it that is fine.
    pub(crate) fine: f64,
    /// Mean width of fine ink in pixels.
    pub(crate) width: f64,
    /// Part of the ink in which squares of half and of the whole width of the trunk fit: masses of foliage.
    pub(crate) mass: [f64; 2],
    /// Length of edge of the crown's ink per pixel of ink.
    pub(crate) rough: f64,
    /// Pixels in which a line begins, in any direction, per pixel of fine ink.
    pub(crate) lines: f64,
    /// Those of the direction with the most.
    pub(crate) strongest: f64,
    /// Free ends per pixel of ink, and the part of them that point down.
    pub(crate) ends: f64,
    pub(crate) hanging: f64,
    /// Mean elevation of lines in degrees, positive where they rise away from the axis.
    pub(crate) elevation: f64,
    /// Part of the lines that are upright.
    pub(crate) upright: f64,
}

/// Memory of [`strokes`].
pub(super) struct Spare<'a> {
    pub(super) fine: &'a mut Grid,
    pub(super) line: &'a mut Grid,
    pub(super) other: &'a mut Grid,
}

/// Length of the edge of ink from its edges between columns and rows (Cauchy's formula for random directions).
fn edge((across, down): (u64, u64)) -> f64 {
    (across + down) as f64 * std::f64::consts::FRAC_PI_4
}

/// Reads the fine ink of the crown above the height `bare`; `origin` is the column of the axis.
pub(super) fn strokes(
    ink: &Grid,
    spare: Spare<'_>,
    rows: Rows,
    bare: usize,
    origin: f64,
    trunk: f64,
) -> Strokes {
    let Spare { fine, line, other } = spare;
    let crown = rows.row(rows.count - 1)..rows.row(bare.min(rows.count - 1)) + 1;
    let mut found = Strokes::default();
    fine.copy_from(ink);
    fine.keep_rows(crown.clone());
    let total = fine.ink_of_rows(crown.clone());
    if total == 0 {
        return found;
    }
    found.ink = total as f64;
    found.rough = edge(fine.edges()) / found.ink;
    let (up, down) = fine.ends();
    found.ends = (up + down) as f64 / found.ink;
    found.hanging = down as f64 / ((up + down) as f64).max(1.0);
    // An opening by the larger square removes at least what that by the smaller one does.
    line.copy_from(fine);
    for (mass, part) in found.mass.iter_mut().zip([0.5, 1.0]) {
        line.open((part * trunk).round().clamp(2.0, 60.0) as u32 + 1, other);
        *mass = line.ink_of_rows(crown.clone()) as f64 / found.ink;
    }
    line.copy_from(fine);
    line.open(rows.part(THICK).max(3) as u32, other);
    fine.remove(line);
    let thin = fine.ink_of_rows(crown.clone());
    found.fine = thin as f64 / found.ink;
    if thin == 0 {
        return found;
    }
    // A long stroke has two edges of its length.
    found.width = 2.0 * thin as f64 / edge(fine.edges()).max(1.0);
    let length = (LINE * rows.count as f64).max(4.0);
    let (mut sum, mut signed, mut upright) = (0.0, 0.0, 0.0);
    let middle = origin.round() as i64;
    for ((step, one), elevation) in LINES.into_iter().zip(ELEVATIONS) {
        line.erode_line(fine, step, (length / one).round().max(2.0) as u32, other);
        let count = line.ink_of_rows(crown.clone());
        let all = count as f64;
        sum += all;
        found.strongest = found.strongest.max(all);
        if step == (0, 1) {
            upright = all;
        } else if step.0 != 0 && step.1 != 0 && count > 0 {
            let left = line.ink_left_of(crown.clone(), middle);
            signed += elevation * (all - 2.0 * left as f64);
        }
    }
    found.lines = sum / thin as f64;
    found.strongest /= thin as f64;
    found.elevation = if sum > upright { signed / (sum - upright) } else { 0.0 };
    found.upright = if sum > 0.0 { upright / sum } else { 0.0 };
    found
}
