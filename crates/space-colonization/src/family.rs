//! Species files of this generator, and those that come with pleach.

use crate::generator::{NAME, SpaceColonization};
use pleach_tree::species::Issue;
use pleach_tree::{Family, Generator, SpeciesDoc};
use std::sync::Arc;

/// Reads species files of trees by space colonisation.
#[derive(Clone, Copy, Debug, Default)]
pub struct SpaceColonizationFamily;

impl Family for SpaceColonizationFamily {
    fn name(&self) -> &'static str {
        NAME
    }

    fn summary(&self) -> &'static str {
        "branches that compete for points in a volume (Runions and others 2007), with Weber and Penn's twigs"
    }

    fn misplaced(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("width", "the width of the crown over the height is `crown_width`"),
            ("crown_height", "the crown reaches from `bare_height` to the top"),
            ("forks", "the number of main stems above the first fork is `limbs`"),
        ]
    }

    fn read(&self, _: &SpeciesDoc, _: &mut Vec<Issue>) -> Option<Arc<dyn Generator>> {
        Some(Arc::new(SpaceColonization))
    }

    fn presets(&self) -> &'static [(&'static str, &'static str)] {
        pleach_species::SPACE_COLONIZATION
    }
}
