//! Where a search starts.

use serde::{Deserialize, Serialize};

/// Where a search starts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Start {
    /// From random parameter lists.
    #[default]
    Random,
    /// From these lists, best guess first, one value per slot. At least one.
    Lists(Vec<Vec<f64>>),
}

impl Start {
    /// The lists to start from, empty for a random start.
    #[must_use]
    pub fn lists(&self) -> &[Vec<f64>] {
        match self {
            Self::Random => &[],
            Self::Lists(lists) => lists,
        }
    }
}
