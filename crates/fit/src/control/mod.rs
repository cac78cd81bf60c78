//! What surrounds a fit: its caller's clock and stop flag, its budget, its observers.

mod budget;
mod cost;
mod handle;
mod history;
pub(crate) mod interrupt;
mod observer;
mod outcome;
mod prepared;

pub(crate) use budget::Spent;
pub use budget::{Budget, Clock, StopReason};
pub use cost::{CostModel, Reserve};
pub use handle::{CheckpointSettings, Control};
pub use history::{COLUMNS, Column, Row};
pub use interrupt::Until;
pub use observer::{Observer, Progress};
pub use outcome::Outcome;
pub use prepared::PreparedSearch;
