//! What to do after a fit.

use super::options::FitOptions;
use super::readings::Readings;
use super::words::{Leaves, StartFrom};
use pleach_fit::{KindVerdict, Verdict};
use pleach_generators::GeneratorChoice;
use pleach_reading::Measure;
use pleach_silhouette::goal::GoalWarning;
use serde::Serialize;
use std::fmt;

/// What to do after a fit: use it, or what may make it better. In JSON a word such as `search-longer`, so that a program or
/// a page can offer it as a command or a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum NextStep {
    /// The kind is found: grow more of it.
    GrowMore,
    /// One lucky tree is like the goal: score parameters over several seeds ([`FitOptions::robust`]).
    EverySeed,
    /// The goal's picture is odd: look at its mask, and correct it.
    CorrectMask,
    /// The goal may have leaves, and the tree has none ([`FitOptions::leaves`]).
    Leafy,
    /// The goal may have no leaves, and the tree has some.
    Bare,
    /// Trunks of the goal and of the tree differ: look at what was read in the picture, and say what is otherwise
    /// ([`FitOptions::reading`]).
    CorrectReading,
    /// No tree of these families is of the kind: search all of them ([`FitOptions::generator`]).
    AnyFamily,
    /// Search for more time ([`FitOptions::timeout`]).
    SearchLonger,
    /// The height of the tree was not said, and no picture shows it ([`FitOptions::height`]).
    TellHeight,
}

/// Whether there are leaves is doubtful below this confidence.
const SURE_OF_LEAVES: f64 = 0.75;

impl NextStep {
    /// What to do after a fit with these options, the most promising first. `warnings` are those of the goal, and `leaves`
    /// tells whether the tree that was found has some.
    pub(super) fn after(
        options: &FitOptions,
        verdict: Option<&Verdict>,
        readings: &Readings,
        warnings: &[GoalWarning],
        leaves: bool,
    ) -> Vec<Self> {
        let kind = verdict.map(|verdict| verdict.kind);
        if kind == Some(KindVerdict::OfItsKind) {
            return vec![Self::GrowMore];
        }
        let is_lucky = verdict.is_some_and(|verdict| verdict.tree == KindVerdict::OfItsKind);
        let is_near = kind == Some(KindVerdict::Roughly);
        let is_far = kind.is_some_and(|kind| kind > KindVerdict::Roughly);
        let is_open = options.from == StartFrom::Auto
            && options.volume_from.is_none()
            && !options.evolve_rules
            && options.generator != Some(GeneratorChoice::Auto);
        let has_usual_height =
            options.frame.is_none() && options.height.total_cmp(&FitOptions::default().height).is_eq();
        let steps = [
            (is_lucky && options.robust.get() == 1).then_some(Self::EverySeed),
            is_near.then_some(Self::SearchLonger),
            warnings.iter().any(is_mended_in_a_mask).then_some(Self::CorrectMask),
            Self::about_leaves(options, readings, leaves),
            readings.differences.iter().any(|one| is_of_a_trunk(one.measure)).then_some(Self::CorrectReading),
            (is_far && is_open).then_some(Self::AnyFamily),
            (!is_near).then_some(Self::SearchLonger),
            has_usual_height.then_some(Self::TellHeight),
        ];
        steps.into_iter().flatten().collect()
    }

    /// What to try where the tree's leaves contradict the picture, or where it is doubtful whether there are any.
    fn about_leaves(options: &FitOptions, readings: &Readings, leaves: bool) -> Option<Self> {
        let seen = &readings.goal.measures;
        let contradicts = seen.leaves != leaves;
        let is_doubtful = options.leaves == Leaves::Auto && seen.leaves_confidence < SURE_OF_LEAVES;
        (contradicts || is_doubtful).then_some(if leaves { Self::Bare } else { Self::Leafy })
    }
}

/// Whether another mask of the same picture would not have what is warned of.
const fn is_mended_in_a_mask(warning: &GoalWarning) -> bool {
    use GoalWarning::{
        ByColor, DoubtfulMask, Ground, MostlyInk, Noise, Outline, Photograph, SeveralPieces, Solid,
    };
    matches!(
        warning,
        ByColor { .. }
            | DoubtfulMask { .. }
            | Ground { .. }
            | MostlyInk { .. }
            | Noise { .. }
            | Outline { .. }
            | Photograph
            | SeveralPieces { .. }
            | Solid { .. }
    )
}

/// Whether a person can say what the measure is.
const fn is_of_a_trunk(measure: Measure) -> bool {
    matches!(
        measure,
        Measure::Feet | Measure::Width | Measure::Lean | Measure::FirstFork | Measure::BareHeight
    )
}

impl fmt::Display for NextStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::GrowMore => "grow more trees",
            Self::EverySeed => "have every seed look like the goal",
            Self::CorrectMask => "look at the mask, and correct it",
            Self::Leafy => "with leaves",
            Self::Bare => "without leaves",
            Self::CorrectReading => "say what was read wrong of the trunk",
            Self::AnyFamily => "try all families of generators",
            Self::SearchLonger => "more time",
            Self::TellHeight => "say how tall the tree is",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::goal_reading::GoalReading;
    use super::*;
    use pleach_reading::{Difference, Reading};

    fn verdict(kind: KindVerdict, tree: KindVerdict) -> Verdict {
        Verdict { kind, tree, share: 0.0, distance: None, off: None }
    }

    fn readings(leaves: bool, leaves_confidence: f64, differs: &[Measure]) -> Readings {
        let measures = Reading { leaves, leaves_confidence, ..Reading::default() };
        let one =
            |&measure: &Measure| Difference { measure, size: 2.0, confidence: 0.9, words: String::new() };
        Readings {
            goal: GoalReading::new(measures, None, None, Vec::new()),
            kind: Reading::default(),
            individual: None,
            distance: 0.0,
            differences: differs.iter().map(one).collect(),
        }
    }

    #[test]
    fn what_is_found_is_grown_and_what_is_near_is_searched_longer() {
        use KindVerdict::{NotOfItsKind, OfItsKind, Roughly};
        let told = FitOptions { height: 14.0, ..FitOptions::default() };
        let sure = readings(true, 0.9, &[]);
        let after = |kind, tree| NextStep::after(&told, Some(&verdict(kind, tree)), &sure, &[], true);
        assert_eq!(after(OfItsKind, OfItsKind), [NextStep::GrowMore]);
        assert_eq!(after(Roughly, OfItsKind), [NextStep::EverySeed, NextStep::SearchLonger]);
        assert_eq!(after(NotOfItsKind, NotOfItsKind), [NextStep::AnyFamily, NextStep::SearchLonger]);
        // Without a verdict, nothing is known of the families.
        assert_eq!(NextStep::after(&told, None, &sure, &[], true), [NextStep::SearchLonger]);
        let all = FitOptions { generator: Some(GeneratorChoice::Auto), ..told.clone() };
        let far = verdict(NotOfItsKind, NotOfItsKind);
        assert_eq!(NextStep::after(&all, Some(&far), &sure, &[], true), [NextStep::SearchLonger]);
        let robust = FitOptions { robust: std::num::NonZeroU32::new(4).unwrap(), ..told };
        let lucky = verdict(Roughly, OfItsKind);
        assert_eq!(NextStep::after(&robust, Some(&lucky), &sure, &[], true), [NextStep::SearchLonger]);
    }

    #[test]
    fn mask_leaves_reading_and_height_are_doubted_where_there_is_cause() {
        let roughly = verdict(KindVerdict::Roughly, KindVerdict::Roughly);
        let after = |options: &FitOptions, readings: &Readings, warnings: &[GoalWarning], leaves| {
            let mut steps = NextStep::after(options, Some(&roughly), readings, warnings, leaves);
            assert_eq!(steps.remove(0), NextStep::SearchLonger);
            steps
        };
        let told = FitOptions { height: 14.0, ..FitOptions::default() };
        let sure = readings(true, 0.9, &[]);
        assert_eq!(after(&FitOptions::default(), &sure, &[], true), [NextStep::TellHeight]);
        assert_eq!(after(&told, &sure, &[GoalWarning::Ground { row: 3 }], true), [NextStep::CorrectMask]);
        assert_eq!(after(&told, &sure, &[GoalWarning::UpsideDown], true), []);
        assert_eq!(after(&told, &readings(true, 0.6, &[]), &[], true), [NextStep::Bare]);
        assert_eq!(after(&told, &readings(true, 0.9, &[]), &[], false), [NextStep::Leafy]);
        // Who has said it is not asked again.
        let said = FitOptions { leaves: Leaves::On, ..told.clone() };
        assert_eq!(after(&said, &readings(true, 0.6, &[]), &[], true), []);
        assert_eq!(
            after(&told, &readings(true, 0.9, &[Measure::Feet]), &[], true),
            [NextStep::CorrectReading]
        );
        assert_eq!(after(&told, &readings(true, 0.9, &[Measure::Grain]), &[], true), []);
    }
}
