//! `pleach import`: a species of another program as a species file.

use crate::{files, input, output};
use anyhow::Context;
use pleach_generators::Foreign;
use pleach_tree::Species;
use pleach_tree::species::check_name;
use std::fs::File;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  pleach import oak.xml -o oak.toml       a species of Arbaro
  pleach import white_birch.py            a preset of Sapling, to standard output
  pleach grow ash.json                    a species argument may be such a file

Read are presets of tree-gen and of Sapling Tree Gen (a dictionary of Python literals), species of Arbaro (XML) and \
trees of ez-tree (JSON). No file is run. ez-tree has a model of its own: the result is the nearest tree of Weber and \
Penn's model.

What has no counterpart is listed on standard error and in the head of the species file. What is switched off there is \
not listed.";

/// Translate a species of tree-gen, Sapling, Arbaro or ez-tree into a species file
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Import {
    /// The file; `-` is standard input
    file: PathBuf,
    /// The species file to write; `-`, the default, is standard output
    #[arg(short, long, value_name = "PATH")]
    out: Option<PathBuf>,
    /// Name of the species; its own, or that of the file, by default
    #[arg(long, value_name = "NAME", value_parser = name)]
    name: Option<String>,
}

fn name(text: &str) -> Result<String, String> {
    check_name(text).map(|()| text.to_owned()).map_err(|error| error.to_string())
}

impl Import {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let (mut species, foreign) = self.read()?;
        if let Some(name) = &self.name {
            species.name.clone_from(name);
        }
        let remarks = remarks(&foreign);
        let text = species.to_toml(&remarks);
        match self.out.as_deref().filter(|path| !files::is_stdout(path)) {
            Some(path) => {
                files::write_text(path, &text)?;
                output::wrote(path);
            }
            None => output::data(text.trim_end())?,
        }
        remarks.iter().for_each(output::note);
        Ok(())
    }

    fn read(&self) -> anyhow::Result<(Species, Foreign)> {
        if input::is_standard(&self.file) {
            return Ok(pleach_generators::import(std::io::stdin().lock(), "stdin")?);
        }
        let path = self.file.display();
        let file = File::open(&self.file).with_context(|| format!("cannot read {path}"))?;
        Ok(pleach_generators::import(file, &path.to_string())?)
    }
}

/// What is to be said of a translation, a paragraph each.
fn remarks(foreign: &Foreign) -> Vec<String> {
    let program = foreign.program.name();
    let mut remarks = vec![format!("Translated from a species of {program}.")];
    remarks.extend(foreign.notes.iter().map(|note| sentence(note)));
    if !foreign.without_counterpart.is_empty() {
        remarks.push(format!("Without a counterpart: {}.", foreign.without_counterpart.join(", ")));
    }
    remarks
}

/// `clause` with a capital letter and a full stop.
fn sentence(clause: &str) -> String {
    let mut chars = clause.chars();
    let first = chars.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", chars.as_str())
}
