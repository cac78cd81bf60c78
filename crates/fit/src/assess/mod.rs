//! The assessment of a result: on other seeds, number by number, and beside other species.

mod assessor;
mod best_kind;
mod expected;
mod finer_leaves;
mod fresh;
mod profile;
mod substitutes;
mod verdict;

pub(crate) use assessor::Assessor;
pub use assessor::{Assessment, AssessmentSettings};
pub(crate) use best_kind::best_kind;
pub use expected::with_expected_numbers;
pub(crate) use finer_leaves::finer_leaves;
pub use fresh::{FreshSeeds, Spread, fresh_seeds};
pub use profile::{Identifiability, PROFILE_STEPS, Profile, profile};
pub use verdict::{KindVerdict, MIN_VERDICT_SPAN, Mismatch, Verdict};
