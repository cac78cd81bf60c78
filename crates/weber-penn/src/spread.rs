//! How far draws of single stems may lie from their own.

use crate::model::Model;
use pleach_tree::Spread;

/// The spreads of the levels of `model`.
pub(crate) fn spreads(model: &Model) -> Vec<Spread> {
    let level = |number: usize| {
        if number == 0 {
            return Spread::for_trunks();
        }
        let level = &model.levels[number];
        Spread::for_stems(Spread {
            azimuth: level.rotate_v,
            pitch: level.down_angle_v,
            length: if level.length > 0.0 { level.length_v / level.length } else { 0.0 },
        })
    };
    (0..model.level_count).map(level).collect()
}
