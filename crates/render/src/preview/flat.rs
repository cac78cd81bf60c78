//! Pictures for the cards of a last level of detail: seen from afar, in even light.

use super::camera::Camera;
use super::scene::Scene;
use super::seen::Seen;
use super::settings::{Background, Ground, PreviewSettings};
use super::shade::View;
use crate::picture::Picture;
use glam::Vec3;

/// What a flat picture shows: a rectangle through `middle` that faces `azimuth`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) middle: Vec3,
    /// Radians; 0 looks along +y.
    pub(crate) azimuth: f32,
    /// Half of width and height, in metres.
    pub(crate) half: [f32; 2],
    /// Width and height in pixels.
    pub(crate) pixels: [u32; 2],
}

/// The tree in this frame on nothing, in its own colours and with the crown's own shade, as an engine
/// that lights it wants it.
pub(super) fn picture(scene: &Scene<'_>, frame: &Frame) -> Picture {
    let [width, height] = frame.pixels;
    let samples = super::shade::SAMPLES;
    let camera = Camera::afar(frame.middle, frame.azimuth, frame.half, [width * samples, height * samples]);
    let seen = Seen::new(scene, width * samples, height * samples, |point| camera.project(point));
    let settings = PreviewSettings {
        width,
        height,
        background: Background::Transparent,
        ground: Ground::None,
        ..PreviewSettings::default()
    };
    View { scene, settings: &settings, camera, sun: None, seen }.picture()
}
