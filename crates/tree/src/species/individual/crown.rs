//! The hull of an individual's crown in a species file.

use crate::param::Problem;
use crate::species::doc::{Node, SpeciesDoc, Value};
use crate::species::error::Issue;
use pleach_plant::{DENSEST, Hull, HullView};
use std::fmt::Write as _;

/// The least and the greatest side of a cell over the tree's height.
const CELL: (f64, f64) = (0.002, 1.0);
/// How far a hull may be from the trunk's foot, over the tree's height.
const REACH: f64 = 10.0;

/// The lines of `hull`.
pub(super) fn to_toml(hull: &Hull) -> String {
    let mut text =
        "# the crown in pictures: degrees around the tree, side of a cell and left edge over the height,\n\
        # rows of cells from the top down to the ground (0: nothing, 9: dense)\n\
        crown = [\n"
            .to_owned();
    // Writing to a string cannot fail.
    for view in &hull.views {
        let _ = writeln!(text, "  [{:?}, {:?}, {:?}, [", view.degrees(), view.cell, view.left);
        for row in view.rows.iter().rev() {
            let digits: String = row.iter().map(|&cell| char::from(b'0' + cell)).collect();
            let _ = writeln!(text, "    \"{digits}\",");
        }
        text += "  ]],\n";
    }
    text += "]\n";
    if !hull.trunk.is_empty() {
        text += "# the trunk in the first picture: to the right, and up\ntrunk = [";
        let points: Vec<String> =
            hull.trunk.iter().map(|[across, up]| format!("[{across:?}, {up:?}]")).collect();
        text = text + &points.join(", ") + "]\n";
    }
    if hull.seed != 0 {
        let _ =
            writeln!(text, "# seed of the draws by which the crown fills them\ncrown_seed = {}", hull.seed);
    }
    text
}

/// The pictures in `node`.
pub(super) fn views(doc: &SpeciesDoc, name: &str, node: &Node) -> Result<Vec<HullView>, Issue> {
    let pictures = list(doc, name, node, "an array of pictures", Hull::MAX_VIEWS)?;
    pictures.iter().map(|picture| view(doc, name, picture)).collect()
}

fn view(doc: &SpeciesDoc, name: &str, node: &Node) -> Result<HullView, Issue> {
    const EXPECTED: &str = "a picture, such as [0.0, 0.25, -0.5, [\"0250\", \"2994\"]]";
    let Value::List(parts) = &node.value else {
        return Err(doc.wrong_type(name, node, EXPECTED, &node.value));
    };
    let [azimuth, cell, left, cells] = &parts[..] else {
        let problem = Problem::WrongLength { expected: 4, found: parts.len() };
        return Err(doc.issue(node.span.clone(), name, problem));
    };
    let view = HullView {
        azimuth: doc.number_within(name, azimuth, -360.0, 360.0)?.to_radians(),
        cell: doc.number_within(name, cell, CELL.0, CELL.1)?,
        left: doc.number_within(name, left, -REACH, REACH)?,
        rows: rows(doc, name, cells)?,
    };
    if view.rise().is_none() {
        let message = "has a picture with nothing in it".to_owned();
        return Err(doc.issue(node.span.clone(), name, Problem::Conflict { message }));
    }
    Ok(view)
}

/// Rows of cells, from the ground up.
fn rows(doc: &SpeciesDoc, name: &str, node: &Node) -> Result<Vec<Vec<u8>>, Issue> {
    let lines = list(doc, name, node, "an array of rows of cells", Hull::MAX_CELLS)?;
    let mut rows = Vec::with_capacity(lines.len());
    for line in lines.iter().rev() {
        let text = doc.text_of(name, line)?;
        let is_digits = text.bytes().all(|byte| (b'0'..=b'0' + DENSEST).contains(&byte));
        if !is_digits || text.len() > Hull::MAX_CELLS {
            let message =
                format!("has a row that is not of digits, or longer than {} cells", Hull::MAX_CELLS);
            return Err(doc.issue(line.span.clone(), name, Problem::Conflict { message }));
        }
        rows.push(text.bytes().map(|byte| byte - b'0').collect());
    }
    Ok(rows)
}

/// The course of a trunk in `node`.
pub(super) fn trunk(doc: &SpeciesDoc, name: &str, node: &Node) -> Result<Vec<[f64; 2]>, Issue> {
    let mut course: Vec<[f64; 2]> = Vec::new();
    for point in list(doc, name, node, "an array of points", Hull::MAX_POINTS)? {
        let Value::List(parts) = &point.value else {
            return Err(doc.wrong_type(name, point, "a point, such as [0.02, 0.25]", &point.value));
        };
        let [across, up] = &parts[..] else {
            let problem = Problem::WrongLength { expected: 2, found: parts.len() };
            return Err(doc.issue(point.span.clone(), name, problem));
        };
        let lowest = course.last().map_or(0.0, |last| last[1]);
        course.push([
            doc.number_within(name, across, -REACH, REACH)?,
            doc.number_within(name, up, lowest, REACH)?,
        ]);
    }
    Ok(course)
}

/// The parts of an array of at most `most`.
fn list<'a>(
    doc: &SpeciesDoc,
    name: &str,
    node: &'a Node,
    expected: &'static str,
    most: usize,
) -> Result<&'a [Node], Issue> {
    match &node.value {
        Value::List(list) if list.len() <= most => Ok(list),
        Value::List(list) => {
            let message = format!("has {} parts, expected at most {most}", list.len());
            Err(doc.issue(node.span.clone(), name, Problem::Conflict { message }))
        }
        other => Err(doc.wrong_type(name, node, expected, other)),
    }
}
