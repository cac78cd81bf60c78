//! What growing has cost so far, held against the limits.
//!
//! A tree that grows on several threads has one count: every part adds what it has made to a
//! [`Pool`] now and then, and all parts stop once the sums are over. Which part notices first is
//! left to chance, so the tree is then grown again on one thread, where the error is always the same.

use pleach_tree::Limits;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering::Relaxed};

/// Steps after which a part adds what it has made to the pool: often enough that all parts together
/// overshoot a limit by little, seldom enough that threads do not wait for each other.
const TELL: u64 = 1024;
/// Stems that wait in one part may be this fraction of the limit; beyond, one thread grows alone.
const WAITING_SHARE: usize = 16;
/// Always allowed: eight megabytes.
const FREE_PART: usize = 30_000;

/// Part of a limit that has to be spent before it is worth counting what is to come.
const MIN_SPENT: f64 = 0.01;
/// Part of a limit that a tree has to be likely to spend for that.
const LOOKS_SHORT: f64 = 0.6;

/// Stems that may wait to be pruned for each stem of the limit: most of them may vanish.
const WAITING_PER_STEM: usize = 8;
/// Where memory matters, though, no more wait than there may be stems: a quarter of a kilobyte each.
const FREE_WAITING: usize = 500_000;

/// Steps for one point of a path.
pub(crate) const POINT_STEPS: u64 = 5;
/// Steps for one point of a path that pruning tries, and tests.
pub(crate) const TRIAL_STEPS: u64 = 6;
/// Solids that a point is tested against in one step.
pub(crate) const SOLIDS_A_STEP: u64 = 4;
/// Steps for a child beyond those for trying its place.
pub(crate) const CHILD_STEPS: u64 = 4;
/// Trunks whose distance to a dart is measured in one step.
pub(crate) const DARTS_A_STEP: u64 = 8;

/// The limit that was passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exceeded {
    Stems,
    Leaves,
    Knots,
    Work,
    /// More stems wait to be pruned than a tree may have.
    Waiting,
}

/// The part of growing that takes work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cause {
    /// Finding places for trunks.
    Darts,
    /// Walking stems of a level.
    Walk,
    /// Walking stems of a level again, shorter and shorter.
    Pruning,
    /// Trying places for the children of stems of a level.
    Children,
    /// Trying places for the leaves of stems of a level.
    Leaves,
}

impl Cause {
    pub(crate) const ALL: [Self; 5] = [Self::Darts, Self::Walk, Self::Pruning, Self::Children, Self::Leaves];
}

#[derive(Clone, Copy, Debug, Default)]
struct Spent {
    stems: usize,
    leaves: usize,
    knots: usize,
    work: u64,
}

/// The sums over all parts of a tree.
#[derive(Debug, Default)]
pub(crate) struct Pool {
    stems: AtomicUsize,
    leaves: AtomicUsize,
    knots: AtomicUsize,
    work: AtomicU64,
    /// Set when a part has failed: the others need not go on.
    stop: AtomicBool,
    /// Stems that wait in all parts when they begin: on one thread they would wait beside those of any part.
    waiting: usize,
}

/// The counts of one thread.
#[derive(Debug)]
pub(crate) struct Budget<'a> {
    limits: Limits,
    /// Whether stems may vanish after they have been counted as waiting.
    prunes: bool,
    spent: Spent,
    told: Spent,
    pool: Option<&'a Pool>,
    steps: [[u64; 4]; Cause::ALL.len()],
}

impl Budget<'static> {
    pub(crate) fn new(limits: Limits, prunes: bool) -> Self {
        let (spent, told) = (Spent::default(), Spent::default());
        Self { limits, prunes, spent, told, pool: None, steps: [[0; 4]; Cause::ALL.len()] }
    }
}

impl Budget<'_> {
    /// The pool of the parts to come, which have `waiting` stems and begin with what has been spent so far.
    pub(crate) const fn pool(&self, waiting: usize) -> Pool {
        let Spent { stems, leaves, knots, work } = self.spent;
        Pool {
            stems: AtomicUsize::new(stems),
            leaves: AtomicUsize::new(leaves),
            knots: AtomicUsize::new(knots),
            work: AtomicU64::new(work),
            stop: AtomicBool::new(false),
            waiting: match self.pool {
                Some(pool) => waiting + pool.waiting,
                None => waiting,
            },
        }
    }

    /// Counts what the parts of a pool that began with this budget have spent so far.
    pub(crate) fn add(&mut self, pool: &Pool) {
        self.spent = Spent {
            stems: pool.stems.load(Relaxed),
            leaves: pool.leaves.load(Relaxed),
            knots: pool.knots.load(Relaxed),
            work: pool.work.load(Relaxed),
        };
    }

    /// The budget of a part.
    pub(crate) const fn part<'p>(&self, pool: &'p Pool) -> Budget<'p> {
        Budget { pool: Some(pool), ..self.trial() }
    }

    /// Counts `steps` of work on level `level`.
    pub(crate) fn work(&mut self, cause: Cause, level: usize, steps: u64) -> Result<(), Exceeded> {
        let sum = &mut self.steps[cause as usize][level];
        *sum = sum.saturating_add(steps);
        self.spent.work = self.spent.work.saturating_add(steps);
        if self.spent.work > self.limits.work {
            return Err(Exceeded::Work);
        }
        if self.spent.work - self.told.work >= TELL { self.tell() } else { Ok(()) }
    }

    /// Counts a stem with `knots` knots.
    pub(crate) fn stem(&mut self, knots: usize) -> Result<(), Exceeded> {
        self.spent.stems += 1;
        self.spent.knots += knots;
        if self.spent.stems > self.limits.stems {
            Err(Exceeded::Stems)
        } else if self.spent.knots > self.limits.knots {
            Err(Exceeded::Knots)
        } else {
            Ok(())
        }
    }

    /// Counts a leaf or blossom.
    pub(crate) const fn leaf(&mut self) -> Result<(), Exceeded> {
        self.leaves(1)
    }

    /// Counts leaves or blossoms.
    pub(crate) const fn leaves(&mut self, count: usize) -> Result<(), Exceeded> {
        self.spent.leaves += count;
        if self.spent.leaves > self.limits.leaves { Err(Exceeded::Leaves) } else { Ok(()) }
    }

    /// Minds that `waiting` stems are yet to be grown. Without pruning each will be one of the tree.
    pub(crate) const fn wait(&self, waiting: usize) -> Result<(), Exceeded> {
        let share = self.limits.stems / WAITING_SHARE;
        if self.pool.is_some() && waiting > share && waiting > FREE_PART {
            return Err(Exceeded::Waiting);
        }
        if !self.prunes && self.spent.stems + waiting > self.limits.stems {
            return Err(Exceeded::Stems);
        }
        let waiting = match self.pool {
            Some(pool) => waiting + pool.waiting,
            None => waiting,
        };
        let Limits { stems, .. } = self.limits;
        let most = stems.saturating_mul(WAITING_PER_STEM);
        let room = if stems > FREE_WAITING { stems } else { FREE_WAITING };
        if waiting > most || waiting > room { Err(Exceeded::Waiting) } else { Ok(()) }
    }

    /// Whether the tree would pass a limit if the rest of its `all` branches were like the `done` ones.
    ///
    /// Not before some work has been done, and earlier than it would come to pass: branches differ.
    pub(crate) fn looks_short(&self, done: usize, all: usize) -> bool {
        let (limits, spent) = (&self.limits, &self.spent);
        let part = |spent: u64, limit: u64| spent as f64 / (limit as f64).max(1.0);
        let spent = part(spent.stems as u64, limits.stems as u64)
            .max(part(spent.leaves as u64, limits.leaves as u64))
            .max(part(spent.knots as u64, limits.knots as u64))
            .max(part(spent.work, limits.work));
        spent > MIN_SPENT && spent * all as f64 > LOOKS_SHORT * done as f64
    }

    /// A budget of its own that goes on from what has been spent so far.
    pub(crate) const fn trial(&self) -> Budget<'static> {
        let Self { limits, prunes, spent, steps, .. } = *self;
        Budget { limits, prunes, spent, told: spent, pool: None, steps }
    }

    /// Adds what is new to the pool, if there is one, and fails if the sums are over.
    pub(crate) fn tell(&mut self) -> Result<(), Exceeded> {
        let Some(pool) = self.pool else { return Ok(()) };
        let (now, then, limits) = (self.spent, self.told, &self.limits);
        self.told = now;
        let stems = now.stems - then.stems + pool.stems.fetch_add(now.stems - then.stems, Relaxed);
        let leaves = now.leaves - then.leaves + pool.leaves.fetch_add(now.leaves - then.leaves, Relaxed);
        let knots = now.knots - then.knots + pool.knots.fetch_add(now.knots - then.knots, Relaxed);
        let work = pool.work.fetch_add(now.work - then.work, Relaxed).saturating_add(now.work - then.work);
        let over = pool.stop.load(Relaxed)
            || stems > limits.stems
            || leaves > limits.leaves
            || knots > limits.knots
            || work > limits.work;
        if over { Err(Exceeded::Work) } else { Ok(()) }
    }

    /// Makes every other part stop as soon as it reports.
    pub(crate) fn stop_all(&self) {
        if let Some(pool) = self.pool {
            pool.stop.store(true, Relaxed);
        }
    }

    /// Steps of work so far.
    pub(crate) const fn spent_work(&self) -> u64 {
        self.spent.work
    }

    pub(crate) const fn limits(&self) -> &Limits {
        &self.limits
    }

    /// What most of the work was done for, and on which level.
    pub(crate) fn most_work(&self) -> (Cause, usize) {
        let all = Cause::ALL.into_iter().flat_map(|cause| (0..4).map(move |level| (cause, level)));
        all.max_by_key(|&(cause, level)| self.steps[cause as usize][level]).unwrap_or((Cause::Walk, 0))
    }
}
