//! Measurements of a tree, under names that scripts rely on.

use crate::plant::{Leaf, Tree};
use glam::{DVec3, Vec3};
use serde::Serialize;

/// Statistics of one tree. Per-level lists start with the trunks (level 0) and end with the deepest
/// level present.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct TreeStats {
    /// Stems on each level, clones included.
    pub stems: Vec<usize>,
    /// Bézier points on each level.
    pub bezier_points: Vec<usize>,
    /// Sum of the lengths of the splines on each level, in metres.
    pub length_total_m: Vec<f64>,
    /// Mean length of a spline on each level, in metres. A clone counts from its fork.
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

    /// The bounds of `tree`: stems with their radii (a ball at each knot) and, if asked, the corners
    /// of leaves and blossoms. `None` for a tree without stems.
    #[must_use]
    pub fn of(tree: &Tree, foliage: bool) -> Option<Self> {
        if tree.stems.is_empty() {
            return None;
        }
        let mut bounds = Self::EMPTY;
        for stem in &tree.stems {
            let knots = tree.knots_of(stem);
            let along = |i: usize| {
                let (a, b) = (knots[i.saturating_sub(1)].point, knots[(i + 1).min(knots.len() - 1)].point);
                (b - a).try_normalize().unwrap_or(DVec3::Z)
            };
            for (i, knot) in knots.iter().enumerate() {
                // The disc across the stem reaches r·sqrt(1 − t²) along each axis.
                let t = along(i);
                let reach = (DVec3::ONE - t * t).max(DVec3::ZERO).powf(0.5) * knot.radius;
                bounds.add(knot.point - reach);
                bounds.add(knot.point + reach);
            }
        }
        if foliage {
            let outline = tree.leaf_shape.outline();
            let corners = outline.iter().map(|p| Vec3::new(p[0], p[1], 0.0)).collect::<Vec<_>>();
            bounds.add_shapes(&tree.leaves, &corners);
            let corners = tree.blossom_shape.faces().vertices.iter().map(|&v| v.into()).collect::<Vec<_>>();
            bounds.add_shapes(&tree.blossoms, &corners);
        }
        Some(bounds)
    }

    fn add_shapes(&mut self, leaves: &[Leaf], corners: &[Vec3]) {
        for leaf in leaves {
            let normal = leaf.normal();
            for corner in corners {
                let point =
                    leaf.position + leaf.across * corner.x + leaf.along * corner.y + normal * corner.z;
                self.add(point.as_dvec3());
            }
        }
    }
}

impl TreeStats {
    /// Measures `tree`.
    #[must_use]
    pub fn of(tree: &Tree) -> Self {
        /// Chords per piece for lengths: pieces turn by well under a radian, so 8 are good to 0.3 %.
        const CHORDS: u32 = 8;
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
        for stem in &tree.stems {
            let level = usize::from(stem.level);
            stats.stems[level] += 1;
            stats.bezier_points[level] += stem.knot_count as usize;
            stats.length_total_m[level] +=
                tree.pieces_of(stem).map(|(piece, ..)| piece.length(CHORDS)).sum::<f64>();
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
        if let Some(bounds) = Bounds::of(tree, true) {
            let size = bounds.max - bounds.min;
            stats.height_m = bounds.max.z;
            stats.crown_width_x_m = size.x;
            stats.crown_width_y_m = size.y;
        }
        stats.lowest_branch_m = if lowest.is_finite() { lowest } else { 0.0 };
        let unit_area = f64::from(tree.leaf_shape.area());
        // The sum of nothing is −0, which nobody wants to read.
        let units = 0.0 + tree.leaves.iter().map(|l| f64::from(l.unit_area())).sum::<f64>();
        stats.leaf_area_m2 = unit_area * units;
        stats
    }
}
