//! The leaderboard: means over goals with intervals, as a table and for people.

use super::budget::Budget;
use super::contestant::Contestant;
use super::goal::Set;
use super::interval::Interval;
use super::row::{MEASURES, Row};
use crate::record::{self, Fixed};
use crate::table::Table;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;

/// By how much `fresh` is more than the default's of the same budget, goal by goal.
const OVER_DEFAULT: &str = "fresh_over_default";

/// A line: a contestant with a budget on the goals of a set.
struct Line<'a> {
    set: Set,
    row: &'a str,
    budget: Budget,
    goals: usize,
    /// In the order of [`MEASURES`].
    means: Vec<Option<Interval>>,
    over_default: Option<Interval>,
}

/// A mean of the table.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
struct Mean {
    set: Set,
    row: String,
    budget: Budget,
    /// Goals that have the measure.
    goals: usize,
    measure: String,
    mean: Fixed<4>,
    /// The ends of an interval that holds the mean nine times in ten.
    low: Fixed<4>,
    high: Fixed<4>,
}

/// The lines of all sets, the best first.
fn lines(rows: &[Row]) -> Vec<Line<'_>> {
    let mut lines: Vec<Line<'_>> = Vec::new();
    for row in rows {
        let is_there =
            |line: &Line<'_>| (line.set, line.row, line.budget) == (row.set, row.row.as_str(), row.budget);
        if !lines.iter().any(is_there) {
            lines.push(line(rows, row));
        }
    }
    let rank = |line: &Line<'_>| {
        let set = Set::ALL.iter().position(|set| *set == line.set);
        // What has no other seeds, since it is not a tree, comes last.
        let best = |at: usize| line.means[at].map_or(f64::NEG_INFINITY, |one| one.mean);
        (set, [-best(0), -best(1)])
    };
    lines.sort_by(|a, b| {
        let ((set, [fresh, own]), (other, [less, least])) = (rank(a), rank(b));
        set.cmp(&other).then(fresh.total_cmp(&less)).then(own.total_cmp(&least))
    });
    lines
}

/// The line that `of` is of.
fn line<'a>(rows: &'a [Row], of: &'a Row) -> Line<'a> {
    let with = |name: &'a str| {
        rows.iter().filter(move |row| (row.set, row.row.as_str(), row.budget) == (of.set, name, of.budget))
    };
    let own: Vec<&Row> = with(&of.row).collect();
    let mean = |value: fn(&Row) -> Option<f64>| {
        Interval::new(own.iter().filter_map(|row| Some((row.group.as_str(), value(row)?))))
    };
    let fresh = MEASURES[0].value;
    let over = |row: &&'a Row| {
        let default = with(Contestant::Default.name()).find(|other| other.goal == row.goal)?;
        Some((row.group.as_str(), fresh(row)? - fresh(default)?))
    };
    let is_default = of.row == Contestant::Default.name();
    Line {
        set: of.set,
        row: &of.row,
        budget: of.budget,
        goals: own.len(),
        means: MEASURES.iter().map(|measure| mean(measure.value)).collect(),
        over_default: (!is_default).then(|| Interval::new(own.iter().filter_map(over))).flatten(),
    }
}

/// All means with their intervals.
pub(super) fn table(rows: &[Row]) -> anyhow::Result<Table> {
    let mut means = Vec::new();
    for line in lines(rows) {
        let named = MEASURES.iter().map(|measure| measure.name).zip(&line.means);
        let all = named.chain([(OVER_DEFAULT, &line.over_default)]);
        means.extend(all.filter_map(|(measure, interval)| {
            let interval = (*interval)?;
            Some(Mean {
                set: line.set,
                row: line.row.to_owned(),
                budget: line.budget,
                goals: interval.count,
                measure: measure.to_owned(),
                mean: Fixed(interval.mean),
                low: Fixed(interval.low),
                high: Fixed(interval.high),
            })
        }));
    }
    let rows = means.iter().map(record::to_row).collect::<anyhow::Result<_>>()?;
    Ok(Table { columns: record::columns(&Mean::default())?, rows })
}

/// A table for each set, in Markdown.
pub(super) fn markdown(rows: &[Row]) -> String {
    let lines = lines(rows);
    let mut text =
        "Means over goals, ± half of the width of an interval that holds nine tenths. Rows with a budget in \
                    seconds depend on the machine.\n"
            .to_owned();
    for set in Set::ALL {
        let of: Vec<&Line<'_>> = lines.iter().filter(|line| line.set == set).collect();
        if of.is_empty() {
            continue;
        }
        // What no row of the set has is left out.
        let shown: Vec<usize> =
            (0..MEASURES.len()).filter(|at| of.iter().any(|line| line.means[*at].is_some())).collect();
        let is_compared = of.iter().any(|line| line.over_default.is_some());
        let words = shown.iter().map(|at| MEASURES[*at].words);
        let heading: Vec<&str> = ["row", "budget", "goals"]
            .into_iter()
            .chain(words)
            .chain(is_compared.then_some("fresh over default"))
            .collect();
        let _ = write!(text, "\n## {set}\n\n| {} |\n", heading.join(" | "));
        let _ = writeln!(text, "| --- | --- |{}", " ---: |".repeat(heading.len() - 2));
        for line in of {
            let name = pleach_console::text::shown(line.row).replace('|', "\\|");
            let mut cells = vec![name, line.budget.to_string(), line.goals.to_string()];
            cells.extend(shown.iter().map(|at| cell(line.means[*at], MEASURES[*at].decimals, "")));
            if is_compared {
                cells.push(cell(line.over_default, MEASURES[0].decimals, "+"));
            }
            let _ = writeln!(text, "| {} |", cells.join(" | "));
        }
    }
    text
}

/// A mean and half of its interval; empty where there is none. `sign` stands before what is not below 0.
fn cell(interval: Option<Interval>, decimals: usize, sign: &str) -> String {
    interval.map_or_else(String::new, |one| {
        let sign = if one.mean < 0.0 { "" } else { sign };
        format!("{sign}{:.decimals$} ± {:.decimals$}", one.mean, one.half())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(goal: &str, name: &str, budget: Budget, fresh: Option<f64>, likeness: f64) -> Row {
        Row {
            goal: goal.to_owned(),
            group: goal.to_owned(),
            row: name.to_owned(),
            budget,
            fresh: fresh.map(Fixed),
            likeness: Some(Fixed(likeness)),
            ..Row::default()
        }
    }

    fn rows() -> Vec<Row> {
        let few = Budget::Trees(100);
        vec![
            row("a", "default", few, Some(0.6), 0.7),
            row("b", "default", few, Some(0.8), 0.7),
            row("a", "cma", few, Some(0.7), 0.9),
            row("b", "cma", few, Some(0.9), 0.9),
            row("a", "ellipse", Budget::Free, None, 0.4),
            row("a", "cma", Budget::Trees(1000), Some(0.95), 0.9),
        ]
    }

    #[test]
    fn the_best_comes_first_and_what_is_not_a_tree_last() {
        let text = markdown(&rows());
        let names: Vec<&str> = text.lines().filter(|line| line.contains("0.")).collect();
        let begins = ["| cma | 1000 trees | 1 | 0.950 ± 0.000", "| cma | 100 trees | 2 | 0.800 ± 0.100"];
        assert!(names[0].starts_with(begins[0]) && names[1].starts_with(begins[1]), "{text}");
        assert!(names[2].starts_with("| default | 100 trees | 2 | 0.700"), "{text}");
        assert_eq!(names[3], "| ellipse |  | 1 |  | 0.400 ± 0.000 |  |", "{text}");
        // Goal by goal, the difference is the same.
        assert!(names[1].ends_with("| +0.100 ± 0.000 |") && names[2].ends_with("|  |"), "{text}");
        assert!(text.contains("## perturbed\n") && !text.contains("IoU"), "{text}");
    }

    #[test]
    fn the_table_has_a_row_for_each_mean() {
        let table = table(&rows()).unwrap();
        assert_eq!(table.columns, ["set", "row", "budget", "goals", "measure", "mean", "low", "high"]);
        let of = |line: &str| table.rows.iter().any(|row| row.join(",") == line);
        assert!(of("perturbed,cma,100 trees,2,fresh,0.8000,0.7000,0.9000"), "{table:?}");
        assert!(of("perturbed,cma,100 trees,2,fresh_over_default,0.1000,0.1000,0.1000"), "{table:?}");
        assert!(of("perturbed,ellipse,,1,likeness,0.4000,0.4000,0.4000"), "{table:?}");
        assert_eq!(table.rows.len(), 3 * 2 + 1 + 1);
    }
}
