//! Finds the parameters of a procedural tree that make it look like a picture.
//!
//! One call is a whole fit: see [`fit_goal`].
//!
//! | idea | items |
//! | --- | --- |
//! | what is fitted | [`FitProblem`], [`GoalView`]; what is not known of a picture: [`Unknown`], [`Placement`] |
//! | what is searched | [`Genome`], [`Score`], [`SearchSpace`], [`Gene`] |
//! | where the tree stands in its picture | [`Accuracy`], [`register`] |
//! | a whole fit | [`fit_goal`], [`GoalSettings`], [`Fitted`] |
//! | the known species that a goal looks like | [`first_guess`], [`GuessLibrary`], [`Candidate`] |
//! | a fit driven from outside, batch by batch | [`Stepwise`], [`evaluator`] |
//! | the search alone | [`fit`], [`FitSettings`], [`Control`], [`Outcome`] |
//! | what is made small | [`Objective`], [`Evaluator`]: grow, draw, score, without allocating |
//! | optimisers | [`Optimizer`], [`Method`], [`Search`]; with argmin: [`ArgminSolver`] |
//! | this very tree | [`individuals`]: draws of single stems, [`IndividualSettings`], [`FoundIndividual`] |
//! | what a result is worth | [`fresh_seeds`], [`profile()`], [`Verdict`] |
//! | watching and stopping | [`Observer`], [`Budget`], [`StopReason`], [`Clock`]; ending on time: [`Ending`], [`Kept`] |
//!
//! # Invariants
//!
//! No generator is known here by name, and no pixel: a fit sees [`pleach_tree::Tree`],
//! [`pleach_tree::Generator`] and `pleach_silhouette`. Nothing here reads the clock, the environment
//! or the operating system's randomness, and nothing prints. The same problem, settings and seed
//! give the same bits on any number of threads, interrupted and resumed or not.
//!
//! Files of this crate use each other in one direction: problem, space, method, search, evaluator, run.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod begun;
mod budget;
mod cancellable;
mod checkpoint;
mod control;
mod driver;
mod ending;
mod error;
mod evaluate;
mod evaluator;
mod finalists;
mod fingerprint;
mod fit_goal;
mod flight;
mod fresh;
mod genome;
mod guess;
mod history;
mod individual;
mod instead;
mod judged;
mod method;
mod nuisance;
mod objective;
mod observer;
mod optimizer;
mod problem;
mod profile;
mod register;
mod run;
mod search;
mod setting;
mod settings;
mod solver;
mod space;
mod stepwise;
mod stream;
#[cfg(test)]
mod testing;
mod verdict;

pub use begun::Begun;
pub use budget::{Budget, Clock, StopReason};
pub use cancellable::Until;
pub use checkpoint::{BodyProblem, CheckpointError, is_checkpoint};
pub use control::{CheckpointSettings, Control, Outcome};
pub use ending::{Aftermath, Ending, Kept};
pub use error::{FitError, ObserverError};
pub use evaluate::Evaluate;
pub use evaluator::{EvalWorkspace, Evaluator};
pub use fit_goal::{Fitted, GoalSettings, Guessing, fit_goal, fit_goal_with};
pub use fresh::{FreshSeeds, Spread, fresh_seeds};
pub use genome::{Genome, Score, Scored, Size};
pub use guess::{
    Candidate, Drawings, DrawingsError, FirstGuess, Guess, GuessLibrary, GuessSettings, RaceSettings,
    Reference, References, Runner, first_guess,
};
pub use history::{COLUMNS, Column, Row};
pub use individual::{FoundIndividual, IndividualProgress, IndividualSettings, individuals};
pub use judged::{Judged, Judging};
pub use method::{
    Cma, CmaSettings, Evolution, EvolutionSettings, Hewitt, HewittSettings, Merge, Method, MethodSettings,
    Random, RandomSettings, Rules, RulesSettings, Shade, ShadeSettings, Start,
};
pub use nuisance::{Azimuth, MAX_OFFSET, MAX_SCALE, Nuisance, Placement, ROUGH_AZIMUTH, Unknown};
pub use objective::{Objective, UnknownObjective};
pub use observer::{Observer, Progress};
pub use optimizer::{AnyMethod, Optimizer, UnknownOptimizer};
pub use problem::{Accuracy, FitProblem, GoalView, ProblemError, placements};
pub use profile::{Identifiability, PROFILE_STEPS, Profile, profile, reset_unidentified};
pub use register::{HEAVY, Steps, register};
pub use run::{evaluator, fit, settled};
pub use search::{Search, SearchState};
pub use setting::{SETTINGS, Setting, SettingKind};
pub use settings::{FIT_LIMITS, FitSettings};
pub use solver::{ArgminSolver, AskTell, Batch, EmptyBatch, FitState};
pub use space::{Freedom, Gene, PRIOR, Place, SearchSpace, SpaceError, TreeSeed, check_freedom};
pub use stepwise::{Asked, Stepwise};
pub use stream::Stream;
pub use verdict::{Kindred, MIN_VERDICT_SPAN, Off, Verdict};
