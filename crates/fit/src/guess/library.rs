//! Trees of the known species, grown once and compared with many goals.

use super::candidate::Candidate;
use super::contradiction::contradiction;
use super::drawings::{Drawings, pack};
use super::goal_context::{GoalContext, likeness_evaluator};
use super::near::Near;
use super::samples::{Sample, TREES_OF_SPECIES, samples, trees_of};
use super::settings::{Contradictions, GuessSettings};
use super::silhouettes::{BothSilhouettes, Silhouettes, index_of};
use crate::control::interrupt;
use crate::error::FitError;
use crate::evaluator::{Buffers, Evaluator, FineSilhouette, height_of, side_for};
use crate::predictor::Predictors;
use crate::problem::{FitProblem, Genome, GoalView, Objective, Terms};
use crate::run::FitSettings;
use crate::space::TreeSeed;
use pleach_reading::Reader;
use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::{Fnv, Foliage, Limits, ModelId, Tree};
use std::sync::atomic::AtomicBool;

/// Sets of trees that are kept: those from the front, and those from a goal's own side.
const SHELVES: usize = 2;
/// Trees between two calls of the observer: enough to keep the threads busy.
const BATCH: usize = 32;
/// The trees that goals are compared with, kept from goal to goal.
///
/// Of a goal they depend only on the direction of view and, roughly, the size in pixels. A library grows them again
/// for other settings: its answers are the same bits as those of a fresh one. It takes some 16 MB for twenty species
/// and goals of 256 pixels.
#[derive(Debug, Default)]
pub struct GuessLibrary {
    shelves: Vec<(Key, Vec<Entry>)>,
    pub(super) prepared: Option<Drawings>,
    pub(super) predictors: Option<Predictors>,
    /// Whether trees are dropped after one goal.
    is_for_one: bool,
}

/// Everything that the trees of a library depend on.
#[derive(Debug, PartialEq)]
struct Key {
    /// Model, name and numbers of each.
    candidates: Vec<(ModelId, String, Vec<f64>)>,
    guess: GuessSettings,
    seed: u64,
    tree_seed: TreeSeed,
    robust: u32,
    limits: Limits,
    views: Vec<View>,
    side: u32,
}

/// A tree, or several of different seeds that count as one.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) sample: Sample,
    /// With leaves and without; `None` where the trees do not grow or were not asked for.
    silhouettes: BothSilhouettes,
}

/// How an entry compares with a goal.
#[derive(Clone, Debug)]
pub(super) struct Resemblance {
    /// Whether the trees have leaves or blobs of foliage.
    pub(super) has_foliage: bool,
    /// Likeness to the goal, in 0..=1; the mean over seeds and views.
    pub(super) likeness: f64,
    /// Intersection over union.
    pub(super) iou: f64,
    /// What it loses of its likeness for what contradicts the goal, at least 0.
    pub(super) contradiction: f64,
    /// The factor that brings it to the goal's height.
    pub(super) factor: f64,
    /// The pictures of its first seed, view by view; only for unvaried species.
    pub(super) pictures: Vec<Bitmap>,
}

impl GuessLibrary {
    /// A library without trees.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A library that grows only trees without drawings.
    #[must_use]
    pub fn with_drawings(drawings: Drawings) -> Self {
        Self { prepared: Some(drawings), ..Self::default() }
    }

    /// The same, whose guesses are also of trees whose numbers `predictors` tell from the goal.
    #[must_use]
    pub fn with_predictors(self, predictors: Predictors) -> Self {
        Self { predictors: Some(predictors), ..self }
    }

    /// What it predicts by.
    #[must_use]
    pub const fn predictors(&self) -> Option<&Predictors> {
        self.predictors.as_ref()
    }

    /// The same, but it drops its trees once a goal has been compared with them: a fit needs their memory only for
    /// its first guess.
    #[must_use]
    pub fn for_one_goal(self) -> Self {
        Self { is_for_one: true, ..self }
    }

    /// Its drawings.
    #[must_use]
    pub const fn drawings(&self) -> Option<&Drawings> {
        self.prepared.as_ref()
    }

    /// Draws all trees that a first guess with these settings compares, with leaves and without, for goals like those
    /// of `problem` in size and view. Returns bytes for [`Drawings::from_bytes`].
    ///
    /// # Errors
    /// As [`first_guess`](super::first_guess).
    pub fn record(
        problem: &FitProblem,
        settings: &FitSettings,
        candidates: &[Candidate],
        guess: &GuessSettings,
        stop: &AtomicBool,
    ) -> Result<Vec<u8>, FitError> {
        let evaluator = likeness_evaluator(problem, settings)?;
        let context = GoalContext::new(problem, candidates, &evaluator, settings, stop, None);
        let mut samples = samples(settings, candidates, guess)?;
        for candidate in 0..candidates.len() {
            samples.extend(trees_of(
                settings,
                candidates,
                candidate,
                u64::from(guess.seeds)..TREES_OF_SPECIES,
            )?);
        }
        let side = side_of(problem);
        let drawn = interrupt::map(&samples, stop, |sample| grow(&context, sample, [true; 2], side))?;
        let marks = samples.iter().map(|sample| mark(&context, sample, side));
        Ok(pack(marks.zip(&drawn)))
    }

    /// The trees for the goals, with leaves and without as `wanted`; missing ones that `near` selects are grown.
    pub(super) fn entries(
        &mut self,
        context: &GoalContext<'_>,
        guess: &GuessSettings,
        wanted: [bool; 2],
        near: &Near,
        mut progress: impl FnMut(usize, usize),
    ) -> Result<&[Entry], FitError> {
        let list = samples(context.settings, context.candidates, guess)?;
        let key = Key::new(context, guess, &list);
        let side = key.side;
        let all = list.iter().filter(|sample| near.has(sample)).count();
        let shelf = self.shelves.iter().position(|(known, _)| *known == key);
        let mut entries = match shelf.map(|place| self.shelves.remove(place)) {
            Some((_, entries)) => entries,
            None => list.into_iter().map(|sample| Entry { sample, silhouettes: [None, None] }).collect(),
        };
        let there = |entry: &Entry| {
            !near.has(&entry.sample) || (0..2).all(|i| !wanted[i] || entry.silhouettes[i].is_some())
        };
        if !entries.iter().all(there) {
            let mut done = 0;
            for batch in entries.chunks_mut(BATCH) {
                let grown = interrupt::map(batch, context.stop, |entry| {
                    if there(entry) { None } else { silhouettes_of(context, &entry.sample, wanted, side) }
                })?;
                for (entry, grown) in batch.iter_mut().zip(grown) {
                    for (silhouettes, grown) in entry.silhouettes.iter_mut().zip(grown.into_iter().flatten())
                    {
                        if grown.is_some() {
                            *silhouettes = grown;
                        }
                    }
                    done += usize::from(near.has(&entry.sample));
                }
                progress(done, all);
            }
        } else if all > 0 {
            progress(all, all);
        }
        if self.shelves.len() >= SHELVES {
            let _ = self.shelves.remove(0);
        }
        self.shelves.push((key, entries));
        Ok(self.latest())
    }

    /// The trees of the last call of `entries`.
    pub(super) fn latest(&self) -> &[Entry] {
        self.shelves.last().map_or(&[], |(_, entries)| entries)
    }

    /// Called once a goal has been compared with the trees.
    pub(super) fn close(&mut self) {
        if self.is_for_one {
            self.shelves.clear();
        }
    }
}

impl Key {
    fn new(context: &GoalContext<'_>, guess: &GuessSettings, list: &[Sample]) -> Self {
        let settings = context.settings;
        let of = |Candidate { species }: &Candidate| {
            (species.generator.model(), species.name.clone(), species.params.values().to_vec())
        };
        let views = |first: &Sample| views(context.models.evaluator(first.candidate), first);
        Self {
            candidates: context.candidates.iter().map(of).collect(),
            guess: GuessSettings {
                detect_leaves: false,
                keep: 0,
                contradictions: Contradictions::Ignored,
                race: None,
                ..*guess
            },
            seed: settings.seed,
            tree_seed: settings.tree_seed,
            robust: settings.robust.get(),
            limits: settings.limits,
            views: list.first().map(views).unwrap_or_default(),
            side: side_of(context.problem),
        }
    }
}

/// The side of fine silhouettes for the goals of `problem`, in pixels: of their trees, whatever margins they have.
fn side_of(problem: &FitProblem) -> u32 {
    let side = |goal: &GoalView| {
        let (left, top, right, bottom) = goal.goal.ink_box().unwrap_or_default();
        side_for(right + 1 - left, bottom + 1 - top)
    };
    problem.goals.iter().map(side).max().unwrap_or_default()
}

/// The directions of view of the library's trees.
fn views(evaluator: &Evaluator, sample: &Sample) -> Vec<View> {
    evaluator.placed(&sample.genome).into_iter().map(|(view, _)| view).collect()
}

/// The key of the drawings of `sample`, which does not depend on the candidate's name.
fn mark(context: &GoalContext<'_>, sample: &Sample, side: u32) -> u64 {
    let model = context.candidates[sample.candidate].species.generator.model();
    let views = views(context.models.evaluator(sample.candidate), sample);
    let FitSettings { robust, limits, .. } = context.settings;
    let Genome { values, tree_seed, .. } = &sample.genome;
    Fnv::hash(format!("{model} {values:?} {tree_seed} {robust} {limits:?} {views:?} {side}").as_bytes())
}

/// The silhouettes of the trees of `sample`, from drawings or grown; `None` if one of them does not grow.
fn silhouettes_of(
    context: &GoalContext<'_>,
    sample: &Sample,
    wanted: [bool; 2],
    side: u32,
) -> Option<BothSilhouettes> {
    let drawn = context.drawings.as_ref().and_then(|drawings| drawings.find(mark(context, sample, side)));
    match drawn {
        Some(None) => None,
        Some(Some(silhouettes)) if (0..2).all(|i| silhouettes[i].is_some() || !wanted[i]) => {
            Some(silhouettes)
        }
        _ => grow(context, sample, wanted, side),
    }
}

/// Grows and draws the trees of `sample`; `None` if one of them does not grow.
fn grow(context: &GoalContext<'_>, sample: &Sample, wanted: [bool; 2], side: u32) -> Option<BothSilhouettes> {
    let evaluator = context.models.evaluator(sample.candidate);
    let views = views(evaluator, sample);
    let mut silhouettes = wanted
        .map(|wanted| wanted.then(|| Silhouettes { height: 0.0, has_foliage: false, views: Vec::new() }));
    let grown = if wanted[index_of(Foliage::All)] { Foliage::All } else { Foliage::None };
    evaluator.show(&sample.genome, grown, |tree, rasterizer| {
        for (foliage, silhouettes) in [Foliage::All, Foliage::None].into_iter().zip(&mut silhouettes) {
            let Some(silhouettes) = silhouettes else { continue };
            if silhouettes.views.is_empty() {
                silhouettes.height = height_of(tree, foliage);
            }
            silhouettes.has_foliage |= foliage != Foliage::None && has_foliage(tree);
            for view in &views {
                silhouettes.views.push(FineSilhouette::draw(tree, view, foliage, side, rasterizer));
            }
        }
    })?;
    Some(silhouettes)
}

fn has_foliage(tree: &Tree) -> bool {
    !(tree.leaves.is_empty() && tree.blossoms.is_empty() && tree.blobs.is_empty())
}

/// What candidates are compared by.
const LIKENESS: Terms = Terms { objective: Objective::Likeness, likeness: true };

/// Compares the entries that `near` selects, with leaves or without, with the goals; `None` for others, and for those
/// that do not grow.
pub(super) fn compare(
    context: &GoalContext<'_>,
    entries: &[Entry],
    foliage: Foliage,
    near: &Near,
) -> Result<Vec<Option<Resemblance>>, FitError> {
    interrupt::map(entries, context.stop, |entry| {
        if !near.has(&entry.sample) {
            return None;
        }
        let silhouettes = entry.silhouettes[index_of(foliage)].as_ref()?;
        let candidate = entry.sample.candidate;
        let evaluator = context.models.evaluator(candidate);
        let mut values = entry.sample.genome.values.clone();
        let factor =
            evaluator.factor_for(silhouettes.height).filter(|&f| context.resize(candidate, &mut values, f));
        let factor = factor.unwrap_or(1.0);
        let frames: Vec<Frame> =
            evaluator.placed(&entry.sample.genome).into_iter().map(|(_, frame)| frame).collect();
        let has_foliage = silhouettes.has_foliage;
        let mut sum = Resemblance {
            has_foliage,
            likeness: 0.0,
            iou: 0.0,
            contradiction: 0.0,
            factor,
            pictures: Vec::new(),
        };
        let (mut picture, mut buffers) = (Bitmap::default(), Buffers::default());
        let mut reader = Reader::new();
        let trunks = context.candidates[candidate].species.generator.trunks(&values);
        for (number, fine) in silhouettes.views.iter().enumerate() {
            let view = number % frames.len();
            fine.through(&frames[view], factor, &mut picture);
            let agreement = context.silhouettes[view].compare(&picture, LIKENESS, &mut buffers);
            if let (0, Some(goal)) = (view, &context.reading) {
                sum.contradiction += context.weight * contradiction(goal, &picture, trunks, &mut reader);
            }
            sum.likeness += agreement.value;
            sum.iou += agreement.iou;
            if number < frames.len() && entry.sample.is_species {
                sum.pictures.push(picture.clone());
            }
        }
        let pictures = silhouettes.views.len().max(1) as f64;
        sum.contradiction *= frames.len() as f64 / pictures;
        sum.likeness /= pictures;
        sum.iou /= pictures;
        Some(sum)
    })
}

/// Grows `samples` without keeping their trees, and compares them as [`compare`] does; `None` for those that do not grow.
pub(super) fn compare_once(
    context: &GoalContext<'_>,
    samples: Vec<Sample>,
    foliage: Foliage,
) -> Result<Vec<Option<Resemblance>>, FitError> {
    let side = side_of(context.problem);
    let wanted = [Foliage::All, Foliage::None].map(|one| one == foliage);
    let silhouettes =
        interrupt::map(&samples, context.stop, |sample| silhouettes_of(context, sample, wanted, side))?;
    let entries: Vec<Entry> = samples
        .into_iter()
        .zip(silhouettes)
        .map(|(sample, silhouettes)| Entry { sample, silhouettes: silhouettes.unwrap_or([None, None]) })
        .collect();
    compare(context, &entries, foliage, &Near::All)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_silhouette::Rasterizer;
    use pleach_tree::Parts;

    #[test]
    fn trees_are_kept_unless_for_one_goal() {
        let species = pleach_generators::preset("palm").unwrap();
        let tree = species.grow(2).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 64, 64);
        let mut goal = Bitmap::default();
        Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut goal);
        let problem = FitProblem::new(species.clone(), GoalView::new(goal, View::FRONT, frame));
        let candidates = [Candidate::from(species)];
        let (settings, stop) = (FitSettings::default(), AtomicBool::new(false));
        for (mut library, keeps) in [(GuessLibrary::new(), true), (GuessLibrary::new().for_one_goal(), false)]
        {
            let guess = GuessSettings::default();
            let guessed = library.first_guess(&problem, &settings, &candidates, &guess, &stop, |_, _| ());
            assert_eq!((guessed.unwrap().names[0].0.as_str(), !library.shelves.is_empty()), ("palm", keeps));
            let _ = library.references(&problem, &settings, &candidates, &stop).unwrap();
            assert_eq!(!library.shelves.is_empty(), keeps);
        }
    }
}
