//! `pleach dataset`: training data for machine learning.

use crate::choice::{Choice, one_of};
use crate::{input, output};
use anyhow::anyhow;
use pleach_console::interrupted::Interrupted;
use pleach_console::{progress, signals, text};
use pleach_dataset::{Control, DatasetError, DatasetOptions, Format, Layer, Mode};
use pleach_fit::{Freedom, Prior};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

const EXAMPLES: &str = "Examples:
  pleach dataset quaking_aspen -o aspens                1000 trees, two views of each
  pleach dataset quaking_aspen palm -n 5000 --view 0,45,90 --size 128 -o trees
  pleach dataset english_oak --with wood,depth,skeleton -o oaks
  pleach dataset palm --format webdataset -o palms      tar files for WebDataset
  pleach dataset palm --free crown --spread 0.3 -o crowns
  pleach dataset quaking_aspen -o aspens --resume       goes on after an interruption

The trees are those of `pleach sample` with the same --spread, --free, --fix and --seed, numbered from 0; with several \
species they take turns. manifest.json says what is in the shards, and failures.csv which draws gave no tree and why. \
The same arguments give the same bytes, on any number of threads, interrupted or not. `docs/inference.md` shows how to \
load them.";

const FORMATS: &[Choice<Format>] = &[
    ("npz", "NumPy arrays, stacked over the trees of a shard", Format::Npz),
    ("webdataset", "tar files with a JSON file, pictures and arrays for each tree", Format::WebDataset),
];

const LAYERS: &[Choice<Layer>] = &[
    ("wood", "silhouettes of the stems alone", Layer::Wood),
    ("depth", "distances from the viewer in metres", Layer::Depth),
    ("skeleton", "positions and radii along all stems", Layer::Skeleton),
];

/// Write training data for machine learning: trees around species, with their numbers and pictures
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Dataset {
    /// Species, by name or file
    #[arg(required = true, value_name = "SPECIES")]
    species: Vec<String>,
    /// How many trees of each species
    #[arg(short = 'n', long, value_name = "N", default_value_t = DatasetOptions::default().count,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(DatasetOptions::MAX_COUNT)))]
    count: u32,
    /// Azimuths of the views in degrees, level; each is a picture of every tree
    #[arg(long, value_name = "DEGREES,...", value_delimiter = ',', default_value = "0,90",
          allow_hyphen_values = true, value_parser = azimuth)]
    view: Vec<f64>,
    /// Height and width of the pictures in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = DatasetOptions::default().size, value_parser = size())]
    size: u32,
    /// What is saved beside numbers and silhouettes
    #[arg(long, value_name = "LAYER,...", value_delimiter = ',', value_parser = one_of(LAYERS))]
    with: Vec<Layer>,
    /// Format of the shards
    #[arg(long, value_name = "FORMAT", default_value = "npz", value_parser = one_of(FORMATS))]
    format: Format,
    /// Trees of each shard; memory is in proportion to it
    #[arg(long, value_name = "N", default_value_t = DatasetOptions::default().shard,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(DatasetOptions::MAX_SHARD)))]
    shard: u32,
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
    /// The folder for the shards, manifest.json and failures.csv
    #[arg(short, long, value_name = "DIR")]
    out: PathBuf,
    /// Go on with the data set in the folder, which was asked for with the same arguments
    #[arg(long)]
    resume: bool,
    /// Replace the data set in the folder
    #[arg(long, conflicts_with = "resume")]
    overwrite: bool,
}

fn azimuth(text: &str) -> Result<f64, String> {
    let value = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| format!("`{text}` is not an azimuth in degrees, expected a list such as 0,90"))
}

fn size() -> clap::builder::RangedI64ValueParser<u32> {
    let sizes = i64::from(DatasetOptions::MIN_SIZE)..=i64::from(DatasetOptions::MAX_SIZE);
    clap::value_parser!(u32).range(sizes)
}

impl Dataset {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let species = self.species.iter().map(|name| input::species(name)).collect::<Result<Vec<_>, _>>()?;
        let options = DatasetOptions {
            count: self.count,
            views: self.view.clone(),
            size: self.size,
            layers: self.with.clone(),
            format: self.format,
            shard: self.shard,
            spread: self.spread,
            freedom: Freedom { free: self.free.clone(), fix: self.fix.clone() },
            seed: self.seed,
        };
        let mode = match (self.resume, self.overwrite) {
            (true, _) => Mode::Resume,
            (_, true) => Mode::Overwrite,
            _ => Mode::New,
        };
        let stop = Arc::new(AtomicBool::new(false));
        let raised = Arc::clone(&stop);
        signals::catch(move || raised.store(true, Ordering::Relaxed), || ())?;
        let bar = progress::bar("trees", u64::from(self.count) * species.len() as u64);
        let control = Control { stop: &stop, progress: &|progress| bar.set_position(progress.done) };
        let written = pleach_dataset::write(&species, &options, &self.out, mode, &control);
        bar.finish_and_clear();
        let written = written.map_err(in_flags)?;
        let out = text::path(&self.out);
        if written.failures > 0 {
            let (failed, draws) = (written.failures, written.trees + written.failures);
            output::warning(format!("{failed} of {draws} draws gave no tree: {out}/failures.csv says why"));
        }
        output::note(format!("wrote {out}: {} trees in {} shards", written.trees, written.shards));
        Ok(())
    }
}

/// An error of the library, with its options as they are typed.
fn in_flags(error: DatasetError) -> anyhow::Error {
    if let DatasetError::Interrupted { shards, all } = error {
        let how = "the same command with --resume goes on there";
        return Interrupted::new(format!("interrupted after {shards} of {all} shards; {how}")).into();
    }
    let mut message = error.to_string();
    for option in ["count", "view", "size", "shard", "spread", "seed", "resume", "overwrite"] {
        message = message.replace(&format!("`{option}`"), &format!("--{option}"));
    }
    anyhow!(message)
}
