//! The tables of the experiment's README, from its rows.

use super::Answer;
use super::measures::MEASURES;
use pleach_console::output;

/// Measures that stand beside each other in the first tables; the rest are the ablation.
const BESIDE: usize = 5;

pub(super) fn tables(table: &[Answer]) -> String {
    let beside = &MEASURES[..BESIDE];
    let ablation = [&MEASURES[..1], &MEASURES[BESIDE..]].concat();
    let sections = [
        ("another tree of the species above trees of others", species(table, beside)),
        ("by species, own", by_species(table, beside)),
        ("another tree of the species above the goal's blobs", blobs(table, beside)),
        ("walks: mean rank correlation, share below -0.9, worst", walks(table, beside)),
        ("without parts, and parts alone", ablated(table, &ablation)),
    ];
    sections.map(|(head, text)| format!("{head}\n\n{text}")).join("\n\n")
}

fn percent(value: f64) -> String {
    format!("{:.2}", 100.0 * value)
}

/// The rows of a question in order, each (set, against) once.
fn subjects<'a>(table: &'a [Answer], question: &str) -> Vec<(&'a str, &'a str)> {
    let mut seen = Vec::new();
    for row in table.iter().filter(|row| row.question == question) {
        let key = (row.set.as_str(), row.against.as_str());
        if seen.last() != Some(&key) {
            seen.push(key);
        }
    }
    seen
}

fn value(table: &[Answer], question: &str, (set, against): (&str, &str), measure: &str) -> Option<f64> {
    let wanted = |row: &&Answer| {
        (row.question.as_str(), row.set.as_str()) == (question, set)
            && (row.against.as_str(), row.measure.as_str()) == (against, measure)
    };
    table.iter().find(wanted).map(|row| row.value.0)
}

/// A table with a line a subject and a column a measure.
fn shares(table: &[Answer], question: &str, subjects: &[(&str, &str)], measures: &[&str]) -> String {
    let heading = ["set", "against"].iter().chain(measures).map(|s| (*s).to_owned()).collect();
    let mut rows: Vec<Vec<String>> = vec![heading];
    for &subject in subjects {
        let cells =
            measures.iter().map(|m| value(table, question, subject, m).map_or_else(String::new, percent));
        rows.push([subject.0, subject.1].map(str::to_owned).into_iter().chain(cells).collect());
    }
    output::table(&rows, &(2..2 + measures.len()).collect::<Vec<_>>())
}

fn species(table: &[Answer], measures: &[&str]) -> String {
    let mut all = subjects(table, "other species");
    all.retain(|s| s.1 == "all");
    shares(table, "other species", &all, measures)
}

fn by_species(table: &[Answer], measures: &[&str]) -> String {
    let mut own = subjects(table, "other species");
    own.retain(|s| s.0 == "own" && s.1 != "all");
    shares(table, "other species", &own, measures)
}

fn blobs(table: &[Answer], measures: &[&str]) -> String {
    shares(table, "blobs", &subjects(table, "blobs"), measures)
}

/// Correlations of all walks, or of those of one parameter, by one measure.
fn correlations(table: &[Answer], parameter: Option<&str>, measure: &str) -> Vec<f64> {
    let of = |row: &&Answer| {
        let name = row.against.split(' ').next();
        row.question == "walk" && row.measure == measure && (parameter.is_none() || name == parameter)
    };
    table.iter().filter(of).map(|row| row.value.0).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

fn walks(table: &[Answer], measures: &[&str]) -> String {
    let mut parameters: Vec<Option<&str>> = vec![None];
    for (_, against) in subjects(table, "walk") {
        let name = against.split(' ').next();
        if !parameters.contains(&name) {
            parameters.push(name);
        }
    }
    let heading = ["parameter", "walks"].iter().chain(measures).map(|s| (*s).to_owned()).collect();
    let mut rows: Vec<Vec<String>> = vec![heading];
    for parameter in parameters {
        let count = correlations(table, parameter, measures[0]).len();
        let cells = measures.iter().map(|measure| {
            let all = correlations(table, parameter, measure);
            let steady = all.iter().filter(|c| **c <= -0.9).count() as f64 / all.len().max(1) as f64;
            let worst = all.iter().copied().fold(-1.0, f64::max);
            format!("{:.3} {:.0} % {worst:.2}", mean(&all), 100.0 * steady)
        });
        let head = [parameter.unwrap_or("all").to_owned(), count.to_string()];
        rows.push(head.into_iter().chain(cells).collect());
    }
    output::table(&rows, &(1..2 + measures.len()).collect::<Vec<_>>())
}

/// One line per measure: species told apart, the worst blob, the mean of all walks, and what a goal that
/// is moved aside or mirrored has.
fn ablated(table: &[Answer], measures: &[&str]) -> String {
    let sets = ["own, not tuned on", "own", "own, bare", "own, goal's scale", "reference"];
    let heading = ["measure"]
        .iter()
        .chain(&sets)
        .chain(&["worst blob", "walks", "aside", "mirrored"])
        .map(|s| (*s).to_owned());
    let mut rows: Vec<Vec<String>> = vec![heading.collect()];
    let against_blobs = subjects(table, "blobs");
    for measure in measures {
        let told = sets.map(|set| {
            value(table, "other species", (set, "all"), measure).map_or_else(String::new, percent)
        });
        let of_blobs = against_blobs.iter().filter(|s| s.0 == "own" || s.0 == "reference");
        let worst = of_blobs.filter_map(|s| value(table, "blobs", *s, measure)).fold(1.0, f64::min);
        let walks = format!("{:.3}", mean(&correlations(table, None, measure)));
        let moved = ["aside by 1/16", "mirrored"].map(|way| {
            value(table, "moved", ("own", way), measure).map_or_else(String::new, |v| format!("{v:.3}"))
        });
        let head = [(*measure).to_owned()];
        rows.push(head.into_iter().chain(told).chain([percent(worst), walks]).chain(moved).collect());
    }
    output::table(&rows, &(1..10).collect::<Vec<_>>())
}
