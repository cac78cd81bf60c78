//! Trees of the candidates, compared with the goals.

use super::goal_context::GoalContext;
use super::leaves::leaves;
use super::library::{Entry, GuessLibrary, Resemblance, compare, compare_once};
use super::near::Near;
use super::ranking::ranked;
use super::samples::{TREES_OF_SPECIES, trees_of};
use super::settings::GuessSettings;
use crate::error::FitError;
use pleach_silhouette::Bitmap;
use pleach_tree::Foliage;

impl GuessLibrary {
    /// The trees that the goals are compared with, whether the goals have leaves, and how the trees compare.
    pub(super) fn seen(
        &mut self,
        context: &GoalContext<'_>,
        guess: &GuessSettings,
        mut progress: impl FnMut(usize, usize),
    ) -> Result<(&[Entry], Foliage, Vec<Option<Resemblance>>), FitError> {
        let both = guess.detect_leaves;
        let wanted = [Foliage::All, Foliage::None].map(|foliage| both || foliage == context.problem.foliage);
        let near = Near::at_first(context);
        let entries = self.entries(context, guess, wanted, &near, &mut progress)?;
        let (foliage, found) = leaves(context, entries, guess.detect_leaves, &near)?;
        let near = match near {
            Near::All => near,
            _ => Near::nearest(context, &ranked(context, (entries, &found), 0).0),
        };
        if near == Near::All {
            return Ok((self.latest(), foliage, found));
        }
        let wanted = [Foliage::All, Foliage::None].map(|one| one == foliage);
        let entries = self.entries(context, guess, wanted, &near, &mut progress)?;
        let found = compare(context, entries, foliage, &near)?;
        Ok((entries, foliage, found))
    }
}

/// Pictures of several trees of candidate `named`, drawn as the goal is: those of the library, and more seeds.
pub(super) fn pictures_of(
    context: &GoalContext<'_>,
    named: Option<usize>,
    (entries, found): (&[Entry], &[Option<Resemblance>]),
    foliage: Foliage,
) -> Result<Vec<Vec<Bitmap>>, FitError> {
    let Some(named) = named else { return Ok(Vec::new()) };
    let is_one = |entry: &Entry| entry.sample.is_species && entry.sample.candidate == named;
    let there = entries.iter().filter(|entry| is_one(entry)).count() as u64;
    let seeds = there..TREES_OF_SPECIES.max(there);
    let more = compare_once(context, trees_of(context.settings, context.candidates, named, seeds)?, foliage)?;
    let known =
        entries.iter().zip(found).filter(|(entry, _)| is_one(entry)).filter_map(|(_, found)| found.as_ref());
    Ok(known
        .map(|found| found.pictures.clone())
        .chain(more.into_iter().flatten().map(|one| one.pictures))
        .collect())
}
