//! Counts the parts of a tree before any of them is made.

use super::GrowFault;
use super::pen::{At, Steps};
use crate::program::Command;
use crate::system::Derived;
use pleach_tree::Limits;

/// A branch of the string: a `[`, or the trunk, or what follows on a gap.
#[derive(Clone, Copy, Debug)]
pub(super) struct Branch {
    /// The branch that it grows from.
    pub(super) parent: Option<u32>,
    /// Number of its pieces; a branch without one is left out.
    pub(super) pieces: u32,
}

/// Every branch in the order of their beginnings, and the number of leaves.
#[derive(Debug, Default)]
pub(super) struct Survey {
    pub(super) branches: Vec<Branch>,
    pub(super) leaves: usize,
}

/// Most leaves of one piece.
const MAX_LEAVES: f64 = 10_000.0;

/// The number of leaves that the arguments of a piece ask for.
pub(super) fn leaves_of(values: &[f64]) -> u32 {
    values.get(1).map_or(0.0, |count| count.clamp(0.0, MAX_LEAVES)) as u32
}

impl Survey {
    /// Walks the string without a turtle.
    pub(super) fn new(derived: &Derived<'_>, limits: &Limits, leafy: bool) -> Result<Self, GrowFault> {
        let mut survey = Self { branches: vec![Branch { parent: None, pieces: 0 }], leaves: 0 };
        let tips = Steps::new(derived.header()).tips;
        let (mut at, mut stack) = (At::default(), Vec::new());
        let (mut stems, mut knots) = (0_usize, 0_usize);
        for (kind, values) in derived.modules.iter(&derived.system.program.kinds) {
            match kind.command {
                Command::Open => {
                    stack.push(at);
                    at = At { branch: survey.branches.len() as u32, gap: false };
                    survey.branches.push(Branch { parent: stack.last().map(|s| s.branch), pieces: 0 });
                }
                Command::Close => {
                    if tips && survey.branches[at.branch as usize].pieces > 0 {
                        survey.leaves += 1;
                    }
                    at = stack.pop().unwrap_or_default();
                }
                Command::Move => at.gap = true,
                Command::Forward => {
                    survey.bridge(&mut at);
                    let branch = &mut survey.branches[at.branch as usize];
                    branch.pieces += 1;
                    let first = branch.pieces == 1;
                    stems += usize::from(first);
                    knots += 1 + usize::from(first);
                    survey.leaves += leaves_of(values) as usize;
                }
                Command::Leaf | Command::ClosePolygon => survey.leaves += 1,
                _ => {}
            }
            if stems > limits.stems {
                return Err(GrowFault::Stems);
            }
            if knots > limits.knots {
                return Err(GrowFault::Knots);
            }
            if leafy && survey.leaves > limits.leaves {
                return Err(GrowFault::Leaves);
            }
        }
        Ok(survey)
    }

    /// A piece after a gap begins a branch of its own beside the last one.
    fn bridge(&mut self, at: &mut At) {
        let last = self.branches[at.branch as usize];
        if at.gap && last.pieces > 0 {
            at.branch = self.branches.len() as u32;
            self.branches.push(Branch { pieces: 0, ..last });
        }
        at.gap = false;
    }
}
