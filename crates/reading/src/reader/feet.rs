//! Where trunks meet the ground.

use super::grid::{Grid, Run};
use super::trace::{Rows, Sample, line, trace};

/// Heights, as parts of the tree's, at which trunks are told apart: the first at which no foliage is in the way.
const LEVELS: [f64; 5] = [0.05, 0.035, 0.022, 0.012, 0.004];
/// Wider than this part of the height, ink at the ground is foliage or ground.
const WIDEST: f64 = 0.33;
/// A trunk gets at most this many times as wide from half the height at which it is looked at.
const SPREADS: f64 = 2.0;
/// Of several trunks, each is at least this part of the widest: foliage that hangs to the ground is thinner.
const THINNEST: f64 = 0.4;
/// Stems that end within this part of the height above the ground stand on it: it is not level.
const UNEVEN: f64 = 0.025;
/// Downwards, a trunk is followed up to so many times its width: there the flare of the roots begins.
const STEADY: f64 = 1.25;
/// A trunk that is seen over less than this part of the height is followed from the ground.
const SHORT: f64 = 0.05;
/// Most feet that are told apart.
const MAX_FEET: usize = 64;
/// Rows between which the width is measured, as parts of the height: above the flare of the roots.
pub(crate) const WIDTH_FROM: f64 = 0.03;
pub(crate) const WIDTH_TO: f64 = 0.1;

/// A trunk at the ground, in columns.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Foot {
    /// The height in rows from which it is followed upwards, and its run there.
    pub(super) height: usize,
    pub(super) run: Run,
    /// Where its axis meets the ground.
    pub(super) center: f64,
    /// Its thickness, at right angles to its axis.
    pub(super) width: f64,
    /// Standard deviation of its widths from row to row, in parts of the width.
    pub(super) unsteady: f64,
}

/// What was found out while looking for feet.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Base {
    /// Place in [`LEVELS`] of the height at which they were found; `None` where none of them would do.
    pub(super) level: Option<usize>,
    /// Part of the rows looked at that agree about the number.
    pub(super) agreement: f64,
}

/// Finds the feet, from left to right.
pub(super) fn feet(grid: &Grid, rows: Rows, memory: &mut Vec<Sample>, feet: &mut Vec<Foot>) -> Base {
    feet.clear();
    let mut base = Base::default();
    for (place, level) in LEVELS.into_iter().enumerate() {
        let height = rows.part(level).min(rows.count - 1);
        if is_clear(grid, rows, height) {
            base.level = Some(place);
            base.agreement = vote(grid, rows, height, feet);
            break;
        }
    }
    if feet.is_empty() {
        // Foliage or a mound down to the ground: its lowest row is all that is known.
        base.level = None;
        stand(grid, rows, 0, feet);
    }
    for foot in feet.iter_mut() {
        measure(grid, rows, memory, foot);
    }
    drop_strands(feet);
    base
}

/// Whether trunks can be told apart in this row.
fn is_clear(grid: &Grid, rows: Rows, height: usize) -> bool {
    let widest = |height: usize| {
        let runs = grid.runs(rows.row(height)).filter(|&run| grounded(grid, rows, height, run).is_some());
        runs.map(Run::width).max().unwrap_or(0) as f64
    };
    let (here, below) = (widest(height), widest(height / 2));
    here > 0.0 && here <= WIDEST * rows.count as f64 && here <= SPREADS * below + 2.0
}

/// The run at the ground that the run at `height` leads down to, if it does.
fn grounded(grid: &Grid, rows: Rows, height: usize, run: Run) -> Option<Run> {
    let mut at = run;
    for lower in (0..height).rev() {
        let y = rows.row(lower);
        let first = at.left.saturating_sub(1);
        let first = grid.run_at(y, first as i64).or_else(|| grid.next_run(y, first))?;
        let mut best: Option<Run> = None;
        let mut next = Some(first).filter(|run| run.touches(at));
        let overlap = |run: Run| run.right.min(at.right).saturating_sub(run.left.max(at.left));
        while let Some(run) = next {
            if best.is_none_or(|best| overlap(run) > overlap(best)) {
                best = Some(run);
            }
            next = grid.next_run(y, run.right).filter(|run| run.touches(at));
        }
        match best {
            Some(run) => at = run,
            None => return (lower <= rows.part(UNEVEN)).then_some(at),
        }
    }
    Some(at)
}

/// The trunks of the row at `height`.
fn stand(grid: &Grid, rows: Rows, height: usize, feet: &mut Vec<Foot>) {
    feet.clear();
    let grounded = grid.runs(rows.row(height)).filter(|&run| grounded(grid, rows, height, run).is_some());
    feet.extend(grounded.take(MAX_FEET).map(|run| Foot { height, run, ..Foot::default() }));
    let widest = feet.iter().map(|foot| foot.run.width()).max().unwrap_or(0) as f64;
    feet.retain(|foot| foot.run.width() as f64 >= THINNEST * widest);
}

/// The trunks around `height` in the row nearest to it with the number that most rows have; part of the rows that
/// have it.
fn vote(grid: &Grid, rows: Rows, height: usize, feet: &mut Vec<Foot>) -> f64 {
    let from = height * 3 / 4;
    let to = (height * 5 / 4).min(rows.count - 1);
    let mut votes = [0_u32; MAX_FEET + 1];
    for row in from..=to {
        stand(grid, rows, row, feet);
        votes[feet.len()] += 1;
    }
    // Of equal ones the smaller number.
    let (number, &most) = votes.iter().enumerate().rev().max_by_key(|(_, votes)| **votes).unwrap_or((0, &0));
    for away in 0..=to - from {
        for row in [height + away, height.wrapping_sub(away)] {
            if (from..=to).contains(&row) {
                stand(grid, rows, row, feet);
                if feet.len() == number {
                    return f64::from(most) / (to - from + 1) as f64;
                }
            }
        }
    }
    0.0
}

/// Follows a foot down, towards the ground but no farther than `lowest`, to where it gets wide or ends.
fn descend(grid: &Grid, rows: Rows, lowest: usize, foot: &mut Foot) {
    let width = foot.run.width() as f64;
    let steady = width / STEADY - 1.0..=width * STEADY + 1.0;
    while foot.height > lowest {
        let y = rows.row(foot.height - 1);
        match grid.run_at(y, foot.run.center().floor() as i64) {
            Some(below) if steady.contains(&(below.width() as f64)) => foot.run = below,
            _ => break,
        }
        foot.height -= 1;
    }
}

/// Follows a foot upwards from above the flare of its roots, or from the ground where little of it is seen, and
/// measures it.
fn measure(grid: &Grid, rows: Rows, memory: &mut Vec<Sample>, foot: &mut Foot) {
    descend(grid, rows, rows.part(WIDTH_FROM), foot);
    trace(grid, rows, foot.height, foot.run, rows.part(WIDTH_TO).max(foot.height + 3), memory);
    if memory.iter().filter(|sample| sample.edges == 2).count() < rows.part(SHORT) {
        descend(grid, rows, 0, foot);
        trace(grid, rows, foot.height, foot.run, rows.part(WIDTH_TO).max(foot.height + 3), memory);
    }
    let seen = || memory.iter().filter(|sample| sample.edges == 2);
    let from = rows.part(WIDTH_FROM);
    let is_tall = seen().filter(|sample| sample.height >= from).count() >= 3;
    let part = || seen().filter(|sample| !is_tall || sample.height >= from);
    let count = part().count() as f64;
    let mean = part().map(|sample| sample.width).sum::<f64>() / count;
    let (slope, center) = line(seen().map(|sample| (sample.height as f64 + 0.5, sample.center)))
        .unwrap_or((0.0, foot.run.center()));
    let variance = part().map(|sample| (sample.width - mean) * (sample.width - mean)).sum::<f64>() / count;
    foot.unsteady = variance.sqrt() / mean.max(1.0);
    foot.width = mean / (1.0 + slope * slope).sqrt();
    foot.center = center;
}

/// Leaves out strands of foliage beside a steady trunk.
fn drop_strands(feet: &mut Vec<Foot>) {
    let widest = feet.iter().map(|foot| foot.width).fold(0.0, f64::max);
    feet.retain(|foot| foot.width >= THINNEST * widest);
}
