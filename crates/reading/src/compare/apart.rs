//! How far two readings are apart in each measure, in tolerances.

use super::Measure;
use crate::reading::Reading;
use pleach_plant::math;

/// Trunks of one kind differ in number by this factor at most.
const FEET: f64 = 1.6;
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
/// Gaps do so at single heights, in the mean.
const GAPS_BY_HEIGHT: f64 = 0.12;
/// Outlines differ by this part of the height, in the mean over heights and both sides.
const OUTLINE: f64 = 0.126;
/// Grains do by this, as vectors of upright and rising.
const GRAIN: f64 = 0.13;
/// Leaves in the one and none in the other are as much as this.
const LEAVES: f64 = 3.0;
/// Stems behind leaves count as stems of a tree that was grown, so its foliage may be less than the picture's by this …
const HIDDEN: f64 = 0.3;
/// … and by this for each further tolerance.
const FOLIAGE: f64 = 0.18;
/// Wrong readings of feet that are so many tolerances farther off are e times as rare.
const WRONG: f64 = 0.7;

/// How far a goal and a tree are apart in one measure.
#[derive(Clone, Copy, Debug)]
pub(super) struct Apart {
    pub(super) measure: Measure,
    /// In tolerances: 1 is as much as two trees of one kind may differ by.
    pub(super) size: f64,
    /// Confidence of the goal's reading and of the tree's, in 0..=1.
    pub(super) confidence: [f64; 2],
}

/// Measures that both readings have, with how far they are apart; `trunks` where the tree's number of trunks is known.
pub(super) fn apart<'a>(
    goal: &'a Reading,
    tree: &'a Reading,
    trunks: Option<u32>,
) -> impl Iterator<Item = Apart> + 'a {
    let within = |a: Option<f64>, b: Option<f64>, tolerance: f64| Some((a? - b?).abs() / tolerance);
    let one = |measure, size: Option<f64>, goal: f64, tree: f64| {
        size.map(|size| Apart { measure, size, confidence: [goal, tree] })
    };
    let gaps = [goal.gap_share_confidence, tree.gap_share_confidence];
    let by_height = mean_apart(goal.gap_by_height.iter().zip(&tree.gap_by_height));
    [
        feet(goal, tree, trunks),
        width(goal, tree, trunks),
        one(
            Measure::Lean,
            within(goal.lean_deg, tree.lean_deg, LEAN),
            goal.lean_deg_confidence,
            tree.lean_deg_confidence,
        ),
        one(
            Measure::FirstFork,
            within(goal.first_fork, tree.first_fork, FORK),
            goal.first_fork_confidence,
            tree.first_fork_confidence,
        ),
        Some(leaves(goal, tree)),
        one(
            Measure::BareHeight,
            within(goal.bare_height, tree.bare_height, BARE),
            goal.bare_height_confidence,
            tree.bare_height_confidence,
        ),
        one(
            Measure::Asymmetry,
            within(goal.asymmetry, tree.asymmetry, ASYMMETRY),
            goal.asymmetry_confidence,
            tree.asymmetry_confidence,
        ),
        one(
            Measure::Crown,
            outline(goal, tree).map(|off| off / OUTLINE),
            goal.crown_confidence,
            tree.crown_confidence,
        ),
        one(Measure::GapShare, within(goal.gap_share, tree.gap_share, GAPS), gaps[0], gaps[1]),
        one(Measure::GapsByHeight, by_height.map(|off| off / GAPS_BY_HEIGHT), gaps[0], gaps[1]),
        one(
            Measure::Grain,
            grain(goal, tree).map(|off| off / GRAIN),
            goal.grain_confidence,
            tree.grain_confidence,
        ),
    ]
    .into_iter()
    .flatten()
}

fn feet(goal: &Reading, tree: &Reading, known: Option<u32>) -> Option<Apart> {
    let (count, read) = (goal.feet.len(), tree.feet.len());
    let (fit, of_fit) = known.map_or((read, tree.feet_confidence), |known| (known as usize, 1.0));
    if count == 0 || fit == 0 {
        return None;
    }
    let size = factor(count as f64, fit as f64, FEET);
    // Readings that are wrong are mostly a little wrong.
    let of_goal = 1.0 - (1.0 - goal.feet_confidence) * math::exp(-WRONG * (size - 1.0).max(0.0));
    Some(Apart { measure: Measure::Feet, size, confidence: [of_goal, of_fit] })
}

/// How much of the ink is foliage, where both know it, or else whether there is any.
fn leaves(goal: &Reading, tree: &Reading) -> Apart {
    let measure = Measure::Leaves;
    if let Some((wanted, grown)) = goal.foliage_share.zip(tree.foliage_share) {
        let off = if grown < wanted { (wanted - HIDDEN - grown).max(0.0) } else { grown - wanted };
        let size = off / FOLIAGE;
        let confidence = [goal.foliage_share_confidence, tree.foliage_share_confidence];
        return Apart { measure, size, confidence };
    }
    let size = if goal.leaves == tree.leaves { 0.0 } else { LEAVES };
    Apart { measure, size, confidence: [goal.leaves_confidence, tree.leaves_confidence] }
}

fn width(goal: &Reading, tree: &Reading, known: Option<u32>) -> Option<Apart> {
    // What is read of trunks that stand together is of the bundle.
    if known.is_some_and(|known| known as usize != tree.feet.len()) {
        return None;
    }
    let size = factor(goal.trunk_width()?, tree.trunk_width()?, WIDTH);
    Some(Apart { measure: Measure::Width, size, confidence: [goal.width_confidence, tree.width_confidence] })
}

/// Mean distance of the outlines over heights and both sides, in heights of the tree. Where feet are not sure, neither is
/// the place of the outline beside them: to that part it is compared as it lies best.
fn outline(goal: &Reading, tree: &Reading) -> Option<f64> {
    let left = || goal.crown.left.iter().zip(&tree.crown.left);
    let right = || goal.crown.right.iter().zip(&tree.crown.right);
    let as_read = mean_apart(left().chain(right()))?;
    let (mut shift, mut count) = (0.0, 0.0);
    for ((goal_left, tree_left), (goal_right, tree_right)) in left().zip(right()) {
        shift += (goal_right - goal_left) - (tree_right - tree_left);
        count += 2.0;
    }
    shift /= count;
    let shifted = left()
        .map(|(goal, tree)| (goal - tree + shift).abs())
        .chain(right().map(|(goal, tree)| (goal - tree - shift).abs()));
    let as_it_lies = shifted.sum::<f64>() / count;
    let sure = goal.feet_confidence.min(tree.feet_confidence);
    Some(sure * as_read + (1.0 - sure) * as_it_lies)
}

/// Mean difference of pairs; `None` without pairs.
fn mean_apart<'a>(pairs: impl Iterator<Item = (&'a f64, &'a f64)>) -> Option<f64> {
    let (sum, count) = pairs.fold((0.0, 0.0), |(sum, count), (a, b)| (sum + (a - b).abs(), count + 1.0));
    (count > 0.0).then(|| sum / count)
}

fn grain(goal: &Reading, tree: &Reading) -> Option<f64> {
    let (upright, rising) =
        (goal.grain_upright? - tree.grain_upright?, goal.grain_rising? - tree.grain_rising?);
    Some((upright * upright + rising * rising).sqrt())
}

/// By how many times `tolerance` two amounts differ, on a logarithmic scale.
fn factor(a: f64, b: f64, tolerance: f64) -> f64 {
    (math::ln(a / b) / math::ln(tolerance)).abs()
}
