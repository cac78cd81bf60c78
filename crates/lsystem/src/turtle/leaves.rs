//! Leaves: put one by one, spread over pieces, or drawn as polygons.

use crate::header::Header;
use crate::syntax::SettingKey;
use glam::DVec3;
use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::piece;
use pleach_tree::turtle::Turtle;
use pleach_tree::{Leaf, Tree};
use std::sync::Arc;

/// Leaves that are spread over one piece, once its curve is known. Angles in degrees.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    /// The knot where the piece begins.
    pub(super) first_knot: usize,
    /// The turtle's right axis on the piece.
    pub(super) right: DVec3,
    pub(super) stem: u32,
    pub(super) count: u32,
    /// Between leaf and stem.
    pub(super) down: f64,
    /// From leaf to leaf, around the stem.
    pub(super) turn: f64,
    /// Around the stem, of the leaf before the first.
    pub(super) rotation: f64,
}

/// Sizes of leaves, and those that wait for their curves.
#[derive(Debug)]
pub(super) struct Leaves {
    wanted: bool,
    length: f64,
    width: f64,
    bend: f64,
    /// Width of the unit shape.
    unit: f64,
    groups: Vec<Group>,
}

impl Leaves {
    pub(super) fn new(header: &Header, count: usize, wanted: bool, tree: &mut Tree) -> Self {
        let number = header.get(SettingKey::LeafShape) as i64;
        // 0 is the default shape, as in the parametric model.
        let shape = LeafShape::from_number(number).unwrap_or_default();
        tree.leaf_shapes.push(Arc::clone(shape.outline()));
        tree.leaves.reserve_exact(count);
        let length = header.get(SettingKey::LeafScale) * header.get(SettingKey::Scale);
        Self {
            wanted,
            length,
            width: length * header.get(SettingKey::LeafScaleX),
            bend: header.get(SettingKey::LeafBend),
            unit: f64::from(shape.outline().width()),
            groups: Vec::new(),
        }
    }

    /// Puts a leaf where the turtle stands, along its direction.
    pub(super) fn put(&self, mut turtle: Turtle, stem: u32, tree: &mut Tree) {
        if !self.wanted {
            return;
        }
        if self.bend > 0.0 {
            turtle.face_the_light(self.bend);
        }
        tree.leaves.push(Leaf {
            position: turtle.position.as_vec3(),
            along: (turtle.direction * self.length).as_vec3(),
            across: (turtle.right * self.width).as_vec3(),
            stem,
            shape: 0,
        });
    }

    /// A filled polygon becomes a leaf of the grammar's shape, stretched over it: from the first
    /// corner to the farthest, as wide as the polygon.
    pub(super) fn polygon(&self, corners: &[DVec3], stem: u32, tree: &mut Tree) {
        let (true, Some(&base)) = (self.wanted, corners.first()) else { return };
        let far = corners.iter().max_by(|a, b| a.distance(base).total_cmp(&b.distance(base)));
        let along = far.map_or(DVec3::ZERO, |&tip| tip - base);
        let next = corners.iter().cycle().skip(1);
        let normal: DVec3 = corners.iter().zip(next).map(|(&a, &b)| (a - base).cross(b - base)).sum();
        let Some(side) = along.cross(normal).try_normalize() else { return };
        let reach = || corners.iter().map(|&c| (c - base).dot(side));
        let width = reach().fold(0.0, f64::max) - reach().fold(0.0, f64::min);
        tree.leaves.push(Leaf {
            position: base.as_vec3(),
            along: along.as_vec3(),
            across: (side * (width / self.unit)).as_vec3(),
            stem,
            shape: 0,
        });
    }

    pub(super) fn group(&mut self, group: Group) {
        if self.wanted {
            self.groups.push(group);
        }
    }

    /// Puts the leaves of all pieces on their curves' surfaces.
    pub(super) fn finish(&mut self, tree: &mut Tree) {
        for group in std::mem::take(&mut self.groups) {
            let [from, to] = [tree.knots[group.first_knot], tree.knots[group.first_knot + 1]];
            let curve = piece(&from, &to);
            let fallback = curve.points[3] - curve.points[0];
            let fallback = fallback.try_normalize().unwrap_or_else(|| group.right.any_orthonormal_vector());
            for number in 0..group.count {
                let t = (f64::from(number) + 0.5) / f64::from(group.count);
                let direction = curve.tangent(t, fallback);
                let right = group.right - direction * group.right.dot(direction);
                let right = right.try_normalize().unwrap_or_else(|| direction.any_orthonormal_vector());
                let mut turtle = Turtle { position: curve.at(t), direction, right };
                let rotation = group.rotation + f64::from(number + 1) * group.turn;
                turtle.roll_right((rotation % 360.0).to_radians());
                turtle.position += turtle.down() * (from.radius + (to.radius - from.radius) * t);
                turtle.pitch_down(group.down.to_radians());
                self.put(turtle, group.stem, tree);
            }
        }
    }
}
