//! Species files of this generator, and those that come with pleach.

use crate::generator::{Fractal, NAME};
use pleach_tree::species::Issue;
use pleach_tree::{Family, Generator, SpeciesDoc};
use std::sync::Arc;

/// Reads species files of fractal trees.
#[derive(Clone, Copy, Debug, Default)]
pub struct FractalFamily;

impl Family for FractalFamily {
    fn name(&self) -> &'static str {
        NAME
    }

    fn summary(&self) -> &'static str {
        "recursive trees of fixed angles and ratios, regular or with chance (Coffey 2025)"
    }

    fn misplaced(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("height", "the size of the tree is `trunk_length`"),
            ("depth", "the number of generations above the trunk is `generations`"),
            ("spread", "the angle between a side branch and its parent is `polar`"),
        ]
    }

    fn read(&self, _: &SpeciesDoc, _: &mut Vec<Issue>) -> Option<Arc<dyn Generator>> {
        Some(Arc::new(Fractal))
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        pleach_species::FRACTAL
    }
}
