//! Finds the parameters of a procedural tree that make it look like a picture.
//!
//! | module | idea |
//! | --- | --- |
//! | [`genome`] | [`Genome`], [`Score`]: what is searched and how good it is |
//! | [`guess`] | [`first_guess`]: the known species that a goal looks like, to start from |
//! | [`space`] | [`SearchSpace`]: which numbers are free, and how far |
//! | [`method`] | optimisers that are asked for individuals and told their scores |
//! | [`search`] | [`Search`]: a method as an argmin solver |
//! | [`nuisance`] | [`Unknown`], [`Placement`]: what is not known of a picture |
//! | [`objective`] | [`Objective`]: what is made small |
//! | [`evaluator`] | [`Evaluator`]: grow, draw, score, without allocating |
//! | [`fresh`] | [`fresh_seeds`]: what the result is worth with other seeds |
//! | [`profile`](mod@profile) | [`profile()`]: how well the goal determines each number |
//! | [`budget`] | [`Budget`], [`StopReason`], [`Clock`] |
//! | [`history`] | one row a generation; [`Observer`] |
//! | [`checkpoint`] | the state of a fit in a file that survives a crash |
//! | [`setting`] | [`Setting`]: what each setting of an optimiser may be |
//! | [`verdict`] | [`Verdict`]: whether a fit is good, in words |
//! | [`run`] | [`fit`]: all of it together |
//!
//! # Invariants
//!
//! No generator is known here by name, and no pixel: a fit sees [`pleach_tree::Tree`],
//! [`pleach_tree::Generator`] and `pleach_silhouette`. Nothing here reads the clock, the environment
//! or the operating system's randomness, and nothing prints. The same problem, settings and seed
//! give the same bits on any number of threads, interrupted and resumed or not.

pub mod budget;
pub mod checkpoint;
pub mod evaluator;
mod exact;
pub mod fingerprint;
pub mod fresh;
pub mod genome;
pub mod guess;
pub mod history;
pub mod method;
pub mod nuisance;
pub mod objective;
pub mod profile;
pub mod run;
pub mod search;
pub mod setting;
pub mod settings;
pub mod space;
mod stoppable;
pub mod stream;
#[cfg(test)]
mod testing;
pub mod verdict;

pub use budget::{Budget, Clock, StopReason};
pub use checkpoint::CheckpointError;
pub use evaluator::{EvalWorkspace, Evaluator, FitProblem, GoalView, ProblemError};
pub use fresh::{FreshSeeds, Spread, fresh_seeds};
pub use genome::{Genome, Score, Scored, Size};
pub use guess::{
    Candidate, FirstGuess, Guess, GuessLibrary, GuessSettings, Reference, References, first_guess,
};
pub use history::{COLUMNS, Column, Observer, Progress, Row};
pub use method::{Method, Start};
pub use nuisance::{Azimuth, Placement, Unknown, placements};
pub use objective::Objective;
pub use profile::{Profile, Seen, profile, put_back_unseen};
pub use run::{CheckpointSettings, Control, FitError, Outcome, fit, settled};
pub use search::{Evaluate, Search, SearchState};
pub use setting::{SETTINGS, Setting, SettingKind};
pub use settings::{AnyMethod, FitSettings, Optimizer};
pub use space::{Freedom, PRIOR, SearchSpace, TreeSeed, check_freedom};
pub use verdict::{Kindred, Off, Verdict};
