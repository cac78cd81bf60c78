//! Wood, foliage, neither.

use super::evidence::Evidence;
use super::grid::{Cell, Grid};
use super::lines::along_lines;
use super::mixture::{Mixture, Normal, wood_of};
use super::oklab;
use super::trunk::trunk;

/// What a cell is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// Not tree, or a colour that no tree has: sky between leaves.
    #[default]
    Neither,
    Wood,
    Foliage,
}

/// Half the length of the lines that limbs keep their likelihood along, per height of the tree.
const REACH: f64 = 0.02;
/// A cell of this likelihood along a line is wood if it touches more of its kind, and
const WEAK: f32 = 0.45;
/// one of this is wood if enough of them hang together.
const STRONG: f32 = 0.64;
/// Wood that does not touch the trunk is at least this long, per longer side of the tree.
const MIN_PIECE: f64 = 0.03;

/// A tree in layers.
pub(super) struct Layers {
    pub(super) kinds: Vec<Kind>,
    pub(super) evidence: Evidence,
    /// The trunk's, from which bark is read; empty where it was not seen.
    pub(super) trunk: Vec<usize>,
    /// What wood looks like.
    pub(super) wood: Normal,
}

/// Whether a colour is sky's, seen through the crown or at its edge.
pub(super) fn is_sky(color: oklab::Oklab) -> bool {
    let [lightness, a, b] = color;
    b < -0.02 && lightness > 0.35 && -b > a.abs()
}

/// Whether what was taken for a trunk has the strong colour of most of the tree: turned leaves that hang to the ground.
fn is_turned_foliage(grid: &Grid, wood: &Normal) -> bool {
    let [u, v, _] = wood.middle;
    if oklab::chroma(u, v) < 0.14 || oklab::angle(u, v) > 92.0 {
        return false;
    }
    let tree = || (0..grid.cells.len()).filter(|&at| grid.is_tree(at) && !oklab::is_black(grid.colors[at]));
    let alike = tree().filter(|&at| wood.hue_distance(grid.colors[at]) < 2.5).count();
    2 * alike > tree().count()
}

impl Layers {
    /// The layers of a picture in colour; `None` where it has no colours.
    pub(super) fn new(grid: &Grid) -> Option<Self> {
        let mut evidence = Evidence::default();
        evidence.see_colors(grid);
        if !evidence.has_colors() {
            return None;
        }
        let trunk = trunk(grid);
        let seen = trunk.as_ref().and_then(|trunk| wood_of(grid, trunk));
        let seen = seen.filter(|wood| !is_turned_foliage(grid, wood));
        let wood = seen.unwrap_or(Normal::BARK);
        evidence.trunk = seen.is_some();
        let mut is_trunk = vec![false; grid.cells.len()];
        if let Some(trunk) = trunk.as_ref().filter(|_| seen.is_some()) {
            let plain = |at: &&usize| !wood.is_green(grid.colors[**at]);
            trunk.all.iter().filter(plain).for_each(|&at| is_trunk[at] = true);
            // Moss and ivy on a trunk do not make it foliage.
            trunk.cells.iter().for_each(|&at| is_trunk[at] = true);
            evidence.trunk_width = trunk.width as f64;
            evidence.trunk_height = trunk.height;
        }
        let inner = |kind: Cell| {
            let cells = (0..grid.cells.len()).filter(|&at| !is_trunk[at] && grid.cells[at] == kind);
            cells.filter(|&at| !is_sky(grid.colors[at])).collect::<Vec<_>>()
        };
        let (mut crown, edge) = (inner(Cell::Inside), inner(Cell::Edge));
        if crown.len() < edge.len() / 8 {
            crown.extend(edge);
        }
        let trunk = if seen.is_some() { trunk.map_or(Vec::new(), |trunk| trunk.cells) } else { Vec::new() };
        evidence.see_crown(grid, &wood, &crown);
        let mut layers = Self { kinds: vec![Kind::Neither; grid.cells.len()], evidence, trunk, wood };
        let mixture = if layers.evidence.has_leaves() {
            Mixture::fit(grid, wood, &crown, layers.evidence.share_of_wood() as f32)
        } else {
            None
        };
        match mixture {
            Some(mixture) => layers.split(grid, &mixture, &is_trunk),
            None => {
                let tree = (0..grid.cells.len()).filter(|&at| grid.is_tree(at));
                tree.for_each(|at| layers.kinds[at] = Kind::Wood);
            }
        }
        Some(layers)
    }

    fn split(&mut self, grid: &Grid, mixture: &Mixture, is_trunk: &[bool]) {
        self.evidence.see_mixture(mixture);
        let wood_like = &mixture.wood;
        let mut likely = vec![0.0_f32; grid.cells.len()];
        for (at, likely) in likely.iter_mut().enumerate().filter(|&(at, _)| grid.is_tree(at)) {
            *likely = if is_trunk[at] { 1.0 } else { mixture.wood_share(grid.colors[at]) };
            if is_sky(grid.colors[at]) || oklab::is_black(grid.colors[at]) {
                *likely = likely.min(0.4);
            }
            if !is_trunk[at] && self.evidence.blossoms() && wood_like.is_petal(grid.colors[at]) {
                *likely = 0.0;
            }
        }
        let reach = ((REACH * grid.height.max(grid.width) as f64).round() as i32).clamp(2, 10);
        let lines = along_lines(grid, &likely, reach, 0.3);
        let mut wood = vec![false; lines.len()];
        let mut piece = Vec::new();
        for start in 0..lines.len() {
            if wood[start] || lines[start] < STRONG {
                continue;
            }
            // All that hangs together from here.
            piece.clear();
            piece.push(start);
            wood[start] = true;
            let mut next = 0;
            while let Some(&at) = piece.get(next) {
                next += 1;
                for beside in grid.around(at).filter(|&beside| lines[beside] >= WEAK) {
                    if !wood[beside] {
                        wood[beside] = true;
                        piece.push(beside);
                    }
                }
            }
            let extent = extent(grid, &piece);
            let kind = if piece.iter().any(|&at| is_trunk[at])
                || extent as f64 >= MIN_PIECE * grid.height.max(grid.width) as f64
            {
                Kind::Wood
            } else {
                Kind::Neither
            };
            if kind == Kind::Wood {
                piece.iter().for_each(|&at| self.kinds[at] = Kind::Wood);
            }
        }
        // The sides of limbs have the background's colours in them.
        let is_side = |kinds: &[Kind], at: usize| {
            grid.cells[at] == Cell::Edge
                && kinds[at] == Kind::Neither
                && !wood_like.is_leaf(grid.colors[at])
                && grid
                    .around(at)
                    .any(|beside| kinds[beside] == Kind::Wood && grid.cells[beside] == Cell::Inside)
        };
        let sides: Vec<usize> = (0..lines.len()).filter(|&at| is_side(&self.kinds, at)).collect();
        sides.into_iter().for_each(|at| self.kinds[at] = Kind::Wood);
        for at in 0..lines.len() {
            if self.kinds[at] == Kind::Neither && grid.is_tree(at) && !is_sky(grid.colors[at]) {
                self.kinds[at] = Kind::Foliage;
            }
        }
    }

    /// The cells of a kind.
    pub(super) fn cells(&self, kind: Kind) -> impl Iterator<Item = usize> + '_ {
        self.kinds.iter().enumerate().filter(move |&(_, &k)| k == kind).map(|(at, _)| at)
    }
}

/// The longer side of the box around cells.
fn extent(grid: &Grid, piece: &[usize]) -> usize {
    let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
    for &at in piece {
        for (axis, place) in [at % grid.width, at / grid.width].into_iter().enumerate() {
            low[axis] = low[axis].min(place);
            high[axis] = high[axis].max(place);
        }
    }
    (0..2).map(|axis| high[axis] - low[axis] + 1).max().unwrap_or(0)
}
