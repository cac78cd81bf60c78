//! The cost of one individual: grow its tree, draw it, compare it with the goals.

mod evaluate;
mod fine;
mod grow;
mod height;
mod idle;
mod measured;
mod silhouette;
mod viewpoint;

pub use evaluate::Evaluate;
pub(crate) use fine::{FineSilhouette, side_for};
pub use grow::EvalWorkspace;
pub(crate) use height::height_of;
pub use measured::{MeasuredGoal, MeasuredMemory, MeasuredSilhouette};
pub(crate) use silhouette::{Buffers, blend};
pub use silhouette::{Silhouette, SilhouetteGoal, SilhouetteMemory};

use crate::problem::{
    Agreement, AnyEvidence, FitProblem, Genome, GoalView, Objective, PlacedTree, PreparedEvidence,
    ProblemError, Score, Size, Terms,
};
use height::GoalHeight;
use idle::{AtWork, IdleThreads};
use pleach_silhouette::{Frame, Rasterizer, View};
use pleach_tree::{Foliage, Generator, Growth, Helpers, Limits, Tree};
use rayon::prelude::*;
use std::num::NonZeroU32;
use std::sync::{Arc, Mutex, PoisonError};
use viewpoint::Viewpoint;

/// Scores individuals against the goals of a problem. Shared between threads.
#[derive(Debug)]
pub struct Evaluator {
    generator: Arc<dyn Generator>,
    goals: Arc<[PreparedGoal]>,
    foliage: Foliage,
    objective: Objective,
    limits: Limits,
    /// Height of the first goal, and the height that trees are resized to.
    goal_height: Option<GoalHeight>,
    height: Option<GoalHeight>,
    /// Share of equal pixels of an empty picture.
    empty_accuracy: f64,
    /// Trees per individual.
    seeds: u32,
    /// Who helps in place of the idle threads of rayon's pool.
    helpers: Option<Arc<dyn Helpers>>,
    pool: Mutex<Vec<EvalWorkspace>>,
}

/// A goal as trees are compared with it.
#[derive(Debug)]
struct PreparedGoal {
    viewpoint: Viewpoint,
    evidence: Box<dyn PreparedEvidence>,
}

impl Evaluator {
    /// Prepares the goals of `problem`.
    ///
    /// # Errors
    /// See [`ProblemError`].
    pub fn new(problem: &FitProblem, objective: Objective, limits: Limits) -> Result<Self, ProblemError> {
        problem.check()?;
        let prepare = |(viewpoint, goal): (Viewpoint, &GoalView)| {
            let evidence = goal.evidence.clone().unwrap_or_else(|| AnyEvidence::new(Silhouette));
            PreparedGoal { viewpoint, evidence: evidence.prepare(&goal.goal) }
        };
        let empty = problem.goals.iter().map(|goal| 1.0 - goal.goal.ink() as f64 / goal.goal.area() as f64);
        Ok(Self {
            generator: Arc::clone(&problem.start.generator),
            goals: Viewpoint::from_problem(problem).into_iter().zip(&problem.goals).map(prepare).collect(),
            foliage: problem.foliage,
            objective,
            limits,
            goal_height: GoalHeight::new(&problem.goals[0]),
            height: None,
            empty_accuracy: empty.sum::<f64>() / problem.goals.len() as f64,
            seeds: 1,
            helpers: None,
            pool: Mutex::default(),
        })
    }

    /// The same for individuals of another generator; shares the prepared goals.
    #[must_use]
    pub(crate) fn with_generator(&self, generator: Arc<dyn Generator>) -> Self {
        let (goals, helpers) = (Arc::clone(&self.goals), self.helpers.clone());
        Self { generator, goals, helpers, pool: Mutex::default(), ..*self }
    }

    /// Scores an individual by the mean over `count` trees, of its tree seed and the following ones, so that
    /// parameters win whose every tree is like the goal, and not one lucky tree.
    #[must_use]
    pub fn with_seeds(self, count: NonZeroU32) -> Self {
        Self { seeds: count.get(), ..self }
    }

    /// Resizes every tree to the height of the first goal's ink before it is compared, if the picture shows it: in a
    /// level view without perspective, with paper above the tree.
    ///
    /// A picture shows the height of its tree to a pixel. A search that has to find it again for
    /// every change of the trunk, or of the branches at its tip, spends most of its trials on that.
    #[must_use]
    pub fn with_height_matching(self) -> Self {
        Self { height: self.goal_height, ..self }
    }

    /// Has `helpers` help with large trees in place of those threads of rayon's pool that have no tree of their own.
    /// Scores are the same.
    #[must_use]
    pub fn with_helpers(self, helpers: Arc<dyn Helpers>) -> Self {
        Self { helpers: Some(helpers), ..self }
    }

    /// Abandons trees that take more than `work` steps or have more than `leaves` leaves.
    #[must_use]
    pub(crate) fn with_limits(self, work: u64, leaves: usize) -> Self {
        let limits = self.limits;
        let limits = Limits { work: limits.work.min(work), leaves: limits.leaves.min(leaves), ..limits };
        Self { limits, ..self }
    }

    /// Memory for one thread.
    ///
    /// # Panics
    /// If the generator's defaults are not allowed by its own declarations: a mistake there.
    #[must_use]
    pub fn workspace(&self) -> EvalWorkspace {
        EvalWorkspace::new(&*self.generator, self.goals.iter().map(|goal| goal.evidence.memory()).collect())
    }

    /// Grows `genome`'s tree, draws it and scores it; [`Score::INVALID`] if it does not grow.
    ///
    /// On the calling thread alone. Allocates nothing once `memory` has held a tree as large as this one.
    pub fn evaluate(&self, genome: &Genome, memory: &mut EvalWorkspace) -> Score {
        self.evaluate_within(
            genome,
            memory,
            Question { max_size: Size::ANY, terms: self.terms(), helpers: None },
        )
    }

    /// [`Evaluator::evaluate`] in memory that the evaluator keeps for as many threads as have asked at once, and with
    /// the help of those that are idle.
    fn evaluate_helped(&self, genome: &Genome, max_size: Size, terms: Terms) -> Score {
        self.with_memory(|memory| {
            let idle = IdleThreads::beside_this();
            let idle = idle.as_ref().map(|idle| idle as &dyn Helpers);
            let helpers = self.helpers.as_deref().or(idle);
            self.evaluate_within(genome, memory, Question { max_size, terms, helpers })
        })
    }

    /// The terms that the objective needs.
    const fn terms(&self) -> Terms {
        Terms { objective: self.objective, likeness: false }
    }

    /// The score of `genome` with its likeness, whatever the objective is.
    pub(crate) fn evaluate_with_likeness(&self, genome: &Genome) -> Score {
        self.evaluate_helped(genome, Size::ANY, Terms { likeness: true, ..self.terms() })
    }

    /// [`Evaluator::evaluate`] in memory that the evaluator keeps for as many threads as have asked at once. Those of
    /// them that are idle may help.
    pub fn score(&self, genome: &Genome) -> Score {
        self.evaluate_helped(genome, Size::ANY, self.terms())
    }

    fn with_memory<T>(&self, work: impl FnOnce(&mut EvalWorkspace) -> T) -> T {
        let _at_work = AtWork::begin();
        let pool = || self.pool.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = pool().pop();
        let mut memory = taken.unwrap_or_else(|| self.workspace());
        let result = work(&mut memory);
        // The next trees may be small.
        memory.tree.release_spare();
        pool().push(memory);
        result
    }

    /// The mean over seeds and views.
    fn evaluate_within(&self, genome: &Genome, memory: &mut EvalWorkspace, question: Question<'_>) -> Score {
        let own;
        let generator = match &genome.structure {
            None => &*self.generator,
            Some(structure) => {
                let read = self.generator.variation().and_then(|v| v.generator(structure));
                let Some(read) = read else { return Score::INVALID };
                own = read;
                &*own
            }
        };
        let growth = self.growth(genome.tree_seed, self.foliage, question.max_size);
        let mut growth = Growth { helpers: question.helpers, ..growth };
        let Some(Matched { resized, mut magnified }) = self.grow_matched(generator, genome, &growth, memory)
        else {
            return Score::INVALID;
        };
        let size = Size::new(&memory.tree);
        let mut sum = Sum::new();
        for number in 0..self.seeds {
            if number > 0 {
                growth.seed = genome.tree_seed.wrapping_add(u64::from(number));
                if !memory.grow(generator, &growth) {
                    return Score::INVALID;
                }
                magnified = 1.0;
            }
            for number in 0..self.goals.len() {
                sum.add(&self.measure(number, genome, magnified, memory, question));
            }
        }
        Score { size, resized, ..sum.mean(f64::from(self.seeds) * self.goals.len() as f64) }
    }

    fn growth(&self, seed: u64, foliage: Foliage, max_size: Size) -> Growth<'static> {
        let limits = Limits {
            stems: self.limits.stems.min(max_size.stems),
            leaves: self.limits.leaves.min(max_size.leaves),
            knots: self.limits.knots.min(max_size.knots),
            ..self.limits
        };
        Growth { seed, limits, foliage, counts_ahead: true, ..Growth::default() }
    }

    /// Grows `genome`'s tree into `memory` at the goal's height; `None` if it does not grow.
    ///
    /// A third to half of all trees are resized, and most trees of searched structures; growing them again would take
    /// up to half of the time. So a tree that is nearly right is drawn larger or smaller instead: its branches are
    /// then off by what does not grow in proportion, such as the minimum thickness of twigs, which is too little to
    /// be seen.
    fn grow_matched(
        &self,
        generator: &dyn Generator,
        genome: &Genome,
        growth: &Growth,
        memory: &mut EvalWorkspace,
    ) -> Option<Matched> {
        memory.values.clone_from(&genome.values);
        if !memory.grow(generator, growth) {
            return None;
        }
        let wanted = self.height.and_then(|goal| goal.factor(height_of(&memory.tree, self.foliage)));
        let Some(factor) = wanted.filter(|&factor| generator.resize(&mut memory.values, factor)) else {
            return Some(Matched { resized: 1.0, magnified: 1.0 });
        };
        let is_flat = || self.goals.iter().all(|goal| goal.viewpoint.is_orthographic());
        let is_near = (1.0 / NEAR..NEAR).contains(&factor) && memory.has_one_trunk();
        let in_proportion = genome.structure.is_some() && generator.grows_in_proportion();
        if (is_near || in_proportion) && is_flat() {
            return Some(Matched { resized: factor, magnified: factor });
        }
        memory.grow(generator, growth).then_some(Matched { resized: factor, magnified: 1.0 })
    }

    /// Compares the tree in `memory`, `magnified` times as large, with goal `number`.
    fn measure(
        &self,
        number: usize,
        genome: &Genome,
        magnified: f64,
        memory: &mut EvalWorkspace,
        question: Question<'_>,
    ) -> Agreement {
        let EvalWorkspace { tree, evidence: memories, .. } = memory;
        let placed = self.standing(number, genome, magnified, tree);
        let placed = PlacedTree { helpers: question.helpers, ..placed };
        self.goals[number].evidence.measure(&placed, question.terms, &mut *memories[number])
    }

    /// `tree`, `magnified` times as large, as it stands in goal `number`.
    fn standing<'a>(&self, number: usize, genome: &Genome, magnified: f64, tree: &'a Tree) -> PlacedTree<'a> {
        let (view, mut frame) = self.goals[number].viewpoint.placed(&genome.nuisances);
        frame.meters_per_pixel /= magnified;
        PlacedTree { tree, view, frame, parts: self.foliage.into(), helpers: None }
    }

    /// The direction and the frame of each goal; unknowns are as in `genome`.
    pub(crate) fn placed(&self, genome: &Genome) -> Vec<(View, Frame)> {
        self.goals.iter().map(|goal| goal.viewpoint.placed(&genome.nuisances)).collect()
    }

    /// Grows the trees of all seeds of `genome`, as they are, and calls `look` with each; `None` if one of them does
    /// not grow.
    pub(crate) fn show(
        &self,
        genome: &Genome,
        foliage: Foliage,
        mut look: impl FnMut(&Tree, &mut Rasterizer),
    ) -> Option<()> {
        self.with_memory(|memory| {
            memory.values.clone_from(&genome.values);
            for number in 0..self.seeds {
                let seed = genome.tree_seed.wrapping_add(u64::from(number));
                let growth = self.growth(seed, foliage, Size::ANY);
                memory.grow(&*self.generator, &growth).then_some(())?;
                look(&memory.tree, &mut memory.fine);
            }
            Some(())
        })
    }

    /// Grows `genome`'s own tree at the goal's height, and calls `look` with it, the factor by which it is still too
    /// small, and the direction of each goal; `None` if it does not grow.
    pub(crate) fn show_matched(&self, genome: &Genome, look: impl FnOnce(&Tree, f64, &[View])) -> Option<()> {
        let views: Vec<View> = self.placed(genome).into_iter().map(|(view, _)| view).collect();
        self.with_memory(|memory| {
            let growth = self.growth(genome.tree_seed, self.foliage, Size::ANY);
            let Matched { magnified, .. } = self.grow_matched(&*self.generator, genome, &growth, memory)?;
            look(&memory.tree, magnified, &views);
            Some(())
        })
    }

    /// Grows `genome`'s own tree at the goal's height, calls `look` with it as it stands in each goal, and returns its
    /// values at that height; `None` if it does not grow.
    pub fn pictures(&self, genome: &Genome, mut look: impl FnMut(&PlacedTree<'_>)) -> Option<Vec<f64>> {
        self.with_memory(|memory| {
            let growth = self.growth(genome.tree_seed, self.foliage, Size::ANY);
            let Matched { magnified, .. } = self.grow_matched(&*self.generator, genome, &growth, memory)?;
            for number in 0..self.goals.len() {
                look(&self.standing(number, genome, magnified, &memory.tree));
            }
            Some(memory.values.clone())
        })
    }

    /// The factor that brings a tree of `height` metres to the goal's height; `None` within the tolerance.
    pub(crate) fn factor_for(&self, height: f64) -> Option<f64> {
        self.height?.factor(height)
    }

    /// Share of equal pixels that an empty picture has, in 0..=1; the mean over views.
    #[must_use]
    pub const fn empty_accuracy(&self) -> f64 {
        self.empty_accuracy
    }
}

/// What is asked about a tree, and who may help.
#[derive(Clone, Copy)]
struct Question<'a> {
    max_size: Size,
    terms: Terms,
    helpers: Option<&'a dyn Helpers>,
}

/// Trees that would be resized by less than this factor are drawn at another scale instead.
const NEAR: f64 = 1.15;

/// How a tree was brought to the height of its goal.
struct Matched {
    /// The factor on its sizes.
    resized: f64,
    /// The factor by which the tree that was grown is still too small.
    magnified: f64,
}

/// The sum of the terms over several pictures.
struct Sum {
    cost: f64,
    iou: f64,
    accuracy: f64,
    /// `None` if one of the pictures has none.
    likeness: Option<f64>,
}

impl Sum {
    const fn new() -> Self {
        Self { cost: 0.0, iou: 0.0, accuracy: 0.0, likeness: Some(0.0) }
    }

    fn add(&mut self, of: &Agreement) {
        self.likeness = self.likeness.zip(of.likeness).map(|(sum, here)| sum + here);
        self.cost += 1.0 - of.value;
        self.iou += of.iou;
        self.accuracy += of.accuracy;
    }

    fn mean(&self, pictures: f64) -> Score {
        Score {
            iou: self.iou / pictures,
            accuracy: self.accuracy / pictures,
            likeness: self.likeness.map(|sum| sum / pictures),
            ..Score::from_cost(self.cost / pictures)
        }
    }
}

impl Evaluate for Evaluator {
    fn scores(&self, genomes: &[Genome], max_size: Size) -> Vec<Score> {
        let score = |genome: &Genome| self.evaluate_helped(genome, max_size, self.terms());
        // Trees differ a hundredfold in time: each is a task of its own.
        genomes.par_iter().with_max_len(1).map(score).collect()
    }

    fn likeness(&self, genome: &Genome) -> Option<f64> {
        self.evaluate_with_likeness(genome).likeness
    }
}
