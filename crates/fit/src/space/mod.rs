//! Which numbers a search may change, and how far.

mod freedom;
mod gene;
mod prior;
mod stream;
mod unknown;

use freedom::free_slots;
pub(crate) use freedom::may_change;
pub use freedom::{Freedom, SpaceError, TreeSeed, check_freedom};
pub use gene::{Gene, Place};
pub use prior::PRIOR;
use prior::Prior;
pub use stream::Stream;

use crate::problem::FitProblem;
use crate::problem::Genome;
use pleach_tree::{Generator, ParamSpace, Slot, Variation};
use std::sync::Arc;

/// Directions in which a list is tried if an azimuth is not known.
const DIRECTIONS: usize = 8;

/// The free numbers of a problem, and the values of all others.
#[derive(Clone, Debug)]
pub struct SearchSpace {
    params: Arc<ParamSpace>,
    generator: Option<Arc<dyn Generator>>,
    genes: Vec<Gene>,
    base: Vec<f64>,
    /// Default values of nuisances.
    usual: Vec<f64>,
    tree_seed: TreeSeed,
    settles: bool,
    /// The prior around the start, if there is one.
    prior: Option<Prior>,
    /// Cost of a word of a structure, where structures are searched.
    price: f64,
}

impl SearchSpace {
    /// Number of bits of a random tree seed.
    const SEED_BITS: u32 = 31;

    /// The free slots of `generator`; all others keep the values of `base`. Without patterns, slots of parameters that
    /// are [opt-in](pleach_tree::Param::opt_in) are free where `base` has other values than the defaults.
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

    /// The free slots of a problem's generator, and the unknowns of its goals' views.
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
        let mut is_free = free_slots(&params, freedom)?;
        if freedom.free.is_empty() {
            params.slots().for_each(|slot| is_free[slot.index()] &= !params.is_left_alone(base, slot));
        }
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
            // After the slots, so that nuisances do not change the draws of a search without them.
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

    /// Adds a prior of this weight around the nearest of `lists`: see [`SearchSpace::prior_cost`].
    #[must_use]
    pub fn with_prior(mut self, lists: &[Vec<f64>], weight: f64) -> Self {
        self.prior = (weight > 0.0 && !lists.is_empty()).then(|| Prior { lists: lists.to_vec(), weight });
        self
    }

    /// The cost that the search adds to that of `genome`: for its distance from the start and for the length of its
    /// structure. 0 without [`SearchSpace::with_prior`] and [`SearchSpace::priced`].
    #[must_use]
    pub fn prior_cost(&self, genome: &Genome) -> f64 {
        let length = |structure: &String| self.variation().map_or(0, |v| v.length(structure)) as f64;
        let price = genome.structure.as_ref().map_or(0.0, |structure| self.price * length(structure));
        price + self.prior.as_ref().map_or(0.0, |prior| prior.cost(&self.genes, &genome.values))
    }

    /// Adds a cost of `price` per word of a structure.
    #[must_use]
    pub fn priced(self, price: f64) -> Self {
        Self { price, ..self }
    }

    /// The variation of structures; `None` if they cannot be changed.
    #[must_use]
    pub fn variation(&self) -> Option<&dyn Variation> {
        self.generator.as_ref()?.variation()
    }

    /// Whether the structure of `genome`, if it has one of its own, can be read: one from a file may be anything.
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

    /// The values of slots that are not free.
    #[must_use]
    pub fn base(&self) -> &[f64] {
        &self.base
    }

    /// Which tree is grown.
    #[must_use]
    pub const fn tree_seed(&self) -> TreeSeed {
        self.tree_seed
    }

    /// The individual with these values where slots are free and the base's elsewhere, and the tree seed of the
    /// problem (`seed` where it is free); nuisances have their defaults.
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

    /// Sets the free variations of size in `genome` to zero: no single tree shows them.
    ///
    /// The first good tree of a search is at one end of such a variation, and trees of other seeds would be larger or
    /// smaller than the goal for no reason.
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

    /// A random parameter list: every free number is drawn by [`Gene::random`].
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

    /// Sets the unknown azimuths of `genome`: the first to the `part`-th of [`SearchSpace::directions`] in its range,
    /// the others anywhere in theirs.
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
    fn what_is_opt_in_is_searched_where_the_start_has_it() {
        let list = pleach_tree::Param::list("b", "height", pleach_tree::Kind::real(0.0, 9.0), [1.0, 1.0]);
        let space = params(vec![real("a", 0.0, 1.0), list.search([(0.5, 2.0)]).opt_in()]);
        let names = |f: &Freedom, base: &[f64]| -> Vec<usize> {
            let space = SearchSpace::from_params(space.clone(), base, f, TreeSeed::Fixed(1)).unwrap();
            space.genes().iter().filter_map(Gene::slot).map(Slot::index).collect()
        };
        let all = Freedom::default();
        assert_eq!(names(&all, &[0.5, 1.0, 1.0]), [0]);
        assert_eq!(names(&all, &[0.5, 1.0, 1.5]), [0, 1, 2], "all of its numbers");
        assert_eq!(names(&freedom(&["b"], &[]), &[0.5, 1.0, 1.0]), [1, 2], "by name");
        assert_eq!(names(&freedom(&[], &["b"]), &[0.5, 1.0, 1.5]), [0]);
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
