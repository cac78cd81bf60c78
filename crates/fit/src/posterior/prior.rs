//! Trees around a species, as nature would vary them.

use super::form::Form;
use crate::problem::{FitProblem, Genome, Nuisance};
use crate::run::FIT_LIMITS;
use crate::space::{Freedom, Gene, Place, SearchSpace, SpaceError, Stream, TreeSeed};
use pleach_tree::param::SlotError;
use pleach_tree::{GrowError, Growth, Species, Tree, Workspace};
use std::sync::{Arc, OnceLock};

/// Purpose of the draws of a prior, for [`Stream::at`].
const DRAWS: u32 = 0x7072;
/// Draws of one number beyond its range after which its end is taken.
const TRIES: usize = 16;

/// What is known of a tree before its picture is seen: it is one of those around a species.
///
/// Every free number is normal around that of the species, with a standard deviation of [`Prior::SPREAD`] of its
/// plausible range ([`pleach_tree::Param::plausible`]; by ratio where the number is searched by ratio) and cut off at the
/// ends of that range. A number whose sign is a switch keeps its sign, and a standard deviation of at most twice that
/// part of itself. Features that the species does not have stay absent; choices, numbers that are not used, and variations
/// of size that no single tree shows are those of the species too. Every seed of a tree is as likely as any other.
///
/// Numbers that are drawn each for itself may give a tree that nobody would take for one: of half of the aspens the
/// leaves are so small or so few that they look dead. So trees have the form of the species as well, as a person sees
/// it at first: at least a quarter and at most four times as many stems on each level, and as much area of leaves and
/// blossoms for their height, and half to twice the width for it. With a larger spread these bounds are wider in
/// proportion.
#[derive(Clone, Debug)]
pub struct Prior {
    species: Species,
    space: SearchSpace,
    spread: f64,
    /// Whether trees have the form of the species.
    keeps_form: bool,
    form: OnceLock<Option<Form>>,
}

/// Why a number of a [`Prior`] has no tree: of the reasons of its draws the last.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NoSample {
    /// The numbers do not belong together.
    #[error("none of {} draws is a tree, the last because {_0}", Prior::DRAWS)]
    Params(#[source] SlotError),
    /// The tree is too large for a search.
    #[error("none of {} draws grows, the last because {_0}", Prior::DRAWS)]
    Growth(#[source] GrowError),
}

impl Prior {
    /// Draws for one tree of [`Prior::try_sample`]: it is the first that has the form of the species, or of those that
    /// grow the one that is nearest to it.
    pub const DRAWS: u32 = 16;
    /// Default standard deviation of a number, as a part of its plausible range.
    pub const SPREAD: f64 = 0.15;
    /// Largest standard deviation that is accepted: nearly uniform.
    pub const MAX_SPREAD: f64 = 10.0;

    /// Trees around `species`, of which the numbers that `freedom` leaves free vary by `spread` of their plausible range:
    /// from 0, which NaN counts as, to [`Prior::MAX_SPREAD`].
    ///
    /// # Errors
    /// Patterns that `species` does not know, and values that are not allowed.
    pub fn new(species: &Species, freedom: &Freedom, spread: f64) -> Result<Self, SpaceError> {
        let generator = Arc::clone(&species.generator);
        let space = SearchSpace::new(generator, species.params.values(), freedom, TreeSeed::Any)?;
        Ok(Self::in_space(species, space, spread))
    }

    /// The same around the start of `problem`, and with all that its views leave unknown.
    ///
    /// # Errors
    /// As [`Prior::new`].
    pub fn from_problem(problem: &FitProblem, freedom: &Freedom, spread: f64) -> Result<Self, SpaceError> {
        let space = SearchSpace::from_problem(problem, freedom, TreeSeed::Any)?;
        let species = Species { foliage: problem.foliage, ..problem.start.clone() };
        Ok(Self::in_space(&species, space, spread))
    }

    fn in_space(species: &Species, space: SearchSpace, spread: f64) -> Self {
        let space = space.plausible(species.params.values()).settling(true);
        let spread = if spread.is_nan() { 0.0 } else { spread.clamp(0.0, Self::MAX_SPREAD) };
        Self { species: species.clone(), space, spread, keeps_form: true, form: OnceLock::new() }
    }

    /// The same, also of trees whose form is far from that of the species: each number is drawn for itself.
    #[must_use]
    pub fn of_any_form(self) -> Self {
        Self { keeps_form: false, ..self }
    }

    /// What the trees are around.
    pub(crate) const fn species(&self) -> &Species {
        &self.species
    }

    /// A tree that anyone could use: of [`Prior::DRAWS`] draws the first that grows within the limits of a search and
    /// has the form of the species, or the nearest to it; `None` if none grows. Each `number` has draws of its own.
    #[must_use]
    pub fn sample(&self, seed: u64, number: u32) -> Option<(Species, Tree)> {
        self.try_sample(seed, number).ok()
    }

    /// [`Prior::sample`] that says why there is no tree.
    ///
    /// # Errors
    /// What is wrong with the last of [`Prior::DRAWS`] draws, if none grows.
    pub fn try_sample(&self, seed: u64, number: u32) -> Result<(Species, Tree), NoSample> {
        let mut tree = Tree::default();
        let species = self.sample_into(seed, number, &mut Workspace::default(), &mut tree)?;
        Ok((species, tree))
    }

    /// [`Prior::try_sample`] into `tree`, for many trees in one memory.
    ///
    /// # Errors
    /// As [`Prior::try_sample`]; then `tree` holds nothing of use.
    pub fn sample_into(
        &self,
        seed: u64,
        number: u32,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<Species, NoSample> {
        self.choose(seed, number, workspace, tree).map(|(_, species)| species)
    }

    /// The numbers of [`Prior::sample_into`] with what the views leave unknown.
    ///
    /// # Errors
    /// As [`Prior::sample_into`].
    pub fn genome_into(
        &self,
        seed: u64,
        number: u32,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<Genome, NoSample> {
        self.choose(seed, number, workspace, tree).map(|(genome, _)| genome)
    }

    fn choose(
        &self,
        seed: u64,
        number: u32,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(Genome, Species), NoSample> {
        let first = u64::from(number) * u64::from(Self::DRAWS);
        let bound = (self.spread / Self::SPREAD).max(1.0);
        let (mut nearest, mut failure) = (None, None);
        for draw in first..first + u64::from(Self::DRAWS) {
            match self.grow(seed, draw, workspace, tree) {
                Ok(grown) => {
                    let distance = self.distance(tree);
                    if distance <= bound {
                        return Ok(grown);
                    }
                    if nearest.is_none_or(|(least, _)| distance < least) {
                        nearest = Some((distance, draw));
                    }
                }
                Err(reason) => failure = Some(reason),
            }
        }
        match nearest {
            Some((_, draw)) => self.grow(seed, draw, workspace, tree),
            None => Err(failure.expect("a draw grows or it does not")),
        }
    }

    /// How far the form of `tree` is from that of the species.
    fn distance(&self, tree: &Tree) -> f64 {
        if !self.keeps_form {
            return 0.0;
        }
        let growth = Growth { limits: FIT_LIMITS, foliage: self.species.foliage, ..Growth::default() };
        let own = self.form.get_or_init(|| Form::of_species(&self.species, &growth));
        match (own, Form::new(tree)) {
            (Some(own), Some(form)) => own.distance(&form),
            (Some(_), None) => f64::INFINITY,
            (None, _) => 0.0,
        }
    }

    fn grow(
        &self,
        seed: u64,
        draw: u64,
        workspace: &mut Workspace,
        tree: &mut Tree,
    ) -> Result<(Genome, Species), NoSample> {
        let genome = self.draw(seed, draw);
        let params = self.species.params.space().check(genome.values.clone()).map_err(NoSample::Params)?;
        let species = Species { params, tree_seed: Some(genome.tree_seed), ..self.species.clone() };
        let growth = Growth {
            limits: FIT_LIMITS,
            foliage: species.foliage,
            counts_ahead: true,
            ..Growth::seed(genome.tree_seed)
        };
        species.generator.grow(&species.params, &growth, workspace, tree).map_err(NoSample::Growth)?;
        Ok((genome, species))
    }

    /// Draw `number` of the numbers with this `seed`, whatever their tree is like.
    #[must_use]
    pub fn draw(&self, seed: u64, number: u64) -> Genome {
        let mut stream = Stream::at(seed, DRAWS, number, 0);
        let base = self.space.base();
        let mut genome = self.space.individual(base, SearchSpace::random_seed(&mut stream));
        for gene in self.space.genes() {
            let value = match gene.place {
                Place::Nuisance { nuisance: Nuisance::Azimuth, .. } => gene.random(&mut stream),
                // Whatever a number is, it takes draws of its own, so that those of others do not depend on it.
                _ => self.near(gene, gene.get(&genome), &mut stream),
            };
            if self.varies(gene) {
                gene.set(&mut genome, value);
            }
        }
        self.space.settle(&mut genome);
        genome
    }

    /// A draw around `center`.
    fn near(&self, gene: &Gene, center: f64, stream: &mut Stream) -> f64 {
        let ([mut low, mut high], mut spread) = ([0.0, 1.0], self.spread);
        let unit = gene.to_unit(center);
        if gene.can_flip() {
            let zero = gene.to_unit(0.0);
            spread = (2.0 * (unit - zero).abs()).min(1.0) * self.spread;
            if center > 0.0 { low = zero } else { high = zero }
        }
        let draws: [f64; TRIES] = std::array::from_fn(|_| unit + spread * stream.normal());
        let last = draws[TRIES - 1].clamp(low, high);
        let drawn =
            gene.from_unit(draws.into_iter().find(|draw| (low..=high).contains(draw)).unwrap_or(last));
        // A whole number that is rounded to 0 has no sign any more.
        if gene.can_flip() && drawn == 0.0 && center != 0.0 { gene.clamp(center.signum()) } else { drawn }
    }

    fn varies(&self, gene: &Gene) -> bool {
        let base = self.space.base();
        let value = gene.slot().map(|slot| base[slot.index()]);
        let is_absent = value.is_some() && gene.neutral() == value;
        !gene.is_choice() && !is_absent && self.space.is_active(base, gene)
    }

    /// The numbers of parameters that vary, in the order of their slots.
    pub fn genes(&self) -> impl Iterator<Item = &Gene> {
        let hidden = self.space.hidden_jitters(self.space.base());
        let is_seen = move |gene: &&Gene| gene.slot().is_some_and(|slot| !hidden.contains(&slot));
        self.space.genes().iter().filter(|gene| self.varies(gene)).filter(is_seen)
    }

    /// Whether trees can be brought to the height of a picture.
    pub(super) fn sizes_are_free(&self) -> bool {
        self.space.sizes_are_free()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn prior(name: &str, spread: f64) -> (Species, Prior) {
        let species = pleach_generators::preset(name).unwrap();
        let prior = Prior::new(&species, &Freedom::default(), spread).unwrap();
        (species, prior)
    }

    #[test]
    fn numbers_are_normal_around_the_species_within_plausible_ranges() {
        let (species, prior) = prior("quaking_aspen", Prior::SPREAD);
        let draws: Vec<Genome> = (0..2000).map(|number| prior.draw(1, number)).collect();
        let name = |gene: &Gene| species.params.space().slot_name(gene.slot().unwrap());
        for gene in prior.genes() {
            let units: Vec<f64> = draws.iter().map(|genome| gene.to_unit(gene.get(genome))).collect();
            assert!(units.iter().all(|unit| (-1e-9..=1.0 + 1e-9).contains(unit)), "{}", name(gene));
        }
        let ratio = prior.genes().find(|gene| name(gene) == "ratio").unwrap();
        let units: Vec<f64> = draws.iter().map(|genome| ratio.to_unit(ratio.get(genome))).collect();
        let mean = units.iter().sum::<f64>() / units.len() as f64;
        let deviation = (units.iter().map(|u| (u - mean).powi(2)).sum::<f64>() / units.len() as f64).sqrt();
        assert!((0.1..=0.152).contains(&deviation), "cut off at one end: {deviation}");
        let again = prior.draw(1, 7);
        assert_eq!((&again.values, again.tree_seed), (&draws[7].values, draws[7].tree_seed));
        assert_ne!(prior.draw(2, 7).values, draws[7].values);
        // An aspen has leaves and one leader.
        let of = |name: &str| species.params.space().select(name).unwrap()[0].index();
        assert!(draws.iter().all(|genome| genome.values[of("leaf_blos_num")] > 0.0));
        assert!(draws.iter().all(|genome| genome.values[of("seg_splits")] == 0.0));
    }

    #[test]
    fn trees_have_the_form_of_their_species() {
        let mut odd = 0;
        for name in ["palm", "quaking_aspen", "small_pine"] {
            let (_, prior) = prior(name, Prior::SPREAD);
            for number in 0..12 {
                let (species, tree) = prior.try_sample(900, number).unwrap();
                assert!(prior.distance(&tree) <= 1.0, "{name} {number}");
                assert!(!tree.leaves.is_empty(), "{name} {number}");
                let (mut memory, mut again) = (Workspace::default(), Tree::default());
                let genome = prior.genome_into(900, number, &mut memory, &mut again).unwrap();
                assert_eq!((&genome.values[..], &again), (species.params.values(), &tree));
                // The same numbers whatever the form, if the first draw has it.
                let (_, any) = prior.clone().of_any_form().try_sample(900, number).unwrap();
                odd += u32::from(prior.distance(&any) > 1.0);
            }
        }
        assert!((12..30).contains(&odd), "{odd} of 36 draws");
    }

    #[test]
    fn where_no_draw_has_the_form_it_is_the_nearest() {
        // Bounds are wider with the spread, but not as wide as numbers that are nearly uniform.
        let (_, prior) = prior("quaking_aspen", 1.0);
        for number in 0..4 {
            let (_, tree) = prior.try_sample(1, number).unwrap();
            let mut all = Vec::new();
            for draw in 0..u64::from(Prior::DRAWS) {
                let (mut memory, mut one) = (Workspace::default(), Tree::default());
                let draw = u64::from(number) * u64::from(Prior::DRAWS) + draw;
                if prior.grow(1, draw, &mut memory, &mut one).is_ok() {
                    all.push(prior.distance(&one));
                }
            }
            let within = all.iter().find(|distance| **distance <= 1.0 / 0.15);
            let nearest = all.iter().copied().fold(f64::INFINITY, f64::min);
            assert_eq!(prior.distance(&tree), *within.unwrap_or(&nearest));
        }
    }

    #[test]
    fn without_a_spread_it_is_the_species_and_what_is_fixed_stays() {
        let (species, prior) = prior("quaking_aspen", 0.0);
        assert_eq!(prior.draw(1, 5).values, prior.draw(9, 1).values);
        let slot = species.params.space().select("ratio").unwrap()[0];
        assert!(
            (prior.draw(1, 5).values[slot.index()] - species.params.values()[slot.index()]).abs() < 1e-12
        );
        let freedom = Freedom { fix: vec!["ratio".to_owned()], ..Freedom::default() };
        let fixed = Prior::new(&species, &freedom, 1.0).unwrap();
        assert!(fixed.genes().all(|gene| gene.slot() != Some(slot)));
        let value = species.params.values()[slot.index()];
        assert!((0..20).all(|number| fixed.draw(1, number).values[slot.index()] == value));
    }
}
