//! Trees of the known species, grown once and compared with many goals.

use super::candidate::Candidate;
use super::drawings::{Drawings, pack};
use super::near::Near;
use super::plate::{Plate, side_for};
use super::settings::GuessSettings;
use super::shown::Shown;
use super::tries::{Try, trees_of, tries};
use super::{TREES_OF_SPECIES, looks};
use crate::cancellable;
use crate::error::FitError;
use crate::evaluator::{Evaluator, height_of};
use crate::genome::Genome;
use crate::problem::FitProblem;
use crate::settings::FitSettings;
use crate::space::TreeSeed;
use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::{Fnv, Foliage, Limits, ModelId, Tree};
use serde::{Deserialize, Serialize};
use std::sync::atomic::AtomicBool;

/// Kinds of goals whose trees are kept at a time: those of a goal from another side than the front, and from there.
const SHELVES: usize = 2;
/// Trees between two calls of the observer: enough to keep the threads busy.
const BATCH: usize = 32;
/// The trees that goals are compared with, kept from goal to goal.
///
/// What is kept does not depend on a goal but for the side from which it was taken and, roughly, its
/// size in pixels. Where something else is asked for, all is grown again: the answers are the same bits
/// as those of a fresh library. It takes some 16 MB for the twenty species and
/// goals of 256 pixels.
#[derive(Debug, Default)]
pub struct GuessLibrary {
    shelves: Vec<(Key, Vec<Entry>)>,
    pub(super) prepared: Option<Drawings>,
    /// Whether trees are kept for no other goal.
    is_for_one: bool,
}

/// What the trees of a library depend on.
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

/// A tree, or several of other seeds that count together.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) attempt: Try,
    /// With leaves and without; none where the trees do not grow or nobody has asked.
    looks: TreeLooks,
}

/// How an entry's trees look.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Looks {
    /// Height of the first in metres.
    height: f64,
    /// Whether any of them has leaves or blobs of foliage.
    has_foliage: bool,
    /// Seed by seed, and of each view by view.
    plates: Vec<Plate>,
}

/// With leaves, then without; none where nobody has asked.
pub(super) type TreeLooks = [Option<Looks>; 2];

/// Which of an entry's looks: with leaves, then without.
fn place(foliage: Foliage) -> usize {
    usize::from(foliage == Foliage::None)
}

/// How an entry compares with a goal.
#[derive(Clone, Debug)]
pub(super) struct Resemblance {
    /// Whether what was compared has leaves or blobs of foliage.
    pub(super) has_foliage: bool,
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

    /// A library that grows only trees of which there are no drawings.
    #[must_use]
    pub fn with_drawings(drawings: Drawings) -> Self {
        Self { prepared: Some(drawings), ..Self::default() }
    }

    /// The same, but it keeps nothing once a goal has been compared with its trees: a fit takes their memory no
    /// longer than its first guess.
    #[must_use]
    pub fn for_one_goal(self) -> Self {
        Self { is_for_one: true, ..self }
    }

    /// The drawings that it was made with.
    #[must_use]
    pub const fn drawings(&self) -> Option<&Drawings> {
        self.prepared.as_ref()
    }

    /// Draws the trees of all candidates that a first guess with these settings looks at, with leaves and without,
    /// for goals that are like those of `problem` in size and view: bytes for [`Drawings::from_bytes`].
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
        let looks = looks(problem, settings)?;
        let shown = Shown::new(problem, candidates, &looks, settings, stop, None);
        let mut attempts = tries(settings, candidates, guess)?;
        for candidate in 0..candidates.len() {
            attempts.extend(trees_of(
                settings,
                candidates,
                candidate,
                u64::from(guess.seeds)..TREES_OF_SPECIES,
            )?);
        }
        let side = side_of(problem);
        let drawn = cancellable::map(&attempts, stop, |attempt| grow(&shown, attempt, [true; 2], side))?;
        let marks = attempts.iter().map(|attempt| mark(&shown, attempt, side));
        Ok(pack(marks.zip(&drawn)))
    }

    /// The trees for the goals that are `shown`, with leaves and without as `wanted`; those that `near`
    /// is about are grown if they are not there.
    pub(super) fn entries(
        &mut self,
        shown: &Shown<'_>,
        guess: &GuessSettings,
        wanted: [bool; 2],
        near: &Near,
        mut progress: impl FnMut(usize, usize),
    ) -> Result<&[Entry], FitError> {
        let list = tries(shown.settings, shown.candidates, guess)?;
        let key = Key::new(shown, guess, &list);
        let side = key.side;
        let all = list.iter().filter(|attempt| near.has(attempt)).count();
        let shelf = self.shelves.iter().position(|(known, _)| *known == key);
        let mut entries = match shelf.map(|place| self.shelves.remove(place)) {
            Some((_, entries)) => entries,
            None => list.into_iter().map(|attempt| Entry { attempt, looks: [None, None] }).collect(),
        };
        let there = |entry: &Entry| {
            !near.has(&entry.attempt) || (0..2).all(|i| !wanted[i] || entry.looks[i].is_some())
        };
        if !entries.iter().all(there) {
            let mut done = 0;
            for batch in entries.chunks_mut(BATCH) {
                let grown = cancellable::map(batch, shown.stop, |entry| {
                    if there(entry) { None } else { looks_of(shown, &entry.attempt, wanted, side) }
                })?;
                for (entry, grown) in batch.iter_mut().zip(grown) {
                    for (looks, grown) in entry.looks.iter_mut().zip(grown.into_iter().flatten()) {
                        if grown.is_some() {
                            *looks = grown;
                        }
                    }
                    done += usize::from(near.has(&entry.attempt));
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

    /// The trees that were asked for last.
    pub(super) fn latest(&self) -> &[Entry] {
        self.shelves.last().map_or(&[], |(_, entries)| entries)
    }

    /// A goal has been compared with the trees.
    pub(super) fn close(&mut self) {
        if self.is_for_one {
            self.shelves.clear();
        }
    }
}

impl Key {
    fn new(shown: &Shown<'_>, guess: &GuessSettings, list: &[Try]) -> Self {
        let settings = shown.settings;
        let of = |Candidate { species }: &Candidate| {
            (species.generator.model(), species.name.clone(), species.params.values().to_vec())
        };
        let views = |first: &Try| views(shown.models.evaluator(first.candidate), first);
        Self {
            candidates: shown.candidates.iter().map(of).collect(),
            guess: GuessSettings { detect_leaves: false, keep: 0, race: None, ..*guess },
            seed: settings.seed,
            tree_seed: settings.tree_seed,
            robust: settings.robust.get(),
            limits: settings.limits,
            views: list.first().map(views).unwrap_or_default(),
            side: side_of(shown.problem),
        }
    }
}

/// The side of the plates for the goals of `problem`, in pixels.
fn side_of(problem: &FitProblem) -> u32 {
    let goals = problem.goals.iter();
    goals.map(|goal| side_for(goal.frame.width, goal.frame.height)).max().unwrap_or_default()
}

/// The views of a problem as the library's trees are seen in them.
fn views(evaluator: &Evaluator, attempt: &Try) -> Vec<View> {
    evaluator.placed(&attempt.genome).into_iter().map(|(view, _)| view).collect()
}

/// What tells the drawings of `attempt` from all others, whatever the candidate is called.
fn mark(shown: &Shown<'_>, attempt: &Try, side: u32) -> u64 {
    let model = shown.candidates[attempt.candidate].species.generator.model();
    let views = views(shown.models.evaluator(attempt.candidate), attempt);
    let FitSettings { robust, limits, .. } = shown.settings;
    let Genome { values, tree_seed, .. } = &attempt.genome;
    Fnv::hash(format!("{model} {values:?} {tree_seed} {robust} {limits:?} {views:?} {side}").as_bytes())
}

/// How the trees of `attempt` look, from drawings that are there or grown; none if one of them does not grow.
fn looks_of(shown: &Shown<'_>, attempt: &Try, wanted: [bool; 2], side: u32) -> Option<TreeLooks> {
    let drawn = shown.drawings.as_ref().and_then(|drawings| drawings.find(mark(shown, attempt, side)));
    match drawn {
        Some(None) => None,
        Some(Some(looks)) if (0..2).all(|i| looks[i].is_some() || !wanted[i]) => Some(looks),
        _ => grow(shown, attempt, wanted, side),
    }
}

/// Grows and draws the trees of `attempt`; none if one of them does not grow.
fn grow(shown: &Shown<'_>, attempt: &Try, wanted: [bool; 2], side: u32) -> Option<TreeLooks> {
    let evaluator = shown.models.evaluator(attempt.candidate);
    let views = views(evaluator, attempt);
    let mut looks =
        wanted.map(|wanted| wanted.then(|| Looks { height: 0.0, has_foliage: false, plates: Vec::new() }));
    let grown = if wanted[place(Foliage::All)] { Foliage::All } else { Foliage::None };
    evaluator.show(&attempt.genome, grown, |tree, rasterizer| {
        for (foliage, looks) in [Foliage::All, Foliage::None].into_iter().zip(&mut looks) {
            let Some(looks) = looks else { continue };
            if looks.plates.is_empty() {
                looks.height = height_of(tree, foliage);
            }
            looks.has_foliage |= foliage != Foliage::None && has_foliage(tree);
            for view in &views {
                looks.plates.push(Plate::draw(tree, view, foliage, side, rasterizer));
            }
        }
    })?;
    Some(looks)
}

fn has_foliage(tree: &Tree) -> bool {
    !(tree.leaves.is_empty() && tree.blossoms.is_empty() && tree.blobs.is_empty())
}

/// Compares the entries that `near` is about, with leaves or without, with the goals that are `shown`;
/// none for others, and for those that do not grow.
pub(super) fn compare(
    shown: &Shown<'_>,
    entries: &[Entry],
    foliage: Foliage,
    near: &Near,
) -> Result<Vec<Option<Resemblance>>, FitError> {
    cancellable::map(entries, shown.stop, |entry| {
        if !near.has(&entry.attempt) {
            return None;
        }
        let looks = entry.looks[place(foliage)].as_ref()?;
        let candidate = entry.attempt.candidate;
        let evaluator = shown.models.evaluator(candidate);
        let mut values = entry.attempt.genome.values.clone();
        let factor = evaluator.factor_for(looks.height).filter(|&f| shown.resize(candidate, &mut values, f));
        let factor = factor.unwrap_or(1.0);
        let frames: Vec<Frame> =
            evaluator.placed(&entry.attempt.genome).into_iter().map(|(_, frame)| frame).collect();
        let has_foliage = looks.has_foliage;
        let mut sum = Resemblance { has_foliage, likeness: 0.0, iou: 0.0, factor, pictures: Vec::new() };
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
    shown: &Shown<'_>,
    attempts: Vec<Try>,
    foliage: Foliage,
) -> Result<Vec<Resemblance>, FitError> {
    let side = side_of(shown.problem);
    let wanted = [Foliage::All, Foliage::None].map(|one| one == foliage);
    let looks = cancellable::map(&attempts, shown.stop, |attempt| looks_of(shown, attempt, wanted, side))?;
    let entries: Vec<Entry> = attempts
        .into_iter()
        .zip(looks)
        .map(|(attempt, looks)| Entry { attempt, looks: looks.unwrap_or([None, None]) })
        .collect();
    Ok(compare(shown, &entries, foliage, &Near::All)?.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::GoalView;
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
