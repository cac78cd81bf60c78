//! What growing a tree may take.

use crate::graph::{Linking, Rules, Work};
use pleach_tree::math;
use pleach_tree::{Blame, GrowError, Limits};

/// Steps that a node takes: its links, its edges' weights, its place in the queue.
const STEPS_PER_NODE: f64 = 20.0;
/// Steps for what lies within the cube of the longest edge: places looked at where only the nearest
/// are linked, and edges kept where all are.
const STEPS_TO_LOOK: f64 = 0.7;
const STEPS_TO_KEEP: f64 = 5.0;

/// Counts work against a limit, the same on any number of threads.
#[derive(Debug)]
pub(crate) struct Budget {
    limits: Limits,
    steps_per_node: u64,
    steps: u64,
    /// What was done.
    pub(crate) work: Work,
}

impl Budget {
    pub(crate) fn new(limits: Limits, rules: &Rules) -> Self {
        let each = if rules.linking == Linking::Threshold { STEPS_TO_KEEP } else { STEPS_TO_LOOK };
        let steps_per_node = (STEPS_PER_NODE + each * math::powi(rules.link, 3)) as u64;
        Self { limits, steps_per_node, steps: 0, work: Work::default() }
    }

    /// Asks for `graphs` graphs of `nodes` nodes at `level`, from 1, before they are grown.
    pub(crate) fn nodes(&mut self, graphs: usize, nodes: usize, level: usize) -> Result<(), GrowError> {
        let steps = (graphs as u64).saturating_mul(nodes as u64).saturating_mul(self.steps_per_node);
        self.steps = self.steps.saturating_add(steps).saturating_add(1);
        self.check(|| match level {
            1 => vec!["nodes".to_owned()],
            _ => vec!["subgraph_nodes".to_owned(), format!("branching[{}]", level - 2)],
        })
    }

    /// Takes in what graphs took.
    pub(crate) fn done(&mut self, work: Work) -> Result<(), GrowError> {
        self.work += work;
        // Darts that missed.
        self.steps = self.steps.saturating_add(work.throws.saturating_sub(work.nodes) as u64);
        self.check(|| vec!["spacing".to_owned()])
    }

    fn check(&self, blame: impl FnOnce() -> Vec<String>) -> Result<(), GrowError> {
        if self.steps > self.limits.work {
            return Err(GrowError::TooMuchWork { limit: self.limits.work, blame: Blame(blame()) });
        }
        Ok(())
    }
}
