//! One tree as a file.

use super::ExportError;
use super::extras::extras;
use super::forms::{Compression, LeafForm};
use super::options::Export;
use super::pivots;
use crate::option_error::OptionError;
use pleach_mesh::lod::{self, Level};
use pleach_mesh::weld::{Skin, WeldSettings};
use pleach_mesh::write::glb::{Glb, Grid, Placed, Scene, Site, level_name};
use pleach_mesh::write::{Format, obj, ply, stl, usda};
use pleach_mesh::{
    Card, Cards, Collision, LeafStyle, Material, Mesher, Palette, Pictures, Pivots, Prism, Rig, Source,
    Welded, blobs_have_tiles, send,
};
use pleach_render::picture::Relief;
use pleach_render::{Billboards, Picture, bark_picture, blob_picture, leaf_atlas, png_file, twig_sheet};
use pleach_tree::{Species, Tree};
use serde_json::json;
use std::io::{Cursor, Seek, Write};

/// A small file that stands beside a mesh file: materials or a picture, which it names, or a texture of pivots.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Beside {
    /// Its name.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
}

/// What was written, apart from the mesh file itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Written {
    /// The files that belong to the mesh file.
    pub beside: Vec<Beside>,
    /// How many trees stand in it.
    pub trees: usize,
    /// What the user is to be told: that the tree is written whole, since it does not fit into
    /// [`Export::USUAL_TRIANGLES`].
    pub note: Option<String>,
}

/// A mesh in memory, with the files beside it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedFile {
    /// What the mesh file holds.
    pub bytes: Vec<u8>,
    /// The files that belong to it.
    pub beside: Vec<Beside>,
    /// What the user is to be told, as of [`Written::note`].
    pub note: Option<String>,
}

/// Pixels a side of the pictures of leaves that are cards, where no other size is asked for.
const CARDS_SIDE: u32 = 512;

/// What meshes `level`, with `skin` in the place of the tubes that it stands for.
fn source<'a>(
    level: &'a Level<'a>,
    skin: Option<&'a Skin>,
    change: impl FnOnce(Mesher<'a>) -> Mesher<'a>,
) -> Box<dyn Source + 'a> {
    match skin {
        Some(skin) => Box::new(Welded::new(skin, change(level.mesher_without(&skin.stems)))),
        None => Box::new(change(level.mesher())),
    }
}

pub(super) fn cards(cards: &[Card]) -> Box<dyn Source + '_> {
    Box::new(Cards(cards))
}

impl Export {
    /// Writes `tree`, which `species` has grown from `seed`, to `out`, an empty and buffered file. What the tree does
    /// not wear in the season is left out. Options that are left open are filled in as [`Export`] says.
    ///
    /// `stem` is the name of the file without its suffix. With it an OBJ or USDA file names its materials and pictures,
    /// which are returned and are to be written into the same folder; without it, as on a stream, there are none. Textures
    /// of `pivot_painter` are returned too; without a name for them there is an error.
    ///
    /// # Errors
    /// An [`ExportError`]: options that [`Export::check`] refuses, a mesh that cannot be made or written. `out` may
    /// then hold a part of the file.
    pub fn write<W: Write + Seek + ?Sized>(
        &self,
        format: Format,
        species: &Species,
        seed: u64,
        tree: &Tree,
        stem: Option<&str>,
        out: &mut W,
    ) -> Result<Written, ExportError> {
        self.check(format)?;
        let palette = self.palette(species);
        let tree = &*palette.dressed(tree);
        let Planned { export, levels, note } = self.planned(format, &[tree])?;
        let export = &export;
        let skins = export.skins(&levels[0])?;
        let one = One { export, species, seed, tree, levels: &levels, palette, skins: &skins, stem };
        let mut beside = Vec::new();
        match format {
            Format::Glb => beside = one.write_glb(out)?,
            Format::Obj => beside = one.write_obj(out)?,
            Format::Ply => send(&[one.source(|mesher| mesher)], &mut ply::Ply::new(out, palette))?,
            Format::Stl => send(&[one.source(|mesher| mesher)], &mut stl::Stl::new(out))?,
            Format::Usda => beside = one.write_usda(out)?,
        }
        Ok(Written { beside, trees: 1, note })
    }

    /// The same in memory.
    ///
    /// # Errors
    /// As of [`Export::write`].
    pub fn to_file(
        &self,
        format: Format,
        species: &Species,
        seed: u64,
        tree: &Tree,
        stem: &str,
    ) -> Result<ExportedFile, ExportError> {
        let mut out = Cursor::new(Vec::new());
        let Written { beside, note, .. } = self.write(format, species, seed, tree, Some(stem), &mut out)?;
        Ok(ExportedFile { bytes: out.into_inner(), beside, note })
    }

    /// The welded stems of each level, where that is asked for: all of them, or, within a budget, the thick ones.
    pub(super) fn skins(&self, levels: &[Level<'_>]) -> Result<Vec<Skin>, ExportError> {
        let Some(cell) = self.weld else { return Ok(Vec::new()) };
        let settings =
            WeldSettings { fillet: self.fillet, parts: self.parts(), ..WeldSettings::new(cell / 1000.0) };
        let has_pictures = self.side().is_some();
        let weld = |level: &Level<'_>| {
            if self.triangles.is_empty() {
                return Skin::whole(&level.tree, &settings, has_pictures);
            }
            Skin::of_level(level, &settings, has_pictures)
        };
        Ok(levels.iter().map(weld).collect::<Result<_, _>>()?)
    }

    /// One mesh for each level.
    pub(super) fn sources<'a>(
        &self,
        levels: &'a [Level<'a>],
        rig: Option<&'a Rig>,
        pivots: Option<&Pivots>,
        skins: &'a [Skin],
    ) -> Vec<Box<dyn Source + 'a>> {
        let change = |mut mesher: Mesher<'a>| {
            if let Some(rig) = rig {
                mesher = mesher.with_rig(rig);
            }
            if let Some(pivots) = pivots {
                mesher = mesher.with_pivots(pivots);
            }
            if self.leaf_form() == LeafForm::Instances {
                mesher = mesher.with_instanced_leaves();
            }
            mesher
        };
        let numbered = levels.iter().enumerate();
        numbered.map(|(number, level)| source(level, skins.get(number), change)).collect()
    }

    /// What is written of `trees`.
    pub(super) fn planned<'a>(&self, format: Format, trees: &[&'a Tree]) -> Result<Planned<'a>, ExportError> {
        let export = self.completed(format);
        match export.levels(trees) {
            Err(ExportError::Budget(too_few)) if self.has_usual_budget(format) => {
                let export = Self { triangles: Vec::new(), ..export };
                let levels = export.levels(trees)?;
                Ok(Planned { export, levels, note: Some(format!("{too_few}; so it is written whole")) })
            }
            levels => Ok(Planned { export, levels: levels?, note: None }),
        }
    }

    /// The levels of detail that are written of each of `trees`.
    pub(super) fn levels<'a>(&self, trees: &[&'a Tree]) -> Result<Vec<Vec<Level<'a>>>, ExportError> {
        let all = 0..self.tree_levels();
        let shown = self.level.map_or(all.clone(), |level| level..level + 1);
        let shown = shown.start.min(all.end)..shown.end.min(all.end);
        if !self.triangles.is_empty() {
            let budgets = &self.triangles[shown.start as usize..shown.end as usize];
            return Ok(lod::budgets(trees, self.settings(), budgets)?);
        }
        let of_tree =
            |tree: &&'a Tree| shown.clone().map(|level| lod::level(tree, self.settings(), level)).collect();
        Ok(trees.iter().map(of_tree).collect())
    }

    /// What whole numbers stand for in a file of `sources` that is to be small.
    pub(super) fn grid(&self, sources: &[Box<dyn Source + '_>]) -> Result<Option<Grid>, ExportError> {
        Ok(match self.compress {
            Some(Compression::Quantize) => Some(Grid::new(sources)?),
            None => None,
        })
    }

    /// Cards that show each of `trees`, where they are asked for.
    pub(super) fn billboards(&self, trees: &[&Tree], palette: &Palette) -> Option<Billboards> {
        let billboards = self.shows_billboard().then(|| Billboards::paint(trees, palette, self.billboard));
        billboards.filter(|billboards| !billboards.is_empty())
    }

    /// PNG files that bark, leaves, blossom, twigs and billboards show.
    pub(super) fn pictures(
        &self,
        trees: &[&Tree],
        levels: &[Vec<Level<'_>>],
        palette: &Palette,
        billboards: Option<&Billboards>,
    ) -> Result<Vec<Pictures<Vec<u8>>>, ExportError> {
        let mut pictures = Vec::new();
        if let Some(side) = self.side() {
            pictures.push(bark_picture::bark(palette.pattern, palette.bark, side));
            if self.leaf_form() != LeafForm::None && trees.iter().any(|tree| blobs_have_tiles(tree)) {
                pictures.push(blob_picture::foliage(palette.leaf, side));
            }
        }
        // Of a level with cards for twigs no leaf is drawn by itself.
        let has_leaves = |level: &Level<'_>| level.settings.leaves != LeafStyle::None;
        if self.shows_leaves() && levels.iter().flatten().any(has_leaves) {
            let side = self.side().unwrap_or(CARDS_SIDE);
            let is_cut_out = levels.iter().flatten().any(|level| level.settings.leaves.is_cut_out());
            let sheets = leaf_atlas::paint(trees[0], palette, side, self.relief());
            pictures.extend(sheets.into_iter().map(|s| if is_cut_out { s } else { leaf_atlas::opaque(s) }));
        }
        if lod::painted(trees, levels).next().is_some() {
            pictures.push(twig_sheet::paint(palette, lod::painted(trees, levels)));
        }
        if let Some(billboards) = billboards {
            pictures.push(billboards.pictures.clone());
        }
        as_png(pictures)
    }

    /// Whether pictures of leaves come with their normals.
    fn relief(&self) -> Relief {
        if self.side().is_some() { Relief::Painted } else { Relief::Omitted }
    }
}

/// The same as PNG files.
fn as_png(pictures: Vec<Pictures<Picture>>) -> Result<Vec<Pictures<Vec<u8>>>, ExportError> {
    let all: Vec<&Picture> = pictures.iter().flat_map(|one| one.all().map(|(_, picture)| picture)).collect();
    let mut packed = png_file::all_bytes(&all).map_err(ExportError::Picture)?.into_iter();
    Ok(pictures.into_iter().map(|one| one.map(|_, _| packed.next().unwrap_or_default())).collect())
}

/// Options with nothing left open, and the levels of detail of each tree.
pub(super) struct Planned<'a> {
    pub(super) export: Export,
    pub(super) levels: Vec<Vec<Level<'a>>>,
    /// What the user is to be told.
    pub(super) note: Option<String>,
}

/// A tree on its way into a file.
struct One<'a> {
    export: &'a Export,
    species: &'a Species,
    seed: u64,
    tree: &'a Tree,
    levels: &'a [Vec<Level<'a>>],
    palette: Palette,
    /// The welded stems of each level of the tree, or none.
    skins: &'a [Skin],
    stem: Option<&'a str>,
}

impl One<'_> {
    /// The one level of formats that hold one.
    fn source<'s>(&'s self, change: impl FnOnce(Mesher<'s>) -> Mesher<'s>) -> Box<dyn Source + 's> {
        match self.levels[0].first() {
            Some(level) => source(level, self.skins.first(), change),
            None => Box::new(change(Mesher::new(self.tree, self.export.settings()))),
        }
    }

    fn write_glb<W: Write + Seek + ?Sized>(&self, out: &mut W) -> Result<Vec<Beside>, ExportError> {
        let Self { export, species, tree, levels, palette, .. } = *self;
        let rig = export.sway.then(|| Rig::new(tree));
        let billboards = export.billboards(&[tree], &palette);
        // Engines look for them beside the finest mesh.
        let prisms = if export.collision && export.level.is_none_or(|level| level == 0) {
            Prism::around(tree)
        } else {
            Vec::new()
        };
        let pivots = if export.pivot_painter { Some(Pivots::new(tree)?) } else { None };
        let beside = self.pivots_beside(pivots.as_ref())?;
        let mut sources = export.sources(&levels[0], rig.as_ref(), pivots.as_ref(), self.skins);
        sources.extend(billboards.iter().map(|billboards| cards(&billboards.cards[0])));
        let mut placed = vec![Placed::at_origin(&self.mesh_name(), sources.len())];
        let finest = placed[0].level_name(0);
        for (number, prism) in prisms.iter().enumerate() {
            let name = format!("UCX_{finest}_{number:02}");
            placed.push(Placed { name, meshes: vec![sources.len()], sites: vec![Site::ORIGIN] });
            sources.push(Box::new(Collision(prism)));
        }
        let scene = Scene {
            name: species.name.clone(),
            palette,
            extras: extras(species, json!(self.seed)),
            placed,
            lod_extension: export.lod_extension,
            grid: export.grid(&sources)?,
            rig: rig.as_ref(),
            pictures: export.pictures(&[tree], levels, &palette, billboards.as_ref())?,
        };
        send(&sources, &mut Glb::new(out, &scene))?;
        Ok(beside)
    }

    /// The textures of `pivots`. All levels have the same, so that they are beside the first.
    fn pivots_beside(&self, pivots: Option<&Pivots>) -> Result<Vec<Beside>, ExportError> {
        let is_first = self.export.level.is_none_or(|level| level == 0);
        let Some(pivots) = pivots.filter(|_| is_first) else { return Ok(Vec::new()) };
        let stem = self.stem.ok_or_else(|| {
            OptionError::new("pivot_painter", "has textures beside the file, which a stream cannot have")
        })?;
        let [positions, axes] = pivots::files(pivots)?;
        Ok(vec![
            Beside { name: format!("{stem}-pivots.exr"), bytes: positions },
            Beside { name: format!("{stem}-axes.png"), bytes: axes },
        ])
    }

    /// The tree's name; that of its level where only one of several is written.
    fn mesh_name(&self) -> String {
        let name = &self.species.name;
        self.export.level.map_or_else(|| name.clone(), |level| level_name(name, level as usize))
    }

    fn write_obj<W: Write + ?Sized>(&self, out: &mut W) -> Result<Vec<Beside>, ExportError> {
        let materials = self.stem.map(|stem| format!("{stem}.mtl"));
        let name = materials.as_deref().unwrap_or_default();
        send(&[self.source(|mesher| mesher)], &mut obj::Obj::new(out, &self.mesh_name(), name))?;
        let Some(name) = materials else { return Ok(Vec::new()) };
        let (mut beside, pictures) = self.pictures_beside()?;
        let bytes = obj::materials(&self.palette, &pictures).into_bytes();
        beside.push(Beside { name, bytes });
        Ok(beside)
    }

    fn write_usda<W: Write + ?Sized>(&self, out: &mut W) -> Result<Vec<Beside>, ExportError> {
        let (beside, pictures) = self.pictures_beside()?;
        let about = [
            ("generator", self.species.generator.family().to_owned()),
            ("seed", self.seed.to_string()),
            ("species", self.species.name.clone()),
        ];
        let notes = usda::Notes {
            name: self.mesh_name(),
            about: about.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
            pictures,
        };
        send(&[self.source(Mesher::with_instanced_leaves)], &mut usda::Usda::new(out, &notes, self.palette))?;
        Ok(beside)
    }

    /// The pictures of bark, leaves and blossom, as files and by name.
    fn pictures_beside(&self) -> Result<(Vec<Beside>, Vec<Pictures<String>>), ExportError> {
        let (mut beside, mut names) = (Vec::new(), Vec::new());
        let Some(stem) = self.stem else { return Ok((beside, names)) };
        for pictures in self.export.pictures(&[self.tree], self.levels, &self.palette, None)? {
            let is_shown = match pictures.material {
                Material::Blossom => !self.tree.blossoms.is_empty(),
                Material::Leaf => !self.tree.leaves.is_empty() || !self.tree.blobs.is_empty(),
                Material::Bark | Material::Twig | Material::Card | Material::Collision => true,
            };
            if !is_shown {
                continue;
            }
            let material = pictures.material.name();
            names.push(pictures.try_map(|what, bytes| {
                let name = match what {
                    "color" => format!("{stem}-{material}.png"),
                    what => format!("{stem}-{material}-{what}.png"),
                };
                beside.push(Beside { name: name.clone(), bytes });
                Ok::<String, ExportError>(name)
            })?);
        }
        Ok((beside, names))
    }
}
