//! Where wood is certain: the trunks, from the foot up to where they widen into a crown.

use super::grid::Grid;

/// Height at which trunks are looked for, above soil and flaring roots, per height of the tree.
const START: f64 = 0.04;
/// A trunk is at most this wide, per longer side of the tree, as icons and baobabs are; foliage that
/// reaches the ground is wider.
const MAX_WIDTH: f64 = 0.4;
/// And per width of the tree.
const MAX_SHARE: f64 = 0.55;
/// And at least this wide, per width of the widest: twigs that hang to the ground are thinner.
const MIN_SHARE: f64 = 0.35;
/// It ends where it is this many times as wide as so far.
const WIDENED: f64 = 1.6;
/// It is followed at most this far up, per height of the tree.
const MAX_HEIGHT: f64 = 0.6;

/// Cells that are trunk, their sides left out, and its width.
pub(super) struct Trunk {
    pub(super) cells: Vec<usize>,
    /// With their sides.
    pub(super) all: Vec<usize>,
    /// Cells across, of the widest trunk.
    pub(super) width: usize,
    /// Rows up to which it was followed, per height of the tree.
    pub(super) height: f64,
}

/// Follows the trunks of the tree's lowest rows; `None` if there are none.
pub(super) fn trunk(grid: &Grid) -> Option<Trunk> {
    let start = grid.height - 1 - (START * grid.height as f64) as usize;
    let longest = grid.width.max(grid.height) as f64;
    let mut found = Trunk { cells: Vec::new(), all: Vec::new(), width: 0, height: 0.0 };
    let most = (MAX_WIDTH * longest).min(MAX_SHARE * grid.width as f64);
    let width = |run: &(usize, usize)| run.1 - run.0;
    let mut feet = runs(grid, start);
    feet.retain(|foot| width(foot) as f64 <= most);
    let widest = feet.iter().map(width).max().unwrap_or(0) as f64;
    for foot in feet {
        let width = width(&foot);
        if (width as f64) < MIN_SHARE * widest {
            continue;
        }
        let up = follow(grid, foot, (0..start).rev().take((MAX_HEIGHT * grid.height as f64) as usize));
        let down = follow(grid, foot, start..grid.height);
        // A speck below the crown, or a leaf that hangs, is not a trunk.
        if up.len() + down.len() < 3 || (up.len() as f64) < 0.02 * grid.height as f64 {
            continue;
        }
        found.width = found.width.max(width);
        found.height = found.height.max(up.len() as f64 / grid.height as f64);
        for (y, (from, to)) in up.into_iter().chain(down) {
            // The sides have the background's colours in them.
            let side = (to - from) / 5;
            found.all.extend((from..to).map(|x| y * grid.width + x));
            found.cells.extend((from + side..(to - side).max(from + side + 1)).map(|x| y * grid.width + x));
        }
    }
    (!found.cells.is_empty()).then_some(found)
}

/// First and one past the last column of each run of tree in a row.
fn runs(grid: &Grid, y: usize) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    let row = grid.row(y);
    for (x, _) in row.enumerate().filter(|&(_, at)| grid.is_tree(at)) {
        match runs.last_mut() {
            Some(run) if run.1 == x => run.1 = x + 1,
            _ => runs.push((x, x + 1)),
        }
    }
    runs
}

/// From row to row, the run that touches the last one, while it stays about as wide.
fn follow(
    grid: &Grid,
    foot: (usize, usize),
    rows: impl Iterator<Item = usize>,
) -> Vec<(usize, (usize, usize))> {
    let (mut last, mut found) = (foot, Vec::new());
    let mut usual = (foot.1 - foot.0) as f64;
    for y in rows {
        let touching = runs(grid, y).into_iter().filter(|run| run.0 < last.1 && last.0 < run.1);
        let overlap = |run: &(usize, usize)| run.1.min(last.1) - run.0.max(last.0);
        let Some(run) = touching.max_by_key(overlap) else { break };
        let width = (run.1 - run.0) as f64;
        if width > WIDENED * usual + 1.0 {
            break;
        }
        usual += 0.1 * (width - usual);
        last = run;
        found.push((y, run));
    }
    found
}
