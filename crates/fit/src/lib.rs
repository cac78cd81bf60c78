//! Finds the parameters of a procedural tree that make it look like a picture.
//!
//! One call is a whole fit: see [`fit_goal`].
//!
//! | idea | items |
//! | --- | --- |
//! | the problem | [`FitProblem`], [`GoalView`]; unknowns of a picture: [`Unknown`], [`Placement`] |
//! | the search space | [`Genome`], [`Score`], [`SearchSpace`], [`Gene`] |
//! | the place of the tree in its picture | [`Accuracy`], [`register`] |
//! | a whole fit | [`fit_goal`], [`GoalSettings`], [`Fitted`] |
//! | the known species that a goal looks like | [`first_guess`], [`GuessLibrary`], [`Candidate`] |
//! | a fit driven from outside, batch by batch | [`Stepwise`], [`evaluator`] |
//! | the search alone | [`fit`], [`FitSettings`], [`Control`], [`Outcome`] |
//! | the cost of an individual | [`Objective`], [`Evaluator`]: grow, draw, score, without allocating; by other evidence than silhouettes: [`Evidence`] |
//! | optimisers | [`Optimizer`], [`Method`], [`Search`]; with argmin: [`ArgminSolver`] |
//! | this very tree | [`individuals`]: draws of single stems, [`IndividualSettings`], [`FoundIndividual`] |
//! | which trees there are, and what a picture says about the numbers of its tree | [`Prior`], [`PosteriorModel`] |
//! | assessment of a result | [`Assessment`], [`fresh_seeds`], [`profile()`], [`Verdict`] |
//! | watching and stopping | [`Observer`], [`Budget`], [`StopReason`], [`Clock`]; ending on time: [`Deadline`], [`Reserve`] |
//!
//! # Invariants
//!
//! The crate knows no generator by name: a fit sees [`pleach_tree::Tree`], [`pleach_tree::Generator`] and
//! `pleach_silhouette`. It does not read the clock, the environment or the operating system's randomness, and it
//! prints nothing. The same problem, settings and seed give the same bits on any number of threads, interrupted and
//! resumed or not.
//!
//! Files of this crate use each other in one direction, without circles.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

// In the order in which a goal meets them.

/// The assessment of a result: other seeds, number by number, beside other species.
mod assess;
/// The cost of one individual: grow its tree, draw it, compare it with the goals.
mod evaluator;
/// All of these stages in one call, or step by step.
mod goal;
/// The first guess: the known species that the goal looks like, as the start of the search.
mod guess;
/// This very tree: draws of single stems.
mod individual;
/// The optimisers: which individuals to try next.
mod method;
/// Answers with intervals: what a picture says about the numbers of its tree.
mod posterior;
/// The numbers of a tree from its picture, by regression.
mod predictor;
/// What is fitted: pictures of a tree, and what is unknown of them.
mod problem;
/// The place of a tree in its picture, to a small part of a pixel: before the search, and for its result.
mod registration;
/// The search of a fit: within its budget, on all threads, saved to checkpoints.
mod run;
/// An optimiser at work in a space: asked for individuals, told their scores.
mod search;
/// What is searched: the free numbers, their ranges, and the draws of searches.
mod space;

/// What the caller has in hand at every stage: clock, stop flag, budget, observers.
mod control;
/// The errors of all stages.
mod error;
#[cfg(test)]
mod testing;

pub use assess::{
    Assessment, AssessmentSettings, FreshSeeds, Identifiability, KindVerdict, MIN_VERDICT_SPAN, Mismatch,
    PROFILE_STEPS, Profile, Spread, Verdict, fresh_seeds, profile, with_expected_numbers,
};
pub use control::{
    Budget, COLUMNS, CheckpointSettings, Clock, Column, Control, CostModel, Observer, Outcome,
    PreparedSearch, Progress, Reserve, Row, StopReason, Until,
};
pub use error::{FitError, ObserverError};
pub use evaluator::{
    EvalWorkspace, Evaluate, Evaluator, MeasuredGoal, MeasuredMemory, MeasuredSilhouette, Silhouette,
    SilhouetteGoal, SilhouetteMemory,
};
pub use goal::{
    Asked, Deadline, Fitted, GoalSettings, Guessing, Stepwise, StepwiseRace, fit_goal, fit_goal_with,
};
pub use guess::{
    Candidate, Contradictions, Drawings, DrawingsError, FirstGuess, Guess, GuessLibrary, GuessSettings, Leg,
    RaceCriterion, RaceSettings, Reference, References, Runner, first_guess,
};
pub use individual::{FoundIndividual, IndividualProgress, IndividualSettings, individuals};
pub use method::{
    AnyMethod, Cma, CmaSettings, Evolution, EvolutionSettings, Hewitt, HewittSettings, Merge, Method,
    MethodSettings, Optimizer, Random, RandomSettings, Rules, RulesSettings, SETTINGS, Setting, SettingKind,
    Shade, ShadeSettings, Start, UnknownOptimizer,
};
pub use posterior::{
    HeldOut, Interval, NoSample, Posterior, PosteriorModel, PosteriorNumber, PosteriorSettings, Prior,
};
pub use predictor::{Answer, LearntParts, PredictorError, Predictors};
pub use problem::{
    Accuracy, Agreement, AnyEvidence, Azimuth, Evidence, FitProblem, Genome, GoalView, MAX_OFFSET, MAX_SCALE,
    Nuisance, Objective, PlacedTree, Placement, ProblemError, ROUGH_AZIMUTH, Score, Scored, Size, Terms,
    Unknown, UnknownObjective, placements,
};
pub use registration::{HEAVY, Steps, register};
pub use run::{
    BodyProblem, CheckpointError, FIT_LIMITS, FitSettings, evaluator, fit, is_checkpoint, settled,
};
pub use search::{ArgminSolver, AskTell, Chunk, EmptyChunk, FitState, Search, SearchState};
pub use space::{Freedom, Gene, PRIOR, Place, SearchSpace, SpaceError, Stream, TreeSeed, check_freedom};
