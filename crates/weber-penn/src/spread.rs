//! How far draws of single stems may lie from their own.

use crate::model::Model;
use pleach_tree::Spread;

/// Degrees and parts of a length that stems differ by in nature where a species says that they do not.
const NATURAL: Spread = Spread { azimuth: 10.0, pitch: 4.0, length: 0.06 };
/// The part of a species' own variation that is given on top of what its stems have drawn.
const SHARE: f64 = 0.5;
/// Degrees that a trunk may lean from where it stands; what it does about its axis is free.
const LEAN: f64 = 2.0;

/// The spreads of the levels of `model`.
pub(crate) fn spreads(model: &Model) -> Vec<Spread> {
    let level = |number: usize| {
        if number == 0 {
            // A picture shows the height of a tree, so a trunk has no other.
            return Spread::from_degrees(180.0, LEAN, 0.0);
        }
        let level = &model.levels[number];
        let part = |varied: f64, least: f64| (SHARE * varied.abs()).max(least);
        let length = if level.length > 0.0 { level.length_v / level.length } else { 0.0 };
        Spread {
            azimuth: part(level.rotate_v, NATURAL.azimuth.to_radians()).min(std::f64::consts::PI),
            pitch: part(level.down_angle_v, NATURAL.pitch.to_radians()).min(MOST_PITCH),
            length: part(length, NATURAL.length).min(MOST_LENGTH),
        }
    };
    (0..model.level_count).map(level).collect()
}

/// Bounds of what a species may ask for, radians and a part of the length.
const MOST_PITCH: f64 = 0.35;
const MOST_LENGTH: f64 = 0.25;
