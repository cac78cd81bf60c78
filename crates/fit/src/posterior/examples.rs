//! Trees of a prior and what their pictures show.

use super::prior::Prior;
use crate::control::Until;
use crate::error::FitError;
use crate::evaluator::Evaluator;
use crate::problem::{FitProblem, Genome, Objective};
use crate::run::FIT_LIMITS;
use pleach_silhouette::score::likeness::{Descriptor, Scratch};
use pleach_silhouette::{Bitmap, Detail, Rasterizer};
use pleach_tree::{Tree, Workspace};

/// A tree at the height of its picture.
#[derive(Clone, Debug)]
pub(super) struct Example {
    /// Its genome, with the values that it has at that height.
    pub(super) genome: Genome,
    /// What its pictures show, one for each goal.
    pub(super) shown: Vec<Descriptor>,
}

/// Grows trees and draws them as the goals of a problem are.
#[derive(Debug)]
pub(super) struct Drawer(Evaluator);

impl Drawer {
    /// # Errors
    /// Problems that [`Evaluator::new`] refuses.
    pub(super) fn new(problem: &FitProblem, prior: &Prior) -> Result<Self, FitError> {
        let evaluator = Evaluator::new(problem, Objective::Balance, FIT_LIMITS)?;
        Ok(Self(if prior.sizes_are_free() { evaluator.with_height_matching() } else { evaluator }))
    }

    /// The first `count` trees of `prior`, without those that do not grow or are not seen, and those for which it is too
    /// late. `notify` is told how many were tried.
    ///
    /// # Errors
    /// [`FitError::Interrupted`] once asked to stop.
    pub(super) fn examples(
        &self,
        prior: &Prior,
        (seed, count): (u64, usize),
        until: Until<'_>,
        mut notify: impl FnMut(usize),
    ) -> Result<Vec<Example>, FitError> {
        let numbers: Vec<u32> = (0..u32::try_from(count).unwrap_or(u32::MAX)).collect();
        let mut all = Vec::with_capacity(count);
        let mut tried = 0;
        for some in numbers.chunks(BATCH) {
            let grown = until.map(some, |&number| self.example(genome(prior, seed, number)?))?;
            tried += grown.len();
            all.extend(grown.into_iter().flatten());
            notify(tried);
            if until.is_late() {
                break;
            }
        }
        Ok(all)
    }

    /// The tree of `genome`; `None` if it does not grow, or if nothing is seen of it in one of the pictures.
    pub(super) fn example(&self, mut genome: Genome) -> Option<Example> {
        let mut rasterizer = Rasterizer::for_searches(Detail::Half);
        let (mut picture, mut scratch) = (Bitmap::default(), Scratch::default());
        let (mut shown, mut is_seen) = (Vec::new(), true);
        genome.values = self.0.pictures(&genome, |placed| {
            rasterizer.draw(placed.tree, &placed.view, &placed.frame, placed.parts, &mut picture);
            is_seen &= picture.ink() > 0;
            shown.push(Descriptor::new(&picture, &mut scratch));
        })?;
        is_seen.then_some(Example { genome, shown })
    }
}

/// The numbers of tree `number` of `prior`; `None` if none of its draws grows.
fn genome(prior: &Prior, seed: u64, number: u32) -> Option<Genome> {
    prior.genome_into(seed, number, &mut Workspace::default(), &mut Tree::default()).ok()
}

/// Trees between two reports.
const BATCH: usize = 64;

/// Pictures as a row of numbers: the amounts that likeness compares, as roots, so that few and many weigh alike.
pub(crate) fn features(shown: &[Descriptor]) -> Vec<f64> {
    shown.iter().flat_map(Descriptor::amounts).map(|amount| f64::from(amount.max(0.0)).sqrt()).collect()
}
