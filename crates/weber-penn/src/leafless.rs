//! Leaves hang on the stems of the deepest level. If a level on the way there never grows, there are none.

use crate::model::Model;
use crate::params::table::{Id, Level};
use pleach_tree::Leafless;

/// The first number because of which there are no leaves, if `leaf_blos_num` asks for some.
pub(crate) fn leafless(model: &Model) -> Option<Leafless> {
    if model.leaf_blos_num == 0.0 {
        return None;
    }
    let count = model.level_count;
    if count < 2 {
        return Some(Leafless {
            parameter: Id::level_count.slot_name(0),
            cause: "is 1, and leaves grow on branches only, so there are none".to_owned(),
            remedy: "raise it to 2 or more".to_owned(),
        });
    }
    (1..count).find_map(|level| {
        let Level { branches, length, length_v, .. } = model.levels[level];
        let id = match () {
            () if branches == 0.0 => Id::branches,
            () if length + length_v.abs() <= 0.0 => Id::length,
            () => return None,
        };
        let remedy =
            if level > 1 { format!("raise it, or lower `levels` to {level}") } else { "raise it".to_owned() };
        Some(Leafless {
            parameter: id.slot_name(level),
            cause: format!(
                "is 0, so no stems of level {level} grow, and leaves hang on those of level {}",
                count - 1
            ),
            remedy,
        })
    })
}
