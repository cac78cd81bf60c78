//! The JSON part of a GLB file.

use super::layout::{Layout, PartLayout, Placements, SKIN_BYTES};
use super::{Placed, Scene, animation, upright};
use crate::palette::linear;
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
        drawn.push(file.mesh(&name, layout.parts.iter().filter(|p| p.part.mesh == mesh)));
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
    let materials: Vec<Value> = file.materials.iter().map(|&m| material(scene, &textures, m)).collect();
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
    if file.used.contains(&INSTANCING) {
        root["extensionsRequired"] = json!([INSTANCING]);
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

fn material(scene: &Scene<'_>, textures: &[Textures], material: Material) -> Value {
    let own = textures.iter().find(|textures| textures.material == material);
    if let Some(Textures { color, normal, roughness, .. }) = own.filter(|_| material == Material::Bark) {
        let mut value = json!({
            "name": material.name(),
            "pbrMetallicRoughness": {
                "baseColorTexture": {"index": color}, "metallicFactor": 0.0, "roughnessFactor": 1.0,
            },
        });
        if let Some(normal) = normal {
            value["normalTexture"] = json!({"index": normal});
        }
        if let Some(roughness) = roughness {
            value["occlusionTexture"] = json!({"index": roughness});
            value["pbrMetallicRoughness"]["metallicRoughnessTexture"] = json!({"index": roughness});
        }
        return value;
    }
    if let Some(Textures { color: texture, .. }) = own {
        let roughness = if material == Material::Card { 1.0 } else { 0.7 };
        return json!({
            "name": material.name(), "doubleSided": true, "alphaMode": "MASK", "alphaCutoff": 0.4,
            "pbrMetallicRoughness": {
                "baseColorTexture": {"index": texture}, "metallicFactor": 0.0, "roughnessFactor": roughness,
            },
        });
    }
    let [r, g, b] = linear(scene.palette.color(material)).map(|c| (f64::from(c) * 1e4).round() / 1e4);
    let roughness = if material == Material::Bark { 0.95 } else { 0.7 };
    let mut value = json!({
        "name": material.name(),
        "pbrMetallicRoughness":
            {"baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": roughness},
    });
    if material != Material::Bark {
        value["doubleSided"] = json!(true);
    }
    value
}

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

/// Numbers of the textures of a material.
type Textures = Pictures<usize>;

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
            let sampler = u8::from(pictures.repeats());
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

    fn mesh<'p>(&mut self, name: &str, parts: impl Iterator<Item = &'p PartLayout>) -> Drawn {
        let mut drawn = Drawn::default();
        let mut primitives = Vec::new();
        for layout in parts {
            let primitive = self.primitive(layout);
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

    fn primitive(&mut self, layout: &PartLayout) -> Value {
        let (part, place) = (layout.part, layout.place);
        let count = part.count.vertices;
        let view = self.view(place.vertices, count * 32, Some(32), Some(ARRAY_BUFFER));
        let mut attributes = Map::new();
        let position = self.accessor(view, 0, FLOAT, "VEC3", count);
        let wide = |v: Vec3| json!(v.to_array().map(f64::from));
        let (min, max) = match layout.bounds {
            Some((min, max)) => (wide(min), wide(max)),
            None => (json!(vec![WIDEST; 3]), json!(vec![WIDEST; 3])),
        };
        self.accessors[position]["min"] = min;
        self.accessors[position]["max"] = max;
        attributes.insert("POSITION".into(), json!(position));
        attributes.insert("NORMAL".into(), json!(self.accessor(view, 12, FLOAT, "VEC3", count)));
        attributes.insert("TEXCOORD_0".into(), json!(self.accessor(view, 24, FLOAT, "VEC2", count)));
        if layout.has_tangents {
            let view = self.view(place.tangents, count * 16, Some(16), Some(ARRAY_BUFFER));
            attributes.insert("TANGENT".into(), json!(self.accessor(view, 0, FLOAT, "VEC4", count)));
        }
        if part.wind {
            let view = self.view(place.wind, count * 32, Some(32), Some(ARRAY_BUFFER));
            attributes.insert("_WIND_PIVOT".into(), json!(self.accessor(view, 0, FLOAT, "VEC4", count)));
            attributes.insert("_WIND_SWAY".into(), json!(self.accessor(view, 16, FLOAT, "VEC4", count)));
        }
        if part.rigged {
            let view = self.view(place.skin, count * SKIN_BYTES, Some(SKIN_BYTES), Some(ARRAY_BUFFER));
            let joints = self.accessor(view, 0, UNSIGNED_SHORT, "VEC4", count);
            let weights = self.accessor(view, 8, UNSIGNED_BYTE, "VEC4", count);
            self.accessors[weights]["normalized"] = json!(true);
            attributes.insert("JOINTS_0".into(), json!(joints));
            attributes.insert("WEIGHTS_0".into(), json!(weights));
        }
        let triangles = part.count.triangles;
        let view = self.view(place.indices, triangles * 12, None, Some(ELEMENT_ARRAY_BUFFER));
        let indices = self.accessor(view, 0, UNSIGNED_INT, "SCALAR", triangles * 3);
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
            let mut node = self.node(&placed.level_name(level), &drawn[mesh]);
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

    /// A node that shows a mesh where it is; what is instanced becomes nodes below it.
    fn node(&mut self, name: &str, drawn: &Drawn) -> Value {
        let children: Vec<usize> = drawn
            .instanced
            .iter()
            .map(|(mesh, name, placed)| {
                push(&mut self.nodes, json!({"name": name, "mesh": mesh, "extensions": placed}))
            })
            .collect();
        let mut node = json!({"name": name});
        if let Some(mesh) = drawn.mesh {
            node["mesh"] = json!(mesh);
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
