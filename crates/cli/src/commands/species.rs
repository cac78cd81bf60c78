//! `pleach species`: the known species, or one of them as a file.

use crate::{input, output};
use anyhow::bail;
use pleach_tree::species::{Form, Key, appearance_keys};
use pleach_tree::{Foliage, Species};
use serde_json::json;

const EXAMPLES: &str = "Examples:
  pleach species                                 those that come with pleach
  pleach species quaking_aspen > my_aspen.toml   a copy to change";

/// List the known species, or print one as a species file
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct SpeciesCommand {
    /// A species, by name or file, to print as a file with every parameter
    name: Option<String>,
    /// Write this seed into the printed file, for one particular tree
    #[arg(long, value_name = "N", requires = "name", value_parser = input::seed)]
    seed: Option<u64>,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

impl SpeciesCommand {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        if let Some(name) = &self.name {
            let mut species = input::species(name)?;
            species.tree_seed = self.seed.or(species.tree_seed);
            let generator = species.generator.family();
            if pleach_generators::family(generator).is_err() {
                bail!(
                    "{name} is one tree and has no species file: its generator, `{generator}`, has no numbers"
                );
            }
            return if self.json {
                output::json(&all_values(&species))
            } else {
                output::data(species.to_toml(&[]).trim_end())
            };
        }
        let known: Vec<Species> =
            pleach_generators::names().iter().filter_map(|name| pleach_generators::preset(name)).collect();
        if self.json {
            let list: Vec<_> = known
                .iter()
                .map(|s| json!({"species": s.name, "generator": s.generator.family(), "description": s.description}))
                .collect();
            return output::json(&list);
        }
        let mut rows = vec![vec!["species".to_owned(), "generator".to_owned(), "description".to_owned()]];
        rows.extend(known.into_iter().map(|s| vec![s.name, s.generator.family().to_owned(), s.description]));
        output::line(output::table(&rows, &[]))
    }
}

fn look((key, value): (Key, String)) -> (String, serde_json::Value) {
    let value = if key.form == Form::Switch { json!(value == "true") } else { json!(value) };
    (key.name.to_owned(), value)
}

fn all_values(species: &Species) -> serde_json::Value {
    let space = species.generator.space();
    let values: serde_json::Map<_, _> = space
        .params()
        .iter()
        .enumerate()
        .map(|(i, param)| {
            let values = species.params.list(i);
            (param.name.to_string(), if values.len() == 1 { json!(values[0]) } else { json!(values) })
        })
        .collect();
    let looks: serde_json::Map<_, _> = appearance_keys(&species.appearance).into_iter().map(look).collect();
    json!({
        "species": species.name, "generator": species.generator.family(), "parameters": values,
        "description": species.description, "tree_seed": species.tree_seed, "bare": species.foliage == Foliage::None, "appearance": looks,
    })
}
