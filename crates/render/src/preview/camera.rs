//! Where a picture is taken from.

use glam::{Vec2, Vec3, vec2, vec3};

/// A perspective camera that looks at a box from outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Camera {
    pub(crate) eye: Vec3,
    right: Vec3,
    up: Vec3,
    ahead: Vec3,
    /// Picture heights at distance 1, and the same across.
    focal: f32,
    size: Vec2,
    center: Vec2,
}

/// Half of the angle that the picture's shorter side covers: 14°, as through a portrait lens.
const HALF_ANGLE: f32 = 0.244;
/// Part of the picture that the box fills.
const FILL: f32 = 0.92;

impl Camera {
    /// The camera from `azimuth` and `elevation` (radians, as in silhouettes: azimuth 0 looks along +y)
    /// that shows `corners` (in metres) in a picture of this many samples.
    pub(crate) fn around(corners: &[Vec3], azimuth: f32, elevation: f32, width: u32, height: u32) -> Self {
        let ((sin_a, cos_a), (sin_e, cos_e)) = (azimuth.sin_cos(), elevation.sin_cos());
        let right = vec3(cos_a, sin_a, 0.0);
        let level = vec3(-sin_a, cos_a, 0.0);
        let up = level * sin_e + Vec3::Z * cos_e;
        let ahead = level * cos_e - Vec3::Z * sin_e;
        let low = corners.iter().copied().fold(Vec3::INFINITY, Vec3::min);
        let high = corners.iter().copied().fold(Vec3::NEG_INFINITY, Vec3::max);
        let target = (low + high) / 2.0;
        let size = vec2(width as f32, height as f32);
        let shorter = size.min_element();
        let focal = shorter / 2.0 / HALF_ANGLE.tan();
        let mut camera = Self { eye: target, right, up, ahead, focal, size, center: Vec2::ZERO };
        // Nearest distance at which every corner is inside, then the middle of what is seen.
        let reach = corners.iter().map(|c| c.distance(target)).fold(1e-3, f32::max);
        let (mut near, mut far) = (reach, reach * 40.0);
        for _ in 0..40 {
            let middle = (near * far).sqrt();
            camera.eye = target - ahead * middle;
            let (low, high) = camera.extent(corners);
            if ((high - low) / size).max_element() > FILL {
                near = middle;
            } else {
                far = middle;
            }
        }
        camera.eye = target - ahead * far;
        let (low, high) = camera.extent(corners);
        camera.center = -(low + high) / 2.0;
        camera
    }

    /// The camera so far away towards `azimuth` (radians) that a rectangle through `middle` of these half
    /// sides, in metres, fills the picture, and what lies before or behind it is hardly any larger or
    /// smaller.
    pub(crate) fn afar(middle: Vec3, azimuth: f32, half: [f32; 2], samples: [u32; 2]) -> Self {
        let (sin, cos) = azimuth.sin_cos();
        let (right, ahead) = (vec3(cos, sin, 0.0), vec3(-sin, cos, 0.0));
        let distance = 200.0 * half[0].max(half[1]).max(1e-3);
        let size = vec2(samples[0] as f32, samples[1] as f32);
        let focal = distance * size.y / (2.0 * half[1].max(1e-6));
        Self { eye: middle - ahead * distance, right, up: Vec3::Z, ahead, focal, size, center: Vec2::ZERO }
    }

    fn extent(&self, corners: &[Vec3]) -> (Vec2, Vec2) {
        let seen = corners.iter().map(|&c| {
            let v = c - self.eye;
            vec2(v.dot(self.right), -v.dot(self.up)) * (self.focal / v.dot(self.ahead).max(1e-3))
        });
        seen.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
    }

    /// Samples right and down, and one over the distance ahead; the latter is 0 or less behind the
    /// camera.
    pub(crate) fn project(&self, point: Vec3) -> Vec3 {
        let v = point - self.eye;
        let inverse = 1.0 / v.dot(self.ahead).max(1e-3);
        let scale = self.focal * inverse;
        let at = self.center + self.size / 2.0;
        vec3(at.x + v.dot(self.right) * scale, at.y - v.dot(self.up) * scale, inverse)
    }

    /// Unit vector from the eye through a sample.
    pub(crate) fn ray(&self, x: f32, y: f32) -> Vec3 {
        let p = vec2(x, y) - self.center - self.size / 2.0;
        (self.ahead * self.focal + self.right * p.x - self.up * p.y).normalize()
    }

    /// Samples that a metre at `point` covers.
    pub(crate) fn scale_at(&self, point: Vec3) -> f32 {
        self.focal / (point - self.eye).dot(self.ahead).max(1e-3)
    }
}
