//! Settings of a search.

use crate::control::Budget;
use crate::method::Optimizer;
use crate::method::{RulesSettings, Start};
use crate::problem::Objective;
use crate::space::{Freedom, TreeSeed};
use pleach_tree::Limits;
use std::num::NonZeroU32;

/// Default bounds of a fit, tighter than [`Limits::default`]: room for every one of the fifteen species (the weeping
/// willow has 34,000 stems, 110,000 knots and 340,000 leaves), while no huge random tree takes longer than a few
/// willows or more than some 60 MB per thread.
pub const FIT_LIMITS: Limits = Limits { stems: 60_000, leaves: 500_000, knots: 300_000, ..Limits::DEFAULT };

/// Settings of a search for a [`crate::FitProblem`].
#[derive(Clone, Debug, PartialEq)]
pub struct FitSettings {
    /// The optimiser and its settings.
    pub optimizer: Optimizer,
    /// Settings of the search over the generator's structure, in place of the optimiser; `None`: numbers only.
    pub rules: Option<RulesSettings>,
    /// When to stop.
    pub budget: Budget,
    /// Seed of the search.
    pub seed: u64,
    /// Seed of the tree: fixed, or searched.
    pub tree_seed: TreeSeed,
    /// Trees per individual: see [`crate::Evaluator::with_seeds`].
    pub robust: NonZeroU32,
    /// The cost that is minimised.
    pub objective: Objective,
    /// Where the search starts.
    pub start: Start,
    /// Which parameters are free.
    pub freedom: Freedom,
    /// Bounds above which a tree counts as not growing.
    pub limits: Limits,
}

impl FitSettings {
    /// The name of the method: `rules`, or that of the optimiser.
    #[must_use]
    pub const fn method_name(&self) -> &'static str {
        if self.rules.is_some() { "rules" } else { self.optimizer.name() }
    }
}

impl Default for FitSettings {
    /// The default optimiser from random lists, every parameter free, tree seed 1, no budget.
    fn default() -> Self {
        Self {
            optimizer: Optimizer::default(),
            rules: None,
            budget: Budget::default(),
            seed: 1,
            tree_seed: TreeSeed::Fixed(1),
            robust: NonZeroU32::MIN,
            objective: Objective::default(),
            start: Start::default(),
            freedom: Freedom::default(),
            limits: FIT_LIMITS,
        }
    }
}
