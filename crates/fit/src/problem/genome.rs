//! Individuals and their scores.

use pleach_tree::Tree;
use serde::{Deserialize, Serialize};

/// One individual: a full parameter list, the seed of its tree, and the unknowns of its views.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Genome {
    /// One value for every slot of the generator's [`pleach_tree::ParamSpace`], free or not, as in
    /// species files (degrees, metres).
    pub values: Vec<f64>,
    /// Nuisance parameters of the views, goal by goal: see [`crate::Unknown`]. Empty if there are none.
    pub nuisances: Vec<f64>,
    /// Seed of the tree.
    pub tree_seed: u64,
    /// The structure, where it is searched too ([`pleach_tree::Variation`]); `None`: that of the problem's generator.
    pub structure: Option<String>,
}

impl Genome {
    /// With no nuisance parameters.
    #[must_use]
    pub const fn new(values: Vec<f64>, tree_seed: u64) -> Self {
        Self { values, nuisances: Vec::new(), tree_seed, structure: None }
    }
}

/// How well an individual matches the goal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// The cost that a search minimises: 0 is a perfect match, 1 nothing in common, infinity a parameter list that
    /// does not grow.
    pub cost: f64,
    /// Intersection over union of the ink, in 0..=1; the mean over views.
    pub iou: f64,
    /// Share of equal pixels, in 0..=1; the mean over views. An empty picture may score high: see
    /// [`crate::Evaluator::empty_accuracy`].
    pub accuracy: f64,
    /// Likeness to the goal, in 0..=1, the mean over views; `None` where the objective does not use it.
    pub likeness: Option<f64>,
    /// Size of the tree.
    pub size: Size,
    /// Factor by which the tree was resized to the goal's height before it was drawn; 1 for none.
    /// Searches resize the individual as well, with [`pleach_tree::Generator::resize`].
    pub resized: f64,
}

/// Size of a tree, which decides the time and memory of its evaluation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Size {
    /// Stems.
    pub stems: usize,
    /// Leaves and blossoms.
    pub leaves: usize,
    /// Knots of all stems.
    pub knots: usize,
}

impl Size {
    /// No bound.
    pub const ANY: Self = Self { stems: usize::MAX, leaves: usize::MAX, knots: usize::MAX };

    /// The size of `tree`.
    #[must_use]
    pub const fn new(tree: &Tree) -> Self {
        Self {
            stems: tree.stems.len(),
            leaves: tree.leaves.len() + tree.blossoms.len(),
            knots: tree.knots.len(),
        }
    }
}

impl Score {
    /// The score of a tree that does not grow.
    pub const INVALID: Self = Self { cost: f64::INFINITY, ..Self::from_cost(0.0) };

    /// A cost alone, for objectives without pictures.
    #[must_use]
    pub const fn from_cost(cost: f64) -> Self {
        Self {
            cost,
            iou: 0.0,
            accuracy: 0.0,
            likeness: None,
            size: Size { stems: 0, leaves: 0, knots: 0 },
            resized: 1.0,
        }
    }
}

/// An individual with its score.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scored {
    /// The individual.
    pub genome: Genome,
    /// Its score.
    pub score: Score,
}
