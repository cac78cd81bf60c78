//! First-level branches on many threads: they are cut into parts, which grow into trees of their own and are put
//! together in order.

use crate::budget::{Budget, Exceeded, Pool};
use crate::context::{Buffers, Scratch};
use crate::stem::StemSpec;
use pleach_tree::{Helpers, StemKind, Tree};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError};

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
    let grow = |chunk: &[StemSpec]| {
        let mut tree = Tree::default();
        part(chunk, budget, &pool, &mut Scratch::default(), &mut tree, grow)?;
        // Room for more would be as much again, all parts together.
        tree.shrink_to_fit();
        Ok(tree)
    };
    let parts = branches.par_chunks(part_of(branches)).map(grow).collect::<Result<Vec<Tree>, Exceeded>>()?;
    tree.reserve_for(&parts);
    parts.iter().for_each(|part| add(part, tree, 1));
    Ok(())
}

/// Stems that wait to be grown, of which those from number `first` on are.
pub(crate) struct Waiting<'a> {
    pub(crate) all: &'a [StemSpec],
    pub(crate) first: usize,
}

/// How stems are counted without being grown.
pub(crate) struct Count<'a> {
    /// How many of the stems with these had been grown before.
    pub(crate) done: usize,
    pub(crate) all: usize,
    /// Counts those that wait.
    pub(crate) count: &'a (dyn Fn(&mut Buffers<'_>) -> Result<(), Exceeded> + Sync),
}

/// Grows the stems of `waiting` with `helpers` and adds them to `tree`, which is left alone otherwise; whether it has.
/// Where it has not, one thread has to say whether they pass a limit. Once they look too many, they are counted.
///
/// # Errors
/// A limit that they pass.
pub(crate) fn shared(
    waiting: &Waiting<'_>,
    budget: &mut Budget<'_>,
    tree: &mut Tree,
    helpers: &dyn Helpers,
    grow: &GrowBranch<'_>,
    count: Option<Count<'_>>,
) -> Result<bool, Exceeded> {
    let pool = budget.pool(waiting.all.len());
    let branches = &waiting.all[waiting.first..];
    let chunks: Vec<&[StemSpec]> = branches.chunks(part_of(branches)).collect();
    let before = [tree.stems.len(), tree.knots.len(), tree.leaves.len(), tree.blossoms.len()];
    let sink = Sink {
        level: branches[0].level,
        end: Mutex::new(End { tree, parts: 0 }),
        grown: Mutex::new(Grown {
            parts: chunks.iter().map(|_| None).collect(),
            free: Vec::new(),
            failed: None,
        }),
    };
    let (common, done, is_counted) = (&*budget, AtomicUsize::new(0), AtomicBool::new(count.is_none()));
    let count = |scratch: &mut Scratch, grown: usize| {
        let done = done.fetch_add(grown, Relaxed) + grown;
        let Some(Count { done: before, all, count }) = &count else { return Ok(()) };
        let (mut so_far, mut none) = (common.trial(), Tree::default());
        so_far.add(&pool);
        if !so_far.looks_short(before + done, *all) || is_counted.swap(true, Relaxed) {
            return Ok(());
        }
        let mut buffers = scratch.buffers(&mut none, common.trial());
        buffers.children.extend(branches.iter().rev());
        count(&mut buffers).inspect_err(|_| common.part(&pool).stop_all())
    };
    helpers.share(chunks.len(), &|next| {
        let mut scratch = Scratch::default();
        while let Some(number) = next() {
            let mut tree = locked(&sink.grown).free.pop().unwrap_or_default();
            let grown = part(chunks[number], common, &pool, &mut scratch, &mut tree, grow);
            let counted = grown.and_then(|()| count(&mut scratch, chunks[number].len()));
            match counted {
                Ok(()) => sink.add(number, tree),
                Err(exceeded) => sink.fail(exceeded),
            }
        }
    });
    let Sink { end, grown, .. } = sink;
    let failed = grown.into_inner().unwrap_or_else(PoisonError::into_inner).failed;
    let Some(exceeded) = failed else {
        budget.add(&pool);
        return Ok(true);
    };
    let tree = end.into_inner().unwrap_or_else(PoisonError::into_inner).tree;
    tree.stems.truncate(before[0]);
    tree.knots.truncate(before[1]);
    tree.leaves.truncate(before[2]);
    tree.blossoms.truncate(before[3]);
    // Fewer stems may wait in a part than in a tree. All else that parts have spent would have been spent on one
    // thread, too.
    if exceeded == Exceeded::Waiting { Ok(false) } else { Err(exceeded) }
}

/// Where the parts come together while others grow: the trees of parts are small, and used for one part after another.
struct Sink<'a> {
    /// Of the stems whose parents are in the tree already.
    level: usize,
    end: Mutex<End<'a>>,
    grown: Mutex<Grown>,
}

/// The tree to which parts are added in order, and how many have been.
struct End<'a> {
    tree: &'a mut Tree,
    parts: usize,
}

/// The parts that wait to be added.
struct Grown {
    parts: Vec<Option<Tree>>,
    free: Vec<Tree>,
    /// The limit that has been passed: that on stems that wait before any other, since parts stop for each other.
    failed: Option<Exceeded>,
}

impl Sink<'_> {
    /// Adds part `number`, if all before it are there and no other thread is adding, and what waits for it.
    fn add(&self, number: usize, part: Tree) {
        locked(&self.grown).parts[number] = Some(part);
        loop {
            let Ok(mut end) = self.end.try_lock() else { return };
            let End { tree, parts } = &mut *end;
            let take = |number: usize| locked(&self.grown).parts.get_mut(number).and_then(Option::take);
            while let Some(mut part) = take(*parts) {
                add(&part, tree, self.level);
                part.clear();
                locked(&self.grown).free.push(part);
                *parts += 1;
            }
            let next = *parts;
            drop(end);
            // A thread that found this one adding has left the part that it had.
            if locked(&self.grown).parts.get(next).is_none_or(Option::is_none) {
                return;
            }
        }
    }

    fn fail(&self, exceeded: Exceeded) {
        let failed = &mut locked(&self.grown).failed;
        if *failed != Some(Exceeded::Waiting) {
            *failed = Some(exceeded);
        }
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Branches of each part.
const fn part_of(branches: &[StemSpec]) -> usize {
    branches.len().div_ceil(PARTS)
}

/// Grows the branches of a part into `tree`, which is empty.
fn part(
    branches: &[StemSpec],
    budget: &Budget<'_>,
    pool: &Pool,
    scratch: &mut Scratch,
    tree: &mut Tree,
    grow: &GrowBranch<'_>,
) -> Result<(), Exceeded> {
    let mut buffers = scratch.buffers(tree, budget.part(pool));
    let grown = branches.iter().try_for_each(|branch| grow(&mut buffers, *branch));
    let grown = grown.and_then(|()| buffers.budget.tell());
    if grown.is_err() {
        buffers.budget.stop_all();
    }
    grown
}

/// Adds a part at the end of `tree`, which has the parents of the branches of `level`.
fn add(part: &Tree, tree: &mut Tree, level: usize) {
    tree.append(part, |stem| usize::from(stem.level) == level && stem.kind == StemKind::Branch);
}
