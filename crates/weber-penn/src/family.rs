//! Species files of this generator, and those that come with pleach.

use crate::generator::WeberPenn;
use crate::params::space;
use crate::solid::{SHAPES, Solid, Surroundings};
use pleach_tree::species::{Appearance, Form, Issue, Key};
use pleach_tree::{Family, Species, SpeciesDoc, SpeciesError};
use std::sync::Arc;

/// Keys of a species file beside parameters.
const KEYS: &[Key] = &[
    Key {
        name: "prune_inside",
        form: Form::Shapes(SHAPES),
        default: "the envelope",
        doc: "solids that stems are pruned to stay in, instead of the envelope; [] for no bound",
    },
    Key {
        name: "prune_obstacles",
        form: Form::Shapes(SHAPES),
        default: "[]",
        doc: "solids that stems are pruned to stay out of",
    },
];

/// Reads Weber–Penn species files.
#[derive(Clone, Copy, Debug, Default)]
pub struct WeberPennFamily;

impl Family for WeberPennFamily {
    fn name(&self) -> &'static str {
        "weber-penn"
    }

    fn summary(&self) -> &'static str {
        "parametric trees of Weber and Penn (1995), extended by Hewitt (2017)"
    }

    fn keys(&self) -> &'static [Key] {
        KEYS
    }

    fn read(&self, doc: &SpeciesDoc) -> Result<Species, SpeciesError> {
        let (values, mut issues) = doc.read(space(), KEYS);
        let inside = Solid::read_list(doc, "prune_inside", &mut issues);
        let obstacles = Solid::read_list(doc, "prune_obstacles", &mut issues).unwrap_or_default();
        let mut text = |read: Result<Option<&str>, Issue>| match read {
            Ok(text) => text.unwrap_or_default().to_owned(),
            Err(issue) => {
                issues.push(issue);
                String::new()
            }
        };
        let (name, description) = (text(doc.name()), text(doc.description()));
        let tree_seed = doc.tree_seed().unwrap_or_else(|issue| {
            issues.push(issue);
            None
        });
        let appearance = Appearance::read(doc, &mut issues);
        // Values that were wrong have left their defaults behind, so this finds nothing new.
        match space().check(values) {
            Ok(params) if issues.is_empty() => Ok(Species {
                name,
                description,
                generator: Arc::new(WeberPenn { surroundings: Surroundings { inside, obstacles } }),
                params,
                tree_seed,
                appearance,
            }),
            _ => {
                issues.sort_by_key(|issue| (issue.line, issue.column));
                Err(SpeciesError { issues })
            }
        }
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        PRESETS
    }
}

macro_rules! presets {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../species/", $name, ".toml")))),*]
    };
}

/// The fifteen species of the dissertation in the order of its figures, then five more.
const PRESETS: &[(&str, &str)] = presets![
    "quaking_aspen",
    "weeping_willow",
    "bamboo",
    "palm",
    "lombardy_poplar",
    "small_pine",
    "acer",
    "silver_birch",
    "douglas_fir",
    "apple",
    "black_tupelo",
    "black_oak",
    "european_larch",
    "hill_cherry",
    "balsam_fir",
    "cambridge_oak",
    "fan_palm",
    "sassafras",
    "sphere_tree",
    "weeping_willow_o",
];

/// A species that comes with pleach.
#[must_use]
pub fn preset(name: &str) -> Option<Species> {
    let (_, text) = PRESETS.iter().find(|(known, _)| *known == name)?;
    let doc = SpeciesDoc::parse(name, text).ok()?;
    WeberPennFamily.read(&doc).ok()
}
