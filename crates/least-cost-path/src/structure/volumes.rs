//! The first volume by its parts.

use crate::volume::{Axis, Part, Side, Solid, Volume};
use glam::DVec3;
use pleach_tree::param::Problem;
use pleach_tree::species::{Form, Issue, Key, Node, Shape, SpeciesDoc, Value};

/// The key in species files.
pub(crate) const VOLUMES: &str = "volumes";
/// Parts that a volume may have.
const MAX_PARTS: usize = 200;
/// Largest coordinate and size, in crown radii.
const MAX_SIZE: f64 = 1e3;

const fn point(name: &'static str, doc: &'static str) -> Key {
    Key { name, form: Form::Point, default: "has to be given", doc }
}

const fn size(name: &'static str, doc: &'static str) -> Key {
    Key { name, form: Form::Length { max: MAX_SIZE }, default: "has to be given", doc }
}

/// The parts as they stand in files. Lengths are in crown radii.
pub(crate) const SHAPES: &[Shape] = &[
    Shape {
        name: "stem",
        keys: &[
            point("from", "the middle of its foot, in crown radii"),
            point("to", "the middle of its end"),
            size("radius", "its radius; no endpoint lies in it"),
        ],
    },
    Shape {
        name: "cylinder",
        keys: &[
            point("from", "the middle of its foot, in crown radii"),
            point("to", "the middle of its end"),
            size("radius", "its radius"),
        ],
    },
    Shape {
        name: "cone",
        keys: &[
            point("from", "the middle of its base, in crown radii"),
            point("to", "its apex"),
            size("radius", "radius of its base"),
        ],
    },
    Shape {
        name: "sphere",
        keys: &[point("center", "its middle, in crown radii"), size("radius", "its radius")],
    },
    Shape {
        name: "ellipsoid",
        keys: &[
            point("center", "its middle, in crown radii"),
            size("radius", "its half axis across"),
            size("height", "its height, twice the upright half axis"),
        ],
    },
];

/// One part as it stands in the file.
#[derive(Clone, Debug)]
struct Piece {
    shape: &'static Shape,
    /// Points and sizes in the order of the shape's keys; sizes are the first number of three.
    values: Vec<[f64; 3]>,
}

/// The parts of a first volume, in crown radii.
#[derive(Clone, Debug)]
pub(crate) struct Volumes {
    pieces: Vec<Piece>,
}

impl Volumes {
    /// Reads the volumes of `doc`, if there are any; what is wrong joins `issues`.
    pub(crate) fn read(doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Option<Self> {
        let node = doc.get(VOLUMES)?;
        let mut refuse = |problem| issues.push(doc.issue(node.span.clone(), VOLUMES, problem));
        let Value::List(items) = &node.value else {
            refuse(Problem::WrongType { expected: "an array of tables", found: node.value.type_name() });
            return None;
        };
        if items.is_empty() || items.len() > MAX_PARTS {
            refuse(Problem::Syntax {
                message: format!("has {} parts, expected 1 to {MAX_PARTS}", items.len()),
            });
            return None;
        }
        let mut pieces = Vec::new();
        for (i, item) in items.iter().enumerate() {
            match Piece::read(doc, &format!("{VOLUMES}[{i}]"), item) {
                Ok(piece) => pieces.push(piece),
                Err(issue) => issues.push(issue),
            }
        }
        (pieces.len() == items.len()).then_some(Self { pieces })
    }

    /// The volume where a crown radius is `unit` meters.
    pub(crate) fn volume(&self, unit: f64) -> Volume {
        let mut axes = Vec::new();
        let part = |piece: &Piece| {
            let (first, second) = (DVec3::from(piece.values[0]) * unit, piece.values[1]);
            let to = DVec3::from(second) * unit;
            let height = first.distance(to);
            let axis = (to - first).try_normalize().unwrap_or(DVec3::Z);
            match piece.shape.name {
                "sphere" => {
                    let solid = Solid::Portion { radius: second[0] * unit, cos: -1.0 };
                    Part::new(solid, first, DVec3::Z, true)
                }
                "ellipsoid" => {
                    let along = piece.values[2][0] * unit / 2.0;
                    let solid = Solid::Ellipsoid { across: second[0] * unit, along };
                    Part::new(solid, first, DVec3::Z, true)
                }
                name => {
                    let radius = piece.values[2][0] * unit;
                    let is_stem = name == "stem";
                    if is_stem {
                        axes.push(Axis { from: first, to, wander: radius });
                    }
                    let solid = match name {
                        "cone" => Solid::Cone { radius, height },
                        _ => Solid::Cylinder { radius, height },
                    };
                    Part::new(solid, first, axis, !is_stem)
                }
            }
        };
        let parts = self.pieces.iter().map(part).collect();
        Volume { axes, ..Volume::new(parts, Side::Above) }
    }

    /// As lines of a species file.
    pub(crate) fn to_toml(&self) -> String {
        let line = |piece: &Piece| {
            let values = piece.shape.keys.iter().zip(&piece.values).map(|(key, value)| match key.form {
                Form::Point => format!("{} = [{:?}, {:?}, {:?}]", key.name, value[0], value[1], value[2]),
                _ => format!("{} = {:?}", key.name, value[0]),
            });
            let values: Vec<String> = values.collect();
            format!("  {{ shape = \"{}\", {} }},\n", piece.shape.name, values.join(", "))
        };
        let lines: String = self.pieces.iter().map(line).collect();
        format!("{VOLUMES} = [\n{lines}]\n")
    }
}

impl Piece {
    fn read(doc: &SpeciesDoc, name: &str, node: &Node) -> Result<Self, Issue> {
        let Value::Table(entries) = &node.value else {
            let problem =
                Problem::WrongType { expected: "a table with a shape", found: node.value.type_name() };
            return Err(doc.issue(node.span.clone(), name, problem));
        };
        let get = |key: &str| {
            entries.iter().find(|e| e.key == key).map(|e| &e.node).ok_or_else(|| {
                let problem = Problem::Missing { expected: format!("`{key}`") };
                doc.issue(node.span.clone(), &format!("{name}.{key}"), problem)
            })
        };
        let shape_node = get("shape")?;
        let word = doc.text_of(&format!("{name}.shape"), shape_node)?;
        let Some(shape) = SHAPES.iter().find(|known| known.name == word) else {
            let known: Vec<String> = SHAPES.iter().map(|known| known.name.to_owned()).collect();
            let problem = Problem::UnknownChoice { value: word.to_owned(), known, nearest: None };
            return Err(doc.issue(shape_node.span.clone(), &format!("{name}.shape"), problem));
        };
        let known = |key: &str| key == "shape" || shape.keys.iter().any(|known| known.name == key);
        if let Some(entry) = entries.iter().find(|entry| !known(&entry.key)) {
            let problem = Problem::UnknownName { nearest: None };
            return Err(doc.issue(entry.span.clone(), &format!("{name}.{}", entry.key), problem));
        }
        let value = |key: &Key| {
            let (full, node) = (format!("{name}.{}", key.name), get(key.name)?);
            let out_of_range = |value: f64, min: f64| {
                let problem = match value.is_finite() {
                    true => Problem::OutOfRange { value, min, max: MAX_SIZE },
                    false => Problem::NotFinite { value },
                };
                doc.issue(node.span.clone(), &full, problem)
            };
            if let Form::Point = key.form {
                let vector = doc.vector_of(&full, node)?;
                return match vector.iter().find(|x| x.abs() > MAX_SIZE) {
                    Some(&far) => Err(out_of_range(far, -MAX_SIZE)),
                    None => Ok(vector),
                };
            }
            let size = doc.number_of(&full, node)?;
            if (0.0..=MAX_SIZE).contains(&size) { Ok([size, 0.0, 0.0]) } else { Err(out_of_range(size, 0.0)) }
        };
        Ok(Self { shape, values: shape.keys.iter().map(value).collect::<Result<_, _>>()? })
    }
}
