//! Trees of ez-tree as the nearest ones of Weber and Penn's model.
//!
//! ez-tree grows a branch section by section, turns each by chance and towards a force, and sets children on it at even
//! distances, each as long as its level says. Its README and its published options say what the names mean.
//!
//! In Weber and Penn's model stems of deeper levels are shorter, and have fewer children, the further out they stand. So
//! their numbers are raised by what this takes away in the mean.

use crate::attraction::DEGREES_PER_SEGMENT;
use crate::literal::{Node, Value, entries};
use crate::program::Program;
use crate::source::Source;
use crate::translation::{Foreign, LEVELS, Translation};
use pleach_tree::SpeciesError;
use pleach_tree::param::Problem;
use std::ops::Range;

/// The groups and numbers at the top of a file.
const KEYS: [&str; 5] = ["seed", "type", "bark", "branch", "leaves"];
const BRANCH: [&str; 12] = [
    "levels",
    "angle",
    "children",
    "force",
    "gnarliness",
    "length",
    "radius",
    "sections",
    "segments",
    "start",
    "taper",
    "twist",
];
const LEAVES: [&str; 9] =
    ["type", "billboard", "angle", "count", "start", "size", "sizeVariance", "tint", "alphaTest"];

/// The golden angle, in degrees: ez-tree sets children around a branch without a pattern.
const GOLDEN_ANGLE: f64 = 137.5;

/// Whether files of ez-tree have `name` at the top.
pub(crate) fn knows(name: &str) -> bool {
    KEYS.contains(&name)
}

pub(crate) fn translate(source: &Source<'_>, preset: &Node) -> Result<Foreign, SpeciesError> {
    let mut species = Translation::new(source, Program::EzTree);
    let nothing = Node { value: Value::Dict(Vec::new()), span: preset.span.clone() };
    let branch = preset.value.get("branch").unwrap_or(&nothing);
    let leaves = preset.value.get("leaves").unwrap_or(&nothing);
    entries(source, branch)?;
    entries(source, leaves)?;
    let is_evergreen = preset.value.get("type").is_some_and(
        |node| matches!(&node.value, Value::Text(kind) if kind.eq_ignore_ascii_case("evergreen")),
    );
    let mut reader = Reader { species, branch, leaves };
    reader.stems(is_evergreen);
    species = reader.species;
    for (group, known) in [(preset, &KEYS[..]), (branch, &BRANCH[..]), (leaves, &LEAVES[..])] {
        for (key, node) in entries(source, group)? {
            if let Value::Text(name) = &key.value
                && (!known.contains(&name.as_str()) || UNUSED.contains(&name.as_str()))
            {
                species.omit(name, &node.value);
            }
        }
    }
    species
        .note("the tree is the nearest one of Weber and Penn's model, since ez-tree has a model of its own");
    species.finish()
}

/// Names that are known and have no counterpart.
const UNUSED: [&str; 8] =
    ["seed", "bark", "segments", "twist", "billboard", "sizeVariance", "tint", "alphaTest"];

/// What part of their full length and of their leaves stems have that stand at `place` of a parent above the first level.
fn shortened(place: f64) -> f64 {
    1.0 - 0.7 * place
}

struct Reader<'a> {
    species: Translation<'a>,
    branch: &'a Node,
    leaves: &'a Node,
}

impl Reader<'_> {
    /// The numbers of the levels under `name`, in a dictionary by level or in a list, over `usual`.
    fn levels(&mut self, name: &str, usual: [f64; LEVELS]) -> ([f64; LEVELS], Range<usize>) {
        let mut values = usual;
        let Some(node) = self.branch.value.get(name) else { return (values, self.branch.span.clone()) };
        match &node.value {
            Value::Dict(entries) => {
                for (key, node) in entries {
                    let is_called = |level: &usize| match &key.value {
                        Value::Text(text) => *text == level.to_string(),
                        Value::Number(number) => *number == *level as f64,
                        _ => false,
                    };
                    let Some(level) = (0..LEVELS).find(is_called) else {
                        self.species.wrong_type(name, key, "a level from 0 to 3");
                        continue;
                    };
                    if let Some(value) = self.species.number(name, node) {
                        values[level] = value;
                    }
                }
            }
            Value::List(nodes) => {
                for (slot, node) in values.iter_mut().zip(nodes) {
                    if let Some(value) = self.species.number(name, node) {
                        *slot = value;
                    }
                }
            }
            _ => {
                let found = node.value.type_name().to_owned();
                let expected = "a dictionary with a number for each level";
                self.species.wrong(name, &node.span, Problem::WrongType { expected, found });
            }
        }
        (values, node.span.clone())
    }

    fn stems(&mut self, is_evergreen: bool) {
        const CONICAL: f64 = 0.0;
        const CYLINDRICAL: f64 = 3.0;
        let whole = self.branch.span.clone();
        let levels = self.branch.value.get("levels");
        let levels_span = levels.map_or_else(|| whole.clone(), |node| node.span.clone());
        let levels = levels.and_then(|node| self.species.number("levels", node));
        // There without the trunk. What a file leaves out is as in its ash, a tree of three levels of branches.
        let stems = (levels.unwrap_or(3.0) + 1.0).clamp(1.0, LEVELS as f64);
        self.species.set("levels", stems, &levels_span);
        self.species.set("shape", if is_evergreen { CONICAL } else { CYLINDRICAL }, &whole);
        let (start, start_span) = self.levels("start", [0.0, 0.23, 0.33, 0.0]);
        // Where the children of a level stand on their parents in the mean, from 0 to 1.
        let place = start.map(|start| f64::midpoint(start.clamp(0.0, 1.0), 1.0));
        let (length, span) = self.levels("length", [43.0, 27.0, 9.5, 4.6]);
        let ratio = |level: usize| length[level] / length[level - 1].max(1e-6);
        self.species.set("g_scale", length[0], &span);
        self.species.set("g_scale_v", 0.0, &span);
        let lengths = [1.0, ratio(1), ratio(2) / shortened(place[2]), ratio(3) / shortened(place[3])];
        self.species.set_list("length", &lengths, &span);
        self.species.set_list("length_v", &[0.0; LEVELS], &span);
        let (taper, taper_span) = self.levels("taper", [0.7; LEVELS]);
        let taper = taper.map(|taper| taper.clamp(0.0, 1.0));
        let (radius, span) = self.levels("radius", [2.0, 0.63, 0.76, 0.7]);
        self.species.set("ratio", radius[0] / length[0].max(1e-6), &span);
        // Radii are parts of the parent's at that place there, and of the parent's base here, whatever the lengths.
        self.species.set("ratio_power", 0.0, &span);
        let part = |level: usize| radius[level] * (1.0 - taper[level - 1] * place[level]);
        self.species.set_list("radius_mod", &[1.0, part(1), part(2), part(3)], &span);
        self.species.set("flare", 0.0, &whole);
        let (children, span) = self.levels("children", [7.0, 4.0, 3.0, 0.0]);
        // A deciduous branch has one more, which continues it at its tip.
        let more = if is_evergreen { 0.0 } else { 1.0 };
        let deepest = ((children[2] + more) / (1.0 - 0.5 * place[2])).round();
        self.species.set_list("branches", &[1.0, children[0] + more, children[1] + more, deepest], &span);
        let (angle, span) = self.levels("angle", [0.0, 48.0, 75.0, 60.0]);
        let mut down = [0.0, angle[1], angle[2], angle[3]];
        let of_leaves = self.leaves.value.get("angle").and_then(|node| self.species.number("angle", node));
        let leaves = stems as usize;
        if leaves < LEVELS {
            down[leaves] = of_leaves.unwrap_or(55.0);
        } else if of_leaves.is_some() {
            self.species.omit_name("leaves.angle");
        }
        self.species.set_list("down_angle", &down, &span);
        self.species.set_list("down_angle_v", &[0.0; LEVELS], &span);
        self.species.set_list("rotate", &[0.0, GOLDEN_ANGLE, GOLDEN_ANGLE, GOLDEN_ANGLE], &span);
        self.species.set_list("rotate_v", &[0.0, 20.0, 20.0, 20.0], &span);
        let mut bases = [start[1], start[2], start[3], 0.0];
        if let Some(base) = self.leaves.value.get("start").and_then(|node| self.species.number("start", node))
        {
            bases[leaves - 1] = base;
        }
        self.species.set_list("base_size", &bases.map(|base| base.clamp(0.0, 0.99)), &start_span);
        self.species.set_list("taper", &taper, &taper_span);
        let (sections, span) = self.levels("sections", [12.0, 8.0, 6.0, 4.0]);
        self.species.set_list("curve_res", &sections, &span);
        let (gnarliness, span) = self.levels("gnarliness", [0.03, 0.25, 0.2, 0.09]);
        // There the largest turn of a section in radians, here of a whole stem in degrees, over as many sections.
        let mut turn = [0.0; LEVELS];
        for (level, turn) in turn.iter_mut().enumerate() {
            *turn = gnarliness[level].abs().to_degrees() * sections[level];
        }
        self.species.set_list("curve", &[0.0; LEVELS], &span);
        self.species.set_list("curve_v", &turn, &span);
        self.species.set_list("bend_v", &turn, &span);
        self.force(radius[0] * part(1));
        self.foliage(if leaves > 2 { shortened(place[leaves - 1]) } else { 1.0 });
    }

    /// The force turns a section by strength over radius, in radians; here it is that of a first-level branch.
    fn force(&mut self, radius: f64) {
        let Some(force) = self.branch.value.get("force") else { return };
        let number = |reader: &mut Self, node: Option<&Node>| {
            node.and_then(|node| reader.species.number("force", node))
        };
        let strength = number(self, force.value.get("strength")).unwrap_or(0.0);
        let direction = force.value.get("direction");
        let mut axis =
            |name: &str| number(self, direction.and_then(|node| node.value.get(name))).unwrap_or(0.0);
        // There y is up.
        let (x, y, z) = (axis("x"), axis("y"), axis("z"));
        let pull = strength.to_degrees() / (radius.max(1e-3) * DEGREES_PER_SEGMENT);
        let pulls = [x, -z, y].map(|along| (along * pull).clamp(-100.0, 100.0));
        self.species.set_list("tropism", &pulls, &force.span);
    }

    /// Leaves, of which stems have `share` of the full number in the mean.
    fn foliage(&mut self, share: f64) {
        let whole = self.leaves.span.clone();
        let number = |reader: &mut Self, name: &str, usual: f64| {
            let node = reader.leaves.value.get(name)?;
            Some((reader.species.number(name, node).unwrap_or(usual), node.span.clone()))
        };
        let (count, span) = number(self, "count", 16.0).unwrap_or((16.0, whole.clone()));
        self.species.set("leaf_blos_num", (count / share).round(), &span);
        let (size, span) = number(self, "size", 2.7).unwrap_or((2.7, whole));
        self.species.set("leaf_scale", size, &span);
        self.species.set("leaf_bend", 0.0, &span);
        if let Some(node) = self.leaves.value.get("type") {
            let shape = match &node.value {
                Value::Text(kind) => match kind.to_lowercase().as_str() {
                    "ash" => Some(1.0),
                    "aspen" => Some(3.0),
                    "oak" => Some(7.0),
                    "pine" => Some(2.0),
                    _ => None,
                },
                _ => None,
            };
            match shape {
                Some(shape) => self.species.set("leaf_shape", shape, &node.span),
                None => self.species.omit("leaves.type", &node.value),
            }
            self.species
                .note("a leaf there is a card with a twig's picture; here it is one leaf of the same length");
        }
    }
}
