//! Why a tree did not grow.

use crate::param::ForeignParams;
use std::fmt;

/// The parameters, or the rules of a grammar, that cause an error, the main cause first; empty where it is not
/// known.
///
/// Its text continues a sentence: `, because of branches[2] and branches[1]`, with quotes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Blame(pub Vec<String>);

impl fmt::Display for Blame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, name) in self.0.iter().enumerate() {
            let before = match i {
                0 => ", because of",
                _ if i + 1 == self.0.len() => " and",
                _ => ",",
            };
            write!(f, "{before} `{name}`")?;
        }
        Ok(())
    }
}

/// Values that are each allowed and cannot grow together.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Conflict {
    /// Nothing is left of the tree: no stem has a length, or what has one is pruned away.
    #[error("nothing is left of the tree: its trunk has no length, or pruning took it{blame}")]
    NothingLeft {
        /// The numbers that take it away.
        blame: Blame,
    },
    /// A number that has to be at least as large as another one is smaller.
    #[error("`{slot}` is {value}, which is less than `{other}`, which is {min}")]
    TooSmall {
        /// Name of the slot whose number is too small.
        slot: String,
        /// Its number.
        value: f64,
        /// Name of the slot that it has to reach.
        other: String,
        /// The number there.
        min: f64,
    },
}

/// Why a tree did not grow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GrowError {
    /// More stems than [`Limits::stems`](crate::Limits::stems).
    #[error(
        "the tree would have more than {limit} stems{blame}; fewer branches or splits, or a higher limit"
    )]
    TooManyStems {
        /// The limit.
        limit: usize,
        /// The parameters that cause it.
        blame: Blame,
    },
    /// More leaves and blossoms than [`Limits::leaves`](crate::Limits::leaves).
    #[error("the tree would have more than {limit} leaves{blame}; a smaller leaf number, or a higher limit")]
    TooManyLeaves {
        /// The limit.
        limit: usize,
        /// The parameters that cause it.
        blame: Blame,
    },
    /// More knots than [`Limits::knots`](crate::Limits::knots).
    #[error(
        "the tree's stems would have more than {limit} knots{blame}; fewer or simpler stems, or a higher limit"
    )]
    TooManyKnots {
        /// The limit.
        limit: usize,
        /// The parameters that cause it.
        blame: Blame,
    },
    /// More work than [`Limits::work`](crate::Limits::work).
    #[error("growing the tree takes more than {limit} steps{blame}; smaller numbers, or a higher limit")]
    TooMuchWork {
        /// The limit.
        limit: u64,
        /// The parameters that cause most of the work.
        blame: Blame,
    },
    /// Numbers left the range in which positions make sense.
    #[error("{what} is not finite")]
    NotFinite {
        /// What left the range.
        what: &'static str,
    },
    /// More stems wait to be grown, at one time, than memory has room for.
    #[error("far too many stems wait to be pruned{blame}; fewer branches")]
    TooManyWaiting {
        /// The parameters that cause it.
        blame: Blame,
    },
    /// A rule of a grammar that cannot be computed with these numbers, such as one that divides by 0.
    #[error("line {line} of the grammar, {step}: {problem}", step = if *.step == 0 { "before the first step".to_owned() } else { format!("step {step}") })]
    Rule {
        /// Line of the grammar, from 1.
        line: usize,
        /// The derivation step, from 1; 0 for the header and the axiom.
        step: usize,
        /// What went wrong, with the rule's name.
        problem: String,
    },
    /// Values that are each allowed and cannot grow together.
    #[error(transparent)]
    Conflict(#[from] Conflict),
    /// Values of another generator's parameters.
    #[error(transparent)]
    Foreign(#[from] ForeignParams),
}
