//! Spearman's rank correlation (Spearman 1904).

/// Spearman's rank correlation of pairs, in -1..=1, equal values with the mean of their ranks; `None` of less than
/// three pairs, or where all values of one side are equal.
pub(crate) fn spearman(pairs: &[(f64, f64)]) -> Option<f64> {
    if pairs.len() < 3 {
        return None;
    }
    let a = ranks(&pairs.iter().map(|pair| pair.0).collect::<Vec<_>>());
    let b = ranks(&pairs.iter().map(|pair| pair.1).collect::<Vec<_>>());
    // Ties leave the mean of ranks as it is.
    let mean = (pairs.len() - 1) as f64 / 2.0;
    let product =
        |x: &[f64], y: &[f64]| -> f64 { x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum() };
    let spread = (product(&a, &a) * product(&b, &b)).sqrt();
    (spread > 0.0).then(|| product(&a, &b) / spread)
}

/// The place of each value among all, from 0.
fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |value: &f64| {
        let lower = values.iter().filter(|other| *other < value).count();
        let equal = values.iter().filter(|other| *other == value).count();
        lower as f64 + (equal - 1) as f64 / 2.0
    };
    values.iter().map(rank).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_agree_whatever_the_scale() {
        let with = |b: [f64; 5]| spearman(&[1.0, 2.0, 3.0, 4.0, 5.0].into_iter().zip(b).collect::<Vec<_>>());
        assert_eq!(with([0.1, 0.2, 5.0, 7.0, 100.0]), Some(1.0));
        assert_eq!(with([9.0, 8.0, 2.0, 1.0, 0.0]), Some(-1.0));
        // By hand: ranks 0.5, 0.5, 2, 3.5, 3.5.
        assert!((with([1.0, 1.0, 2.0, 3.0, 3.0]).unwrap() - 9.0 / 90.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(with([1.0; 5]), None);
        assert_eq!(spearman(&[(0.0, 1.0), (1.0, 2.0)]), None);
    }
}
