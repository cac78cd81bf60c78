//! Species files of this generator, and those that come with pleach.

use crate::generator::WeberPenn;
use crate::solid::{SHAPES, Solid, Surroundings};
use pleach_tree::species::{Form, Issue, Key};
use pleach_tree::{Family, Generator, Species, SpeciesDoc};
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

    fn misplaced(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("height", "the height of the tree is `g_scale`"),
            ("leaves", "the number of leaves on a stem is `leaf_blos_num`"),
        ]
    }

    fn read(&self, doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Option<Arc<dyn Generator>> {
        let inside = Solid::read_list(doc, "prune_inside", issues);
        let obstacles = Solid::read_list(doc, "prune_obstacles", issues).unwrap_or_default();
        Some(Arc::new(WeberPenn { surroundings: Surroundings { inside, obstacles } }))
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        pleach_species::WEBER_PENN
    }
}

/// The fifteen species of Hewitt's dissertation, in the order of its figures.
pub const HEWITT_2017: &[&str] = &[
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
];

/// A species that comes with pleach.
#[must_use]
pub fn preset(name: &str) -> Option<Species> {
    pleach_tree::species::preset(&WeberPennFamily, name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hewitts_species_come_first() {
        let names: Vec<&str> = WeberPennFamily.presets().iter().map(|(name, _)| *name).collect();
        assert!(names.starts_with(HEWITT_2017), "{names:?}");
    }
}
