//! What is in a picture of a tree.

use serde::{Deserialize, Serialize};

/// Heights at which the outline of a crown is read: 0, 1/32, …, 1.
pub const CROWN_HEIGHTS: usize = 33;
/// Bands of height over which the course of gaps is read.
pub const GAP_HEIGHTS: usize = 16;
/// Sizes of gaps that are told apart.
pub const GAP_SIZES: usize = 4;

/// A trunk where it meets the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Foot {
    /// Where its axis meets the ground, in heights of the tree to the right of the middle of all feet.
    pub x: f64,
    /// Its thickness at right angles to its axis, in heights of the tree: the mean between 3 and 10 % of the height,
    /// above the flare of the roots, or as far up as it can be seen.
    pub width: f64,
}

/// How far a tree reaches to both sides at [`CROWN_HEIGHTS`] even heights from the ground to the top.
///
/// In heights of the tree from the vertical through the middle of the feet, positive outwards; negative where all
/// of a row lies on the other side, and 0 on both sides where there is nothing. Gaps narrower than 3 % of the height
/// are closed first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Crown {
    /// To the left.
    pub left: Vec<f64>,
    /// To the right.
    pub right: Vec<f64>,
}

/// What is in a picture of a tree: measures, each with a confidence in 0..=1.
///
/// Six confidences are calibrated: fitted to pictures of grown trees and to ragged masks of them,
/// so that of the readings with such a confidence that part is right in both together. They are `feet_confidence`,
/// `width_confidence`, `lean_deg_confidence`, `bare_height_confidence`, `first_fork_confidence` and
/// `leaves_confidence`. That of the lean is lowered further where the trunk is bare over less than 10 % of the height,
/// or seen over less than 2.5 of its widths. Of clean pictures widths and bare heights are right more often than their
/// confidence says, of ragged masks less often: a mask that is a pixel too wide has another trunk.
///
/// All other confidences are formulas of what was seen: size of the picture, sides that cut the crown, amount of fine
/// ink. Their constants are estimates: they rank readings. 0 stands beside what is not known, which is `None`, empty
/// or 0. The names of the fields are those of the JSON and do not change.
///
/// Lengths are in heights of the tree, from the lowest to the highest row of ink. x counts to the right from the
/// middle of the feet: the mean of their places, weighted by their widths. y counts up from the ground. Angles are in
/// degrees.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reading {
    /// Where trunks meet the ground, from left to right.
    ///
    /// Trunks are told apart at 5 % of the height, or lower where foliage is in the way. So one with a flare of roots
    /// is one foot, one that divides below that height is as many as it has arms, and trunks that lie before one
    /// another are one. Foliage that hangs to the ground is not a foot.
    pub feet: Vec<Foot>,
    /// Confidence that the number of feet is right.
    pub feet_confidence: f64,
    /// Confidence that the width of the main trunk is right to 15 %.
    pub width_confidence: f64,
    /// The axis of the main trunk, the widest one, as points `[x, y, width]` from the ground up to where the crown
    /// hides it. The width is along the row.
    pub trunk: Vec<[f64; 3]>,
    /// Confidence that the axis is a trunk's.
    pub trunk_confidence: f64,
    /// Angle of the main trunk from the vertical, positive to the right, in -90..=90: of the straight line fitted to
    /// its axis up to the bare height, but at least up to 12 % and at most up to half of the height.
    pub lean_deg: Option<f64>,
    /// Confidence that the lean is right to 3°.
    pub lean_deg_confidence: f64,
    /// Height at which the main trunk first divides into arms of which the thinner one is at least half as thick as
    /// the thicker one, and which are at least 10° apart: where their axes meet. `None` if none is seen.
    pub first_fork: Option<f64>,
    /// Confidence that the fork is there, to 8 % of the height, or that there is none below the crown.
    pub first_fork_confidence: f64,
    /// Angles of the arms of the first fork from the vertical, positive to the right, from left to right.
    pub fork_arms_deg: Vec<f64>,
    /// Place of the first fork to the right of the middle of the feet; `None` without one.
    pub fork_x: Option<f64>,
    /// Height up to which the main trunk is bare: where the first branch, arm or foliage can be told from it, or
    /// hides it.
    pub bare_height: Option<f64>,
    /// Confidence that the bare height is right to 5 % of the height.
    pub bare_height_confidence: f64,
    /// The outline.
    pub crown: Crown,
    /// Confidence in the outline: lower where the picture's edge cuts the crown.
    pub crown_confidence: f64,
    /// Height at which the outline above the bare height is widest, over bands of 3 % of the height.
    pub crown_widest: Option<f64>,
    /// The outline's width there.
    pub crown_width: Option<f64>,
    /// Confidence in these two.
    pub crown_widest_confidence: f64,
    /// The area within the outline above the bare height to the right of the middle of the feet, less the area to
    /// the left, per sum of the two: -1..=1, positive where the crown is on the right.
    pub asymmetry: Option<f64>,
    /// Confidence in the asymmetry.
    pub asymmetry_confidence: f64,
    /// Part of the area within the outline above the bare height, holes filled, that is not ink: 0..=1.
    pub gap_share: Option<f64>,
    /// The same in [`GAP_HEIGHTS`] bands of even height from the ground up; 0 below the bare height.
    pub gap_by_height: Vec<f64>,
    /// How much of `gap_share` are gaps up to 1 %, 2 %, and 4 % of the height wide, and wider ones: parts of the area
    /// within the outline, by openings with squares.
    pub gap_sizes: Vec<f64>,
    /// Confidence in these three.
    pub gap_share_confidence: f64,
    /// Number of pieces of the crown that are left when all that is thinner than 2 % of the height is removed.
    pub clumps: u32,
    /// Confidence in the number of clumps.
    pub clumps_confidence: f64,
    /// Mean width of ink above the bare height that is thinner than 1.6 % of the height: twice its area per length of
    /// its edge.
    pub twig_fineness: Option<f64>,
    /// Confidence in the fineness of twigs.
    pub twig_fineness_confidence: f64,
    /// Mean size of leaves, or of tufts where leaves cannot be told apart, in pixels of the picture: four times the
    /// area per length of edge of fine ink. `None` where there are no leaves or no fine ink.
    pub leaf_size_px: Option<f64>,
    /// Confidence in the size of leaves.
    pub leaf_size_px_confidence: f64,
    /// Mean elevation of thin strokes above the bare height, positive where they rise away from the axis and negative
    /// where they hang, in -64..=64; upright strokes are left out, since they have no side.
    pub stroke_deg: Option<f64>,
    /// Confidence in the direction of strokes.
    pub stroke_deg_confidence: f64,
    /// Part of the thin strokes that are upright, within 13°: 0..=1.
    pub stroke_upright: Option<f64>,
    /// Part of the free ends that point down: near 0.5 for most crowns, more where twigs hang.
    pub hanging_ends: Option<f64>,
    /// Which way the texture of the crown above the bare height runs, seen at 1/128 of the height: from -1, level, to 1,
    /// upright. Curtains of hanging twigs are above 0.2, layers of branches below -0.1.
    pub grain_upright: Option<f64>,
    /// The same at 45°: from -1, down and away from the axis, to 1, up and away from it.
    pub grain_rising: Option<f64>,
    /// Confidence in these two.
    pub grain_confidence: f64,
    /// Part of the tree's ink that is foliage, in 0..=1, where colours tell it, or where the tree was grown: there it is
    /// what its stems alone do not cover. `None` of a silhouette.
    pub foliage_share: Option<f64>,
    /// Confidence in it.
    pub foliage_share_confidence: f64,
    /// Whether there are leaves.
    pub leaves: bool,
    /// Confidence that this is right.
    pub leaves_confidence: f64,
}
