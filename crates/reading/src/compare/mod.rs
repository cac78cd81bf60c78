//! What is different between the reading of a goal and that of a tree.

mod apart;
mod words;

use crate::reading::Reading;
use apart::{Apart, apart};
use serde::Serialize;
use std::fmt;
use words::words;

/// A measure that two trees may differ in. In JSON it is called as its field of [`Reading`], and the thickness of the
/// trunk `width`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Measure {
    /// The number of feet.
    Feet,
    /// The thickness of the main trunk.
    Width,
    /// The lean of the main trunk.
    #[serde(rename = "lean_deg")]
    Lean,
    /// The height of the first fork.
    FirstFork,
    /// Whether there are leaves, and how much of the tree is foliage.
    Leaves,
    /// The height up to which the trunk is bare.
    BareHeight,
    /// How much heavier the crown is on one side.
    Asymmetry,
    /// The outline of the crown.
    Crown,
    /// The part of the crown that is gaps.
    GapShare,
    /// The same, height by height.
    GapsByHeight,
    /// Which way the texture of the crown runs.
    Grain,
}

impl Measure {
    /// Whether it is of a species: trees of one species differ little in it, whatever their seeds.
    #[must_use]
    pub const fn is_of_species(self) -> bool {
        matches!(self, Self::Feet | Self::Width | Self::BareHeight)
    }

    /// Whether trees of one species and one season are alike in it, or nearly so: those of its species, and what the
    /// crown is like. How a single tree leans or forks and which side of it is heavier is its own.
    #[must_use]
    pub const fn is_of_kind(self) -> bool {
        self.is_of_species() || matches!(self, Self::Leaves | Self::Crown | Self::GapsByHeight | Self::Grain)
    }

    /// Its part of [`Reading::distance`]; all add up to 1.
    const fn weight(self) -> f64 {
        match self {
            Self::Feet => 0.09,
            Self::Width => 0.13,
            Self::Lean => 0.05,
            Self::FirstFork => 0.02,
            Self::Leaves => 0.1,
            Self::BareHeight => 0.09,
            Self::Asymmetry => 0.04,
            Self::Crown => 0.13,
            Self::GapShare => 0.08,
            Self::GapsByHeight => 0.11,
            Self::Grain => 0.16,
        }
    }
}

/// A measure in which a tree differs from its goal by more than two trees of one kind do.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Difference {
    /// The measure.
    pub measure: Measure,
    /// How large it is: 1 is as much as two trees of one kind may differ by.
    pub size: f64,
    /// How sure it is: the lesser confidence of the two readings, in 0..=1.
    pub confidence: f64,
    /// In words, such as "one trunk in the picture, 14 in the fit".
    pub words: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

/// Readings of less confidence are not compared.
const SURE: f64 = 0.6;
/// Readings of a goal of this confidence or less do not count in a distance.
const DOUBTFUL: f64 = 0.4;

impl Reading {
    /// In which measures `tree` differs from `self`, its goal, the largest first: those of which both readings are sure,
    /// and which differ by more than two trees of one kind do.
    ///
    /// ```
    /// use pleach_reading::{Foot, Reading};
    ///
    /// let of = |feet: Vec<Foot>| Reading { feet, feet_confidence: 0.9, ..Reading::default() };
    /// let goal = of(vec![Foot { x: 0.0, width: 0.05 }]);
    /// let canes = of((0..14).map(|i| Foot { x: 0.05 * f64::from(i), width: 0.05 }).collect());
    /// assert_eq!(goal.differences(&canes)[0].words, "one trunk in the picture, 14 in the fit");
    /// assert!(goal.differences(&goal).is_empty());
    /// ```
    #[must_use]
    pub fn differences(&self, tree: &Self) -> Vec<Difference> {
        self.differences_from(tree, None)
    }

    /// The same of a tree that was grown with a known number of `trunks`. Trunks that stand close together are read as
    /// one, so that number goes before what was read; the thickness of such a bundle is not compared.
    #[must_use]
    pub fn differences_from(&self, tree: &Self, trunks: Option<u32>) -> Vec<Difference> {
        let is_told = |one: &Apart| one.size >= 1.0 && one.confidence.into_iter().all(|one| one >= SURE);
        let mut found: Vec<Difference> = apart(self, tree, trunks)
            .filter(is_told)
            .map(|Apart { measure, size, confidence: [goal, fit] }| Difference {
                measure,
                size,
                confidence: goal.min(fit),
                words: words(measure, self, tree, trunks),
            })
            .collect();
        found.sort_by(|a, b| b.size.total_cmp(&a.size));
        found
    }

    /// How far `tree` stands from `self`, its goal, in 0..=1: 0 where nothing is different, and 1 where everything is and
    /// the goal's reading is sure. `trunks` as in [`Reading::differences_from`].
    ///
    /// Each measure counts by its weight and by how far the confidence of the goal's reading is above 0.4: s/(1 + s) of
    /// it, where s is the difference in tolerances. So a search follows small differences too, and one that cannot be
    /// mended does not hide the others.
    ///
    /// ```
    /// use pleach_reading::{Foot, Reading};
    ///
    /// let of = |lean: f64| Reading {
    ///     lean_deg: Some(lean),
    ///     lean_deg_confidence: 1.0,
    ///     ..Reading::default()
    /// };
    /// let far = |lean: f64| of(0.0).distance(&of(lean), None);
    /// assert!(far(0.0) == 0.0 && far(5.0) > 0.0 && far(20.0) > far(5.0) && far(20.0) < 1.0);
    /// ```
    #[must_use]
    pub fn distance(&self, tree: &Self, trunks: Option<u32>) -> f64 {
        let trust = |confidence: f64| ((confidence - DOUBTFUL) / (1.0 - DOUBTFUL)).max(0.0);
        let part = |one: Apart| one.measure.weight() * trust(one.confidence[0]) * one.size / (1.0 + one.size);
        apart(self, tree, trunks).map(part).sum()
    }

    /// Thickness of the main trunk, the thickest one, in heights of the tree; `None` where none is known.
    #[must_use]
    pub fn trunk_width(&self) -> Option<f64> {
        self.feet.iter().map(|foot| foot.width).max_by(f64::total_cmp).filter(|width| *width > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reading::Foot;

    fn leaning(lean: f64, width: f64) -> Reading {
        Reading {
            feet: vec![Foot { x: 0.0, width }],
            feet_confidence: 0.9,
            width_confidence: 0.8,
            lean_deg: Some(lean),
            lean_deg_confidence: 0.9,
            leaves: true,
            leaves_confidence: 0.95,
            ..Reading::default()
        }
    }

    #[test]
    fn differences_are_told_from_the_largest_on() {
        let found = leaning(-11.0, 0.04).differences(&leaning(2.0, 0.09));
        let words: Vec<&str> = found.iter().map(|one| one.words.as_str()).collect();
        let [width, lean] = [
            "the trunk is 2.2 times as thick as in the picture",
            "the trunk leans 11° to the left in the picture, 2° to the right in the fit",
        ];
        assert_eq!(words, [width, lean]);
        assert_eq!(found[1].confidence, 0.9);
        let bare = Reading { leaves: false, ..leaning(0.0, 0.04) };
        assert_eq!(
            leaning(0.0, 0.04).differences(&bare)[0].to_string(),
            "in leaf in the picture, bare in the fit"
        );
    }

    #[test]
    fn what_is_not_sure_or_not_there_is_no_difference() {
        let unsure = Reading { lean_deg_confidence: 0.5, ..leaning(-20.0, 0.04) };
        assert!(unsure.differences(&leaning(20.0, 0.04)).is_empty());
        let none = Reading { lean_deg: None, feet: Vec::new(), ..leaning(0.0, 0.04) };
        assert!(none.differences(&leaning(20.0, 0.04)).is_empty());
        assert!(leaning(0.0, 0.04).differences(&leaning(6.0, 0.05)).is_empty(), "two trees of one kind");
    }
}
