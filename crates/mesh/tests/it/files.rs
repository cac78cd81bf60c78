//! Every file format, read back by somebody else's reader or byte by byte.

use pleach_mesh::lod::{self, Level};
use pleach_mesh::write::glb::{Glb, Placed, Scene, Site};
use pleach_mesh::write::{obj, ply, stl, usda};
use pleach_mesh::{
    Card, Cards, LeafStyle, Material, Mesh, MeshError, MeshSettings, Mesher, Palette, Pictures, Rig, Sink,
    Source, send,
};
use pleach_tests::tool;
use pleach_tree::{Species, Tree};
use std::io::{Cursor, Write};
use std::path::Path;
use std::process::Command;

pub(crate) fn grow(name: &str) -> (Species, Tree) {
    let species = pleach_generators::preset(name).unwrap();
    let tree = species.grow(1).unwrap();
    (species, tree)
}

pub(crate) fn scene<'a>(species: &Species, _: &Tree, levels: usize) -> Scene<'a> {
    Scene {
        name: species.name.clone(),
        palette: Palette::new(&species.appearance, None),
        extras: serde_json::json!({"species": species.name, "seed": 1}),
        placed: vec![Placed::at_origin(&species.name, levels)],
        lod_extension: false,
        grid: None,
        rig: None,
        pictures: Vec::new(),
    }
}

pub(crate) fn glb(meshers: &[impl Source], scene: &Scene<'_>) -> Vec<u8> {
    let mut out = Cursor::new(Vec::new());
    send(meshers, &mut Glb::new(&mut out, scene)).unwrap();
    out.into_inner()
}

pub(crate) fn plain(name: &str, settings: MeshSettings) -> Vec<u8> {
    let (species, tree) = grow(name);
    glb(&[Mesher::new(&tree, settings)], &scene(&species, &tree, 1))
}

pub(crate) fn levels_glb(name: &str, count: u32) -> Vec<u8> {
    let (species, tree) = grow(name);
    let levels: Vec<Level<'_>> = lod::levels(&tree, MeshSettings::default(), count);
    let meshers: Vec<Mesher<'_>> = levels.iter().map(Level::mesher).collect();
    glb(&meshers, &scene(&species, &tree, levels.len()))
}

fn rigged(name: &str) -> Vec<u8> {
    let (species, tree) = grow(name);
    let rig = Rig::new(&tree);
    let scene = Scene { rig: Some(&rig), ..scene(&species, &tree, 1) };
    glb(&[Mesher::new(&tree, MeshSettings::default()).with_rig(&rig)], &scene)
}

fn instanced(name: &str) -> Vec<u8> {
    let (species, tree) = grow(name);
    let mesher = Mesher::new(&tree, MeshSettings::default()).with_instanced_leaves();
    glb(&[mesher], &scene(&species, &tree, 1))
}

/// A picture of one pixel.
pub(crate) fn dot() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 1, 1);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(&[90, 140, 50, 255]).unwrap();
    bytes
}

fn cards_glb(name: &str) -> Vec<u8> {
    let (species, tree) = grow(name);
    let settings = MeshSettings { leaves: LeafStyle::CrossedCards, ..MeshSettings::default() };
    let plain = scene(&species, &tree, 1);
    let pictures = [Material::Leaf, Material::Blossom].map(|of| Pictures::cut_out(of, dot(), 0.4)).to_vec();
    glb(&[Mesher::new(&tree, settings)], &Scene { pictures, ..plain })
}

fn billboards_glb(name: &str, sides: u32) -> Vec<u8> {
    let (species, tree) = grow(name);
    let plain = scene(&species, &tree, 2);
    let card = |side: u32| {
        let right = glam::Vec2::from_angle(side as f32).extend(0.0);
        let corner = |x: f32, z: f32| right * x + glam::Vec3::Z * z;
        let corners = [corner(-1.0, 0.0), corner(1.0, 0.0), corner(1.0, 2.0), corner(-1.0, 2.0)];
        Card { corners, uv: [0.0, 0.0, 1.0, 1.0] }
    };
    let cards: Vec<Card> = (0..sides).map(card).collect();
    let settings = MeshSettings::default();
    let meshers: [Box<dyn Source>; 2] = [Box::new(Mesher::new(&tree, settings)), Box::new(Cards(&cards))];
    let pictures = vec![Pictures::cut_out(Material::Card, dot(), 0.4)];
    glb(&meshers, &Scene { pictures, ..plain })
}

fn forest() -> Vec<u8> {
    let (species, tree) = grow("acer");
    let (_, palm) = grow("palm");
    let meshers = [&tree, &palm].map(|tree| Mesher::new(tree, MeshSettings::default()));
    let site =
        |i: u16| Site { position: glam::vec3(f32::from(i) * 6.0, 0.0, 0.0), turn: f32::from(i), scale: 0.9 };
    let variant = |mesh: usize, sites: &[u16]| Placed {
        name: format!("tree {mesh}"),
        meshes: vec![mesh],
        sites: sites.iter().copied().map(site).collect(),
    };
    let placed = vec![variant(0, &[0, 2, 4]), variant(1, &[1])];
    glb(&meshers, &Scene { placed, ..scene(&species, &tree, 1) })
}

#[test]
fn the_gltf_crate_reads_every_corner_back() {
    for name in ["acer", "palm", "hill_cherry", "small_pine"] {
        let bytes = plain(name, MeshSettings::default());
        let (_, tree) = grow(name);
        let mesh = Mesh::new(&tree, MeshSettings::default());
        let file = gltf::Gltf::from_slice(&bytes).unwrap();
        let blob = file.blob.as_deref().unwrap();
        let found: Vec<_> = file.meshes().flat_map(|m| m.primitives().collect::<Vec<_>>()).collect();
        assert_eq!(found.len(), mesh.parts.len(), "{name}");
        for (primitive, (part, block)) in found.iter().zip(&mesh.parts) {
            assert_eq!(primitive.material().name(), Some(part.material.name()));
            let reader = primitive.reader(|_| Some(blob));
            let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
            let expected: Vec<[f32; 3]> =
                block.vertices.iter().map(|v| [v.position.x, v.position.z, -v.position.y]).collect();
            assert!(positions == expected, "{name}: positions, y up");
            let normals = reader.read_normals().unwrap();
            assert!(
                normals.zip(&block.vertices).all(|(n, v)| n == [v.normal.x, v.normal.z, -v.normal.y]),
                "{name}: normals"
            );
            let textures = reader.read_tex_coords(0).unwrap().into_f32();
            assert!(textures.zip(&block.vertices).all(|(t, v)| t == v.uv.to_array()), "{name}: textures");
            let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
            assert!(indices == block.triangles.concat(), "{name}: triangles");
            let bounds = primitive.bounding_box();
            let least = |axis: usize| positions.iter().map(|p| p[axis]).fold(f32::INFINITY, f32::min);
            assert_eq!(bounds.min, [least(0), least(1), least(2)]);
        }
    }
}

#[test]
fn the_same_tree_is_the_same_file() {
    let once = levels_glb("acer", 3);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert!(once == levels_glb("acer", 3) && once == pool.install(|| levels_glb("acer", 3)));
}

#[test]
fn instances_place_every_leaf() {
    let (_, tree) = grow("acer");
    let bytes = instanced("acer");
    let json = json_of(&bytes);
    let node = json["nodes"].as_array().unwrap().iter().find(|n| n["extensions"].is_object()).unwrap();
    let attributes = &node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    for name in ["TRANSLATION", "ROTATION", "SCALE"] {
        let accessor = &json["accessors"][attributes[name].as_u64().unwrap() as usize];
        assert_eq!(accessor["count"].as_u64().unwrap() as usize, tree.leaves.len(), "{name}");
    }
    // Placed by its instance, the unit leaf lies where the plain mesh has it.
    let file = gltf::Gltf::from_slice(&plain("acer", MeshSettings::default())).unwrap();
    let leaf = file.meshes().next().unwrap().primitives().nth(1).unwrap();
    let plain: Vec<[f32; 3]> =
        leaf.reader(|_| file.blob.as_deref()).read_positions().unwrap().take(11).collect();
    let mut unit = Mesh::default();
    send(&[Mesher::new(&tree, MeshSettings::default()).with_instanced_leaves()], &mut unit).unwrap();
    let block = &unit.parts[1].1;
    let place = block.instances[0];
    for (v, expected) in block.vertices.iter().zip(plain) {
        let at = place.translation + place.rotation * (place.scale * v.position);
        let expected = glam::Vec3::new(expected[0], -expected[2], expected[1]);
        assert!((at - expected).length() < 1e-5, "{at} {expected}");
    }
}

#[test]
fn cards_show_the_pictures_of_their_scene() {
    let bytes = cards_glb("apple");
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = file.blob.as_deref().unwrap();
    let materials: Vec<_> = file.materials().map(|m| (m.name().unwrap_or_default(), m)).collect();
    assert_eq!(materials.iter().map(|m| m.0).collect::<Vec<_>>(), ["bark", "leaves", "blossom"]);
    for (name, material) in &materials[1..] {
        assert_eq!(material.alpha_mode(), gltf::material::AlphaMode::Mask, "{name}");
        let texture = material.pbr_metallic_roughness().base_color_texture().unwrap().texture();
        let gltf::image::Source::View { view, .. } = texture.source().source() else { panic!("{name}") };
        assert_eq!(blob[view.offset()..view.offset() + view.length()], dot(), "{name}");
    }
    // Two cards a leaf and one a blossom, whose corners are the picture's.
    let (_, tree) = grow("apple");
    for (primitive, corners) in file
        .meshes()
        .flat_map(|m| m.primitives())
        .skip(1)
        .zip([tree.leaves.len() * 8, tree.blossoms.len() * 4])
    {
        let uv = primitive.reader(|_| Some(blob)).read_tex_coords(0).unwrap().into_f32();
        assert_eq!(uv.len(), corners);
        assert!(uv.flatten().all(|c| c.abs() < 1e-5 || (c - 1.0).abs() < 1e-5));
    }
}

#[test]
fn the_last_level_is_a_picture_on_cards() {
    let json = json_of(&billboards_glb("acer", 3));
    let meshes = json["meshes"].as_array().unwrap();
    assert_eq!(meshes.len(), 2);
    let card = &meshes[1]["primitives"][0];
    assert_eq!(json["materials"][card["material"].as_u64().unwrap() as usize]["name"], "card");
    let corners = &json["accessors"][card["attributes"]["POSITION"].as_u64().unwrap() as usize]["count"];
    assert_eq!(corners, 12);
}

#[test]
fn the_sway_moves_every_joint_and_comes_back() {
    let bytes = rigged("acer");
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = file.blob.as_deref().unwrap();
    let animation = file.animations().next().unwrap();
    let joints = file.skins().next().unwrap().joints().count();
    assert_eq!(animation.channels().count(), joints);
    for channel in animation.channels() {
        let reader = channel.reader(|_| Some(blob));
        let times: Vec<f32> = reader.read_inputs().unwrap().collect();
        assert!(times.windows(2).all(|w| w[0] < w[1]));
        let Some(gltf::animation::util::ReadOutputs::Rotations(turns)) = reader.read_outputs() else {
            panic!("rotations");
        };
        let turns: Vec<[f32; 4]> = turns.into_f32().collect();
        assert_eq!(turns.len(), times.len());
        assert_eq!(turns[0], turns[turns.len() - 1], "the loop closes");
        assert!(turns.iter().any(|t| t != &turns[0]), "the joint moves");
    }
    for primitive in file.meshes().next().unwrap().primitives() {
        let reader = primitive.reader(|_| Some(blob));
        let numbers = reader.read_joints(0).unwrap().into_u16();
        assert!(numbers.map(|j| usize::from(j[0])).max().unwrap() < joints);
        assert!(reader.read_weights(0).unwrap().into_f32().all(|w| w == [1.0, 0.0, 0.0, 0.0]));
    }
}

#[test]
fn the_khronos_validator_finds_no_error_and_no_warning() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/support/validate.js");
    let probe = "require('gltf-validator').validateString('{\"asset\": {\"version\": \"2.0\"}}')\
                 .then(report => process.exit(report.issues.numErrors))";
    let needs = "node and `npm install --no-save gltf-validator` in the repository's root";
    let mut node = Command::new("node");
    if !tool::is_usable(needs, node.current_dir(script.parent().unwrap()).args(["-e", probe])) {
        return;
    }
    let dir = tempfile::tempdir().unwrap();
    let cards = MeshSettings { leaves: LeafStyle::CrossedCards, wind: true, ..MeshSettings::default() };
    let mut files: Vec<(String, Vec<u8>)> = vec![
        ("levels".into(), levels_glb("acer", lod::MAX_LEVELS)),
        ("instances".into(), instanced("hill_cherry")),
        ("sway".into(), rigged("acer")),
        ("forest".into(), forest()),
        ("textures".into(), crate::pictures::textured("acer")),
        ("cards".into(), cards_glb("apple")),
        ("billboards".into(), billboards_glb("hill_cherry", 4)),
        ("cards without pictures".into(), plain("palm", cards)),
        ("wind".into(), plain("acer", MeshSettings { wind: true, ..MeshSettings::default() })),
    ];
    for name in ["quaking_aspen", "bamboo", "palm", "acer", "lombardy_poplar", "apple", "hill_cherry"] {
        files.push((name.into(), plain(name, MeshSettings::default())));
    }
    let paths = files.iter().map(|(name, bytes)| {
        let path = dir.path().join(format!("{name}.glb"));
        std::fs::write(&path, bytes).unwrap();
        path
    });
    let output = Command::new("node").arg(&script).args(paths).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
}

#[test]
fn the_usd_library_finds_nothing_wrong() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/support/usd.py");
    let python = |arguments: &[&str]| {
        let mut python = Command::new("python3");
        python.args(arguments);
        python
    };
    let probe = "from pxr import Usd, UsdGeom, UsdValidation\n\
                 UsdValidation.ValidationRegistry().GetOrLoadAllValidators()";
    if !tool::is_usable("python3 and `pip install usd-core`", &mut python(&["-c", probe])) {
        return;
    }
    let dir = tempfile::tempdir().unwrap();
    for (name, leaves) in [("acer", LeafStyle::Outline), ("apple", LeafStyle::CrossedCards)] {
        let (species, tree) = grow(name);
        let palette = Palette::new(&species.appearance, None);
        let mesher = Mesher::new(&tree, MeshSettings { leaves, ..MeshSettings::default() });
        let mesher = if name == "acer" { mesher } else { mesher.with_instanced_leaves() };
        let count = mesher.count();
        let notes = usda::Notes { name: name.into(), ..usda::Notes::default() };
        let path = dir.path().join(format!("{name}.usda"));
        send(&[mesher], &mut usda::Usda::new(std::fs::File::create(&path).unwrap(), &notes, palette))
            .unwrap();
        let run = python(&[script.to_str().unwrap(), path.to_str().unwrap()]).output().unwrap();
        let said = String::from_utf8_lossy(&run.stdout);
        assert!(run.status.success(), "{said}{}", String::from_utf8_lossy(&run.stderr));
        assert_eq!(said.trim(), format!("{} {}", count.vertices, count.triangles));
    }
}

#[test]
fn stl_holds_every_triangle_with_its_normal() {
    let (_, tree) = grow("acer");
    let mesher = Mesher::new(&tree, MeshSettings::default());
    let count = mesher.count().triangles as usize;
    let mut bytes = Vec::new();
    send(&[mesher], &mut stl::Stl::new(&mut bytes)).unwrap();
    assert_eq!(bytes.len(), 84 + 50 * count);
    assert_eq!(bytes[80..84], (count as u32).to_le_bytes());
    let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    for triangle in 0..count {
        let vector = |k: usize| {
            let at = 84 + 50 * triangle + 12 * k;
            glam::Vec3::new(float(at), float(at + 4), float(at + 8))
        };
        let [n, a, b, c] = [0, 1, 2, 3].map(vector);
        assert!((n.length() - 1.0).abs() < 1e-3 && n.dot((b - a).cross(c - a)) > 0.0);
    }
}

#[test]
fn ply_holds_what_its_head_promises() {
    let (species, tree) = grow("hill_cherry");
    for wind in [false, true] {
        let mesher = Mesher::new(&tree, MeshSettings { wind, ..MeshSettings::default() });
        let count = mesher.count();
        let palette = Palette::new(&species.appearance, None);
        let mut bytes = Vec::new();
        send(&[mesher], &mut ply::Ply::new(&mut bytes, palette)).unwrap();
        let end = b"end_header\n";
        let body = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
        let head = std::str::from_utf8(&bytes[..body]).unwrap();
        assert!(head.contains(&format!("element vertex {}\n", count.vertices)), "{head}");
        assert!(head.contains(&format!("element face {}\n", count.triangles)), "{head}");
        let each = 35 + if wind { 56 } else { 0 };
        let faces = body + each * count.vertices as usize;
        assert_eq!(bytes.len(), faces + 13 * count.triangles as usize);
        for face in bytes[faces..].chunks(13) {
            let corner = |k: usize| u32::from_le_bytes(face[1 + 4 * k..5 + 4 * k].try_into().unwrap());
            assert!(face[0] == 3 && (0..3).all(|k| u64::from(corner(k)) < count.vertices));
        }
    }
}

#[test]
fn obj_counts_corners_from_one_and_names_its_materials() {
    let (species, tree) = grow("palm");
    let mesher = Mesher::new(&tree, MeshSettings::default());
    let count = mesher.count();
    let mut bytes = Vec::new();
    send(&[mesher], &mut obj::Obj::new(&mut bytes, "a palm", "palm.mtl")).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let lines = |start: &str| text.lines().filter(|l| l.starts_with(start)).count() as u64;
    assert_eq!((lines("v "), lines("vn "), lines("vt ")), (count.vertices, count.vertices, count.vertices));
    assert_eq!(lines("f "), count.triangles);
    assert!(text.contains("mtllib palm.mtl") && text.contains("o a_palm") && text.contains("usemtl leaves"));
    let highest = text.lines().filter(|l| l.starts_with("f ")).flat_map(|l| l.split([' ', '/']).skip(1));
    assert_eq!(highest.map(|n| n.parse::<u64>().unwrap()).max(), Some(count.vertices));
    let materials = obj::materials(&Palette::new(&species.appearance, None), &[]);
    assert_eq!(materials.matches("newmtl").count(), 3);
}

/// Every array has as many items as the numbers of corners, triangles and leaves ask for.
#[test]
fn usda_arrays_have_their_lengths() {
    let (species, tree) = grow("hill_cherry");
    let mesher = Mesher::new(&tree, MeshSettings::default()).with_instanced_leaves();
    let parts = mesher.parts(0);
    let notes = usda::Notes { name: "1 hill cherry".into(), ..usda::Notes::default() };
    let palette = Palette::new(&species.appearance, None);
    let mut bytes = Vec::new();
    send(&[mesher], &mut usda::Usda::new(&mut bytes, &notes, palette)).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    assert!(text.contains("defaultPrim = \"_1_hill_cherry\""));
    let depth = text.chars().fold(0, |d, c| d + i32::from("{([".contains(c)) - i32::from("})]".contains(c)));
    assert_eq!(depth, 0, "brackets close");
    let lengths = |name: &str| -> Vec<u64> {
        let rows = text.lines().filter(|l| l.trim_start().starts_with(name));
        rows.map(|l| l.matches(", ").count() as u64 + 1).collect()
    };
    let corners: Vec<u64> = parts.iter().map(|p| 3 * p.count.vertices).collect();
    assert_eq!(lengths("point3f[] points"), corners);
    assert_eq!(lengths("normal3f[] normals"), corners);
    let triangles: Vec<u64> = parts.iter().map(|p| p.count.triangles).collect();
    assert_eq!(lengths("int[] faceVertexCounts"), triangles);
    assert_eq!(lengths("int[] faceVertexIndices"), triangles.iter().map(|t| 3 * t).collect::<Vec<_>>());
    assert_eq!(lengths("quath[] orientations"), [4 * parts[1].instances]);
}

#[test]
fn formats_refuse_what_they_cannot_hold() {
    let (_, tree) = grow("acer");
    let meshers = || [Mesher::new(&tree, MeshSettings::default()).with_instanced_leaves()];
    let refused = send(&meshers(), &mut stl::Stl::new(Vec::new()));
    assert!(matches!(refused, Err(MeshError::Unsupported { what: "instances", format: "STL" })));
    let two = [(); 2].map(|()| Mesher::new(&tree, MeshSettings::default()));
    let refused = send(&two, &mut obj::Obj::new(Vec::new(), "a", "a.mtl"));
    assert!(matches!(refused, Err(MeshError::Unsupported { format: "OBJ", .. })));
    let nothing = Tree::default();
    let empty = send(&[Mesher::new(&nothing, MeshSettings::default())], &mut stl::Stl::new(Vec::new()));
    assert!(matches!(empty, Err(MeshError::Empty)));
}

/// A disk with room for so many bytes.
struct SmallDisk(usize);

impl Write for SmallDisk {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0 = self.0.checked_sub(bytes.len()).ok_or(std::io::ErrorKind::StorageFull)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

impl std::io::Seek for SmallDisk {
    fn seek(&mut self, _: std::io::SeekFrom) -> std::io::Result<u64> {
        Ok(0)
    }
}

#[test]
fn a_full_disk_is_an_error_in_every_format() {
    let (species, tree) = grow("acer");
    let scene = scene(&species, &tree, 1);
    for room in [0, 1000, 1_000_000] {
        let sinks: [Box<dyn Sink>; 4] = [
            Box::new(Glb::new(SmallDisk(room), &scene)),
            Box::new(obj::Obj::new(SmallDisk(room), "a", "a.mtl")),
            Box::new(ply::Ply::new(SmallDisk(room), scene.palette)),
            Box::new(stl::Stl::new(SmallDisk(room))),
        ];
        for mut sink in sinks {
            let result = send(&[Mesher::new(&tree, MeshSettings::default())], sink.as_mut());
            assert!(matches!(&result, Err(MeshError::Io(e)) if e.kind() == std::io::ErrorKind::StorageFull));
        }
    }
}

/// The JSON part of a GLB file.
pub(crate) fn json_of(bytes: &[u8]) -> serde_json::Value {
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!(u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize, bytes.len());
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).unwrap()
}
