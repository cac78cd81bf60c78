//! `pleach render`: a shaded picture of a tree, or one that turns.

use super::export::SEASONS;
use super::gallery;
use crate::choice::{Choice, one_of};
use crate::input::{LeafArgs, LimitArgs};
use crate::{files, input, output};
use anyhow::{Context, bail};
use pleach_generators::GeneratorChoice;
use pleach_mesh::Palette;
use pleach_render::preview::{Background, Ground};
use pleach_render::{Picture, Preview, PreviewSettings, png_file};
use pleach_silhouette::View;
use pleach_tree::Season;
use pleach_tree::{Growth, Parts, Species, Tree};
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "Examples:
  pleach render quaking_aspen                         quaking_aspen-1.png here
  pleach render acer --season autumn -o acer.png      in autumn
  pleach render palm --size 1600 --view 30,10         larger, from another side
  pleach render palm --background transparent -o palm.png
  pleach render acer --turntable 36 -o acer.png       an animated PNG
  pleach render acer --turntable 36 -o frames/        36 files
  pleach render all -o gallery/                       every species, leafy
  pleach render all --no-leaves -o winter/            and bare
  pleach render --gallery -o gallery.png              fifteen species on one sheet
  pleach render --gallery --generator all             every species of every generator
  pleach render --gallery --only acer,my_tree.toml --columns 2
  pleach render acer -o - > acer.png                  to standard output

This is the picture to look at: bark, light and shadow, 768 pixels high, enough for a page. \
`pleach silhouette` draws the binary picture that fits compare, with 512 pixels, twice what a fit \
compares; the flat drawing that `pleach grow` puts beside a skeleton has 1024, so that twigs are seen.";

/// Draw a shaded picture of a tree
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Render {
    /// A species, by name or file; `all` for every species that comes with pleach, `-` for a file from
    /// standard input
    #[arg(required_unless_present = "gallery")]
    species: Option<String>,
    /// One sheet of the dissertation's fifteen species, leafy and in winter
    #[arg(long, conflicts_with_all = ["species", "season", "no_leaves", "leafy", "turntable", "background", "ground"])]
    gallery: bool,
    /// In a gallery: the species of this generator instead, or of `all`
    #[arg(long, value_name = "NAME", requires = "gallery", conflicts_with = "species")]
    generator: Option<GeneratorChoice>,
    /// In a gallery: these species instead, by name or file, in this order
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', requires = "gallery", conflicts_with_all = ["species", "generator"])]
    only: Vec<String>,
    /// In a gallery: species per row; about a square by default
    #[arg(long, value_name = "N", requires = "gallery", value_parser = clap::value_parser!(u32).range(1..=100))]
    columns: Option<u32>,
    /// Seed of the tree; the species file's own, or 1, by default
    #[arg(long, value_name = "N", value_parser = input::seed)]
    seed: Option<u64>,
    /// PNG file, folder to write to, or `-` for standard output; the working directory by default
    #[arg(short, long, value_name = "PATH")]
    out: Option<PathBuf>,
    /// Width and height in pixels; in a gallery, of each tree, 224 by default
    #[arg(long, value_name = "PIXELS", default_value_t = 768, default_value_if("gallery", "true", "224"), value_parser = clap::value_parser!(u32).range(16..=4096))]
    size: u32,
    /// Azimuth, or azimuth,elevation, in degrees
    #[arg(long, value_name = "AZ,EL", default_value = "0,5", value_parser = input::view, allow_hyphen_values = true)]
    view: View,
    /// Season; by default the species file's own, or summer with all its blossom
    #[arg(long, value_parser = one_of(SEASONS))]
    season: Option<Season>,
    #[command(flatten)]
    leaves: LeafArgs,
    /// Draw roots too, where the generator grows any
    #[arg(long)]
    roots: bool,
    /// What is behind the tree: studio, transparent, or a colour such as #dde6ee
    #[arg(long, value_name = "WHAT", default_value = "studio")]
    background: Background,
    /// What the tree stands on
    #[arg(long, value_parser = one_of(GROUNDS), default_value = "shadow")]
    ground: Ground,
    /// This many pictures around the tree: one animated PNG, or files in a folder
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=360))]
    turntable: Option<u32>,
    #[command(flatten)]
    limits: LimitArgs,
}

const GROUNDS: &[Choice<Ground>] = &[
    ("shadow", "The tree's shadow", Ground::Shadow),
    ("grass", "Grass", Ground::Grass),
    ("none", "Nothing", Ground::None),
];

impl Render {
    pub(crate) fn run(&self) -> anyhow::Result<()> {
        let Some(name) = self.species.as_deref() else {
            return self.sheet();
        };
        if name != "all" {
            return self.one(&input::species(name)?);
        }
        if self.file()?.is_some() {
            bail!("pictures of all species need a folder, not a file: -o gallery/");
        }
        pleach_generators::names().into_iter().try_for_each(|name| self.one(&input::species(name)?))
    }

    fn one(&self, species: &Species) -> anyhow::Result<()> {
        let seed = self.seed.or(species.tree_seed).unwrap_or(1);
        let file = self.file()?;
        let mut tree = self.grow(species, seed)?;
        let palette = Palette::new(&species.appearance, self.season);
        palette.apply_season(&mut tree);
        let preview = Preview::with_parts(&tree, &palette, self.size, self.parts());
        let name = |what: &str| format!("{}-{seed}{what}.png", species.name);
        let place = |name: String| match (&self.out, file) {
            (_, Some(file)) => Ok(file.to_owned()),
            (Some(folder), None) => files::inside(folder, name),
            (None, None) => Ok(PathBuf::from(name)),
        };
        let Some(frames) = self.turntable else {
            let picture = preview.picture(&self.settings(0.0));
            return write(&place(name(""))?, &[picture], 0);
        };
        let turn = |i: u32| self.settings(TAU * f64::from(i) / f64::from(frames));
        if file.is_some() || self.out.is_none() {
            let pictures: Vec<_> = (0..frames).map(|i| preview.picture(&turn(i))).collect();
            // A turn takes four seconds.
            return write(&place(name(""))?, &pictures, (4000 / frames).max(10) as u16);
        }
        (0..frames)
            .try_for_each(|i| write(&place(name(&format!("-{i:03}")))?, &[preview.picture(&turn(i))], 0))
    }

    fn sheet(&self) -> anyhow::Result<()> {
        let path = match (self.file()?, &self.out) {
            (Some(file), _) => file.to_owned(),
            (None, Some(folder)) => files::inside(folder, "gallery.png")?,
            (None, None) => PathBuf::from("gallery.png"),
        };
        let grow = |species: &Species| self.grow(species, self.seed.or(species.tree_seed).unwrap_or(1));
        let species: Vec<Species> = match &self.generator {
            _ if !self.only.is_empty() => {
                self.only.iter().map(|name| input::species(name)).collect::<Result<_, _>>()?
            }
            Some(generator) => generator.known().collect(),
            None => pleach_generators::HEWITT_2017
                .iter()
                .filter_map(|name| pleach_generators::preset(name))
                .collect(),
        };
        let sheet =
            gallery::sheet(&species, self.columns, self.size, self.parts(), grow, &self.settings(0.0))?;
        files::write_out(&path, |mut out| Ok(png_file::write_indexed(&mut out, &sheet)?))?;
        output::wrote(&path);
        Ok(())
    }

    /// The file to write to, if one was named; `-` is one.
    fn file(&self) -> anyhow::Result<Option<&Path>> {
        let file = self.out.as_deref().filter(|path| files::is_file(path) || files::is_stdout(path));
        if let Some(file) = file.filter(|path| !files::is_stdout(path)) {
            let suffix = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
            if suffix != "png" {
                bail!("cannot write `.{suffix}` pictures, known is .png");
            }
        }
        Ok(file)
    }

    fn grow(&self, species: &Species, seed: u64) -> anyhow::Result<Tree> {
        let foliage = self.leaves.foliage(species);
        input::note_leafless(species, foliage);
        let growth = Growth { parallel: true, foliage, limits: self.limits.limits(), ..Growth::seed(seed) };
        species.grow_with(&growth).with_context(|| format!("{} does not grow from seed {seed}", species.name))
    }

    fn parts(&self) -> Parts {
        if self.roots { Parts::ALL } else { Parts::LEAFY }
    }

    fn settings(&self, turn: f64) -> PreviewSettings {
        PreviewSettings {
            width: self.size,
            height: self.size,
            azimuth: self.view.azimuth + turn,
            elevation: self.view.elevation,
            background: self.background,
            ground: self.ground,
            all_around: self.turntable.is_some(),
        }
    }
}

fn write(path: &Path, pictures: &[Picture], milliseconds: u16) -> anyhow::Result<()> {
    files::write_out(path, |mut out| Ok(png_file::write(&mut out, pictures, milliseconds)?))?;
    output::wrote(path);
    Ok(())
}
