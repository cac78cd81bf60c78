//! The form of a crown beside `shape`: its outline by height, and by azimuth.

use crate::model::Model;
use crate::params::HEIGHTS;
use glam::DVec3;
use pleach_tree::math;

/// Factor on the length of a first-level branch that leaves the trunk at `q`, 0 at the trunk's tip and 1 where the bare
/// base ends: a Catmull-Rom spline through the numbers of `outline`, at least 0.
pub(crate) fn outline(model: &Model, q: f64) -> f64 {
    let last = HEIGHTS - 1;
    let at = (1.0 - q).clamp(0.0, 1.0) * last as f64;
    let i = (at as usize).min(last - 1);
    let t = at - i as f64;
    let number = |j: usize| model.outline[j.min(last)];
    let (before, from, to, after) = (number(i.saturating_sub(1)), number(i), number(i + 1), number(i + 2));
    let (leave, arrive) = ((to - before) / 2.0, (after - from) / 2.0);
    let cubic = 2.0 * (from - to) + leave + arrive;
    let square = 3.0 * (to - from) - 2.0 * leave - arrive;
    (from + t * (leave + t * (square + t * cubic))).max(0.0)
}

/// Factor on the length of a first-level branch that leaves in `direction`: by one-sidedness, and by the ellipse that a
/// flat crown is from above. 1 for an upright branch.
pub(crate) fn by_azimuth(model: &Model, direction: DVec3) -> f64 {
    let Some(level) = direction.truncate().try_normalize() else { return 1.0 };
    let depth = model.crown_depth;
    let ellipse = if depth == 1.0 { 1.0 } else { depth / math::hypot(level.x * depth, level.y) };
    ellipse * (1.0 + model.side * level.x)
}

/// Whether directions matter.
pub(crate) fn is_round(model: &Model) -> bool {
    model.side == 0.0 && model.crown_depth == 1.0
}

/// The least factor on the lengths of branches.
pub(crate) fn least(model: &Model) -> f64 {
    // Between its numbers a spline may come below all of them.
    let outline = if model.outline == [1.0; HEIGHTS] { 1.0 } else { 0.0 };
    outline * model.crown_depth * (1.0 - model.side.abs())
}
