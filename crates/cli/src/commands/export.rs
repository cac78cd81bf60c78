//! Meshes for `pleach grow`: what was asked for, and the files.

use crate::files;
use anyhow::{Context, bail};
use clap::ValueEnum;
use pleach_mesh::lod::{self, Level};
use pleach_mesh::write::glb::{Glb, Placed, Scene};
use pleach_mesh::write::{obj, ply, stl, usda};
use pleach_mesh::{
    Billboards, Block, LeafStyle, Material, MeshSettings, Mesher, Palette, Rig, leaf_picture, png_file, send,
    weld,
};
use pleach_mesh::{billboard, forest};
use pleach_tree::species::Season;
use pleach_tree::{Species, Tree};
use serde_json::{Map, Value, json};
use std::io::Write;
use std::path::Path;

/// Suffixes of mesh files.
pub(crate) const SUFFIXES: [&str; 5] = ["glb", "obj", "ply", "stl", "usda"];

/// How leaves are put into a file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Leaves {
    /// Their outlines
    #[default]
    Outline,
    /// Two triangles each
    Simple,
    /// Two crossed cards each, which show a picture of the leaf
    Cards,
    /// One leaf, placed many times (.glb with EXT_mesh_gpu_instancing, and always in .usda)
    Instances,
    /// No leaves and no blossom
    None,
}

/// The time of the year.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SeasonArg {
    Spring,
    Summer,
    Autumn,
    Winter,
}

impl From<SeasonArg> for Season {
    fn from(season: SeasonArg) -> Self {
        match season {
            SeasonArg::Spring => Self::Spring,
            SeasonArg::Summer => Self::Summer,
            SeasonArg::Autumn => Self::Autumn,
            SeasonArg::Winter => Self::Winter,
        }
    }
}

/// Options of .glb, .obj, .ply, .stl and .usda files.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Meshes (.glb, .obj, .ply, .stl, .usda)")]
pub(crate) struct MeshArgs {
    /// Levels of detail in a .glb, the finest included
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=i64::from(lod::MOST_LEVELS)))]
    lod: u32,
    /// Weld all stems into one watertight surface, on a grid of cells of so many millimetres; what is
    /// thinner becomes as thick as a cell
    #[arg(long, value_name = "MM", value_parser = cell, conflicts_with_all = ["lod", "sway", "wind", "forest"])]
    weld: Option<f64>,
    /// A last level of detail of N crossing cards that show the tree, 1 to 8, in a .glb
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(billboard::MOST_SIDES)))]
    billboard: Option<u32>,
    /// How far bark may stray from its true surface, in millimetres
    #[arg(long, value_name = "MM", default_value_t = 2.0, value_parser = tolerance)]
    tolerance: f64,
    /// How leaves are drawn
    #[arg(long, value_enum, default_value_t)]
    leaves: Leaves,
    /// Season; by default the species file's own, or summer with all its blossom
    #[arg(long, value_enum)]
    season: Option<SeasonArg>,
    /// Give each corner the data that shaders need for wind (.glb, .ply)
    #[arg(long)]
    wind: bool,
    /// Add joints and a looping animation of the tree in wind (.glb)
    #[arg(long, conflicts_with_all = ["lod", "forest", "billboard"])]
    sway: bool,
    /// A forest on a field of so many metres, such as 40x40m, instead of one tree (.glb)
    #[arg(long, value_name = "WxD", value_parser = field)]
    forest: Option<(f64, f64)>,
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

/// `40x30m`, `40x30` or `40`.
fn field(text: &str) -> Result<(f64, f64), String> {
    let sides = text.trim_end_matches('m');
    let (width, depth) = sides.split_once(['x', '×']).unwrap_or((sides, sides));
    let side =
        |text: &str| text.trim_end_matches('m').parse::<f64>().ok().filter(|s| *s > 0.0 && s.is_finite());
    side(width)
        .zip(side(depth))
        .ok_or_else(|| format!("`{text}` is no field, expected metres such as 40x30m"))
}

impl MeshArgs {
    /// Whether the file holds many trees, which are grown here.
    pub(crate) const fn is_forest(&self) -> bool {
        self.forest.is_some()
    }

    fn settings(&self) -> MeshSettings {
        let leaves = match self.leaves {
            Leaves::Outline | Leaves::Instances => LeafStyle::Outline,
            Leaves::Simple => LeafStyle::Simple,
            Leaves::Cards => LeafStyle::CrossedCards,
            Leaves::None => LeafStyle::None,
        };
        MeshSettings {
            tolerance: self.tolerance / 1000.0,
            leaves,
            wind: self.wind,
            ..MeshSettings::default()
        }
    }

    /// What only a .glb can hold, if it was asked for.
    fn glb_only(&self, suffix: &str) -> Option<&'static str> {
        let asked = [
            (self.lod > 1, "levels of detail (--lod)"),
            (self.leaves == Leaves::Instances && suffix != "usda", "instances (--leaves instances)"),
            (self.billboard.is_some(), "billboards (--billboard)"),
            (self.sway, "an animation (--sway)"),
            (self.forest.is_some(), "a forest (--forest)"),
        ];
        asked.into_iter().find(|(asked, _)| *asked).map(|(_, what)| what)
    }

    /// Whether `suffix` can hold what was asked for.
    pub(crate) fn check(&self, suffix: &str) -> anyhow::Result<()> {
        match self.glb_only(suffix) {
            Some(what) if suffix != "glb" => bail!("{what} needs a .glb file, not .{suffix}"),
            _ => Ok(()),
        }
    }

    /// Writes `tree` as the mesh file that the suffix of `path` names.
    pub(crate) fn write(&self, path: &Path, species: &Species, seed: u64, tree: &Tree) -> anyhow::Result<()> {
        let suffix = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        self.check(&suffix)?;
        let palette = Palette::of(species, self.season.map(Season::from));
        // A winter tree is a copy without leaves; any other is used as it is.
        let dressed;
        let tree =
            if (palette.leaves || tree.leaves.is_empty()) && (palette.blossoms || tree.blossoms.is_empty()) {
                tree
            } else {
                let mut bare = tree.clone();
                palette.dress(&mut bare);
                dressed = bare;
                &dressed
            };
        match suffix.as_str() {
            "glb" => self.write_glb(path, species, seed, tree, palette),
            "obj" => self.write_obj(path, species, tree, palette),
            "ply" => {
                let bark = self.welded(tree)?;
                let meshers = [self.plain(tree, self.settings(), bark.as_ref())];
                files::write_whole(path, |file| Ok(send(&meshers, &mut ply::Ply::new(file, palette))?))
            }
            "stl" => {
                let bark = self.welded(tree)?;
                let settings = MeshSettings { wind: false, ..self.settings() };
                let meshers = [self.plain(tree, settings, bark.as_ref())];
                files::write_whole(path, |file| Ok(send(&meshers, &mut stl::Stl::new(file))?))
            }
            "usda" => self.write_usda(path, species, seed, tree, palette),
            other => bail!("`.{other}` is no mesh file, known are .{}", SUFFIXES.join(", .")),
        }
    }

    /// The bark as one surface, if that was asked for.
    fn welded(&self, tree: &Tree) -> anyhow::Result<Option<Block>> {
        Ok(self.weld.map(|cell| weld::surface(tree, cell / 1000.0)).transpose()?)
    }

    fn plain<'a>(&self, tree: &'a Tree, settings: MeshSettings, bark: Option<&'a Block>) -> Mesher<'a> {
        let mesher = Mesher::new(tree, settings);
        if let Some(bark) = bark { mesher.with_welded_bark(bark) } else { mesher }
    }

    /// PNG files that leaves, blossom and billboards show.
    fn pictures(
        &self,
        tree: &Tree,
        palette: &Palette,
        billboards: Option<&Billboards>,
    ) -> anyhow::Result<Vec<(Material, Vec<u8>)>> {
        let mut pictures = Vec::new();
        if self.leaves == Leaves::Cards {
            for (material, picture) in leaf_picture::of(tree, palette) {
                pictures.push((material, png_file::bytes(&picture)?));
            }
        }
        if let Some(billboards) = billboards {
            pictures.push((Material::Card, png_file::bytes(&billboards.picture)?));
        }
        Ok(pictures)
    }

    fn write_glb(
        &self,
        path: &Path,
        species: &Species,
        seed: u64,
        tree: &Tree,
        palette: Palette,
    ) -> anyhow::Result<()> {
        let levels = lod::levels(tree, self.settings(), self.lod);
        let rig = self.sway.then(|| Rig::of(tree));
        let billboards = self.billboard.map(|sides| Billboards::paint(&[tree], &palette, sides));
        let bark = self.welded(tree)?;
        let mut meshers = self.meshers(&levels, rig.as_ref());
        if let Some(bark) = &bark {
            meshers = meshers.into_iter().map(|mesher| mesher.with_welded_bark(bark)).collect();
        }
        meshers.extend(billboards.iter().map(|b| Mesher::of_cards(tree, &b.cards[0])));
        let scene = Scene {
            name: species.name.clone(),
            palette,
            extras: extras(species, json!(seed)),
            placed: vec![Placed::at_origin(&species.name, meshers.len())],
            rig: rig.as_ref(),
            pictures: self.pictures(tree, &palette, billboards.as_ref())?,
        };
        files::write_whole(path, |file| Ok(send(&meshers, &mut Glb::new(file, &scene))?))
    }

    fn meshers<'a>(&self, levels: &'a [Level<'a>], rig: Option<&'a Rig>) -> Vec<Mesher<'a>> {
        let mesher = |level: &'a Level<'a>| {
            let mut mesher = Mesher::new(&level.tree, level.settings);
            if let Some(rig) = rig {
                mesher = mesher.with_rig(rig);
            }
            if self.leaves == Leaves::Instances { mesher.with_instanced_leaves() } else { mesher }
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
        let suffix = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        self.check(&suffix)?;
        let sites = forest::plant(width, depth, self.spacing, self.variants, seed)?;
        // Only variants that stand somewhere are grown.
        let mut used: Vec<u32> = sites.iter().map(|s| s.variant).collect();
        used.sort_unstable();
        used.dedup();
        let season = self.season.map(Season::from);
        let mut trees = Vec::new();
        let mut palette = None;
        for &variant in &used {
            let mut tree = grow(seed + u64::from(variant))?;
            let colours = Palette::of(species, season);
            colours.dress(&mut tree);
            palette = palette.or(Some(colours));
            trees.push(tree);
        }
        let levels: Vec<Vec<Level<'_>>> =
            trees.iter().map(|tree| lod::levels(tree, self.settings(), self.lod)).collect();
        let palette = palette.context("a forest needs a tree")?;
        let billboards = self.billboard.map(|sides| {
            let trees: Vec<&Tree> = trees.iter().collect();
            Billboards::paint(&trees, &palette, sides)
        });
        let mut meshers: Vec<Mesher<'_>> = Vec::new();
        for (i, levels) in levels.iter().enumerate() {
            meshers.extend(self.meshers(levels, None));
            meshers.extend(billboards.iter().map(|b| Mesher::of_cards(&trees[i], &b.cards[i])));
        }
        let each = self.lod as usize + usize::from(billboards.is_some());
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
        files::write_whole(path, |file| Ok(send(&meshers, &mut Glb::new(file, &scene))?))?;
        Ok(sites.len())
    }

    fn write_obj(&self, path: &Path, species: &Species, tree: &Tree, palette: Palette) -> anyhow::Result<()> {
        let materials = path.with_extension("mtl");
        let name = materials.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let bark = self.welded(tree)?;
        let settings = MeshSettings { wind: false, ..self.settings() };
        let meshers = [self.plain(tree, settings, bark.as_ref())];
        files::write_whole(path, |file| Ok(send(&meshers, &mut obj::Obj::new(file, &species.name, &name))?))?;
        let pictures = self.pictures_beside(path, tree, &palette)?;
        files::write_text(&materials, &obj::materials(&palette, &pictures))
    }

    fn write_usda(
        &self,
        path: &Path,
        species: &Species,
        seed: u64,
        tree: &Tree,
        palette: Palette,
    ) -> anyhow::Result<()> {
        let bark = self.welded(tree)?;
        let settings = MeshSettings { wind: false, ..self.settings() };
        let meshers = [self.plain(tree, settings, bark.as_ref()).with_instanced_leaves()];
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
        files::write_whole(path, |file| Ok(send(&meshers, &mut usda::Usda::new(file, &notes, palette))?))
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

/// Species, parameters and seed, for whoever finds the file without its history.
fn extras(species: &Species, seed: Value) -> Value {
    let space = species.generator.space();
    let parameters: Map<String, Value> = space
        .params()
        .iter()
        .enumerate()
        .map(|(i, param)| {
            let values = species.params.of(space, i);
            let value = if let [one] = values { json!(one) } else { json!(values) };
            (param.name.to_string(), value)
        })
        .collect();
    json!({
        "species": species.name,
        "generator": species.generator.family(),
        "seed": seed,
        "units": "metres",
        "parameters": parameters,
    })
}
