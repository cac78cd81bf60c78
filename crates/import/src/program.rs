//! The programs whose species are read.

/// A program whose species are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Program {
    /// Hewitt's add-on for Blender.
    TreeGen,
    /// The add-on that came with Blender.
    Sapling,
    /// Diestel's program in Java.
    Arbaro,
    /// Greenheck's library of trees for the browser.
    EzTree,
}

impl Program {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::TreeGen => "tree-gen",
            Self::Sapling => "Sapling",
            Self::Arbaro => "Arbaro",
            Self::EzTree => "ez-tree",
        }
    }
}
