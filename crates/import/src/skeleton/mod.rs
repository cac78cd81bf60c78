//! Measured trees: skeletons that other programs found in scans of trees, as SWC or as tables of cylinders.

mod cylinders;
mod draft;
mod error;
mod links;
mod swc;

pub use error::{SkeletonError, SkeletonProblem};

use draft::Draft;
use glam::DVec3;
use pleach_tree::{Knot, Stem, StemKind, Tree};
use std::path::Path;

/// Most bytes of a file: some 500,000 cylinders.
pub const MAX_SKELETON_BYTES: u64 = 64 << 20;
/// Most nodes or cylinders of a file.
pub(crate) const MAX_ROWS: usize = 1_000_000;
/// Farthest point from the foot of a tree, in metres.
const MAX_REACH: f64 = 10_000.0;
/// Points that are nearer to each other, in metres, are one.
const NEAR: f64 = 1e-7;

/// Whether a file called `origin`, which begins with `start`, holds a skeleton: its name ends in `.swc` or `.csv`, or in
/// `.txt` and it begins as tables of TreeQSM do.
#[must_use]
pub fn is_skeleton(origin: &str, start: &[u8]) -> bool {
    match ending(origin).as_str() {
        "swc" | "csv" => true,
        "txt" => start.get(..6).is_some_and(|start| start.eq_ignore_ascii_case(b"radius")),
        _ => false,
    }
}

/// The ending of a file's name, in lower case.
fn ending(origin: &str) -> String {
    Path::new(origin).extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// The tree whose skeleton the file `origin` holds: SWC if its name says so, a table of cylinders otherwise.
///
/// Metres, z up. The foot of the first trunk is moved to the origin; scans have coordinates of maps. Stems run straight
/// from node to node. There are no leaves.
///
/// ```
/// let swc = "1 5 10 20 3 0.1 -1\n2 5 10 20 5 0.08 1\n3 6 11 20 6 0.02 2\n4 5 10 20 7 0.05 2\n";
/// let tree = pleach_import::read_skeleton("tree.swc", swc.as_bytes())?;
/// assert_eq!((tree.stems.len(), tree.stems[1].level, tree.stems[1].offset), (2, 1, 2.0));
/// # Ok::<(), pleach_import::SkeletonError>(())
/// ```
///
/// # Errors
/// The first row that cannot be, with its line.
pub fn read_skeleton(origin: &str, bytes: &[u8]) -> Result<Tree, SkeletonError> {
    if bytes.len() as u64 > MAX_SKELETON_BYTES {
        return Err(SkeletonError::new(origin, 1, SkeletonProblem::TooManyBytes));
    }
    let drafts = match ending(origin).as_str() {
        "swc" => swc::read(origin, bytes)?,
        _ => cylinders::read(origin, bytes)?,
    };
    tree(origin, &drafts)
}

/// The tree of these stems, parents before children.
fn tree(origin: &str, drafts: &[Draft]) -> Result<Tree, SkeletonError> {
    let mut tree = Tree::default();
    // Of each draft, the stem that it became, or of one without a length the stem below it; and its place there.
    let mut made: Vec<(Option<u32>, Option<f64>)> = Vec::with_capacity(drafts.len());
    let foot = drafts.first().map_or(DVec3::ZERO, |draft| draft.knots[0].0);
    for draft in drafts {
        let below = draft.parent.map(|(parent, offset)| {
            let (stem, moved) = made[parent as usize];
            (stem, moved.unwrap_or(offset))
        });
        let parent = below.and_then(|(stem, offset)| Some((stem?, offset)));
        if draft.knots.len() < 2 {
            made.push(parent.map_or((None, Some(0.0)), |(stem, offset)| (Some(stem), Some(offset))));
            continue;
        }
        let far = draft.knots.iter().find(|(at, radius)| {
            let reach = at.distance(foot).max(*radius);
            !reach.is_finite() || reach > MAX_REACH
        });
        if far.is_some() {
            return Err(SkeletonError::new(origin, draft.line, SkeletonProblem::TooFar));
        }
        let below = parent.map(|(stem, _)| tree.stems[stem as usize]);
        let (kind, level) = match below {
            None => (StemKind::Trunk, 0),
            Some(below) if draft.is_fork => (StemKind::Fork, below.level),
            Some(below) => (StemKind::Branch, below.level.saturating_add(1)),
        };
        made.push((Some(tree.stems.len() as u32), None));
        tree.stems.push(Stem {
            parent: parent.map(|(stem, _)| stem),
            level,
            kind,
            number: 0,
            offset: parent.map_or(0.0, |(_, offset)| offset),
            first_knot: tree.knots.len() as u32,
            knot_count: draft.knots.len() as u32,
        });
        let knots = &draft.knots;
        tree.knots.extend((0..knots.len()).map(|at| {
            let (point, radius) = (knots[at].0 - foot, knots[at].1);
            // Straight pieces: handles lie a third of the way to the neighbours. At the ends they go on as the stem does.
            let third = |from: usize, to: usize| (knots[to].0 - knots[from].0) / 3.0;
            let before = if at > 0 { third(at - 1, at) } else { third(0, 1) };
            let after = if at + 1 < knots.len() { third(at, at + 1) } else { before };
            Knot { point, handle_in: point - before, handle_out: point + after, radius }
        }));
    }
    if tree.stems.is_empty() {
        return Err(SkeletonError::new(origin, 1, SkeletonProblem::NoStem));
    }
    if tree.knots.iter().all(|knot| knot.radius == 0.0) {
        return Err(SkeletonError::new(origin, 1, SkeletonProblem::NoRadius));
    }
    Ok(tree)
}

#[cfg(test)]
mod tests;
