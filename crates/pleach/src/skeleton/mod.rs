//! A tree as a graph of points: the axes of its stems, with radii, for programs that measure trees.

mod cylinders;
mod format;
mod lines;
mod mtg;
mod swc;

pub use cylinders::Cylinder;
pub use format::SkeletonFormat;

use glam::DVec3;
use pleach_tree::spline::Cubic;
use pleach_tree::{Parts, Stem, Tree};
use std::f64::consts::PI;
use std::io::{self, Write};

/// Nodes of a stem that are nearer to each other, in metres, are one.
const NEAR: f64 = 1e-5;
/// Most segments of one Bézier piece.
const MAX_CHORDS: f64 = 64.0;

/// A point on the axis of a stem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkeletonNode {
    /// In metres, z up.
    pub position: DVec3,
    /// Radius of the stem here, in metres.
    pub radius: f64,
    /// Index of the node below it: on the same stem, or, for the first node of a stem, the node of the parent stem at
    /// the very same position. `None` for the foot of a trunk.
    pub parent: Option<u32>,
    /// Index of its stem in [`Tree::stems`].
    pub stem: u32,
    /// Level of its stem.
    pub level: u16,
}

/// The axes of all stems of a tree above the ground, as nodes with parents; between two nodes of a stem runs a straight
/// frustum.
///
/// Generators may start a branch on the surface of its parent. Here it starts on the parent's axis, at the nearest
/// point: a branch and all that it carries are moved there, by less than the radius of the parent, and so a twig by less
/// than those of all below it. So the graph has no gaps, and lengths and volumes stay those of the tree: chords shorten
/// curves by about 0.1 %.
///
/// ```
/// let tree = pleach::species("acer")?.grow(1)?;
/// let skeleton = pleach::Skeleton::new(&tree);
/// assert!(skeleton.length() > 100.0 && skeleton.volume() > 0.1);
/// let mut swc = Vec::new();
/// skeleton.write(pleach::SkeletonFormat::Swc, &mut swc)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    /// Nodes, each behind its parent, those of a stem in one run from base to tip.
    pub nodes: Vec<SkeletonNode>,
}

impl Skeleton {
    /// The skeleton of `tree`, without roots.
    #[must_use]
    pub fn new(tree: &Tree) -> Self {
        let place = |stem: &Stem| Parts::STEMS.has_stem(stem.kind).then(|| tree.place_of(stem)).flatten();
        let places: Vec<Option<f64>> = tree.stems.iter().map(place).collect();
        let mut cuts: Vec<Vec<f64>> = vec![Vec::new(); tree.stems.len()];
        for (stem, place) in tree.stems.iter().zip(&places) {
            if let (Some(parent), Some(place)) = (stem.parent, place) {
                cuts[parent as usize].push(*place);
            }
        }
        let mut skeleton = Self::default();
        // Of each stem: its nodes by their places, and how far it was moved. `None` if it is left out.
        let mut made: Vec<Option<Made>> = Vec::with_capacity(tree.stems.len());
        for (index, stem) in tree.stems.iter().enumerate() {
            let parent = stem.parent.map(|parent| made[parent as usize].as_ref());
            if !Parts::STEMS.has_stem(stem.kind) || matches!(parent, Some(None)) {
                made.push(None);
                continue;
            }
            let foot = parent.flatten().zip(places[index]).map(|(parent, place)| parent.node_at(place));
            let stem_made = skeleton.add(tree, index as u32, stem, foot, &mut cuts[index]);
            made.push(Some(stem_made));
        }
        skeleton
    }

    /// Adds the nodes of `stem`, which starts at node `foot` and has nodes at `cuts` beside its own.
    fn add(&mut self, tree: &Tree, index: u32, stem: &Stem, foot: Option<u32>, cuts: &mut Vec<f64>) -> Made {
        let start = tree.knots_of(stem)[0].point;
        let base = foot.map_or(start, |foot| self.nodes[foot as usize].position);
        let shift = base - start;
        for (number, (piece, ..)) in tree.pieces_of(stem).enumerate() {
            let chords = chords(&piece);
            cuts.extend((0..=chords).map(|chord| number as f64 + f64::from(chord) / f64::from(chords)));
        }
        cuts.sort_unstable_by(f64::total_cmp);
        let mut made = Made { places: Vec::with_capacity(cuts.len()) };
        let pieces: Vec<(Cubic, f64, f64)> = tree.pieces_of(stem).collect();
        for &place in &*cuts {
            let number = (place as usize).min(pieces.len() - 1);
            let (piece, from, to) = &pieces[number];
            let t = place - number as f64;
            let (position, radius) = (piece.at(t) + shift, from + (to - from) * t);
            let first = made.places.is_empty();
            let last = self.nodes.len().wrapping_sub(1);
            if !first && self.nodes[last].position.distance(position) < NEAR {
                made.places.push((place, last as u32));
                continue;
            }
            made.places.push((place, self.nodes.len() as u32));
            let (position, parent) = if first { (base, foot) } else { (position, Some(last as u32)) };
            self.nodes.push(SkeletonNode { position, radius, parent, stem: index, level: stem.level });
        }
        made
    }

    /// The frusta of all stems: pairs of nodes, the lower one first.
    pub fn segments(&self) -> impl Iterator<Item = (&SkeletonNode, &SkeletonNode)> {
        self.nodes.iter().filter_map(|node| {
            let below = &self.nodes[node.parent? as usize];
            (below.stem == node.stem).then_some((below, node))
        })
    }

    /// Length of all stems, in metres.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.segments().map(|(a, b)| a.position.distance(b.position)).sum()
    }

    /// Volume of all stems, in cubic metres.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let frustum = |(a, b): (&SkeletonNode, &SkeletonNode)| {
            PI * mean_square(a.radius, b.radius) * a.position.distance(b.position)
        };
        self.segments().map(frustum).sum()
    }

    /// Writes it in `format`, to a buffered `out`. The same tree gives the same bytes on every platform.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, format: SkeletonFormat, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
        match format {
            SkeletonFormat::Swc => swc::write(self, out),
            SkeletonFormat::Csv => cylinders::write(self, out),
            SkeletonFormat::Mtg => mtg::write(self, out),
        }
    }
}

/// A stem that is in the skeleton.
struct Made {
    /// Places along the stem, from base to tip, with the node at each.
    places: Vec<(f64, u32)>,
}

impl Made {
    /// The node at `place`, which is one of the places.
    fn node_at(&self, place: f64) -> u32 {
        let at = self.places.partition_point(|(other, _)| *other < place);
        self.places[at.min(self.places.len() - 1)].1
    }
}

/// Chords that shorten `piece` by about 0.1 % at most: the sagitta of each is a fiftieth of its length.
fn chords(piece: &Cubic) -> u32 {
    const SAGITTA: f64 = 0.02;
    let [a, b, c, d] = piece.points;
    let bend = (a - b * 2.0 + c).length().max((b - c * 2.0 + d).length());
    let length = a.distance(b) + b.distance(c) + c.distance(d);
    // Of n chords, each has a sagitta of 0.75 bend / n² at most, over length / n.
    let chords = (0.75 * bend / (SAGITTA * length)).ceil();
    if chords >= 1.0 { chords.min(MAX_CHORDS) as u32 } else { 1 }
}

/// The mean of the squared radius along a frustum between two radii.
fn mean_square(from: f64, to: f64) -> f64 {
    (from * from + from * to + to * to) / 3.0
}

/// `vector` as it is written with eight digits after the point, without a minus before zero.
fn written(vector: DVec3) -> [f64; 3] {
    vector.to_array().map(|value| if value.abs() < 5e-9 { 0.0 } else { value })
}

#[cfg(test)]
mod round_trip;
#[cfg(test)]
mod tests;
