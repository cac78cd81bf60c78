//! The normal distribution's tail, and back.

use pleach_tree::math;

/// The chance that a standard normal number is above `x`, with an error below 1e-7 (Abramowitz and
/// Stegun 1964, 26.2.17).
pub(super) fn tail(x: f64) -> f64 {
    const B: [f64; 5] = [0.319_381_530, -0.356_563_782, 1.781_477_937, -1.821_255_978, 1.330_274_429];
    if x < 0.0 {
        return 1.0 - tail(-x);
    }
    let t = 1.0 / (1.0 + 0.231_641_9 * x);
    density(x) * t * B.iter().rev().fold(0.0, |sum, b| sum * t + b)
}

/// The number x ≥ 0 of which [`tail`] is `p`, for `p` above 0; 0 for one half and more (the same,
/// 26.2.23, then a step of Newton's).
pub(super) fn tail_at(p: f64) -> f64 {
    if p >= 0.5 {
        return 0.0;
    }
    let t = (-2.0 * math::ln(p)).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    let x = t - above / below;
    (x + (tail(x) - p) / density(x)).max(0.0)
}

fn density(x: f64) -> f64 {
    math::exp(-0.5 * x * x) / std::f64::consts::TAU.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_quantiles() {
        for (x, p) in [(0.0, 0.5), (1.0, 0.158_655_254), (1.959_963_985, 0.025), (3.090_232_306, 1e-3)] {
            assert!((tail(x) - p).abs() < 1e-7, "{x}: {}", tail(x));
            assert!((tail_at(p) - x).abs() < 1e-4, "{p}: {}", tail_at(p));
        }
        assert!((tail(-1.0) + tail(1.0) - 1.0).abs() < 1e-12);
    }
}
