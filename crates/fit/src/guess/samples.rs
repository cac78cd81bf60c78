//! The trees that a goal is compared with: candidates as they are, and variations.

use super::candidate::Candidate;
use super::settings::GuessSettings;
use crate::error::FitError;
use crate::problem::Genome;
use crate::run::FitSettings;
use crate::space::Stream;
use crate::space::{Freedom, SearchSpace, TreeSeed};
use std::ops::Range;
use std::sync::Arc;

/// Purpose of the draws of variations, for [`Stream::at`].
const VARIATION: u32 = 0x6775;

/// Trees of the goal's species that are compared in pairs: 15 pairs, whose mean is accurate to 0.01 or 0.02.
pub(super) const TREES_OF_SPECIES: u64 = 6;

/// One tree that is compared.
#[derive(Clone, Debug)]
pub(super) struct Sample {
    pub(super) candidate: usize,
    /// Whether it is the candidate as it is, and not a variation.
    pub(super) is_species: bool,
    /// Whether it is the first tree of the candidate as it is.
    pub(super) is_first: bool,
    /// Whether its seed is one that the search will use.
    pub(super) may_start: bool,
    pub(super) genome: Genome,
}

/// A few seeds and variations of each candidate.
pub(super) fn samples(
    settings: &FitSettings,
    candidates: &[Candidate],
    guess: &GuessSettings,
) -> Result<Vec<Sample>, FitError> {
    let mut list = Vec::new();
    for (number, candidate) in candidates.iter().enumerate() {
        let space = space_around(candidate)?;
        let seeds = 0..u64::from(guess.seeds.max(1));
        list.extend(seeds.map(|i| by_candidate(&space, settings, (number, candidate), i)));
        for i in 0..guess.variants {
            let draws = Stream::at(settings.seed, VARIATION, number as u64, i);
            let genome = varied(&space, candidate.values(), first_seed(settings), guess.spread, draws);
            list.push(Sample {
                candidate: number,
                is_species: false,
                is_first: false,
                may_start: true,
                genome,
            });
        }
    }
    Ok(list)
}

/// Trees of one candidate as it is, of the seeds from `seeds.start` on.
pub(super) fn trees_of(
    settings: &FitSettings,
    candidates: &[Candidate],
    candidate: usize,
    seeds: Range<u64>,
) -> Result<Vec<Sample>, FitError> {
    let species = &candidates[candidate];
    let space = space_around(species)?;
    Ok(seeds.map(|i| by_candidate(&space, settings, (candidate, species), i)).collect())
}

/// `values` with every active number, except choices, moved by a normal draw of `spread` times itself.
fn varied(space: &SearchSpace, values: &[f64], seed: u64, spread: f64, mut draws: Stream) -> Genome {
    let mut genome = space.individual(values, seed);
    let mut read = Vec::new();
    space.active_genes(values, &mut read);
    for gene in read.into_iter().map(|g| &space.genes()[g]).filter(|gene| !gene.is_choice()) {
        let value = gene.clamp(gene.get(&genome) * (1.0 + spread * draws.normal()));
        gene.set(&mut genome, value);
    }
    space.settle(&mut genome);
    genome
}

fn space_around(candidate: &Candidate) -> Result<SearchSpace, FitError> {
    let generator = Arc::clone(&candidate.species.generator);
    let values = candidate.values();
    let space = SearchSpace::new(generator, values, &Freedom::default(), TreeSeed::Any)?;
    Ok(space.plausible(values).settling(true))
}

fn by_candidate(
    space: &SearchSpace,
    settings: &FitSettings,
    (number, candidate): (usize, &Candidate),
    i: u64,
) -> Sample {
    let may_start = i == 0 || settings.tree_seed == TreeSeed::Any;
    let mut genome = space.individual(candidate.values(), first_seed(settings).wrapping_add(i));
    space.settle(&mut genome);
    Sample { candidate: number, is_species: true, is_first: i == 0, may_start, genome }
}

const fn first_seed(settings: &FitSettings) -> u64 {
    match settings.tree_seed {
        TreeSeed::Fixed(seed) => seed,
        TreeSeed::Any => settings.seed,
    }
}
