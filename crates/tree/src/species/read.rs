//! From a parsed file to a species: what is the same for every family.

use super::Species;
use super::appearance;
use super::doc::{Node, SpeciesDoc, Value};
use super::error::{Issue, SpeciesError};
use super::family::Family;
use super::individual;
use super::key::{Form, Key, MAX_SEED};
use super::keys::KEYS;
use super::name::check_name;
use crate::param::{Kind, ParamSpace, Problem, Shape, Slot, is_hidden, nearest};
use pleach_plant::Foliage;

/// Names that are wrong at the top level of every file, and what would be right.
const MISPLACED: [(&str, &str); 2] =
    [("seed", "the seed of the tree is `tree_seed`"), ("species", "the species is called by `name`")];

impl SpeciesDoc {
    /// The species that the file describes: its generator as `family` reads it, its numbers, and what
    /// every file may say ([`KEYS`]).
    ///
    /// # Errors
    /// Every problem found, with line and column.
    pub fn species(&self, family: &dyn Family) -> Result<Species, SpeciesError> {
        let mut issues = Vec::new();
        let generator = family.read(self, &mut issues);
        let values = generator.as_ref().map(|generator| {
            let (values, wrong) = self.numbers(generator.space(), family);
            issues.extend(wrong);
            values
        });
        let name = kept(self.said_name(), &mut issues).flatten();
        let description = kept(self.said_description(), &mut issues).flatten();
        let tree_seed = kept(self.said_tree_seed(), &mut issues).flatten();
        let is_bare = kept(self.said_bare(), &mut issues).flatten().unwrap_or(false);
        let foliage = if is_bare { Foliage::None } else { Foliage::All };
        let appearance = appearance::read(self, &mut issues);
        let individual = individual::read(self, &mut issues);
        if let (Some(node), None) = (self.get("individual"), tree_seed) {
            let message =
                "is one tree of a species and says not which, expected `tree_seed` beside it".to_owned();
            issues.push(self.issue(node.span.clone(), "individual", Problem::Conflict { message }));
        }
        // Values that were wrong have left their defaults behind, so checking finds nothing new.
        if let (Some(generator), Some(values), true) = (generator, values, issues.is_empty())
            && let Ok(params) = generator.space().check(values)
        {
            let text = |said: Option<&str>| said.unwrap_or_default().to_owned();
            let (name, description) = (text(name), text(description));
            let kind = Species { name, description, generator, params, tree_seed, foliage, appearance };
            let Some(seed) = tree_seed.filter(|_| !individual.is_empty()) else { return Ok(kind) };
            let (generator, values) = (&kind.generator, kind.params.values());
            let lacks_hull = individual.hull().is_some() && generator.hull_height(values).is_none();
            let family = generator.family();
            let message = if lacks_hull {
                format!("has a crown to fill, which trees of {family} do not")
            } else if generator.spreads(values).is_empty() {
                format!("needs stems with addresses, which trees of {family} have not")
            } else {
                return Ok(kind.with_individual(seed, individual));
            };
            let span = self.get("individual").map_or(0..0, |node| node.span.clone());
            issues.push(self.issue(span, "individual", Problem::Conflict { message }));
        }
        issues.sort_by_key(|issue| (issue.line, issue.column));
        Err(self.wrong(issues))
    }

    /// The name of the species, if the file says one.
    ///
    /// # Errors
    /// If it is not a string, or cannot be a name: see [`check_name`].
    fn said_name(&self) -> Result<Option<&str>, Issue> {
        let Some(node) = self.get("name") else { return Ok(None) };
        let name = self.text_of("name", node)?;
        check_name(name).map_err(|error| {
            self.issue(node.span.clone(), "name", Problem::Conflict { message: error.to_string() })
        })?;
        Ok(Some(name))
    }

    /// The description of the species, if the file has one; it may have several lines.
    ///
    /// # Errors
    /// If it is not a string, or has control characters.
    fn said_description(&self) -> Result<Option<&str>, Issue> {
        let Some(node) = self.get("description") else { return Ok(None) };
        let text = self.text_of("description", node)?;
        match text.chars().find(|&c| is_hidden(c) && c != '\n') {
            None => Ok(Some(text)),
            Some(c) => {
                let message = format!("contains the character {}, expected plain text", c.escape_unicode());
                Err(self.issue(node.span.clone(), "description", Problem::Conflict { message }))
            }
        }
    }

    /// The seed under `tree_seed`, if it is there.
    ///
    /// # Errors
    /// If it is there and no whole number from 0 on.
    fn said_tree_seed(&self) -> Result<Option<u64>, Issue> {
        let Some(node) = self.get("tree_seed") else { return Ok(None) };
        let seed = self.number_of("tree_seed", node)?;
        let max = MAX_SEED as f64;
        if (0.0..=max).contains(&seed) && seed.fract() == 0.0 {
            Ok(Some(seed as u64))
        } else {
            Err(self.issue(
                node.span.clone(),
                "tree_seed",
                Problem::OutOfRange { value: seed, min: 0.0, max },
            ))
        }
    }

    /// What stands under `bare`, if it is there.
    ///
    /// # Errors
    /// If it is there and neither `true` nor `false`.
    fn said_bare(&self) -> Result<Option<bool>, Issue> {
        let Some(node) = self.get("bare") else { return Ok(None) };
        match &node.value {
            Value::Switch(bare) => Ok(Some(*bare)),
            other => Err(self.wrong_type("bare", node, "true or false", other)),
        }
    }

    /// Reads every parameter of `space`, beside the keys of `family`.
    ///
    /// Returns one value for each slot (the default where the file is silent or wrong) and every
    /// issue: unknown names, wrong types and lengths, values that are not allowed.
    pub(super) fn numbers(&self, space: &ParamSpace, family: &dyn Family) -> (Vec<f64>, Vec<Issue>) {
        let mut values = space.defaults();
        let mut issues = Vec::new();
        for entry in self.entries() {
            let key = entry.key.as_str();
            let keys = || KEYS.iter().chain(family.keys());
            if keys().any(|known| known.name == key) {
                continue;
            }
            let Some((number, param)) = space.find(key) else {
                let known = space.params().iter().map(|p| p.name.as_ref());
                let problem = match MISPLACED.iter().chain(family.misplaced()).find(|(name, _)| *name == key)
                {
                    Some((_, right)) => Problem::Misplaced { right },
                    None => Problem::UnknownName {
                        nearest: inside_a_table(key, keys())
                            .or_else(|| nearest(key, known.chain(keys().map(|known| known.name)))),
                    },
                };
                issues.push(self.issue(entry.span.clone(), key, problem));
                continue;
            };
            let nodes: &[Node] = match &entry.node.value {
                Value::List(list) => list,
                _ => std::slice::from_ref(&entry.node),
            };
            let slots = space.slots_of(number);
            let is_list = matches!(entry.node.value, Value::List(_));
            let wants_list = param.shape != Shape::Scalar;
            if nodes.len() != slots.len() || is_list != wants_list {
                let problem = if nodes.len() != slots.len() {
                    Problem::WrongLength { expected: slots.len(), found: nodes.len() }
                } else {
                    let expected = if wants_list { "an array of numbers" } else { "a single number" };
                    Problem::WrongType { expected, found: entry.node.value.type_name() }
                };
                issues.push(self.issue(entry.node.span.clone(), key, problem));
                continue;
            }
            for (slot, node) in slots.zip(nodes) {
                match self.slot_value(space, slot, node) {
                    Ok(value) => values[slot.index()] = value,
                    Err(issue) => issues.push(issue),
                }
            }
        }
        (values, issues)
    }

    fn slot_value(&self, space: &ParamSpace, slot: Slot, node: &Node) -> Result<f64, Issue> {
        let name = space.slot_name(slot);
        let value = match (&node.value, space.kind_of(slot)) {
            (Value::Text(text), Kind::Choice { first, names }) => {
                names.iter().position(|n| n == text).map(|i| (*first + i as i64) as f64).ok_or_else(|| {
                    let problem = Problem::UnknownChoice {
                        value: text.clone(),
                        known: names.iter().map(|n| n.to_string()).collect(),
                        nearest: nearest(text, names.iter().map(AsRef::as_ref)),
                    };
                    self.issue(node.span.clone(), &name, problem)
                })?
            }
            _ => self.number_of(&name, node)?,
        };
        space.check_slot(slot, value).map_err(|problem| self.issue(node.span.clone(), &name, problem))?;
        Ok(value)
    }
}

/// What was read; if there is an issue instead, that joins `issues`.
fn kept<T>(read: Result<T, Issue>, issues: &mut Vec<Issue>) -> Option<T> {
    read.map_err(|issue| issues.push(issue)).ok()
}

/// `table.key`, where `key` stands outside the table that it belongs to.
fn inside_a_table<'a>(key: &str, mut keys: impl Iterator<Item = &'a Key>) -> Option<String> {
    keys.find_map(|table| match table.form {
        Form::Table(inside) if inside.iter().any(|inner| inner.name == key) => {
            Some(format!("{}.{key}", table.name))
        }
        _ => None,
    })
}
