//! Meshes for `pleach grow`: what was asked for, and the files.

use super::format::Format;
use crate::choice::{Choice, one_of};
use crate::{files, output};
use anyhow::{Context, bail};
use pleach::{Compression, Export, Forest, LeafForm, MeshFormat, Written};
use pleach_mesh::lod;
use pleach_mesh::weld::WeldSettings;
use pleach_mesh::write::glb::level_name;
use pleach_render::{bark_picture, billboard};
use pleach_tree::Season;
use pleach_tree::{Foliage, GrowError, Species, Tree};
use std::io::Write;
use std::path::Path;

pub(super) const SEASONS: &[Choice<Season>] = &[
    (Season::Spring.name(), "", Season::Spring),
    (Season::Summer.name(), "", Season::Summer),
    (Season::Autumn.name(), "", Season::Autumn),
    (Season::Winter.name(), "", Season::Winter),
];

const LEAVES: &[Choice<LeafForm>] = &[
    (LeafForm::Outline.name(), "Their outlines", LeafForm::Outline),
    (LeafForm::Simple.name(), "Two triangles each", LeafForm::Simple),
    (LeafForm::Cards.name(), "Two crossed cards each, which show a picture of the leaf", LeafForm::Cards),
    (
        LeafForm::Instances.name(),
        "One leaf, placed many times (EXT_mesh_gpu_instancing in .glb); always so in .usda",
        LeafForm::Instances,
    ),
    (LeafForm::None.name(), "No leaves and no blossom", LeafForm::None),
];

const COMPRESSIONS: &[Choice<Compression>] = &[(
    Compression::Quantize.name(),
    "Positions and texture coordinates of 16 bits, normals of 8 (KHR_mesh_quantization)",
    Compression::Quantize,
)];

/// Options of mesh files.
#[derive(Clone, Debug, clap::Args)]
#[command(next_help_heading = "Meshes (.glb, .obj, .ply, .stl, .usda)")]
pub(crate) struct MeshArgs {
    /// Every leaf and twig, in however many triangles, where a .glb would otherwise have 50,000 at most and pictures of
    /// bark and leaves. Other formats are so by themselves
    #[arg(long, conflicts_with = "triangles")]
    pub(super) finest: bool,
    /// Levels of detail of fixed coarseness in a .glb, every leaf and twig the finest
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(lod::MAX_LEVELS)))]
    pub(super) lod: Option<u32>,
    /// Levels of detail of so many triangles each, such as 30000,8000,2000: one or, in a .glb, up to 6. Where leaves
    /// have no room, twigs become cards that show pictures of them (.glb, .obj, .usda)
    #[arg(long, value_name = "N,…", value_delimiter = ',', value_parser = budget, conflicts_with_all = ["lod", "sway"])]
    pub(super) triangles: Vec<u32>,
    /// Write each level of detail into a file of its own, NAME_LOD0 and so on
    #[arg(long, conflicts_with = "forest")]
    pub(super) lod_files: bool,
    /// Hang coarser levels on the finest by MSFT_lod, out of sight, instead of putting all of them into the scene as
    /// NAME_LOD0, NAME_LOD1, … (.glb)
    #[arg(long, conflicts_with = "lod_files")]
    pub(super) lod_extension: bool,
    /// Weld all stems into one surface, on a grid with cells of this many millimetres; what is thinner becomes as thick as
    /// a cell. It is watertight unless --textures cut it. With --triangles stems thinner than a cell stay tubes
    #[arg(long, value_name = "MM", value_parser = cell, conflicts_with_all = ["lod", "sway", "growth", "pivot_painter", "forest", "tolerance"])]
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
    /// How far bark may stray from its true surface, in millimetres [default: 2, or as --triangles allow]
    #[arg(long, value_name = "MM", value_parser = tolerance)]
    pub(super) tolerance: Option<f64>,
    /// How leaves are drawn [default: outline, or as --triangles allow]
    #[arg(long, value_parser = one_of(LEAVES), value_name = "HOW", conflicts_with = "no_leaves")]
    pub(super) leaves: Option<LeafForm>,
    /// Pictures of bark and leaves of so many pixels a side: colour and normals, of bark also roughness and occlusion, in
    /// the file or beside it (.glb, .obj, .usda) [default: 1024 in a .glb]
    #[arg(long, value_name = "512|1024|2048|none", value_parser = textures)]
    pub(super) textures: Option<u32>,
    /// Make the file smaller (.glb); gltfpack makes it smaller still, for pages
    #[arg(long, value_parser = one_of(COMPRESSIONS), value_name = "HOW", conflicts_with_all = ["wind", "growth", "pivot_painter", "sway"])]
    pub(super) compress: Option<Compression>,
    /// Season; by default the species file's own, or summer with all its blossom
    #[arg(long, value_parser = one_of(SEASONS))]
    pub(super) season: Option<Season>,
    /// Give each vertex the data that shaders need for wind (.glb, .ply)
    #[arg(long)]
    pub(super) wind: bool,
    /// Give each vertex the data that shaders need to let the tree grow (.glb, .ply)
    #[arg(long, conflicts_with = "wind")]
    pub(super) growth: bool,
    /// Give each vertex a pixel of two textures, NAME-pivots.exr and NAME-axes.png, by which Unreal's material functions
    /// "Pivot Painter 2" move trunks, limbs and twigs in wind (.glb)
    #[arg(long, conflicts_with_all = ["wind", "growth", "sway", "forest"])]
    pub(super) pivot_painter: bool,
    /// Add joints and a looping animation of the tree in wind (.glb)
    #[arg(long, conflicts_with_all = ["lod", "forest", "billboard"])]
    pub(super) sway: bool,
    /// Add up to 32 convex pieces around trunk and thick limbs that things bump into, as meshes UCX_NAME_00 and so on
    /// (.glb)
    #[arg(long, conflicts_with = "forest")]
    pub(super) collision: bool,
    /// A forest on a field of this size in metres, such as 40x40m, instead of one tree (.glb)
    #[arg(long, value_name = "WxD", value_parser = field)]
    pub(super) forest: Option<(f64, f64)>,
    /// Give each tree of a forest a node of its own, instead of one for all that look alike (EXT_mesh_gpu_instancing)
    #[arg(long, requires = "forest")]
    separate: bool,
    /// Metres between the trees of a forest
    #[arg(long, value_name = "METRES", default_value_t = 6.0, requires = "forest")]
    spacing: f64,
    /// Different trees in a forest
    #[arg(long, value_name = "N", default_value_t = 4, requires = "forest", value_parser = clap::value_parser!(u32).range(1..=i64::from(Forest::MAX_VARIANTS)))]
    variants: u32,
}

fn budget(text: &str) -> Result<u32, String> {
    let (least, most) = (lod::BUDGETS.start(), lod::BUDGETS.end());
    let budget = text.parse().ok().filter(|budget| lod::BUDGETS.contains(budget));
    budget.ok_or_else(|| format!("triangles from {least} to {most}"))
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

fn textures(text: &str) -> Result<u32, String> {
    let sides = bark_picture::SIDES;
    let side = if text == "none" { Some(0) } else { text.parse().ok().filter(|side| sides.contains(side)) };
    side.ok_or_else(|| format!("pixels: {}, or none", sides.map(|side| side.to_string()).join(", ")))
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

    /// Whether trees are grown with leaves, if `--leaves` is given.
    pub(super) fn foliage(&self) -> Option<Foliage> {
        let leaves = self.leaves?;
        Some(if leaves == LeafForm::None { Foliage::None } else { Foliage::All })
    }

    /// What was asked for, in the library's terms.
    pub(super) fn export(&self) -> Export {
        let usual = Export::default();
        Export {
            finest: self.finest,
            lod: self.lod,
            triangles: self.triangles.clone(),
            level: None,
            lod_extension: self.lod_extension,
            billboard: self.billboard.unwrap_or(usual.billboard),
            tolerance: self.tolerance,
            weld: self.weld,
            fillet: self.fillet.unwrap_or(usual.fillet),
            roots: self.roots,
            leaves: self.leaves,
            textures: self.textures,
            compress: self.compress,
            season: self.season,
            wind: self.wind,
            growth: self.growth,
            pivot_painter: self.pivot_painter,
            sway: self.sway,
            collision: self.collision,
        }
    }

    /// Fails if files beside the one at `path` are needed: standard output has no place for them.
    pub(super) fn check_alone(&self, path: &Path, format: Format) -> anyhow::Result<()> {
        let Format::Mesh(format) = format else { return Ok(()) };
        let is_glb = format == MeshFormat::Glb;
        if is_glb && self.pivot_painter && files::is_stdout(path) {
            bail!("`--pivot-painter` writes textures beside the file, which standard output cannot have");
        }
        if is_glb {
            return Ok(());
        }
        let option = if self.leaves == Some(LeafForm::Cards) {
            "--leaves cards"
        } else if self.textures.is_some_and(|side| side > 0) {
            "--textures"
        } else if !self.triangles.is_empty() {
            "--triangles"
        } else {
            return Ok(());
        };
        if files::is_stdout(path) {
            bail!(
                "`{option}` writes pictures beside a .{}, which standard output cannot have; .glb holds them",
                format.suffix()
            );
        }
        Ok(())
    }

    /// Writes a tree as a mesh to `path`, or to standard output where it is `-`, and the files that the mesh names
    /// beside it.
    pub(super) fn write(
        &self,
        path: &Path,
        format: MeshFormat,
        species: &Species,
        seed: u64,
        tree: &Tree,
    ) -> anyhow::Result<()> {
        self.check_alone(path, Format::Mesh(format))?;
        let export = self.export();
        if !self.lod_files {
            return write_one(path, format, &export, species, seed, tree);
        }
        if files::is_stdout(path) {
            bail!("`--lod-files` writes several files, which standard output cannot have");
        }
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        for level in 0..export.level_count() {
            let name = format!("{}.{}", level_name(&stem, level as usize), format.suffix());
            let export = Export { level: Some(level), ..export.clone() };
            write_one(&path.with_file_name(name), format, &export, species, seed, tree)?;
        }
        Ok(())
    }

    /// Grows a few trees, from `seed` on, and writes a forest of them. Returns how many stand there.
    pub(crate) fn write_forest(
        &self,
        path: &Path,
        species: &Species,
        seed: u64,
        grow: impl Fn(u64) -> Result<Tree, GrowError>,
    ) -> anyhow::Result<usize> {
        let (width, depth) = self.forest.context("no forest was asked for")?;
        let (spacing, variants, separate) = (self.spacing, self.variants, self.separate);
        let forest = Forest { width, depth, spacing, variants, separate };
        let mut written = Written::default();
        files::write_out(path, |out| {
            written = self.export().write_forest(&forest, species, seed, grow, out)?;
            Ok(())
        })?;
        written.note.iter().for_each(output::note);
        Ok(written.trees)
    }
}

/// Writes a mesh to `path` and the files that it names beside it.
fn write_one(
    path: &Path,
    format: MeshFormat,
    export: &Export,
    species: &Species,
    seed: u64,
    tree: &Tree,
) -> anyhow::Result<()> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let stem = (!files::is_stdout(path)).then_some(&*stem);
    let mut written = Written::default();
    files::write_out(path, |out| {
        written = export.write(format, species, seed, tree, stem, out)?;
        Ok(())
    })?;
    written.note.iter().for_each(output::note);
    for file in written.beside {
        files::write_whole(&path.with_file_name(&file.name), |out| Ok(out.write_all(&file.bytes)?))?;
    }
    Ok(())
}
