//! What it comes to: medians and counts of each method over each kind of goals, and which method wins.
//!
//! A goal counts once: its numbers are means over repetitions.

use super::COLUMNS;
use super::spec::{Kind, MethodSpec, TreefitSpec};
use crate::Table;
use anyhow::Context;
use pleach_console::output;

/// Columns whose medians are shown.
const SHOWN: [&str; 7] =
    ["likeness", "iou", "pixel_accuracy", "fresh_likeness", "fresh_iou", "evaluations", "wall_s"];

pub(super) fn of(spec: &TreefitSpec, table: &Table) -> anyhow::Result<String> {
    let column = |name: &str| COLUMNS.iter().position(|c| *c == name).context("a declared column");
    let at: Vec<usize> = SHOWN.iter().map(|name| column(name)).collect::<anyhow::Result<_>>()?;
    let [iou, ellipse] = [column("iou")?, column("best_ellipse_iou")?];
    let [fresh, ceiling] = [column("fresh_likeness")?, column("ceiling_likeness")?];
    let heading = ["goals", "method"].into_iter().chain(SHOWN).chain(["near ceiling", "above ellipse"]);
    let mut lines = vec![heading.map(str::to_owned).collect::<Vec<_>>()];
    for kind in Kind::ALL {
        for method in spec.methods().filter(|method| method.fits(kind)) {
            let of: Vec<&Vec<String>> =
                table.rows.iter().filter(|row| row[1] == kind.name() && row[2] == method.name).collect();
            if of.is_empty() {
                continue;
            }
            let goals = by_goal(&of);
            let mut line = vec![kind.name().to_owned(), method.name.clone()];
            for (&at, name) in at.iter().zip(SHOWN) {
                let digits = match name {
                    "evaluations" => 0,
                    "wall_s" => 1,
                    _ => 3,
                };
                let median = median(goals.iter().filter_map(|rows| mean(rows, at)).collect());
                line.push(median.map_or_else(String::new, |median| format!("{median:.digits$}")));
            }
            // A number that is missing counts as a failure.
            let count = |left: usize, right: usize, part: f64| {
                let is = |rows: &&Vec<&Vec<String>>| {
                    mean(rows, left).zip(mean(rows, right)).is_some_and(|(a, b)| a >= part * b)
                };
                format!("{} of {}", goals.iter().filter(is).count(), goals.len())
            };
            line.push(count(fresh, ceiling, 0.95));
            line.push(count(iou, ellipse, 1.0));
            lines.push(line);
        }
    }
    let text = output::table(&lines, &(2..lines[0].len()).collect::<Vec<_>>());
    let [goal, named] = [column("goal")?, column("named")?];
    let known = [Kind::Own, Kind::Bare].map(Kind::name);
    let first = |row: &&Vec<String>| row[2] == spec.first_method().name && known.contains(&row[1].as_str());
    let guessed: Vec<&Vec<String>> = table.rows.iter().filter(first).collect();
    let right = guessed.iter().filter(|row| row[goal].trim_end_matches("_bare") == row[named]).count();
    Ok(format!(
        "medians over goals of means over repetitions, and how many goals are within 5 % of the ceiling and \
         above the best ellipse\n\n{text}\n\nspecies named right: {right} of {} fits\n{}",
        guessed.len(),
        wins(spec, table, [column("likeness")?, iou], fresh)
    ))
}

/// On how many leafy own goals each method is the best of those with the same start and budget, by the
/// mean of likeness and IoU, and by the likeness of fresh seeds; first repetitions.
fn wins(spec: &TreefitSpec, table: &Table, both: [usize; 2], fresh: usize) -> String {
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
        for (by, columns) in [("likeness and IoU", &both[..]), ("fresh likeness", &[fresh])] {
            let mut counts = vec![0; group.len()];
            for goal in spec.goals().filter(|goal| goal.kind() == Kind::Own) {
                let score = |method: &&MethodSpec| -> f64 {
                    let row = table.rows.iter().find(|r| r[0] == goal.name() && r[2] == method.name);
                    let value = |&at: &usize| row.and_then(|row| row[at].parse::<f64>().ok());
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
fn by_goal<'a>(rows: &[&'a Vec<String>]) -> Vec<Vec<&'a Vec<String>>> {
    rows.chunk_by(|a, b| a[0] == b[0]).map(<[_]>::to_vec).collect()
}

/// The mean of a column; none where no row has it.
fn mean(rows: &[&Vec<String>], at: usize) -> Option<f64> {
    let values: Vec<f64> = rows.iter().filter_map(|row| row[at].parse().ok()).collect();
    (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
}

/// The middle value, or the mean of the two in the middle.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = *values.get(values.len() / 2)?;
    let lower = values[(values.len() - 1) / 2];
    Some(f64::midpoint(lower, upper))
}
