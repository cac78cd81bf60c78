//! What a generator promises.

use crate::param::{CheckedParams, ParamSpace, Unit};
use crate::plant::Tree;
use crate::species::{Key, Species, SpeciesDoc, SpeciesError};
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
    /// Most steps of work: points walked, places tried for children and leaves, whether or not
    /// anything comes of them. What a step is, is the generator's affair; it takes some 50 ns.
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

/// Which leaves are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Foliage {
    /// Every leaf and blossom.
    #[default]
    All,
    /// Stems only.
    None,
    /// About one leaf in this many, grown so that the leaf area stays: a coarse crown.
    OneIn(u32),
}

/// One request to grow a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Growth {
    /// Seed of the tree.
    pub seed: u64,
    /// Bounds that turn monsters into errors.
    pub limits: Limits,
    /// Which leaves are made; stems do not depend on it.
    pub foliage: Foliage,
    /// Whether the stems of a big tree may be grown on rayon's threads. The tree is the same.
    pub parallel: bool,
}

impl Growth {
    /// A whole tree from `seed` on the calling thread, within the default limits.
    #[must_use]
    pub fn seed(seed: u64) -> Self {
        Self { seed, ..Self::default() }
    }
}

/// The parameters that an error is put down to, most of all first; none where that is not known.
///
/// Its text continues a sentence: `, because of branches[2] and branches[1]`, with quotes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Blame(pub Vec<String>);

impl fmt::Display for Blame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, name) in self.0.iter().enumerate() {
            let before = match i {
                0 => ", because of",
                _ if i + 1 == self.0.len() => " and",
                _ => ",",
            };
            write!(f, "{before} `{name}`")?;
        }
        Ok(())
    }
}

/// Why a tree did not grow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GrowError {
    /// More stems than [`Limits::stems`].
    #[error(
        "the tree would have more than {limit} stems{blame}; fewer branches or splits, or a higher limit"
    )]
    TooManyStems {
        /// The limit.
        limit: usize,
        /// What makes them so many.
        blame: Blame,
    },
    /// More leaves and blossoms than [`Limits::leaves`].
    #[error("the tree would have more than {limit} leaves{blame}; a smaller leaf number, or a higher limit")]
    TooManyLeaves {
        /// The limit.
        limit: usize,
        /// What makes them so many.
        blame: Blame,
    },
    /// More knots than [`Limits::knots`].
    #[error(
        "the tree's stems would have more than {limit} knots{blame}; fewer or simpler stems, or a higher limit"
    )]
    TooManyKnots {
        /// The limit.
        limit: usize,
        /// What makes them so many.
        blame: Blame,
    },
    /// More work than [`Limits::work`].
    #[error("growing the tree takes more than {limit} steps{blame}; smaller numbers, or a higher limit")]
    TooMuchWork {
        /// The limit.
        limit: u64,
        /// What most of the work is done for.
        blame: Blame,
    },
    /// Numbers left the range in which positions make sense.
    #[error("{what} is not finite")]
    NotFinite {
        /// What left the range.
        what: &'static str,
    },
    /// Values that are each allowed and cannot grow together.
    #[error("{message}")]
    Conflict {
        /// Which, and what would be right.
        message: String,
    },
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

/// A growth model with everything settled but its numbers.
///
/// Shared between threads behind an `Arc`; cheap to call, since all memory comes from the caller.
pub trait Generator: Send + Sync + fmt::Debug {
    /// The family's name, as in `generator = "weber-penn"`.
    fn family(&self) -> &'static str;

    /// The numbers that it takes.
    fn space(&self) -> &ParamSpace;

    /// Grows a tree into `tree`, whose former content is dropped and whose memory is kept.
    ///
    /// The same parameters and the same seed give the same tree, bit for bit, on any number of
    /// threads and whatever `workspace` was used for before.
    ///
    /// # Errors
    /// See [`GrowError`]; `tree` is then in an unspecified but valid state.
    fn grow(
        &self,
        params: &CheckedParams,
        growth: &Growth,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(), GrowError>;

    /// Whether the value in slot number `slot` can change any tree grown with these `values`.
    ///
    /// False for levels that a species does not have, or for the shape of blossoms at a rate of 0.
    fn reads(&self, values: &[f64], slot: usize) -> bool {
        let _ = (values, slot);
        true
    }

    /// The values, in rising order, at which the number in slot number `slot` starts to mean
    /// something else, though a tree changes gradually across them; empty for most.
    ///
    /// `taper` of Weber and Penn is an example: a cone up to 1, rounded up to 2, beads above. A sign
    /// that is a switch is told by [`Kind::Flagged`](crate::Kind::Flagged) instead.
    fn regimes(&self, slot: usize) -> &'static [f64] {
        let _ = slot;
        &[]
    }

    /// The values in slot number `slot` that trees have which anyone would draw: its search range, or a
    /// part of it. Beyond it, a tree may look right as a silhouette and be absurd.
    ///
    /// Searches go no farther, unless where they start is beyond it.
    fn plausible(&self, slot: usize) -> (f64, f64) {
        self.space().search_range(slot)
    }

    /// Whether a small change of the number in slot number `slot` deals the parts of a tree out anew:
    /// counts, what counts are computed from, angles that add up from part to part.
    ///
    /// Blends change such numbers together, in few steps, so that a tree stays itself in between.
    fn redeals(&self, slot: usize) -> bool {
        self.space().kind_of(slot).is_whole()
    }

    /// Changes `values` so that their tree grows `factor` times as large and nearly the same in all
    /// else; if that cannot be had within the allowed ranges, leaves them and returns false.
    ///
    /// Numbers in metres are sizes unless a generator says otherwise. Only nearly, since models have
    /// sizes of their own: Weber and Penn's stems are never thinner than a centimetre.
    fn resize(&self, values: &mut [f64], factor: f64) -> bool {
        let space = self.space();
        let sizes = || (0..space.len()).filter(|&slot| space.param_of(slot).unit == Unit::Meters);
        let fits = sizes().all(|slot| space.check_slot(slot, values[slot] * factor).is_ok());
        if fits {
            sizes().for_each(|slot| values[slot] *= factor);
        }
        fits
    }

    /// The slots whose numbers make trees of other seeds larger or smaller and show in no single
    /// tree, where a size can make up for them; none unless a generator says so.
    ///
    /// A search that has one tree's picture sets them to zero, within their allowed range.
    fn size_variations(&self, values: &[f64]) -> Vec<usize> {
        let _ = values;
        Vec::new()
    }

    /// The parts of a species file beside the numbers (solids, a grammar), as TOML lines that
    /// follow the parameters; empty if there are none.
    fn extra_toml(&self) -> String {
        String::new()
    }
}

/// A family of generators: reads species files that name it.
pub trait Family: Send + Sync + fmt::Debug {
    /// The name in `generator = "…"`.
    fn name(&self) -> &'static str;

    /// One line of what it grows.
    fn summary(&self) -> &'static str;

    /// The keys of its species files beside parameters and [what all files may
    /// say](crate::species::KEYS); none unless a family has some.
    fn keys(&self) -> &'static [Key] {
        &[]
    }

    /// Builds generator and checked numbers from a parsed species file.
    ///
    /// # Errors
    /// Every problem found, with line and column.
    fn read(&self, doc: &SpeciesDoc) -> Result<Species, SpeciesError>;

    /// The species that come with pleach: name and text of the file.
    fn presets(&self) -> &'static [(&'static str, &'static str)];
}
