//! SWC: a node per line, with its parent.
//!
//! Cannon, Turner, Pyapali and Wheal 1998, *An on-line archive of reconstructed hippocampal neurons*: number, type, x, y, z,
//! radius, number of the parent or −1.

use super::draft::{Draft, are_levels};
use super::error::{SkeletonError, SkeletonProblem as Problem};
use super::links::{Links, Named, forest};
use super::{MAX_ROWS, NEAR};
use glam::DVec3;
use pleach_tree::param::shown;

/// The type of nodes of trunks where types are levels: the first that the format leaves to its users.
const TRUNK: i64 = 5;

struct Node {
    line: u64,
    number: i64,
    kind: i64,
    position: DVec3,
    radius: f64,
    parent: i64,
}

/// The stems of a file, parents before children.
pub(super) fn read(origin: &str, bytes: &[u8]) -> Result<Vec<Draft>, SkeletonError> {
    let wrong = |line, problem| SkeletonError::new(origin, line, problem);
    let text = String::from_utf8_lossy(bytes);
    let mut nodes = Vec::new();
    for (line, text) in (1..).zip(text.trim_start_matches('\u{feff}').lines()) {
        let text = text.split('#').next().unwrap_or_default();
        if !text.trim().is_empty() {
            nodes.push(node(line, text).map_err(|problem| wrong(line, problem))?);
        }
        if nodes.len() > MAX_ROWS {
            return Err(wrong(line, Problem::TooManyRows));
        }
    }
    let rows = nodes.iter().map(|&Node { line, number, parent, .. }| Named { line, number, parent });
    let (links, order) = forest(origin, rows, 0)?;
    Ok(drafts(&nodes, &links, &order))
}

fn node(line: u64, text: &str) -> Result<Node, Problem> {
    let words: Vec<&str> = text.split_whitespace().take(7).collect();
    let &[number, kind, x, y, z, radius, parent] = &words[..] else {
        return Err(Problem::TooFewNumbers { found: words.len() });
    };
    let whole = |what, text: &str| {
        text.parse::<i64>().map_err(|_| Problem::NoNumber {
            what,
            text: shown(text),
            expected: "a whole number",
        })
    };
    let real = |what, text: &str| {
        text.parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(|| Problem::NoNumber {
            what,
            text: shown(text),
            expected: "a number with a decimal point",
        })
    };
    let position = DVec3::new(real("x", x)?, real("y", y)?, real("z", z)?);
    let radius = real("radius", radius)?;
    if radius < 0.0 {
        return Err(Problem::Radius { radius });
    }
    let (number, kind) = (whole("number", number)?, whole("type", kind)?);
    Ok(Node { line, number, kind, position, radius, parent: whole("parent", parent)? })
}

fn drafts(nodes: &[Node], links: &Links, order: &[u32]) -> Vec<Draft> {
    let below = |row: u32| links.parents[row as usize].map(|parent| &nodes[parent as usize]);
    let lengths: Vec<f64> = (0..nodes.len() as u32)
        .map(|row| below(row).map_or(0.0, |below| below.position.distance(nodes[row as usize].position)))
        .collect();
    let reaches = links.reaches(order, &lengths);
    let level = |node: &Node| node.kind.saturating_sub(TRUNK);
    let levels = (0..nodes.len() as u32).map(|row| (level(&nodes[row as usize]), below(row).map(level)));
    let have_levels = are_levels(levels);
    // Of each node, its stem and the length of the stem up to it.
    let mut places = vec![(0_u32, 0.0); nodes.len()];
    let mut is_next = vec![false; nodes.len()];
    let mut drafts: Vec<Draft> = Vec::new();
    for &row in order {
        let node = &nodes[row as usize];
        let parent = links.parents[row as usize];
        let stem = match parent {
            Some(parent) if is_next[row as usize] => {
                let stem = places[parent as usize].0;
                drafts[stem as usize].push(node.position, node.radius);
                stem
            }
            Some(parent) => {
                let below = &nodes[parent as usize];
                // A branch that is not told where it starts does so on the axis of its parent, as thick as it is further on.
                let base = (below.position, node.radius);
                let is_fork = have_levels && node.kind == below.kind;
                let mut draft = Draft::new(Some(places[parent as usize]), is_fork, node.line, base);
                draft.push(node.position, node.radius);
                drafts.push(draft);
                drafts.len() as u32 - 1
            }
            None => {
                drafts.push(Draft::new(None, false, node.line, (node.position, node.radius)));
                drafts.len() as u32 - 1
            }
        };
        places[row as usize] = (stem, drafts[stem as usize].length);
        if let Some(next) = next(nodes, links, &lengths, &reaches, row, have_levels) {
            is_next[next as usize] = true;
        }
    }
    drafts
}

/// The child of node `row` that goes on as its stem: the thickest, and of several the one with most above it.
///
/// A child at the very same place begins a branch, unless nothing distinguishes the two. Where types are levels, a stem has
/// one type.
fn next(
    nodes: &[Node],
    links: &Links,
    lengths: &[f64],
    reaches: &[f64],
    row: u32,
    have_levels: bool,
) -> Option<u32> {
    let node = &nodes[row as usize];
    let children = links.children(row);
    if let &[only] = children {
        let child = &nodes[only as usize];
        if child.kind == node.kind && child.radius == node.radius {
            return Some(only);
        }
    }
    let goes_on = |&child: &u32| {
        lengths[child as usize] > NEAR && (!have_levels || nodes[child as usize].kind == node.kind)
    };
    let rank = |child: u32| {
        let reach = lengths[child as usize] + reaches[child as usize];
        (nodes[child as usize].radius, reach)
    };
    let by = |a: &u32, b: &u32| {
        let ((thick, far), (other_thick, other_far)) = (rank(*a), rank(*b));
        // Of equals, the first one.
        thick.total_cmp(&other_thick).then(far.total_cmp(&other_far)).then(b.cmp(a))
    };
    children.iter().copied().filter(goes_on).max_by(by)
}
