//! A drawn outline in a species file: an SVG path, points, or radii by height and direction.

use crate::volume::outline::{Outline, sampled};
use kurbo::{BezPath, PathEl, Point};
use pleach_tree::param::Problem;
use pleach_tree::species::{Issue, Node, SpeciesDoc, Value};
use std::ops::Range;
use std::sync::Arc;

/// The key in species files.
pub(crate) const OUTLINE: &str = "outline";
/// Points, heights and directions that an outline may have.
const MAX_POINTS: usize = 100_000;
/// How far a curve may stray from the straight pieces that stand for it, over its size.
const TOLERANCE: f64 = 1e-3;

/// An outline and how it stands in the file.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    pub(crate) outline: Arc<Outline>,
    toml: String,
}

/// A problem and the bytes of the file that it is about.
type Fault = (Range<usize>, Problem);

impl Drawn {
    /// Reads the outline of `doc`, if there is one; what is wrong joins `issues`.
    pub(crate) fn read(doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Option<Self> {
        let node = doc.get(OUTLINE)?;
        let read = match &node.value {
            Value::Text(path) => svg(node, path),
            Value::List(points) => curve(node, points),
            Value::Table(entries) => match entries.as_slice() {
                [only] if only.key == "radii" => radii(&only.node),
                _ => Err((
                    node.span.clone(),
                    Problem::Missing { expected: "`radii` and nothing else".to_owned() },
                )),
            },
            other => Err(wrong(node, "an SVG path, an array of points or a table", other)),
        };
        read.map_err(|(span, problem)| issues.push(doc.issue(span, OUTLINE, problem))).ok()
    }

    /// An outline by its radii: `heights` lists from the foot to the top, each with as many
    /// directions, evenly around from +x towards +y. `None` where they are no outline.
    pub(crate) fn of_radii(heights: &[Vec<f64>]) -> Option<Self> {
        let directions = heights.first()?.len();
        let even = heights.iter().all(|row| row.len() == directions);
        let all: Vec<f64> = heights.concat();
        let sound = all.iter().all(|r| r.is_finite() && *r >= 0.0) && all.iter().any(|r| *r > 0.0);
        if heights.len() < 2 || directions == 0 || all.len() > MAX_POINTS || !even || !sound {
            return None;
        }
        let row = |row: &Vec<f64>| format!("  {},\n", list(row.iter().copied()));
        let rows: String = heights.iter().map(row).collect();
        let toml = format!("{OUTLINE} = {{ radii = [\n{rows}] }}\n");
        Some(Self { outline: Arc::new(Outline::by_direction(all, directions)), toml })
    }

    /// As a line of a species file.
    pub(crate) fn to_toml(&self) -> String {
        self.toml.clone()
    }
}

fn list(numbers: impl Iterator<Item = f64>) -> String {
    let numbers: Vec<String> = numbers.map(|number| format!("{number:?}")).collect();
    format!("[{}]", numbers.join(", "))
}

fn wrong(node: &Node, expected: &'static str, found: &Value) -> Fault {
    (node.span.clone(), Problem::WrongType { expected, found: found.type_name() })
}

fn refused(node: &Node, message: &str) -> Fault {
    (node.span.clone(), Problem::Syntax { message: message.to_owned() })
}

/// A number that is finite.
fn number(node: &Node) -> Result<f64, Fault> {
    match node.value {
        Value::Number(value) if value.is_finite() => Ok(value),
        Value::Number(value) => Err((node.span.clone(), Problem::NotFinite { value })),
        ref other => Err(wrong(node, "a number", other)),
    }
}

/// A radius.
fn radius(node: &Node) -> Result<f64, Fault> {
    let value = number(node)?;
    if value < 0.0 {
        return Err((node.span.clone(), Problem::OutOfRange { value, min: 0.0, max: f64::MAX }));
    }
    Ok(value)
}

/// Largest coordinate of an SVG path.
const MAX_COORDINATE: f64 = 1e9;

/// A curve through points, each a radius and a height.
fn curve(node: &Node, points: &[Node]) -> Result<Drawn, Fault> {
    let point = |node: &Node| match &node.value {
        Value::List(pair) => match pair.as_slice() {
            [r, h] => Ok([radius(r)?, number(h)?]),
            _ => Err((node.span.clone(), Problem::WrongLength { expected: 2, found: pair.len() })),
        },
        other => Err(wrong(node, "a point: [radius, height]", other)),
    };
    if points.len() > MAX_POINTS {
        return Err(refused(node, "has too many points"));
    }
    let points: Vec<[f64; 2]> = points.iter().map(point).collect::<Result<_, _>>()?;
    let rows: Vec<String> = points.iter().map(|point| list(point.iter().copied())).collect();
    let toml = format!("{OUTLINE} = [{}]\n", rows.join(", "));
    fitted(node, points.windows(2).map(|pair| [pair[0], pair[1]]).collect(), toml)
}

/// A curve as SVG draws it: y downwards, the axis at x = 0.
fn svg(node: &Node, text: &str) -> Result<Drawn, Fault> {
    let path =
        BezPath::from_svg(text).map_err(|error| refused(node, &format!("is not an SVG path: {error}")))?;
    if !path.is_finite() {
        return Err(refused(node, "is an SVG path with numbers that are not finite"));
    }
    if path.elements().is_empty() {
        return Err(refused(node, "is an empty SVG path"));
    }
    let bounds = path.control_box();
    let reach = [bounds.x0, bounds.x1, bounds.y0, bounds.y1].map(f64::abs).into_iter().fold(0.0, f64::max);
    // Pieces of the curve are counted in proportion to what its control points span.
    if reach > MAX_COORDINATE {
        return Err(refused(node, "is an SVG path with coordinates beyond a thousand million"));
    }
    let size = bounds.width().max(bounds.height());
    let mut pieces: Vec<[[f64; 2]; 2]> = Vec::new();
    let (mut start, mut last) = (Point::ZERO, Point::ZERO);
    kurbo::flatten(path, (TOLERANCE * size).max(f64::MIN_POSITIVE), |element| {
        let to = match element {
            PathEl::MoveTo(to) => {
                (start, last) = (to, to);
                return;
            }
            PathEl::LineTo(to) => to,
            _ => start,
        };
        if pieces.len() <= MAX_POINTS {
            pieces.push([[last.x.abs(), -last.y], [to.x.abs(), -to.y]]);
            if last.x * to.x < 0.0 {
                // It crosses the axis, where its distance is zero.
                let middle = [0.0, -(last.y + (to.y - last.y) * last.x / (last.x - to.x))];
                let len = pieces.len();
                pieces[len - 1][1] = middle;
                pieces.push([middle, [to.x.abs(), -to.y]]);
            }
        }
        last = to;
    });
    if pieces.len() > MAX_POINTS {
        return Err(refused(node, "is an SVG path with too many pieces"));
    }
    let toml = format!("{OUTLINE} = {}\n", toml_string(text));
    fitted(node, pieces, toml)
}

/// Text in quotes, as TOML has it.
fn toml_string(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => quoted.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// Brings a curve to heights from 0 to 1 and a largest radius of 1.
fn fitted(node: &Node, mut pieces: Vec<[[f64; 2]; 2]>, toml: String) -> Result<Drawn, Fault> {
    let points = || pieces.iter().flatten();
    let widest = points().map(|p| p[0]).fold(0.0, f64::max);
    let low = points().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let high = points().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    if !(widest > 0.0 && high > low && (high - low).is_finite()) {
        return Err(refused(node, "encloses nothing: it needs a height, and a distance from its axis"));
    }
    for point in pieces.iter_mut().flatten() {
        *point = [point[0] / widest, (point[1] - low) / (high - low)];
    }
    let outline = Outline::of_radii(&sampled(pieces));
    if outline.content() <= 0.0 {
        return Err(refused(node, "encloses nothing: it needs a height, and a distance from its axis"));
    }
    Ok(Drawn { outline: Arc::new(outline), toml })
}

/// Radii by height and direction.
fn radii(node: &Node) -> Result<Drawn, Fault> {
    let rows = |node: &Node| match &node.value {
        Value::List(row) => row.iter().map(radius).collect::<Result<Vec<f64>, _>>(),
        other => Err(wrong(node, "an array of radii", other)),
    };
    let Value::List(list) = &node.value else {
        return Err(wrong(node, "an array of arrays of radii", &node.value));
    };
    let rows: Vec<Vec<f64>> = list.iter().map(rows).collect::<Result<_, _>>()?;
    let message = "needs two heights or more, all with as many directions, and a radius above zero";
    Drawn::of_radii(&rows).ok_or_else(|| refused(node, message))
}
