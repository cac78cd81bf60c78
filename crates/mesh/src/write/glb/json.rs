//! The JSON part of a GLB file.

use super::layout::{self, Layout, PartLayout, Placements, SKIN_BYTES};
use super::materials::{
    TRANSFORM, TRANSMISSION, Textures, has_picture, material, transform_textures, transmitted,
};
use super::quantize::{Form, Grid};
use super::{Placed, Scene, Site, animation, upright};
use crate::part::Material;
use crate::pictures::Pictures;
use glam::Vec3;
use pleach_plant::math;
use serde_json::{Map, Value, json};

const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_BYTE: u32 = 5121;
const BYTE: u32 = 5120;
/// Bounds before they are known: no number takes more room.
const WIDEST: f64 = -1.234_567_890_123_456_7e-100;

/// The whole text. Before the corners are written, bounds are placeholders that take at least the
/// room of real ones.
pub(super) fn text(scene: &Scene<'_>, layout: &Layout) -> String {
    let mut file = File::default();
    let meshes = layout.parts.iter().map(|p| p.part.mesh + 1).max().unwrap_or(0);
    let mut drawn = Vec::new();
    for mesh in 0..meshes {
        let name = mesh_name(scene, mesh);
        drawn.push(file.mesh(
            &name,
            layout.parts.iter().filter(|p| p.part.mesh == mesh),
            scene.grid.as_ref(),
        ));
    }
    let mut roots = Vec::new();
    for (placed, sites) in scene.placed.iter().zip(&layout.sites) {
        let sites = sites.map(|sites| file.placements(sites));
        let node = file.placed(placed, &drawn, sites.as_ref(), scene);
        roots.push(node);
    }
    if let Some(rig) = scene.rig {
        let root = file.rig(rig, layout);
        roots.push(root);
    }
    let textures = file.textures(layout);
    if file.materials.iter().any(|&material| transmitted(material).is_some()) {
        file.uses(TRANSMISSION);
    }
    let mut materials: Vec<Value> = file.materials.iter().map(|&m| material(scene, &textures, m)).collect();
    if let Some(grid) = &scene.grid {
        file.uses(QUANTIZATION);
        for (value, &material) in materials.iter_mut().zip(&file.materials.clone()) {
            if let Some(tiles) = grid.tiles(material).filter(|_| has_picture(value)) {
                file.uses(TRANSFORM);
                transform_textures(value, tiles);
            }
        }
    }
    let mut root = json!({
        "asset": {"version": "2.0", "generator": concat!("pleach ", env!("CARGO_PKG_VERSION"))},
        "scene": 0,
        "scenes": [{"name": scene.name, "nodes": roots, "extras": scene.extras}],
        "nodes": file.nodes,
        "meshes": file.meshes,
        "materials": materials,
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{"byteLength": layout.bytes}],
    });
    if scene.rig.is_some() {
        root["skins"] = Value::Array(file.skins);
        root["animations"] = Value::Array(file.animations);
    }
    if !textures.is_empty() {
        root["images"] = Value::Array(file.images);
        // Linear, with mipmaps; clamped at the edges, and repeating.
        let sampler = |wrap: u32| json!({"magFilter": 9729, "minFilter": 9987, "wrapS": wrap, "wrapT": wrap});
        root["samplers"] = [33_071, 10_497].map(sampler).into_iter().collect();
        root["textures"] = Value::Array(file.textures);
    }
    if !file.used.is_empty() {
        root["extensionsUsed"] = json!(file.used);
    }
    let required = [INSTANCING, QUANTIZATION].into_iter().filter(|extension| file.used.contains(extension));
    let required: Vec<&str> = required.collect();
    if !required.is_empty() {
        root["extensionsRequired"] = json!(required);
    }
    root.to_string()
}

/// The name of mesh number `mesh`: that of the first tree that has it, and its level.
fn mesh_name(scene: &Scene<'_>, mesh: usize) -> String {
    let level = |placed: &Placed| Some(placed.level_name(placed.meshes.iter().position(|&m| m == mesh)?));
    scene.placed.iter().find_map(level).unwrap_or_else(|| scene.name.clone())
}

const INSTANCING: &str = "EXT_mesh_gpu_instancing";
const LEVELS: &str = "MSFT_lod";
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// The meshes of one number: what is drawn where it stands, and what is drawn by instances.
#[derive(Default)]
struct Drawn {
    mesh: Option<usize>,
    /// Mesh, its name, and the extension that places it.
    instanced: Vec<(usize, String, Value)>,
}

/// Puts a node where a tree stands that is not instanced.
fn put(node: &mut Value, placed: &Placed) {
    let [site] = &placed.sites[..] else { return };
    if site.position != Vec3::ZERO {
        node["translation"] = json!(upright(site.position).to_array());
    }
    if site.turn != 0.0 {
        node["rotation"] = json!(glam::Quat::from_rotation_y(site.turn).to_array());
    }
    if site.scale != 1.0 {
        node["scale"] = json!(vec![site.scale; 3]);
    }
}

#[derive(Default)]
struct File {
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    skins: Vec<Value>,
    animations: Vec<Value>,
    materials: Vec<Material>,
    images: Vec<Value>,
    textures: Vec<Value>,
    used: Vec<&'static str>,
}

fn push(list: &mut Vec<Value>, value: Value) -> usize {
    list.push(value);
    list.len() - 1
}

impl File {
    fn uses(&mut self, extension: &'static str) {
        if !self.used.contains(&extension) {
            self.used.push(extension);
        }
    }

    /// One image and texture for each PNG file of what some part shows; returns their numbers.
    fn textures(&mut self, layout: &Layout) -> Vec<Textures> {
        let numbered = |pictures: &Pictures<(u64, u64)>| {
            let sampler = u8::from(pictures.repeats);
            let material = pictures.material.name();
            pictures.as_ref().map(|what, &(offset, length)| {
                let name = if what == "color" { material.to_owned() } else { format!("{material} {what}") };
                let view = self.view(offset, length, None, None);
                let image = json!({"name": name, "mimeType": "image/png", "bufferView": view});
                let image = push(&mut self.images, image);
                push(&mut self.textures, json!({"source": image, "sampler": sampler}))
            })
        };
        layout.pictures.iter().map(numbered).collect()
    }

    fn view(&mut self, offset: u64, bytes: u64, stride: Option<u64>, target: Option<u32>) -> usize {
        let mut view = json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes});
        if let Some(stride) = stride {
            view["byteStride"] = json!(stride);
        }
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        push(&mut self.views, view)
    }

    fn accessor(&mut self, view: usize, offset: u64, component: u32, kind: &str, count: u64) -> usize {
        let accessor = json!({
            "bufferView": view, "byteOffset": offset, "componentType": component, "type": kind, "count": count,
        });
        push(&mut self.accessors, accessor)
    }

    /// An accessor whose whole numbers stand for −1 or 0 to 1.
    fn normalized(&mut self, view: usize, offset: u64, component: u32, kind: &str, count: u64) -> usize {
        let accessor = self.accessor(view, offset, component, kind, count);
        if component != FLOAT {
            self.accessors[accessor]["normalized"] = json!(true);
        }
        accessor
    }

    fn mesh<'p>(
        &mut self,
        name: &str,
        parts: impl Iterator<Item = &'p PartLayout>,
        grid: Option<&Grid>,
    ) -> Drawn {
        let mut drawn = Drawn::default();
        let mut primitives = Vec::new();
        for layout in parts {
            let primitive = self.primitive(layout, grid);
            if layout.part.instances == 0 {
                primitives.push(primitive);
                continue;
            }
            self.uses(INSTANCING);
            let name = format!("{name} {}", layout.part.material.name());
            let mesh = push(&mut self.meshes, json!({"name": name, "primitives": [primitive]}));
            let placed = self.placements(layout.place.placements);
            drawn.instanced.push((mesh, name, placed));
        }
        if !primitives.is_empty() {
            let mesh = json!({"name": name, "primitives": primitives});
            drawn.mesh = Some(push(&mut self.meshes, mesh));
        }
        drawn
    }

    fn primitive(&mut self, layout: &PartLayout, grid: Option<&Grid>) -> Value {
        let (part, place, form) = (layout.part, layout.place, layout.form);
        let count = part.count.vertices;
        let (stride, normal_at, uv_at) = form.sizes();
        let view = self.view(place.vertices, count * stride, Some(stride), Some(ARRAY_BUFFER));
        let mut attributes = Map::new();
        let (has_grid, has_tiles) = match form {
            Form::Floats => (false, true),
            Form::Numbers { has_grid, tiles } => (has_grid, tiles.is_some()),
        };
        let component = if has_grid { UNSIGNED_SHORT } else { FLOAT };
        let position = self.accessor(view, 0, component, "VEC3", count);
        let wide = |v: Vec3| match grid.filter(|_| has_grid) {
            Some(grid) => json!(grid.position(v)),
            None => json!(v.to_array().map(f64::from)),
        };
        let (min, max) = match layout.bounds {
            Some((min, max)) => (wide(min), wide(max)),
            None => (json!(vec![WIDEST; 3]), json!(vec![WIDEST; 3])),
        };
        self.accessors[position]["min"] = min;
        self.accessors[position]["max"] = max;
        attributes.insert("POSITION".into(), json!(position));
        let small = if form == Form::Floats { FLOAT } else { BYTE };
        attributes.insert("NORMAL".into(), json!(self.normalized(view, normal_at, small, "VEC3", count)));
        if has_tiles {
            let component = if form == Form::Floats { FLOAT } else { UNSIGNED_SHORT };
            let tiles = self.normalized(view, uv_at, component, "VEC2", count);
            attributes.insert("TEXCOORD_0".into(), json!(tiles));
        }
        if layout.has_tangents {
            let bytes = form.tangent_bytes();
            let view = self.view(place.tangents, count * bytes, Some(bytes), Some(ARRAY_BUFFER));
            attributes.insert("TANGENT".into(), json!(self.normalized(view, 0, small, "VEC4", count)));
        }
        let (sets, bytes) = (layout::data_sets(&part), layout::data_bytes(&part));
        if sets > 0 {
            let view = self.view(place.data, count * bytes, Some(bytes), Some(ARRAY_BUFFER));
            // Engines read these sets, and not attributes of other names.
            for set in 1..=sets {
                let accessor = self.accessor(view, 8 * (set - 1), FLOAT, "VEC2", count);
                attributes.insert(format!("TEXCOORD_{set}"), json!(accessor));
            }
        }
        if part.rigged {
            let view = self.view(place.skin, count * SKIN_BYTES, Some(SKIN_BYTES), Some(ARRAY_BUFFER));
            let joints = self.accessor(view, 0, UNSIGNED_SHORT, "VEC4", count);
            let weights = self.normalized(view, 8, UNSIGNED_BYTE, "VEC4", count);
            attributes.insert("JOINTS_0".into(), json!(joints));
            attributes.insert("WEIGHTS_0".into(), json!(weights));
        }
        let triangles = part.count.triangles;
        let bytes = triangles * layout.index_bytes();
        let view = self.view(place.indices, bytes, None, Some(ELEMENT_ARRAY_BUFFER));
        let component = if layout.has_short_indices() { UNSIGNED_SHORT } else { UNSIGNED_INT };
        let indices = self.accessor(view, 0, component, "SCALAR", triangles * 3);
        let material = self.material(part.material);
        json!({"attributes": attributes, "indices": indices, "material": material})
    }

    fn material(&mut self, material: Material) -> usize {
        if let Some(known) = self.materials.iter().position(|m| *m == material) {
            return known;
        }
        self.materials.push(material);
        self.materials.len() - 1
    }

    /// The extension that places a mesh many times.
    fn placements(&mut self, places: Placements) -> Value {
        self.uses(INSTANCING);
        let mut run = |offset, size, kind| {
            let view = self.view(offset, places.count * size, None, None);
            self.accessor(view, 0, FLOAT, kind, places.count)
        };
        let attributes = json!({
            "TRANSLATION": run(places.translations, 12, "VEC3"),
            "ROTATION": run(places.rotations, 16, "VEC4"),
            "SCALE": run(places.scales, 12, "VEC3"),
        });
        json!({(INSTANCING): {"attributes": attributes}})
    }

    /// The node of a tree: its mesh, or the parent of its levels.
    fn placed(
        &mut self,
        placed: &Placed,
        drawn: &[Drawn],
        sites: Option<&Value>,
        scene: &Scene<'_>,
    ) -> usize {
        let mut levels = Vec::new();
        for (level, &mesh) in placed.meshes.iter().enumerate() {
            let is_alone = placed.meshes.len() == 1 && placed.sites[..] != [Site::ORIGIN];
            // Where it stands takes in what whole numbers stand for.
            let grid = scene.grid.as_ref().filter(|_| sites.is_none());
            let mut node = self.node(&placed.level_name(level), &drawn[mesh], grid, is_alone);
            if let Some(sites) = sites {
                node["extensions"] = sites.clone();
            }
            levels.push(node);
        }
        if let [node] = &mut levels[..] {
            put(node, placed);
            if scene.rig.is_some() {
                node["skin"] = json!(0);
            }
            return push(&mut self.nodes, node.take());
        }
        if !scene.lod_extension {
            let children: Vec<usize> = levels.into_iter().map(|node| push(&mut self.nodes, node)).collect();
            let mut parent = json!({"name": placed.name, "children": children});
            put(&mut parent, placed);
            return push(&mut self.nodes, parent);
        }
        levels.iter_mut().for_each(|node| put(node, placed));
        let mut finest = levels.remove(0);
        self.uses(LEVELS);
        let coarse: Vec<usize> = levels.into_iter().map(|node| push(&mut self.nodes, node)).collect();
        // What part of the screen's height a level is good for; below the last, nothing is drawn.
        let covers: Vec<f64> = (0..=coarse.len()).map(|i| 0.5 / math::powi(2.5, i as i32)).collect();
        let covers: Vec<f64> = covers.iter().map(|c| (c * 1e3).round() / 1e3).collect();
        finest["extensions"][LEVELS] = json!({"ids": coarse});
        finest["extras"] = json!({"MSFT_screencoverage": covers});
        push(&mut self.nodes, finest)
    }

    /// A node that shows a mesh where it is; what is instanced becomes nodes below it, and so does a mesh of whole
    /// numbers, which has a place of its own, if the node has one too.
    fn node(&mut self, name: &str, drawn: &Drawn, grid: Option<&Grid>, is_placed: bool) -> Value {
        let mut children: Vec<usize> = drawn
            .instanced
            .iter()
            .map(|(mesh, name, placed)| {
                push(&mut self.nodes, json!({"name": name, "mesh": mesh, "extensions": placed}))
            })
            .collect();
        let mut node = json!({"name": name});
        if let Some(mesh) = drawn.mesh {
            let mut own = json!({"mesh": mesh});
            if let Some(grid) = grid {
                own["translation"] = json!(grid.origin.to_array());
                own["scale"] = json!(vec![grid.step; 3]);
            }
            if grid.is_some() && (is_placed || !children.is_empty()) {
                // What moves and scales the mesh must not move and scale what else stands here.
                own["name"] = json!(format!("{name} mesh"));
                children.insert(0, push(&mut self.nodes, own));
            } else {
                own["name"] = json!(name);
                node = own;
            }
        }
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        node
    }

    /// Joints, skin and animation; returns the joints' common root.
    fn rig(&mut self, rig: &crate::Rig, layout: &Layout) -> usize {
        let first = self.nodes.len();
        let mut children = vec![Vec::new(); rig.joints.len()];
        let mut tops = Vec::new();
        for (i, joint) in rig.joints.iter().enumerate() {
            match joint.parent {
                Some(parent) => children[usize::from(parent)].push(first + i),
                None => tops.push(first + i),
            }
        }
        for (i, translation) in animation::translations(rig).into_iter().enumerate() {
            let mut node = json!({"name": format!("joint {i}"), "translation": translation.to_array()});
            if !children[i].is_empty() {
                node["children"] = json!(children[i]);
            }
            self.nodes.push(node);
        }
        let root = push(&mut self.nodes, json!({"name": "joints", "children": tops}));
        let count = rig.joints.len() as u64;
        let keys = u64::from(animation::KEYS);
        let view = self.view(layout.bind_matrices, count * 64, None, None);
        let matrices = self.accessor(view, 0, FLOAT, "MAT4", count);
        let joints: Vec<usize> = (first..root).collect();
        self.skins.push(json!({"joints": joints, "skeleton": root, "inverseBindMatrices": matrices}));

        let view = self.view(layout.times, keys * 4, None, None);
        let times = self.accessor(view, 0, FLOAT, "SCALAR", keys);
        self.accessors[times]["min"] = json!([0.0]);
        self.accessors[times]["max"] = json!([f64::from(keys as u32 - 1) / 12.0]);
        let view = self.view(layout.rotations, count * keys * 16, None, None);
        let (mut samplers, mut channels) = (Vec::new(), Vec::new());
        for i in 0..count {
            let output = self.accessor(view, i * keys * 16, FLOAT, "VEC4", keys);
            samplers.push(json!({"input": times, "output": output}));
            let target = json!({"node": first + i as usize, "path": "rotation"});
            channels.push(json!({"sampler": i, "target": target}));
        }
        self.animations.push(json!({"name": "sway", "samplers": samplers, "channels": channels}));
        root
    }
}
