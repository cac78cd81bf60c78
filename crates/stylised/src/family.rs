//! Species files of this generator, and those that come with pleach.

use crate::generator::{NAME, Stylised};
use pleach_tree::species::Issue;
use pleach_tree::{Family, Generator, SpeciesDoc};
use std::sync::Arc;

/// Reads species files of stylised trees.
#[derive(Clone, Copy, Debug, Default)]
pub struct StylisedFamily;

impl Family for StylisedFamily {
    fn name(&self) -> &'static str {
        NAME
    }

    fn summary(&self) -> &'static str {
        "stylised trees of few vertices with blobs of foliage (Lorite 2021)"
    }

    fn misplaced(&self) -> &'static [(&'static str, &'static str)] {
        &[("height", "the height of the trunk is `trunk_height`, times `scale` metres")]
    }

    fn read(&self, _: &SpeciesDoc, _: &mut Vec<Issue>) -> Option<Arc<dyn Generator>> {
        Some(Arc::new(Stylised))
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        pleach_species::STYLISED
    }
}
