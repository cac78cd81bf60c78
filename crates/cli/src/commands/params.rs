//! `pleach params`: the declared parameters, and the other keys of species files.

use crate::output;
use anyhow::{Context, bail};
use pleach_tree::param::{Declared, Shape, nearest};
use pleach_tree::species::{self, Form, Key};
use pleach_tree::{Kind, Param, ParamSpace, Slot};
use serde_json::json;

const EXAMPLES: &str = "Examples:
  pleach params                 every parameter by groups, and the other keys
  pleach params down_angle_v    one parameter in full
  pleach params 'length[1]'     one of its numbers
  pleach params crown           a group of parameters
  pleach params level:2         what all parameters say of a level
  pleach params appearance      a table of species files
  pleach params --json          for programs

`pleach fit --free` and `--fix` take the same names, groups and levels.";

/// List what species files may say: parameters by groups, and other keys
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Params {
    /// A parameter, one number of it such as length[1], a group, level:0 to level:3, or another key of species files
    name: Option<String>,
    /// The generator whose parameters to list
    #[arg(long, value_name = "NAME", default_value = "weber-penn")]
    generator: String,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

/// A key of species files beside the parameters, and the table that it stands in.
#[derive(Clone, Copy)]
struct FileKey {
    table: Option<&'static str>,
    key: Key,
}

impl FileKey {
    fn path(&self) -> String {
        self.table.map_or_else(|| self.key.name.to_owned(), |table| format!("{table}.{}", self.key.name))
    }
}

/// The keys of all species files, then the generator's own; those of a table follow it.
fn file_keys(own: &[Key]) -> Vec<FileKey> {
    let mut all = Vec::new();
    for key in species::KEYS.iter().chain(own) {
        all.push(FileKey { table: None, key: *key });
        if let Form::Table(inside) = key.form {
            all.extend(inside.iter().map(|inner| FileKey { table: Some(key.name), key: *inner }));
        }
    }
    all
}

impl Params {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let family = pleach_generators::family(&self.generator)?;
        let first = pleach_generators::presets(family).into_iter().next();
        let species = first.context("a generator has species that are built in")?;
        let space = species.generator.space();
        let keys = file_keys(family.keys());
        match &self.name {
            Some(name) => self.one(name, space, &keys),
            None if self.json => {
                let params = (0..space.params().len()).map(|param| as_json(&space.declared(param)));
                let all: Vec<_> = params.chain(keys.iter().map(|key| Ok(key_as_json(key)))).collect();
                output::json(&all.into_iter().collect::<anyhow::Result<Vec<_>>>()?)
            }
            None => output::line(everything(space, &keys)),
        }
    }

    /// What `name` names: a parameter or a key in full, else a group, a level or one number.
    fn one(&self, name: &str, space: &ParamSpace, keys: &[FileKey]) -> anyhow::Result<()> {
        if let Some((number, param)) = space.find(name) {
            if self.json {
                return output::json(&as_json(&space.declared(number))?);
            }
            let mut text = in_full(param);
            if space.of_group(name).next().is_some() {
                text.push_str(&format!("\n\nThe group of that name:\n{}", group(space, name)));
            }
            return output::line(text);
        }
        if let Some(key) = keys.iter().find(|key| key.path() == name) {
            let inside: Vec<&FileKey> = keys.iter().filter(|inner| inner.table == Some(name)).collect();
            if self.json {
                let mut value = key_as_json(key);
                value["keys"] = inside.into_iter().map(key_as_json).collect();
                return output::json(&value);
            }
            return output::line(key_in_full(key, &inside));
        }
        match space.select(name) {
            Ok(slots) => self.slots(name, space, &slots),
            Err(problem) => {
                let paths: Vec<String> = keys.iter().map(FileKey::path).collect();
                let tables = nearest(name, paths.iter().map(String::as_str));
                // A parameter is meant more often than a key, so a key is named where no parameter is near.
                match (&problem, tables) {
                    (pleach_tree::param::Problem::UnknownPattern { nearest: None, .. }, Some(key)) => {
                        bail!("`{name}` is not a known name, did you mean `{key}`?")
                    }
                    _ => bail!("`{name}` {problem}"),
                }
            }
        }
    }

    /// Some numbers of some parameters: a group, a level, or one number.
    fn slots(&self, name: &str, space: &ParamSpace, slots: &[Slot]) -> anyhow::Result<()> {
        let is_group = space.of_group(name).next().is_some();
        if self.json {
            let list: Vec<_> = if is_group {
                let params = (0..space.params().len()).filter(|&param| space.params()[param].group == name);
                params.map(|param| as_json(&space.declared(param))).collect::<anyhow::Result<_>>()?
            } else {
                let numbers = slots.iter().map(|&slot| as_json(&space.declared_number(slot)));
                numbers.collect::<anyhow::Result<_>>()?
            };
            return if let ([only], false) = (list.as_slice(), is_group) {
                output::json(only)
            } else {
                output::json(&list)
            };
        }
        if is_group {
            return output::line(group(space, name));
        }
        if let [only] = slots {
            return output::line(slot_in_full(space, *only));
        }
        let rows = slots.iter().map(|&slot| slot_row(space, slot));
        output::line(output::table(&heading(&SLOT_HEADING).into_iter().chain(rows).collect::<Vec<_>>(), &[]))
    }
}

const HEADING: [&str; 6] = ["parameter", "kind", "range", "unit", "default", "meaning"];
const SLOT_HEADING: [&str; 6] = ["number", "kind", "range", "default", "searched", "meaning"];
const KEY_HEADING: [&str; 4] = ["key", "kind", "default", "meaning"];

fn heading(words: &[&str]) -> Vec<Vec<String>> {
    vec![words.iter().map(|&word| word.to_owned()).collect()]
}

/// All parameters under the names of their groups, then the other keys.
fn everything(space: &ParamSpace, keys: &[FileKey]) -> String {
    let mut rows = heading(&HEADING);
    let mut groups = Vec::new();
    for name in space.groups() {
        for param in space.of_group(name) {
            rows.push(row(param));
            groups.push(name);
        }
    }
    // One table, so that the columns of all groups stand below each other.
    let table = output::table(&rows, &[]);
    let mut lines = table.lines();
    let mut text = lines.next().unwrap_or_default().to_owned();
    let mut last = "";
    for (line, group) in lines.zip(groups) {
        if group != last {
            text.push_str(&format!("\n\n{group}"));
            last = group;
        }
        text.push_str(&format!("\n{line}"));
    }
    text.push_str("\n\nother keys of species files\n");
    text.push_str(&key_table(&keys.iter().collect::<Vec<_>>()));
    text
}

fn group(space: &ParamSpace, name: &str) -> String {
    let rows = heading(&HEADING).into_iter().chain(space.of_group(name).map(row));
    output::table(&rows.collect::<Vec<_>>(), &[])
}

fn key_table(keys: &[&FileKey]) -> String {
    let row = |key: &&FileKey| {
        [&key.path(), key.key.form.word(), key.key.default, key.key.doc].map(str::to_owned).to_vec()
    };
    output::table(&heading(&KEY_HEADING).into_iter().chain(keys.iter().map(row)).collect::<Vec<_>>(), &[])
}

fn row(param: &Param) -> Vec<String> {
    vec![
        format!("{}{}", param.name, layout(param)),
        param.kind.word().to_owned(),
        range(param),
        param.unit.to_string(),
        numbers(&param.default),
        param.doc.to_string(),
    ]
}

fn slot_row(space: &ParamSpace, slot: Slot) -> Vec<String> {
    let (param, (low, high)) = (space.param_of(slot), space.search_range(slot));
    vec![
        space.slot_name(slot),
        param.kind.word().to_owned(),
        range(param),
        space.default_of(slot).to_string(),
        format!("{low}..{high}"),
        param.doc.to_string(),
    ]
}

fn layout(param: &Param) -> String {
    match param.shape {
        Shape::Scalar => String::new(),
        Shape::List { len, .. } => format!("[{len}]"),
        Shape::Vector => "[x, y, z]".to_owned(),
    }
}

fn range(param: &Param) -> String {
    let (min, max) = param.kind.range();
    format!("{min}..{max}")
}

fn numbers(values: &[f64]) -> String {
    let all: Vec<String> = values.iter().map(f64::to_string).collect();
    if all.len() == 1 { all[0].clone() } else { format!("[{}]", all.join(", ")) }
}

fn in_full(param: &Param) -> String {
    let search: Vec<String> = param.search.iter().map(|(low, high)| format!("{low}..{high}")).collect();
    let title = format!("{}{}", param.name, layout(param));
    described(param, &title, numbers(&param.default), &search.join(", "))
}

fn slot_in_full(space: &ParamSpace, slot: Slot) -> String {
    let (param, (low, high)) = (space.param_of(slot), space.search_range(slot));
    let default = space.default_of(slot).to_string();
    described(param, &space.slot_name(slot), default, &format!("{low}..{high}"))
}

fn described(param: &Param, title: &str, default: String, searched: &str) -> String {
    let mut lines = vec![format!("{title}: {}", param.doc)];
    let mut add = |name: &str, value: String| lines.push(format!("  {name:<10}{value}"));
    add("kind", param.kind.word().to_owned());
    add("range", range(param));
    add("unit", param.unit.to_string());
    add("default", default);
    add("group", param.group.to_string());
    match &param.kind {
        Kind::Choice { first, names } => {
            let names: Vec<String> = names.iter().zip(*first..).map(|(n, i)| format!("{i} {n}")).collect();
            add("choices", names.join(", "));
        }
        Kind::Flagged { negative, .. } | Kind::FlaggedInteger { negative, .. } => {
            add("negative", negative.to_string());
        }
        _ => {}
    }
    let only = if param.opt_in { ", where the start has another value, or by name" } else { "" };
    add("searched", format!("{searched}{only}"));
    add("source", param.source.to_string());
    lines.join("\n")
}

fn key_in_full(key: &FileKey, inside: &[&FileKey]) -> String {
    let Key { form, default, doc, .. } = key.key;
    let mut lines = vec![format!("{}: {doc}", key.path())];
    let mut add = |name: &str, value: &str| lines.push(format!("  {name:<10}{value}"));
    add("kind", form.word());
    match form {
        Form::Shapes(shapes) => {
            for shape in shapes {
                let keys = shape.keys.iter().map(|key| format!("{} = {}", key.name, key.form.example()));
                let keys: Vec<String> =
                    std::iter::once(format!("shape = \"{}\"", shape.name)).chain(keys).collect();
                add("one of", &format!("{{ {} }}", keys.join(", ")));
            }
        }
        Form::Table(_) => {}
        form => add("written", &form.example()),
    }
    add("default", default);
    let mut text = lines.join("\n");
    if !inside.is_empty() {
        text.push_str(&format!("\n\n{}", key_table(inside)));
    }
    text
}

/// What is declared, marked as a parameter among the other keys of species files.
fn as_json(declared: &Declared<'_>) -> anyhow::Result<serde_json::Value> {
    let mut value = serde_json::to_value(declared)?;
    value["parameter"] = json!(true);
    Ok(value)
}

/// A key with everything that a parameter has, null where it has no such thing.
fn key_as_json(key: &FileKey) -> serde_json::Value {
    let Key { form, default, doc, .. } = key.key;
    let (min, max) = form.range().unzip();
    let choices = if let Form::Choice(names) = form { Some(names) } else { None };
    let shapes = if let Form::Shapes(shapes) = form { Some(shapes) } else { None };
    let shapes = shapes.map(|shapes| {
        let keys = |shape: &species::Shape| -> serde_json::Map<_, _> {
            shape.keys.iter().map(|key| (key.name.to_owned(), json!(key.form.example()))).collect()
        };
        let shapes = shapes.iter().map(|shape| (shape.name.to_owned(), json!(keys(shape))));
        shapes.collect::<serde_json::Map<_, _>>()
    });
    json!({
        "name": key.path(), "values": 1, "kind": form.word(), "min": min, "max": max, "unit": null,
        "default": Some(default).filter(|default| *default != "none"), "search": null, "group": null, "first": null,
        "choices": choices, "negative": null, "neutral": null, "opt_in": null, "breakpoints": null, "doc": doc, "source": null,
        "slots": null, "parameter": false, "table": key.table, "written": form.example(), "shapes": shapes,
    })
}
