//! Numbers in one byte each.

use serde::{Deserialize, Serialize};

/// A list of numbers, each a whole multiple of one step: wrong by less than a part in 250 of the largest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Packed {
    step: f32,
    #[serde(with = "serde_bytes")]
    bytes: Vec<u8>,
}

impl Packed {
    pub(super) fn new(numbers: &[f64]) -> Self {
        let largest = numbers.iter().fold(0.0_f64, |most, number| most.max(number.abs()));
        // Rounded up, so that the largest number still has its place.
        let step = ((largest / f64::from(i8::MAX)) as f32).next_up();
        let whole = |number: &f64| (number / f64::from(step)).round() as i8;
        Self { step, bytes: numbers.iter().map(|number| whole(number).cast_unsigned()).collect() }
    }

    pub(super) fn len(&self) -> usize {
        self.bytes.len()
    }

    pub(super) fn is_finite(&self) -> bool {
        self.step.is_finite()
    }

    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> {
        let step = f64::from(self.step);
        self.bytes.iter().map(move |byte| step * f64::from(byte.cast_signed()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_nearly_as_they_were() {
        let numbers = [0.0, 1.0, -3.0, 2.999_99, 1e-9];
        let packed = Packed::new(&numbers);
        assert_eq!(packed.len(), numbers.len());
        assert!(packed.numbers().zip(numbers).all(|(is, was)| (is - was).abs() <= 3.0 / 250.0));
        assert!(Packed::new(&[0.0; 3]).numbers().eq([0.0; 3]));
    }
}
