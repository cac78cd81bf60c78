//! How far a point is from a piece of stem: two spheres and everything between them.

use glam::DVec3;
use pleach_plant::math;

/// A unit vector, and how far along it the plane lies, in metres.
#[derive(Clone, Copy, Debug)]
struct Plane {
    up: DVec3,
    height: f64,
}

/// The hull of two spheres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    pub(super) from: DVec3,
    pub(super) to: DVec3,
    /// Radii at `from` and `to`, in metres.
    pub(super) radii: [f64; 2],
    /// What lies behind this plane is cut off, as below the foot of a trunk.
    foot: Option<Plane>,
    /// Unit vector from `from` to `to`; zero where they are the same point.
    axis: DVec3,
    length: f64,
    /// By how much the radius grows per metre along the axis.
    taper: f64,
    /// The nearest sphere stands this many metres farther back per metre aside of the axis; `None` where one
    /// sphere holds the other.
    slant: Option<f64>,
}

impl Plane {
    /// Metres from the plane to `p`, negative behind it.
    fn ahead(&self, p: DVec3) -> f64 {
        p.dot(self.up) - self.height
    }
}

impl Cone {
    pub(super) fn new(from: DVec3, to: DVec3, radii: [f64; 2]) -> Self {
        let length = from.distance(to);
        let [a, b] = radii;
        let axis = if length > 1e-9 { (to - from) / length } else { DVec3::ZERO };
        // The nearest sphere stands where the way to the point leaves the surface at a right angle.
        let k = (a - b) / length;
        let slant = (length > (a - b).abs() + 1e-9).then(|| k / (1.0 - k * k).sqrt());
        let taper = if length > 0.0 { (b - a) / length } else { 0.0 };
        Self { from, to, radii, foot: None, axis, length, taper, slant }
    }

    /// Cuts the pieces of one stem off flat where it begins, at right angles to it. Its first ones may be
    /// shorter than the stem is thick, and each would bulge through the cut.
    ///
    /// A stem of few cells stays whole, and so does one that soon turns back: a cut could leave nothing of
    /// them, or part them from what they bear.
    pub(super) fn cut_foot(pieces: &mut [Self], cell: f64) {
        let Some((base, up)) = pieces.first().zip(pieces.iter().map(Self::axis).find(|a| *a != DVec3::ZERO))
        else {
            return;
        };
        let plane = Plane { up, height: base.from.dot(up) };
        let is_above = |cone: &Self| {
            let [a, b] = cone.radii;
            plane.ahead(cone.from) >= a && plane.ahead(cone.to) >= b
        };
        let is_thick = base.radii[0] > 2.0 * cell;
        let end = pieces.iter().position(is_above).unwrap_or(pieces.len());
        let cut = &mut pieces[..end];
        let is_long = cut.last().is_some_and(|last| plane.ahead(last.to) > cell);
        if is_thick && is_long && cut.iter().all(|cone| plane.ahead(cone.to) > -1e-9) {
            cut.iter_mut().for_each(|cone| cone.foot = Some(plane));
        }
    }

    /// Unit vector from `from` to `to`; zero where they are the same point.
    pub(super) const fn axis(&self) -> DVec3 {
        self.axis
    }

    /// Metres from `p` to the surface, negative inside.
    ///
    /// This is the least of |p − c(t)| − r(t) over the spheres between the two ends. Each of those changes
    /// by at most a metre per metre, so the whole does too, for any taper.
    #[inline]
    pub(super) fn distance(&self, p: DVec3) -> f64 {
        let away = p - self.from;
        let ahead = away.dot(self.axis);
        let aside = (away.length_squared() - ahead * ahead).max(0.0);
        let [a, b] = self.radii;
        let place = match self.slant {
            Some(slant) => (ahead - slant * aside.sqrt()).clamp(0.0, self.length),
            None if b > a => self.length,
            None => 0.0,
        };
        let radius = if self.length > 0.0 { a + self.taper * place } else { a.max(b) };
        let round = (aside + (ahead - place) * (ahead - place)).sqrt() - radius;
        self.foot.map_or(round, |plane| round.max(-plane.ahead(p)))
    }

    /// The place on the axis that is nearest to `p`, 0 at `from` to 1 at `to`.
    pub(super) fn nearest(&self, p: DVec3) -> f64 {
        if self.length > 0.0 { ((p - self.from).dot(self.axis) / self.length).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// About how many cubic metres lie nearer to the surface than `margin` metres.
    pub(super) fn volume_around(&self, margin: f64) -> f64 {
        let radius = (self.radii[0] + self.radii[1]) / 2.0;
        let ring = math::powi(radius + margin, 2) - math::powi((radius - margin).max(0.0), 2);
        std::f64::consts::PI * ring * self.length
    }

    /// Smallest and largest coordinates of what is nearer than `margin` metres.
    pub(super) fn bounds(&self, margin: f64) -> (DVec3, DVec3) {
        let reach = DVec3::splat(self.radii[0].max(self.radii[1]) + margin);
        (self.from.min(self.to) - reach, self.from.max(self.to) + reach)
    }
}

#[cfg(test)]
impl Cone {
    /// Whether it is cut off flat nearer than `margin` metres to `p`.
    pub(super) fn foot_near(&self, p: DVec3, margin: f64) -> bool {
        self.foot.is_some_and(|plane| plane.ahead(p).abs() < margin) && self.distance(p) < margin
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    fn points() -> impl Iterator<Item = DVec3> {
        (0..300).map(|i| {
            let f = |step: f64| 4.0 * ((f64::from(i) * step).fract() - 0.5);
            dvec3(f(0.618_034), f(0.754_878), f(0.569_84))
        })
    }

    #[test]
    fn the_distance_is_that_to_the_nearest_sphere() {
        let pairs = [(0.5, 0.2), (0.2, 0.5), (0.3, 0.3), (0.9, 0.05), (2.5, 0.1)];
        for (a, b) in pairs {
            let (from, to) = (dvec3(0.3, -0.2, 0.1), dvec3(0.9, 0.7, 1.4));
            let cone = Cone::new(from, to, [a, b]);
            for p in points() {
                let sphere = |k: i32| {
                    let t = f64::from(k) / 4000.0;
                    p.distance(from.lerp(to, t)) - (a + (b - a) * t)
                };
                let least = (0..=4000).map(sphere).fold(f64::INFINITY, f64::min);
                assert!((cone.distance(p) - least).abs() < 1e-5, "{a} {b} {p}");
            }
        }
    }

    #[test]
    fn a_piece_without_a_length_is_a_ball() {
        let at = dvec3(0.3, -0.2, 0.1);
        let mut cones = [Cone::new(at, at, [0.2, 0.5])];
        Cone::cut_foot(&mut cones, 0.01);
        let [cone] = cones;
        for p in points() {
            assert!((cone.distance(p) - (p.distance(at) - 0.5)).abs() < 1e-12);
        }
    }

    fn distance(cones: &[Cone], p: DVec3) -> f64 {
        cones.iter().map(|cone| cone.distance(p)).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_foot_is_flat_however_short_the_first_pieces_are() {
        let stem = |heights: [f64; 4]| {
            let piece = |i: usize| Cone::new(DVec3::Z * heights[i], DVec3::Z * heights[i + 1], [0.4, 0.4]);
            let mut cones = [0, 1, 2].map(piece);
            Cone::cut_foot(&mut cones, 0.05);
            cones
        };
        let below = dvec3(0.1, 0.0, -0.07);
        for heights in [[0.0, 1.0, 2.0, 3.0], [0.0, 0.0, 0.1, 3.0], [0.0, 0.1, 0.2, 0.3]] {
            assert!((distance(&stem(heights), below) - 0.07).abs() < 1e-12, "{heights:?}");
        }
        // What turns back is not cut, nor is what is shorter than a cell.
        for heights in [[0.0, 0.1, -0.2, 3.0], [0.0, 0.01, 0.02, 0.03]] {
            assert!(distance(&stem(heights), below) < -0.2, "{heights:?}");
        }
    }
}
