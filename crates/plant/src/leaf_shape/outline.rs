//! Outlines of flat leaves: those that come with pleach, and any that a generator makes.

use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// The closed outline of a flat leaf in the coordinates of [`crate::leaf_shape`], and its name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "OutlineData", into = "OutlineData")]
pub struct Outline {
    name: Cow<'static, str>,
    corners: Vec<[f32; 2]>,
    /// Corners of the right half, which come first; 0 where the halves differ.
    half: usize,
    area: f32,
}

/// An outline as it is written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct OutlineData {
    name: String,
    corners: Vec<[f32; 2]>,
    /// Corners of the right half, if the left half mirrors it; 0 otherwise.
    #[serde(default)]
    half: usize,
}

impl From<Outline> for OutlineData {
    fn from(outline: Outline) -> Self {
        let Outline { name, corners, half, area: _ } = outline;
        Self { name: name.into_owned(), corners, half }
    }
}

impl TryFrom<OutlineData> for Outline {
    type Error = OutlineError;

    fn try_from(data: OutlineData) -> Result<Self, OutlineError> {
        let outline = Self::new(data.name, data.corners)?;
        // A half that nothing mirrors is no promise.
        let mirrored = outline.corners.get(..data.half).is_some_and(|half| mirrored(half) == outline.corners);
        Ok(Self { half: if mirrored { data.half } else { 0 }, ..outline })
    }
}

/// Why corners are not the outline of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// Fewer corners than a triangle, or more than [`Outline::MAX_CORNERS`].
    #[error("a leaf's outline has {count} corners, expected 3 to {max}", max = Outline::MAX_CORNERS)]
    CornerCount {
        /// How many there are.
        count: usize,
    },
    /// A coordinate that is not a finite number.
    #[error("corner {corner} of a leaf's outline is not finite")]
    NotFinite {
        /// Number of the corner, from 0.
        corner: usize,
    },
    /// All corners on one line, or loops that cancel each other.
    #[error("a leaf's outline encloses no area")]
    NoArea,
}

impl Outline {
    /// Most corners.
    pub const MAX_CORNERS: usize = 64;

    /// The outline through `corners`, (u, v) in either direction.
    ///
    /// # Errors
    /// See [`OutlineError`].
    pub fn new(name: impl Into<Cow<'static, str>>, mut corners: Vec<[f32; 2]>) -> Result<Self, OutlineError> {
        let count = corners.len();
        if !(3..=Self::MAX_CORNERS).contains(&count) {
            return Err(OutlineError::CornerCount { count });
        }
        if let Some(corner) = corners.iter().position(|p| !p.iter().all(|c| c.is_finite())) {
            return Err(OutlineError::NotFinite { corner });
        }
        let mut area = area(&corners);
        if area < 0.0 {
            corners.reverse();
            area = -area;
        }
        if !(area.is_finite() && area > 0.0) {
            return Err(OutlineError::NoArea);
        }
        Ok(Self { name: name.into(), corners, half: 0, area })
    }

    /// The outline whose right half, from the stalk to the tip, is `half`, and whose left half mirrors
    /// it. A last corner with u = 0 is the tip itself; without one the tip is a straight edge.
    pub(super) fn from_half(name: &'static str, half: &[[f32; 2]]) -> Self {
        let corners = mirrored(half);
        let area = area(&corners);
        Self { name: Cow::Borrowed(name), corners, half: half.len(), area }
    }

    /// What the shape is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The corners as (u, v), counter-clockwise.
    #[must_use]
    pub fn corners(&self) -> &[[f32; 2]] {
        &self.corners
    }

    /// The right half as (u, v), u ≥ 0, from the stalk to the tip, if the left half mirrors it.
    #[must_use]
    pub fn half(&self) -> Option<&[[f32; 2]]> {
        (self.half > 0).then(|| &self.corners[..self.half])
    }

    /// The area that it encloses.
    #[must_use]
    pub const fn area(&self) -> f32 {
        self.area
    }

    /// From the leftmost to the rightmost corner.
    #[must_use]
    pub fn width(&self) -> f32 {
        let us = || self.corners.iter().map(|p| p[0]);
        us().fold(f32::NEG_INFINITY, f32::max) - us().fold(f32::INFINITY, f32::min)
    }
}

/// The outline whose right half is `half`.
fn mirrored(half: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let left = half.iter().rev().filter(|p| p[0] > 0.0).map(|p| [-p[0], p[1]]);
    half.iter().copied().chain(left).collect()
}

/// Signed area of a closed polygon, positive if it is counter-clockwise.
fn area(corners: &[[f32; 2]]) -> f32 {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f32>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_direction_is_made_counter_clockwise() {
        let clockwise = vec![[0.0, 0.0], [-0.5, 1.0], [0.2, 0.4]];
        let outline = Outline::new("kite", clockwise).unwrap();
        assert_eq!(outline.corners()[0], [0.2, 0.4]);
        assert!((outline.area() - 0.2).abs() < 1e-6 && (outline.width() - 0.7).abs() < 1e-6);
        assert_eq!((outline.name(), outline.half()), ("kite", None));
    }

    #[test]
    fn what_is_not_an_outline_is_refused() {
        let refused = |corners: &[[f32; 2]]| Outline::new("x", corners.to_vec()).unwrap_err();
        assert_eq!(refused(&[[0.0, 0.0], [1.0, 1.0]]), OutlineError::CornerCount { count: 2 });
        assert_eq!(refused(&[[0.0, 1.0]; 65]), OutlineError::CornerCount { count: 65 });
        assert_eq!(refused(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), OutlineError::NoArea);
        let holes = [[0.0, 0.0], [f32::NAN, 1.0], [2.0, 2.0]];
        assert_eq!(refused(&holes), OutlineError::NotFinite { corner: 1 });
    }
}
