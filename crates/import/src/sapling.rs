//! Presets of Sapling Tree Gen: Weber and Penn's model under other names.
//!
//! What the names mean is in Blender's manual, "Sapling Tree Gen", and in the wiki of the improved Sapling. Angles are
//! degrees, lengths metres, lists have a value for each level.

use crate::attraction::tropism;
use crate::literal::{Node, Value, entries};
use crate::program::Program;
use crate::source::Source;
use crate::translation::{Foreign, LEVELS, Translation};
use pleach_tree::SpeciesError;
use std::ops::Range;

/// Numbers that mean the same: Sapling's name and pleach's.
const SCALARS: [(&str, &str); 12] = [
    ("scale", "g_scale"),
    ("scaleV", "g_scale_v"),
    ("ratio", "ratio"),
    ("ratioPower", "ratio_power"),
    ("baseSplits", "base_splits"),
    ("leaves", "leaf_blos_num"),
    ("leafScale", "leaf_scale"),
    ("leafScaleX", "leaf_scale_x"),
    ("pruneWidth", "prune_width"),
    ("pruneWidthPeak", "prune_width_peak"),
    ("prunePowerLow", "prune_power_low"),
    ("prunePowerHigh", "prune_power_high"),
];

/// Lists that mean the same.
const LISTS: [(&str, &str); 10] = [
    ("length", "length"),
    ("lengthV", "length_v"),
    ("taper", "taper"),
    ("segSplits", "seg_splits"),
    ("splitAngle", "split_angle"),
    ("splitAngleV", "split_angle_v"),
    ("curveRes", "curve_res"),
    ("curve", "curve"),
    ("curveV", "curve_v"),
    ("curveBack", "curve_back"),
];

/// Names that are read one by one.
const OTHERS: [&str; 23] = [
    "levels",
    "shape",
    "customShape",
    "branches",
    "baseSize",
    "baseSize_s",
    "downAngle",
    "downAngleV",
    "rotate",
    "rotateV",
    "leafDownAngle",
    "leafDownAngleV",
    "leafRotate",
    "leafRotateV",
    "leafShape",
    "bend",
    "rootFlare",
    "scale0",
    "radiusTweak",
    "attractUp",
    "showLeaves",
    "prune",
    "pruneRatio",
];

/// The most levels that pleach's trees have.
const MAX_LEVELS: f64 = LEVELS as f64;
/// Levels of Sapling's default tree.
const USUAL_LEVELS: f64 = 3.0;
/// Segments of a second-level stem where a preset does not say how many.
const USUAL_SEGMENTS: f64 = 3.0;

/// Whether presets of Sapling have `name`.
pub(crate) fn knows(name: &str) -> bool {
    SCALARS.iter().chain(&LISTS).any(|(theirs, _)| *theirs == name) || OTHERS.contains(&name)
}

pub(crate) fn translate(source: &Source<'_>, preset: &Node) -> Result<Foreign, SpeciesError> {
    let species = Translation::new(source, Program::Sapling);
    let mut reader = Reader { preset, species, segments: USUAL_SEGMENTS };
    for (theirs, ours) in SCALARS {
        if let Some((value, span)) = reader.number(theirs) {
            reader.species.set(ours, value, &span);
        }
    }
    for (theirs, ours) in LISTS {
        if let Some((values, span)) = reader.list(theirs) {
            if ours == "curve_res" {
                reader.segments = values[2];
            }
            reader.species.set_list(ours, &values, &span);
        }
    }
    let levels = reader.levels();
    reader.crown();
    reader.trunk();
    reader.angles(levels);
    reader.foliage();
    reader.attraction();
    reader.pruning();
    for (key, node) in entries(source, preset)? {
        if let Value::Text(name) = &key.value
            && !knows(name)
        {
            reader.species.omit(name, &node.value);
        }
    }
    reader.species.finish()
}

struct Reader<'a> {
    preset: &'a Node,
    species: Translation<'a>,
    /// Segments of a second-level stem.
    segments: f64,
}

impl Reader<'_> {
    fn number(&mut self, name: &str) -> Option<(f64, Range<usize>)> {
        let node = self.preset.value.get(name)?;
        Some((self.species.number(name, node)?, node.span.clone()))
    }

    fn list(&mut self, name: &str) -> Option<([f64; LEVELS], Range<usize>)> {
        let node = self.preset.value.get(name)?;
        Some((self.species.numbers(name, node)?, node.span.clone()))
    }

    fn is_off(&self, name: &str) -> bool {
        self.preset.value.get(name).is_some_and(|node| node.value == Value::Flag(false))
    }

    /// Levels of stems, as many as pleach's trees have at most.
    fn levels(&mut self) -> usize {
        let Some((levels, span)) = self.number("levels") else { return USUAL_LEVELS as usize };
        if levels > MAX_LEVELS {
            self.species
                .note(format!("levels are {levels} there and {MAX_LEVELS} here, the most that there are"));
        }
        self.species.set("levels", levels.min(MAX_LEVELS), &span);
        levels.clamp(1.0, MAX_LEVELS) as usize
    }

    /// The outline of the crown. Sapling's 0 to 7 are those of Weber and Penn.
    fn crown(&mut self) {
        /// Tapered downwards: half as long at the bare base as at the tip.
        const INVERSE_TAPERED: [f64; 5] = [0.5, 0.625, 0.75, 0.875, 1.0];
        const CYLINDRICAL: f64 = 3.0;
        let custom = self.preset.value.get("customShape").cloned();
        if let Some((shape, span)) = self.number("shape") {
            let outline = if shape == 8.0 {
                custom.and_then(|node| self.species.numbers::<4>("customShape", &node)).map(outline)
            } else if shape == 10.0 {
                Some(INVERSE_TAPERED)
            } else {
                None
            };
            self.species.set("shape", if outline.is_some() { CYLINDRICAL } else { shape }, &span);
            if let Some(outline) = outline {
                self.species.set_list("outline", &outline, &span);
            }
        }
        if let Some(([_, first, second, third], span)) = self.list("branches") {
            self.species.set_list("branches", &[1.0, first, second, third], &span);
        }
        if let Some((base, span)) = self.number("baseSize") {
            let factor = self.number("baseSize_s").map_or(0.0, |(factor, _)| factor);
            let bases = [base, base * factor, base * factor * factor, base * factor * factor * factor];
            self.species.set_list("base_size", &bases, &span);
        }
    }

    /// Flare, and factors on radii.
    fn trunk(&mut self) {
        if let Some((factor, span)) = self.number("rootFlare") {
            // There a factor on the radius, here what is added to it.
            self.species.set("flare", (factor - 1.0).max(0.0), &span);
        }
        let scale = self.number("scale0");
        let tweak = self.list("radiusTweak");
        if let Some(span) =
            scale.as_ref().map(|(_, span)| span).or(tweak.as_ref().map(|(_, span)| span)).cloned()
        {
            let mut factors = tweak.map_or([1.0; LEVELS], |(factors, _)| factors);
            factors[0] *= scale.map_or(1.0, |(scale, _)| scale);
            self.species.set_list("radius_mod", &factors, &span);
        }
    }

    /// Angles of stems, and of leaves, which have names of their own in the improved Sapling.
    fn angles(&mut self, levels: usize) {
        let leaves = [
            ("downAngle", "leafDownAngle", "down_angle"),
            ("downAngleV", "leafDownAngleV", "down_angle_v"),
            ("rotate", "leafRotate", "rotate"),
            ("rotateV", "leafRotateV", "rotate_v"),
        ];
        for (stems, leaves, ours) in leaves {
            let of_leaves = self.number(leaves);
            let Some((mut angles, span)) = self.list(stems) else {
                if of_leaves.is_some() {
                    self.species.omit_name(leaves);
                }
                continue;
            };
            match of_leaves {
                // With four levels of stems, the last has its angles from the same place as its leaves.
                Some(_) if levels >= LEVELS => self.species.omit_name(leaves),
                Some((angle, _)) => angles[levels] = angle,
                None => {}
            }
            if ours == "rotate_v" {
                angles = angles.map(f64::abs);
            }
            self.species.set_list(ours, &angles, &span);
        }
    }

    fn foliage(&mut self) {
        if self.is_off("showLeaves") {
            self.species.bare();
        }
        if let Some(node) = self.preset.value.get("leafShape") {
            let shape = match &node.value {
                Value::Text(text) if text == "hex" => Some(8.0),
                Value::Text(text) if text == "rect" => Some(9.0),
                _ => None,
            };
            match shape {
                Some(shape) => self.species.set("leaf_shape", shape, &node.span),
                None => self.species.omit("leafShape", &node.value),
            }
        }
        if let Some((bend, span)) = self.number("bend") {
            self.species.set("leaf_bend", bend, &span);
        }
    }

    /// The pull upwards: one number, or one for each level, of which pleach has that of the second.
    fn attraction(&mut self) {
        let Some(node) = self.preset.value.get("attractUp") else { return };
        let up = if matches!(node.value, Value::List(_)) {
            self.species.numbers::<LEVELS>("attractUp", node).map(|levels| levels[2])
        } else {
            self.species.number("attractUp", node)
        };
        if let Some(up) = up {
            self.species.set_list("tropism", &[0.0, 0.0, tropism(up, self.segments)], &node.span);
        }
    }

    fn pruning(&mut self) {
        if self.is_off("prune") || self.preset.value.get("prune").is_none() {
            self.species.set("prune_ratio", 0.0, &self.preset.span.clone());
        } else if let Some((ratio, span)) = self.number("pruneRatio") {
            self.species.set("prune_ratio", ratio, &span);
        }
    }
}

/// Lengths at five heights of a crown that is given at its base, its middle and its top, with the height of the middle.
fn outline([base, middle, height, top]: [f64; 4]) -> [f64; 5] {
    let height = height.clamp(0.01, 0.99);
    [0.0, 0.25, 0.5, 0.75, 1.0].map(|at: f64| {
        if at <= height {
            base + (middle - base) * at / height
        } else {
            middle + (top - middle) * (at - height) / (1.0 - height)
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outline_passes_its_three_points() {
        let made = outline([0.5, 1.0, 0.25, 0.1]);
        for (made, expected) in made.into_iter().zip([0.5, 1.0, 0.7, 0.4, 0.1]) {
            assert!((made - expected).abs() < 1e-12, "{made}");
        }
    }
}
