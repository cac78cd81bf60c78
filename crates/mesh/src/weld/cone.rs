//! How far a point is from a piece of stem: two spheres and everything between them.

use glam::DVec3;

/// The hull of two spheres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    pub(super) from: DVec3,
    pub(super) to: DVec3,
    /// Radii at `from` and `to`, in metres.
    pub(super) radii: [f64; 2],
    /// Whether the end at `from` is cut off flat, as the foot of a trunk is.
    pub(super) foot: bool,
    /// How far fillets at its joints raise the surface at most, in metres.
    pub(super) swell: f64,
}

impl Cone {
    /// Metres from `p` to the surface, negative inside.
    ///
    /// This is the least of |p − c(t)| − r(t) over the spheres between the two ends. Each of those changes
    /// by at most a metre a metre, so the whole does too, for any taper.
    pub(super) fn distance(&self, p: DVec3) -> f64 {
        let axis = self.to - self.from;
        let length = axis.length();
        let [a, b] = self.radii;
        let ahead = if length > 1e-9 { (p - self.from).dot(axis) / length } else { 0.0 };
        let t = if length > (a - b).abs() + 1e-9 {
            // The nearest sphere stands where the way to `p` leaves the surface at a right angle.
            let k = (a - b) / length;
            let aside = ((p - self.from).length_squared() - ahead * ahead).max(0.0).sqrt();
            ((ahead - k * aside / (1.0 - k * k).sqrt()) / length).clamp(0.0, 1.0)
        } else {
            // One sphere holds the other.
            f64::from(u8::from(b > a))
        };
        let round = p.distance(self.from + axis * t) - (a + (b - a) * t);
        if self.foot { round.max(-ahead) } else { round }
    }

    /// About how many cubic metres lie nearer to the surface than `margin` metres.
    pub(super) fn volume_around(&self, margin: f64) -> f64 {
        let radius = (self.radii[0] + self.radii[1]) / 2.0;
        let ring = (radius + margin).powi(2) - (radius - margin).max(0.0).powi(2);
        std::f64::consts::PI * ring * self.from.distance(self.to)
    }

    /// Smallest and largest coordinates of what is nearer than `margin` metres.
    pub(super) fn bounds(&self, margin: f64) -> (DVec3, DVec3) {
        let reach = DVec3::splat(self.radii[0].max(self.radii[1]) + margin);
        (self.from.min(self.to) - reach, self.from.max(self.to) + reach)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    #[test]
    fn the_distance_is_that_to_the_nearest_sphere() {
        let pairs = [(0.5, 0.2), (0.2, 0.5), (0.3, 0.3), (0.9, 0.05), (2.5, 0.1)];
        for (a, b) in pairs {
            let (from, to) = (dvec3(0.3, -0.2, 0.1), dvec3(0.9, 0.7, 1.4));
            let cone = Cone { from, to, radii: [a, b], foot: false, swell: 0.0 };
            for i in 0..300 {
                let f = |step: f64| 4.0 * ((f64::from(i) * step).fract() - 0.5);
                let p = dvec3(f(0.618_034), f(0.754_878), f(0.569_84));
                let sphere = |k: i32| {
                    let t = f64::from(k) / 4000.0;
                    p.distance(from.lerp(to, t)) - (a + (b - a) * t)
                };
                let least = (0..=4000).map(sphere).fold(f64::INFINITY, f64::min);
                assert!((cone.distance(p) - least).abs() < 1e-5, "{a} {b} {p}");
            }
        }
    }
}
