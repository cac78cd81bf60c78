//! First-level branches on many threads: they are cut into parts, which grow into trees of their own and are put
//! together in order.

use crate::budget::{Budget, Exceeded, Pool};
use crate::context::{Buffers, Scratch};
use crate::stem::StemSpec;
use pleach_tree::{Helpers, StemKind, Tree};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// Parts into which first-level branches are cut for the threads.
const PARTS: usize = 32;

/// Grows a branch and everything on it.
pub(crate) type GrowBranch<'a> = dyn Fn(&mut Buffers<'_>, StemSpec) -> Result<(), Exceeded> + Sync + 'a;

/// Grows `branches` on all threads and adds them to `tree`, or leaves it alone and fails.
pub(crate) fn in_parallel(
    branches: &[StemSpec],
    budget: &Budget<'_>,
    tree: &mut Tree,
    grow: &GrowBranch<'_>,
) -> Result<(), Exceeded> {
    let pool = budget.pool(branches.len());
    let chunks = branches.par_chunks(part_of(branches));
    let parts = chunks.map(|chunk| part(chunk, budget, &pool, &mut Scratch::default(), grow));
    put_together(parts.collect::<Result<_, Exceeded>>()?, tree);
    Ok(())
}

/// Grows `branches` with `helpers` and adds them to `tree`, which is left alone otherwise; whether it has. Where it
/// has not, one thread has to say whether they pass a limit.
///
/// # Errors
/// A limit that they pass.
pub(crate) fn shared(
    branches: &[StemSpec],
    budget: &Budget<'_>,
    tree: &mut Tree,
    helpers: &dyn Helpers,
    grow: &GrowBranch<'_>,
) -> Result<bool, Exceeded> {
    let pool = budget.pool(branches.len());
    let chunks: Vec<&[StemSpec]> = branches.chunks(part_of(branches)).collect();
    let done = Mutex::new(Vec::with_capacity(chunks.len()));
    helpers.share(chunks.len(), &|next| {
        let mut scratch = Scratch::default();
        while let Some(number) = next() {
            let grown = part(chunks[number], budget, &pool, &mut scratch, grow);
            done.lock().unwrap_or_else(PoisonError::into_inner).push((number, grown));
        }
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    // Fewer stems may wait in a part than in a tree, and the others stop for that one.
    if done.iter().any(|(_, grown)| matches!(grown, Err(Exceeded::Waiting))) {
        return Ok(false);
    }
    done.sort_unstable_by_key(|(number, _)| *number);
    // All else that parts have spent would have been spent on one thread, too.
    let parts = done.into_iter().map(|(_, grown)| grown).collect::<Result<_, Exceeded>>()?;
    put_together(parts, tree);
    Ok(true)
}

/// Branches of each part.
const fn part_of(branches: &[StemSpec]) -> usize {
    branches.len().div_ceil(PARTS)
}

/// Grows the branches of a part.
fn part(
    branches: &[StemSpec],
    budget: &Budget<'_>,
    pool: &Pool,
    scratch: &mut Scratch,
    grow: &GrowBranch<'_>,
) -> Result<Tree, Exceeded> {
    let mut tree = Tree::default();
    let mut buffers = scratch.buffers(&mut tree, budget.part(pool));
    let grown = branches.iter().try_for_each(|branch| grow(&mut buffers, *branch));
    let grown = grown.and_then(|()| buffers.budget.tell());
    if grown.is_err() {
        buffers.budget.stop_all();
    }
    // Room for more would be as much again, all parts together.
    grown.map(|()| tree.shrink_to_fit()).map(|()| tree)
}

fn put_together(parts: Vec<Tree>, tree: &mut Tree) {
    tree.reserve_for(&parts);
    for part in parts {
        tree.append(&part, |stem| stem.level == 1 && stem.kind == StemKind::Branch);
    }
}
