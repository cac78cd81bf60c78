//! The goals, with all that is known of the trees that they show.

use super::spec::{Degraded, FileGoal, GoalSpec, OwnGoal};
use super::{FRESH, stop};
use crate::pictured::{load, load_view, pictured};
use anyhow::Context;
use pleach_fit::{FitProblem, Genome, GoalView, Objective, fresh_seeds};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::score::likeness::Likeness;
use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::{Foliage, Key, Limits};
use std::path::Path;

/// A goal with what is known of it.
pub(super) struct Problem {
    pub(super) spec: GoalSpec,
    pub(super) name: String,
    /// The problem to fit.
    pub(super) fit: FitProblem,
    /// The unspoilt picture that results are scored against where the goal is spoilt.
    pub(super) clean: Option<FitProblem>,
    /// A picture that the search does not see.
    pub(super) held_out: Option<GoalView>,
    /// Scores of other trees of the goal's kind.
    pub(super) ceiling: Option<Ceiling>,
}

/// Mean scores of other trees of the goal's kind.
#[derive(Clone, Copy)]
pub(super) struct Ceiling {
    pub(super) likeness: f64,
    pub(super) iou: f64,
}

impl Problem {
    /// Without a ceiling.
    pub(super) fn read(folder: &Path, spec: &GoalSpec) -> anyhow::Result<Self> {
        match spec {
            GoalSpec::Own(goal) => Self::own(spec, goal),
            GoalSpec::File(goal) => Self::file(folder, spec, goal),
        }
    }

    /// The same with what other trees of its kind score, which takes a while.
    pub(super) fn with_ceiling(folder: &Path, spec: &GoalSpec) -> anyhow::Result<Self> {
        let problem = Self::read(folder, spec)?;
        let ceiling = match spec {
            GoalSpec::Own(goal) => seeds_of(goal)?,
            GoalSpec::File(FileGoal { like: Some(species), bare, .. }) => {
                seeds_of(&OwnGoal::new(species, LIKE_SEED, *bare))?
            }
            GoalSpec::File(goal) => others(folder, goal, &problem.fit.goals[0].goal)?,
        };
        Ok(Self { ceiling, ..problem })
    }

    fn own(spec: &GoalSpec, goal: &OwnGoal) -> anyhow::Result<Self> {
        let species = pleach_generators::species(&goal.species)?;
        let foliage = !goal.bare;
        let tree = species.grow(goal.seed)?;
        let front = pictured(&tree, View::FRONT, foliage);
        let side = |azimuth: f64| pictured(&tree, View::degrees(azimuth, 0.0), foliage);
        let whole: Vec<GoalView> = std::iter::once(front).chain(goal.second_view.map(side)).collect();
        let (goals, clean) = match goal.degraded {
            None => (whole, None),
            Some(degraded) => {
                let (spoilt, clean) = spoil(&whole[0], degraded)?;
                (vec![spoilt], Some(problem(vec![clean], foliage)?))
            }
        };
        Ok(Self {
            spec: spec.clone(),
            name: spec.name(),
            fit: problem(goals, foliage)?,
            clean,
            held_out: goal.held_out.map(side),
            ceiling: None,
        })
    }

    fn file(folder: &Path, spec: &GoalSpec, goal: &FileGoal) -> anyhow::Result<Self> {
        let view = load_view(folder, &goal.file, goal.height)?;
        Ok(Self {
            spec: spec.clone(),
            name: spec.name(),
            fit: problem(vec![view], !goal.bare)?,
            clean: None,
            held_out: None,
            ceiling: None,
        })
    }
}

/// Seed of our own tree that stands in for a foreign one when the ceiling of its kind is measured.
const LIKE_SEED: u64 = 11;

/// A problem of the default generator, from the default species.
fn problem(goals: Vec<GoalView>, foliage: bool) -> anyhow::Result<FitProblem> {
    let start = pleach_generators::preset("quaking_aspen").context("the default species is built in")?;
    Ok(FitProblem { start, goals, foliage: if foliage { Foliage::All } else { Foliage::None } })
}

/// How trees of other seeds of the true parameters do, against the whole picture.
fn seeds_of(goal: &OwnGoal) -> anyhow::Result<Option<Ceiling>> {
    let whole = OwnGoal { degraded: None, ..goal.clone() };
    let problem = Problem::own(&GoalSpec::Own(whole.clone()), &whole)?;
    let species = pleach_generators::species(&goal.species)?;
    let own = FitProblem { start: species.clone(), ..problem.fit };
    let truth = Genome::new(species.params.values().to_vec(), goal.seed);
    let fresh =
        fresh_seeds(&own, Objective::default(), Limits::default(), &truth, FRESH, stop::flag().into())?;
    Ok(fresh.map(|fresh| Ceiling { likeness: fresh.likeness.mean, iou: fresh.iou.mean }))
}

/// How the other pictures by the same program do.
fn others(folder: &Path, goal: &FileGoal, picture: &Bitmap) -> anyhow::Result<Option<Ceiling>> {
    let mut sum = Ceiling { likeness: 0.0, iou: 0.0 };
    for file in &goal.others {
        let other = load(folder, file)?.bitmap;
        sum.likeness += Likeness::between(&other, picture).value();
        sum.iou += iou(&other, picture);
    }
    let n = goal.others.len() as f64;
    Ok((n > 0.0).then(|| Ceiling { likeness: sum.likeness / n, iou: sum.iou / n }))
}

/// The picture with something wrong with it, understood as a user's picture would be, and the whole
/// picture in the frame that it is believed to have.
fn spoil(whole: &GoalView, how: Degraded) -> anyhow::Result<(GoalView, GoalView)> {
    let ink = &whole.goal;
    let (_, top, right, bottom) = ink.ink_box().context("a tree leaves ink")?;
    let axis = f64::from(ink.width()) / 2.0;
    let spoilt = match how {
        Degraded::CutOff => {
            // Half of the way from the trunk to the crown's edge.
            let width = u32::midpoint(axis as u32, right);
            Bitmap::from_fn(width, ink.height(), |x, y| ink.get(x, y))
        }
        Degraded::NoTrunk => {
            let hidden = bottom - (bottom - top) / 6;
            Bitmap::from_fn(ink.width(), ink.height(), |x, y| y < hidden && ink.get(x, y))
        }
        Degraded::Noise => {
            let flips = |x: u32, y: u32| Key::root(NOISE).child(0, y).bits(0, x).is_multiple_of(50);
            Bitmap::from_fn(ink.width(), ink.height(), |x, y| ink.get(x, y) != flips(x, y))
        }
    };
    let understood = Goal::from_ink(spoilt, &GoalOptions::default())?;
    let frame = understood.frame(10.0);
    let clean = GoalView { frame: Frame { width: ink.width(), ..frame }, ..whole.clone() };
    Ok((GoalView { frame, goal: understood.bitmap, ..whole.clone() }, clean))
}

/// Seed of the wrong pixels.
const NOISE: u64 = 7;

/// Intersection over union.
pub(super) fn iou(a: &Bitmap, b: &Bitmap) -> f64 {
    let both = a.intersection(b) as f64;
    both / ((a.ink() + b.ink()) as f64 - both).max(1.0)
}
