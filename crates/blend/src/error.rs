//! Why there is no map or no blend.

use crate::plane::readable;
use pleach_tree::ModelId;

/// Why there is no map or no blend.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BlendError {
    /// There is nothing between fewer than two species.
    #[error("a map or a blend needs at least two species, found {found}")]
    TooFew {
        /// How many there were.
        found: usize,
    },
    /// Two species whose parameters cannot be compared.
    #[error(
        "`{first}` grows by {} and `{second}` by {}: only species of one generator, with the same parameters, blend", first_model.family(), different(first_model, second_model)
    )]
    MixedGenerators {
        /// A species.
        first: String,
        /// Its generator.
        first_model: ModelId,
        /// Another species.
        second: String,
        /// Its generator.
        second_model: ModelId,
    },
    /// Every species has the same parameters.
    #[error("`{first}` and `{second}` have the same parameters: there is nothing between them")]
    AllAlike {
        /// A species.
        first: String,
        /// Another one.
        second: String,
    },
    /// Two species have one name.
    #[error("two species are called `{name}`: one of them needs another `name` in its file")]
    SameName {
        /// The name.
        name: String,
    },
    /// No species has this name.
    #[error("no species of this map is called `{name}`{}", nearest.as_ref().map_or_else(String::new, |n| format!(", did you mean `{n}`?")))]
    UnknownSpecies {
        /// The value that was given.
        name: String,
        /// The nearest known name, if any is near.
        nearest: Option<String>,
    },
    /// The wrong number of weights.
    #[error("{found} weights for {expected} species")]
    WeightCount {
        /// How many species there are.
        expected: usize,
        /// How many weights were given.
        found: usize,
    },
    /// A weight below zero, infinite or not a number.
    #[error("the weight of `{name}` is {}, expected a finite number of 0 or more", readable(*value))]
    BadWeight {
        /// The species.
        name: String,
        /// Its weight.
        value: f64,
    },
    /// All weights are zero.
    #[error("all weights are 0, expected at least one above")]
    NoWeight,
    /// A place between two species that is not between them.
    #[error(
        "{} is not between the two species, expected a number from 0 (the first) to 1 (the second)",
        readable(*at)
    )]
    NotBetween {
        /// The value that was given.
        at: f64,
    },
    /// A point that is nowhere.
    #[error("({}, {}) is not a point of the plane", readable(*x), readable(*y))]
    NotFinitePoint {
        /// First coordinate.
        x: f64,
        /// Second coordinate.
        y: f64,
    },
    /// The decomposition failed; a bug rather than bad input.
    #[error("the principal components could not be computed: {0}")]
    Decomposition(DecompositionFault),
}

/// Why there are no principal components.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DecompositionFault {
    /// A number of a row is infinite or not a number.
    #[error("a feature is not finite")]
    NotFinite,
    /// There is no direction in which the rows differ.
    #[error("all rows are alike")]
    AllAlike,
    /// The eigenvalue solver gave up.
    #[error("the eigenvalue solver failed")]
    Solver,
}

/// The name of `second` beside a different `first`.
fn different(first: &ModelId, second: &ModelId) -> String {
    let family = second.family();
    if family == first.family() { format!("another model of {family}") } else { family.to_owned() }
}
