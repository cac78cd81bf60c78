//! Texture coordinates of a welded surface.
//!
//! Each triangle shows the bark of the stem that is nearest to it, with as many tiles around it and along it as the stem's
//! tube has. A surface has no seams, and pictures need some: a corner is there once for each stem whose bark its triangles
//! show, and twice where a stem's picture begins again.

use super::TRACED;
use super::boxes::Boxes;
use super::cone::Cone;
use crate::block::{Block, Vertex};
use crate::tube::{Path, perpendicular, transport, unroll};
use glam::{DVec3, Vec3, vec2};
use pleach_plant::trig::atan2;
use pleach_plant::{StemKind, Tree};
use rayon::prelude::*;
use std::f64::consts::TAU;
use std::ops::Range;

/// The bark of one stem.
#[derive(Clone, Copy, Debug, Default)]
struct Bark {
    /// Tiles around it.
    around: f64,
    /// Tiles below its base.
    before: f64,
}

/// Where pictures are at the two ends of a piece.
#[derive(Clone, Copy, Debug)]
struct Ends {
    /// Unit vectors along the stem.
    tangents: [DVec3; 2],
    /// Unit vectors across it, towards where its picture begins.
    sides: [DVec3; 2],
    /// Tiles from the base of the stem.
    tiles: [f64; 2],
}

/// The bark of all stems, in pieces.
#[derive(Debug)]
pub(super) struct Unrolled<'a> {
    cones: &'a [Cone],
    boxes: Boxes<'a>,
    /// The stem of each piece.
    stem_of: Vec<u32>,
    /// The pieces of each stem.
    pieces: &'a [Range<usize>],
    ends: Vec<Ends>,
    barks: Vec<Bark>,
}

/// A place on a stem's bark: turns around it, from 0 to less than 1, and tiles from the ground.
#[derive(Clone, Copy, Debug, Default)]
struct Spot {
    turn: f64,
    tiles: f64,
}

impl<'a> Unrolled<'a> {
    /// The stems of `tree` whose `pieces` of `cones` are not empty, which are nowhere thinner than `cell` metres in radius.
    pub(super) fn new(tree: &Tree, pieces: &'a [Range<usize>], cones: &'a [Cone], cell: f64) -> Self {
        let mut stem_of = vec![0; cones.len()];
        let mut ends = Vec::with_capacity(cones.len());
        let mut barks: Vec<Bark> = Vec::with_capacity(pieces.len());
        let mut path = Path::default();
        for (i, (stem, own)) in tree.stems.iter().zip(pieces).enumerate() {
            if own.is_empty() {
                barks.push(Bark::default());
                continue;
            }
            stem_of[own.clone()].fill(i as u32);
            path.trace(tree, stem, TRACED * cell);
            path.rings.iter_mut().for_each(|ring| ring.radius = ring.radius.max(cell));
            let around = f64::from(unroll(&mut path.rings));
            let base = path.rings[0];
            let mut side = perpendicular(base.tangent);
            for pair in path.rings.windows(2) {
                let (a, b) = (&pair[0], &pair[1]);
                let next = transport(side, a.center, a.tangent, b.center, b.tangent);
                ends.push(Ends {
                    tangents: [a.tangent, b.tangent],
                    sides: [side, next],
                    tiles: [a.tiles, b.tiles],
                });
                side = next;
            }
            let parent = stem.parent.filter(|_| stem.kind == StemKind::Fork).map(|parent| parent as usize);
            let goes_on = parent.filter(|&parent| !pieces[parent].is_empty()).map(|parent| {
                let below = pieces[parent].clone();
                let nearest = below.min_by(|&a, &b| {
                    let far = |c: usize| cones[c].distance(base.center);
                    far(a).total_cmp(&far(b))
                });
                let Bark { around, before } = barks[parent];
                before + nearest.map_or(0.0, |c| ends[c].place(&cones[c], around, base.center).1)
            });
            barks.push(Bark { around, before: goes_on.unwrap_or(0.0) });
        }
        Self { cones, boxes: Boxes::new(cones), stem_of, pieces, ends, barks }
    }

    /// The same surface with a corner for each place in a picture. Corners that two triangles share are still in one place
    /// and have one normal.
    pub(super) fn cut(&self, block: &Block) -> Block {
        let at = |corner: u32| block.vertices[corner as usize].position;
        let near: Vec<u32> = block
            .vertices
            .par_iter()
            .map(|vertex| self.boxes.nearest(vertex.position.as_dvec3()).unwrap_or(0))
            .collect();
        // Of each triangle the stem, and of each of its corners the place on it.
        let spots: Vec<(u32, [Spot; 3])> = block
            .triangles
            .par_iter()
            .map(|triangle| {
                let stems = triangle.map(|corner| self.stem_of[near[corner as usize] as usize]);
                let stem = if stems[0] == stems[1] && stems[1] == stems[2] {
                    stems[0]
                } else {
                    let middle = triangle.iter().map(|&corner| at(corner)).sum::<Vec3>() / 3.0;
                    self.boxes.nearest(middle.as_dvec3()).map_or(stems[0], |cone| self.stem_of[cone as usize])
                };
                let spot = |corner: u32| {
                    let p = at(corner).as_dvec3();
                    let own = near[corner as usize];
                    let is_own = self.stem_of[own as usize] == stem;
                    self.spot(if is_own { own } else { self.nearest_of(stem, p) }, p)
                };
                (stem, triangle.map(spot))
            })
            .collect();
        let mut cut = Block { triangles: Vec::with_capacity(block.triangles.len()), ..Block::default() };
        let mut copies = Copies::new(block.vertices.len());
        for (triangle, (stem, spots)) in block.triangles.iter().zip(spots) {
            let turns = spots.map(|spot| spot.turn);
            let (low, high) = turns.iter().fold((1.0_f64, 0.0_f64), |(l, h), t| (l.min(*t), h.max(*t)));
            let is_across = high - low > 0.5;
            let corners = [0, 1, 2].map(|i| {
                let (corner, Spot { turn, tiles }) = (triangle[i], spots[i]);
                let is_next = is_across && turn < 0.5;
                let new = cut.vertices.len() as u32;
                let number = copies.number(corner, stem, is_next, new);
                if number == new {
                    let u = (turn + f64::from(u8::from(is_next))) * self.barks[stem as usize].around;
                    let uv = vec2(u as f32, -tiles as f32);
                    cut.vertices.push(Vertex { uv, ..block.vertices[corner as usize] });
                }
                number
            });
            cut.triangles.push(corners);
        }
        cut
    }

    /// The piece of `stem` that is nearest to `p`.
    fn nearest_of(&self, stem: u32, p: DVec3) -> u32 {
        let far = |cone: usize| self.cones[cone].distance(p);
        let own = self.pieces[stem as usize].clone();
        own.min_by(|&a, &b| far(a).total_cmp(&far(b))).unwrap_or(0) as u32
    }

    fn spot(&self, cone: u32, p: DVec3) -> Spot {
        let (piece, ends) = (&self.cones[cone as usize], &self.ends[cone as usize]);
        let bark = self.barks[self.stem_of[cone as usize] as usize];
        let (part, tiles) = ends.place(piece, bark.around, p);
        let between = |[a, b]: [DVec3; 2]| a.lerp(b, part);
        let axis = between(ends.tangents).normalize_or(DVec3::Z);
        let side = between(ends.sides);
        let side = (side - axis * side.dot(axis)).normalize_or(DVec3::X);
        let away = p - piece.from.lerp(piece.to, part);
        let turn = atan2(away.dot(axis.cross(side)), away.dot(side)) / TAU;
        Spot {
            // Rounding may make a whole turn of almost none.
            turn: if turn < 0.0 { (turn + 1.0).min(1.0 - f64::EPSILON) } else { turn },
            tiles: bark.before + tiles,
        }
    }
}

impl Ends {
    /// The part of the way along `piece` where `p` is, 0 to 1, and how many tiles from the base of the stem. Planes across
    /// the stem at both ends say where: pieces have them in common, so that nothing jumps where a stem bends. Before its
    /// base and after its tip a stem goes on by as much as it is thick.
    fn place(&self, piece: &Cone, around: f64, p: DVec3) -> (f64, f64) {
        let ahead = (p - piece.from).dot(self.tangents[0]);
        let behind = (piece.to - p).dot(self.tangents[1]);
        let ([a, b], [from, to]) = (self.tiles, piece.radii);
        let beyond = |metres: f64, radius: f64| metres.clamp(-radius, 0.0) * around / (TAU * radius);
        if ahead <= 0.0 {
            (0.0, a + beyond(ahead, from))
        } else if behind <= 0.0 {
            (1.0, b - beyond(behind, to))
        } else {
            let part = ahead / (ahead + behind);
            (part, a + (b - a) * part)
        }
    }
}

/// Numbers of the corners that each corner of the whole surface becomes.
struct Copies {
    /// The last one of each corner, as a number of `all` and one.
    last: Vec<u32>,
    all: Vec<Copy>,
}

struct Copy {
    stem: u32,
    is_next: bool,
    number: u32,
    /// The one before it of the same corner, as `Copies::last`.
    before: u32,
}

impl Copies {
    fn new(corners: usize) -> Self {
        Self { last: vec![0; corners], all: Vec::new() }
    }

    /// The number of `corner` on this stem, before or after its picture begins again; `new` if it has none yet.
    fn number(&mut self, corner: u32, stem: u32, is_next: bool, new: u32) -> u32 {
        let last = &mut self.last[corner as usize];
        let mut at = *last;
        while let Some(copy) = at.checked_sub(1).map(|place| &self.all[place as usize]) {
            if copy.stem == stem && copy.is_next == is_next {
                return copy.number;
            }
            at = copy.before;
        }
        self.all.push(Copy { stem, is_next, number: new, before: *last });
        *last = self.all.len() as u32;
        new
    }
}
