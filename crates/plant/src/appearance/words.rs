//! What is said in words: seasons, and how bark is marked.

/// A time of the year.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Season {
    /// Young leaves, full blossom.
    Spring,
    /// Full leaf.
    #[default]
    Summer,
    /// Turning leaves, no blossom.
    Autumn,
    /// Bare, unless the species is evergreen.
    Winter,
}

impl Season {
    /// All four, in the order of the year.
    pub const ALL: [Self; 4] = [Self::Spring, Self::Summer, Self::Autumn, Self::Winter];

    /// Their names, in the same order.
    pub const NAMES: [&'static str; 4] =
        [Self::ALL[0].name(), Self::ALL[1].name(), Self::ALL[2].name(), Self::ALL[3].name()];

    /// The name in files and flags.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Spring => "spring",
            Self::Summer => "summer",
            Self::Autumn => "autumn",
            Self::Winter => "winter",
        }
    }

    /// The season of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|season| season.name() == name)
    }
}

/// How bark is marked in pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BarkPattern {
    /// Furrows along the stem.
    #[default]
    Furrowed,
    /// Pale, with dark level dashes: birch, aspen, cherry.
    Banded,
    /// Rings at even distances: palms, bamboo.
    Ringed,
    /// Nearly even.
    Smooth,
    /// One flat colour on trunks and twigs alike, for stylised trees.
    Plain,
}

impl BarkPattern {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Furrowed, Self::Banded, Self::Ringed, Self::Smooth, Self::Plain];

    /// Their names, in the same order.
    pub const NAMES: [&'static str; 5] = [
        Self::ALL[0].name(),
        Self::ALL[1].name(),
        Self::ALL[2].name(),
        Self::ALL[3].name(),
        Self::ALL[4].name(),
    ];

    /// The name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Furrowed => "furrowed",
            Self::Banded => "banded",
            Self::Ringed => "ringed",
            Self::Smooth => "smooth",
            Self::Plain => "plain",
        }
    }

    /// The pattern of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|pattern| pattern.name() == name)
    }
}
