//! What is fitted: a species to the pictures of one tree.

mod evidence;
mod genome;
mod nuisance;
mod objective;

pub(crate) use evidence::PreparedEvidence;
pub use evidence::{Agreement, AnyEvidence, Evidence, PlacedTree, Terms};
pub use genome::{Genome, Score, Scored, Size};
pub use nuisance::{Azimuth, MAX_OFFSET, MAX_SCALE, Nuisance, Placement, ROUGH_AZIMUTH, Unknown};
pub use objective::{Objective, UnknownObjective};

use pleach_reading::Reading;
use pleach_silhouette::{Bitmap, Frame, View};
use pleach_tree::param::SlotError;
use pleach_tree::{Foliage, Species};
use std::sync::Arc;

/// One picture of the goal tree, with its direction, scale and place.
#[derive(Clone, Debug)]
pub struct GoalView {
    /// The picture.
    pub goal: Bitmap,
    /// The direction of view.
    pub view: View,
    /// Scale and place; of the goal's size.
    pub frame: Frame,
    /// Unknowns of view and frame. A problem's first goal should have none.
    pub unknown: Unknown,
    /// Accuracy of the frame.
    pub accuracy: Accuracy,
    /// Scale and offset of the tree against the frame, as found by registration. The frame itself stays as it was
    /// given, since it defines the height of the tree.
    pub registered: Placement,
    /// What trees are compared by; `None`: the silhouette, [`Silhouette`](crate::Silhouette). A first guess,
    /// registration and individuals compare silhouettes in any case.
    pub evidence: Option<AnyEvidence>,
    /// What is in the picture, where somebody knows it better; `None`: what [`Reading`] reads in it. A first guess
    /// passes over trees that contradict it.
    pub reading: Option<Reading>,
}

/// Accuracy of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Accuracy {
    /// Exact: the frame of a picture that pleach has drawn, or of a known camera.
    #[default]
    Exact,
    /// Read off the picture to a pixel or two, as by [`pleach_silhouette::goal::Goal::frame`]. A fit registers it:
    /// see [`register`](crate::register).
    Pixel,
}

impl GoalView {
    /// A picture without unknowns.
    #[must_use]
    pub fn new(goal: Bitmap, view: View, frame: Frame) -> Self {
        Self {
            goal,
            view,
            frame,
            unknown: Unknown::default(),
            accuracy: Accuracy::Exact,
            registered: Placement::KNOWN,
            evidence: None,
            reading: None,
        }
    }

    /// A picture whose frame was read off the picture.
    #[must_use]
    pub fn from_picture(goal: Bitmap, view: View, frame: Frame) -> Self {
        Self { accuracy: Accuracy::Pixel, ..Self::new(goal, view, frame) }
    }
}

/// A species, and the pictures of one tree that its numbers are fitted to.
#[derive(Clone, Debug)]
pub struct FitProblem {
    /// The start of the fit: parameters of its generator are searched, and slots that are not free keep its values. A
    /// [first guess](crate::first_guess) may replace it with another, of any generator.
    pub start: Species,
    /// The pictures, at least one; all count the same.
    pub goals: Vec<GoalView>,
    /// Whether leaves and blossoms are grown and drawn.
    pub foliage: Foliage,
}

/// The reason why trees cannot be compared with a problem's goals.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ProblemError {
    /// There is no goal.
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
    #[error("goal {index} is at {meters_per_pixel} metres per pixel, expected a positive number")]
    Scale {
        /// Which goal, from 0.
        index: usize,
        /// What was given.
        meters_per_pixel: String,
    },
}

impl FitProblem {
    /// Fits `start`, with leaves, to one picture.
    #[must_use]
    pub fn new(start: Species, goal: GoalView) -> Self {
        Self { start, goals: vec![goal], foliage: Foliage::All }
    }

    /// The same problem with other numbers to start from, one for every slot of the generator.
    ///
    /// # Errors
    /// The first value that the generator does not allow.
    pub fn with_values(&self, values: Vec<f64>) -> Result<Self, SlotError> {
        Ok(Self { start: with_values(&self.start, values)?, ..self.clone() })
    }

    /// The species that `genome` is: that of the start with its numbers, its structure and its tree seed,
    /// and with leaves only if the problem has them.
    ///
    /// # Errors
    /// The first value that the generator does not allow; individuals of a fit have none.
    pub fn species(&self, genome: &Genome) -> Result<Species, SlotError> {
        // An individual with a score has grown, so its structure can be read.
        let read = |structure: &String| self.start.generator.variation()?.generator(structure);
        let generator = genome.structure.as_ref().and_then(read);
        let start = Species {
            generator: generator.unwrap_or_else(|| Arc::clone(&self.start.generator)),
            ..self.start.clone()
        };
        let species = with_values(&start, genome.values.clone())?;
        Ok(Species { tree_seed: Some(genome.tree_seed), foliage: self.foliage, ..species })
    }

    /// Checks that trees can be compared with every goal.
    ///
    /// # Errors
    /// See [`ProblemError`].
    pub fn check(&self) -> Result<(), ProblemError> {
        if self.goals.is_empty() {
            return Err(ProblemError::NoGoal);
        }
        for (index, GoalView { goal, frame, .. }) in self.goals.iter().enumerate() {
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
        }
        Ok(())
    }
}

/// `species` with other numbers.
pub(crate) fn with_values(species: &Species, values: Vec<f64>) -> Result<Species, SlotError> {
    Ok(Species { params: species.generator.space().check(values)?, ..species.clone() })
}

/// The placement of each goal in an individual with these nuisances.
#[must_use]
pub fn placements(goals: &[GoalView], nuisances: &[f64]) -> Vec<Placement> {
    let mut rest = nuisances;
    let mut list = Vec::new();
    for GoalView { view, unknown, registered, .. } in goals {
        let (own, others) = rest.split_at(unknown.count().min(rest.len()));
        rest = others;
        list.push(unknown.placement(view, own).and(registered));
    }
    list
}
