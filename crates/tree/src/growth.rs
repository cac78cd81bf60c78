//! One request to grow a tree, and what is reused from one tree to the next.

use pleach_plant::{Address, Draw, Draws, Foliage, Helpers, Hull};
use std::any::Any;
use std::fmt;

/// How many parts a tree may have, and how much work may go into it, before growing it is an error.
///
/// A limit is one count for the whole tree, on however many threads it grows. Change some and keep
/// the others: `Limits { stems: 1000, ..Limits::DEFAULT }`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most stems.
    pub stems: usize,
    /// Most leaves and blossoms together.
    pub leaves: usize,
    /// Most knots of all stems together: what memory grows with.
    pub knots: usize,
    /// Most steps of work: points walked, places tried for children and leaves, successful or not. Each generator
    /// defines its step; one takes some 50 ns.
    pub work: u64,
}

impl Limits {
    /// 500,000 stems, 5,000,000 leaves, 5,000,000 knots and 40,000,000 steps: ten times the largest
    /// of the known species and more. At most 1.5 GB and 10 s of processor time, the copies and the
    /// repetition of trees that grow in parallel included.
    pub const DEFAULT: Self = Self { stems: 500_000, leaves: 5_000_000, knots: 5_000_000, work: 40_000_000 };
}

impl Default for Limits {
    /// [`Limits::DEFAULT`].
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// One request to grow a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Growth<'a> {
    /// Seed of the tree.
    pub seed: u64,
    /// Bounds that turn runaway trees into errors.
    pub limits: Limits,
    /// Which leaves are made; stems do not depend on it.
    pub foliage: Foliage,
    /// Whether the stems of a big tree may be grown on rayon's threads. The tree is the same.
    pub parallel: bool,
    /// Threads that may help with a big tree from any time on at which they have nothing else to do. The tree is the
    /// same, and one beyond the limits fails; but the error may name another one of the limits that it passes.
    /// Generators that cannot share their work do not.
    pub helpers: Option<&'a dyn Helpers>,
    /// Whether a tree that looks too large while it grows is counted ahead, without growing the rest, and given up
    /// at once if it will pass a limit. Trees within the limits are the same, and those beyond fail; but the
    /// error may name another one of the limits that they pass, and blame other parameters. Generators that
    /// cannot count do not.
    pub counts_ahead: bool,
    /// Stems with draws of their own; generators without [spreads](crate::Generator::spreads) have none.
    pub draws: Option<&'a Draws>,
}

impl Growth<'_> {
    /// A whole tree from `seed` on the calling thread, within the default limits.
    #[must_use]
    pub fn seed(seed: u64) -> Self {
        Self { seed, ..Self::default() }
    }

    /// The draw of the stem at `address`, of `level`.
    #[must_use]
    pub fn draw(&self, address: Address, level: usize) -> Draw {
        self.draws.map_or(Draw::OWN, |draws| draws.at(address, level))
    }

    /// What the crown grows into, if it is an individual's.
    #[must_use]
    pub fn hull(&self) -> Option<&Hull> {
        self.draws.and_then(Draws::hull)
    }
}

/// Memory that generators reuse from one tree to the next.
#[derive(Default)]
pub struct Workspace {
    scratch: Option<Box<dyn Any + Send>>,
}

impl Workspace {
    /// The scratch of type `T` left here by the last tree, or a new one.
    pub fn scratch<T: Any + Send + Default>(&mut self) -> &mut T {
        if !self.scratch.as_ref().is_some_and(|s| s.is::<T>()) {
            self.scratch = None;
        }
        let scratch = self.scratch.get_or_insert_with(|| Box::<T>::default());
        scratch.downcast_mut().expect("the scratch was just made to be of this type")
    }
}

impl fmt::Debug for Workspace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Workspace").finish_non_exhaustive()
    }
}
