//! Triangles for the screen.

use crate::error::thrown;
use glam::Vec3;
use pleach::{LeafStyle, Material, Mesh, MeshError, MeshSettings, Palette, Season, Tree, send};
use pleach_mesh::block::Block;
use pleach_mesh::lod;
use pleach_mesh::palette::linear;
use serde_json::json;
use wasm_bindgen::JsError;
use wasm_bindgen::prelude::wasm_bindgen;

/// A season by name; `None` for an empty name.
pub(crate) fn season_named(name: &str) -> Result<Option<Season>, JsError> {
    if name.is_empty() {
        return Ok(None);
    }
    let known = || thrown(format!("`{name}` is not a season, expected {}", Season::NAMES.join(", ")));
    Season::from_name(name).map(Some).ok_or_else(known)
}

/// How leaves are drawn, and whether they show their cells of the sheet that GLB files have.
fn leaf_style(name: &str) -> Result<(LeafStyle, bool), JsError> {
    Ok(match name {
        "outline" => (LeafStyle::Outline, false),
        "simple" => (LeafStyle::Simple, false),
        "cards" => (LeafStyle::CrossedCards, false),
        "pictured" => (LeafStyle::Card, true),
        "none" => (LeafStyle::None, false),
        _ => {
            let expected = "outline, simple, cards, pictured or none";
            return Err(thrown(format!("leaves are `{name}`, expected {expected}")));
        }
    })
}

/// Vertices and triangles as a graphics card takes them: metres, y up.
#[wasm_bindgen]
pub struct MeshBuffers {
    parts: String,
    positions: Vec<f32>,
    normals: Vec<f32>,
    wind: Vec<f32>,
    uv: Vec<f32>,
    indices: Vec<u32>,
    level: u32,
    wanted: u32,
}

#[wasm_bindgen]
impl MeshBuffers {
    /// Runs of indices with a material each: JSON.
    #[must_use]
    pub fn parts(&self) -> String {
        self.parts.clone()
    }

    /// Three numbers per vertex.
    #[must_use]
    pub fn positions(&self) -> Vec<f32> {
        self.positions.clone()
    }

    /// Three numbers per vertex, of length 1.
    #[must_use]
    pub fn normals(&self) -> Vec<f32> {
        self.normals.clone()
    }

    /// Four numbers per vertex: how far it sways (0 at the foot, 1 at the top), the phase of its stem in turns, how far
    /// it flutters in metres (leaves), and the level of its stem, 0 to 2.
    #[must_use]
    pub fn wind(&self) -> Vec<f32> {
        self.wind.clone()
    }

    /// Two numbers per vertex: places in the pictures of GLB files.
    #[must_use]
    pub fn uv(&self) -> Vec<f32> {
        self.uv.clone()
    }

    /// The level of detail: a coarser one than was asked for where that has too many vertices.
    #[must_use]
    pub fn level(&self) -> u32 {
        self.level
    }

    /// The triangles of the level that was asked for.
    #[must_use]
    pub fn wanted_triangles(&self) -> u32 {
        self.wanted
    }

    /// None: colours are those of the parts.
    #[must_use]
    pub fn colors(&self) -> Vec<f32> {
        Vec::new()
    }

    /// Three vertices per triangle.
    #[must_use]
    pub fn indices(&self) -> Vec<u32> {
        self.indices.clone()
    }

    /// The number of triangles.
    #[must_use]
    pub fn triangles(&self) -> u32 {
        (self.indices.len() / 3) as u32
    }

    /// The number of vertices.
    #[must_use]
    pub fn vertices(&self) -> u32 {
        (self.positions.len() / 3) as u32
    }
}

/// How far bark may stray on the screen, in metres.
const TOLERANCE: f64 = 0.002;

/// Times the tolerance of the coarsest level, one after the other, where that has too many vertices: at the end bark may
/// stray by metres, and only the thickest stems are left.
const COARSER: [f64; 4] = [4.0, 16.0, 64.0, 256.0];

/// Level `level` of the tree if it has at most `most` vertices, or else the finest coarser one that has; beyond the
/// coarsest, stems that are thinner and thinner go. Beside it are the number of that level, and the triangles of what was
/// asked for.
fn fitting(tree: &Tree, settings: MeshSettings, level: u32, most: u64) -> (lod::Level<'_>, u32, u32) {
    let last = lod::MAX_LEVELS - 1;
    let asked = level.min(last);
    let coarser = |times: f64| MeshSettings { tolerance: settings.tolerance * times, ..settings };
    let levels = (asked..=last).map(|level| (level, settings));
    let levels = levels.chain(COARSER.map(|times| (last, coarser(times))));
    let mut wanted = None;
    let mut found = None;
    for (level, settings) in levels {
        let made = lod::level(tree, settings, level);
        let count = made.mesher().count();
        let wanted = *wanted.get_or_insert(count.triangles);
        found = Some((made, level, u32::try_from(wanted).unwrap_or(u32::MAX)));
        if count.vertices <= most {
            break;
        }
    }
    found.unwrap_or_else(|| (lod::level(tree, settings, last), last, 0))
}

pub(crate) fn buffers(
    tree: &Tree,
    palette: &Palette,
    leaves: &str,
    level: u32,
    most: u32,
) -> Result<MeshBuffers, JsError> {
    let (leaves, pictured) = leaf_style(leaves)?;
    let settings =
        MeshSettings { tolerance: TOLERANCE, leaves, pictured, wind: true, ..MeshSettings::default() };
    let (made, level, wanted) = fitting(tree, settings, level, most.into());
    let mut mesh = Mesh::default();
    match send(&[made.mesher()], &mut mesh) {
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
        uv: Vec::new(),
        indices: Vec::new(),
        level,
        wanted,
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
        buffers.append(block, top);
    }
    buffers.parts = json!(parts).to_string();
    Ok(buffers)
}

/// The axes of files and screens: y is up, z comes towards the viewer.
fn turned(v: Vec3) -> [f32; 3] {
    [v.x, v.z, -v.y]
}

impl MeshBuffers {
    fn append(&mut self, block: &Block, top: f32) {
        let first = self.vertices();
        for vertex in &block.vertices {
            self.positions.extend(turned(vertex.position));
            self.normals.extend(turned(vertex.normal));
            self.uv.extend(vertex.uv.to_array());
        }
        for (wind, vertex) in block.wind.iter().zip(&block.vertices) {
            let sway = (vertex.position.z / top).clamp(0.0, 1.0);
            self.wind.extend([sway * sway, wind.phase, wind.flutter, wind.level]);
        }
        self.indices.extend(block.triangles.iter().flatten().map(|corner| first + corner));
    }
}
