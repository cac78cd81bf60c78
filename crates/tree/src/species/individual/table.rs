//! An individual in a species file: the table `[individual]`.
//!
//! ```toml
//! [individual]
//! # the crown in pictures: degrees around the tree, side of a cell and left edge over the height,
//! # rows of cells from the top down to the ground (0: nothing, 9: dense)
//! crown = [
//!   [0.0, 0.25, -0.5, [
//!     "0250",
//!     "2994",
//!     "0391",
//!     "0000",
//!   ]],
//! ]
//! # the trunk in the first picture: to the right, and up
//! trunk = [[0.0, 0.0], [0.02, 0.25]]
//! # seed of the draws by which the crown fills them
//! crown_seed = 3
//! # stem, seed of its draws, azimuth and pitch in degrees, factor of its length
//! stems = [
//!   ["0/12", 7, 12.5, -3.1, 1.04],
//!   ["0/13", 0, -8.0, 0.0, 1.0],
//! ]
//! ```

use super::{crown, stems};
use crate::param::{Problem, nearest};
use crate::species::doc::{SpeciesDoc, Value};
use crate::species::error::Issue;
use crate::species::key::{Form, Key};
use pleach_plant::{Hull, Individual};

/// The keys of the table.
pub(crate) const KEYS: [Key; 4] = [
    Key {
        name: "crown",
        form: Form::Pictures,
        default: "none",
        doc: "what the crown fills, in pictures: degrees around the tree, side of a cell, left edge, cells from the top",
    },
    Key {
        name: "trunk",
        form: Form::Course,
        default: "none",
        doc: "where the first of these pictures shows the trunk: to the right, and up",
    },
    Key {
        name: "crown_seed",
        form: Form::Seed,
        default: "0",
        doc: "seed of the draws by which the crown fills them, below 2^32; 0: the tree's own",
    },
    Key {
        name: "stems",
        form: Form::Stems,
        default: "none",
        doc: "stems with other draws: where each is from the trunk up, their seed, degrees about and away, factor of length",
    },
];

/// The table of `individual`; empty where it is the tree of its seed.
pub(super) fn to_toml(individual: &Individual) -> String {
    if individual.is_empty() {
        return String::new();
    }
    let mut text = "\n[individual]\n".to_owned();
    if let Some(hull) = individual.hull() {
        text += &crown::to_toml(hull);
    }
    text + &stems::to_toml(individual)
}

/// The individual of `doc`, empty where it has none; what is wrong joins `issues`.
pub(crate) fn read(doc: &SpeciesDoc, issues: &mut Vec<Issue>) -> Individual {
    let Some(node) = doc.get("individual") else { return Individual::default() };
    let Value::Table(entries) = &node.value else {
        issues.push(doc.wrong_type("individual", node, "a table", &node.value));
        return Individual::default();
    };
    let mut hull = Hull::default();
    let mut rows = None;
    for entry in entries {
        let name = format!("individual.{}", entry.key);
        let found = match entry.key.as_str() {
            "crown" => crown::views(doc, &name, &entry.node).map(|views| hull.views = views),
            "trunk" => crown::trunk(doc, &name, &entry.node).map(|trunk| hull.trunk = trunk),
            "crown_seed" => doc.small_seed(&name, &entry.node).map(|seed| hull.seed = seed),
            "stems" => {
                rows = Some((name, entry));
                Ok(())
            }
            key => {
                let nearest = nearest(key, KEYS.iter().map(|key| key.name));
                Err(doc.issue(entry.span.clone(), &name, Problem::UnknownName { nearest }))
            }
        };
        issues.extend(found.err());
    }
    let mut individual = match hull.views[..] {
        [] if hull == Hull::default() => Individual::default(),
        [] => {
            let message = "has no crown, and trunk and crown_seed are nothing without one".to_owned();
            issues.push(doc.issue(node.span.clone(), "individual", Problem::Conflict { message }));
            Individual::default()
        }
        _ => Individual::with_hull(hull),
    };
    if let Some((name, entry)) = rows {
        stems::read(doc, (&name, entry), &mut individual, issues);
    }
    individual
}
