//! Measurements of a tree, under names that scripts rely on.

use crate::tree::{Leaf, Parts, Tree};
use glam::{DVec3, Vec3};
use serde::Serialize;

/// Statistics of one tree. Per-level lists start with the trunks (level 0) and end with the deepest
/// level present.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TreeStats {
    /// Stems on each level, forks included.
    pub stems: Vec<usize>,
    /// Bézier points on each level.
    pub bezier_points: Vec<usize>,
    /// Sum of the lengths of the splines on each level, in metres.
    pub length_total_m: Vec<f64>,
    /// Mean length of a spline on each level, in metres. An arm of a fork counts from the fork.
    pub length_mean_m: Vec<f64>,
    /// Mean radius at the first point of each stem on each level, in metres.
    pub radius_mean_m: Vec<f64>,
    /// Number of leaves.
    pub leaves: usize,
    /// Number of blossoms.
    pub blossoms: usize,
    /// Highest point of bark, leaves or blossom, in metres above the ground.
    pub height_m: f64,
    /// Extent along x, in metres.
    pub crown_width_x_m: f64,
    /// Extent along y, in metres.
    pub crown_width_y_m: f64,
    /// Lowest place where a stem of level 1 or deeper starts, in metres; 0 without any.
    pub lowest_branch_m: f64,
    /// Sum of the areas of all leaves, one side, in square metres.
    pub leaf_area_m2: f64,
}

/// Smallest and largest coordinates of a tree, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest x, y, z.
    pub min: DVec3,
    /// Largest x, y, z.
    pub max: DVec3,
}

impl Bounds {
    const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    fn add(&mut self, point: DVec3) {
        self.min = self.min.min(point);
        self.max = self.max.max(point);
    }

    /// The bounds of `parts` of `tree`: stems with their radii (a disc at each knot), the corners of
    /// leaves and blossoms, the vertices of blobs. `None` where there are no such parts.
    #[must_use]
    pub fn new(tree: &Tree, parts: Parts) -> Option<Self> {
        let mut bounds = Self::EMPTY;
        for stem in tree.stems.iter().filter(|stem| parts.has_stem(stem.kind)) {
            let knots = tree.knots_of(stem);
            let along = |i: usize| {
                let (a, b) = (knots[i.saturating_sub(1)].point, knots[(i + 1).min(knots.len() - 1)].point);
                (b - a).try_normalize().unwrap_or(DVec3::Z)
            };
            for (i, knot) in knots.iter().enumerate() {
                // The disc across the stem reaches r·sqrt(1 − t²) along each axis.
                let t = along(i);
                let reach = (DVec3::ONE - t * t).max(DVec3::ZERO).map(f64::sqrt) * knot.radius;
                bounds.add(knot.point - reach);
                bounds.add(knot.point + reach);
            }
        }
        if parts.contains(Parts::LEAVES) {
            let reaches: Vec<[f32; 2]> =
                tree.leaf_shapes.iter().map(|shape| reach(shape.corners())).collect();
            let mut inner = bounds.inner();
            for leaf in &tree.leaves {
                // Most leaves of a crown are not at its rim.
                if inner.holds(leaf, reaches[usize::from(leaf.shape)]) {
                    continue;
                }
                let corners = tree.outline_of(leaf).corners();
                bounds.add_shape(leaf, corners.iter().map(|p| Vec3::new(p[0], p[1], 0.0)));
                inner = bounds.inner();
            }
        }
        if parts.contains(Parts::BLOSSOMS) {
            for blossom in &tree.blossoms {
                let faces = tree.blossom_shapes[usize::from(blossom.shape)].faces();
                bounds.add_shape(blossom, faces.vertices.iter().map(|&v| v.into()));
            }
        }
        if parts.contains(Parts::BLOBS) {
            tree.blob_vertices.iter().for_each(|v| bounds.add(v.as_dvec3()));
        }
        (bounds.min.x <= bounds.max.x).then_some(bounds)
    }

    fn inner(&self) -> Inner {
        Inner { min: self.min.as_vec3(), max: self.max.as_vec3() }
    }

    fn add_shape(&mut self, leaf: &Leaf, corners: impl Iterator<Item = Vec3>) {
        let normal = leaf.normal();
        for corner in corners {
            let point = leaf.position + leaf.across * corner.x + leaf.along * corner.y + normal * corner.z;
            self.add(point.as_dvec3());
        }
    }
}

/// How far the corners of a unit shape reach along u and along v, to either side.
fn reach(corners: &[[f32; 2]]) -> [f32; 2] {
    corners.iter().fold([0.0; 2], |[u, v], corner| [corner[0].abs().max(u), corner[1].abs().max(v)])
}

/// Bounds in single precision, for a quick look.
struct Inner {
    min: Vec3,
    max: Vec3,
}

impl Inner {
    /// Whether a flat shape that reaches so far lies inside for certain, by more than rounding may hide.
    fn holds(&self, leaf: &Leaf, [u, v]: [f32; 2]) -> bool {
        const ROUNDING: f32 = 1e-5;
        let reach = leaf.across.abs() * u + leaf.along.abs() * v;
        let reach = reach + Vec3::splat((leaf.position.abs() + reach).max_element() * ROUNDING + ROUNDING);
        // Also false where a number is none.
        (leaf.position - reach).cmpgt(self.min).all() && (leaf.position + reach).cmplt(self.max).all()
    }
}

impl TreeStats {
    /// Measures `tree`, its roots left out.
    #[must_use]
    pub fn new(tree: &Tree) -> Self {
        let levels = tree.level_count();
        let mut stats = Self {
            stems: vec![0; levels],
            bezier_points: vec![0; levels],
            length_total_m: vec![0.0; levels],
            length_mean_m: vec![0.0; levels],
            radius_mean_m: vec![0.0; levels],
            leaves: tree.leaves.len(),
            blossoms: tree.blossoms.len(),
            ..Self::default()
        };
        let mut lowest = f64::INFINITY;
        for stem in tree.stems.iter().filter(|stem| Parts::LEAFY.has_stem(stem.kind)) {
            let level = usize::from(stem.level);
            stats.stems[level] += 1;
            stats.bezier_points[level] += stem.knot_count as usize;
            stats.length_total_m[level] += tree.length_of(stem);
            let knots = tree.knots_of(stem);
            stats.radius_mean_m[level] += knots[0].radius;
            if level > 0 {
                lowest = lowest.min(knots[0].point.z);
            }
        }
        for level in 0..levels {
            let count = stats.stems[level].max(1) as f64;
            stats.length_mean_m[level] = stats.length_total_m[level] / count;
            stats.radius_mean_m[level] /= count;
        }
        if let Some(bounds) = Bounds::new(tree, Parts::LEAFY) {
            let size = bounds.max - bounds.min;
            stats.height_m = bounds.max.z;
            stats.crown_width_x_m = size.x;
            stats.crown_width_y_m = size.y;
        }
        stats.lowest_branch_m = if lowest.is_finite() { lowest } else { 0.0 };
        let mut areas = vec![0.0; tree.leaf_shapes.len()];
        for leaf in &tree.leaves {
            areas[usize::from(leaf.shape)] += f64::from(leaf.unit_area());
        }
        let areas = areas.iter().zip(&tree.leaf_shapes).map(|(sum, unit)| sum * f64::from(unit.area()));
        // The sum of no floats at all is -0.
        stats.leaf_area_m2 = areas.fold(0.0, |sum, area| sum + area);
        stats
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::leaf_shape::LeafShape;
    use std::sync::Arc;

    #[test]
    fn bounds_are_those_of_every_corner() {
        let shapes: Vec<_> = LeafShape::ALL.iter().map(|leaf| Arc::clone(leaf.outline())).collect();
        let mut tree = Tree { leaf_shapes: shapes, ..Tree::default() };
        let mut all = Bounds::EMPTY;
        for i in 0..4000_u32 {
            let unit = |k: u32| ((f64::from(i * 16 + k) * 0.618_034).fract() - 0.5) as f32;
            let vec = |k: u32, size: f32| Vec3::new(unit(k), unit(k + 1), unit(k + 2)) * size;
            let shape = (i % tree.leaf_shapes.len() as u32) as u16;
            let size = [0.01, 0.3, 3.0][i as usize % 3];
            let leaf =
                Leaf { position: vec(0, 20.0), along: vec(3, size), across: vec(6, size), stem: 0, shape };
            let corners = tree.leaf_shapes[usize::from(shape)].corners();
            all.add_shape(&leaf, corners.iter().map(|p| Vec3::new(p[0], p[1], 0.0)));
            tree.leaves.push(leaf);
            if i % 100 == 0 || i < 10 {
                assert_eq!(Bounds::new(&tree, Parts::LEAFY), Some(all), "{i} leaves");
            }
        }
    }
}
