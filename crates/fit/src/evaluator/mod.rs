//! Grow, draw, score: what a fit does a million times.

mod compare;
mod grow;
mod height;

pub use grow::EvalWorkspace;
pub(crate) use height::height_of;

use crate::evaluate::Evaluate;
use crate::genome::{Genome, Score, Size};
use crate::objective::Objective;
use crate::problem::{FitProblem, ProblemError};
pub(crate) use compare::{Agreement, Comparisons, Likeness, PreparedView, blend};
use height::GoalHeight;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Foliage, Generator, Growth, Limits, Tree};
use rayon::prelude::*;
use std::num::NonZeroU32;
use std::sync::{Arc, Mutex, PoisonError};

/// Scores individuals against the goals of a problem. Shared between threads.
#[derive(Debug)]
pub struct Evaluator {
    generator: Arc<dyn Generator>,
    views: Arc<[PreparedView]>,
    foliage: Foliage,
    objective: Objective,
    limits: Limits,
    /// Height that every tree is resized to; of several seeds, the first.
    height: Option<GoalHeight>,
    /// Trees that an individual is judged by.
    seeds: u32,
    pool: Mutex<Vec<EvalWorkspace>>,
}

impl Evaluator {
    /// Prepares the goals of `problem`.
    ///
    /// # Errors
    /// See [`ProblemError`].
    pub fn new(problem: &FitProblem, objective: Objective, limits: Limits) -> Result<Self, ProblemError> {
        problem.check()?;
        Ok(Self {
            generator: Arc::clone(&problem.start.generator),
            views: PreparedView::of_problem(problem).into(),
            foliage: problem.foliage,
            objective,
            limits,
            height: None,
            seeds: 1,
            pool: Mutex::default(),
        })
    }

    /// The same for individuals of another generator; shares the prepared goals.
    #[must_use]
    pub(crate) fn with_generator(&self, generator: Arc<dyn Generator>) -> Self {
        Self { generator, views: Arc::clone(&self.views), pool: Mutex::default(), ..*self }
    }

    /// Judges an individual by the mean over `count` trees, of its tree seed and of those after it, so
    /// that parameters win of which every tree is like the goal and not a lucky one.
    #[must_use]
    pub fn with_seeds(self, count: NonZeroU32) -> Self {
        Self { seeds: count.get(), ..self }
    }

    /// Has every tree resized to the height of the first goal's ink before it is compared, if that
    /// can be seen: in a level view without perspective, with paper above the tree.
    ///
    /// A picture shows the height of its tree to a pixel. A search that has to find it again for
    /// every change of the trunk, or of the branches at its tip, spends most of its trials on that.
    #[must_use]
    pub fn with_height_matching(self) -> Self {
        Self { height: GoalHeight::seen(&self.views[0]), ..self }
    }

    /// Gives up trees that take more than `work` steps or have more than `leaves` leaves.
    #[must_use]
    pub(crate) fn with_at_most(self, work: u64, leaves: usize) -> Self {
        let Limits { work: most, leaves: most_leaves, .. } = self.limits;
        let limits = Limits { work: most.min(work), leaves: most_leaves.min(leaves), ..self.limits };
        Self { limits, ..self }
    }

    /// Memory for one thread.
    ///
    /// # Panics
    /// If the generator's defaults are not allowed by its own declarations: a mistake there.
    #[must_use]
    pub fn workspace(&self) -> EvalWorkspace {
        EvalWorkspace::new(&*self.generator)
    }

    /// Grows `genome`'s tree, draws it and scores it; [`Score::INVALID`] if it does not grow.
    ///
    /// Allocates nothing once `memory` has held a tree as large as this one.
    pub fn evaluate(&self, genome: &Genome, memory: &mut EvalWorkspace) -> Score {
        self.evaluate_within(genome, Size::ANY, memory, Likeness::IfNeeded)
    }

    /// The score of `genome` with its likeness, whatever the objective is.
    pub(crate) fn evaluate_with_likeness(&self, genome: &Genome) -> Score {
        self.with_memory(|memory| self.evaluate_within(genome, Size::ANY, memory, Likeness::Always))
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
        // The next tree may be small, and the one after it.
        memory.tree.release_spare();
        pool().push(memory);
        result
    }

    /// The mean over seeds and views.
    fn evaluate_within(
        &self,
        genome: &Genome,
        most: Size,
        memory: &mut EvalWorkspace,
        likeness: Likeness,
    ) -> Score {
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
        let mut growth = self.growth(genome.tree_seed, self.foliage, most);
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
            for view in self.views.iter() {
                sum.add(&self.draw_and_compare(view, genome, magnified, memory, likeness));
            }
        }
        Score { size, resized, ..sum.mean(f64::from(self.seeds) * self.views.len() as f64) }
    }

    fn growth(&self, seed: u64, foliage: Foliage, most: Size) -> Growth<'static> {
        let limits = Limits {
            stems: self.limits.stems.min(most.stems),
            leaves: self.limits.leaves.min(most.leaves),
            knots: self.limits.knots.min(most.knots),
            ..self.limits
        };
        Growth { seed, limits, foliage, counts_ahead: true, ..Growth::default() }
    }

    /// Grows `genome`'s tree into `memory` at the height that it should have; none if it does not grow.
    ///
    /// A third to half of all trees are resized, of searched structures most, and growing them again would take up
    /// to half of the time. So a tree that is nearly right is drawn larger or smaller instead: its branches are
    /// then off by what does not grow in proportion, the least thickness of twigs, and not by more than can
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
        let is_flat = || self.views.iter().all(PreparedView::is_orthographic);
        let is_near = (1.0 / NEAR..NEAR).contains(&factor) && memory.has_one_trunk();
        let in_proportion = genome.structure.is_some() && generator.grows_in_proportion();
        if (is_near || in_proportion) && is_flat() {
            return Some(Matched { resized: factor, magnified: factor });
        }
        memory.grow(generator, growth).then_some(Matched { resized: factor, magnified: 1.0 })
    }

    /// Compares the tree in `memory`, `magnified` times as large, with one goal.
    fn draw_and_compare(
        &self,
        view: &PreparedView,
        genome: &Genome,
        magnified: f64,
        memory: &mut EvalWorkspace,
        likeness: Likeness,
    ) -> Agreement {
        let (from, mut frame) = view.placed(&genome.nuisances);
        frame.meters_per_pixel /= magnified;
        let EvalWorkspace { tree, rasterizer, bitmap, comparisons, .. } = memory;
        rasterizer.draw(tree, &from, &frame, self.foliage.into(), bitmap);
        view.compare(bitmap, self.objective, likeness, comparisons)
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

    /// Grows `genome`'s own tree at the height that it is compared at, and shows it to `look` with the factor by
    /// which it is still too small and the direction of each goal; none if it does not grow.
    pub(crate) fn show_matched(&self, genome: &Genome, look: impl FnOnce(&Tree, f64, &[View])) -> Option<()> {
        let views: Vec<View> = self.placed(genome).into_iter().map(|(view, _)| view).collect();
        self.with_memory(|memory| {
            let growth = self.growth(genome.tree_seed, self.foliage, Size::ANY);
            let Matched { magnified, .. } = self.grow_matched(&*self.generator, genome, &growth, memory)?;
            look(&memory.tree, magnified, &views);
            Some(())
        })
    }

    /// Likeness and intersection over union of `picture` with goal number `view`.
    pub(crate) fn resemblance(&self, view: usize, picture: &Bitmap) -> (f64, f64) {
        self.with_memory(|memory| {
            let comparisons = &mut memory.comparisons;
            let agreement =
                self.views[view].compare(picture, Objective::Likeness, Likeness::Always, comparisons);
            (agreement.value, agreement.iou)
        })
    }

    /// How much larger a tree of `height` metres has to be, if it is not right already.
    pub(crate) fn factor_for(&self, height: f64) -> Option<f64> {
        self.height?.factor(height)
    }

    /// Share of equal pixels that an empty picture has, in 0..=1; the mean over views.
    #[must_use]
    pub fn empty_accuracy(&self) -> f64 {
        let shares = self.views.iter().map(|v| 1.0 - v.goal.ink() as f64 / v.goal.area() as f64);
        shares.sum::<f64>() / self.views.len() as f64
    }
}

/// Trees that are to be resized by less than this factor are drawn at another scale instead.
const NEAR: f64 = 1.15;

/// How a tree was brought to the height of its goal.
struct Matched {
    /// The factor on its sizes.
    resized: f64,
    /// The factor by which the tree that was grown is still too small.
    magnified: f64,
}

/// The sum of what was measured in several pictures.
struct Sum {
    cost: f64,
    iou: f64,
    accuracy: f64,
    /// None once one of the pictures has none.
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
    fn scores(&self, genomes: &[Genome], most: Size) -> Vec<Score> {
        let score = |genome: &Genome| {
            self.with_memory(|memory| self.evaluate_within(genome, most, memory, Likeness::IfNeeded))
        };
        // Trees differ a hundredfold in cost: each is a piece of work of its own.
        genomes.par_iter().with_max_len(1).map(score).collect()
    }

    fn likeness(&self, genome: &Genome) -> Option<f64> {
        self.evaluate_with_likeness(genome).likeness
    }
}
