//! Trees of the known species, grown once and compared with many goals.

use super::plate::{Plate, side_for};
use super::{BATCH, Candidate, GuessSettings, Try, tries};
use crate::evaluator::{Evaluator, FitProblem, height_of};
use crate::run::FitError;
use crate::settings::FitSettings;
use crate::space::TreeSeed;
use crate::stoppable;
use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::{Limits, ModelId};
use std::sync::atomic::AtomicBool;

/// The trees that goals are compared with, kept from goal to goal.
///
/// What is kept does not depend on a goal but for the side from which it was taken and, roughly, its
/// size in pixels. Where something else is asked for, all is grown anew: the answers are the same bits
/// as those of a fresh library. It takes some 10 MB for the twenty species.
#[derive(Debug, Default)]
pub struct GuessLibrary {
    shelf: Option<(Key, Vec<Entry>)>,
}

/// What the trees of a library depend on.
#[derive(Debug, PartialEq)]
struct Key {
    generator: ModelId,
    candidates: Vec<Candidate>,
    guess: GuessSettings,
    seed: u64,
    tree_seed: TreeSeed,
    robust: u32,
    limits: Limits,
    views: Vec<View>,
    side: u32,
}

/// What is asked of a library.
pub(super) struct Wish<'a> {
    pub(super) candidates: &'a [Candidate],
    pub(super) guess: &'a GuessSettings,
    /// Whether trees with leaves are wanted, and such without.
    pub(super) looks: [bool; 2],
}

/// A tree, or several of other seeds that count together.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) attempt: Try,
    /// With leaves and without; none where the trees do not grow or nobody has asked.
    looks: [Option<Looks>; 2],
}

/// How an entry's trees look.
#[derive(Debug)]
struct Looks {
    /// Height of the first in metres.
    height: f64,
    /// Seed by seed, and of each view by view.
    plates: Vec<Plate>,
}

/// Which of an entry's looks.
pub(super) const fn place(foliage: bool) -> usize {
    if foliage { 0 } else { 1 }
}

/// How an entry compares with a goal.
#[derive(Clone, Debug)]
pub(super) struct Resemblance {
    /// Likeness to the goal, in 0..=1; the mean over seeds and views.
    pub(super) likeness: f64,
    /// Intersection over union.
    pub(super) iou: f64,
    /// How much larger it had to be for the goal's height.
    pub(super) factor: f64,
    /// The pictures of its first seed, view by view; only of species as they are.
    pub(super) pictures: Vec<Bitmap>,
}

impl GuessLibrary {
    /// A library without trees.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The trees for `problem`; grown if they are not there.
    pub(super) fn entries(
        &mut self,
        (problem, evaluator): (&FitProblem, &Evaluator),
        settings: &FitSettings,
        Wish { candidates, guess, looks: wanted }: Wish<'_>,
        stop: &AtomicBool,
        mut progress: impl FnMut(usize, usize),
    ) -> Result<&[Entry], FitError> {
        let list = tries(problem, settings, candidates, guess)?;
        let goals = problem.goals.iter();
        let side = goals.map(|goal| side_for(goal.frame.width, goal.frame.height)).max().unwrap_or_default();
        let key = Key {
            generator: problem.generator.model(),
            candidates: candidates.to_vec(),
            guess: GuessSettings { detect_leaves: false, keep: 0, ..*guess },
            seed: settings.seed,
            tree_seed: settings.tree_seed,
            robust: settings.robust.get(),
            limits: settings.limits,
            views: list.first().map(|attempt| views(evaluator, attempt)).unwrap_or_default(),
            side,
        };
        let all = list.len();
        let mut entries = match self.shelf.take() {
            Some((known, entries)) if known == key => entries,
            _ => list.into_iter().map(|attempt| Entry { attempt, looks: [None, None] }).collect(),
        };
        let there = |entry: &Entry| (0..2).all(|i| !wanted[i] || entry.looks[i].is_some());
        if !entries.iter().all(there) {
            let mut done = 0;
            for batch in entries.chunks_mut(BATCH) {
                let grown = stoppable::map(batch, stop, |entry| {
                    if there(entry) { None } else { grow(evaluator, &entry.attempt, wanted, side) }
                })?;
                for (entry, grown) in batch.iter_mut().zip(grown) {
                    if let Some(looks) = grown {
                        entry.looks = looks;
                    }
                }
                done += batch.len();
                progress(done, all);
            }
        } else if all > 0 {
            progress(all, all);
        }
        Ok(&self.shelf.insert((key, entries)).1)
    }
}

/// The views of a problem as the library's trees are seen in them.
fn views(evaluator: &Evaluator, attempt: &Try) -> Vec<View> {
    evaluator.placed(&attempt.genome).into_iter().map(|(view, _)| view).collect()
}

/// Grows and draws the trees of `attempt`; none if one of them does not grow.
fn grow(evaluator: &Evaluator, attempt: &Try, wanted: [bool; 2], side: u32) -> Option<[Option<Looks>; 2]> {
    let views = views(evaluator, attempt);
    let mut looks = wanted.map(|wanted| wanted.then(|| Looks { height: 0.0, plates: Vec::new() }));
    evaluator.show(&attempt.genome, wanted[place(true)], |tree, rasterizer| {
        for (at, looks) in looks.iter_mut().enumerate() {
            let Some(looks) = looks else { continue };
            let foliage = at == place(true);
            if looks.plates.is_empty() {
                looks.height = height_of(tree, foliage);
            }
            for view in &views {
                looks.plates.push(Plate::draw(tree, view, foliage, side, rasterizer));
            }
        }
    })?;
    Some(looks)
}

/// Compares every entry, with leaves or without, with the goals of `evaluator`; none for those that do
/// not grow.
pub(super) fn compare(
    (problem, evaluator): (&FitProblem, &Evaluator),
    entries: &[Entry],
    foliage: bool,
    stop: &AtomicBool,
) -> Result<Vec<Option<Resemblance>>, FitError> {
    stoppable::map(entries, stop, |entry| {
        let looks = entry.looks[place(foliage)].as_ref()?;
        let mut values = entry.attempt.genome.values.clone();
        let factor = evaluator.factor_for(looks.height).filter(|&f| problem.generator.resize(&mut values, f));
        let factor = factor.unwrap_or(1.0);
        let frames: Vec<Frame> =
            evaluator.placed(&entry.attempt.genome).into_iter().map(|(_, frame)| frame).collect();
        let mut sum = Resemblance { likeness: 0.0, iou: 0.0, factor, pictures: Vec::new() };
        let mut picture = Bitmap::default();
        for (number, plate) in looks.plates.iter().enumerate() {
            let view = number % frames.len();
            plate.through(&frames[view], factor, &mut picture);
            let (likeness, iou) = evaluator.resemblance(view, &picture);
            sum.likeness += likeness;
            sum.iou += iou;
            if number < frames.len() && entry.attempt.is_species {
                sum.pictures.push(picture.clone());
            }
        }
        let pictures = looks.plates.len().max(1) as f64;
        sum.likeness /= pictures;
        sum.iou /= pictures;
        Some(sum)
    })
}

/// Grows `attempts`, whose trees nobody keeps, and compares them as [`compare`] does.
pub(super) fn shown_once(
    shown: (&FitProblem, &Evaluator),
    attempts: Vec<Try>,
    foliage: bool,
    stop: &AtomicBool,
) -> Result<Vec<Resemblance>, FitError> {
    let goals = shown.0.goals.iter();
    let side = goals.map(|goal| side_for(goal.frame.width, goal.frame.height)).max().unwrap_or_default();
    let wanted = [foliage, !foliage];
    let looks = stoppable::map(&attempts, stop, |attempt| grow(shown.1, attempt, wanted, side))?;
    let entries: Vec<Entry> = attempts
        .into_iter()
        .zip(looks)
        .map(|(attempt, looks)| Entry { attempt, looks: looks.unwrap_or([None, None]) })
        .collect();
    Ok(compare(shown, &entries, foliage, stop)?.into_iter().flatten().collect())
}
