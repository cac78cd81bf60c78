//! The numbers of a tree as the generator wants them: each with its deviation.

use crate::choices::{Dimensions, ThicknessRule};
use crate::noise::Noise;
use crate::params::{MAX_SIDES, Numbers, SCALES};
use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::param::table::Parameters;

/// A number and its greatest deviation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Varied {
    pub(crate) nominal: f64,
    pub(crate) deviation: f64,
}

/// All numbers of a tree. Angles in radians, lengths in metres.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Model {
    pub(crate) dimensions: Dimensions,
    pub(crate) generations: u16,
    pub(crate) trunk_length: f64,
    pub(crate) trunk_radius: f64,
    pub(crate) thickness_rule: ThicknessRule,
    pub(crate) thickness_factor: f64,
    pub(crate) side_branches: Varied,
    pub(crate) polar: Varied,
    pub(crate) azimuth: Varied,
    pub(crate) scale: Varied,
    pub(crate) apical_ratio: Varied,
    pub(crate) central_polar_v: f64,
    pub(crate) noise: Noise,
    pub(crate) drop: f64,
    pub(crate) drop_from: u16,
    pub(crate) leaf_rate: f64,
    pub(crate) leaf_length: f64,
    pub(crate) leaf_width: f64,
    pub(crate) leaf_shape: LeafShape,
}

impl Model {
    /// The model of `values` that their space has checked.
    pub(crate) fn new(values: &[f64]) -> Self {
        let n = Numbers::read(values);
        let varied = |nominal, deviation| Varied { nominal, deviation };
        Self {
            dimensions: n.dimensions,
            generations: n.generations,
            trunk_length: n.trunk_length,
            trunk_radius: n.trunk_length * n.thickness,
            thickness_rule: n.thickness_rule,
            thickness_factor: n.thickness_factor,
            side_branches: varied(n.side_branches, n.side_branches_v),
            polar: varied(n.polar, n.polar_v),
            azimuth: varied(n.azimuth, n.azimuth_v),
            scale: varied(n.scale, n.scale_v),
            apical_ratio: varied(n.apical_ratio, n.apical_ratio_v),
            central_polar_v: n.central_polar_v,
            noise: n.noise,
            drop: n.drop,
            drop_from: n.drop_from,
            leaf_rate: n.leaf_rate,
            leaf_length: n.leaf_length,
            leaf_width: n.leaf_width,
            leaf_shape: n.leaf_shape,
        }
    }

    /// Whether nodes have a central branch.
    pub(crate) fn has_central(&self) -> bool {
        self.apical_ratio.nominal > 0.0
    }

    /// The whole number of side branches that `count` stands for.
    pub(crate) fn sides(count: f64) -> u32 {
        count.round().clamp(0.0, MAX_SIDES) as u32
    }

    /// The length ratio of a side branch that `scale` stands for.
    pub(crate) fn side_scale(scale: f64) -> f64 {
        scale.clamp(SCALES.0, SCALES.1)
    }

    /// The length ratio of a central branch: nothing for an apical ratio of 0, so that a tree changes
    /// gradually as it gets there.
    pub(crate) fn central_scale(scale: f64, apical_ratio: f64) -> f64 {
        (Self::side_scale(scale) * apical_ratio).clamp(0.0, SCALES.1)
    }

    /// By the rule of areas: radius at the tip of a branch without daughters, over that at its foot. It is
    /// that of the thickest daughter that it would have without deviations.
    pub(crate) fn tip_taper(&self) -> f64 {
        let side = self.scale.nominal;
        let central = Self::central_scale(side, self.apical_ratio.nominal);
        let sides = f64::from(Self::sides(self.side_branches.nominal));
        let greatest = if sides > 0.0 { side.max(central) } else { central };
        let sum = sides * side * side + central * central;
        if sum > 0.0 { greatest / sum.sqrt() } else { 1.0 }
    }

    /// In a plane: how much of the angle `polar` side branch `number` of `count` takes, from 1 (right) to
    /// −1 (left).
    pub(crate) fn fan(number: u32, count: u32) -> f64 {
        if count < 2 { 1.0 } else { 1.0 - 2.0 * f64::from(number) / f64::from(count - 1) }
    }
}
