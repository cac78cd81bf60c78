//! `pleach sample`: trees around a species, as nature would vary them.

use super::sheet::{render, sheet};
use crate::{files, input, output};
use anyhow::{bail, ensure};
use pleach_fit::{Freedom, Prior};
use pleach_render::{Picture, png_file};
use pleach_tree::Species;
use rayon::prelude::*;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  pleach sample quaking_aspen -o aspens              16 of them
  pleach sample english_oak --count 500 --spread 0.3 -o oaks
  pleach sample palm --free crown -o palms           only these numbers vary

Each free number is normal around that of the species, with a standard deviation of --spread of its plausible range \
(`pleach params` has it), cut off at the ends of that range. Features that the species does not have stay absent. A \
tree that is too large to be looked at, or whose form is far from that of the species, is drawn again: it has a quarter \
to four times as many branches and as much leaf area, and half to twice the width for its height. `pleach fit \
--posterior` learns from the same trees.";

/// Pixels a side of each tree on the sheet, and trees on it.
const SIZE: u32 = 256;
const SHOWN: usize = 16;

/// Draw trees around a species: species files, a table of their numbers and a picture
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Sample {
    /// A species, by name or file
    species: String,
    /// How many trees
    #[arg(short = 'n', long, value_name = "N", default_value_t = 16,
          value_parser = clap::value_parser!(u32).range(1..=100_000))]
    count: u32,
    /// Standard deviation of each number, as a part of its plausible range, from 0 to 10
    #[arg(long, value_name = "PART", default_value_t = Prior::SPREAD, value_parser = input::spread)]
    spread: f64,
    /// Patterns of the numbers that vary, as in `pleach fit`; all by default
    #[arg(long, value_name = "PATTERN")]
    free: Vec<String>,
    /// Patterns of the numbers that stay
    #[arg(long, value_name = "PATTERN")]
    fix: Vec<String>,
    /// Seed of the numbers
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = input::seed)]
    seed: u64,
    /// The folder for 1.toml and so on, samples.csv and samples.png
    #[arg(short, long, value_name = "DIR")]
    out: PathBuf,
}

impl Sample {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let species = input::species(&self.species)?.kind();
        let freedom = Freedom { free: self.free.clone(), fix: self.fix.clone() };
        let prior = Prior::new(&species, &freedom, self.spread)?;
        ensure!(prior.genes().next().is_some(), "no number of {} varies", species.name);
        files::make_folder(&self.out)?;
        let space = species.params.space();
        let names = space.slots().map(|slot| space.slot_name(slot));
        let mut rows = vec![["file", "tree_seed"].map(str::to_owned).into_iter().chain(names).collect()];
        let mut shown: Vec<Option<Picture>> = Vec::new();
        let mut missing = 0;
        let numbers: Vec<u32> = (0..self.count).collect();
        for some in numbers.chunks(SHOWN) {
            let is_first = shown.is_empty();
            let grown: Vec<(Option<Species>, Option<Picture>)> = some
                .par_iter()
                .map(|&number| match prior.sample(self.seed, number) {
                    Some((one, tree)) => {
                        let picture = is_first.then(|| render(&tree, &one, SIZE));
                        (Some(one), picture)
                    }
                    None => (None, None),
                })
                .collect();
            for (&number, (one, picture)) in some.iter().zip(grown) {
                if is_first {
                    shown.push(picture);
                }
                let Some(one) = one else {
                    missing += 1;
                    continue;
                };
                let name = format!("{}.toml", number + 1);
                let comment = format!("Number {} of the trees around {}.", number + 1, species.name);
                files::write_text(&self.out.join(&name), &one.to_toml(&[comment]))?;
                let seed = one.tree_seed.unwrap_or_default().to_string();
                let values = one.params.values().iter().map(f64::to_string);
                rows.push([name, seed].into_iter().chain(values).collect());
            }
        }
        if rows.len() == 1 {
            bail!("no tree around {} is small enough to be drawn: choose a smaller --spread", species.name);
        }
        if missing > 0 {
            output::warning(format!(
                "{missing} of {} trees were too large whatever was drawn, and are left out",
                self.count
            ));
        }
        files::write_whole(&self.out.join("samples.csv"), |file| {
            let mut csv = csv::Writer::from_writer(file);
            rows.iter().try_for_each(|row: &Vec<String>| csv.write_record(row))?;
            Ok(csv.flush()?)
        })?;
        let picture = self.out.join("samples.png");
        files::write_whole(&picture, |file| Ok(png_file::write(file, &[sheet(&shown, SIZE)], 0)?))?;
        output::wrote(&picture);
        Ok(())
    }
}
