//! What part of the readings is right, and whether their confidences tell.

use super::judged::Read;
use pleach_console::output;

/// A measure, what is asked of it, and whether a reading of it is right, with its confidence; `None` where it cannot be
/// judged.
struct Judge {
    name: &'static str,
    /// Percent.
    asked: Option<u32>,
    judge: fn(&Read) -> Option<(bool, f64)>,
}

/// Right within this part of the width …
const WIDTH: f64 = 0.15;
/// … degrees …
const LEAN: f64 = 3.0;
/// … heights of the tree …
const BARE: f64 = 0.05;
/// … of the tree …
const FORK: f64 = 0.08;
/// … CIEDE2000 of leaves, and of bark.
const LEAF: f64 = 8.0;
const BARK: f64 = 12.0;
/// The least intersection over union of a layer.
const IOU: f64 = 0.6;
/// A lean can be seen by a person where so much of the trunk is bare.
const BARE_ENOUGH: f64 = 0.1;

const JUDGES: [Judge; 17] = [
    Judge {
        name: "feet, seen",
        asked: Some(95),
        judge: |r| r.feet_seen.then_some((r.has_feet(), r.feet_confidence.0)),
    },
    Judge { name: "feet, all", asked: None, judge: |r| Some((r.has_feet(), r.feet_confidence.0)) },
    Judge {
        name: "trunk's width to 15 %",
        asked: Some(90),
        judge: |r| {
            let off = (r.width.0 / r.true_width.0 - 1.0).abs();
            (r.has_feet() && r.true_width.0 > 0.0).then_some((off <= WIDTH, r.width_confidence.0))
        },
    },
    Judge {
        name: "lean to 3°, a tenth is bare",
        asked: Some(90),
        judge: |r| lean(r).filter(|_| r.true_bare.is_some_and(|bare| bare.0 >= BARE_ENOUGH)),
    },
    Judge { name: "lean to 3°, all", asked: None, judge: lean },
    Judge {
        name: "bare height to 0.05",
        asked: Some(85),
        judge: |r| {
            let (bare, truth) = r.bare.zip(r.true_bare).filter(|_| r.has_feet())?;
            Some(((bare.0 - truth.0).abs() <= BARE, r.bare_confidence.0))
        },
    },
    Judge { name: "first fork to 0.08, seen", asked: Some(75), judge: |r| fork(r).filter(|_| r.fork_seen) },
    Judge { name: "first fork or none, all", asked: None, judge: fork },
    Judge {
        name: "leafy or bare, by silhouette",
        asked: Some(98),
        judge: |r| r.leaves_seen.then_some((r.leaves == r.true_leaves, r.leaves_confidence.0)),
    },
    Judge {
        name: "leafy or bare, by colours",
        asked: Some(98),
        judge: |r| {
            let right = r.color_leaves == Some(r.true_leaves);
            r.leaves_seen.then_some((right, r.color_leaves_confidence.0))
        },
    },
    Judge {
        name: "leafy or bare, by both",
        asked: Some(98),
        judge: |r| {
            let confidence = r.leaves_confidence.0.max(r.color_leaves_confidence.0);
            r.leaves_seen.then_some((r.leaves_by_both() == r.true_leaves, confidence))
        },
    },
    Judge { name: "season", asked: None, judge: |r| Some((r.season == r.true_season, 0.0)) },
    Judge {
        name: "wood, IoU 0.6, of leafy trees",
        asked: None,
        judge: |r| Some((r.wood_iou.filter(|_| r.true_leaves)?.0 >= IOU, r.layers_confidence.0)),
    },
    Judge {
        name: "the same of limbs of 3 pixels",
        asked: None,
        judge: |r| Some((r.limb_iou.filter(|_| r.true_leaves)?.0 >= IOU, r.layers_confidence.0)),
    },
    Judge {
        name: "foliage, IoU 0.6",
        asked: None,
        judge: |r| Some((r.foliage_iou?.0 >= IOU, r.layers_confidence.0)),
    },
    Judge {
        name: "colour of leaves to 8",
        asked: Some(90),
        judge: |r| Some((r.leaf_difference?.0 <= LEAF, r.leaf_confidence.0)),
    },
    Judge {
        name: "colour of bark to 12",
        asked: None,
        judge: |r| Some((r.bark_difference?.0 <= BARK, r.bark_confidence.0)),
    },
];

fn lean(r: &Read) -> Option<(bool, f64)> {
    let (lean, truth) = r.lean.zip(r.true_lean).filter(|_| r.has_feet())?;
    Some(((lean.0 - truth.0).abs() <= LEAN, r.lean_confidence.0))
}

fn fork(r: &Read) -> Option<(bool, f64)> {
    let right = match (r.fork, r.true_fork) {
        (Some(fork), Some(truth)) => (fork.0 - truth.0).abs() <= FORK,
        (None, None) => true,
        // A fork that foliage hides need not be found.
        (None, Some(_)) => return (r.has_feet() && r.fork_seen).then_some((false, r.fork_confidence.0)),
        (Some(_), None) => false,
    };
    r.has_feet().then_some((right, r.fork_confidence.0))
}

/// Classes of confidence: from, to.
const CLASSES: [(f64, f64); 4] = [(0.0, 0.5), (0.5, 0.7), (0.7, 0.85), (0.85, 1.01)];

/// A line for each measure: of how many readings it could be judged, what part is right, and for each class of confidence
/// the part that is right, and of how many.
pub(super) fn table(rows: &[Read]) -> String {
    let head = ["measure", "asked", "judged", "right"].map(str::to_owned).into_iter();
    let classes = CLASSES.map(|(from, to)| format!("confidence {from:.2} to {:.2}", to.min(1.0)));
    let mut lines: Vec<Vec<String>> = vec![head.chain(classes).collect()];
    for Judge { name, asked, judge } in &JUDGES {
        let judged: Vec<(bool, f64)> = rows.iter().filter_map(judge).collect();
        let of = |from: f64, to: f64| {
            let part: Vec<bool> =
                judged.iter().filter(|one| (from..to).contains(&one.1)).map(|one| one.0).collect();
            let right = part.iter().filter(|right| **right).count();
            (part.len(), 100.0 * right as f64 / part.len().max(1) as f64)
        };
        let (all, right) = of(0.0, f64::INFINITY);
        let asked = asked.map_or_else(String::new, |asked| format!("{asked} %"));
        let mut line = vec![(*name).to_owned(), asked, all.to_string(), format!("{right:.1} %")];
        line.extend(CLASSES.map(|(from, to)| match of(from, to) {
            (0, _) => String::new(),
            (count, right) => format!("{right:.0} % of {count}"),
        }));
        lines.push(line);
    }
    output::table(&lines, &[1, 2, 3, 4, 5, 6, 7])
}
