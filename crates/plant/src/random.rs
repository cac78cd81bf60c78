//! Randomness by address.
//!
//! A draw is a function of (seed, address of the stem, purpose, index) and of nothing else. So one
//! more branch leaves the other branches as they were, a pruning trial needs no saved state, stems
//! may grow in any order or in parallel, and the picture of a tree changes no more than its
//! parameters do.
//!
//! The hash is the finaliser of SplitMix64 (Steele, Lea and Flood 2014, *Fast splittable
//! pseudorandom number generators*, §3) over the key and the address. It is not cryptographic.

/// The odd number nearest to 2⁶⁴ / φ, which spreads consecutive addresses over all bits.
const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;

/// What a draw is for; each generator numbers its own purposes.
pub type Purpose = u32;

/// The address of a stem (or of a whole tree), from which its draws and its children's keys follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Key(u64);

impl Key {
    /// The key of the tree that grows from `seed`.
    #[must_use]
    pub fn root(seed: u64) -> Self {
        Self(mix(seed.wrapping_add(GOLDEN)))
    }

    /// The key of the `index`-th child made for `purpose`.
    #[must_use]
    pub fn child(self, purpose: Purpose, index: u32) -> Self {
        Self(self.bits(purpose, index))
    }

    /// 64 uniform bits.
    #[must_use]
    pub fn bits(self, purpose: Purpose, index: u32) -> u64 {
        let address = (u64::from(purpose) << 32) | u64::from(index);
        mix(self.0.wrapping_add(address.wrapping_add(1).wrapping_mul(GOLDEN)))
    }

    /// A uniform number in [0, 1), a multiple of 2⁻⁵³.
    #[must_use]
    pub fn unit(self, purpose: Purpose, index: u32) -> f64 {
        (self.bits(purpose, index) >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    }

    /// A uniform number in [−1, 1).
    #[must_use]
    pub fn signed(self, purpose: Purpose, index: u32) -> f64 {
        2.0 * self.unit(purpose, index) - 1.0
    }
}

/// A bijection of 64 bits that lets every input bit reach every output bit.
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_depend_on_every_part_of_the_address() {
        let key = Key::root(7);
        let base = key.bits(3, 5);
        assert_ne!(base, key.bits(3, 6));
        assert_ne!(base, key.bits(4, 5));
        assert_ne!(base, Key::root(8).bits(3, 5));
        assert_ne!(base, key.child(0, 0).bits(3, 5));
        assert_eq!(base, Key::root(7).bits(3, 5));
    }

    #[test]
    fn draws_are_uniform_along_and_across_addresses() {
        // Mean and variance of n uniform numbers: 1/2 ± 0.29/√n and 1/12; five standard errors.
        let n = 100_000_u32;
        let along: Vec<f64> = (0..n).map(|i| Key::root(1).unit(2, i)).collect();
        let across: Vec<f64> = (0..n).map(|i| Key::root(u64::from(i)).child(1, 3).unit(2, 0)).collect();
        for draws in [along, across] {
            let mean = draws.iter().sum::<f64>() / f64::from(n);
            let variance = draws.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / f64::from(n);
            assert!((mean - 0.5).abs() < 5.0 * 0.289 / f64::from(n).sqrt(), "mean {mean}");
            assert!((variance - 1.0 / 12.0).abs() < 2e-3, "variance {variance}");
            assert!(draws.iter().all(|x| (0.0..1.0).contains(x)));
        }
    }

    #[test]
    fn neighbouring_draws_do_not_correlate() {
        let n = 100_000_u32;
        let product: f64 = (0..n).map(|i| Key::root(1).signed(2, i) * Key::root(1).signed(2, i + 1)).sum();
        assert!((product / f64::from(n)).abs() < 5.0 / 3.0 / f64::from(n).sqrt());
    }
}
