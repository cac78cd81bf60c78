//! What is different between the reading of a goal and that of a tree.

use crate::reading::Reading;
use pleach_plant::math;
use serde::Serialize;
use std::fmt;

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
    /// Whether there are leaves.
    Leaves,
    /// The height up to which the trunk is bare.
    BareHeight,
    /// How much heavier the crown is on one side.
    Asymmetry,
    /// The part of the crown that is gaps.
    GapShare,
}

impl Measure {
    /// Whether it is of a species: trees of one species differ little in it, whatever their seeds.
    #[must_use]
    pub const fn is_of_species(self) -> bool {
        matches!(self, Self::Feet | Self::Width | Self::BareHeight)
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

/// Trunks of one kind differ in number by this factor at most.
const FEET: f64 = 1.6;
/// Wrong readings of feet that are so many tolerances farther off are e times as rare.
const WRONG: f64 = 0.7;
/// … in thickness by this one.
const WIDTH: f64 = 1.5;
/// … and lean otherwise by so many degrees.
const LEAN: f64 = 7.0;
/// Bare heights differ by this part of the height.
const BARE: f64 = 0.12;
/// Heights of the first fork do.
const FORK: f64 = 0.15;
/// Crowns are one-sided to within this.
const ASYMMETRY: f64 = 0.3;
/// Gaps of the crown are alike to within this part of it.
const GAPS: f64 = 0.2;
/// Leaves in the one and none in the other are as much as this.
const LEAVES: f64 = 3.0;

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
        let found = [
            self.feet_apart(tree, trunks),
            self.widths_apart(tree, trunks),
            self.leans_apart(tree),
            self.forks_apart(tree),
            self.leaves_apart(tree),
            apart(
                Measure::BareHeight,
                (self.bare_height, self.bare_height_confidence),
                (tree.bare_height, tree.bare_height_confidence),
                BARE,
                |goal, tree| {
                    format!("bare up to {goal:.2} of the height in the picture, {tree:.2} in the fit")
                },
            ),
            apart(
                Measure::Asymmetry,
                (self.asymmetry, self.asymmetry_confidence),
                (tree.asymmetry, tree.asymmetry_confidence),
                ASYMMETRY,
                |goal, tree| format!("the crown is {} in the picture, {} in the fit", side(goal), side(tree)),
            ),
            apart(
                Measure::GapShare,
                (self.gap_share, self.gap_share_confidence),
                (tree.gap_share, tree.gap_share_confidence),
                GAPS,
                |goal, tree| {
                    format!(
                        "{:.0} % of the crown are gaps in the picture, {:.0} % in the fit",
                        100.0 * goal,
                        100.0 * tree
                    )
                },
            ),
        ];
        let mut found: Vec<Difference> = found.into_iter().flatten().filter(|one| one.size >= 1.0).collect();
        found.sort_by(|a, b| b.size.total_cmp(&a.size));
        found
    }

    fn feet_apart(&self, tree: &Self, known: Option<u32>) -> Option<Difference> {
        let (goal, read) = (self.feet.len(), tree.feet.len());
        let (fit, sure_of_fit) = known.map_or((read, tree.feet_confidence), |known| (known as usize, 1.0));
        if goal == 0 || fit == 0 {
            return None;
        }
        let size = factor(goal as f64, fit as f64, FEET);
        let confidence = sure(far_off(self.feet_confidence, size), sure_of_fit)?;
        let words = format!("{} in the picture, {} in the fit", trunks(goal), number(fit));
        Some(Difference { measure: Measure::Feet, size, confidence, words })
    }

    fn widths_apart(&self, tree: &Self, known: Option<u32>) -> Option<Difference> {
        if known.is_some_and(|known| known as usize != tree.feet.len()) {
            return None;
        }
        let confidence = sure(self.width_confidence, tree.width_confidence)?;
        let (goal, fit) = (self.trunk_width()?, tree.trunk_width()?);
        let words = if fit > goal {
            format!("the trunk is {:.1} times as thick as in the picture", fit / goal)
        } else {
            format!("the trunk is {:.1} times as thin as in the picture", goal / fit)
        };
        Some(Difference { measure: Measure::Width, size: factor(goal, fit, WIDTH), confidence, words })
    }

    /// Thickness of the main trunk, the thickest one, in heights of the tree; `None` where none is known.
    #[must_use]
    pub fn trunk_width(&self) -> Option<f64> {
        self.feet.iter().map(|foot| foot.width).max_by(f64::total_cmp).filter(|width| *width > 0.0)
    }

    fn leans_apart(&self, tree: &Self) -> Option<Difference> {
        apart(
            Measure::Lean,
            (self.lean_deg, self.lean_deg_confidence),
            (tree.lean_deg, tree.lean_deg_confidence),
            LEAN,
            |goal, tree| format!("the trunk leans {} in the picture, {} in the fit", lean(goal), lean(tree)),
        )
    }

    fn forks_apart(&self, tree: &Self) -> Option<Difference> {
        apart(
            Measure::FirstFork,
            (self.first_fork, self.first_fork_confidence),
            (tree.first_fork, tree.first_fork_confidence),
            FORK,
            |goal, tree| {
                format!("the first fork is at {goal:.2} of the height in the picture, {tree:.2} in the fit")
            },
        )
    }

    fn leaves_apart(&self, tree: &Self) -> Option<Difference> {
        let confidence = sure(self.leaves_confidence, tree.leaves_confidence)?;
        let state = |leaves: bool| if leaves { "in leaf" } else { "bare" };
        let words = format!("{} in the picture, {} in the fit", state(self.leaves), state(tree.leaves));
        let size = if self.leaves == tree.leaves { 0.0 } else { LEAVES };
        Some(Difference { measure: Measure::Leaves, size, confidence, words })
    }
}

/// The lesser of two confidences, if it is enough to compare.
fn sure(goal: f64, tree: f64) -> Option<f64> {
    let least = goal.min(tree);
    (least >= SURE).then_some(least)
}

/// Confidence that a number of feet that was read with `confidence` is not one that lies `size` tolerances off: readings
/// that are wrong are mostly a little wrong.
fn far_off(confidence: f64, size: f64) -> f64 {
    1.0 - (1.0 - confidence) * math::exp(-WRONG * (size - 1.0).max(0.0))
}

/// How far two numbers that are measured and confident are apart, in `tolerance`s.
fn apart(
    measure: Measure,
    (goal, of_goal): (Option<f64>, f64),
    (tree, of_tree): (Option<f64>, f64),
    tolerance: f64,
    words: impl FnOnce(f64, f64) -> String,
) -> Option<Difference> {
    let confidence = sure(of_goal, of_tree)?;
    let (goal, tree) = goal.zip(tree)?;
    let size = (goal - tree).abs() / tolerance;
    Some(Difference { measure, size, confidence, words: words(goal, tree) })
}

/// By how many times `tolerance` two amounts differ, on a logarithmic scale.
fn factor(a: f64, b: f64, tolerance: f64) -> f64 {
    (math::ln(a / b) / math::ln(tolerance)).abs()
}

fn number(count: usize) -> String {
    if count == 1 { "one".to_owned() } else { count.to_string() }
}

fn trunks(count: usize) -> String {
    format!("{} {}", number(count), if count == 1 { "trunk" } else { "trunks" })
}

fn lean(degrees: f64) -> String {
    let side = if degrees < 0.0 { "left" } else { "right" };
    format!("{:.0}° to the {side}", degrees.abs())
}

fn side(asymmetry: f64) -> String {
    if asymmetry.abs() < 0.1 {
        return "even".to_owned();
    }
    format!("heavier on the {}", if asymmetry < 0.0 { "left" } else { "right" })
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
