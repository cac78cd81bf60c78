//! What it comes to: medians and counts of each method over each kind of goals.

use super::COLUMNS;
use super::spec::{Kind, TreefitSpec};
use crate::commands::experiment::Table;
use crate::output;
use anyhow::Context;

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
        for method in spec.methods.iter().filter(|method| method.fits(kind)) {
            let of: Vec<&Vec<String>> =
                table.rows.iter().filter(|row| row[1] == kind.name() && row[2] == method.name).collect();
            if of.is_empty() {
                continue;
            }
            let value = |row: &[String], at: usize| row[at].parse::<f64>().ok();
            let mut line = vec![kind.name().to_owned(), method.name.clone()];
            for (&at, name) in at.iter().zip(SHOWN) {
                let digits = match name {
                    "evaluations" => 0,
                    "wall_s" => 1,
                    _ => 3,
                };
                let median = median(of.iter().filter_map(|row| value(row, at)).collect());
                line.push(median.map_or_else(String::new, |median| format!("{median:.digits$}")));
            }
            // A number that is missing counts as a failure.
            let count = |left: usize, right: usize, part: f64| {
                let is = |row: &&&Vec<String>| {
                    value(row, left).zip(value(row, right)).is_some_and(|(a, b)| a >= part * b)
                };
                format!("{} of {}", of.iter().filter(is).count(), of.len())
            };
            line.push(count(fresh, ceiling, 0.95));
            line.push(count(iou, ellipse, 1.0));
            lines.push(line);
        }
    }
    let text = output::table(&lines, &(2..lines[0].len()).collect::<Vec<_>>());
    Ok(format!("medians, and how many are within 5 % of the ceiling and above the best ellipse\n\n{text}"))
}

/// The middle value, or the mean of the two in the middle.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let upper = *values.get(values.len() / 2)?;
    let lower = values[(values.len() - 1) / 2];
    Some(f64::midpoint(lower, upper))
}
