//! `pleach grow`: one tree, or many seeds of a species.

use super::export::{self, MeshArgs};
use crate::input::LimitArgs;
use crate::{files, input, output, skeleton};
use anyhow::{Context, bail};
use indicatif::{ProgressBar, ProgressStyle};
use pleach_silhouette::{Frame, View, picture};
use pleach_tree::{Foliage, Growth, Species, Tree, TreeStats, Workspace};
use rayon::prelude::*;
use serde::Serialize;
use std::ops::Range;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach grow quaking_aspen --seed 3              quaking_aspen-3.json and .png here, and statistics
  pleach grow my_tree.toml -o tree.png            the picture alone
  pleach grow my_tree.toml -o tree.glb --lod 3    a mesh with three levels of detail
  pleach grow acer --forest 40x40m -o wood.glb    a forest of a few trees, placed many times
  pleach grow acer --stats-only --json            statistics for scripts
  pleach grow acer --seeds 0..100 --stats-only    means and spreads over a hundred trees
  pleach grow acer --seeds 0..9 -o forest/        nine skeletons and pictures";

/// Grow one tree, or a range of seeds
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Grow {
    /// A species, by name (see `pleach species`) or file
    species: String,
    /// Seed of the tree; the species file's own, or 1, by default
    #[arg(long, value_name = "N", value_parser = input::seed)]
    seed: Option<u64>,
    /// Grow a tree for every seed from A up to, and without, B
    #[arg(long, value_name = "A..B", value_parser = input::seeds, conflicts_with = "seed")]
    seeds: Option<Range<u64>>,
    /// File (.json, .png, .glb, .obj, .ply, .stl or .usda) or folder to write to; the working directory
    /// by default
    #[arg(short, long, value_name = "PATH", conflicts_with = "stats_only")]
    out: Option<PathBuf>,
    /// Print statistics and write no file
    #[arg(long)]
    stats_only: bool,
    /// Print the statistics as JSON, one object a line
    #[arg(long)]
    json: bool,
    /// Grow stems only
    #[arg(long)]
    no_leaves: bool,
    /// Height and width of pictures in pixels
    #[arg(long, value_name = "PIXELS", default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=8192))]
    size: u32,
    #[command(flatten)]
    mesh: MeshArgs,
    #[command(flatten)]
    limits: LimitArgs,
}

/// The statistics of a tree under the names that scripts rely on.
#[derive(Debug, Serialize)]
struct Report<'a> {
    species: &'a str,
    generator: &'a str,
    seed: u64,
    #[serde(flatten)]
    stats: TreeStats,
}

impl Grow {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let species = input::species(&self.species)?;
        self.check_suffix()?;
        if self.mesh.is_forest() {
            return self.forest(&species, self.seed.or(species.tree_seed).unwrap_or(1));
        }
        match &self.seeds {
            None => self.one(&species, self.seed.or(species.tree_seed).unwrap_or(1)),
            Some(seeds) => self.many(&species, seeds),
        }
    }

    fn one(&self, species: &Species, seed: u64) -> anyhow::Result<()> {
        let tree = species
            .grow_with(&Growth { parallel: true, ..self.growth(seed) })
            .with_context(|| format!("{} does not grow from seed {seed}", species.name))?;
        let written = if self.stats_only {
            Vec::new()
        } else {
            let targets = targets(self.out.as_deref(), species, seed)?;
            for target in &targets {
                self.write(target, species, seed, &tree)?;
            }
            targets
        };
        let report = report(species, seed, &tree);
        if self.json {
            output::json(&report)?;
        } else {
            output::line(describe(&report))?;
        }
        for path in written {
            output::note(format!("wrote {}", path.display()));
        }
        Ok(())
    }

    /// Grows every seed on all threads; results in order of seeds.
    fn many(&self, species: &Species, seeds: &Range<u64>) -> anyhow::Result<()> {
        if self.out.as_deref().and_then(Path::extension).is_some() {
            bail!("several trees need a folder, not a file: -o {}/", species.name);
        }
        let bar = progress(seeds.end - seeds.start);
        let reports: Vec<Report<'_>> = seeds
            .clone()
            .into_par_iter()
            .map_init(Default::default, |(workspace, tree): &mut (Workspace, Tree), seed| {
                species
                    .generator
                    .grow(&species.params, &self.growth(seed), workspace, tree)
                    .with_context(|| format!("{} does not grow from seed {seed}", species.name))?;
                if let Some(folder) = &self.out {
                    for target in targets(Some(folder), species, seed)? {
                        self.write(&target, species, seed, tree)?;
                    }
                }
                bar.inc(1);
                Ok(report(species, seed, tree))
            })
            .collect::<anyhow::Result<_>>()?;
        bar.finish_and_clear();
        if self.json { reports.iter().try_for_each(output::json) } else { output::line(summarise(&reports)) }
    }

    /// One file with many trees.
    fn forest(&self, species: &Species, seed: u64) -> anyhow::Result<()> {
        let Some(path) = self.out.as_deref().filter(|p| p.extension().is_some()) else {
            bail!("a forest is one file: -o {}.glb", species.name);
        };
        let trees = self.mesh.write_forest(path, species, seed, |seed| {
            species
                .grow_with(&Growth { parallel: true, ..self.growth(seed) })
                .with_context(|| format!("{} does not grow from seed {seed}", species.name))
        })?;
        output::note(format!("wrote {}: {trees} trees", path.display()));
        Ok(())
    }

    /// A file that cannot be written is told of before anything grows.
    fn check_suffix(&self) -> anyhow::Result<()> {
        let Some(path) = self.out.as_deref() else { return Ok(()) };
        let suffix = extension(path);
        if path.is_dir() {
            let file = !path.to_string_lossy().ends_with(['/', '\\']);
            if file && export::SUFFIXES.contains(&suffix.as_str()) {
                bail!("{} is a folder, expected a file", path.display());
            }
            return Ok(());
        }
        match suffix.as_str() {
            "" | "json" | "png" => Ok(()),
            mesh if export::SUFFIXES.contains(&mesh) => self.mesh.check(mesh),
            other => {
                bail!(
                    "cannot write `.{other}` files, known are .json, .png, .{}",
                    export::SUFFIXES.join(", .")
                )
            }
        }
    }

    fn growth(&self, seed: u64) -> Growth {
        let foliage = if self.no_leaves { Foliage::None } else { Foliage::All };
        Growth { limits: self.limits.limits(), foliage, ..Growth::seed(seed) }
    }

    fn write(&self, path: &Path, species: &Species, seed: u64, tree: &Tree) -> anyhow::Result<()> {
        match extension(path).as_str() {
            "json" => files::write_whole(path, |file| skeleton::write(file, species, seed, tree)),
            "png" => self.picture(path, tree),
            _ => self.mesh.write(path, species, seed, tree),
        }
    }

    /// Bark and foliage in two colours, seen from the front.
    fn picture(&self, path: &Path, tree: &Tree) -> anyhow::Result<()> {
        let foliage = !self.no_leaves;
        let frame = Frame::automatic(tree, &View::FRONT, foliage, self.size, self.size);
        let picture = picture::two_colours(tree, &View::FRONT, &frame, foliage);
        files::write_whole(path, |file| Ok(picture.write_png(file)?))
    }
}

fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// The files that a tree is written to: the one that was named, or two in a folder.
fn targets(out: Option<&Path>, species: &Species, seed: u64) -> anyhow::Result<Vec<PathBuf>> {
    match out {
        Some(file) if file.extension().is_some() && !file.is_dir() => Ok(vec![file.to_owned()]),
        folder => ["json", "png"]
            .iter()
            .map(|ext| {
                let name = format!("{}-{seed}.{ext}", species.name);
                folder.map_or_else(|| Ok(PathBuf::from(&name)), |folder| files::inside(folder, &name))
            })
            .collect(),
    }
}

fn report<'a>(species: &'a Species, seed: u64, tree: &Tree) -> Report<'a> {
    Report { species: &species.name, generator: species.generator.family(), seed, stats: TreeStats::of(tree) }
}

fn progress(total: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{pos}/{len} trees {wide_bar} {per_sec}, {eta} left");
    let bar = if output::is_watched() { ProgressBar::new(total) } else { ProgressBar::hidden() };
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}

fn describe(report: &Report<'_>) -> String {
    let stats = &report.stats;
    let mut rows = vec![
        ["level", "stems", "Bézier points", "length", "mean length", "mean radius"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for level in 0..stats.stems.len() {
        rows.push(vec![
            level.to_string(),
            stats.stems[level].to_string(),
            stats.bezier_points[level].to_string(),
            format!("{:.2} m", stats.length_total_m[level]),
            format!("{:.3} m", stats.length_mean_m[level]),
            format!("{:.2} mm", 1000.0 * stats.radius_mean_m[level]),
        ]);
    }
    format!(
        "{} (seed {}), {:.2} m high, {:.2} × {:.2} m wide, lowest branch at {:.2} m\n\
         {} leaves ({:.2} m²), {} blossoms\n\n{}",
        report.species,
        report.seed,
        stats.height_m,
        stats.crown_width_x_m,
        stats.crown_width_y_m,
        stats.lowest_branch_m,
        stats.leaves,
        stats.leaf_area_m2,
        stats.blossoms,
        output::table(&rows, &[0, 1, 2, 3, 4, 5])
    )
}

/// Mean, standard deviation and range of every figure over many trees.
fn summarise(reports: &[Report<'_>]) -> String {
    type Figure = (&'static str, fn(&TreeStats) -> f64);
    const FIGURES: [Figure; 8] = [
        ("stems", |s| s.stems.iter().sum::<usize>() as f64),
        ("Bézier points", |s| s.bezier_points.iter().sum::<usize>() as f64),
        ("leaves", |s| s.leaves as f64),
        ("blossoms", |s| s.blossoms as f64),
        ("height, m", |s| s.height_m),
        ("width x, m", |s| s.crown_width_x_m),
        ("width y, m", |s| s.crown_width_y_m),
        ("leaf area, m²", |s| s.leaf_area_m2),
    ];
    let mut rows = vec![["", "mean", "sd", "min", "max"].map(str::to_owned).to_vec()];
    for (name, figure) in FIGURES {
        let values: Vec<f64> = reports.iter().map(|r| figure(&r.stats)).collect();
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let sd = (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0)).sqrt();
        let min = values.iter().copied().fold(f64::INFINITY, f64::min);
        let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        rows.push(
            std::iter::once(name.to_owned()).chain([mean, sd, min, max].map(|v| format!("{v:.2}"))).collect(),
        );
    }
    let species = reports.first().map_or("", |r| r.species);
    format!("{species}, {} trees\n\n{}", reports.len(), output::table(&rows, &[1, 2, 3, 4]))
}
