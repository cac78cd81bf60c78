//! The row of a fit.

use crate::record::Fixed;
use serde::{Deserialize, Serialize};

/// A fit of a goal; numbers that it does not have are empty.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(in super::super) struct Fit {
    pub(super) goal: String,
    pub(super) kind: String,
    pub(super) method: String,
    pub(super) repetition: u64,
    pub(super) evaluations: u64,
    /// The species that the first guess names, and how sure it is.
    pub(super) named: String,
    pub(super) confidence: Option<Fixed<4>>,
    /// Of the nearest tree before the search.
    pub(super) guess_likeness: Option<Fixed<4>>,
    pub(super) guess_iou: Option<Fixed<4>>,
    pub(super) likeness: Fixed<4>,
    pub(super) iou: Fixed<4>,
    pub(super) blurred_iou_64: Fixed<4>,
    pub(super) boundary_f: Fixed<4>,
    pub(super) pixel_accuracy: Fixed<4>,
    pub(super) empty_accuracy: Fixed<4>,
    pub(super) best_ellipse_iou: Fixed<4>,
    /// With the goal as it was before it was spoilt.
    pub(super) clean_likeness: Option<Fixed<4>>,
    pub(super) clean_iou: Option<Fixed<4>>,
    /// With a picture that the search has not seen.
    pub(super) held_out_likeness: Option<Fixed<4>>,
    pub(super) held_out_iou: Option<Fixed<4>>,
    /// Of trees of other seeds: mean, and deviation of one.
    pub(super) fresh_likeness: Option<Fixed<4>>,
    pub(super) fresh_likeness_sd: Option<Fixed<4>>,
    pub(super) fresh_iou: Option<Fixed<4>>,
    pub(super) fresh_iou_sd: Option<Fixed<4>>,
    /// Of trees of the true parameters.
    pub(super) ceiling_likeness: Option<Fixed<4>>,
    pub(super) ceiling_iou: Option<Fixed<4>>,
    /// 0 for the best ellipse, 1 for trees of the true parameters.
    pub(super) skill: Option<Fixed<4>>,
    pub(super) wall_s: Fixed<1>,
}

impl Fit {
    /// Whether two rows are of the same fit.
    pub(in super::super) fn is_same(a: &Self, b: &Self) -> bool {
        (&a.goal, &a.method, a.repetition) == (&b.goal, &b.method, b.repetition)
    }
}
