//! The species that a goal may be of, and the models that grow them.

use crate::evaluator::Evaluator;
use pleach_tree::{ModelId, Species};
use std::sync::Arc;

/// A species that a goal may be of, of any family of generators.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The species; its name is reported as what the goal looks like.
    pub species: Species,
}

impl From<Species> for Candidate {
    fn from(species: Species) -> Self {
        Self { species }
    }
}

impl Candidate {
    pub(super) fn values(&self) -> &[f64] {
        self.species.params.values()
    }
}

/// The models of candidates, each once.
#[derive(Debug)]
pub(super) struct Models {
    /// An evaluator of each.
    evaluators: Vec<Evaluator>,
    /// The number of each candidate's model.
    of_candidate: Vec<usize>,
}

impl Models {
    /// Those of `candidates`, with evaluators like `base`.
    pub(super) fn new(candidates: &[Candidate], base: &Evaluator) -> Self {
        let mut known: Vec<ModelId> = Vec::new();
        let mut models = Self { evaluators: Vec::new(), of_candidate: Vec::new() };
        for Candidate { species } in candidates {
            let id = species.generator.model();
            let model = known.iter().position(|one| *one == id).unwrap_or_else(|| {
                known.push(id);
                models.evaluators.push(base.with_generator(Arc::clone(&species.generator)));
                known.len() - 1
            });
            models.of_candidate.push(model);
        }
        models
    }

    /// The number of the model of candidate number `candidate`.
    pub(super) fn number(&self, candidate: usize) -> usize {
        self.of_candidate[candidate]
    }

    /// Its evaluator.
    pub(super) fn evaluator(&self, candidate: usize) -> &Evaluator {
        &self.evaluators[self.of_candidate[candidate]]
    }
}
