//! A fit of a goal as the program makes it: where it begins, which species take part, and how its time is
//! shared out. `pleach fit` and the Python package are made of this, so that the same goal and the same options
//! give the same bits in both.

mod known;
mod origin;
mod shares;

pub use known::{draw, library, library_with};
pub use origin::{Origin, has_individuals, plan, usual_start};
pub use shares::{DRAWING, Shares};

use std::time::Duration;

/// What a fit takes where neither its time nor its trees are bounded.
pub const USUAL_TIME: Duration = Duration::from_secs(60);
