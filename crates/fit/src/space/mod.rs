//! Which numbers a search may change, and how far.

mod gene;
mod prior;
mod unknown;

pub use gene::{Gene, Place};
pub use prior::PRIOR;
use prior::Prior;

use crate::genome::Genome;
use crate::problem::FitProblem;
use crate::stream::Stream;
use pleach_tree::param::Problem;
use pleach_tree::{Generator, ParamSpace, Slot, Variation};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Which slots are free, by the patterns of [`ParamSpace::select`]: a slot (`length[1]`), a
/// parameter (`length`), a group (`leaves`), or `level:N`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Freedom {
    /// Only these are free; all are if the list is empty.
    pub free: Vec<String>,
    /// These keep the value of the start, whatever `free` says.
    pub fix: Vec<String>,
}

/// Which tree is grown from the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TreeSeed {
    /// The same for every individual, as in the dissertation (§3.3.2).
    Fixed(u64),
    /// Part of the genome: searched like the parameters.
    Any,
}

/// Why there is nothing to search in.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SpaceError {
    /// A pattern that names no parameter.
    #[error("`{pattern}` {problem}")]
    Pattern {
        /// As it was given.
        pattern: String,
        /// What is wrong with it.
        problem: Problem,
    },
    /// Every slot is fixed, and the tree's seed too.
    #[error("no parameter is free: nothing to search")]
    NothingFree,
    /// A start whose values do not belong to this generator.
    #[error("start values: {0}")]
    Start(#[from] pleach_tree::param::SlotError),
}

/// Directions in which a list is tried if an azimuth is not known.
const DIRECTIONS: usize = 8;

/// The free numbers of a problem, and the values of all others.
#[derive(Clone, Debug)]
pub struct SearchSpace {
    params: Arc<ParamSpace>,
    generator: Option<Arc<dyn Generator>>,
    genes: Vec<Gene>,
    base: Vec<f64>,
    /// What nuisances are where nothing is said.
    usual: Vec<f64>,
    tree_seed: TreeSeed,
    settles: bool,
    /// What draws numbers to where the search starts, if anything does.
    prior: Option<Prior>,
    /// What a word of a structure costs, where structures are searched.
    price: f64,
}

/// Tells whether every pattern of `freedom` names parameters of `params`, and something is left to
/// search.
///
/// # Errors
/// The first pattern that names none, or [`SpaceError::NothingFree`]: what [`crate::fit`] would say
/// after a first guess.
pub fn check_freedom(params: &ParamSpace, freedom: &Freedom, tree_seed: TreeSeed) -> Result<(), SpaceError> {
    let is_any_free = free_slots(params, freedom)?.contains(&true);
    if is_any_free || tree_seed == TreeSeed::Any { Ok(()) } else { Err(SpaceError::NothingFree) }
}

/// For each slot whether it is free.
fn free_slots(params: &ParamSpace, freedom: &Freedom) -> Result<Vec<bool>, SpaceError> {
    let mut is_free = vec![freedom.free.is_empty(); params.len()];
    for (patterns, value) in [(&freedom.free, true), (&freedom.fix, false)] {
        for pattern in patterns {
            let slots = params
                .select(pattern)
                .map_err(|problem| SpaceError::Pattern { pattern: pattern.clone(), problem })?;
            for slot in slots {
                is_free[slot.index()] = value;
            }
        }
    }
    Ok(is_free)
}

impl SearchSpace {
    /// Lanes of [`Stream::at`] up to this number are left to optimisers.
    const SEED_BITS: u32 = 31;

    /// The free slots of `generator`; all others keep the values of `base`.
    ///
    /// Ranges are those of [`ParamSpace::search_range`], widened to hold `base`.
    ///
    /// # Errors
    /// Unknown patterns, nothing free, or values in `base` that are not allowed.
    pub fn new(
        generator: Arc<dyn Generator>,
        base: &[f64],
        freedom: &Freedom,
        tree_seed: TreeSeed,
    ) -> Result<Self, SpaceError> {
        let mut space = Self::from_params(Arc::clone(generator.space()), base, freedom, tree_seed)?;
        space.generator = Some(generator);
        Ok(space)
    }

    /// The free slots of a problem's generator, and what is not known of its goals' views.
    ///
    /// # Errors
    /// As [`SearchSpace::new`].
    pub fn from_problem(
        problem: &FitProblem,
        freedom: &Freedom,
        tree_seed: TreeSeed,
    ) -> Result<Self, SpaceError> {
        let start = &problem.start;
        let params = start.generator.space().clone();
        let unknown = unknown::genes(&problem.goals);
        let mut space = Self::build(params, start.params.values(), freedom, tree_seed, unknown)?;
        space.generator = Some(Arc::clone(&start.generator));
        Ok(space)
    }

    /// The same without a generator: every slot counts as active. For tests on known functions.
    ///
    /// # Errors
    /// As [`SearchSpace::new`].
    pub fn from_params(
        params: Arc<ParamSpace>,
        base: &[f64],
        freedom: &Freedom,
        tree_seed: TreeSeed,
    ) -> Result<Self, SpaceError> {
        Self::build(params, base, freedom, tree_seed, (Vec::new(), Vec::new()))
    }

    fn build(
        params: Arc<ParamSpace>,
        base: &[f64],
        freedom: &Freedom,
        tree_seed: TreeSeed,
        (nuisances, usual): (Vec<Gene>, Vec<f64>),
    ) -> Result<Self, SpaceError> {
        params.check_all(base)?;
        let is_free = free_slots(&params, freedom)?;
        let genes: Vec<Gene> = params
            .slots()
            .filter(|slot| is_free[slot.index()])
            .map(|slot| {
                let ((low, high), start) = (params.search_range(slot), base[slot.index()]);
                let param = params.param_of(slot);
                Gene {
                    place: Place::Slot(slot),
                    kind: param.kind.clone(),
                    scale: params.scale_of(slot),
                    neutral: param.neutral,
                    low: low.min(start),
                    high: high.max(start),
                }
            })
            .filter(|gene| !gene.is_constant())
            // After the slots, so that without nuisances no draw of a search is another.
            .chain(nuisances)
            .collect();
        if genes.is_empty() && tree_seed != TreeSeed::Any {
            return Err(SpaceError::NothingFree);
        }
        Ok(Self {
            params,
            generator: None,
            genes,
            base: base.to_vec(),
            usual,
            tree_seed,
            settles: false,
            prior: None,
            price: 0.0,
        })
    }

    /// Widens the ranges to hold `values`, one per slot: another start.
    ///
    /// # Errors
    /// Values that are not allowed.
    pub fn widen(&mut self, values: &[f64]) -> Result<(), SpaceError> {
        self.params.check_all(values)?;
        for gene in &mut self.genes {
            if let Some(slot) = gene.slot() {
                gene.low = gene.low.min(values[slot.index()]);
                gene.high = gene.high.max(values[slot.index()]);
            }
        }
        Ok(())
    }

    /// Narrows the ranges to what is [plausible](pleach_tree::Param::plausible), unless `start`, one value per slot,
    /// has more or less.
    #[must_use]
    pub fn plausible(mut self, start: &[f64]) -> Self {
        for gene in &mut self.genes {
            if let Some(slot) = gene.slot() {
                let ((low, high), start) = (self.params.plausible_range(slot), start[slot.index()]);
                gene.low = gene.low.max(low.min(start));
                gene.high = gene.high.min(high.max(start));
            }
        }
        self.genes.retain(|gene| !gene.is_constant());
        self
    }

    /// Has the search draw numbers to the nearest of `lists`: see [`SearchSpace::prior_cost`].
    #[must_use]
    pub fn drawn_to(mut self, lists: &[Vec<f64>], weight: f64) -> Self {
        self.prior = (weight > 0.0 && !lists.is_empty()).then(|| Prior { lists: lists.to_vec(), weight });
        self
    }

    /// What the search adds to the cost of `genome` for being unlike what it started from and for the length of
    /// its structure: 0 unless [`SearchSpace::drawn_to`] or [`SearchSpace::priced`] have said otherwise.
    #[must_use]
    pub fn prior_cost(&self, genome: &Genome) -> f64 {
        let length = |structure: &String| self.variation().map_or(0, |v| v.length(structure)) as f64;
        let price = genome.structure.as_ref().map_or(0.0, |structure| self.price * length(structure));
        price + self.prior.as_ref().map_or(0.0, |prior| prior.of(&self.genes, &genome.values))
    }

    /// Has every word of a structure cost `price`.
    #[must_use]
    pub fn priced(self, price: f64) -> Self {
        Self { price, ..self }
    }

    /// How structures are changed; none if they cannot be.
    #[must_use]
    pub fn variation(&self) -> Option<&dyn Variation> {
        self.generator.as_ref()?.variation()
    }

    /// Whether the structure of `genome`, if it has one of its own, can be read: what comes from a file
    /// may be anything.
    pub(crate) fn has_structure(&self, genome: &Genome) -> bool {
        let is_one = |structure: &String| {
            let generator = self.variation().and_then(|v| v.generator(structure));
            generator.is_some_and(|generator| *generator.space() == self.params)
        };
        genome.structure.as_ref().is_none_or(is_one)
    }

    /// The free numbers: slots in order, then nuisances.
    #[must_use]
    pub fn genes(&self) -> &[Gene] {
        &self.genes
    }

    /// All parameters, free or not.
    #[must_use]
    pub const fn params(&self) -> &Arc<ParamSpace> {
        &self.params
    }

    /// The values that slots have which are not free.
    #[must_use]
    pub fn base(&self) -> &[f64] {
        &self.base
    }

    /// Which tree is grown.
    #[must_use]
    pub const fn tree_seed(&self) -> TreeSeed {
        self.tree_seed
    }

    /// The individual with these values where slots are free and the base's elsewhere, and the tree
    /// seed of the problem (`seed` where any will do); nuisances are what is usual.
    #[must_use]
    pub fn individual(&self, values: &[f64], seed: u64) -> Genome {
        let mut genome = Genome { nuisances: self.usual.clone(), ..Genome::new(self.base.clone(), seed) };
        for gene in &self.genes {
            if let Some(slot) = gene.slot() {
                genome.values[slot.index()] = gene.clamp(values[slot.index()]);
            }
        }
        if let TreeSeed::Fixed(seed) = self.tree_seed {
            genome.tree_seed = seed;
        }
        genome
    }

    /// Whether there are sizes and all of them are free, so that individuals may be resized.
    #[must_use]
    pub fn sizes_are_free(&self) -> bool {
        let is_free = |slot| self.genes.iter().any(|gene| gene.slot() == Some(slot));
        let mut sizes = self.params.sizes().peekable();
        sizes.peek().is_some() && sizes.all(is_free)
    }

    /// Makes the tree of `genome` larger by `factor`, as [`Generator::resize`] does.
    pub fn resize(&self, genome: &mut Genome, factor: f64) {
        if let (true, Some(generator)) = (factor != 1.0, &self.generator) {
            generator.resize(&mut genome.values, factor);
        }
    }

    /// Whether [`SearchSpace::settle`] does anything.
    #[must_use]
    pub fn settling(self, settles: bool) -> Self {
        Self { settles, ..self }
    }

    /// Takes from `genome` the variations of size that no single tree shows, where they are free.
    ///
    /// The first tree that a search likes stands at one end of such a variation or the other, and
    /// trees of other seeds would be larger or smaller than the goal without anyone having asked.
    pub fn settle(&self, genome: &mut Genome) {
        for slot in self.hidden_jitters(&genome.values) {
            genome.values[slot.index()] = 0.0;
        }
    }

    /// The slots that [`SearchSpace::settle`] sets to zero in an individual with these values.
    pub(crate) fn hidden_jitters(&self, values: &[f64]) -> Vec<Slot> {
        let generator = self.generator.as_ref().filter(|_| self.settles);
        if generator.is_none_or(|generator| generator.shows_size_jitter(values)) {
            return Vec::new();
        }
        let may_go =
            |slot: &Slot| self.genes.iter().any(|gene| gene.slot() == Some(*slot) && gene.clamp(0.0) == 0.0);
        self.params.size_jitters().filter(may_go).collect()
    }

    /// A random parameter list: every free number drawn as [`Gene::random`] says.
    #[must_use]
    pub fn random(&self, stream: &mut Stream) -> Genome {
        let mut genome = self.individual(&self.base, 0);
        for gene in &self.genes {
            let value = gene.random(stream);
            gene.set(&mut genome, value);
        }
        if self.tree_seed == TreeSeed::Any {
            genome.tree_seed = Self::random_seed(stream);
        }
        genome
    }

    /// In how many directions each list of a start is tried: one if all azimuths are known.
    pub(crate) fn directions(&self) -> usize {
        if self.genes.iter().any(Gene::is_azimuth) { DIRECTIONS } else { 1 }
    }

    /// Turns the pictures of `genome` whose azimuth is not known: the first of them to the `part`-th of
    /// [`SearchSpace::directions`] in its range, the others anywhere in theirs.
    pub(crate) fn turn(&self, genome: &mut Genome, part: usize, stream: &mut Stream) {
        for (i, gene) in self.genes.iter().filter(|gene| gene.is_azimuth()).enumerate() {
            let unit = stream.unit();
            let unit = if i == 0 { (part as f64 + unit) / DIRECTIONS as f64 } else { unit };
            gene.set(genome, gene.from_unit(unit));
        }
    }

    /// A tree's seed, short enough to be typed.
    #[must_use]
    pub fn random_seed(stream: &mut Stream) -> u64 {
        stream.bits() >> (64 - Self::SEED_BITS)
    }

    /// Whether the value of `gene` can change the tree of `values`: see [`Generator::is_active`].
    #[must_use]
    pub fn is_active(&self, values: &[f64], gene: &Gene) -> bool {
        match (&self.generator, gene.slot()) {
            (Some(generator), Some(slot)) => generator.is_active(values, slot),
            _ => true,
        }
    }

    /// Collects the numbers (in [`SearchSpace::genes`]) of the genes that are active with `values`.
    pub fn active_genes(&self, values: &[f64], into: &mut Vec<usize>) {
        into.clear();
        into.extend((0..self.genes.len()).filter(|&g| self.is_active(values, &self.genes[g])));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{integer, params, real};

    fn freedom(free: &[&str], fix: &[&str]) -> Freedom {
        let strings = |list: &[&str]| list.iter().map(|s| (*s).to_owned()).collect();
        Freedom { free: strings(free), fix: strings(fix) }
    }

    #[test]
    fn patterns_are_checked_before_anything_else() {
        let params = params(vec![real("a", 0.0, 1.0), real("b", 0.0, 1.0)]);
        let check = |free: &[&str], fix: &[&str], seed| check_freedom(&params, &freedom(free, fix), seed);
        assert_eq!(check(&["a"], &["b"], TreeSeed::Fixed(1)), Ok(()));
        assert!(
            matches!(check(&["aa"], &[], TreeSeed::Any), Err(SpaceError::Pattern { pattern, .. }) if pattern == "aa")
        );
        assert!(matches!(check(&[], &["c"], TreeSeed::Fixed(1)), Err(SpaceError::Pattern { .. })));
        assert_eq!(check(&["a"], &["a"], TreeSeed::Fixed(1)), Err(SpaceError::NothingFree));
        assert_eq!(check(&["a"], &["a"], TreeSeed::Any), Ok(()));
    }

    #[test]
    fn patterns_choose_and_starts_widen() {
        let space = params(vec![real("a", 0.0, 1.0), real("b", 0.0, 1.0), integer("n", 1, 9)]);
        let build =
            |f: Freedom, base: &[f64]| SearchSpace::from_params(space.clone(), base, &f, TreeSeed::Fixed(1));
        let names = |s: &SearchSpace| -> Vec<usize> {
            s.genes().iter().filter_map(Gene::slot).map(Slot::index).collect()
        };
        let base = [0.5, 0.5, 3.0];
        assert_eq!(names(&build(Freedom::default(), &base).unwrap()), [0, 1, 2]);
        assert_eq!(names(&build(freedom(&["a", "n"], &[]), &base).unwrap()), [0, 2]);
        assert_eq!(names(&build(freedom(&[], &["a"]), &base).unwrap()), [1, 2]);
        assert_eq!(build(freedom(&["a"], &["a"]), &base).unwrap_err(), SpaceError::NothingFree);
        assert!(matches!(
            build(freedom(&["nope"], &[]), &base).unwrap_err(),
            SpaceError::Pattern { pattern, .. } if pattern == "nope"
        ));
        // The test parameters allow ten times what they search.
        let wide = build(Freedom::default(), &[7.0, 0.5, 3.0]).unwrap();
        assert_eq!((wide.genes()[0].low, wide.genes()[0].high), (0.0, 7.0));
        assert!(matches!(build(Freedom::default(), &[f64::NAN, 0.5, 3.0]), Err(SpaceError::Start(_))));
    }

    #[test]
    fn random_individuals_are_allowed_and_keep_what_is_fixed() {
        let space = params(vec![real("a", 0.0, 1.0), real("b", 0.0, 1.0), integer("n", 1, 9)]);
        let fixed = freedom(&[], &["b"]);
        let space = SearchSpace::from_params(space, &[0.5, 0.25, 3.0], &fixed, TreeSeed::Any).unwrap();
        let mut seeds = Vec::new();
        for member in 0..100 {
            let genome = space.random(&mut Stream::at(1, 0, 0, member));
            space.params().check_all(&genome.values).unwrap();
            assert_eq!(genome.values[1], 0.25);
            seeds.push(genome.tree_seed);
        }
        seeds.sort_unstable();
        seeds.dedup();
        assert_eq!(seeds.len(), 100);
    }
}
