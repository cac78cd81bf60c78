//! Sine, cosine and arc tangent for the inner loops of growing.
//!
//! A quarter of the time of growing went into the platform's functions. These are polynomials after
//! range reduction, good to 10⁻¹² (a leaf is placed to 10⁻⁶ m), inlined, and made of additions and
//! multiplications alone, so that they give the same bits on every platform.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, FRAC_PI_4, PI};

/// π/2 in two parts: the first has 33 significant bits, so small multiples of it are exact.
const HALF_PI_HIGH: f64 = 1.570_796_326_734_125_6;
const HALF_PI_LOW: f64 = 6.077_100_506_506_192e-11;
/// Adding and subtracting this rounds to the nearest integer.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// Sine and cosine of `x` radians, each within 10⁻¹² for |x| up to 10⁵; slower beyond.
#[inline]
#[must_use]
pub fn sin_cos(x: f64) -> (f64, f64) {
    if is_near(x) { near_sin_cos(x) } else { crate::math::sin_cos(x) }
}

/// Whether |x|, in radians, is at most 10⁵: what [`near_sin_cos`] is for.
#[inline]
#[must_use]
pub fn is_near(x: f64) -> bool {
    x.abs() <= 1e5
}

/// [`sin_cos`] of `x` radians that are [near](is_near), to the same bits and without a branch; some numbers elsewhere.
#[inline]
#[must_use]
pub fn near_sin_cos(x: f64) -> (f64, f64) {
    let shifted = x * FRAC_2_PI + ROUNDER;
    let quarter = shifted.to_bits();
    let turns = shifted - ROUNDER;
    let r = (x - turns * HALF_PI_HIGH) - turns * HALF_PI_LOW;
    let u = r * r;
    // Taylor series on [−π/4, π/4]: the first terms left out are below 10⁻¹³.
    let sin = r
        * (1.0
            + u * (-1.0 / 6.0
                + u * (1.0 / 120.0
                    + u * (-1.0 / 5040.0
                        + u * (1.0 / 362_880.0 + u * (-1.0 / 39_916_800.0 + u / 6_227_020_800.0))))));
    let cos = 1.0
        + u * (-0.5
            + u * (1.0 / 24.0
                + u * (-1.0 / 720.0
                    + u * (1.0 / 40_320.0
                        + u * (-1.0 / 3_628_800.0 + u * (1.0 / 479_001_600.0 - u / 87_178_291_200.0))))));
    // Quarter turns swap the two and change signs; selected, not branched on, since the quarter is
    // as good as random and a wrong guess costs more than the polynomials.
    let swap = 0_u64.wrapping_sub(quarter & 1);
    let (sin, cos) = (sin.to_bits(), cos.to_bits());
    let difference = (sin ^ cos) & swap;
    let sin_sign = (quarter & 2) << 62;
    let cos_sign = (quarter.wrapping_add(1) & 2) << 62;
    (f64::from_bits(sin ^ difference ^ sin_sign), f64::from_bits(cos ^ difference ^ cos_sign))
}

/// The angle of the vector (`x`, `y`) from the x axis, in [−π, π], within 10⁻¹²; 0 for (0, 0).
#[inline]
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    let (ax, ay) = (x.abs(), y.abs());
    let steep = ax < ay;
    let (low, high) = (if steep { ax } else { ay }, if steep { ay } else { ax });
    // tan(π/8) and above: atan(q) = π/4 + atan((q − 1)/(q + 1)).
    let far = low > 0.414_213_562_373_095 * high;
    let above = if far { high } else { 0.0 };
    let below = if far { low } else { 0.0 };
    let q = (low - above) / (high + below);
    let base = if far { FRAC_PI_4 } else { 0.0 };
    let u = q * q;
    // Interpolates atan(√u)/√u at the Chebyshev nodes of [0, tan²(π/8)]; error 2.8·10⁻¹³.
    let p = 0.999_999_999_999_244_7
        + u * (-0.333_333_332_769_224_94
            + u * (0.199_999_930_535_558_15
                + u * (-0.142_853_865_537_521_39
                    + u * (0.111_034_569_089_474_64
                        + u * (-0.089_925_529_061_509_11
                            + u * (0.069_741_976_865_952_63 - u * 0.037_655_106_012_913_01))))));
    // Each fold of the plane back onto the first eighth, as a sign and an offset.
    let angle = base + q * p;
    let angle = if steep { FRAC_PI_2 - angle } else { angle };
    let angle = if x < 0.0 { PI - angle } else { angle };
    // Chosen at the end, so that there is no branch.
    if high == 0.0 { 0.0 } else { angle.copysign(y) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_agree_with_the_platform() {
        for i in -200_000..200_000 {
            let x = f64::from(i) * 0.001_37;
            let (sin, cos) = sin_cos(x);
            assert!((sin - x.sin()).abs() < 1e-12 && (cos - x.cos()).abs() < 1e-12, "{x}: {sin} {cos}");
        }
        for x in [99_999.9, -31_415.926, 2e9] {
            let (sin, cos) = sin_cos(x);
            assert!((sin - x.sin()).abs() < 1e-11 && (cos - x.cos()).abs() < 1e-11, "{x}");
        }
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::INFINITY).1.is_nan());
    }

    #[test]
    fn arc_tangent_agrees_with_the_platform() {
        for i in 0..100_000 {
            let angle = f64::from(i) * 1e-4 - 5.0;
            let (y, x) = (angle.sin() * (1.0 + angle * angle), angle.cos() * (1.0 + angle * angle));
            assert!((atan2(y, x) - y.atan2(x)).abs() < 1e-12, "{y} {x}");
        }
        assert_eq!(atan2(0.0, 0.0), 0.0);
        assert_eq!(atan2(0.0, -1.0), PI);
        assert_eq!(atan2(1.0, 0.0), FRAC_PI_2);
        assert!(atan2(f64::NAN, 1.0).is_nan());
    }
}
