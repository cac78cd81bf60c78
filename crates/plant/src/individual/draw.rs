//! Draws of one stem that replace its own.

use crate::math;
use crate::random::{Key, Purpose};

/// The purpose of the key that follows from a new seed.
const RESEED: Purpose = Purpose::MAX;

/// Degrees and factors of lengths have this many decimal places: as many as files write.
const PLACES: f64 = 1e4;

/// `value` to the places that files write.
pub(super) fn rounded(value: f64) -> f64 {
    (value * PLACES).round() / PLACES
}

/// Other draws of one stem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// Seed of the new draws of the stem and of what it carries; 0: their own.
    pub seed: u32,
    /// Turn about the parent, radians.
    pub azimuth: f64,
    /// Lean away from the parent's tip, radians.
    pub pitch: f64,
    /// Factor of the length. A fork has its parent's length.
    pub length: f64,
}

impl Draw {
    /// The stem's own draws.
    pub const OWN: Self = Self { seed: 0, azimuth: 0.0, pitch: 0.0, length: 1.0 };

    /// The key that its draws follow from, where `own` is its own.
    #[must_use]
    pub fn key(&self, own: Key) -> Key {
        if self.seed == 0 { own } else { own.child(RESEED, self.seed) }
    }

    /// Azimuth and pitch in degrees, to the places that files write.
    #[must_use]
    pub fn degrees(&self) -> (f64, f64) {
        (rounded(self.azimuth.to_degrees()), rounded(self.pitch.to_degrees()))
    }

    /// The same with numbers as short as a file has them, so that a tree is the one that its file grows.
    #[must_use]
    pub fn rounded(&self) -> Self {
        let angle = |radians: f64| rounded(radians.to_degrees()).to_radians();
        Self { azimuth: angle(self.azimuth), pitch: angle(self.pitch), length: rounded(self.length), ..*self }
    }

    /// Whether the numbers are allowed: turns of at most half a turn, a length of a tenth to ten times.
    #[must_use]
    pub fn is_allowed(&self) -> bool {
        let turn = |angle: f64| angle.is_finite() && angle.abs() <= std::f64::consts::PI;
        turn(self.azimuth) && turn(self.pitch) && (0.1..=10.0).contains(&self.length)
    }

    /// How far it lies from the stem's own draws, in squares of `spread`; the mean of the three numbers.
    #[must_use]
    pub fn price(&self, spread: &Spread) -> f64 {
        let part = |distance: f64, most: f64| if most > 0.0 { math::powi(distance / most, 2) } else { 0.0 };
        let Spread { azimuth, pitch, length } = *spread;
        (part(self.azimuth, azimuth) + part(self.pitch, pitch) + part(self.length - 1.0, length)) / 3.0
    }
}

/// How far the draws of stems of one level may be from their own: a share of the species' own variation, and a
/// little where the species has none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Largest turn about the parent, radians.
    pub azimuth: f64,
    /// Largest lean, radians.
    pub pitch: f64,
    /// Largest relative change of the length.
    pub length: f64,
}

/// Least spread, degrees and relative length: stems differ by about this much in nature.
const NATURAL: (f64, f64, f64) = (10.0, 4.0, 0.06);
/// Share of the species' own variation.
const SHARE: f64 = 0.5;
/// Degrees that a trunk may lean; its turn about its axis is free.
const LEAN: f64 = 2.0;
/// Upper bounds of the spread, radians and relative length.
const MAX_PITCH: f64 = 0.35;
const MAX_LENGTH: f64 = 0.25;

impl Spread {
    /// The spread of `degrees` about the parent and away from its tip, and of a part of the length.
    #[must_use]
    pub fn from_degrees(azimuth: f64, pitch: f64, length: f64) -> Self {
        Self { azimuth: azimuth.to_radians(), pitch: pitch.to_radians(), length }
    }

    /// The spread of trunks: turned freely, hardly leaning. A picture shows the height of a tree, so a trunk has no other
    /// length.
    #[must_use]
    pub fn for_trunks() -> Self {
        Self::from_degrees(180.0, LEAN, 0.0)
    }

    /// The spread of stems that a species varies by `varied`: half of that, and a little where it varies nothing.
    #[must_use]
    pub fn for_stems(varied: Self) -> Self {
        let (azimuth, pitch, length) = NATURAL;
        let part = |varied: f64, least: f64| (SHARE * varied.abs()).max(least);
        Self {
            azimuth: part(varied.azimuth, azimuth.to_radians()).min(std::f64::consts::PI),
            pitch: part(varied.pitch, pitch.to_radians()).min(MAX_PITCH),
            length: part(varied.length, length).min(MAX_LENGTH),
        }
    }

    /// A draw near `from`, within the spread: `key` chooses it, and it is at most the part `reach` of the spread
    /// away.
    pub(super) fn sample(&self, key: Key, from: &Draw, reach: f64) -> Draw {
        let near = |from: f64, most: f64, index: u32| {
            (from + reach * most * key.signed(0, index)).clamp(-most, most)
        };
        Draw {
            seed: from.seed,
            azimuth: near(from.azimuth, self.azimuth, 0),
            pitch: near(from.pitch, self.pitch, 1),
            length: 1.0 + near(from.length - 1.0, self.length, 2),
        }
        .rounded()
    }
}
