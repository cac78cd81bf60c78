//! Parameters that are one of a few words.

/// Whether a tree is flat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Dimensions {
    /// All of it lies in the plane y = 0.
    Plane,
    /// Branches turn about their parents.
    Space,
}

impl Dimensions {
    pub(crate) const NAMES: [&str; 2] = ["plane", "space"];

    pub(crate) fn from_number(number: f64) -> Self {
        if number < 1.5 { Self::Plane } else { Self::Space }
    }
}

/// How radii of daughters follow from their parent's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ThicknessRule {
    /// Divided by a factor in each generation.
    Factor,
    /// Together the daughters have the cross-section of their parent, each in proportion to its
    /// length squared: Leonardo da Vinci's rule (Coffey 2025, §2).
    Area,
}

impl ThicknessRule {
    pub(crate) const NAMES: [&str; 2] = ["factor", "area"];

    pub(crate) fn from_number(number: f64) -> Self {
        if number < 1.5 { Self::Factor } else { Self::Area }
    }
}
