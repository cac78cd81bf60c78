//! Optimisers: which individuals to try next, given the scores of earlier ones.
//!
//! A [`Method`] only asks and tells; evaluation is the caller's: through [`crate::Search`], or by hand in a loop. Every method is a plain value: its whole state is written
//! to checkpoints, and its draws are those of [`crate::Stream`], addressed by generation.
//!
//! | method | idea | source |
//! | --- | --- | --- |
//! | [`Evolution`] | sparse steps in an elitist population, restarted: the default | |
//! | [`Cma`] | a normal distribution that learns which way to go: CMA-ES with margin | Hansen 2016; Hamano and others 2022 |
//! | [`Shade`] | differential evolution with learned factors | Tanabe and Fukunaga 2013 |
//! | [`Random`] | lists drawn independently: the floor to compare with | |
//! | [`Rules`] | structures and their numbers: genetic programming | Koza 1993; Jacob 1994 |
//! | [`Hewitt`] | copies of a base with one parameter changed each; the two fittest merge to the next base | Hewitt 2017, §3.3.2 |

mod cma;
mod evolution;
mod first;
mod hewitt;
mod members;
mod optimizer;
mod random;
mod rules;
mod setting;
mod shade;
mod start;
mod traits;

pub use cma::{Cma, CmaSettings};
pub use evolution::{Evolution, EvolutionSettings};
pub use hewitt::{Hewitt, HewittSettings, Merge};
pub(crate) use members::{is_individual, only_batch, ranking};
pub use optimizer::{AnyMethod, Optimizer, UnknownOptimizer};
pub use random::{Random, RandomSettings};
pub use rules::{Rules, RulesSettings};
pub use setting::{SETTINGS, Setting, SettingKind};
pub use shade::{Shade, ShadeSettings};
pub use start::Start;
pub use traits::{Method, MethodSettings};
