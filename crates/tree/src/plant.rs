//! The tree as flat arrays: stems, their knots, leaves and blossoms.

use crate::leaf_shape::{BlossomShape, LeafShape};
use crate::spline::Cubic;
use glam::{DVec3, Vec3};
use std::ops::Range;

/// One knot of a stem's spline. Neighbouring knots bound a cubic Bézier piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// The point itself, in metres.
    pub point: DVec3,
    /// Handle of the piece that arrives here (an absolute point, in metres).
    pub handle_in: DVec3,
    /// Handle of the piece that leaves here (an absolute point, in metres).
    pub handle_out: DVec3,
    /// Radius of the stem here, in metres. Linear in the curve parameter between knots.
    pub radius: f64,
}

/// How a stem came to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StemKind {
    /// Comes out of the ground.
    Trunk,
    /// A lateral child: leaves its parent's side at an angle (monopodial branching).
    Branch,
    /// One half of a fork (dichotomous branching): continues its parent at the parent's own level.
    Clone,
    /// Grows below or along the ground.
    Root,
}

/// A stem: a run of [`Tree::knots`] and where it stands in the plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stem {
    /// Index in [`Tree::stems`] of the stem that this one grows from; always smaller than its own.
    pub parent: Option<u32>,
    /// 0 for trunks, one more for each branching; a clone has its parent's level.
    pub level: u8,
    /// How it came to be.
    pub kind: StemKind,
    /// Metres along the parent, from its base, at which this stem starts. 0 for trunks.
    pub offset: f64,
    /// Nominal length in metres: what the model asked for. A clone carries its origin's.
    pub length: f64,
    /// First of its knots in [`Tree::knots`].
    pub first_knot: u32,
    /// Number of its knots, at least 2.
    pub knot_count: u32,
}

impl Stem {
    /// The stem's knots as a range of [`Tree::knots`].
    #[must_use]
    pub fn knots(&self) -> Range<usize> {
        let first = self.first_knot as usize;
        first..first + self.knot_count as usize
    }
}

/// A leaf or a blossom: a unit shape carried to its place.
///
/// A point (u, v, w) of the unit shape goes to `position + u·across + v·along + w·normal` where
/// `normal` is [`Leaf::normal`]. The two axes carry the scale, so they are seldom of length 1.
/// Single precision: a leaf is placed to a micrometre, and there are 300,000 of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    /// Where the leaf is attached, in metres.
    pub position: Vec3,
    /// From the base of the blade to its tip; its length is the leaf's length in metres.
    pub along: Vec3,
    /// Across the blade; its length is the metres that one unit of width measures.
    pub across: Vec3,
    /// Index in [`Tree::stems`] of the stem that carries it.
    pub stem: u32,
}

impl Leaf {
    /// The third axis, at right angles to the blade, as long as `along`.
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        self.across.cross(self.along).normalize_or_zero() * self.along.length()
    }

    /// Area of one unit square of the blade, in square metres.
    #[must_use]
    pub fn unit_area(&self) -> f32 {
        self.across.cross(self.along).length()
    }
}

/// A whole plant. Metres, z up, right-handed; the ground is z = 0.
///
/// Flat arrays that [`Tree::clear`] empties and keeps, so that growing the next tree into the same
/// value allocates nothing once the arrays are large enough.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tree {
    /// Stems, parents before children.
    pub stems: Vec<Stem>,
    /// Knots of all stems, each stem's in one run.
    pub knots: Vec<Knot>,
    /// Leaves, all of shape `leaf_shape`.
    pub leaves: Vec<Leaf>,
    /// Blossoms, all of shape `blossom_shape`.
    pub blossoms: Vec<Leaf>,
    /// The unit shape of every leaf.
    pub leaf_shape: LeafShape,
    /// The unit shape of every blossom.
    pub blossom_shape: BlossomShape,
}

impl Tree {
    /// Removes every part and keeps the memory.
    pub fn clear(&mut self) {
        self.stems.clear();
        self.knots.clear();
        self.leaves.clear();
        self.blossoms.clear();
    }

    /// Gives back memory that holds nothing.
    pub fn shrink_to_fit(&mut self) {
        self.stems.shrink_to_fit();
        self.knots.shrink_to_fit();
        self.leaves.shrink_to_fit();
        self.blossoms.shrink_to_fit();
    }

    /// Makes room for all of `others`, to be appended, and for nothing else.
    pub fn reserve_for(&mut self, others: &[Self]) {
        let sum = |len: fn(&Self) -> usize| others.iter().map(len).sum();
        self.stems.reserve_exact(sum(|t| t.stems.len()));
        self.knots.reserve_exact(sum(|t| t.knots.len()));
        self.leaves.reserve_exact(sum(|t| t.leaves.len()));
        self.blossoms.reserve_exact(sum(|t| t.blossoms.len()));
    }

    /// The knots of `stem`.
    #[must_use]
    pub fn knots_of(&self, stem: &Stem) -> &[Knot] {
        &self.knots[stem.knots()]
    }

    /// The Bézier pieces of `stem` from base to tip, each with the radii at its two ends.
    pub fn pieces_of(&self, stem: &Stem) -> impl Iterator<Item = (Cubic, f64, f64)> + '_ {
        self.knots_of(stem).windows(2).map(|w| (piece(&w[0], &w[1]), w[0].radius, w[1].radius))
    }

    /// The deepest level present plus one.
    #[must_use]
    pub fn level_count(&self) -> usize {
        self.stems.iter().map(|s| usize::from(s.level) + 1).max().unwrap_or(0)
    }

    /// Appends `other`, whose indices are its own, except for the parents of those stems for which
    /// `rooted_here` holds: these are indices in `self` already.
    pub fn append(&mut self, other: &Self, rooted_here: impl Fn(&Stem) -> bool) {
        let stem_base = self.stems.len() as u32;
        let knot_base = self.knots.len() as u32;
        self.stems.extend(other.stems.iter().map(|stem| Stem {
            parent: stem.parent.map(|p| if rooted_here(stem) { p } else { p + stem_base }),
            first_knot: stem.first_knot + knot_base,
            ..*stem
        }));
        self.knots.extend_from_slice(&other.knots);
        let moved = |leaf: &Leaf| Leaf { stem: leaf.stem + stem_base, ..*leaf };
        self.leaves.extend(other.leaves.iter().map(moved));
        self.blossoms.extend(other.blossoms.iter().map(moved));
    }

    /// Checks every promise of the types above; the first that is broken comes back as a sentence.
    ///
    /// # Errors
    /// What is wrong and where, for tests and for generators under development.
    pub fn well_formed(&self) -> Result<(), String> {
        for (i, stem) in self.stems.iter().enumerate() {
            let at = |what: &str| Err(format!("stem {i}: {what}"));
            if stem.knot_count < 2 || stem.knots().end > self.knots.len() {
                return at("needs at least two knots, inside the array");
            }
            match stem.parent {
                None if stem.level != 0 => return at("only trunks and roots have no parent"),
                Some(p) if p as usize >= i => return at("comes before its parent"),
                Some(p) => {
                    let parent = self.stems[p as usize].level;
                    let expected = if stem.kind == StemKind::Clone { parent } else { parent + 1 };
                    if stem.kind != StemKind::Root && stem.level != expected {
                        return at("is not one level below its parent");
                    }
                }
                None => {}
            }
            if !(stem.length.is_finite() && stem.length >= 0.0 && stem.offset.is_finite()) {
                return at("length and offset must be finite");
            }
            for knot in self.knots_of(stem) {
                if !(knot.point.is_finite() && knot.handle_in.is_finite() && knot.handle_out.is_finite()) {
                    return at("has a knot that is not finite");
                }
                if !(knot.radius.is_finite() && knot.radius >= 0.0) {
                    return at("has a radius that is negative or not finite");
                }
            }
        }
        for (what, leaves) in [("leaf", &self.leaves), ("blossom", &self.blossoms)] {
            for (i, leaf) in leaves.iter().enumerate() {
                if !(leaf.position.is_finite() && leaf.along.is_finite() && leaf.across.is_finite()) {
                    return Err(format!("{what} {i} is not finite"));
                }
                if leaf.stem as usize >= self.stems.len() {
                    return Err(format!("{what} {i} hangs on a stem that does not exist"));
                }
            }
        }
        Ok(())
    }
}

/// The Bézier piece between two neighbouring knots.
#[must_use]
pub fn piece(from: &Knot, to: &Knot) -> Cubic {
    Cubic::new(from.point, from.handle_out, to.handle_in, to.point)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{dvec3, vec3};

    fn pole(level: u8, parent: Option<u32>, first_knot: u32) -> Stem {
        let kind = if parent.is_some() { StemKind::Branch } else { StemKind::Trunk };
        Stem { parent, level, kind, offset: 0.0, length: 1.0, first_knot, knot_count: 2 }
    }

    fn knot(z: f64) -> Knot {
        let point = dvec3(0.0, 0.0, z);
        Knot { point, handle_in: point, handle_out: point, radius: 0.1 }
    }

    fn small() -> Tree {
        let leaf = Leaf { position: Vec3::ZERO, along: vec3(0.0, 0.0, 2.0), across: Vec3::X, stem: 0 };
        Tree {
            stems: vec![pole(0, None, 0), pole(1, Some(0), 2)],
            knots: (0..4).map(|i| knot(f64::from(i))).collect(),
            leaves: vec![leaf],
            ..Tree::default()
        }
    }

    #[test]
    fn appending_moves_every_index() {
        let mut tree = small();
        let mut branches = small();
        branches.stems = vec![pole(1, Some(0), 0), pole(2, Some(0), 2)];
        branches.leaves[0].stem = 1;
        tree.append(&branches, |stem| stem.level == 1);
        assert_eq!(tree.stems.len(), 4);
        assert_eq!((tree.stems[2].parent, tree.stems[2].first_knot), (Some(0), 4));
        assert_eq!((tree.stems[3].parent, tree.stems[3].first_knot), (Some(2), 6));
        assert_eq!(tree.leaves[1].stem, 3);
        tree.well_formed().unwrap();
    }

    #[test]
    fn broken_promises_are_named() {
        let breaks: [(&str, fn(&mut Tree)); 5] = [
            ("two knots", |t| t.stems[1].knot_count = 1),
            ("before its parent", |t| t.stems[1].parent = Some(1)),
            ("one level below", |t| t.stems[1].level = 2),
            ("not finite", |t| t.knots[3].point.x = f64::NAN),
            ("does not exist", |t| t.leaves[0].stem = 9),
        ];
        small().well_formed().unwrap();
        for (what, damage) in breaks {
            let mut tree = small();
            damage(&mut tree);
            let message = tree.well_formed().unwrap_err();
            assert!(message.contains(what), "{message}");
        }
    }

    #[test]
    fn a_leaf_measures_itself() {
        let leaf = small().leaves[0];
        assert_eq!(leaf.unit_area(), 2.0);
        assert_eq!(leaf.normal(), vec3(0.0, -2.0, 0.0));
    }
}
