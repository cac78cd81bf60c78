//! Where the trunk divides.

use super::grid::{Grid, Run};
use super::trace::{Rows, Sample, line, trace};

/// An arm is at least this part of the trunk's expected width, along the row.
const ARM: f64 = 0.35;
/// The thinner arm is at least this part of the thicker one, at right angles to their axes.
pub(crate) const EVEN: f64 = 0.5;
/// Arms are followed over this part of the height.
const ARM_ROWS: f64 = 0.04;
/// Of these rows an arm is seen in at least this part.
const ARM_SEEN: f64 = 0.6;
/// Two arms differ by at least this angle, as slopes: 10°.
pub(crate) const APART: f64 = 0.176;
/// Ink wider than this many trunks is crown.
const CROWN: f64 = 5.0;
/// A fork lies at most this many widths of the trunk beside its axis.
const NEAR: f64 = 2.0;
/// Rows beyond the last one in which the trunk is seen, as a part of the height.
const BEYOND: f64 = 0.08;

/// Two arms of a trunk.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fork {
    /// Where their axes meet, in rows.
    pub(super) height: f64,
    /// Column of that place.
    pub(super) center: f64,
    /// Columns per row of the left and of the right arm.
    pub(super) slopes: [f64; 2],
    /// Part of the arms' rows in which both edges are seen.
    pub(super) seen: f64,
}

/// An arm that was followed upwards.
struct Arm {
    slope: f64,
    /// Column where the arms part.
    center: f64,
    width: f64,
    seen: f64,
}

/// The lowest fork of the trunk that was traced.
pub(super) fn first(grid: &Grid, rows: Rows, samples: &[Sample], arms: &mut Vec<Sample>) -> Option<Fork> {
    let start = samples.first()?;
    let end = (samples.last()?.height + rows.part(BEYOND)).min(rows.count - 1);
    let mut below = start.run;
    let mut width = start.width;
    for height in start.height + 1..=end {
        let y = rows.row(height);
        if let Some(sample) = samples.get(height - start.height).filter(|sample| sample.edges == 2) {
            width = sample.width.min(1.2 * width);
        }
        if below.width() == 0 || below.width() as f64 > CROWN * width + 3.0 {
            // Crown, or paper: the trunk's own run is looked for again where it is seen.
            below = samples.get(height - start.height).map_or(Run::default(), |sample| sample.run);
            if height - start.height >= samples.len() {
                return None;
            }
            continue;
        }
        let axis = samples.get(height - start.height).or(samples.last()).map_or(0.0, |sample| sample.center);
        let least = (ARM * width).max(1.0);
        let (mut left, mut right, mut widest): (Option<Run>, Option<Run>, Option<Run>) = (None, None, None);
        let first = below.left.saturating_sub(1);
        let mut next = grid.run_at(y, first as i64).or_else(|| grid.next_run(y, first));
        while let Some(run) = next.filter(|run| run.touches(below)) {
            if run.width() as f64 >= least {
                left = left.or(Some(run));
                right = Some(run);
            }
            if widest.is_none_or(|widest| run.width() > widest.width()) {
                widest = Some(run);
            }
            next = grid.next_run(y, run.right);
        }
        if let (Some(left), Some(right)) = (left, right)
            && left != right
        {
            let pair = (
                follow(grid, rows, height, left, width, arms),
                follow(grid, rows, height, right, width, arms),
            );
            if let (Some(left), Some(right)) = pair
                && let Some(fork) = meeting(height, width, &left, &right)
                && (fork.center - axis).abs() <= NEAR * width + 2.0
            {
                return Some(fork);
            }
        }
        below = match samples.get(height - start.height) {
            Some(sample) if sample.run.width() > 0 => sample.run,
            _ => widest.unwrap_or_default(),
        };
    }
    None
}

/// Follows an arm from the row where it parts from the other.
fn follow(
    grid: &Grid,
    rows: Rows,
    height: usize,
    run: Run,
    trunk: f64,
    memory: &mut Vec<Sample>,
) -> Option<Arm> {
    let count = rows.part(ARM_ROWS).max(4);
    trace(grid, rows, height, run, height + count, memory);
    let seen = || memory.iter().filter(|sample| sample.edges == 2);
    let number = seen().count();
    if (number as f64) < ARM_SEEN * count as f64 {
        return None;
    }
    let (slope, center) = line(seen().map(|sample| (sample.height as f64 - height as f64, sample.center)))?;
    let mean = seen().map(|sample| sample.width).sum::<f64>() / number as f64;
    let width = mean / (1.0 + slope * slope).sqrt();
    let is_arm = width >= ARM * trunk && width <= 1.4 * trunk + 1.0;
    is_arm.then_some(Arm { slope, center, width, seen: number as f64 / count as f64 })
}

/// The fork of two arms that part at `height`.
fn meeting(height: usize, trunk: f64, left: &Arm, right: &Arm) -> Option<Fork> {
    let apart = right.slope - left.slope;
    if left.width.min(right.width) < EVEN * left.width.max(right.width) || apart < APART {
        return None;
    }
    // Both axes are where the arms part at `center`; below, they meet.
    let down = ((right.center - left.center) / apart).clamp(0.0, 4.0 * trunk);
    let center = (left.center - left.slope * down + right.center - right.slope * down) / 2.0;
    Some(Fork {
        height: (height as f64 - down).max(0.0),
        center,
        slopes: [left.slope, right.slope],
        seen: left.seen.min(right.seen),
    })
}
