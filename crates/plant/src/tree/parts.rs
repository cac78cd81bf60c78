//! Which parts of a tree a picture, a mesh or a measurement takes in.

use super::StemKind;
use std::ops::BitOr;

/// Which leaves are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Foliage {
    /// Every leaf and blossom.
    #[default]
    All,
    /// Stems only.
    None,
}

/// A set of kinds of parts: `Parts::STEMS | Parts::LEAVES`.
///
/// Everything that looks at a tree takes one, so that pictures, meshes, bounds and heights agree on
/// what the tree is. The default is [`Parts::LEAFY`]: all that is seen above the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Parts(u8);

impl Parts {
    /// Trunks, branches and twigs; no roots.
    pub const STEMS: Self = Self(1);
    /// Leaves.
    pub const LEAVES: Self = Self(1 << 1);
    /// Blossoms.
    pub const BLOSSOMS: Self = Self(1 << 2);
    /// Closed surfaces of foliage.
    pub const BLOBS: Self = Self(1 << 3);
    /// Stems of [`StemKind::Root`].
    pub const ROOTS: Self = Self(1 << 4);
    /// Leaves, blossoms and blobs.
    pub const FOLIAGE: Self = Self(Self::LEAVES.0 | Self::BLOSSOMS.0 | Self::BLOBS.0);
    /// A tree without foliage: its stems.
    pub const BARE: Self = Self::STEMS;
    /// Stems and foliage: everything but roots.
    pub const LEAFY: Self = Self(Self::STEMS.0 | Self::FOLIAGE.0);
    /// Everything, roots included.
    pub const ALL: Self = Self(Self::LEAFY.0 | Self::ROOTS.0);

    /// [`Parts::LEAFY`] or [`Parts::BARE`].
    #[must_use]
    pub const fn with_foliage(foliage: bool) -> Self {
        if foliage { Self::LEAFY } else { Self::BARE }
    }

    /// Whether every part of `other` is among these.
    #[must_use]
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// Whether stems of this kind are among these.
    #[must_use]
    pub const fn has_stem(self, kind: StemKind) -> bool {
        self.contains(match kind {
            StemKind::Root => Self::ROOTS,
            StemKind::Trunk | StemKind::Branch | StemKind::Fork => Self::STEMS,
        })
    }
}

impl Default for Parts {
    /// [`Parts::LEAFY`].
    fn default() -> Self {
        Self::LEAFY
    }
}

impl From<Foliage> for Parts {
    /// [`Parts::LEAFY`] or [`Parts::BARE`].
    fn from(foliage: Foliage) -> Self {
        match foliage {
            Foliage::All => Self::LEAFY,
            Foliage::None => Self::BARE,
        }
    }
}

impl BitOr for Parts {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_asked_for() {
        assert!(!Parts::default().has_stem(StemKind::Root) && Parts::ALL.has_stem(StemKind::Root));
        assert!(Parts::BARE.has_stem(StemKind::Fork) && !Parts::FOLIAGE.has_stem(StemKind::Trunk));
        assert!(!Parts::BARE.contains(Parts::LEAVES) && Parts::LEAFY.contains(Parts::FOLIAGE));
        assert_eq!(Parts::STEMS | Parts::FOLIAGE, Parts::with_foliage(true));
    }
}
