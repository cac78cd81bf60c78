//! Measures along a walk of one parameter.

use super::measures::Values;

/// Shorter walks say too little about order.
pub(super) const MIN_STEPS: usize = 5;

/// Values along a walk: how many steps away, and every measure there.
pub(super) type Walk = Vec<(u32, Values)>;

/// One walk of one parameter of one species.
#[derive(Clone, Debug)]
pub(in super::super) struct Line {
    pub(super) species: String,
    pub(super) parameter: String,
    /// −1 towards smaller values, 1 towards larger ones.
    pub(super) sign: f64,
    pub(super) walk: Walk,
}
