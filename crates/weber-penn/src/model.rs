//! Checked parameters in the units and groups that growing needs.

use crate::params::Cursor;
use glam::DVec3;
use pleach_tree::leaf_shape::{BlossomShape, LeafShape};

/// The parameters of one level; angles in radians.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Level {
    pub(crate) base_size: f64,
    pub(crate) down_angle: f64,
    pub(crate) down_angle_v: f64,
    pub(crate) rotate: f64,
    pub(crate) rotate_v: f64,
    pub(crate) branches: f64,
    pub(crate) branch_dist: f64,
    pub(crate) length: f64,
    pub(crate) length_v: f64,
    pub(crate) taper: f64,
    pub(crate) seg_splits: f64,
    pub(crate) split_angle: f64,
    pub(crate) split_angle_v: f64,
    /// Segments, at least 1.
    pub(crate) curve_res: u32,
    pub(crate) curve: f64,
    pub(crate) curve_v: f64,
    pub(crate) curve_back: f64,
    pub(crate) bend_v: f64,
    pub(crate) radius_mod: f64,
}

impl Level {
    /// Whether the stems of this level are helices.
    pub(crate) fn is_helix(&self) -> bool {
        self.curve_v < 0.0
    }
}

/// The pruning envelope's shape parameters (Weber and Penn 1995, §4.6).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Envelope {
    pub(crate) ratio: f64,
    pub(crate) width: f64,
    pub(crate) width_peak: f64,
    pub(crate) power_low: f64,
    pub(crate) power_high: f64,
}

impl Envelope {
    /// Relative radius of the envelope at `q`, 0 at its top and 1 at its foot; 0 outside.
    ///
    /// Weber and Penn print `(1 − q)/(1 − w)` below the widest place, which jumps there unless
    /// w = 0.5; `(1 − q)/w` is continuous and the same at 0.5.
    pub(crate) fn profile(&self, q: f64) -> f64 {
        let w = self.width_peak;
        if !(0.0..=1.0).contains(&q) {
            0.0
        } else if q < 1.0 - w {
            (q / (1.0 - w)).powf(self.power_high)
        } else if w > 0.0 {
            ((1.0 - q) / w).powf(self.power_low)
        } else {
            1.0
        }
    }
}

/// Everything about a species that growing reads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model {
    pub(crate) shape: i64,
    pub(crate) g_scale: f64,
    pub(crate) g_scale_v: f64,
    pub(crate) level_count: usize,
    pub(crate) ratio: f64,
    pub(crate) ratio_power: f64,
    pub(crate) flare: f64,
    /// As the file says; 0 leaves the number of trunks to `branches[0]`.
    pub(crate) floor_splits: u32,
    pub(crate) trunks: u32,
    pub(crate) base_splits: i64,
    pub(crate) tropism: DVec3,
    pub(crate) levels: [Level; 4],
    pub(crate) leaf_blos_num: f64,
    pub(crate) leaf_shape: LeafShape,
    pub(crate) leaf_scale: f64,
    pub(crate) leaf_scale_x: f64,
    pub(crate) leaf_bend: f64,
    pub(crate) blossom_shape: BlossomShape,
    pub(crate) blossom_scale: f64,
    pub(crate) blossom_rate: f64,
    pub(crate) prune: Envelope,
}

impl Model {
    /// Reads values that [`crate::params::space`] has checked.
    pub(crate) fn new(values: &[f64]) -> Self {
        let mut c = Cursor::new(values);
        let shape = c.scalar("shape") as i64;
        let g_scale = c.scalar("g_scale");
        let g_scale_v = c.scalar("g_scale_v");
        let level_count = c.scalar("levels") as usize;
        let ratio = c.scalar("ratio");
        let ratio_power = c.scalar("ratio_power");
        let flare = c.scalar("flare");
        let floor_splits = c.scalar("floor_splits") as u32;
        let base_splits = c.scalar("base_splits") as i64;

        let mut levels = [Level::default(); 4];
        let mut each = |values: [f64; 4], set: fn(&mut Level, f64)| {
            for (level, value) in levels.iter_mut().zip(values) {
                set(level, value);
            }
        };
        each(c.levels("base_size"), |l, v| l.base_size = v);
        each(c.levels("down_angle"), |l, v| l.down_angle = v.to_radians());
        each(c.levels("down_angle_v"), |l, v| l.down_angle_v = v.to_radians());
        each(c.levels("rotate"), |l, v| l.rotate = v.to_radians());
        each(c.levels("rotate_v"), |l, v| l.rotate_v = v.to_radians());
        each(c.levels("branches"), |l, v| l.branches = v);
        each(c.levels("branch_dist"), |l, v| l.branch_dist = v);
        each(c.levels("length"), |l, v| l.length = v);
        each(c.levels("length_v"), |l, v| l.length_v = v);
        each(c.levels("taper"), |l, v| l.taper = v);
        each(c.levels("seg_splits"), |l, v| l.seg_splits = v);
        each(c.levels("split_angle"), |l, v| l.split_angle = v.to_radians());
        each(c.levels("split_angle_v"), |l, v| l.split_angle_v = v.to_radians());
        each(c.levels("curve_res"), |l, v| l.curve_res = (v as u32).max(1));
        each(c.levels("curve"), |l, v| l.curve = v.to_radians());
        each(c.levels("curve_v"), |l, v| l.curve_v = v.to_radians());
        each(c.levels("curve_back"), |l, v| l.curve_back = v.to_radians());
        each(c.levels("bend_v"), |l, v| l.bend_v = v.to_radians());
        each(c.levels("radius_mod"), |l, v| l.radius_mod = v);
        let tropism = DVec3::from(c.vector("tropism"));

        // Struct fields are evaluated in the order written, which is the order of the declarations.
        Self {
            shape,
            g_scale,
            g_scale_v,
            level_count,
            ratio,
            ratio_power,
            flare,
            floor_splits,
            trunks: if floor_splits > 0 { floor_splits } else { (levels[0].branches.abs() as u32).max(1) },
            base_splits,
            tropism,
            levels,
            leaf_blos_num: c.scalar("leaf_blos_num"),
            leaf_shape: LeafShape::from_number(c.scalar("leaf_shape") as i64).unwrap_or_default(),
            leaf_scale: c.scalar("leaf_scale"),
            leaf_scale_x: c.scalar("leaf_scale_x"),
            leaf_bend: c.scalar("leaf_bend"),
            blossom_shape: BlossomShape::from_number(c.scalar("blossom_shape") as i64).unwrap_or_default(),
            blossom_scale: c.scalar("blossom_scale"),
            blossom_rate: c.scalar("blossom_rate"),
            prune: Envelope {
                ratio: c.scalar("prune_ratio"),
                width: c.scalar("prune_width"),
                width_peak: c.scalar("prune_width_peak"),
                power_low: c.scalar("prune_power_low"),
                power_high: c.scalar("prune_power_high"),
            },
        }
    }

    /// The parameters of the children, or the leaves, of a stem of level `depth`.
    pub(crate) const fn child_level(&self, depth: usize) -> &Level {
        &self.levels[if depth + 1 < 4 { depth + 1 } else { 3 }]
    }
}

/// Relative length of a first-level branch at `q`, 0 at the trunk's tip and 1 where the bare base
/// ends: Weber and Penn's `ShapeRatio` (1995, §4.3). Shape 8 is the pruning envelope's profile.
pub(crate) fn shape_ratio(shape: i64, q: f64, envelope: &Envelope) -> f64 {
    use std::f64::consts::{FRAC_PI_2, PI};
    let flame = |q: f64| if q <= 0.7 { q / 0.7 } else { (1.0 - q) / 0.3 };
    match shape {
        1 => 0.2 + 0.8 * (PI * q).sin(),
        2 => 0.2 + 0.8 * (FRAC_PI_2 * q).sin(),
        3 => 1.0,
        4 => 0.5 + 0.5 * q,
        5 => flame(q),
        6 => 1.0 - 0.8 * q,
        7 => 0.5 + 0.5 * flame(q),
        8 => envelope.profile(q),
        _ => 0.2 + 0.8 * q,
    }
}
