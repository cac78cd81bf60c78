//! Functions of mathematics that give the same bits on every platform.
//!
//! Rust leaves the precision of `powf`, `sin` and their like to the system's library, which differs in the last bit
//! from one to the next, and a search that goes on from there differs in everything. These are the `libm` crate's,
//! compiled in. `clippy.toml` forbids the others; for sine, cosine and arc tangent in inner loops see [`crate::trig`].

pub use libm::{
    acos, asin, atan, cbrt, cbrtf, cos, exp, expf, expm1, hypot, hypotf, log as ln, log1p, log2, log2f,
    log10, logf as lnf, pow, powf, sin, tan,
};

/// `x` to a whole power, by repeated squaring.
#[inline]
#[must_use]
pub fn powi(x: f64, n: i32) -> f64 {
    let (mut base, mut left, mut power) = (x, n.unsigned_abs(), 1.0);
    while left > 0 {
        if left & 1 == 1 {
            power *= base;
        }
        base *= base;
        left >>= 1;
    }
    if n < 0 { 1.0 / power } else { power }
}

/// Sine and cosine of `x` radians, as exact as can be; [`crate::trig::sin_cos`] is faster.
#[inline]
#[must_use]
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// The same in single precision.
#[inline]
#[must_use]
pub fn sin_cos_f32(x: f32) -> (f32, f32) {
    libm::sincosf(x)
}

/// The angle of the vector (`x`, `y`) from the x axis, in [−π, π]; [`crate::trig::atan2`] is faster.
#[inline]
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_powers_are_products() {
        for (x, n, power) in [(3.0, 4, 81.0), (-2.0, 3, -8.0), (2.0, -2, 0.25), (7.5, 0, 1.0), (0.0, 2, 0.0)]
        {
            assert_eq!(powi(x, n), power, "{x}^{n}");
        }
        assert_eq!(powi(1.1, 3), 1.1 * (1.1 * 1.1));
    }

    /// Written down from one platform: any other has to agree to the last bit.
    #[test]
    fn bits_are_those_of_every_platform() {
        let bits =
            [pow(0.3, 1.7), exp(-1.3), ln(0.7), tan(0.9), acos(0.2), cbrt(0.6), hypot(0.3, 0.7), expm1(0.2)]
                .map(f64::to_bits);
        assert_eq!(
            bits,
            [
                4593821265024622477,
                4598581116244124289,
                13823468941351141200,
                4608354067251634488,
                4608846221467635921,
                4605772185619606540,
                4605034898129617804,
                4597144895323726952,
            ]
        );
    }
}
