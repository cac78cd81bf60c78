//! Pictures for the cards of a last level of detail: seen from afar, in even light.

use super::camera::Camera;
use super::light::Sun;
use super::scene::Scene;
use super::seen::Seen;
use super::settings::{Background, Ground, PreviewSettings};
use super::shade::View;
use crate::picture::Picture;
use glam::{Vec3, vec3};

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

/// What a card shows: colours and directions.
#[derive(Clone, Debug)]
pub(crate) struct Flat {
    pub(crate) color: Picture,
    /// Normals in the card's space: x to the right, y up, z towards the viewer.
    pub(crate) normal: Picture,
}

/// The tree in this frame on nothing, in its own colours and with the crown's own shade, as an engine that lights it wants
/// it, and with the shadows of `suns` if there are any.
pub(super) fn colors(scene: &Scene<'_>, suns: &[Sun], frame: &Frame) -> Picture {
    seen(scene, suns, frame, |view| view.picture())
}

/// The same, and its normals, which `turn` brings into the card's space.
pub(super) fn both(
    scene: &Scene<'_>,
    suns: &[Sun],
    frame: &Frame,
    turn: impl Fn(Vec3) -> Vec3 + Sync,
) -> Flat {
    seen(scene, suns, frame, |view| Flat { color: view.picture(), normal: view.normals(turn) })
}

fn seen<T>(scene: &Scene<'_>, suns: &[Sun], frame: &Frame, look: impl FnOnce(View<'_>) -> T) -> T {
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
    look(View { scene, settings: &settings, camera, sun: None, suns, seen })
}

/// Pixels across the shadows of [`suns`].
const TEXELS: u32 = 1024;

/// Four suns all around a scene, halfway up.
pub(super) fn suns(scene: &Scene<'_>) -> Vec<Sun> {
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let towards = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let mut suns = towards.map(|(x, y)| Sun::new(vec3(x * 0.5, y * 0.5, half))).to_vec();
    scene.each_point(|point| suns.iter_mut().for_each(|sun| sun.include(point)));
    suns.iter_mut().for_each(|sun| sun.shine(scene, TEXELS));
    suns
}
