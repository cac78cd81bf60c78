//! Counting what a tree will have without growing it.
//!
//! How many stems, knots and leaves there are follows from lengths, radii and draws, and not from where
//! anything stands, unless stems are pruned. So a tree that will pass a limit can be given up for a small
//! part of what growing it up to there would take.

use crate::budget::{Budget, CHILD_STEPS, Cause, Exceeded, POINT_STEPS};
use crate::children::{self, Bearing};
use crate::context::{Buffers, GrowContext};
use crate::leaves;
use crate::path::{fork_index, forks_at};
use crate::spacing::{Spacing, places};
use crate::stem::{ForkStart, StemSpec};
use pleach_tree::Foliage;

/// What the tree will have cost once the branches that wait in `buffers`, and all that they carry, have grown.
///
/// # Errors
/// The limit that will be passed.
pub(crate) fn count(
    context: &GrowContext<'_>,
    buffers: &mut Buffers<'_>,
) -> Result<Budget<'static>, Exceeded> {
    let Buffers { children, forked_stems, budget, .. } = buffers;
    let mut census = Census { context, budget: budget.trial(), forks: forked_stems, keeps: Vec::new() };
    let counted = children.iter().rev().try_for_each(|branch| census.branch(branch));
    census.forks.clear();
    counted.map(|()| census.budget)
}

struct Census<'a> {
    context: &'a GrowContext<'a>,
    budget: Budget<'static>,
    /// Forks that are yet to be counted; a stack.
    forks: &'a mut Vec<StemSpec>,
    /// What forks leave of the children of each segment, for stems that are being counted; a stack.
    keeps: Vec<f64>,
}

impl Census<'_> {
    fn branch(&mut self, branch: &StemSpec) -> Result<(), Exceeded> {
        let mut carry = branch.first_carry(self.context.model);
        self.stem(branch, &mut carry)
    }

    /// Counts a stem, what it carries, and its forks.
    fn stem(&mut self, stem: &StemSpec, carry: &mut f64) -> Result<(), Exceeded> {
        let GrowContext { model, growth, .. } = *self.context;
        if !stem.is_made() {
            return Ok(());
        }
        let knots = stem.knots(model);
        let steps = POINT_STEPS * u64::from(stem.points(model)) + knots as u64;
        self.budget.work(Cause::Walk, stem.level, steps)?;
        self.budget.stem(knots)?;

        let child_length = stem.child_length(model);
        let (first_fork, first_keep) = (self.forks.len(), self.keeps.len());
        self.walk(stem, child_length, carry);
        if stem.level + 1 < model.level_count {
            self.children(stem, child_length, first_keep)?;
        } else if stem.level > 0 && growth.foliage != Foliage::None {
            self.leaves(&leaves::spacing(model, stem))?;
        }
        self.keeps.truncate(first_keep);

        let last_fork = self.forks.len();
        for i in first_fork..last_fork {
            let mut fork = self.forks[i];
            fork.adopt(model, stem);
            self.stem(&fork, carry)?;
        }
        self.forks.truncate(first_fork);
        Ok(())
    }

    /// Finds where `stem` forks, and what that leaves of the children of each segment.
    fn walk(&mut self, stem: &StemSpec, child_length: f64, carry: &mut f64) {
        let GrowContext { model, growth, .. } = *self.context;
        let segments = model.levels[stem.level].curve_res;
        let is_helix = model.levels[stem.level].is_helix();
        let mut fork = stem.fork();
        let mut keep = if is_helix { 1.0 } else { fork.branch_factor };
        for i in stem.start() + 1..=segments {
            if i < segments && !is_helix {
                let parting = forks_at(model, stem, i, carry, &mut fork, &mut keep);
                for j in 0..parting.forked_stems {
                    let state = ForkStart { start: i, first_handle: None, child_length, fork };
                    self.forks.push(stem.fork_at(growth, state, fork_index(i, j)).0);
                }
            }
            self.keeps.push(keep);
        }
    }

    fn children(&mut self, stem: &StemSpec, child_length: f64, first_keep: usize) -> Result<(), Exceeded> {
        let GrowContext { model, growth, .. } = *self.context;
        let spacing = children::spacing(model, stem);
        let bearing = Bearing::new(model, growth, stem, child_length);
        if spacing.count < 0.0 {
            self.budget.work(Cause::Children, stem.level, -spacing.count as u64)?;
            return (0..spacing.members())
                .try_for_each(|number| self.child(&bearing, number, stem.length, true));
        }
        let (bare, mut shares, mut number) = (spacing.bare(), spacing.shares(), 0);
        for piece in 0..self.keeps.len() - first_keep {
            let here = shares.take(self.keeps[first_keep + piece]);
            self.budget.work(Cause::Children, stem.level, here as u64)?;
            places(spacing.next.branch_dist, here as u32, |place| {
                let offset = spacing.offset(piece, place.t);
                number += 1;
                if offset > bare { self.child(&bearing, number - 1, offset, false) } else { Ok(()) }
            })?;
        }
        Ok(())
    }

    fn child(
        &mut self,
        bearing: &Bearing<'_>,
        number: u32,
        offset: f64,
        in_fan: bool,
    ) -> Result<(), Exceeded> {
        let Some((child, _)) = bearing.child(number, offset, in_fan) else { return Ok(()) };
        self.budget.work(Cause::Children, child.level - 1, CHILD_STEPS)?;
        self.branch(&child)
    }

    /// Counts the leaves of a stem, a segment at a time where all of its places bear one.
    fn leaves(&mut self, spacing: &Spacing<'_>) -> Result<(), Exceeded> {
        let level = spacing.stem.level;
        if spacing.count < 0.0 {
            self.budget.work(Cause::Leaves, level, -spacing.count as u64)?;
            return self.budget.leaves(spacing.members() as usize);
        }
        let (bare, mut shares) = (spacing.bare(), spacing.shares());
        let dist = spacing.next.branch_dist;
        for piece in 0..spacing.stem.points(self.context.model) as usize - 1 {
            let here = shares.take(1.0);
            self.budget.work(Cause::Leaves, level, here as u64)?;
            let mut leaves = here as usize;
            if dist > 1.0 || spacing.offset(piece, 0.0) <= bare {
                leaves = 0;
                places(dist, here as u32, |place| {
                    leaves += usize::from(spacing.offset(piece, place.t) > bare);
                    Ok::<(), Exceeded>(())
                })?;
            }
            self.budget.leaves(leaves)?;
        }
        Ok(())
    }
}
