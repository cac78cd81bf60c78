//! Binary glTF 2.0 (Khronos, ISO/IEC 12113): one file with everything, y up, metres.
//!
//! Sizes are known before the first corner, so the binary chunk is written in place, block by block;
//! the JSON in front of it gets its room at the start and its text, with the bounds, at the end.
//!
//! | what | how |
//! | --- | --- |
//! | corners | interleaved position, normal, texture coordinates; tangents where there is a picture of normals; wind in `TEXCOORD_1` to `TEXCOORD_7`, or growth in `TEXCOORD_1` and `TEXCOORD_2`, or the pixel of an element of [`crate::pivots`] in `TEXCOORD_1` |
//! | materials | plain metallic-roughness colours `bark`, `leaves`, `blossom`; leaves are two-sided; cards show pictures with alpha masks, bark tiles with normals, roughness and occlusion |
//! | corners with a [`Grid`] | positions and texture coordinates of 16 bits, the latter where a picture is shown, normals and tangents of 8 (`KHR_mesh_quantization`, then required); nodes and `KHR_texture_transform` put them where they belong |
//! | levels of detail | nodes and meshes `NAME_LOD0`, `NAME_LOD1`, … under one of the tree's name, all in the scene; or, if asked for, `MSFT_lod` on the node of the finest |
//! | leaves as instances | `EXT_mesh_gpu_instancing`, then required: without it there is no crown |
//! | forests | a node for each mesh, instanced (`EXT_mesh_gpu_instancing`), or many nodes that share few meshes |
//! | sway | a skin of rigid joints with one looping animation |
//! | collision | a node and mesh for each convex piece, beside the tree's |

mod animation;
mod json;
mod layout;
mod materials;
mod quantize;

pub use quantize::Grid;

use crate::block::{Block, Emergence, Placement, Wind};
use crate::mesher::Mesher;
use crate::palette::Palette;
use crate::part::{MeshError, Part, Sink};
use crate::pictures::Pictures;
use crate::rig::Rig;
use crate::settings::MeshSettings;
use crate::stream::send;
use crate::tangents::tangents;
use glam::{Quat, Vec2, Vec3, vec3};
use layout::Layout;
use pleach_plant::Tree;
use std::io::{Seek, SeekFrom, Write};

/// Where a tree stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// In metres, z up.
    pub position: Vec3,
    /// Turn about the vertical, in radians, counter-clockwise from above.
    pub turn: f32,
    /// Size against the mesh.
    pub scale: f32,
}

impl Site {
    /// The origin.
    pub const ORIGIN: Self = Self { position: Vec3::ZERO, turn: 0.0, scale: 1.0 };

    /// The same in the file's axes.
    fn upright(&self) -> Placement {
        Placement {
            translation: upright(self.position),
            rotation: Quat::from_rotation_y(self.turn),
            scale: Vec3::splat(self.scale),
        }
    }
}

/// A tree in a scene, once or many times.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The name of its node and mesh; with `_LOD0`, `_LOD1` and so on behind it where there are levels of detail.
    pub name: String,
    /// Numbers of its meshes from fine to coarse.
    pub meshes: Vec<usize>,
    /// Where it stands; at more than one place it is instanced.
    pub sites: Vec<Site>,
}

impl Placed {
    /// One tree at the origin with meshes 0 to `levels` as its levels of detail.
    #[must_use]
    pub fn at_origin(name: &str, levels: usize) -> Self {
        Self { name: name.to_owned(), meshes: (0..levels).collect(), sites: vec![Site::ORIGIN] }
    }

    fn is_instanced(&self) -> bool {
        self.sites.len() > 1
    }

    /// The name of one of its levels.
    #[must_use]
    pub fn level_name(&self, level: usize) -> String {
        if self.meshes.len() > 1 { level_name(&self.name, level) } else { self.name.clone() }
    }
}

/// The name of a level of detail of a tree of this name, as engines look for it.
#[must_use]
pub fn level_name(name: &str, level: usize) -> String {
    format!("{name}_LOD{level}")
}

/// What a file says beside triangles.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// The scene's name.
    pub name: String,
    /// Colours of the materials.
    pub palette: Palette,
    /// Free data about the scene: species, parameters, seed.
    pub extras: serde_json::Value,
    /// The trees.
    pub placed: Vec<Placed>,
    /// Whether the coarser levels of detail hang on the finest by `MSFT_lod`, outside the scene, instead of standing
    /// in it as nodes.
    pub lod_extension: bool,
    /// What whole numbers stand for, where vertices are to be written as such: that of all meshes, which have no wind
    /// data, growth data, pixels or joints.
    pub grid: Option<Grid>,
    /// Joints and their sway, for a mesh that was made with this rig.
    pub rig: Option<&'a Rig>,
    /// PNG files that materials show instead of their colour.
    pub pictures: Vec<Pictures<Vec<u8>>>,
}

/// Writes GLB.
#[derive(Debug)]
pub struct Glb<'a, W> {
    out: W,
    scene: &'a Scene<'a>,
    layout: Layout,
    json_room: u64,
}

/// Writes `tree` in the colours of `palette` to `out`, an empty file, as one mesh with the default
/// settings.
///
/// # Errors
/// See [`MeshError`].
pub fn write<W: Write + Seek>(out: W, name: &str, tree: &Tree, palette: &Palette) -> Result<(), MeshError> {
    let scene = Scene {
        name: name.to_owned(),
        palette: *palette,
        extras: serde_json::Value::Null,
        placed: vec![Placed::at_origin(name, 1)],
        lod_extension: false,
        grid: None,
        rig: None,
        pictures: Vec::new(),
    };
    send(&[Mesher::new(tree, MeshSettings::default())], &mut Glb::new(out, &scene))
}

/// Header, chunk header of the JSON, chunk header of the binary part.
const HEAD: u64 = 12 + 8;

impl<'a, W: Write + Seek> Glb<'a, W> {
    /// Writes `scene` to `out`, an empty file.
    pub fn new(out: W, scene: &'a Scene<'a>) -> Self {
        Self { out, scene, layout: Layout::default(), json_room: 0 }
    }

    fn write_at(&mut self, offset: u64, bytes: &[u8]) -> Result<(), MeshError> {
        self.out.seek(SeekFrom::Start(HEAD + self.json_room + 8 + offset))?;
        Ok(self.out.write_all(bytes)?)
    }
}

impl<W: Write + Seek> Sink for Glb<'_, W> {
    fn begin(&mut self, parts: &[Part]) -> Result<(), MeshError> {
        self.layout = Layout::new(parts, self.scene);
        let json = json::text(self.scene, &self.layout);
        self.json_room = (json.len() as u64).next_multiple_of(4);
        let whole = HEAD + self.json_room + 8 + self.layout.bytes;
        let limit = u64::from(u32::MAX);
        if whole > limit {
            return Err(MeshError::TooLarge { what: "bytes", found: whole, limit, format: "GLB" });
        }
        self.out.write_all(b"glTF")?;
        for number in [2, whole as u32, self.json_room as u32] {
            self.out.write_all(&number.to_le_bytes())?;
        }
        self.out.write_all(b"JSON")?;
        self.out.seek(SeekFrom::Start(HEAD + self.json_room))?;
        self.out.write_all(&(self.layout.bytes as u32).to_le_bytes())?;
        self.out.write_all(b"BIN\0")?;
        for (offset, bytes) in self.layout.fixed(self.scene) {
            self.write_at(offset, &bytes)?;
        }
        Ok(())
    }

    fn block(&mut self, part: usize, block: &mut Block) -> Result<(), MeshError> {
        turn_upright(block);
        let layout = &mut self.layout.parts[part];
        let tangents = layout.has_tangents.then(|| tangents(block, layout.next_corner()));
        let place = layout.advance(block);
        let form = layout.form;
        let is_short = layout.has_short_indices();
        self.write_at(place.vertices, &form.vertices(self.scene.grid.as_ref(), &block.vertices))?;
        if let Some(tangents) = tangents {
            self.write_at(place.tangents, &form.tangents(&tangents))?;
        }
        if !block.wind.is_empty() {
            let wind: Vec<[f32; 14]> = block.wind.iter().map(Wind::to_array).collect();
            self.write_at(place.data, bytemuck::cast_slice(&wind))?;
        }
        if !block.growth.is_empty() {
            let growth: Vec<[f32; 4]> = block.growth.iter().map(Emergence::to_array).collect();
            self.write_at(place.data, bytemuck::cast_slice(&growth))?;
        }
        if !block.pixels.is_empty() {
            let pixels: Vec<[f32; 2]> = block.pixels.iter().map(Vec2::to_array).collect();
            self.write_at(place.data, bytemuck::cast_slice(&pixels))?;
        }
        if !block.joints.is_empty() {
            let bytes: Vec<u8> = block.joints.iter().flat_map(|&joint| layout::skin(joint)).collect();
            self.write_at(place.skin, &bytes)?;
        }
        if !block.triangles.is_empty() {
            if is_short {
                let short: Vec<[u16; 3]> = block.triangles.iter().map(|t| t.map(|i| i as u16)).collect();
                self.write_at(place.indices, bytemuck::cast_slice(&short))?;
            } else {
                self.write_at(place.indices, bytemuck::cast_slice(&block.triangles))?;
            }
        }
        if !block.instances.is_empty() {
            for (offset, numbers) in place.placements.runs(&block.instances) {
                self.write_at(offset, bytemuck::cast_slice(&numbers))?;
            }
        }
        Ok(())
    }

    fn end(&mut self) -> Result<(), MeshError> {
        let mut json = json::text(self.scene, &self.layout).into_bytes();
        debug_assert!(json.len() as u64 <= self.json_room, "bounds take less room than was kept");
        json.resize(self.json_room as usize, b' ');
        self.out.seek(SeekFrom::Start(HEAD))?;
        self.out.write_all(&json)?;
        Ok(self.out.flush()?)
    }
}

/// From z up to y up, for everything in a block.
fn turn_upright(block: &mut Block) {
    for vertex in &mut block.vertices {
        (vertex.position, vertex.normal) = (upright(vertex.position), upright(vertex.normal));
    }
    for wind in &mut block.wind {
        (wind.pivot, wind.bend) = (upright(wind.pivot), upright(wind.bend));
        (wind.parent_pivot, wind.parent_bend) = (upright(wind.parent_pivot), upright(wind.parent_bend));
    }
    for emergence in &mut block.growth {
        emergence.toward = upright(emergence.toward);
    }
    for placement in &mut block.instances {
        let [x, y, z, w] = placement.rotation.to_array();
        placement.translation = upright(placement.translation);
        placement.rotation = Quat::from_xyzw(x, z, -y, w);
        // The shape itself is turned too, so its axes change places.
        let scale = placement.scale;
        placement.scale = vec3(scale.x, scale.z, scale.y);
    }
}

fn upright(v: Vec3) -> Vec3 {
    vec3(v.x, v.z, -v.y)
}
