//! From samples to pixels.

use super::bark::{self, smooth};
use super::camera::Camera;
use super::clumps;
use super::light::Sun;
use super::scene::Scene;
use super::seen::{Seen, Triangle};
use super::settings::{Background, Ground, PreviewSettings};
use crate::picture::Picture;
use glam::{Vec2, Vec3, Vec4, vec3};
use pleach_mesh::Material;
use pleach_mesh::palette::{BarkPattern, linear};
use rayon::prelude::*;

/// Samples per pixel, across and down.
pub(super) const SAMPLES: u32 = 3;
/// Light of the sun, of the sky overhead, and reflected by the ground.
const SUN: Vec3 = vec3(3.5, 3.2, 2.65);
const SKY: Vec3 = vec3(0.66, 0.80, 1.02);
const BOUNCE: Vec3 = vec3(0.30, 0.29, 0.22);
/// How much more light a crown shows than reaches it at once, since leaves light each other: cards against meshes of three
/// species, rendered by Cycles.
const BOUNCED: f32 = 1.2;
/// Everything is divided by this before it is shown.
const WHITE: f32 = 2.6;

pub(super) fn picture(scene: &Scene<'_>, settings: &PreviewSettings) -> Picture {
    let (width, height) = (settings.width * SAMPLES, settings.height * SAMPLES);
    let (azimuth, elevation) = (settings.azimuth as f32, settings.elevation as f32);
    // From the viewer's upper left, three quarters to the front.
    let (turn, rise) = (azimuth - 0.75, 0.87_f32);
    let towards = vec3(turn.sin() * rise.cos(), -turn.cos() * rise.cos(), rise.sin());
    let texels = (settings.width.max(settings.height) * 2).clamp(256, 4096);
    let mut sun = Sun::new(towards);
    let outline = outline(scene, settings.all_around, |point| sun.include(point));
    let camera = Camera::around(&outline, azimuth, elevation, width, height);
    sun.shine(scene, texels);
    let seen = Seen::new(scene, width, height, |point| camera.project(point));
    View { scene, settings, camera, sun: Some(sun), suns: &[], seen }.picture()
}

/// Points that a picture must show: some of the tree's own, or the rim of all its turns. All points of the
/// tree are passed to `also`, so that one pass serves both.
fn outline(scene: &Scene<'_>, all_around: bool, mut also: impl FnMut(Vec3)) -> Vec<Vec3> {
    let step = (scene.count().vertices as usize / 6000).max(1);
    let (mut some, mut number) = (Vec::new(), 0_usize);
    scene.each_point(|p| {
        if number.is_multiple_of(step) {
            some.push(p);
        }
        number += 1;
        also(p);
    });
    if some.is_empty() {
        return vec![scene.low, scene.high];
    }
    if !all_around {
        return some;
    }
    let rim = |p: &Vec3| {
        let reach = p.truncate().length();
        (0..16).map(move |i| {
            let (sin, cos) = (i as f32 * std::f32::consts::TAU / 16.0).sin_cos();
            (reach * cos, reach * sin)
        })
    };
    some.iter().step_by(8).flat_map(|p| rim(p).map(|(x, y)| vec3(x, y, p.z))).collect()
}

/// What is seen at a sample.
struct Hit<'a> {
    at: Vec3,
    normal: Vec3,
    material: Material,
    uv: Vec2,
    /// Whether it is the back of its triangle.
    is_behind: bool,
    triangle: &'a Triangle,
}

/// A scene from a camera; without a sun, colours are shown as they are, in the crown's shade.
pub(super) struct View<'a> {
    pub(super) scene: &'a Scene<'a>,
    pub(super) settings: &'a PreviewSettings,
    pub(super) camera: Camera,
    pub(super) sun: Option<Sun>,
    /// Suns of several directions, whose shadows are shown without their light.
    pub(super) suns: &'a [Sun],
    pub(super) seen: Seen,
}

impl View<'_> {
    pub(super) fn picture(&self) -> Picture {
        let (width, height) = (self.settings.width, self.settings.height);
        let mut rgba = vec![0; width as usize * height as usize * 4];
        rgba.par_chunks_mut(width as usize * 4).enumerate().for_each(|(y, row)| {
            for (x, pixel) in row.chunks_exact_mut(4).enumerate() {
                pixel.copy_from_slice(&self.pixel(x as u32, y as u32));
            }
        });
        Picture { width, height, rgba }
    }

    fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        let mut sum = Vec4::ZERO;
        // It is soft, so that one look at it does for all samples.
        let mut ground = None;
        for j in 0..SAMPLES {
            for i in 0..SAMPLES {
                let tree = self.sample(x * SAMPLES + i, y * SAMPLES + j);
                sum += tree.unwrap_or_else(|| *ground.get_or_insert_with(|| self.ground(x, y)));
            }
        }
        let mut color = sum / (SAMPLES * SAMPLES) as f32;
        if let Some(wall) = self.wall(y) {
            color += (wall * (1.0 - color.w)).extend(1.0 - color.w);
        }
        if color.w <= 0.0 {
            return [0; 4];
        }
        let [r, g, b] = (color.truncate() / color.w).to_array().map(to_srgb);
        [r, g, b, (color.w * 255.0).round() as u8]
    }

    /// The background in row `y`, in shown light.
    fn wall(&self, y: u32) -> Option<Vec3> {
        match self.settings.background {
            Background::Transparent => None,
            Background::Plain(color) => Some(linear(color).into()),
            Background::Studio => {
                let t = y as f32 / self.settings.height.max(2) as f32;
                Some(vec3(0.86, 0.88, 0.90).lerp(vec3(0.93, 0.925, 0.91), smooth(0.2, 1.0, t)))
            }
        }
    }

    /// Shown light and coverage of one sample of the tree, multiplied; `None` where the ground is seen.
    fn sample(&self, x: u32, y: u32) -> Option<Vec4> {
        let ray = self.camera.ray(x as f32 + 0.5, y as f32 + 0.5);
        let Hit { at, normal, material, triangle, uv, .. } = self.hit(x, y, ray)?;
        if self.scene.has_roots && at.z < 0.0 && self.settings.ground != Ground::None {
            return None;
        }
        let light = match material {
            Material::Bark => self.bark(at, normal, ray, self.scene.stem_of(triangle.first_corner), uv),
            Material::Leaf if self.scene.blobs.contains(&triangle.number) => self.blob(at, normal, uv),
            _ => self.leaf(at, normal, ray, material, uv),
        };
        Some(if self.sun.is_some() { shown(light) } else { light }.extend(1.0))
    }

    /// What is seen at a sample along `ray`.
    fn hit(&self, x: u32, y: u32, ray: Vec3) -> Option<Hit<'_>> {
        let triangle = self.seen.at(x, y)?;
        let corners = self.seen.corners(triangle);
        let [a, b, c] = corners.map(|vertex| vertex.position);
        let plane = (b - a).cross(c - a);
        let slope = ray.dot(plane);
        let distance = if slope.abs() > 1e-12 { (a - self.camera.eye).dot(plane) / slope } else { 0.0 };
        let center = (a + b + c) / 3.0;
        let size = (b - a).length().max((c - a).length());
        let mut at = self.camera.eye + ray * distance;
        if at.distance(center) > 2.0 * size {
            // Seen edge on: rounding has thrown the point off the triangle.
            at = center;
        }
        let whole = plane.length_squared().max(1e-20);
        let wb = (at - a).cross(c - a).dot(plane) / whole;
        let wc = (b - a).cross(at - a).dot(plane) / whole;
        let weights = [1.0 - wb - wc, wb, wc].map(|w| w.clamp(0.0, 1.0));
        let normal = (0..3).map(|k| corners[k].normal * weights[k]).sum::<Vec3>();
        Some(Hit {
            at,
            normal: normal.try_normalize().unwrap_or(Vec3::Z),
            material: self.scene.material_of(triangle.number),
            uv: (0..3).map(|k| corners[k].uv * weights[k]).sum(),
            is_behind: slope > 0.0,
            triangle,
        })
    }

    /// The normals that are seen, as programs turn those of faces that are seen from behind, as a picture of directions
    /// that `turn` brings into the space of a card: x to the right, y up, z towards the viewer.
    pub(super) fn normals(&self, turn: impl Fn(Vec3) -> Vec3 + Sync) -> Picture {
        let (width, height) = (self.settings.width, self.settings.height);
        let mut rgba = vec![0; width as usize * height as usize * 4];
        let sample = |x: u32, y: u32| {
            let ray = self.camera.ray(x as f32 + 0.5, y as f32 + 0.5);
            let Hit { at, normal, material, is_behind, .. } = self.hit(x, y, ray)?;
            if material == Material::Bark {
                return Some(turn(normal));
            }
            Some(turn(self.of_body(at, if is_behind { -normal } else { normal })))
        };
        rgba.par_chunks_mut(width as usize * 4).enumerate().for_each(|(y, row)| {
            for (x, pixel) in row.chunks_exact_mut(4).enumerate() {
                let first = (x as u32 * SAMPLES, y as u32 * SAMPLES);
                let places = (0..SAMPLES * SAMPLES).map(|i| (first.0 + i % SAMPLES, first.1 + i / SAMPLES));
                let sum: Vec3 = places.filter_map(|(x, y)| sample(x, y)).sum();
                // Nothing looks away from the viewer.
                let [x, y, z] = sum.with_z(sum.z.max(0.0)).try_normalize().unwrap_or(Vec3::Z).to_array();
                let byte = |part: f32| (127.5 + 127.5 * part + 0.5) as u8;
                pixel.copy_from_slice(&[byte(x), byte(y), byte(z), 255]);
            }
        });
        Picture { width, height, rgba }
    }

    fn bark(&self, at: Vec3, normal: Vec3, ray: Vec3, (radius, level): (f32, u16), uv: Vec2) -> Vec3 {
        let (palette, colors) = (&self.scene.palette, &self.scene.colors);
        let bark = colors.bark;
        let Some(sun) = &self.sun else {
            // As meshes show bark on stems of any age.
            let facing = if normal.dot(ray) > 0.0 { -normal } else { normal };
            let open = self.scene.crown.sky_at(at + facing * 0.05);
            return bark * bark::shade(palette.pattern, uv.x, uv.y) * self.even(at, facing, open);
        };
        // Young wood is darker and browner; palms and bamboo carry green stalks.
        let young = match palette.pattern {
            BarkPattern::Ringed if level > 0 => colors.leaf * 0.9,
            BarkPattern::Banded => vec3(0.115, 0.075, 0.055),
            BarkPattern::Plain => bark,
            _ => bark * vec3(0.62, 0.52, 0.46),
        };
        let old = if palette.pattern == BarkPattern::Ringed && level > 0 {
            0.0
        } else {
            smooth(0.006, 0.045, radius)
        };
        // Below a pixel or two markings only flicker.
        let seen = smooth(2.0, 8.0, radius * self.camera.scale_at(at) / SAMPLES as f32);
        let marks = 1.0 + (bark::shade(palette.pattern, uv.x, uv.y) - 1.0) * seen * old;
        let albedo = young.lerp(bark, old) * marks;
        let facing = if normal.dot(ray) > 0.0 { -normal } else { normal };
        let sky = self.scene.crown.sky_at(at + facing * 0.05);
        let shadow = sun.at(at + facing * 0.01, 1, 1.0);
        let sunlit = SUN * (facing.dot(sun.towards).max(0.0) * shadow);
        albedo * (sunlit + self.sky_light(facing, sky))
    }

    fn leaf(&self, at: Vec3, normal: Vec3, ray: Vec3, material: Material, uv: Vec2) -> Vec3 {
        let scene = self.scene;
        let varied = scene.foliage.color(material, uv).unwrap_or(scene.colors.leaf);
        let facing = if normal.dot(ray) > 0.0 { -normal } else { normal };
        // A crown is lit as a body too: its outer leaves stand for what lies behind them.
        let outward = (at - scene.heart) / scene.reach;
        let rounded = (facing + outward * 0.55).try_normalize().unwrap_or(facing);
        let sky = scene.crown.sky_at(at);
        let Some(sun) = &self.sun else { return varied * self.even(at, self.of_body(at, facing), sky) };
        let shadow = sun.at(at, 1, 1.0);
        // Petals let light through, to those behind them too.
        let shadow = if material == Material::Blossom { 0.3 + 0.7 * shadow } else { shadow };
        let flat = facing.dot(sun.towards);
        let reflected = 0.55 * flat.max(0.0) + 0.45 * (rounded.dot(sun.towards) * 0.75 + 0.25).max(0.0);
        let through = (-flat).max(0.0) * 0.55;
        let thin = if material == Material::Leaf { vec3(1.15, 1.25, 0.45) } else { Vec3::ONE };
        let half = (sun.towards - ray).try_normalize().unwrap_or(facing);
        let gloss = facing.dot(half).max(0.0).powi(24) * 0.10 * shadow;
        varied * (SUN * (reflected * shadow) + self.sky_light(rounded, sky))
            + varied * thin * SUN * (through * shadow)
            + SUN * gloss * 0.5
    }

    /// A closed surface of foliage, in soft light.
    fn blob(&self, at: Vec3, normal: Vec3, uv: Vec2) -> Vec3 {
        let tint = if self.scene.has_tiles { clumps::tint(clumps::height(uv.x, uv.y)) } else { Vec3::ONE };
        let color = self.scene.colors.leaf * tint;
        // Seen from outside only. A smooth normal at the rim may look away, and is still the right one.
        let sky = self.scene.crown.sky_at(at + normal * 0.05);
        let Some(sun) = &self.sun else { return color * self.even(at, normal, sky) };
        // Wrapped around the edge of the shadow: a ball of leaves is softer than a solid ball.
        let wrapped = (normal.dot(sun.towards) * 0.7 + 0.3).max(0.0);
        let shadow = sun.at(at + normal * 0.02, 2, 1.6);
        color * (SUN * (wrapped * shadow) + self.sky_light(normal, sky))
    }

    /// The normal of a leaf that looks towards the viewer, leant away from the crown's heart where a whole tree is shown on
    /// a card: its side that is turned to the light has to be the lighter one, as shadows make it on the tree.
    fn of_body(&self, at: Vec3, facing: Vec3) -> Vec3 {
        if self.suns.is_empty() {
            return facing;
        }
        (facing + (at - self.scene.heart).normalize_or_zero()).try_normalize().unwrap_or(facing)
    }

    /// The part of its colour that a place shows in even light, with this much of the sky open. With suns it is what is left
    /// of their light and the sky's by the crown's own shadows: who lights a card does not cast them again.
    fn even(&self, at: Vec3, normal: Vec3, open: f32) -> f32 {
        if self.suns.is_empty() {
            return 0.45 + 0.55 * open;
        }
        let [from_sky, whole_sky] = [open, 1.0].map(|open| self.sky_light(normal, open).y);
        let (mut lit, mut all) = (0.0, 0.0);
        for sun in self.suns {
            let direct = SUN.y * normal.dot(sun.towards).max(0.0);
            lit += direct * sun.at(at, 1, 1.0) + from_sky;
            all += direct + whole_sky;
        }
        BOUNCED * lit / all
    }

    /// Light from above and from the ground on a face, where this part of the sky is open.
    fn sky_light(&self, normal: Vec3, open: f32) -> Vec3 {
        let up = 0.5 + 0.5 * normal.z;
        (SKY * (0.35 + 0.65 * up) + BOUNCE * (1.0 - up)) * (0.06 + 0.94 * open)
    }

    /// How much of the ground is shown in a pixel: a picture that will stand on a page ends softly,
    /// where a studio's wall goes on behind the frame.
    fn margin(&self, x: u32, y: u32) -> f32 {
        if self.settings.background == Background::Studio {
            return 1.0;
        }
        let [width, height] = [self.settings.width, self.settings.height].map(|side| side as f32);
        let (left, above) = (x as f32 + 0.5, y as f32 + 0.5);
        let edge = left.min(width - left).min(height - above);
        smooth(0.0, 0.16 * width.min(height), edge)
    }

    /// The ground in a pixel: grass, or its shadow alone.
    fn ground(&self, x: u32, y: u32) -> Vec4 {
        let middle = |pixel: u32| (pixel as f32 + 0.5) * SAMPLES as f32;
        let ray = self.camera.ray(middle(x), middle(y));
        let Some(sun) = self.sun.as_ref().filter(|_| self.settings.ground != Ground::None && ray.z < -1e-4)
        else {
            return Vec4::ZERO;
        };
        let scene = self.scene;
        let at = self.camera.eye - ray * (self.camera.eye.z / ray.z);
        let away = (at - vec3(0.0, 0.0, at.z)).length() / (scene.high - scene.low).max_element().max(1e-3);
        let shown_part = (1.0 - smooth(0.9, 2.2, away)) * self.margin(x, y);
        if shown_part <= 0.0 {
            return Vec4::ZERO;
        }
        let open = scene.crown.sky_at(at + Vec3::Z * 0.05);
        let shadow = sun.at(at, 2, 1.6);
        let sunlit = SUN * (sun.towards.z * shadow);
        let light = sunlit + SKY * open;
        let full = SUN * sun.towards.z + SKY;
        match self.settings.ground {
            Ground::Grass => {
                let blade = 0.8 + 0.2 * (at.x * 9.0 + (at.y * 7.0).sin() * 2.0).sin() * (at.y * 8.0).cos();
                let grass = vec3(0.115, 0.155, 0.05) * blade;
                shown(grass * light).extend(1.0) * shown_part
            }
            _ => {
                let dark = 1.0 - (light.element_sum() / full.element_sum()).clamp(0.0, 1.0);
                let alpha = 0.62 * dark * shown_part;
                (vec3(0.10, 0.11, 0.14) * alpha).extend(alpha)
            }
        }
    }
}

/// Light as it is shown, 0 to 1: straight in the dark, rolling off towards white.
fn shown(light: Vec3) -> Vec3 {
    let x = light / WHITE * 1.9;
    // x·(1 + x/w²) / (1 + x): Reinhard and others 2002, equation 4, with w = 2.6.
    x * (Vec3::ONE + x / 6.76) / (Vec3::ONE + x)
}

fn to_srgb(linear: f32) -> u8 {
    let c = linear.clamp(0.0, 1.0);
    let s = if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    (s * 255.0).round() as u8
}
