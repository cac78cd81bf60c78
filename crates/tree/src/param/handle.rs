//! The few parameters that a person who shapes a tree wants first, by words of their own.

use serde::ser::SerializeStruct as _;
use serde::{Serialize, Serializer};

/// What a number does to a tree, in a word that anyone has who draws trees. Generators say which of their numbers are such
/// handles; each has at most one number for a handle.
///
/// The order is that in which they are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Handle {
    /// How tall the tree is.
    Height,
    /// The outline of the crown.
    CrownShape,
    /// How wide the crown is.
    CrownWidth,
    /// How high the lowest branches stand.
    BareTrunk,
    /// How thick the trunk is.
    Trunk,
    /// How many branches there are.
    Density,
    /// How far branches stand off the trunk.
    Spread,
    /// How far branches rise or, below the middle of its range, hang.
    Rise,
    /// How far the trunk leans.
    Lean,
    /// How many leaves there are.
    Leaves,
    /// How large a leaf is.
    LeafSize,
}

impl Handle {
    /// All of them, in order.
    pub const ALL: [Self; 11] = [
        Self::Height,
        Self::CrownShape,
        Self::CrownWidth,
        Self::BareTrunk,
        Self::Trunk,
        Self::Density,
        Self::Spread,
        Self::Rise,
        Self::Lean,
        Self::Leaves,
        Self::LeafSize,
    ];

    /// Its name, in small letters.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Height => "height",
            Self::CrownShape => "crown shape",
            Self::CrownWidth => "crown width",
            Self::BareTrunk => "bare trunk",
            Self::Trunk => "trunk thickness",
            Self::Density => "density",
            Self::Spread => "spread",
            Self::Rise => "droop or rise",
            Self::Lean => "lean",
            Self::Leaves => "leaves",
            Self::LeafSize => "leaf size",
        }
    }
}

/// Its `name`, and its `order` among the others, from 0.
impl Serialize for Handle {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let order = Self::ALL.iter().position(|one| one == self);
        let mut both = serializer.serialize_struct("Handle", 2)?;
        both.serialize_field("name", self.name())?;
        both.serialize_field("order", &order)?;
        both.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_are_listed_in_order() {
        assert!(Handle::ALL.is_sorted());
        assert_eq!(Handle::ALL.len(), Handle::LeafSize as usize + 1);
    }
}
