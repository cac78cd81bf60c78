//! One piece of a stem: a cubic Bézier curve in space.

use glam::DVec3;

/// A cubic Bézier curve by its four control points, in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic {
    /// Start, first handle, second handle, end.
    pub points: [DVec3; 4],
}

impl Cubic {
    /// The curve from `start` to `end` with the given handles.
    #[must_use]
    pub const fn new(start: DVec3, handle_out: DVec3, handle_in: DVec3, end: DVec3) -> Self {
        Self { points: [start, handle_out, handle_in, end] }
    }

    /// The point at `t` in [0, 1].
    #[must_use]
    pub fn at(&self, t: f64) -> DVec3 {
        let [a, b, c, d] = self.points;
        let s = 1.0 - t;
        a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t)
    }

    /// The derivative with respect to `t`, not normalised.
    #[must_use]
    pub fn derivative(&self, t: f64) -> DVec3 {
        let [a, b, c, d] = self.points;
        let s = 1.0 - t;
        ((b - a) * (s * s) + (c - b) * (2.0 * s * t) + (d - c) * (t * t)) * 3.0
    }

    /// The second derivative with respect to `t`.
    #[must_use]
    pub fn second_derivative(&self, t: f64) -> DVec3 {
        let [a, b, c, d] = self.points;
        ((a - b * 2.0 + c) * (1.0 - t) + (b - c * 2.0 + d) * t) * 6.0
    }

    /// The unit tangent at `t`, or `fallback` where the curve stands still.
    #[must_use]
    pub fn tangent(&self, t: f64, fallback: DVec3) -> DVec3 {
        self.derivative(t).try_normalize().unwrap_or(fallback)
    }

    /// How many chords, evenly spaced in `t`, stray at most `tolerance` metres from the curve.
    ///
    /// An upper bound from the second differences of the control points (a cubic's chord error over
    /// a step h is at most h²/8 · max|second derivative|). Grows as `tolerance^-1/2`; at least 1.
    #[must_use]
    pub fn chords(&self, tolerance: f64) -> u32 {
        let [a, b, c, d] = self.points;
        let bend = (a - b * 2.0 + c).length_squared().max((b - c * 2.0 + d).length_squared()).sqrt();
        // Second derivative of a cubic Bézier: at most 6 times the larger second difference.
        let chords = (0.75 * bend / tolerance).sqrt().ceil();
        if chords >= 1.0 { chords.min(1024.0) as u32 } else { 1 }
    }

    /// Length of the polyline with `chords` chords, in metres.
    #[must_use]
    pub fn length(&self, chords: u32) -> f64 {
        let mut length = 0.0;
        let mut last = self.points[0];
        for i in 1..=chords {
            let point = self.at(f64::from(i) / f64::from(chords));
            length += last.distance(point);
            last = point;
        }
        length
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;

    fn arc() -> Cubic {
        // A quarter of the unit circle, good to 2.7e-4.
        let k = 0.552_284_749_831;
        Cubic::new(dvec3(1.0, 0.0, 0.0), dvec3(1.0, k, 0.0), dvec3(k, 1.0, 0.0), dvec3(0.0, 1.0, 0.0))
    }

    #[test]
    fn ends_and_tangents() {
        let arc = arc();
        assert_eq!(arc.at(0.0), dvec3(1.0, 0.0, 0.0));
        assert_eq!(arc.at(1.0), dvec3(0.0, 1.0, 0.0));
        assert!((arc.tangent(0.0, DVec3::Z) - DVec3::Y).length() < 1e-12);
        assert!((arc.tangent(1.0, DVec3::Z) + DVec3::X).length() < 1e-12);
        let still = Cubic::new(DVec3::ZERO, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        assert_eq!(still.tangent(0.5, DVec3::Z), DVec3::Z);
    }

    #[test]
    fn derivative_agrees_with_differences() {
        let arc = arc();
        for i in 1..10 {
            let t = f64::from(i) / 10.0;
            let numeric = (arc.at(t + 1e-6) - arc.at(t - 1e-6)) / 2e-6;
            assert!((arc.derivative(t) - numeric).length() < 1e-8);
            let numeric = (arc.derivative(t + 1e-6) - arc.derivative(t - 1e-6)) / 2e-6;
            assert!((arc.second_derivative(t) - numeric).length() < 1e-8);
        }
    }

    #[test]
    fn flattening_keeps_its_tolerance() {
        let arc = arc();
        for exponent in 1..12 {
            let tolerance = 0.5_f64.powi(exponent);
            let n = arc.chords(tolerance);
            let mut worst = 0.0_f64;
            for i in 0..n {
                let (t0, t1) = (f64::from(i) / f64::from(n), f64::from(i + 1) / f64::from(n));
                let (p, q) = (arc.at(t0), arc.at(t1));
                for k in 1..8 {
                    let point = arc.at(t0 + (t1 - t0) * f64::from(k) / 8.0);
                    let along = (q - p).normalize();
                    worst = worst.max(((point - p) - along * (point - p).dot(along)).length());
                }
            }
            assert!(worst <= tolerance, "{n} chords stray {worst} > {tolerance}");
        }
        assert!((arc.length(512) - std::f64::consts::FRAC_PI_2).abs() < 3e-4);
    }
}
