//! What is said once about a parameter.

use std::borrow::Cow;
use std::fmt;

/// How many numbers a parameter has, and what they are called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// One number.
    Scalar,
    /// Four numbers, one a level: 0 the trunk, 3 the deepest twigs and the leaves.
    PerLevel,
    /// Three numbers: x, y, z.
    Vector,
}

impl Layout {
    /// Number of slots.
    #[must_use]
    pub const fn len(self) -> usize {
        match self {
            Self::Scalar => 1,
            Self::PerLevel => 4,
            Self::Vector => 3,
        }
    }

    /// Always false; a parameter has at least one slot.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        false
    }
}

/// What the numbers of a parameter mean, and which are allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Any number in `min..=max`.
    Real {
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
    },
    /// A whole number in `min..=max`.
    Integer {
        /// Smallest allowed value.
        min: i64,
        /// Largest allowed value.
        max: i64,
    },
    /// One of several named things, numbered from `first`.
    Choice {
        /// The number of the first name.
        first: i64,
        /// The names, in the order of their numbers.
        names: &'static [&'static str],
    },
    /// A number whose sign is a switch between two meanings and whose magnitude is a quantity, in
    /// `-max..=max`. Going through zero changes what the parameter means, not only how much.
    Flagged {
        /// Largest allowed magnitude.
        max: f64,
        /// What a negative value means, in a few words.
        negative: &'static str,
    },
    /// Like [`Kind::Flagged`], whole numbers only.
    FlaggedInteger {
        /// Largest allowed magnitude.
        max: i64,
        /// What a negative value means, in a few words.
        negative: &'static str,
    },
}

impl Kind {
    /// Smallest and largest allowed value.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        match *self {
            Self::Real { min, max } => (min, max),
            Self::Integer { min, max } => (min as f64, max as f64),
            Self::Choice { first, names } => (first as f64, (first + names.len() as i64 - 1) as f64),
            Self::Flagged { max, .. } => (-max, max),
            Self::FlaggedInteger { max, .. } => (-(max as f64), max as f64),
        }
    }

    /// Whether only whole numbers are allowed.
    #[must_use]
    pub const fn is_whole(&self) -> bool {
        matches!(self, Self::Integer { .. } | Self::Choice { .. } | Self::FlaggedInteger { .. })
    }

    /// Whether the sign is a switch.
    #[must_use]
    pub const fn is_flagged(&self) -> bool {
        matches!(self, Self::Flagged { .. } | Self::FlaggedInteger { .. })
    }

    /// The nearest allowed value: clamped, rounded where whole; the middle of the range for NaN.
    #[must_use]
    pub fn repair(&self, value: f64) -> f64 {
        let (min, max) = self.range();
        if value.is_nan() {
            return self.repair((min + max) / 2.0);
        }
        let value = if self.is_whole() { value.round() } else { value };
        value.clamp(min, max)
    }

    /// One word for tables.
    #[must_use]
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Real { .. } => "real",
            Self::Integer { .. } => "integer",
            Self::Choice { .. } => "choice",
            Self::Flagged { .. } => "flagged",
            Self::FlaggedInteger { .. } => "flagged integer",
        }
    }
}

/// The unit of a parameter's numbers, as they stand in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Metres.
    Meters,
    /// Degrees; converted to radians when a generator reads them.
    Degrees,
    /// A count of things.
    Count,
    /// A ratio or a power: no unit.
    Ratio,
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Meters => "m",
            Self::Degrees => "°",
            Self::Count => "count",
            Self::Ratio => "ratio",
        })
    }
}

/// Where a parameter is defined.
pub type Source = &'static str;

/// The one declaration of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Its name in species files.
    pub name: Cow<'static, str>,
    /// Scalar, one number a level, or a vector.
    pub layout: Layout,
    /// What its numbers mean and which are allowed.
    pub kind: Kind,
    /// The range that searches and random lists draw from: narrower than what is allowed. One pair
    /// for all slots, or one for each.
    pub search: Cow<'static, [(f64, f64)]>,
    /// Unit of the numbers in files.
    pub unit: Unit,
    /// Values where a species file is silent, one for each slot.
    pub default: Cow<'static, [f64]>,
    /// A word by which several parameters can be chosen together, such as `crown` or `leaves`.
    pub group: &'static str,
    /// One line of documentation.
    pub doc: Cow<'static, str>,
    /// Paper and section.
    pub source: Source,
}

impl Param {
    /// The search range of slot `index` of this parameter.
    #[must_use]
    pub fn search_range(&self, index: usize) -> (f64, f64) {
        self.search[index.min(self.search.len() - 1)]
    }
}
