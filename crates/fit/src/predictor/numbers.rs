//! The numbers of trees around one species, each as a sum over what is seen.

use super::basis::Basis;
use super::cloud::Cloud;
use super::examples::{Example, HEIGHT};
use super::packed::Packed;
use crate::posterior::{Columns, Interval, PosteriorNumber, Prior, Ridge, quantiles};
use crate::problem::Genome;
use crate::space::Gene;
use pleach_tree::{Slot, Species};
use serde::{Deserialize, Serialize};

/// A number of which a picture explains less of the variance than this stays that of the species.
const MIN_EXPLAINED: f64 = 0.05;

/// What was learnt about trees around one species.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Numbers {
    numbers: Vec<Number>,
    cloud: Cloud,
}

/// A number, as a part of its range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Number {
    slot: u32,
    low: f64,
    high: f64,
    /// Before a picture is seen: the ends and the middle of an interval that holds nine in ten.
    before: [f32; 3],
    /// By how much the variance is smaller since, each tree predicted by the others.
    explained: f32,
    /// Where a picture tells something of it.
    sum: Option<Sum>,
}

/// A number as a sum over what is seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Sum {
    constant: f32,
    weights: Packed,
    /// As [`Number::before`], of what is left when a tree is predicted by the others.
    left: [f32; 3],
}

impl Sum {
    fn at(&self, coordinates: &[f64]) -> f64 {
        let sum: f64 = self.weights.numbers().zip(coordinates).map(|(weight, at)| weight * at).sum();
        f64::from(self.constant) + sum
    }
}

impl Number {
    /// The gene in the range of the trees that were learnt from.
    fn own(&self, gene: &Gene) -> Gene {
        Gene { low: self.low, high: self.high, ..gene.clone() }
    }

    fn is_finite(&self, width: usize) -> bool {
        let Self { low, high, before, explained, sum, .. } = self;
        let is_sum = |sum: &Sum| {
            let Sum { constant, weights, left } = sum;
            let numbers = left.iter().chain([constant]);
            numbers.copied().all(f32::is_finite) && weights.is_finite() && weights.len() == width
        };
        let is_range = low.is_finite() && high.is_finite() && low < high;
        is_range && before.iter().chain([explained]).all(|x| x.is_finite()) && sum.iter().all(is_sum)
    }
}

impl Numbers {
    /// From trees of `prior`; nothing if there are none.
    pub(super) fn learn(prior: &Prior, basis: &Basis, examples: &[Example]) -> Self {
        let known = || examples.iter().map(|one| &one.genome);
        let genes: Vec<Gene> = prior.genes().map(|gene| gene.holding(known())).collect();
        let seen: Vec<Vec<f64>> = examples.iter().map(|one| basis.coordinates(&one.features)).collect();
        let units = |genome: &Genome| genes.iter().map(|gene| gene.to_unit(gene.get(genome))).collect();
        let units = Columns::from_rows(&known().map(units).collect::<Vec<_>>());
        let ridge = Ridge::learn(Columns::from_rows(&seen), &units);
        let packed = |numbers: Vec<f64>| quantiles(numbers).map(|number| number as f32);
        let number = |(place, gene): (usize, &Gene)| {
            let target = &ridge.targets[place];
            let sum = || {
                let (constant, weights) = ridge.sum(place, basis.directions.len());
                let left = packed(target.residuals.clone());
                Sum { constant: constant as f32, weights: Packed::new(&weights), left }
            };
            (gene.low < gene.high).then_some(Number {
                slot: u32::try_from(gene.slot()?.index()).ok()?,
                low: gene.low,
                high: gene.high,
                before: packed(units.columns[place].clone()),
                explained: target.explained as f32,
                sum: (target.explained >= MIN_EXPLAINED).then(sum),
            })
        };
        let numbers = genes.iter().enumerate().take(ridge.targets.len()).filter_map(number).collect();
        Self { numbers, cloud: Cloud::learn(&seen) }
    }

    /// Whether all numbers are finite sums over `width` coordinates, in a range.
    pub(super) fn are_sums_over(&self, width: usize) -> bool {
        self.numbers.iter().all(|number| number.is_finite(width)) && self.cloud.is_of(width)
    }

    /// The numbers that are known of `genes`.
    fn known<'a>(&self, genes: impl Iterator<Item = &'a Gene>) -> impl Iterator<Item = (&Number, Gene)> {
        genes.filter_map(|gene| {
            let slot = gene.slot().map(Slot::index);
            let number = self.numbers.iter().find(|number| Some(number.slot as usize) == slot)?;
            Some((number, number.own(gene)))
        })
    }

    /// `values` of a species with the numbers that follow from `coordinates`; `genes` are those of its prior.
    pub(super) fn predict<'a>(
        &self,
        values: &[f64],
        genes: impl Iterator<Item = &'a Gene>,
        coordinates: &[f64],
    ) -> Vec<f64> {
        let mut values = values.to_vec();
        for (number, own) in self.known(genes) {
            let Some(sum) = &number.sum else { continue };
            if let Some(value) = values.get_mut(number.slot as usize) {
                *value = own.from_unit(sum.at(coordinates).clamp(0.0, 1.0));
            }
        }
        values
    }

    /// The share of the trees that were learnt from whose pictures are at least as far from all others as one with
    /// these `coordinates`.
    pub(super) fn familiarity(&self, coordinates: &[f64]) -> f64 {
        self.cloud.share_as_far(coordinates)
    }

    /// See [`Cloud::log_density`].
    pub(super) fn log_density(&self, coordinates: &[f64]) -> f64 {
        self.cloud.log_density(coordinates)
    }

    /// What `coordinates` say of the numbers of a tree `height` metres high around `species`, whose prior is `prior`.
    pub(super) fn answer(
        &self,
        species: &Species,
        prior: &Prior,
        height: f64,
        coordinates: &[f64],
    ) -> Vec<PosteriorNumber> {
        // The trees that were learnt from are all of one height.
        let at_height = |slot: usize, value: f64| {
            let mut values = species.params.values().to_vec();
            values[slot] = value;
            species.generator.resize(&mut values, height / HEIGHT);
            values[slot]
        };
        let answer = |(number, own): (&Number, Gene)| {
            let slot = own.slot()?;
            let interval = |middle: f64, spread: [f32; 3]| {
                let end = |end: f32| {
                    let unit = (middle + f64::from(end)).clamp(0.0, 1.0);
                    at_height(slot.index(), own.from_unit(unit))
                };
                let [low, median, high] = spread.map(end);
                Interval { low, median, high }
            };
            let prior = interval(0.0, number.before);
            let posterior = number.sum.as_ref().map_or(prior, |sum| interval(sum.at(coordinates), sum.left));
            Some(PosteriorNumber { slot, prior, posterior, shrunk: f64::from(number.explained) })
        };
        // One that nine in ten trees have alike has no interval to speak of.
        let varies = |(number, _): &(&Number, Gene)| number.before[0] < number.before[2];
        self.known(prior.genes()).filter(varies).filter_map(answer).collect()
    }
}
