//! What growing a tree may take.

use crate::graph::{Linking, Meter, OutOfSteps, Rules, Work};
use crate::numbers::Id;
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

    /// Asks for `graphs` graphs of `nodes` nodes before they are grown; gives what they may take beyond
    /// what is certain.
    pub(crate) fn nodes(&mut self, graphs: usize, nodes: usize, causes: &Causes) -> Result<Meter, GrowError> {
        let steps = (graphs as u64).saturating_mul(nodes as u64).saturating_mul(self.steps_per_node);
        self.steps = self.steps.saturating_add(steps).saturating_add(1);
        match self.limits.work.checked_sub(self.steps) {
            Some(left) => Ok(Meter::new(left)),
            None => Err(self.too_much(&causes.nodes)),
        }
    }

    /// Takes in what the graphs took of what [`Self::nodes`] gave.
    pub(crate) fn done(
        &mut self,
        grown: Result<Work, OutOfSteps>,
        meter: &Meter,
        causes: &Causes,
    ) -> Result<(), GrowError> {
        self.steps = self.steps.saturating_add(meter.taken());
        self.work += grown.map_err(|out| match out {
            OutOfSteps::Misses => self.too_much(&causes.misses),
            OutOfSteps::Crowding => self.too_much(&causes.crowding),
        })?;
        Ok(())
    }

    fn too_much(&self, blame: &[String]) -> GrowError {
        GrowError::TooMuchWork { limit: self.limits.work, blame: Blame(blame.to_vec()) }
    }
}

/// What is to blame where graphs take too much.
#[derive(Clone, Debug)]
pub(crate) struct Causes {
    /// For their number and that of their nodes.
    pub(crate) nodes: Vec<String>,
    /// For darts that find no place.
    pub(crate) misses: Vec<String>,
    /// For nodes that are crowded.
    pub(crate) crowding: Vec<String>,
}

impl Causes {
    /// For the first graph, whose nodes are crowded because of `crowded`.
    pub(crate) fn first(crowded: String) -> Self {
        Self { nodes: names([Id::nodes]), misses: names([Id::spacing, Id::nodes]), crowding: vec![crowded] }
    }

    /// For the graph of the roots.
    pub(crate) fn roots() -> Self {
        let misses = names([Id::spacing, Id::subgraph_nodes]);
        Self { nodes: names([Id::subgraph_nodes]), crowding: misses.clone(), misses }
    }

    /// For the graphs of `level`, from 2. Which of them is the first to find that too much is taken
    /// depends on threads, so that one thing is to blame.
    pub(crate) fn level(level: usize) -> Self {
        let nodes = vec![Id::subgraph_nodes.slot_name(0), Id::branching.slot_name(level - 2)];
        Self { nodes, ..Self::roots() }
    }
}

fn names<const N: usize>(ids: [Id; N]) -> Vec<String> {
    ids.map(|id| id.slot_name(0)).to_vec()
}
