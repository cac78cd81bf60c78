//! Verdicts in the cells of a table.

use pleach_fit::KindVerdict;

/// From the worst to the best.
const VERDICTS: [KindVerdict; 4] =
    [KindVerdict::NoMoreThanAnother, KindVerdict::NotOfItsKind, KindVerdict::Roughly, KindVerdict::OfItsKind];

/// The words of a verdict, without its reason.
pub(super) fn words(verdict: KindVerdict) -> String {
    let text = verdict.to_string();
    text.split_once(':').map_or(text.as_str(), |(words, _)| words).to_owned()
}

/// How good the verdict of these words is: 0 is the worst; `None` of an empty cell.
pub(super) fn rank(verdict: &str) -> Option<f64> {
    VERDICTS.iter().position(|known| words(*known) == verdict).map(|place| place as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_are_told_apart_by_their_words() {
        let ranks = [1.0, 0.5, 0.2, 0.0].map(|share| rank(&words(KindVerdict::from_share(share))));
        assert_eq!(ranks, [Some(3.0), Some(2.0), Some(1.0), Some(0.0)]);
        assert_eq!(words(KindVerdict::Roughly), "roughly of its kind");
        assert_eq!(rank(""), None);
    }
}
