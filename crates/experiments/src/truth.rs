//! Trees around the known species, whose numbers no library has, and how near numbers are to theirs.

use anyhow::Context;
use pleach_fit::{Freedom, Gene, Genome, Prior};
use pleach_tree::{Species, Tree};

/// The seed of the trees: not that of the trees that predictors are learnt from.
const TREES: u64 = 777;

/// A tree around a species.
#[derive(Clone, Debug)]
pub(super) struct Truth {
    prior: Prior,
    /// Its numbers, with its seed.
    pub(super) species: Species,
    pub(super) seed: u64,
}

impl Truth {
    /// Number `number` of the trees around `species`, and the tree.
    pub(super) fn new(species: &Species, number: u32) -> anyhow::Result<(Self, Tree)> {
        let prior = Prior::new(species, &Freedom::default(), Prior::SPREAD)?.of_any_form();
        let (species, tree) = prior.sample(TREES, number).context("no tree around the species grows")?;
        let seed = species.tree_seed.context("samples have seeds")?;
        Ok((Self { prior, species, seed }, tree))
    }

    /// How far the numbers of `found` are from the truth's, in standard deviations of the prior: the root mean square
    /// over the numbers that vary in it. `None` of a species that other rules grow.
    pub(super) fn numbers_off(&self, found: &Species) -> Option<f64> {
        if found.generator.model() != self.species.generator.model() {
            return None;
        }
        let [own, found] = [&self.species, found].map(|one| Genome::new(one.params.values().to_vec(), 0));
        let off = |gene: &Gene| {
            let apart = (gene.to_unit(gene.get(&found)) - gene.to_unit(gene.get(&own))).abs();
            // Once around is where it began.
            if gene.is_periodic() { apart.min(1.0 - apart).abs() } else { apart }
        };
        let squares: Vec<f64> = self.prior.genes().map(|gene| off(gene) * off(gene)).collect();
        let mean = squares.iter().sum::<f64>() / squares.len().max(1) as f64;
        Some(mean.sqrt() / Prior::SPREAD)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_measured_in_deviations_of_the_prior() {
        let species = pleach_generators::species("quaking_aspen").unwrap();
        let (truth, _) = Truth::new(&species, 1).unwrap();
        assert_eq!(truth.numbers_off(&truth.species), Some(0.0));
        // The middle of the prior is about one deviation from a draw.
        let middle = truth.numbers_off(&species).unwrap();
        assert!((0.6..1.4).contains(&middle), "{middle}");
        // One number that is off by its plausible range is so by all of the deviations in it.
        let gene = truth.prior.genes().find(|gene| !gene.is_log() && !gene.can_flip()).unwrap();
        let mut genome = Genome::new(truth.species.params.values().to_vec(), 0);
        let unit = gene.to_unit(gene.get(&genome));
        gene.set(&mut genome, gene.from_unit(if unit > 0.5 { unit - 0.3 } else { unit + 0.3 }));
        let params = species.params.space().check(genome.values).unwrap();
        let off = truth.numbers_off(&Species { params, ..species.clone() }).unwrap();
        let count = truth.prior.genes().count() as f64;
        assert!((off - 2.0 / count.sqrt()).abs() < 0.2 / count.sqrt(), "{off} of {count} numbers");
        let oak = pleach_generators::species("english_oak").unwrap();
        assert_eq!(truth.numbers_off(&oak), None);
    }
}
