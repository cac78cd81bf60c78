//! A difference in words.

use super::Measure;
use crate::reading::Reading;

/// How `goal` and `tree` differ in `measure`; `trunks` where the tree's number of trunks is known. Empty if one of them
/// has none.
pub(super) fn words(measure: Measure, goal: &Reading, tree: &Reading, trunks: Option<u32>) -> String {
    let both = |of: fn(&Reading) -> Option<f64>| of(goal).zip(of(tree));
    let told = match measure {
        Measure::Feet => {
            let fit = trunks.map_or(tree.feet.len(), |known| known as usize);
            Some(format!("{} in the picture, {} in the fit", trunks_of(goal.feet.len()), number(fit)))
        }
        Measure::Width => both(Reading::trunk_width).map(|(goal, fit)| {
            if fit > goal {
                format!("the trunk is {:.1} times as thick as in the picture", fit / goal)
            } else {
                format!("the trunk is {:.1} times as thin as in the picture", goal / fit)
            }
        }),
        Measure::Lean => both(|one| one.lean_deg).map(|(goal, fit)| {
            format!("the trunk leans {} in the picture, {} in the fit", lean(goal), lean(fit))
        }),
        Measure::FirstFork => both(|one| one.first_fork).map(|(goal, fit)| {
            format!("the first fork is at {goal:.2} of the height in the picture, {fit:.2} in the fit")
        }),
        Measure::Leaves => {
            let state = |leaves: bool| if leaves { "in leaf" } else { "bare" };
            let shares = goal.foliage_share.zip(tree.foliage_share);
            Some(match shares {
                Some((goal, fit)) if fit < goal => "less foliage than in the picture".to_owned(),
                Some(_) => "more foliage than in the picture".to_owned(),
                None => format!("{} in the picture, {} in the fit", state(goal.leaves), state(tree.leaves)),
            })
        }
        Measure::BareHeight => both(|one| one.bare_height).map(|(goal, fit)| {
            format!("bare up to {goal:.2} of the height in the picture, {fit:.2} in the fit")
        }),
        Measure::Asymmetry => both(|one| one.asymmetry).map(|(goal, fit)| {
            format!("the crown is {} in the picture, {} in the fit", side(goal), side(fit))
        }),
        Measure::Crown => both(|one| one.crown_width).map(|(goal, fit)| {
            let width = |width: f64| format!("{width:.2} of the height wide");
            if (goal - fit).abs() < 0.1 * goal.max(fit) {
                "the outline of the crown is another one".to_owned()
            } else {
                format!("the crown is {} in the picture, {} in the fit", width(goal), width(fit))
            }
        }),
        Measure::GapShare => both(|one| one.gap_share).map(|(goal, fit)| {
            format!(
                "{:.0} % of the crown are gaps in the picture, {:.0} % in the fit",
                100.0 * goal,
                100.0 * fit
            )
        }),
        Measure::GapsByHeight => {
            Some("gaps are at other heights of the crown than in the picture".to_owned())
        }
        Measure::Grain => both(|one| one.grain_upright).map(|(goal, fit)| {
            if (goal - fit).abs() < LEAST {
                "twigs and leaves run another way than in the picture".to_owned()
            } else if fit > goal {
                "twigs and leaves run more up and down than in the picture".to_owned()
            } else {
                "twigs and leaves lie flatter than in the picture".to_owned()
            }
        }),
    };
    told.unwrap_or_default()
}

/// Crowns whose grain is as upright as the other's to this differ in what rises and hangs.
const LEAST: f64 = 0.1;

fn number(count: usize) -> String {
    if count == 1 { "one".to_owned() } else { count.to_string() }
}

fn trunks_of(count: usize) -> String {
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
