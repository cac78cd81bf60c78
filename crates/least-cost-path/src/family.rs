//! Species files of this generator, and those that come with pleach.

use crate::generator::{LeastCostPath, NAME};
use crate::structure::{Drawn, OUTLINE, SHAPES, Structure, VOLUMES, Volumes};
use pleach_tree::species::{Form, Issue, Key};
use pleach_tree::{Family, Generator, SpeciesDoc};
use std::sync::Arc;

/// Keys of a species file beside parameters.
const KEYS: &[Key] = &[
    Key {
        name: OUTLINE,
        form: Form::Text,
        default: "crown_profile",
        doc: "the curve that a crown of revolution is turned from: an SVG path, [[radius, height], …], or { radii = [[…], …] } by height and direction",
    },
    Key {
        name: VOLUMES,
        form: Form::Shapes(SHAPES),
        default: "a trunk and a crown",
        doc: "the parts of the first volume, instead of trunk and crown; lengths in crown radii",
    },
];

/// Reads species files of trees of least-cost paths.
#[derive(Clone, Copy, Debug, Default)]
pub struct LeastCostPathFamily;

impl Family for LeastCostPathFamily {
    fn name(&self) -> &'static str {
        NAME
    }

    fn summary(&self) -> &'static str {
        "least-cost paths through random graphs in a volume (Xu and Mould 2012)"
    }

    fn keys(&self) -> &'static [Key] {
        KEYS
    }

    fn misplaced(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("height", "the heights of a tree are `trunk_height` and `crown_height`"),
            ("branches", "the number of branches is `branching`"),
        ]
    }

    fn read(&self, doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Option<Arc<dyn Generator>> {
        let structure = Structure { outline: Drawn::read(doc, issues), volumes: Volumes::read(doc, issues) };
        Some(Arc::new(LeastCostPath { structure }))
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        pleach_species::LEAST_COST_PATH
    }
}
