//! Species one of whose trees is an individual.

mod crown;
mod generator;
mod stems;
mod table;

pub(super) use table::{KEYS, read};

use super::Species;
use crate::generator::Generator;
use generator::WithIndividual;
use pleach_plant::Individual;
use std::sync::Arc;

impl Species {
    /// The same species whose tree of seed `tree_seed` is `individual`. An individual that it had before is
    /// forgotten.
    #[must_use]
    pub fn with_individual(&self, tree_seed: u64, individual: Individual) -> Self {
        let kind = self.kind();
        let generator = if individual.is_empty() {
            kind.generator
        } else {
            Arc::new(WithIndividual::new(kind.generator, tree_seed, individual)) as Arc<dyn Generator>
        };
        Self { generator, tree_seed: Some(tree_seed), ..kind }
    }

    /// The draws of its individual, if it has one.
    #[must_use]
    pub fn individual(&self) -> Option<&Individual> {
        self.generator.individual()
    }

    /// The same species without its individual.
    #[must_use]
    pub fn kind(&self) -> Self {
        let generator = self.generator.kind().unwrap_or_else(|| Arc::clone(&self.generator));
        Self { generator, ..self.clone() }
    }
}
