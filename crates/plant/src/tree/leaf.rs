//! A leaf or a blossom in its place.

use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A leaf or a blossom: a unit shape carried to its place.
///
/// A point (u, v, w) of the unit shape goes to `position + u·across + v·along + w·normal` where
/// `normal` is [`Leaf::normal`]. The two axes carry the scale, so they are seldom of length 1.
/// Single precision: a leaf is placed to a micrometre, and there are 300,000 of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Leaf {
    /// Where the leaf is attached, in metres.
    pub position: Vec3,
    /// From the base of the blade to its tip; its length is the leaf's length in metres.
    pub along: Vec3,
    /// Across the blade; its length is the metres that one unit of width measures.
    pub across: Vec3,
    /// Index in [`Tree::stems`](super::Tree::stems) of the stem that carries it.
    pub stem: u32,
    /// Index of its unit shape in [`Tree::leaf_shapes`](super::Tree::leaf_shapes), or of a blossom's in
    /// [`Tree::blossom_shapes`](super::Tree::blossom_shapes).
    pub shape: u16,
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
