//! Where the picture is taken from, and which part of the world it shows.

use glam::DVec3;
use pleach_plant::Bounds;
use pleach_plant::math;
use pleach_plant::{Parts, Tree};

/// How depth is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Projection {
    /// Without perspective.
    #[default]
    Orthographic,
    /// With perspective, from this many metres before the trunk's axis; sizes are true there.
    Perspective {
        /// Metres from the camera to the axis.
        distance: f64,
    },
}

/// A direction of view.
///
/// Azimuth 0 looks along +y with +x to the right; positive azimuths walk around the tree
/// counter-clockwise seen from above. Elevation 0 looks level, positive ones look down on the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct View {
    /// Radians around the trunk.
    pub azimuth: f64,
    /// Radians above the horizon.
    pub elevation: f64,
    /// How depth is shown.
    pub projection: Projection,
}

impl View {
    /// The front view: azimuth and elevation 0, orthographic.
    pub const FRONT: Self = Self { azimuth: 0.0, elevation: 0.0, projection: Projection::Orthographic };

    /// An orthographic view from angles in degrees.
    #[must_use]
    pub fn degrees(azimuth: f64, elevation: f64) -> Self {
        Self { azimuth: azimuth.to_radians(), elevation: elevation.to_radians(), ..Self::FRONT }
    }

    /// The axes of the picture in the world: right, up, and away from the viewer.
    #[must_use]
    pub fn axes(&self) -> [DVec3; 3] {
        let ((sin_a, cos_a), (sin_e, cos_e)) = (math::sin_cos(self.azimuth), math::sin_cos(self.elevation));
        let right = DVec3::new(cos_a, sin_a, 0.0);
        let level = DVec3::new(-sin_a, cos_a, 0.0);
        [right, level * sin_e + DVec3::Z * cos_e, level * cos_e - DVec3::Z * sin_e]
    }
}

/// Which part of the world a picture shows, and at what scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Width and height of a pixel in metres.
    pub meters_per_pixel: f64,
    /// Where the trunk's foot is, in pixels from the left edge; pixel 0 reaches from 0 to 1.
    pub axis_column: f64,
    /// Where the trunk's foot is, in pixels from the top edge.
    pub ground_row: f64,
}

impl Frame {
    /// Part of the picture that the larger of the tree's height and width fills.
    pub const FILL: f64 = 0.95;

    /// The frame that shows all of `parts` of a tree: ground at the bottom edge, the trunk's foot in the middle,
    /// the larger of height and twice the reach to a side filling 95 % of the picture.
    ///
    /// Seen from above or below the foot moves up as far as the tree reaches below it.
    #[must_use]
    pub fn automatic(tree: &Tree, view: &View, parts: Parts, width: u32, height: u32) -> Self {
        Self::around(Bounds::new(tree, parts).as_ref(), view, width, height)
    }

    /// [`Frame::automatic`] of a tree of these bounds, which are found once for several views; `None` for a tree
    /// without parts.
    #[must_use]
    pub fn around(bounds: Option<&Bounds>, view: &View, width: u32, height: u32) -> Self {
        let Some(bounds) = bounds else {
            return Self {
                width,
                height,
                meters_per_pixel: 1.0,
                axis_column: f64::from(width) / 2.0,
                ground_row: f64::from(height),
            };
        };
        let [right, up, _] = view.axes();
        let (mut reach, mut top, mut bottom) = (0.0_f64, 0.0_f64, 0.0_f64);
        for corner in 0..8 {
            let pick = |bit: u32, low: f64, high: f64| if corner >> bit & 1 == 0 { low } else { high };
            let p = DVec3::new(
                pick(0, bounds.min.x, bounds.max.x),
                pick(1, bounds.min.y, bounds.max.y),
                pick(2, bounds.min.z.max(0.0), bounds.max.z),
            );
            reach = reach.max(p.dot(right).abs());
            top = top.max(p.dot(up));
            bottom = bottom.min(p.dot(up));
        }
        // A level view puts the ground at the edge and cuts off what hangs below it.
        let below = if view.elevation == 0.0 { 0.0 } else { -bottom };
        let (w, h) = (f64::from(width) * Self::FILL, f64::from(height) * Self::FILL);
        let meters_per_pixel = (2.0 * reach / w).max((top + below) / h).max(1e-9);
        Self {
            width,
            height,
            meters_per_pixel,
            axis_column: f64::from(width) / 2.0,
            ground_row: f64::from(height) - below / meters_per_pixel,
        }
    }

    /// The same part of the world in another number of pixels.
    #[must_use]
    pub fn scaled(&self, width: u32, height: u32) -> Self {
        let factor = f64::from(height) / f64::from(self.height);
        Self {
            width,
            height,
            meters_per_pixel: self.meters_per_pixel / factor,
            axis_column: self.axis_column * factor,
            ground_row: self.ground_row * factor,
        }
    }
}

/// A view through a frame: from metres in the world to pixels in the picture.
#[derive(Clone, Copy, Debug)]
pub struct Camera {
    /// Pixels right and down for each metre along x, y, z.
    pub(crate) right: DVec3,
    pub(crate) down: DVec3,
    /// Unit vector away from the viewer.
    pub(crate) away: DVec3,
    origin: (f64, f64),
    distance: f64,
    pixels_per_meter: f64,
}

impl Camera {
    /// The camera of `view` and `frame`.
    #[must_use]
    pub fn new(view: &View, frame: &Frame) -> Self {
        let [right, up, away] = view.axes();
        let pixels_per_meter = 1.0 / frame.meters_per_pixel;
        Self {
            right: right * pixels_per_meter,
            down: -up * pixels_per_meter,
            away,
            origin: (frame.axis_column, frame.ground_row),
            distance: match view.projection {
                Projection::Orthographic => f64::INFINITY,
                Projection::Perspective { distance } => distance.max(1e-3),
            },
            pixels_per_meter,
        }
    }

    pub(crate) const fn is_orthographic(&self) -> bool {
        self.distance.is_infinite()
    }

    /// How much larger than at the axis things are at `point`; `None` behind the camera.
    #[must_use]
    pub fn magnification(&self, point: DVec3) -> Option<f64> {
        if self.distance.is_infinite() {
            return Some(1.0);
        }
        let depth = self.distance + point.dot(self.away);
        (depth > 1e-3 * self.distance).then(|| self.distance / depth)
    }

    /// Pixel coordinates (right, down) of a point in metres, for a magnification found before.
    #[must_use]
    pub fn project(&self, point: DVec3, magnification: f64) -> (f64, f64) {
        (
            self.origin.0 + point.dot(self.right) * magnification,
            self.origin.1 + point.dot(self.down) * magnification,
        )
    }

    /// Pixels that a metre at the axis measures.
    #[must_use]
    pub const fn pixels_per_meter(&self) -> f64 {
        self.pixels_per_meter
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_view_looks_along_y() {
        let [right, up, away] = View::FRONT.axes();
        assert_eq!((right, up, away), (DVec3::X, DVec3::Z, DVec3::Y));
        let [right, ..] = View::degrees(90.0, 0.0).axes();
        assert!((right - DVec3::Y).length() < 1e-12);
        let [_, up, away] = View::degrees(0.0, 90.0).axes();
        assert!((up - DVec3::Y).length() < 1e-12 && (away + DVec3::Z).length() < 1e-12);
    }

    #[test]
    fn perspective_is_true_at_the_axis() {
        let frame =
            Frame { width: 100, height: 100, meters_per_pixel: 0.1, axis_column: 50.0, ground_row: 90.0 };
        let view = View { projection: Projection::Perspective { distance: 10.0 }, ..View::FRONT };
        let camera = Camera::new(&view, &frame);
        let seen = |p: DVec3| camera.magnification(p).map(|m| camera.project(p, m));
        assert_eq!(seen(DVec3::new(1.0, 0.0, 2.0)), Some((60.0, 70.0)));
        assert_eq!(seen(DVec3::new(1.0, -5.0, 0.0)), Some((70.0, 90.0)));
        assert_eq!(seen(DVec3::new(1.0, -11.0, 0.0)), None);
    }
}
