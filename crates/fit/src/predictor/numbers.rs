//! The numbers of trees around one species, each as a sum over what is seen.

use super::basis::Basis;
use super::examples::Example;
use super::packed::Packed;
use crate::posterior::{Columns, Prior, Ridge};
use crate::problem::Genome;
use crate::space::Gene;
use pleach_tree::Slot;
use serde::{Deserialize, Serialize};

/// A number of which a picture explains less of the variance than this stays that of the species.
const MIN_EXPLAINED: f64 = 0.05;

/// What was learnt about trees around one species.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Numbers(Vec<Number>);

/// A number, as a part of its range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Number {
    slot: u32,
    low: f64,
    high: f64,
    constant: f32,
    weights: Packed,
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
        let number = |(place, gene): (usize, &Gene)| {
            let (constant, weights) = ridge.sum(place, basis.directions.len());
            let slot = u32::try_from(gene.slot()?.index()).ok()?;
            let (constant, weights) = (constant as f32, Packed::new(&weights));
            (ridge.targets[place].explained >= MIN_EXPLAINED).then_some(Number {
                slot,
                low: gene.low,
                high: gene.high,
                constant,
                weights,
            })
        };
        Self(genes.iter().enumerate().take(ridge.targets.len()).filter_map(number).collect())
    }

    /// Whether all numbers are finite sums over `width` coordinates, in a range.
    pub(super) fn are_sums_over(&self, width: usize) -> bool {
        self.0.iter().all(|Number { low, high, constant, weights, .. }| {
            let is_finite =
                low.is_finite() && high.is_finite() && constant.is_finite() && weights.is_finite();
            is_finite && low < high && weights.len() == width
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
        for gene in genes {
            let slot = gene.slot().map(Slot::index);
            let Some(number) = self.0.iter().find(|number| Some(number.slot as usize) == slot) else {
                continue;
            };
            let sum: f64 = number.weights.numbers().zip(coordinates).map(|(weight, at)| weight * at).sum();
            let unit = (f64::from(number.constant) + sum).clamp(0.0, 1.0);
            let own = Gene { low: number.low, high: number.high, ..gene.clone() };
            if let Some(value) = values.get_mut(number.slot as usize) {
                *value = own.from_unit(unit);
            }
        }
        values
    }
}
