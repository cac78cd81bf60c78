//! `pleach grow`: one tree, or many seeds of a species.

mod formats;
mod in_order;
mod statistics;

use super::export::MeshArgs;
use super::format::Format;
use crate::input::{LeafArgs, LimitArgs};
use crate::{files, input, output, skeleton};
use anyhow::{Context, bail, ensure};
use formats::Goes;
use indicatif::{ProgressBar, ProgressStyle};
use pleach::Skeleton;
use pleach_silhouette::{Frame, View, picture};
use pleach_tree::{Foliage, Growth, Species, Tree, Workspace};
use statistics::{Report, Summary};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// Default height and width of pictures, in pixels.
const SIZE: u32 = 1024;

/// Seeds of one command, at most: days of growing.
const MAX_SEEDS: u64 = 1_000_000_000;
/// The same where each tree becomes a file or two: as many as a folder may hold without harm.
const MAX_WRITTEN: u64 = 1_000_000;

const EXAMPLES: &str = "Examples:
  pleach grow quaking_aspen --seed 3            quaking_aspen-3.json and .png
  pleach grow acer -o tree.glb --lod 3          three levels of detail
  pleach grow acer -o tree.obj --season autumn  a mesh in another format
  pleach grow acer -o flat.png                  the flat drawing alone
  pleach grow acer -o tree.swc                  axes and radii of the stems
  pleach grow acer -o cylinders.csv             the same as TreeQSM's table
  pleach grow acer -o tree.mtg                  the same as OpenAlea's tree graph
  pleach grow cylinders.csv -o tree.glb         a measured tree as a mesh
  pleach grow acer --lines -o axes.obj          the axes alone, as lines
  pleach grow acer --forest 40x40m -o wood.glb  a few trees in many places
  pleach grow acer --stats-only --json          statistics for scripts
  pleach grow acer --seeds 0..100 --stats-only  means and spreads
  pleach grow acer --seeds 0..9 -o forest/      nine skeletons and drawings
  pleach grow acer --seeds 0..9 -o forest/ --format glb
  pleach grow acer -o - --format ply > tree.ply
  pleach grow stylised_oak --weld 30 --fillet 2 -o oak.glb   one soft skin
  pleach grow acer --weld 20 --fillet 2 --triangles 30000,8000 -o maple.glb
                                                             soft forks, with bark, within a budget

A .png from here is a flat drawing in two colours; `pleach render` makes shaded pictures, with bark, \
light, seasons and views.

A .swc holds a node per line, with its parent. A .csv holds cylinders with the columns of TreeQSM, which rTwig \
reads: radius, length, start, axis, parent, extension, branch, BranchOrder, PositionInBranch; metres, z up. A .mtg \
holds plants (P), axes (A) and nodes (N) with XX, YY, ZZ, Radius and Level. In all of them a branch starts on its \
parent's axis, and roots are left out.

SPECIES may be a measured tree: a .swc, or a .csv of cylinders with the columns of TreeQSM or rTwig. It has one tree \
without leaves, whatever the seed.

Statistics go to standard output, or to standard error where the tree goes to standard output. They are \
of the tree that is written: without the leaves that --no-leaves, --leaves none or --season winter leave \
out.";

static AFTER_HELP: LazyLock<String> = LazyLock::new(|| format!("{EXAMPLES}\n\n{}", *formats::TABLE));

/// Grow a tree, or a range of seeds: skeleton, drawing, mesh, statistics
#[derive(Debug, clap::Args)]
#[command(after_help = AFTER_HELP.as_str())]
pub(crate) struct Grow {
    /// A species, by name (see `pleach species`) or file; `-` reads the file from standard input
    species: String,
    /// Seed of the tree; the species file's own, or 1, by default
    #[arg(long, value_name = "N", value_parser = input::seed)]
    seed: Option<u64>,
    /// Grow a tree for every seed from A up to but not including B
    #[arg(long, value_name = "A..B", value_parser = input::seeds, conflicts_with_all = ["seed", "forest"])]
    seeds: Option<Range<u64>>,
    /// File (.json, .png, .swc, .csv, .mtg, .glb, .obj, .ply, .stl or .usda), folder, or `-` for standard output; the
    /// working directory by default
    #[arg(short, long, value_name = "PATH", conflicts_with = "stats_only")]
    out: Option<PathBuf>,
    /// The format where the suffix of PATH does not name it: by default .json and .png into a folder,
    /// .json to standard output
    #[arg(
        long,
        value_enum,
        value_name = "FORMAT",
        conflicts_with = "stats_only",
        hide_possible_values = true
    )]
    format: Option<Format>,
    /// Print statistics and write no file
    #[arg(long, conflicts_with = "forest")]
    stats_only: bool,
    /// Print the statistics as JSON, one object per line
    #[arg(long, conflicts_with = "forest")]
    json: bool,
    #[command(flatten)]
    leaves: LeafArgs,
    /// Height and width of a .png in pixels [default: 1024]
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(16..=8192))]
    size: Option<u32>,
    /// Write the axes of the stems as lines instead of surfaces (.obj)
    #[arg(long, conflicts_with_all = ["finest", "triangles", "lod", "lod_files", "weld", "tolerance", "leaves", "textures", "roots", "season"])]
    lines: bool,
    #[command(flatten)]
    mesh: MeshArgs,
    #[command(flatten)]
    limits: LimitArgs,
}

impl Grow {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let goes = self.goes()?;
        formats::check(self, &goes)?;
        if let Some(path) = self.out.as_deref().filter(|path| files::is_stdout(path)) {
            self.check_stdout(path, &goes)?;
        }
        let species = input::species(&self.species)?;
        let seed = self.seed.or(species.tree_seed).unwrap_or(1);
        input::note_leafless(&species, self.foliage(&species));
        match &self.seeds {
            _ if self.mesh.is_forest() => self.forest(&species, seed),
            None => self.one(&species, seed),
            Some(seeds) => self.many(&species, seeds),
        }
    }

    /// What is written. Impossible requests fail here, before anything grows.
    fn goes(&self) -> anyhow::Result<Vec<Goes>> {
        let asked = || self.format.map(|format| vec![Goes::Into(format)]);
        let Some(path) = self.out.as_deref() else {
            let silent = self.stats_only || self.seeds.is_some();
            let usual = if silent { vec![Goes::Statistics] } else { Self::usual() };
            return Ok(asked().unwrap_or(usual));
        };
        if files::is_stdout(path) {
            return Ok(asked().unwrap_or(vec![Goes::Into(Format::Json)]));
        }
        let slash = path.to_string_lossy().ends_with(std::path::is_separator);
        if path.is_dir() && !slash && Format::from_path(path).is_ok_and(Format::is_mesh) {
            bail!("{} is a folder, expected a file", path.display());
        }
        if !files::is_file(path) {
            return Ok(asked().unwrap_or_else(Self::usual));
        }
        match (Format::from_path(path), self.format) {
            (Ok(named), Some(format)) if named != format => {
                let (named, format) = (named.suffix(), format.suffix());
                bail!("{} ends in .{named}, but --format says {format}", path.display())
            }
            (named, format) => Ok(vec![Goes::Into(format.map_or(named, Ok)?)]),
        }
    }

    /// What goes into a folder.
    fn usual() -> Vec<Goes> {
        vec![Goes::Into(Format::Json), Goes::Into(Format::Png)]
    }

    /// Only one result can go to standard output.
    fn check_stdout(&self, path: &Path, goes: &[Goes]) -> anyhow::Result<()> {
        if self.seeds.is_some() {
            bail!("several trees need a folder, not standard output");
        }
        if self.json {
            bail!("`--json` and `-o -` both want standard output");
        }
        match goes {
            [Goes::Into(format)] => self.mesh.check_alone(path, *format),
            _ => Ok(()),
        }
    }

    fn one(&self, species: &Species, seed: u64) -> anyhow::Result<()> {
        let mut tree = species
            .grow_with(&Growth { parallel: true, ..self.growth(species, seed) })
            .with_context(|| format!("{} does not grow from seed {seed}", species.name))?;
        self.apply_season(species, &mut tree);
        let written = if self.stats_only { Vec::new() } else { self.write_all(species, seed, &tree)? };
        let report = Report::new(species, seed, &tree);
        if self.out.as_deref().is_some_and(files::is_stdout) {
            output::note(statistics::describe(&report));
        } else if self.json {
            output::json(&report)?;
        } else {
            output::line(statistics::describe(&report))?;
        }
        written.iter().for_each(|path| output::wrote(path));
        Ok(())
    }

    /// Grows every seed on all threads; results in order of seeds, as they are made.
    fn many(&self, species: &Species, seeds: &Range<u64>) -> anyhow::Result<()> {
        if self.out.as_deref().is_some_and(files::is_file) {
            bail!("several trees need a folder, not a file: -o {}/", species.name);
        }
        let (count, is_written) = (seeds.end - seeds.start, self.out.is_some() || self.format.is_some());
        let max = if is_written { MAX_WRITTEN } else { MAX_SEEDS };
        ensure!(
            count <= max,
            "--seeds {}..{} are {count} trees, and at most {max} are {} at a time; take a smaller range",
            seeds.start,
            seeds.end,
            if is_written { "written" } else { "grown" }
        );
        let bar = progress(count);
        let mut summary = Summary::default();
        let make = |(workspace, tree): &mut (Workspace, Tree), seed| {
            species
                .generator
                .grow(&species.params, &self.growth(species, seed), workspace, tree)
                .with_context(|| format!("{} does not grow from seed {seed}", species.name))?;
            self.apply_season(species, tree);
            if is_written {
                self.write_all(species, seed, tree)?;
            }
            Ok(Report::new(species, seed, tree))
        };
        in_order::for_each(seeds, make, |report| {
            bar.inc(1);
            summary.add(&report);
            if self.json { bar.suspend(|| output::json(&report)) } else { Ok(()) }
        })?;
        bar.finish_and_clear();
        if self.json { Ok(()) } else { output::line(summary.text(&species.name)) }
    }

    /// One file with many trees.
    fn forest(&self, species: &Species, seed: u64) -> anyhow::Result<()> {
        let one_file = |path: &&Path| files::is_file(path) || files::is_stdout(path);
        let Some(path) = self.out.as_deref().filter(one_file) else {
            bail!("a forest is one file: -o {}.glb", species.name);
        };
        let trees = self.mesh.write_forest(path, species, seed, |seed| {
            species.grow_with(&Growth { parallel: true, ..self.growth(species, seed) })
        })?;
        output::note(format!("wrote {}: {trees} trees", path.display()));
        Ok(())
    }

    fn growth(&self, species: &Species, seed: u64) -> Growth<'static> {
        Growth { limits: self.limits.limits(), foliage: self.foliage(species), ..Growth::seed(seed) }
    }

    /// Whether leaves grow. `--leaves` decides as well.
    fn foliage(&self, species: &Species) -> Foliage {
        self.mesh.foliage().unwrap_or_else(|| self.leaves.foliage(species))
    }

    /// Removes leaves and blossoms that the tree does not have in the season.
    fn apply_season(&self, species: &Species, tree: &mut Tree) {
        self.mesh.export().palette(species).apply_season(tree);
    }

    /// Writes the requested files, and prints their names.
    fn write_all(&self, species: &Species, seed: u64, tree: &Tree) -> anyhow::Result<Vec<PathBuf>> {
        let mut written = Vec::new();
        for goes in self.goes()? {
            let Goes::Into(format) = goes else { continue };
            let path = match self.out.as_deref() {
                Some(file) if files::is_file(file) || files::is_stdout(file) => file.to_owned(),
                folder => {
                    let name = format!("{}-{seed}.{}", species.name, format.suffix());
                    folder.map_or_else(|| Ok(PathBuf::from(&name)), |folder| files::inside(folder, &name))?
                }
            };
            match format {
                Format::Json => {
                    files::write_out(&path, |mut out| skeleton::write(&mut out, species, seed, tree))?
                }
                Format::Png => self.picture(&path, tree)?,
                Format::Skeleton(format) => {
                    files::write_out(&path, |mut out| Ok(Skeleton::new(tree).write(format, &mut out)?))?
                }
                Format::Mesh(_) if self.lines => {
                    files::write_out(&path, |mut out| Ok(Skeleton::new(tree).write_lines(&mut out)?))?
                }
                Format::Mesh(format) => self.mesh.write(&path, format, species, seed, tree)?,
            }
            written.push(path);
        }
        Ok(written)
    }

    /// Bark and foliage in two colours, seen from the front.
    fn picture(&self, path: &Path, tree: &Tree) -> anyhow::Result<()> {
        let size = self.size.unwrap_or(SIZE);
        let parts = self.mesh.export().parts();
        let frame = Frame::automatic(tree, &View::FRONT, parts, size, size);
        let picture = picture::two_colors(tree, &View::FRONT, &frame, parts);
        files::write_out(path, |mut out| Ok(picture.write_png(&mut out)?))
    }
}

fn progress(total: u64) -> ProgressBar {
    let style = ProgressStyle::with_template("{pos}/{len} trees {wide_bar} {per_sec}, {eta} left");
    let bar = if output::is_watched() { ProgressBar::new(total) } else { ProgressBar::hidden() };
    bar.with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
}
