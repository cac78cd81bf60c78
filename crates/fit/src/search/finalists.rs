//! Former bests of a search, for validation on other seeds once it has ended.

use crate::method::is_individual;
use crate::problem::Scored;
use crate::space::SearchSpace;
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;

/// Former bests that are kept beside the last one.
const MAX_COUNT: usize = 7;
/// The cost of each is at most this part of the cost of the one before.
const STEP: f64 = 0.98;

/// Bests of a search that were replaced since, oldest first.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Finalists(VecDeque<Scored>);

impl Finalists {
    pub(crate) const fn new() -> Self {
        Self(VecDeque::new())
    }

    /// Adds a best that was replaced.
    pub(super) fn add(&mut self, former: Scored) {
        let is_new = |last: &Scored| former.score.cost <= STEP * last.score.cost;
        if former.score.cost.is_finite() && self.0.back().is_none_or(is_new) {
            self.0.push_back(former);
            if self.0.len() > MAX_COUNT {
                self.0.pop_front();
            }
        }
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Scored> {
        self.0.iter()
    }

    /// Whether a search in `space` can have found them.
    pub(super) fn suit(&self, space: &SearchSpace) -> bool {
        self.0.len() <= MAX_COUNT && self.0.iter().all(|one| is_individual(&one.genome, space))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{Genome, Score};

    #[test]
    fn a_few_are_kept_that_differ() {
        let mut kept = Finalists::new();
        let costs = |kept: &Finalists| kept.iter().map(|one| one.score.cost).collect::<Vec<_>>();
        let former = |cost| Scored { genome: Genome::new(vec![cost], 1), score: Score::from_cost(cost) };
        for cost in [f64::INFINITY, 1.0, 0.99, 0.981, 0.98, 0.9, 0.89] {
            kept.add(former(cost));
        }
        assert_eq!(costs(&kept), [1.0, 0.98, 0.9]);
        for cost in [0.8, 0.7, 0.6, 0.5, 0.4] {
            kept.add(former(cost));
        }
        assert_eq!(costs(&kept), [0.98, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4]);
    }
}
