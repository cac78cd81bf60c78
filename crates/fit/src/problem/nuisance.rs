//! Unknowns of a picture: the direction of view, the scale, and the place of the tree.
//!
//! They are nuisance parameters, not part of the tree. They are searched beside its parameters
//! ([`crate::Genome::nuisances`]), view by view in the order of the problem's goals, and reported beside them. The
//! first goal has none: azimuths are counted from it, and its scale is the tree's.

use pleach_silhouette::{Frame, View};
use serde::Serialize;

/// The unknowns of a view.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Unknown {
    /// The direction around the trunk.
    pub azimuth: Azimuth,
    /// Whether scale and place of the frame are only approximate: see [`MAX_SCALE`] and [`MAX_OFFSET`].
    pub frame: bool,
}

/// How well an azimuth is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Azimuth {
    /// It is the view's.
    #[default]
    Known,
    /// It is within this many degrees of the view's, on either side.
    Within(f64),
    /// Any.
    Any,
}

/// Degrees by which an azimuth that is known roughly may be off.
pub const ROUGH_AZIMUTH: f64 = 15.0;
/// Relative error of an approximate scale, on either side.
pub const MAX_SCALE: f64 = 0.2;
/// Error of an approximate place, relative to the picture's width and height.
pub const MAX_OFFSET: f64 = 0.1;

/// The kind of a nuisance parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nuisance {
    /// Azimuth in degrees.
    Azimuth,
    /// Factor on the metres per pixel.
    Scale,
    /// How far the trunk's foot is to the right of the frame's axis, in widths of the picture.
    Right,
    /// How far it is below the frame's ground, in heights of the picture.
    Down,
}

/// Corrections of the view and the frame of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Placement {
    /// Azimuth in degrees, where it was unknown.
    pub azimuth: Option<f64>,
    /// Factor on the metres per pixel; 1 where the scale was known.
    pub scale: f64,
    /// How far the trunk's foot is to the right of where the frame says, in widths of the picture, and
    /// below it, in heights; 0 where the place was known.
    pub offset: [f64; 2],
}

impl Placement {
    /// No correction.
    pub const KNOWN: Self = Self { azimuth: None, scale: 1.0, offset: [0.0; 2] };

    /// This and then `other`, whose azimuth is ignored.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        Self {
            azimuth: self.azimuth,
            scale: self.scale * other.scale,
            offset: [self.offset[0] + other.offset[0], self.offset[1] + other.offset[1]],
        }
    }

    /// `view` from the azimuth that was found.
    #[must_use]
    pub fn view(&self, view: &View) -> View {
        View { azimuth: self.azimuth.map_or(view.azimuth, f64::to_radians), ..*view }
    }

    /// `frame` at the scale and the place that were found, whatever its size in pixels.
    #[must_use]
    pub fn frame(&self, frame: &Frame) -> Frame {
        let [right, down] = self.offset;
        Frame {
            meters_per_pixel: frame.meters_per_pixel * self.scale,
            axis_column: frame.axis_column + right * f64::from(frame.width),
            ground_row: frame.ground_row + down * f64::from(frame.height),
            ..*frame
        }
    }
}

impl Unknown {
    /// The number of unknowns.
    #[must_use]
    pub fn count(&self) -> usize {
        usize::from(self.azimuth != Azimuth::Known) + if self.frame { 3 } else { 0 }
    }

    /// The unknowns, in order, each with its range and its default.
    pub(crate) fn numbers(&self, view: &View) -> impl Iterator<Item = (Nuisance, f64, f64, f64)> + use<> {
        let about = view.azimuth.to_degrees();
        let azimuth = match self.azimuth {
            Azimuth::Known => None,
            Azimuth::Within(reach) => Some((Nuisance::Azimuth, about - reach, about + reach, about)),
            Azimuth::Any => Some((Nuisance::Azimuth, 0.0, 360.0, 0.0)),
        };
        let frame = self.frame.then_some([
            (Nuisance::Scale, 1.0 - MAX_SCALE, 1.0 + MAX_SCALE, 1.0),
            (Nuisance::Right, -MAX_OFFSET, MAX_OFFSET, 0.0),
            (Nuisance::Down, -MAX_OFFSET, MAX_OFFSET, 0.0),
        ]);
        azimuth.into_iter().chain(frame.into_iter().flatten())
    }

    /// The placement of `values`, one per unknown of `view`; defaults for missing ones.
    #[must_use]
    pub fn placement(&self, view: &View, values: &[f64]) -> Placement {
        let mut placement = Placement::KNOWN;
        for (i, (nuisance, _, _, usual)) in self.numbers(view).enumerate() {
            let value = values.get(i).copied().unwrap_or(usual);
            match nuisance {
                Nuisance::Azimuth => placement.azimuth = Some(value),
                Nuisance::Scale => placement.scale = value,
                Nuisance::Right => placement.offset[0] = value,
                Nuisance::Down => placement.offset[1] = value,
            }
        }
        placement
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_unknown_changes_nothing() {
        let view = View::degrees(33.3, 5.0);
        let frame =
            Frame { width: 30, height: 20, meters_per_pixel: 0.1, axis_column: 14.7, ground_row: 19.3 };
        let placement = Unknown::default().placement(&view, &[]);
        assert_eq!(placement, Placement::KNOWN);
        assert_eq!((placement.view(&view), placement.frame(&frame)), (view, frame));

        let unknown = Unknown { azimuth: Azimuth::Within(15.0), frame: true };
        assert_eq!(unknown.count(), 4);
        let placement = unknown.placement(&view, &[40.0, 1.1, 0.1, -0.1]);
        assert!((placement.view(&view).azimuth.to_degrees() - 40.0).abs() < 1e-12);
        let moved = placement.frame(&frame);
        assert!((moved.meters_per_pixel - 0.11).abs() < 1e-12);
        assert!((moved.axis_column - 17.7).abs() < 1e-12 && (moved.ground_row - 17.3).abs() < 1e-12);
    }
}
