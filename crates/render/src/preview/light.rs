//! The sun and its shadows.

use super::scene::Scene;
use glam::{Vec3, vec3};

/// The sun's shadow map: a depth buffer along its rays.
#[derive(Clone, Debug)]
pub(crate) struct Sun {
    /// Unit vector towards the sun.
    pub(crate) towards: Vec3,
    right: Vec3,
    up: Vec3,
    /// The corners of what is included, in metres along `right`, `up` and `towards`.
    low: Vec3,
    high: Vec3,
    /// Texels a metre.
    scale: f32,
    width: u32,
    height: u32,
    /// For each texel how far towards the sun the mesh reaches, as [`Sun::place`] measures it.
    near: Vec<f32>,
}

impl Sun {
    /// The sun in direction `towards` over nothing yet.
    pub(super) fn new(towards: Vec3) -> Self {
        let right = Vec3::Z.cross(towards).try_normalize().unwrap_or(Vec3::X);
        Self {
            towards,
            right,
            up: towards.cross(right),
            low: Vec3::INFINITY,
            high: Vec3::NEG_INFINITY,
            scale: 1.0,
            width: 0,
            height: 0,
            near: Vec::new(),
        }
    }

    /// Makes room for a point of the scene.
    pub(super) fn include(&mut self, p: Vec3) {
        let seen = vec3(p.dot(self.right), p.dot(self.up), p.dot(self.towards));
        (self.low, self.high) = (self.low.min(seen), self.high.max(seen));
    }

    /// Shines on a scene, all of whose points are included, with about `texels` texels across it.
    pub(super) fn shine(&mut self, scene: &Scene<'_>, texels: u32) {
        let extent = (self.high - self.low).max(Vec3::splat(1e-3));
        self.scale = texels as f32 / extent.x.max(extent.y);
        [self.width, self.height] = [extent.x, extent.y].map(|e| (e * self.scale).ceil() as u32 + 1);
        self.near = scene.draw(self.width, self.height, |point| self.place(point)).near;
    }

    /// Texels, and metres towards the sun from one before the mesh.
    fn place(&self, p: Vec3) -> Vec3 {
        vec3(
            (p.dot(self.right) - self.low.x) * self.scale,
            (p.dot(self.up) - self.low.y) * self.scale,
            p.dot(self.towards) - self.low.z + 1.0,
        )
    }

    /// Part of the sunlight that reaches `p`, over `2·reach + 1` texels a side.
    pub(crate) fn at(&self, p: Vec3, reach: i32, stride: f32) -> f32 {
        let at = self.place(p);
        let bias = 2.5 / self.scale;
        let margin = reach as f32 * stride;
        let is_beside = |x: f32, side: u32| x < -margin || x > side as f32 + margin;
        if is_beside(at.x, self.width) || is_beside(at.y, self.height) {
            return 1.0;
        }
        let mut lit = 0.0;
        for dy in -reach..=reach {
            for dx in -reach..=reach {
                let (x, y) = (at.x + dx as f32 * stride, at.y + dy as f32 * stride);
                lit += self.lit(x, y, at.z + bias);
            }
        }
        lit / ((2 * reach + 1) * (2 * reach + 1)) as f32
    }

    fn lit(&self, x: f32, y: f32, near: f32) -> f32 {
        let inside = x >= 0.0 && y >= 0.0 && x < self.width as f32 && y < self.height as f32;
        if !inside {
            return 1.0;
        }
        let nearest = self.near[y as usize * self.width as usize + x as usize];
        // Nothing is 0, which lies behind everything only where the mesh itself is.
        if nearest > near && nearest > 0.0 { 0.0 } else { 1.0 }
    }
}
