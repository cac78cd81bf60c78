//! `pleach params`: the declared parameters.

use crate::output;
use anyhow::bail;
use pleach_tree::param::nearest;
use pleach_tree::{Kind, Layout, Param};
use serde_json::json;

const EXAMPLES: &str = "Examples:
  pleach params                 every parameter in a table
  pleach params down_angle_v    one parameter in full
  pleach params --json          for programs";

/// List the parameters of species files: kind, range, default and meaning
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Params {
    /// One parameter, to be told in full
    name: Option<String>,
    /// The generator whose parameters to list
    #[arg(long, value_name = "NAME", default_value = "weber-penn")]
    generator: String,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl Params {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let family = pleach_generators::families().iter().find(|f| f.name() == self.generator);
        let Some(species) =
            family.and_then(|f| f.presets().first()).and_then(|(name, _)| pleach_generators::preset(name))
        else {
            let known: Vec<&str> = pleach_generators::families().iter().map(|f| f.name()).collect();
            bail!("unknown generator `{}`, known are {}", self.generator, known.join(", "));
        };
        let params = species.generator.space().params();
        if let Some(name) = &self.name {
            let Some(param) = params.iter().find(|p| p.name == *name) else {
                let hint = nearest(name, params.iter().map(|p| p.name.as_ref()));
                bail!(
                    "unknown parameter `{name}`{}",
                    hint.map_or_else(String::new, |n| format!(", did you mean `{n}`?"))
                );
            };
            return if self.json { output::json(&as_json(param)) } else { output::line(in_full(param)) };
        }
        if self.json {
            return output::json(&params.iter().map(as_json).collect::<Vec<_>>());
        }
        let heading = ["parameter", "kind", "range", "unit", "default", "meaning"];
        let mut rows = vec![heading.map(str::to_owned).to_vec()];
        for param in params {
            rows.push(vec![
                format!("{}{}", param.name, layout(param)),
                param.kind.word().to_owned(),
                range(param),
                param.unit.to_string(),
                numbers(&param.default),
                param.doc.to_string(),
            ]);
        }
        output::line(output::table(&rows, &[]))
    }
}

const fn layout(param: &Param) -> &'static str {
    match param.layout {
        Layout::Scalar => "",
        Layout::PerLevel => "[4]",
        Layout::Vector => "[x, y, z]",
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
    let mut lines = vec![format!("{}{}: {}", param.name, layout(param), param.doc)];
    let mut add = |name: &str, value: String| lines.push(format!("  {name:<10}{value}"));
    add("kind", param.kind.word().to_owned());
    add("range", range(param));
    add("unit", param.unit.to_string());
    add("default", numbers(&param.default));
    add("group", param.group.to_owned());
    match param.kind {
        Kind::Choice { first, names } => {
            let names: Vec<String> = names.iter().zip(first..).map(|(n, i)| format!("{i} {n}")).collect();
            add("choices", names.join(", "));
        }
        Kind::Flagged { negative, .. } | Kind::FlaggedInteger { negative, .. } => {
            add("negative", negative.to_owned());
        }
        _ => {}
    }
    let search: Vec<String> = param.search.iter().map(|(low, high)| format!("{low}..{high}")).collect();
    add("searched", search.join(", "));
    add("source", param.source.to_owned());
    lines.join("\n")
}

fn as_json(param: &Param) -> serde_json::Value {
    let (min, max) = param.kind.range();
    let (choices, negative) = match param.kind {
        Kind::Choice { names, .. } => (Some(names), None),
        Kind::Flagged { negative, .. } | Kind::FlaggedInteger { negative, .. } => (None, Some(negative)),
        _ => (None, None),
    };
    json!({
        "name": param.name, "values": param.layout.len(), "kind": param.kind.word(), "min": min, "max": max,
        "unit": param.unit.to_string(), "default": param.default, "search": param.search, "group": param.group,
        "choices": choices, "negative": negative, "doc": param.doc, "source": param.source,
    })
}
