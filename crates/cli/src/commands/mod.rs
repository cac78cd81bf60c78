//! One module per command: what was typed, and what it does.

mod advice;
mod bench;
mod blend;
mod collect;
mod completions;
mod corrections;
mod dataset;
mod describe;
mod experiment;
mod export;
mod fit;
mod format;
mod gallery;
mod grammar;
mod grow;
mod hints;
mod import;
mod landmarks;
mod man;
mod map;
mod mask;
mod params;
mod read;
mod render;
mod sample;
mod score;
mod sheet;
mod silhouette;
mod species;
mod studio;

use crate::{help, output};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

/// Finds the parameters of procedural trees that make them look like pictures.
#[derive(Debug, Parser)]
#[command(name = "pleach", version, max_term_width = 100, arg_required_else_help = true)]
pub(crate) struct Arguments {
    /// Threads to use; all cores by default. Results do not depend on it
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Write neither progress nor notes to standard error, only errors and warnings
    #[arg(short, long, global = true)]
    quiet: bool,

    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Fit(Box<fit::Fit>),
    Collect(collect::Collect),
    Grow(grow::Grow),
    Render(render::Render),
    Silhouette(silhouette::Silhouette),
    Score(score::Score),
    Map(map::Map),
    Mask(mask::MaskCommand),
    Read(read::Read),
    Blend(Box<blend::BlendCommand>),
    Import(import::Import),
    Sample(sample::Sample),
    Dataset(Box<dataset::Dataset>),
    Species(species::SpeciesCommand),
    Params(params::Params),
    Grammar(grammar::GrammarCommand),
    Studio(studio::Studio),
    Experiment(experiment::Experiment),
    Bench(Box<bench::Bench>),
    Completions(completions::Completions),
    Man(man::Man),
}

impl Arguments {
    /// The command line's arguments; where they are wrong, or help is asked for, the program ends.
    pub(crate) fn from_command_line() -> Self {
        let matches = Self::laid_out().get_matches();
        Self::from_arg_matches(&matches).unwrap_or_else(|error| error.exit())
    }

    /// The program's commands and options, their texts laid out.
    fn laid_out() -> clap::Command {
        help::with_negative_numbers(help::laid_out(Self::command()))
    }

    pub(crate) fn run(self) -> anyhow::Result<()> {
        if self.quiet {
            output::be_quiet();
        }
        if let Some(threads) = self.threads {
            rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build_global()?;
        }
        match self.command {
            Command::Fit(command) => command.run(),
            Command::Collect(command) => command.run(),
            Command::Grow(command) => command.run(),
            Command::Render(command) => command.run(),
            Command::Score(command) => command.run(),
            Command::Experiment(command) => command.run(),
            Command::Bench(command) => command.run(),
            Command::Silhouette(command) => command.run(),
            Command::Map(command) => command.run(),
            Command::Mask(command) => command.run(),
            Command::Read(command) => command.run(),
            Command::Blend(command) => command.run(),
            Command::Import(command) => command.run(),
            Command::Sample(command) => command.run(),
            Command::Dataset(command) => command.run(),
            Command::Species(command) => command.run(),
            Command::Params(command) => command.run(),
            Command::Grammar(command) => command.run(),
            Command::Studio(command) => command.run(),
            Command::Completions(command) => command.run(),
            Command::Man(command) => command.run(),
        }
    }
}

#[cfg(test)]
mod tests;
