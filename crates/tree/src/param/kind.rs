//! What the numbers of a parameter mean, and which are allowed.

use std::borrow::Cow;

/// What the numbers of a parameter mean, and which are allowed.
#[derive(Clone, Debug, PartialEq)]
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
        /// The names, in the order of their numbers; at least one.
        names: Cow<'static, [Cow<'static, str>]>,
    },
    /// A number whose sign is a switch between two meanings and whose magnitude is a quantity, in
    /// `-max..=max`. Going through zero changes what the parameter means, not only how much.
    Flagged {
        /// Largest allowed magnitude.
        max: f64,
        /// What a negative value means, in a few words.
        negative: Cow<'static, str>,
    },
    /// Like [`Kind::Flagged`], whole numbers only.
    FlaggedInteger {
        /// Largest allowed magnitude.
        max: i64,
        /// What a negative value means, in a few words.
        negative: Cow<'static, str>,
    },
}

impl Kind {
    /// Any number in `min..=max`.
    #[must_use]
    pub const fn real(min: f64, max: f64) -> Self {
        Self::Real { min, max }
    }

    /// A whole number in `min..=max`.
    #[must_use]
    pub const fn integer(min: i64, max: i64) -> Self {
        Self::Integer { min, max }
    }

    /// One of `names`, numbered from `first`.
    #[must_use]
    pub fn choice<N: Into<Cow<'static, str>>>(first: i64, names: impl IntoIterator<Item = N>) -> Self {
        Self::Choice { first, names: names.into_iter().map(Into::into).collect() }
    }

    /// A switch with a magnitude up to `max`; `negative` says what a negative value means.
    #[must_use]
    pub fn flagged(max: f64, negative: impl Into<Cow<'static, str>>) -> Self {
        Self::Flagged { max, negative: negative.into() }
    }

    /// A switch with a whole magnitude up to `max`; `negative` says what a negative value means.
    #[must_use]
    pub fn flagged_integer(max: i64, negative: impl Into<Cow<'static, str>>) -> Self {
        Self::FlaggedInteger { max, negative: negative.into() }
    }

    /// Smallest and largest allowed value.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        match self {
            Self::Real { min, max } => (*min, *max),
            Self::Integer { min, max } => (*min as f64, *max as f64),
            Self::Choice { first, names } => (*first as f64, (*first + names.len() as i64 - 1) as f64),
            Self::Flagged { max, .. } => (-max, *max),
            Self::FlaggedInteger { max, .. } => (-(*max as f64), *max as f64),
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

    /// Whether the number is the name of a thing, so that neighbors are not more alike than others.
    #[must_use]
    pub const fn is_choice(&self) -> bool {
        matches!(self, Self::Choice { .. })
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
