//! The summary: medians and counts of each method over each kind of goals, and which method wins.
//!
//! A goal counts once: its numbers are means over repetitions.

use super::Fit;
use super::spec::{Kind, MethodSpec, TreefitSpec};
use pleach_console::output;

/// A number of a row, if it has one.
type Column = fn(&Fit) -> Option<f64>;

/// Columns whose medians are shown: name, decimals, value.
const SHOWN: [(&str, usize, Column); 7] = [
    ("likeness", 3, |row| Some(row.likeness.0)),
    ("iou", 3, |row| Some(row.iou.0)),
    ("pixel_accuracy", 3, |row| Some(row.pixel_accuracy.0)),
    ("fresh_likeness", 3, FRESH_LIKENESS),
    ("fresh_iou", 3, |row| Some(row.fresh_iou?.0)),
    ("evaluations", 0, |row| Some(row.evaluations as f64)),
    ("wall_s", 1, |row| Some(row.wall_s.0)),
];

const FRESH_LIKENESS: Column = |row| Some(row.fresh_likeness?.0);

pub(super) fn report(spec: &TreefitSpec, fits: &[Fit]) -> String {
    let shown = SHOWN.iter().map(|(name, ..)| *name);
    let heading = ["goals", "method"].into_iter().chain(shown).chain(["near ceiling", "above ellipse"]);
    let mut lines = vec![heading.map(str::to_owned).collect::<Vec<_>>()];
    for kind in Kind::ALL {
        for method in spec.methods().filter(|method| method.fits(kind)) {
            let of: Vec<&Fit> =
                fits.iter().filter(|row| row.kind == kind.name() && row.method == method.name).collect();
            if of.is_empty() {
                continue;
            }
            let goals = by_goal(&of);
            let mut line = vec![kind.name().to_owned(), method.name.clone()];
            for (_, digits, column) in SHOWN {
                let median = median(goals.iter().filter_map(|rows| mean(rows, column)).collect());
                line.push(median.map_or_else(String::new, |median| format!("{median:.digits$}")));
            }
            // A number that is missing counts as a failure.
            let count = |left: Column, right: Column, part: f64| {
                let is = |rows: &&Vec<&Fit>| {
                    mean(rows, left).zip(mean(rows, right)).is_some_and(|(a, b)| a >= part * b)
                };
                format!("{} of {}", goals.iter().filter(is).count(), goals.len())
            };
            line.push(count(FRESH_LIKENESS, |row| Some(row.ceiling_likeness?.0), 0.95));
            line.push(count(|row| Some(row.iou.0), |row| Some(row.best_ellipse_iou.0), 1.0));
            lines.push(line);
        }
    }
    let text = output::table(&lines, &(2..lines[0].len()).collect::<Vec<_>>());
    let known = [Kind::Own, Kind::Bare].map(Kind::name);
    let first = |row: &&Fit| row.method == spec.first_method().name && known.contains(&row.kind.as_str());
    let guessed: Vec<&Fit> = fits.iter().filter(first).collect();
    let right = guessed.iter().filter(|row| row.goal.trim_end_matches("_bare") == row.named).count();
    format!(
        "medians over goals of means over repetitions, and how many goals are within 5 % of the ceiling and \
         above the best ellipse\n\n{text}\n\nspecies named right: {right} of {} fits\n{}",
        guessed.len(),
        wins(spec, fits)
    )
}

/// On how many leafy own goals each method is the best of those with the same start and budget, by the
/// mean of likeness and IoU, and by the likeness of fresh seeds; first repetitions.
fn wins(spec: &TreefitSpec, fits: &[Fit]) -> String {
    const BOTH: [Column; 2] = [|row| Some(row.likeness.0), |row| Some(row.iou.0)];
    let terms = |m: &MethodSpec| {
        (m.from, m.evaluations, m.seconds.map(|s| s.to_bits()), m.objective.as_ref().map(|o| o.value))
    };
    let mut groups: Vec<Vec<&MethodSpec>> = Vec::new();
    for method in spec.methods().filter(|method| method.fits(Kind::Own)) {
        match groups.iter_mut().find(|group| terms(group[0]) == terms(method)) {
            Some(group) => group.push(method),
            None => groups.push(vec![method]),
        }
    }
    let mut text = String::new();
    for group in groups.into_iter().filter(|group| group.len() > 1) {
        for (by, columns) in [("likeness and IoU", &BOTH[..]), ("fresh likeness", &[FRESH_LIKENESS])] {
            let mut counts = vec![0; group.len()];
            for goal in spec.goals().filter(|goal| goal.kind() == Kind::Own) {
                let score = |method: &&MethodSpec| -> f64 {
                    let row = fits.iter().find(|row| row.goal == goal.name() && row.method == method.name);
                    let value = |column: &Column| row.and_then(column);
                    columns.iter().map(value).sum::<Option<f64>>().unwrap_or(f64::NEG_INFINITY)
                };
                let best = (0..group.len()).max_by(|&a, &b| score(&group[a]).total_cmp(&score(&group[b])));
                counts[best.unwrap_or(0)] += 1;
            }
            let list: Vec<String> =
                group.iter().zip(counts).map(|(method, count)| format!("{} {count}", method.name)).collect();
            text += &format!("best by {by}: {}\n", list.join("; "));
        }
    }
    text
}

/// The rows of each goal.
fn by_goal<'a>(rows: &[&'a Fit]) -> Vec<Vec<&'a Fit>> {
    rows.chunk_by(|a, b| a.goal == b.goal).map(<[_]>::to_vec).collect()
}

/// The mean of a column; `None` where no row has it.
fn mean(rows: &[&Fit], column: Column) -> Option<f64> {
    let values: Vec<f64> = rows.iter().filter_map(|row| column(row)).collect();
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The middle value, or the mean of the two in the middle.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = *values.get(values.len() / 2)?;
    let lower = values[(values.len() - 1) / 2];
    Some(f64::midpoint(lower, upper))
}
