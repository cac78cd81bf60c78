//! Grow, draw, score: what a fit does a million times.

use crate::genome::{Genome, Score, Size};
use crate::nuisance::Unknown;
use crate::objective::Objective;
use crate::search::Evaluate;
use pleach_silhouette::score::fast::{Overlaps, PreparedGoal, Scratch};
use pleach_silhouette::score::likeness::{self, Descriptor};
use pleach_silhouette::{Bitmap, Detail, Frame, Projection, Rasterizer, View};
use pleach_tree::{CheckedParams, Foliage, Generator, Growth, Leaf, Limits, Parts, Tree, Workspace};
use rayon::prelude::*;
use std::num::NonZeroU32;
use std::sync::{Arc, Mutex, PoisonError};

/// One picture of the goal tree, and from where it was taken.
#[derive(Clone, Debug)]
pub struct GoalView {
    /// The picture.
    pub goal: Bitmap,
    /// The direction of view.
    pub view: View,
    /// Scale and place; of the goal's size.
    pub frame: Frame,
    /// What of view and frame is not known. Of a problem's first goal, nothing should be.
    pub unknown: Unknown,
}

/// What a fit fits: a generator's numbers to the pictures of one tree.
#[derive(Clone, Debug)]
pub struct FitProblem {
    /// The generator.
    pub generator: Arc<dyn Generator>,
    /// Values of the slots that are not free, one for every slot.
    pub base: Vec<f64>,
    /// The pictures, at least one; all count the same.
    pub goals: Vec<GoalView>,
    /// Whether leaves and blossoms are drawn.
    pub foliage: bool,
}

/// Why a problem's goals cannot be compared with.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ProblemError {
    /// No goal at all.
    #[error("there is no goal image")]
    NoGoal,
    /// A goal and its frame differ in size.
    #[error("goal {index} has {goal:?} pixels, its frame {frame:?}")]
    FrameSize {
        /// Which goal, from 0.
        index: usize,
        /// Width and height of the picture.
        goal: (u32, u32),
        /// Width and height of the frame.
        frame: (u32, u32),
    },
    /// A goal without ink: everything and nothing fits it.
    #[error("goal {index} is empty")]
    EmptyGoal {
        /// Which goal, from 0.
        index: usize,
    },
    /// A frame that shows no part of the world.
    #[error("goal {index} is at {meters_per_pixel} metres a pixel, expected a positive number")]
    Scale {
        /// Which goal, from 0.
        index: usize,
        /// What was given.
        meters_per_pixel: String,
    },
}

/// Weights of the blend: cells of 32, 16, 8, 4 and 2 pixels, then single pixels.
///
/// Equal weights. Chosen by fits of the fifteen species.
const BLEND: [f64; 6] = [1.0, 1.0, 1.0, 1.0, 1.0, 1.0];

/// Scores individuals against the goals of a problem. Shared between threads.
#[derive(Debug)]
pub struct Evaluator {
    generator: Arc<dyn Generator>,
    views: Vec<PreparedView>,
    foliage: bool,
    objective: Objective,
    limits: Limits,
    /// Height that every tree is resized to; of several seeds, the first.
    height: Option<Height>,
    /// Trees that an individual is judged by.
    seeds: u32,
    pool: Mutex<Vec<EvalWorkspace>>,
}

/// The height of the goal's tree, in metres.
#[derive(Clone, Copy, Debug)]
struct Height {
    goal: f64,
    tolerance: f64,
}

#[derive(Debug)]
struct PreparedView {
    prepared: PreparedGoal,
    descriptor: Descriptor,
    goal: Bitmap,
    view: View,
    frame: Frame,
    unknown: Unknown,
    /// Number of its first unknown among all nuisances.
    first: usize,
}

/// How far a tree's height may be from the goal's before it is resized, in pixels: the tip of a tree
/// is thinner than a pixel and leaves no ink.
const HEIGHT_TOLERANCE: f64 = 2.0;
/// Trees that would have to be resized by more than this factor are left to their bad score.
const MAX_RESIZING: f64 = 100.0;

/// Memory that one thread reuses from one evaluation to the next: about the largest tree so far.
#[derive(Debug)]
pub struct EvalWorkspace {
    params: CheckedParams,
    values: Vec<f64>,
    tree: Tree,
    workspace: Workspace,
    rasterizer: Rasterizer,
    /// For pictures at twice the goal's size: there half the samples are as many.
    fine: Rasterizer,
    bitmap: Bitmap,
    comparisons: Comparisons,
}

/// Memory of the comparisons.
#[derive(Debug, Default)]
struct Comparisons {
    overlaps: Scratch,
    likeness: likeness::Scratch,
}

impl EvalWorkspace {
    /// The tree of the last evaluation.
    #[must_use]
    pub const fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The silhouette of the last evaluation, in its last view.
    #[must_use]
    pub const fn bitmap(&self) -> &Bitmap {
        &self.bitmap
    }
}

impl Evaluator {
    /// Prepares the goals of `problem`.
    ///
    /// # Errors
    /// See [`ProblemError`].
    pub fn new(problem: &FitProblem, objective: Objective, limits: Limits) -> Result<Self, ProblemError> {
        if problem.goals.is_empty() {
            return Err(ProblemError::NoGoal);
        }
        let mut views = Vec::new();
        let mut nuisances = 0;
        for (index, goal) in problem.goals.iter().enumerate() {
            let GoalView { goal, view, frame, unknown } = goal;
            let sizes = ((goal.width(), goal.height()), (frame.width, frame.height));
            if sizes.0 != sizes.1 {
                return Err(ProblemError::FrameSize { index, goal: sizes.0, frame: sizes.1 });
            }
            if goal.ink() == 0 {
                return Err(ProblemError::EmptyGoal { index });
            }
            let scale = frame.meters_per_pixel;
            if !(scale > 0.0 && scale.is_finite()) {
                return Err(ProblemError::Scale { index, meters_per_pixel: scale.to_string() });
            }
            views.push(PreparedView {
                prepared: PreparedGoal::new(goal),
                descriptor: Descriptor::of(goal, &mut likeness::Scratch::default()),
                goal: goal.clone(),
                view: *view,
                frame: *frame,
                unknown: *unknown,
                first: nuisances,
            });
            nuisances += unknown.count();
        }
        Ok(Self {
            generator: Arc::clone(&problem.generator),
            views,
            foliage: problem.foliage,
            objective,
            limits,
            height: None,
            seeds: 1,
            pool: Mutex::default(),
        })
    }

    /// Judges an individual by the mean over `count` trees, of its tree seed and of those after it, so
    /// that parameters win of which every tree is like the goal and not a lucky one.
    #[must_use]
    pub fn over_seeds(self, count: NonZeroU32) -> Self {
        Self { seeds: count.get(), ..self }
    }

    /// Has every tree resized to the height of the first goal's ink before it is compared, if that
    /// can be seen: in a level view without perspective, with paper above the tree.
    ///
    /// A picture shows the height of its tree to a pixel. A search that has to find it again for
    /// every change of the trunk, or of the branches at its tip, spends most of its trials on that.
    #[must_use]
    pub fn matching_height(mut self) -> Self {
        let PreparedView { goal, view, frame, .. } = &self.views[0];
        let is_level = view.elevation == 0.0 && view.projection == Projection::Orthographic;
        let top = goal.ink_box().map_or(0, |(_, top, _, _)| top);
        let goal = (frame.ground_row - f64::from(top)) * frame.meters_per_pixel;
        let tolerance = HEIGHT_TOLERANCE * frame.meters_per_pixel;
        self.height = (is_level && top > 0 && goal > tolerance).then_some(Height { goal, tolerance });
        self
    }

    /// Memory for one thread.
    ///
    /// # Panics
    /// If the generator's defaults are not allowed by its own declarations: a mistake there.
    #[must_use]
    pub fn workspace(&self) -> EvalWorkspace {
        let space = self.generator.space();
        EvalWorkspace {
            params: space.check(space.defaults()).expect("defaults are allowed values"),
            values: Vec::new(),
            tree: Tree::default(),
            workspace: Workspace::default(),
            rasterizer: Rasterizer::with_detail(Detail::Half),
            fine: Rasterizer::with_detail(Detail::Draft),
            bitmap: Bitmap::default(),
            comparisons: Comparisons::default(),
        }
    }

    /// Grows `genome`'s tree, draws it and scores it; [`Score::FAILED`] if it does not grow.
    ///
    /// Allocates nothing once `memory` has held a tree as large as this one.
    pub fn evaluate(&self, genome: &Genome, memory: &mut EvalWorkspace) -> Score {
        self.evaluate_within(genome, Size::ANY, memory, false)
    }

    /// The score of `genome` with its likeness, whatever the objective is.
    pub(crate) fn evaluate_and_look(&self, genome: &Genome) -> Score {
        self.with_memory(|memory| self.evaluate_within(genome, Size::ANY, memory, true))
    }

    /// [`Evaluator::evaluate`] in memory that is kept from call to call.
    pub(crate) fn score(&self, genome: &Genome) -> Score {
        self.with_memory(|memory| self.evaluate(genome, memory))
    }

    fn with_memory<T>(&self, work: impl FnOnce(&mut EvalWorkspace) -> T) -> T {
        let pool = || self.pool.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = pool().pop();
        let mut memory = taken.unwrap_or_else(|| self.workspace());
        let result = work(&mut memory);
        pool().push(memory);
        result
    }

    fn evaluate_within(&self, genome: &Genome, most: Size, memory: &mut EvalWorkspace, looks: bool) -> Score {
        let EvalWorkspace { params, values, tree, workspace, rasterizer, bitmap, comparisons, .. } = memory;
        let mut growth = Growth {
            seed: genome.tree_seed,
            limits: Limits {
                stems: self.limits.stems.min(most.stems),
                leaves: self.limits.leaves.min(most.leaves),
                knots: self.limits.knots.min(most.knots),
                ..self.limits
            },
            foliage: if self.foliage { Foliage::All } else { Foliage::None },
            parallel: false,
        };
        let mut grow = |values: &[f64], growth: &Growth, tree: &mut Tree| {
            params.set(values).is_ok() && self.generator.grow(params, growth, workspace, tree).is_ok()
        };
        values.clone_from(&genome.values);
        if !grow(values, &growth, tree) {
            return Score::FAILED;
        }
        let mut sum = Score::of_cost(0.0);
        let mut likeness = Some(0.0);
        if let Some(factor) = self.factor(tree)
            && self.generator.resize(values, factor)
        {
            sum.resized = factor;
            if !grow(values, &growth, tree) {
                return Score::FAILED;
            }
        }
        sum.size = Size {
            stems: tree.stems.len(),
            leaves: tree.leaves.len() + tree.blossoms.len(),
            knots: tree.knots.len(),
        };
        for number in 0..self.seeds {
            if number > 0 {
                growth.seed = genome.tree_seed.wrapping_add(u64::from(number));
                if !grow(values, &growth, tree) {
                    return Score::FAILED;
                }
            }
            for view in &self.views {
                let (from, frame) = view.placed(&genome.nuisances);
                rasterizer.draw(tree, &from, &frame, Parts::with_foliage(self.foliage), bitmap);
                let agreement = view.compare(bitmap, self.objective, looks, comparisons);
                likeness = likeness.zip(agreement.likeness).map(|(sum, here)| sum + here);
                sum.cost += 1.0 - agreement.value;
                sum.iou += agreement.iou;
                sum.accuracy += agreement.accuracy;
            }
        }
        let pictures = f64::from(self.seeds) * self.views.len() as f64;
        Score {
            cost: sum.cost / pictures,
            iou: sum.iou / pictures,
            accuracy: sum.accuracy / pictures,
            likeness: likeness.map(|sum| sum / pictures),
            ..sum
        }
    }

    /// The direction and the frame of each goal, as `genome` says where they are not known.
    pub(crate) fn placed(&self, genome: &Genome) -> Vec<(View, Frame)> {
        self.views.iter().map(|view| view.placed(&genome.nuisances)).collect()
    }

    /// Grows the trees that `genome` is judged by, as they are, and shows them to `look` one by one;
    /// none if one of them does not grow.
    pub(crate) fn show(
        &self,
        genome: &Genome,
        foliage: bool,
        mut look: impl FnMut(&Tree, &mut Rasterizer),
    ) -> Option<()> {
        self.with_memory(|memory| {
            let EvalWorkspace { params, tree, workspace, fine, .. } = memory;
            params.set(&genome.values).ok()?;
            for number in 0..self.seeds {
                let growth = Growth {
                    seed: genome.tree_seed.wrapping_add(u64::from(number)),
                    limits: self.limits,
                    foliage: if foliage { Foliage::All } else { Foliage::None },
                    parallel: false,
                };
                self.generator.grow(params, &growth, workspace, tree).ok()?;
                look(tree, fine);
            }
            Some(())
        })
    }

    /// Likeness and intersection over union of `picture` with goal number `view`.
    pub(crate) fn resemblance(&self, view: usize, picture: &Bitmap) -> (f64, f64) {
        self.with_memory(|memory| {
            let view = &self.views[view];
            let agreement = view.compare(picture, Objective::Likeness, true, &mut memory.comparisons);
            (agreement.value, agreement.iou)
        })
    }

    /// How much larger `tree` has to be for the height that it should have, if it is not so already.
    fn factor(&self, tree: &Tree) -> Option<f64> {
        self.height?;
        self.factor_for(height_of(tree, self.foliage))
    }

    /// How much larger a tree of `height` metres has to be, if it is not right already.
    pub(crate) fn factor_for(&self, height: f64) -> Option<f64> {
        let Height { goal, tolerance } = self.height?;
        let factor = goal / height;
        let is_off = (height - goal).abs() > tolerance;
        (is_off && (1.0 / MAX_RESIZING..MAX_RESIZING).contains(&factor)).then_some(factor)
    }

    /// Share of equal pixels that an empty picture has, in 0..=1; the mean over views.
    #[must_use]
    pub fn empty_accuracy(&self) -> f64 {
        let shares = self.views.iter().map(|v| 1.0 - v.goal.ink() as f64 / v.goal.area() as f64);
        shares.sum::<f64>() / self.views.len() as f64
    }

    /// The goals, where they were taken from and how large their trees are, for fingerprints: by name,
    /// so that a run that differs in one of them can say in which.
    pub(crate) fn goal_parts(&self) -> [(&'static str, Vec<u8>); 4] {
        let mut pictures = Vec::new();
        let mut scales = String::new();
        let mut views = String::new();
        for PreparedView { goal, view, frame, unknown, .. } in &self.views {
            pictures.extend(format!("{} {}\n", goal.width(), goal.height()).bytes());
            pictures.extend(goal.words().iter().flat_map(|word| word.to_le_bytes()));
            // What is asked for is the tree's height; the scale follows from it and the picture.
            let top = goal.ink_box().map_or(0, |(_, top, _, _)| top);
            let height = (frame.ground_row - f64::from(top)) * frame.meters_per_pixel;
            scales += &format!("{height:.6}\n");
            views += &format!("{view:?} {unknown:?} {:?} {:?}\n", frame.axis_column, frame.ground_row);
        }
        let leaves = vec![u8::from(self.foliage)];
        [
            ("the goal's picture", pictures),
            ("the tree's height (--height)", scales.into_bytes()),
            ("view, ground or trunk", views.into_bytes()),
            ("leaves (--leaves)", leaves),
        ]
    }
}

/// Metres from the ground to the highest knot or, with `foliage`, middle line of a leaf: the height to a
/// pixel or two, at a fraction of the price of [`pleach_tree::stats::Bounds`].
pub(crate) fn height_of(tree: &Tree, foliage: bool) -> f64 {
    let knots = tree.knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max);
    if !foliage {
        return knots;
    }
    let leaves = tree.leaves.iter().chain(&tree.blossoms);
    let top = |leaf: &Leaf| leaf.position.z + leaf.along.z.max(0.0);
    knots.max(f64::from(leaves.map(top).fold(0.0, f32::max)))
}

/// What is measured of one silhouette against one goal, each in 0..=1.
struct Agreement {
    /// Share of equal pixels.
    accuracy: f64,
    /// Intersection over union of the ink, pixel by pixel.
    iou: f64,
    /// What the objective makes large.
    value: f64,
    /// Likeness, where it was looked at.
    likeness: Option<f64>,
}

impl PreparedView {
    /// From where the picture was taken, and its frame.
    fn placed(&self, nuisances: &[f64]) -> (View, Frame) {
        let own = nuisances.get(self.first..).unwrap_or_default();
        let placement = self.unknown.placement(&self.view, own);
        (placement.view(&self.view), placement.frame(&self.frame))
    }

    fn compare(
        &self,
        bitmap: &Bitmap,
        objective: Objective,
        looks: bool,
        memory: &mut Comparisons,
    ) -> Agreement {
        let overlaps = self.prepared.overlaps(bitmap, &mut memory.overlaps);
        let accuracy = 1.0 - overlaps.differing as f64 / self.goal.area() as f64;
        let iou = overlaps.iou();
        let looks = looks || objective.looks();
        let likeness = looks.then(|| self.likeness(bitmap, memory));
        let alike = likeness.unwrap_or_default();
        let value = match objective {
            Objective::Accuracy => accuracy,
            Objective::Iou => iou,
            Objective::Blend => blend(&overlaps),
            Objective::Likeness => alike,
            Objective::Balance => f64::midpoint(blend(&overlaps), alike),
        };
        Agreement { accuracy, iou, value, likeness }
    }

    fn likeness(&self, bitmap: &Bitmap, memory: &mut Comparisons) -> f64 {
        let descriptor = Descriptor::of(bitmap, &mut memory.likeness);
        self.descriptor.compare(&descriptor).value()
    }
}

/// The weighted mean of overlaps over cell sizes.
fn blend(overlaps: &Overlaps) -> f64 {
    // `pyramid` goes from cells of 2 pixels up; the weights from 32 down.
    let scales = overlaps.pyramid.iter().rev().copied().chain([overlaps.iou()]);
    let (mut sum, mut total) = (0.0, 0.0);
    for (weight, overlap) in BLEND.iter().zip(scales) {
        sum += weight * overlap;
        total += weight;
    }
    sum / total
}

impl Evaluate for Evaluator {
    fn scores(&self, genomes: &[Genome], most: Size) -> Vec<Score> {
        genomes
            .par_iter()
            // Trees differ a hundredfold in cost: each is a piece of work of its own.
            .with_max_len(1)
            .map(|genome| self.with_memory(|memory| self.evaluate_within(genome, most, memory, false)))
            .collect()
    }

    fn likeness(&self, genome: &Genome) -> Option<f64> {
        self.evaluate_and_look(genome).likeness
    }
}
