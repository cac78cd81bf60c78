//! Medians and spreads that a few odd values do not move.

/// The value below which the part `share` of `values` lies; `None` of none. Puts them in another order.
pub(super) fn quantile(values: &mut [f32], share: f64) -> Option<f32> {
    let place = (share * values.len().saturating_sub(1) as f64).round() as usize;
    if place >= values.len() {
        return None;
    }
    let (_, value, _) = values.select_nth_unstable_by(place, f32::total_cmp);
    Some(*value)
}

/// Median and spread: half of the range that the middle 68 % lie in, the standard deviation of a normal
/// distribution.
pub(super) fn median_and_spread(values: &mut [f32]) -> Option<(f32, f32)> {
    let middle = quantile(values, 0.5)?;
    let (low, high) = (quantile(values, 0.16)?, quantile(values, 0.84)?);
    Some((middle, (high - low) / 2.0))
}

/// 0 at `from` and before, 1 at `to` and beyond, straight between; `from` may be the larger one.
pub(super) fn ramp(from: f64, to: f64, x: f64) -> f64 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values_of_the_list() {
        assert_eq!(quantile(&mut [], 0.5), None);
        assert_eq!(quantile(&mut [3.0, 1.0, 2.0], 0.5), Some(2.0));
        assert_eq!(median_and_spread(&mut [7.0]), Some((7.0, 0.0)));
        let mut even: Vec<f32> = (0..101).map(|i| i as f32).collect();
        assert_eq!(median_and_spread(&mut even), Some((50.0, 34.0)));
        assert_eq!([ramp(1.0, 3.0, 2.0), ramp(3.0, 1.0, 2.5), ramp(0.0, 1.0, 7.0)], [0.5, 0.25, 1.0]);
    }
}
