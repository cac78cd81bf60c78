//! Solids that a tree is pruned against, beside the envelope of revolution.
//!
//! Hewitt 2017, §3.2.1 *Pruning*: any point test may stand for the envelope (Figure 3.8), and
//! things in the way, such as buildings, may be taken out of it (Figure 3.9).

use glam::DVec3;
use pleach_tree::param::Problem;
use pleach_tree::species::{Entry, Form, Issue, Key, Node, Shape, SpeciesDoc, Value};
use std::fmt::Write as _;

/// Largest coordinate, radius and height in metres.
const MAX_SIZE: f64 = 1e6;

const fn point(name: &'static str, doc: &'static str) -> Key {
    Key { name, form: Form::Point, default: "has to be given", doc }
}

const fn size(name: &'static str, doc: &'static str) -> Key {
    Key { name, form: Form::Length { max: MAX_SIZE }, default: "has to be given", doc }
}

/// The solids as they stand in files.
pub(crate) const SHAPES: &[Shape] = &[
    Shape { name: "sphere", keys: &[point("center", "its middle"), size("radius", "its radius")] },
    Shape {
        name: "cylinder",
        keys: &[
            point("center", "the middle of its foot"),
            size("radius", "its radius"),
            size("height", "its height above the foot"),
        ],
    },
    Shape {
        name: "box",
        keys: &[
            point("min", "its corner with the smallest coordinates"),
            point("max", "its corner with the largest coordinates"),
        ],
    },
];

/// A solid, fixed in the world. Metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solid {
    /// A ball.
    Sphere {
        /// Its middle.
        center: DVec3,
        /// Its radius.
        radius: f64,
    },
    /// An upright cylinder.
    Cylinder {
        /// The middle of its foot.
        center: DVec3,
        /// Its radius.
        radius: f64,
        /// Its height above the foot.
        height: f64,
    },
    /// A box along the axes.
    Box {
        /// Its corner with the smallest coordinates.
        min: DVec3,
        /// Its corner with the largest coordinates.
        max: DVec3,
    },
}

impl Solid {
    /// Whether `point` is inside or on the surface.
    #[must_use]
    pub fn contains(&self, point: DVec3) -> bool {
        match *self {
            Self::Sphere { center, radius } => point.distance_squared(center) <= radius * radius,
            Self::Cylinder { center, radius, height } => {
                let d = point - center;
                (0.0..=height).contains(&d.z) && d.truncate().length_squared() <= radius * radius
            }
            Self::Box { min, max } => point.cmpge(min).all() && point.cmple(max).all(),
        }
    }

    /// Reads a list of solids: `[{ shape = "sphere", center = [0, 0, 8], radius = 5 }, …]`.
    pub(crate) fn read_list(doc: &SpeciesDoc, key: &str, issues: &mut Vec<Issue>) -> Option<Vec<Self>> {
        let node = doc.get(key)?;
        let Value::List(items) = &node.value else {
            let problem =
                Problem::WrongType { expected: "an array of solids", found: node.value.type_name() };
            issues.push(doc.issue(node.span.clone(), key, problem));
            return None;
        };
        let mut solids = Vec::new();
        for (i, item) in items.iter().enumerate() {
            match Self::read(doc, &format!("{key}[{i}]"), item) {
                Ok(solid) => solids.push(solid),
                Err(issue) => issues.push(issue),
            }
        }
        Some(solids)
    }

    fn read(doc: &SpeciesDoc, name: &str, node: &Node) -> Result<Self, Issue> {
        let Value::Table(entries) = &node.value else {
            let problem =
                Problem::WrongType { expected: "a table with a shape", found: node.value.type_name() };
            return Err(doc.issue(node.span.clone(), name, problem));
        };
        let get = |key: &str| -> Result<&Node, Issue> {
            entries.iter().find(|e| e.key == key).map(|e| &e.node).ok_or_else(|| {
                let problem = Problem::Missing { expected: format!("`{key}`") };
                doc.issue(node.span.clone(), &format!("{name}.{key}"), problem)
            })
        };
        let shape = doc.text_of(&format!("{name}.shape"), get("shape")?)?;
        let Some(Shape { keys, .. }) = SHAPES.iter().find(|known| known.name == shape) else {
            let problem = Problem::UnknownChoice {
                value: shape.to_owned(),
                known: SHAPES.iter().map(|known| known.name.to_owned()).collect(),
                nearest: None,
            };
            return Err(doc.issue(get("shape")?.span.clone(), &format!("{name}.shape"), problem));
        };
        let names: Vec<&str> = keys.iter().map(|key| key.name).collect();
        let stray = |e: &&Entry| e.key != "shape" && !names.contains(&e.key.as_str());
        if let Some(entry) = entries.iter().find(stray) {
            let problem = Problem::Conflict { message: format!("a {shape} has {}", names.join(", ")) };
            return Err(doc.issue(entry.span.clone(), &format!("{name}.{}", entry.key), problem));
        }
        let point = |key: &str| {
            let node = get(key)?;
            let full = format!("{name}.{key}");
            let point = DVec3::from(doc.vector_of(&full, node)?);
            let far = point.to_array().into_iter().find(|value| value.abs() > MAX_SIZE);
            far.map_or(Ok(point), |value| {
                let problem = Problem::OutOfRange { value, min: -MAX_SIZE, max: MAX_SIZE };
                Err(doc.issue(node.span.clone(), &full, problem))
            })
        };
        let size = |key: &str| {
            let node = get(key)?;
            let full = format!("{name}.{key}");
            let value = doc.number_of(&full, node)?;
            if (0.0..=MAX_SIZE).contains(&value) {
                Ok(value)
            } else {
                Err(doc.issue(
                    node.span.clone(),
                    &full,
                    Problem::OutOfRange { value, min: 0.0, max: MAX_SIZE },
                ))
            }
        };
        match shape {
            "sphere" => Ok(Self::Sphere { center: point("center")?, radius: size("radius")? }),
            "cylinder" => Ok(Self::Cylinder {
                center: point("center")?,
                radius: size("radius")?,
                height: size("height")?,
            }),
            _ => {
                let (min, max) = (point("min")?, point("max")?);
                if min.cmple(max).all() {
                    Ok(Self::Box { min, max })
                } else {
                    let message = "has a `min` that is larger than its `max`".to_owned();
                    Err(doc.issue(node.span.clone(), name, Problem::Conflict { message }))
                }
            }
        }
    }

    /// The solids as a TOML array.
    pub(crate) fn write_list(solids: &[Self]) -> String {
        let mut text = String::from("[");
        for (i, solid) in solids.iter().enumerate() {
            text.push_str(if i == 0 { "\n" } else { ",\n" });
            let p = |v: DVec3| format!("[{:?}, {:?}, {:?}]", v.x, v.y, v.z);
            // Writing to a string cannot fail.
            let _ = match *solid {
                Self::Sphere { center, radius } => {
                    write!(text, r#"    {{ shape = "sphere", center = {}, radius = {radius:?} }}"#, p(center))
                }
                Self::Cylinder { center, radius, height } => write!(
                    text,
                    r#"    {{ shape = "cylinder", center = {}, radius = {radius:?}, height = {height:?} }}"#,
                    p(center)
                ),
                Self::Box { min, max } => {
                    write!(text, r#"    {{ shape = "box", min = {}, max = {} }}"#, p(min), p(max))
                }
            };
        }
        text.push_str(if solids.is_empty() { "]" } else { ",\n]" });
        text
    }
}

/// The bounds that pruning tests points against when `prune_ratio` is above 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surroundings {
    /// A point fits if it is inside one of these; `None` for the envelope of revolution, an empty
    /// list for no bound at all.
    pub inside: Option<Vec<Solid>>,
    /// A point does not fit if it is inside one of these.
    pub obstacles: Vec<Solid>,
}

impl Surroundings {
    /// Whether a tree is pruned by nothing but the envelope of its own numbers.
    pub(crate) fn are_the_envelope(&self) -> bool {
        self.inside.is_none() && self.obstacles.is_empty()
    }
}
