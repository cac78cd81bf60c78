//! The draws of an individual's stems in a species file.

use crate::param::Problem;
use crate::species::doc::{Entry, Node, SpeciesDoc, Value};
use crate::species::error::Issue;
use pleach_plant::{BadStemPath, Draw, Individual, StemPath};
use std::fmt::Write as _;

/// Most stems of an individual: more than any fit writes.
const MAX_STEMS: usize = 100_000;

/// The stems of `individual`; empty where none has draws of its own.
pub(super) fn to_toml(individual: &Individual) -> String {
    if individual.stems().next().is_none() {
        return String::new();
    }
    let mut text =
        "# stem, seed of its draws, azimuth and pitch in degrees, factor of its length\nstems = [\n"
            .to_owned();
    for (path, draw) in individual.stems() {
        let Draw { seed, length, .. } = draw;
        let (azimuth, pitch) = draw.degrees();
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  [\"{path}\", {seed}, {azimuth:?}, {pitch:?}, {length:?}],");
    }
    text + "]\n"
}

/// Reads the stems of `entry` into `individual`; what is wrong joins `issues`.
pub(super) fn read(
    doc: &SpeciesDoc,
    (name, entry): (&str, &Entry),
    individual: &mut Individual,
    issues: &mut Vec<Issue>,
) {
    match &entry.node.value {
        Value::List(rows) if rows.len() > MAX_STEMS => {
            let message = format!("has {} stems, expected at most {MAX_STEMS}", rows.len());
            issues.push(doc.issue(entry.span.clone(), name, Problem::Conflict { message }));
        }
        Value::List(rows) => {
            for node in rows {
                match row(doc, name, node, individual) {
                    Ok((path, draw)) => individual.set(path, draw),
                    Err(issue) => issues.push(issue),
                }
            }
        }
        other => issues.push(doc.wrong_type(name, &entry.node, "an array of stems", other)),
    }
}

/// One stem and its draws.
fn row(doc: &SpeciesDoc, name: &str, node: &Node, before: &Individual) -> Result<(StemPath, Draw), Issue> {
    const EXPECTED: &str = "a stem, such as [\"0/12\", 7, 12.5, -3.1, 1.04]";
    let Value::List(cells) = &node.value else {
        return Err(doc.wrong_type(name, node, EXPECTED, &node.value));
    };
    let [path, seed, azimuth, pitch, length] = &cells[..] else {
        let problem = Problem::WrongLength { expected: 5, found: cells.len() };
        return Err(doc.issue(node.span.clone(), name, problem));
    };
    let conflict =
        |node: &Node, message: String| doc.issue(node.span.clone(), name, Problem::Conflict { message });
    let stem: StemPath = doc
        .text_of(name, path)?
        .parse()
        .map_err(|error: BadStemPath| conflict(path, format!("names no stem: {error}")))?;
    if before.get(&stem).is_some() {
        return Err(conflict(path, format!("has the stem {stem} twice")));
    }
    let within = |node: &Node, min: f64, max: f64| doc.number_within(name, node, min, max);
    let draw = Draw {
        seed: doc.small_seed(name, seed)?,
        azimuth: within(azimuth, -180.0, 180.0)?.to_radians(),
        pitch: within(pitch, -180.0, 180.0)?.to_radians(),
        length: within(length, 0.1, 10.0)?,
    };
    Ok((stem, draw))
}
