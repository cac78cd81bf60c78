//! Limits, counted while a tree grows.

use crate::params::Id;
use pleach_tree::{Blame, GrowError, Limits, Tree};

/// What is left of the limits. A step of work is a point that is looked at, or a node, twig or leaf that is made.
#[derive(Debug)]
pub(crate) struct Budget {
    limits: Limits,
    spent: u64,
}

impl Budget {
    pub(crate) const fn new(limits: Limits) -> Self {
        Self { limits, spent: 0 }
    }

    /// Takes `steps` of work, of which most follow from `cause`.
    pub(crate) fn work(&mut self, steps: u64, cause: Id) -> Result<(), GrowError> {
        self.spent += steps;
        if self.spent > self.limits.work {
            return Err(GrowError::TooMuchWork { limit: self.limits.work, blame: blame(cause) });
        }
        Ok(())
    }

    /// Room for one more stem of `knots` knots in `tree`.
    pub(crate) fn stem(&self, tree: &Tree, knots: usize, cause: Id) -> Result<(), GrowError> {
        if tree.stems.len() >= self.limits.stems {
            return Err(GrowError::TooManyStems { limit: self.limits.stems, blame: blame(cause) });
        }
        if tree.knots.len() + knots > self.limits.knots {
            return Err(GrowError::TooManyKnots { limit: self.limits.knots, blame: blame(cause) });
        }
        Ok(())
    }

    /// Room for `count` more leaves in `tree`.
    pub(crate) fn leaves(&self, tree: &Tree, count: usize) -> Result<(), GrowError> {
        if tree.leaves.len() + count > self.limits.leaves {
            return Err(GrowError::TooManyLeaves {
                limit: self.limits.leaves,
                blame: blame(Id::leaf_number),
            });
        }
        Ok(())
    }
}

/// The number that causes it, and the one that all counts follow.
fn blame(cause: Id) -> Blame {
    let mut names = vec![cause.slot_name(0)];
    if cause != Id::points {
        names.push(Id::points.slot_name(0));
    }
    Blame(names)
}
