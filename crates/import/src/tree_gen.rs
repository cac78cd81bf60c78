//! Presets of tree-gen: a dictionary with the very names and units of pleach's Weber–Penn species.
//!
//! What the names mean is in Hewitt 2017, Appendix C, and in the wiki of the add-on, "Tree Parameters".

use crate::literal::{Node, Value, entries};
use crate::program::Program;
use crate::source::Source;
use crate::translation::{Foreign, LEVELS, Translation};
use pleach_tree::SpeciesError;

/// Parameters of one number.
const SCALARS: [&str; 22] = [
    "shape",
    "g_scale",
    "g_scale_v",
    "levels",
    "ratio",
    "ratio_power",
    "flare",
    "floor_splits",
    "base_splits",
    "leaf_blos_num",
    "leaf_shape",
    "leaf_scale",
    "leaf_scale_x",
    "leaf_bend",
    "blossom_shape",
    "blossom_scale",
    "blossom_rate",
    "prune_ratio",
    "prune_width",
    "prune_width_peak",
    "prune_power_low",
    "prune_power_high",
];

/// Parameters of one number for each level.
const LISTS: [&str; 19] = [
    "base_size",
    "down_angle",
    "down_angle_v",
    "rotate",
    "rotate_v",
    "branches",
    "branch_dist",
    "length",
    "length_v",
    "taper",
    "seg_splits",
    "split_angle",
    "split_angle_v",
    "curve_res",
    "curve",
    "curve_v",
    "curve_back",
    "bend_v",
    "radius_mod",
];

/// The bare base of deeper levels, where a preset says that of the trunk alone.
const DEEPER_BASE: f64 = 0.02;

/// The shape that leaves have where a preset says 0.
const ELLIPTIC: f64 = 8.0;

/// Whether presets of tree-gen have `name`.
pub(crate) fn knows(name: &str) -> bool {
    SCALARS.contains(&name) || LISTS.contains(&name) || matches!(name, "tropism" | "bevel_res")
}

pub(crate) fn translate(source: &Source<'_>, preset: &Node) -> Result<Foreign, SpeciesError> {
    let mut species = Translation::new(source, Program::TreeGen);
    for (key, node) in entries(source, preset)? {
        let Value::Text(name) = &key.value else { continue };
        // Of equal names the last counts.
        if preset.value.get(name).is_some_and(|last| last.span != node.span) {
            continue;
        }
        match name.as_str() {
            "leaf_shape" => {
                if let Some(shape) = species.number(name, node) {
                    species.set(name, if shape == 0.0 { ELLIPTIC } else { shape }, &node.span);
                }
            }
            "base_size" if matches!(node.value, Value::Number(_)) => {
                if let Some(base) = species.number(name, node) {
                    species.set_list(name, &[base, DEEPER_BASE, DEEPER_BASE, DEEPER_BASE], &node.span);
                }
            }
            "tropism" => {
                if let Some(pull) = species.numbers::<3>(name, node) {
                    species.set_list(name, &pull, &node.span);
                }
            }
            scalar if SCALARS.contains(&scalar) => {
                if let Some(value) = species.number(name, node) {
                    species.set(name, value, &node.span);
                }
            }
            list if LISTS.contains(&list) => {
                if let Some(values) = species.numbers::<LEVELS>(name, node) {
                    species.set_list(name, &values, &node.span);
                }
            }
            _ => species.omit(name, &node.value),
        }
    }
    species.finish()
}
