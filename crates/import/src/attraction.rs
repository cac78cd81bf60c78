//! How far stems bend towards the light, in the terms of both models.

use std::f64::consts::PI;

/// Degrees by which tree-gen turns a stem that is level, for each unit of tropism at each segment.
pub(crate) const DEGREES_PER_SEGMENT: f64 = 10.0;

/// The vertical tropism that bends a level stem of `segments` segments as far as the vertical attraction of Weber and
/// Penn (1995, §4.4).
///
/// They turn each segment by attraction × declination / segments, in radians: a level stem by attraction × 90° in all.
/// tree-gen turns each segment by 10° for each unit of tropism, however many there are.
pub(crate) fn tropism(attraction: f64, segments: f64) -> f64 {
    let bend = (attraction * PI / 2.0).to_degrees();
    bend / (DEGREES_PER_SEGMENT * segments.max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_stem_bends_as_far() {
        assert!((tropism(1.0, 9.0) - 1.0).abs() < 1e-12);
        assert!((tropism(-2.0, 3.0) + 6.0).abs() < 1e-12);
        assert_eq!(tropism(0.0, 0.0), 0.0);
    }
}
