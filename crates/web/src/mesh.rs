//! Triangles for the screen and for files.

use crate::error::thrown;
use glam::Vec3;
use pleach::extras;
use pleach::{LeafStyle, Material, Mesh, MeshError, MeshSettings, Mesher, Palette, Season, Tree, send};
use pleach_mesh::block::{Block, Wind};
use pleach_mesh::lod;
use pleach_mesh::palette::linear;
use pleach_mesh::write::glb::{Glb, Placed, Scene};
use pleach_mesh::write::{obj, ply, stl, usda};
use pleach_render::{leaf_picture, png_file};
use serde_json::json;
use std::io::Cursor;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// A season by name; none for an empty one.
pub(crate) fn season_named(name: &str) -> Result<Option<Season>, JsError> {
    if name.is_empty() {
        return Ok(None);
    }
    let known = || thrown(format!("there is no season `{name}`, expected {}", Season::NAMES.join(", ")));
    Season::from_name(name).map(Some).ok_or_else(known)
}

pub(crate) fn leaf_style(name: &str) -> Result<LeafStyle, JsError> {
    Ok(match name {
        "outline" => LeafStyle::Outline,
        "simple" => LeafStyle::Simple,
        "cards" => LeafStyle::CrossedCards,
        "none" => LeafStyle::None,
        _ => return Err(thrown(format!("leaves are `{name}`, expected outline, simple, cards or none"))),
    })
}

/// Corners and triangles as a graphics card takes them: metres, y up.
#[wasm_bindgen]
pub struct MeshBuffers {
    parts: String,
    positions: Vec<f32>,
    normals: Vec<f32>,
    wind: Vec<f32>,
    indices: Vec<u32>,
}

#[wasm_bindgen]
impl MeshBuffers {
    /// Runs of indices with a material each: JSON.
    #[must_use]
    pub fn parts(&self) -> String {
        self.parts.clone()
    }

    /// Three numbers a corner.
    #[must_use]
    pub fn positions(&self) -> Vec<f32> {
        self.positions.clone()
    }

    /// Three numbers a corner, of length 1.
    #[must_use]
    pub fn normals(&self) -> Vec<f32> {
        self.normals.clone()
    }

    /// Four numbers a corner: how far it sways (0 at the foot, 1 at the top), the phase of its stem in turns, how far
    /// it flutters (leaves), and the level of its stem.
    #[must_use]
    pub fn wind(&self) -> Vec<f32> {
        self.wind.clone()
    }

    /// None: colours are those of the parts.
    #[must_use]
    pub fn colors(&self) -> Vec<f32> {
        Vec::new()
    }

    /// Three corners a triangle.
    #[must_use]
    pub fn indices(&self) -> Vec<u32> {
        self.indices.clone()
    }

    /// How many triangles.
    #[must_use]
    pub fn triangles(&self) -> u32 {
        (self.indices.len() / 3) as u32
    }

    /// How many corners.
    #[must_use]
    pub fn vertices(&self) -> u32 {
        (self.positions.len() / 3) as u32
    }
}

/// How far bark may stray on the screen, in metres.
const TOLERANCE: f64 = 0.002;

pub(crate) fn buffers(
    tree: &Tree,
    palette: &Palette,
    leaves: LeafStyle,
    level: u32,
) -> Result<MeshBuffers, JsError> {
    let settings = MeshSettings { tolerance: TOLERANCE, leaves, wind: true, ..MeshSettings::default() };
    let level = lod::level(tree, settings, level.min(lod::MAX_LEVELS - 1));
    let mut mesh = Mesh::default();
    match send(&[Mesher::new(&level.tree, level.settings)], &mut mesh) {
        Ok(()) | Err(MeshError::Empty) => {}
        Err(error) => return Err(thrown(error)),
    }
    let corners = mesh.parts.iter().flat_map(|(_, block)| &block.vertices);
    let top = corners.map(|vertex| vertex.position.z).fold(1e-3, f32::max);
    let mut buffers = MeshBuffers {
        parts: String::new(),
        positions: Vec::new(),
        normals: Vec::new(),
        wind: Vec::new(),
        indices: Vec::new(),
    };
    let mut parts = Vec::new();
    for (part, block) in &mesh.parts {
        parts.push(json!({
            "material": part.material.name(),
            "color": palette.color(part.material).0.map(|channel| f32::from(channel) / 255.0),
            "linear": linear(palette.color(part.material)),
            "double_sided": part.material != Material::Bark,
            "first": buffers.indices.len(),
            "count": 3 * block.triangles.len(),
        }));
        buffers.append(block, part.material, top);
    }
    buffers.parts = json!(parts).to_string();
    Ok(buffers)
}

/// The axes of files and screens: y is up, z comes towards the viewer.
fn turned(v: Vec3) -> [f32; 3] {
    [v.x, v.z, -v.y]
}

impl MeshBuffers {
    fn append(&mut self, block: &Block, material: Material, top: f32) {
        let first = self.vertices();
        for vertex in &block.vertices {
            self.positions.extend(turned(vertex.position));
            self.normals.extend(turned(vertex.normal));
        }
        for (Wind { phase, level, place, .. }, vertex) in block.wind.iter().zip(&block.vertices) {
            let sway = (vertex.position.z / top).clamp(0.0, 1.0);
            let flutter = if material == Material::Bark { 0.0 } else { *place };
            self.wind.extend([sway * sway, *phase, flutter, *level]);
        }
        self.indices.extend(block.triangles.iter().flatten().map(|corner| first + corner));
    }
}

/// A tree, dressed for its season, on its way into a file.
pub(crate) struct File<'a> {
    pub(crate) species: &'a pleach::Species,
    pub(crate) seed: u64,
    pub(crate) tree: &'a Tree,
    pub(crate) palette: Palette,
    pub(crate) levels: u32,
    pub(crate) style: LeafStyle,
    pub(crate) wind: bool,
}

impl File<'_> {
    pub(crate) fn bytes(&self, format: &str) -> Result<Vec<u8>, JsError> {
        let Self { species, tree, palette, style, wind, .. } = *self;
        let settings = MeshSettings { tolerance: TOLERANCE, leaves: style, wind, ..MeshSettings::default() };
        let meshers = || [Mesher::new(tree, settings)];
        let materials = format!("{}.mtl", species.name);
        let mut out = Cursor::new(Vec::new());
        match format {
            "glb" => self.write_glb(settings, &mut out)?,
            "obj" => {
                send(&meshers(), &mut obj::Obj::new(&mut out, &species.name, &materials)).map_err(thrown)?
            }
            "mtl" => return Ok(obj::materials(&palette, &[]).into_bytes()),
            "ply" => send(&meshers(), &mut ply::Ply::new(&mut out, palette)).map_err(thrown)?,
            "stl" => send(&meshers(), &mut stl::Stl::new(&mut out)).map_err(thrown)?,
            "usda" => {
                let about = [
                    ("generator", species.generator.family().to_owned()),
                    ("seed", self.seed.to_string()),
                    ("species", species.name.clone()),
                ];
                let notes = usda::Notes {
                    name: species.name.clone(),
                    about: about.map(|(name, value)| (name.to_owned(), value)).into(),
                    pictures: Vec::new(),
                };
                let [mesher] = meshers();
                let sources = [mesher.with_instanced_leaves()];
                send(&sources, &mut usda::Usda::new(&mut out, &notes, palette)).map_err(thrown)?;
            }
            _ => {
                return Err(thrown(format!(
                    "the format is `{format}`, expected glb, obj, mtl, ply, stl or usda"
                )));
            }
        }
        Ok(out.into_inner())
    }

    fn write_glb(&self, settings: MeshSettings, out: &mut Cursor<Vec<u8>>) -> Result<(), JsError> {
        let Self { species, tree, palette, .. } = *self;
        let levels = lod::levels(tree, settings, self.levels.clamp(1, lod::MAX_LEVELS));
        let sources: Vec<Mesher<'_>> =
            levels.iter().map(|one| Mesher::new(&one.tree, one.settings)).collect();
        let mut pictures = Vec::new();
        if self.style == LeafStyle::CrossedCards {
            for (material, picture) in leaf_picture::of(tree, &palette) {
                pictures.push((material, png_file::bytes(&picture).map_err(thrown)?));
            }
        }
        let scene = Scene {
            name: species.name.clone(),
            palette,
            extras: extras(species, json!(self.seed)),
            placed: vec![Placed::at_origin(&species.name, sources.len())],
            rig: None,
            pictures,
        };
        send(&sources, &mut Glb::new(out, &scene)).map_err(thrown)
    }
}
