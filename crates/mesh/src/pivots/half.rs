//! Floating-point numbers of 16 bits (IEEE 754 binary16).

/// The bits of the half float that is nearest to `value`; of two, the even one. What is too large becomes infinite.
pub(super) fn from_f32(value: f32) -> u16 {
    let bits = value.to_bits();
    let sign = (bits >> 16) as u16 & 0x8000;
    let size = bits & 0x7fff_ffff;
    let half = if value.is_nan() {
        0x7e00
    } else if value.abs() >= 65_536.0 {
        0x7c00
    } else if value.abs() < 1.0 / 16_384.0 {
        // Whole multiples of 2^-24.
        (value.abs() * 16_777_216.0).round_ties_even() as u16
    } else {
        // The exponent counts from 15 and no longer from 127, and 13 bits of the fraction go.
        let rebased = size - (112 << 23);
        ((rebased + 0xfff + (rebased >> 13 & 1)) >> 13) as u16
    };
    sign | half
}

/// The number that `bits` stand for.
#[cfg(test)]
pub(super) fn to_f32(bits: u16) -> f32 {
    let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
    let (exponent, fraction) = (i32::from(bits >> 10 & 0x1f), f32::from(bits & 0x3ff));
    sign * match exponent {
        0 => fraction / 16_777_216.0,
        31 if fraction > 0.0 => f32::NAN,
        31 => f32::INFINITY,
        _ => (1.0 + fraction / 1024.0) * 2.0_f32.powi(exponent - 15),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_half_float_comes_back() {
        for bits in 0..=u16::MAX {
            let value = to_f32(bits);
            if !value.is_nan() {
                assert_eq!(from_f32(value), bits, "{value}");
            }
        }
        assert!(to_f32(from_f32(f32::NAN)).is_nan());
    }

    #[test]
    fn what_is_between_two_goes_to_the_nearest() {
        for (value, nearest) in [
            (2049.0, 2048.0),
            (2051.0, 2052.0),
            (1024.6, 1025.0),
            (-1024.4, -1024.0),
            (65_519.0, 65_504.0),
            (65_521.0, f32::INFINITY),
            (1e9, f32::INFINITY),
            (0.4 / 16_777_216.0, 0.0),
            (0.6 / 16_777_216.0, 1.0 / 16_777_216.0),
        ] {
            assert_eq!(to_f32(from_f32(value)), nearest, "{value}");
        }
    }
}
