//! Meshes for `pleach grow`: what was asked for, and the files.

use super::grow::formats::Format;
use super::leaf_form::Leaves;
use crate::choice::{Choice, one_of};
use crate::files::{self, Out};
use anyhow::{Context, bail};
use pleach::extras;
use pleach_mesh::forest;
use pleach_mesh::lod::{self, Level};
use pleach_mesh::weld::WeldSettings;
use pleach_mesh::write::glb::{Glb, Placed, Scene};
use pleach_mesh::write::{obj, ply, stl, usda};
use pleach_mesh::{
    Block, Card, Cards, LeafStyle, Material, MeshError, MeshSettings, Mesher, Palette, Rig, Source, Welded,
    send, weld,
};
use pleach_render::{Billboards, billboard, leaf_picture, png_file};
use pleach_tree::Season;
use pleach_tree::{Foliage, Parts, Species, Tree};
use serde_json::json;
use std::io::Write;
use std::path::Path;

/// How far bark may stray where nothing is said of it, in millimetres.
const TOLERANCE: f64 = 2.0;

pub(super) const SEASONS: &[Choice<Season>] = &[
    (Season::Spring.name(), "", Season::Spring),
    (Season::Summer.name(), "", Season::Summer),
    (Season::Autumn.name(), "", Season::Autumn),
    (Season::Winter.name(), "", Season::Winter),
];

/// A tree, dressed for its season, and the file that it goes to.
#[derive(Clone, Copy)]
pub(super) struct Export<'a> {
    /// The file, or `-` for standard output.
    pub(super) path: &'a Path,
    pub(super) species: &'a Species,
    pub(super) seed: u64,
    pub(super) tree: &'a Tree,
    pub(super) palette: Palette,
}

impl Export<'_> {
    /// Writes the file, whole or not at all.
    fn write(&self, send: impl FnOnce(&mut dyn Out) -> Result<(), MeshError>) -> anyhow::Result<()> {
        files::write_out(self.path, |out| Ok(send(out)?))
    }
}

/// `mesher` with `bark` instead of its tubes, if there is one.
fn with_bark<'a>(mesher: Mesher<'a>, bark: Option<&'a Block>) -> Box<dyn Source + 'a> {
    match bark {
        Some(bark) => Box::new(Welded::new(bark, mesher)),
        None => Box::new(mesher),
    }
}

fn cards(cards: &[Card]) -> Box<dyn Source + '_> {
    Box::new(Cards(cards))
}

/// Options of mesh files.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Meshes (.glb, .obj, .ply, .stl, .usda)")]
pub(crate) struct MeshArgs {
    /// Levels of detail in a .glb, the finest included [default: 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(lod::MAX_LEVELS)))]
    pub(super) lod: Option<u32>,
    /// Weld all stems into one watertight surface, on a grid with cells of this many millimetres; what
    /// is thinner becomes as thick as a cell
    #[arg(long, value_name = "MM", value_parser = cell, conflicts_with_all = ["lod", "sway", "wind", "forest", "tolerance"])]
    pub(super) weld: Option<f64>,
    /// Round the corners where welded stems meet: width of the fillet over the radius of the thinner
    /// stem, 0 to 4 [default: 0]
    #[arg(long, value_name = "RATIO", value_parser = fillet, requires = "weld")]
    fillet: Option<f64>,
    /// Draw roots too, where the generator grows any
    #[arg(long, conflicts_with = "forest")]
    roots: bool,
    /// A last level of detail: N crossing cards that show the tree, 1 to 8, in a .glb
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(billboard::MAX_SIDES)))]
    pub(super) billboard: Option<u32>,
    /// How far bark may stray from its true surface, in millimetres [default: 2]
    #[arg(long, value_name = "MM", value_parser = tolerance)]
    pub(super) tolerance: Option<f64>,
    /// How leaves are drawn [default: outline]
    #[arg(long, value_enum, value_name = "HOW", conflicts_with = "no_leaves")]
    pub(super) leaves: Option<Leaves>,
    /// Season; by default the species file's own, or summer with all its blossom
    #[arg(long, value_parser = one_of(SEASONS))]
    pub(super) season: Option<Season>,
    /// Give each vertex the data that shaders need for wind (.glb, .ply)
    #[arg(long)]
    pub(super) wind: bool,
    /// Add joints and a looping animation of the tree in wind (.glb)
    #[arg(long, conflicts_with_all = ["lod", "forest", "billboard"])]
    pub(super) sway: bool,
    /// A forest on a field of this size in metres, such as 40x40m, instead of one tree (.glb)
    #[arg(long, value_name = "WxD", value_parser = field)]
    pub(super) forest: Option<(f64, f64)>,
    /// Metres between the trees of a forest
    #[arg(long, value_name = "METRES", default_value_t = 6.0, requires = "forest")]
    spacing: f64,
    /// Different trees in a forest
    #[arg(long, value_name = "N", default_value_t = 4, requires = "forest", value_parser = clap::value_parser!(u32).range(1..=64))]
    variants: u32,
}

fn tolerance(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|t| (0.01..=1000.0).contains(t))
        .ok_or_else(|| "millimetres from 0.01 to 1000".to_owned())
}

fn cell(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|t| (1.0..=1000.0).contains(t))
        .ok_or_else(|| "millimetres from 1 to 1000".to_owned())
}

fn fillet(text: &str) -> Result<f64, String> {
    let max = WeldSettings::MAX_FILLET;
    text.parse().ok().filter(|f| (0.0..=max).contains(f)).ok_or_else(|| format!("a ratio from 0 to {max}"))
}

/// `40x30m`, `40x30` or `40`.
fn field(text: &str) -> Result<(f64, f64), String> {
    let sides = text.trim_end_matches('m');
    let (width, depth) = sides.split_once(['x', '×']).unwrap_or((sides, sides));
    let side =
        |text: &str| text.trim_end_matches('m').parse::<f64>().ok().filter(|s| *s > 0.0 && s.is_finite());
    side(width)
        .zip(side(depth))
        .ok_or_else(|| format!("`{text}` is not a field, expected metres such as 40x30m"))
}

impl MeshArgs {
    /// Whether the file holds many trees, which are grown here.
    pub(crate) const fn is_forest(&self) -> bool {
        self.forest.is_some()
    }

    /// Whether trees are to be grown with leaves, if `--leaves` says how they are drawn.
    pub(super) fn foliage(&self) -> Option<Foliage> {
        let leaves = self.leaves?;
        Some(if leaves == Leaves::None { Foliage::None } else { Foliage::All })
    }

    /// What of a tree is drawn.
    pub(super) fn parts(&self) -> Parts {
        if self.roots { Parts::ALL } else { Parts::LEAFY }
    }

    fn levels(&self) -> u32 {
        self.lod.unwrap_or(1)
    }

    fn settings(&self) -> MeshSettings {
        let leaves = match self.leaves {
            None | Some(Leaves::Outline | Leaves::Instances) => LeafStyle::Outline,
            Some(Leaves::Simple) => LeafStyle::Simple,
            Some(Leaves::Cards) => LeafStyle::CrossedCards,
            Some(Leaves::None) => LeafStyle::None,
        };
        MeshSettings {
            tolerance: self.tolerance.unwrap_or(TOLERANCE) / 1000.0,
            leaves,
            wind: self.wind,
            parts: self.parts(),
            ..MeshSettings::default()
        }
    }

    /// Fails if files beside the one at `path` are wanted: standard output has none beside it.
    pub(super) fn check_alone(&self, path: &Path, format: Format) -> anyhow::Result<()> {
        if files::is_stdout(path) && self.leaves == Some(Leaves::Cards) && format != Format::Glb {
            bail!(
                "`--leaves cards` writes pictures beside a .{}, which standard output cannot have; .glb \
                 holds them",
                format.suffix()
            );
        }
        Ok(())
    }

    /// The colours of the season that was asked for.
    pub(super) fn palette(&self, species: &Species) -> Palette {
        Palette::new(&species.appearance, self.season)
    }

    /// Writes a tree as a mesh.
    pub(super) fn write(&self, format: Format, export: &Export<'_>) -> anyhow::Result<()> {
        self.check_alone(export.path, format)?;
        let welded = |cell: f64| {
            let fillet = self.fillet.unwrap_or(0.0);
            let settings = WeldSettings { fillet, parts: self.parts(), ..WeldSettings::new(cell / 1000.0) };
            weld::surface(export.tree, &settings)
        };
        let bark = self.weld.map(welded).transpose()?;
        let bark = bark.as_ref();
        match format {
            Format::Glb => self.write_glb(export, bark),
            Format::Obj => self.write_obj(export, bark),
            Format::Ply => {
                let sources = [self.source(export.tree, bark)];
                export.write(|out| send(&sources, &mut ply::Ply::new(out, export.palette)))
            }
            Format::Stl => {
                let sources = [self.source(export.tree, bark)];
                export.write(|out| send(&sources, &mut stl::Stl::new(out)))
            }
            Format::Usda => self.write_usda(export, bark),
            Format::Json | Format::Png => bail!("a .{} file holds no mesh", format.suffix()),
        }
    }

    fn source<'a>(&self, tree: &'a Tree, bark: Option<&'a Block>) -> Box<dyn Source + 'a> {
        with_bark(Mesher::new(tree, self.settings()), bark)
    }

    /// PNG files that leaves, blossom and billboards show.
    fn pictures(
        &self,
        tree: &Tree,
        palette: &Palette,
        billboards: Option<&Billboards>,
    ) -> anyhow::Result<Vec<(Material, Vec<u8>)>> {
        let mut pictures = Vec::new();
        if self.leaves == Some(Leaves::Cards) {
            for (material, picture) in leaf_picture::of(tree, palette) {
                pictures.push((material, png_file::bytes(&picture)?));
            }
        }
        if let Some(billboards) = billboards {
            pictures.push((Material::Card, png_file::bytes(&billboards.picture)?));
        }
        Ok(pictures)
    }

    fn write_glb(&self, export: &Export<'_>, bark: Option<&Block>) -> anyhow::Result<()> {
        let Export { species, seed, tree, palette, .. } = *export;
        let levels = lod::levels(tree, self.settings(), self.levels());
        let rig = self.sway.then(|| Rig::new(tree));
        let billboards = self.billboard.map(|sides| Billboards::paint(&[tree], &palette, sides));
        let billboards = billboards.filter(|billboards| !billboards.is_empty());
        let mut sources = self.sources(&levels, rig.as_ref(), bark);
        sources.extend(billboards.iter().map(|b| cards(&b.cards[0])));
        let scene = Scene {
            name: species.name.clone(),
            palette,
            extras: extras(species, json!(seed)),
            placed: vec![Placed::at_origin(&species.name, sources.len())],
            rig: rig.as_ref(),
            pictures: self.pictures(tree, &palette, billboards.as_ref())?,
        };
        export.write(|out| send(&sources, &mut Glb::new(out, &scene)))
    }

    fn sources<'a>(
        &self,
        levels: &'a [Level<'a>],
        rig: Option<&'a Rig>,
        bark: Option<&'a Block>,
    ) -> Vec<Box<dyn Source + 'a>> {
        let mesher = |level: &'a Level<'a>| {
            let mut mesher = Mesher::new(&level.tree, level.settings);
            if let Some(rig) = rig {
                mesher = mesher.with_rig(rig);
            }
            if self.leaves == Some(Leaves::Instances) {
                mesher = mesher.with_instanced_leaves();
            }
            with_bark(mesher, bark)
        };
        levels.iter().map(mesher).collect()
    }

    /// Grows a few trees, from `seed` on, and writes a forest of them. Returns how many stand there.
    pub(crate) fn write_forest(
        &self,
        path: &Path,
        species: &Species,
        seed: u64,
        grow: impl Fn(u64) -> anyhow::Result<Tree>,
    ) -> anyhow::Result<usize> {
        let (width, depth) = self.forest.context("no forest was asked for")?;
        let sites = forest::plant(width, depth, self.spacing, self.variants, seed)?;
        // Only variants that stand somewhere are grown.
        let mut used: Vec<u32> = sites.iter().map(|s| s.variant).collect();
        used.sort_unstable();
        used.dedup();
        let season = self.season;
        let mut trees = Vec::new();
        let mut palette = None;
        for &variant in &used {
            let mut tree = grow(seed + u64::from(variant))?;
            let colors = Palette::new(&species.appearance, season);
            colors.apply_season(&mut tree);
            palette = palette.or(Some(colors));
            trees.push(tree);
        }
        let levels: Vec<Vec<Level<'_>>> =
            trees.iter().map(|tree| lod::levels(tree, self.settings(), self.levels())).collect();
        let palette = palette.context("a forest needs a tree")?;
        let billboards = self.billboard.map(|sides| {
            let trees: Vec<&Tree> = trees.iter().collect();
            Billboards::paint(&trees, &palette, sides)
        });
        let mut sources = Vec::new();
        for (i, levels) in levels.iter().enumerate() {
            sources.extend(self.sources(levels, None, None));
            sources.extend(billboards.iter().map(|b| cards(&b.cards[i])));
        }
        let each = self.levels() as usize + usize::from(billboards.is_some());
        let placed = sites.iter().enumerate().map(|(i, site)| {
            let first = used.binary_search(&site.variant).unwrap_or(0) * each;
            Placed {
                name: format!("{} {}", species.name, i + 1),
                meshes: (first..first + each).collect(),
                position: site.position.as_vec2().extend(0.0),
                turn: site.turn as f32,
                scale: site.scale as f32,
            }
        });
        let seeds: Vec<u64> = used.iter().map(|v| seed + u64::from(*v)).collect();
        let scene = Scene {
            name: format!("{} forest", species.name),
            palette,
            extras: extras(species, json!(seeds)),
            placed: placed.collect(),
            rig: None,
            pictures: self.pictures(&trees[0], &palette, billboards.as_ref())?,
        };
        files::write_out(path, |out| Ok(send(&sources, &mut Glb::new(out, &scene))?))?;
        Ok(sites.len())
    }

    fn write_obj(&self, export: &Export<'_>, bark: Option<&Block>) -> anyhow::Result<()> {
        let Export { path, species, tree, palette, .. } = *export;
        // Standard output has nothing beside it.
        let materials = (!files::is_stdout(path)).then(|| path.with_extension("mtl"));
        let name = materials.as_deref().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
        let sources = [self.source(tree, bark)];
        export.write(|out| send(&sources, &mut obj::Obj::new(out, &species.name, &name)))?;
        let Some(materials) = materials else { return Ok(()) };
        let pictures = self.pictures_beside(path, tree, &palette)?;
        files::write_text(&materials, &obj::materials(&palette, &pictures))
    }

    fn write_usda(&self, export: &Export<'_>, bark: Option<&Block>) -> anyhow::Result<()> {
        let Export { path, species, seed, tree, palette } = *export;
        let sources = [with_bark(Mesher::new(tree, self.settings()).with_instanced_leaves(), bark)];
        let about = [
            ("generator", species.generator.family().to_string()),
            ("seed", seed.to_string()),
            ("species", species.name.clone()),
        ];
        let notes = usda::Notes {
            name: species.name.clone(),
            about: about.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
            pictures: self.pictures_beside(path, tree, &palette)?,
        };
        export.write(|out| send(&sources, &mut usda::Usda::new(out, &notes, palette)))
    }

    /// Writes the pictures of leaves and blossom beside `path`, and says their names.
    fn pictures_beside(
        &self,
        path: &Path,
        tree: &Tree,
        palette: &Palette,
    ) -> anyhow::Result<Vec<(Material, String)>> {
        let mut pictures = Vec::new();
        for (material, png) in self.pictures(tree, palette, None)? {
            let placed = if material == Material::Blossom { &tree.blossoms } else { &tree.leaves };
            if placed.is_empty() {
                continue;
            }
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let name = format!("{stem}-{}.png", material.name());
            files::write_whole(&path.with_file_name(&name), |file| Ok(file.write_all(&png)?))?;
            pictures.push((material, name));
        }
        Ok(pictures)
    }
}
