//! GLB files of whole numbers, read back and compared with those of floats.

use crate::files::{glb, grow, json_of, scene};
use crate::pictures::bark;
use glam::{Mat4, Quat, Vec2, Vec3, vec2};
use pleach_mesh::write::glb::{Grid, Placed, Scene, Site};
use pleach_mesh::{MeshSettings, Mesher, lod};
use serde_json::Value;

/// The binary chunk.
fn chunk(bytes: &[u8]) -> &[u8] {
    let json = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    &bytes[28 + json..]
}

/// The numbers of an accessor, as a viewer reads them; none of one that is not there.
fn numbers(json: &Value, bytes: &[u8], accessor: &Value) -> Vec<Vec<f64>> {
    if accessor.is_null() {
        return Vec::new();
    }
    let accessor = &json["accessors"][accessor.as_u64().unwrap() as usize];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
    let count = match accessor["type"].as_str().unwrap() {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        _ => 4,
    };
    let (size, most) = match accessor["componentType"].as_u64().unwrap() {
        5120 => (1, 127.0),
        5123 => (2, 65_535.0),
        _ => (4, 1.0),
    };
    let is_normalized = accessor["normalized"] == true;
    let stride = view["byteStride"].as_u64().map_or(count * size, |stride| stride as usize);
    let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
    let one = |at: usize| {
        let bytes = &chunk(bytes)[at..at + size];
        let value = match (size, accessor["componentType"].as_u64().unwrap()) {
            (1, _) => f64::from(bytes[0] as i8),
            (2, _) => f64::from(u16::from_le_bytes(bytes.try_into().unwrap())),
            (_, 5125) => f64::from(u32::from_le_bytes(bytes.try_into().unwrap())),
            _ => f64::from(f32::from_le_bytes(bytes.try_into().unwrap())),
        };
        if is_normalized { value / most } else { value }
    };
    let vectors = 0..number(&accessor["count"]);
    vectors.map(|i| (0..count).map(|k| one(start + i * stride + k * size)).collect()).collect()
}

fn vec3(v: &[f64]) -> Vec3 {
    Vec3::new(v[0] as f32, v[1] as f32, v[2] as f32)
}

/// What a viewer makes of a file: of each primitive the positions where they stand, normals, the coordinates in the
/// picture that the material shows, indices, and whether it shows one.
type Seen = Vec<(Vec<Vec3>, Vec<Vec3>, Vec<Vec2>, Vec<Vec<f64>>, bool)>;

fn seen(bytes: &[u8]) -> Seen {
    let json = json_of(bytes);
    let list = |key: &str| json[key].as_array().cloned().unwrap_or_default();
    let (nodes, meshes) = (list("nodes"), list("meshes"));
    let mut seen = Vec::new();
    let own = |node: &Value| {
        let floats = |key: &str, usual: &[f64]| -> Vec<f32> {
            let given = node[key].as_array().map(|a| a.iter().map(|x| x.as_f64().unwrap()).collect());
            given.unwrap_or_else(|| usual.to_vec()).into_iter().map(|x: f64| x as f32).collect()
        };
        let (t, s) = (floats("translation", &[0.0; 3]), floats("scale", &[1.0; 3]));
        let r = floats("rotation", &[0.0, 0.0, 0.0, 1.0]);
        let turn = Quat::from_xyzw(r[0], r[1], r[2], r[3]);
        Mat4::from_scale_rotation_translation(Vec3::from_slice(&s), turn, Vec3::from_slice(&t))
    };
    let mut stack: Vec<(usize, Mat4)> = Vec::new();
    for root in json["scenes"][0]["nodes"].as_array().unwrap().iter().rev() {
        stack.push((root.as_u64().unwrap() as usize, Mat4::IDENTITY));
    }
    while let Some((number, above)) = stack.pop() {
        let node = &nodes[number];
        let here = above * own(node);
        for child in node["children"].as_array().into_iter().flatten().rev() {
            stack.push((child.as_u64().unwrap() as usize, here));
        }
        let Some(mesh) = node["mesh"].as_u64() else { continue };
        let placements = &node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
        let all = |key: &str| numbers(&json, bytes, &placements[key]);
        let places: Vec<Mat4> = if placements.is_object() {
            let parts = all("TRANSLATION").into_iter().zip(all("ROTATION")).zip(all("SCALE"));
            let place = |((t, r), s): ((Vec<f64>, Vec<f64>), Vec<f64>)| {
                let turn = Quat::from_xyzw(r[0] as f32, r[1] as f32, r[2] as f32, r[3] as f32);
                here * Mat4::from_scale_rotation_translation(vec3(&s), turn, vec3(&t))
            };
            parts.map(place).collect()
        } else {
            vec![here]
        };
        for primitive in meshes[mesh as usize]["primitives"].as_array().unwrap() {
            let read = |name: &str| numbers(&json, bytes, &primitive["attributes"][name]);
            let material = &json["materials"][primitive["material"].as_u64().unwrap() as usize];
            let texture = &material["pbrMetallicRoughness"]["baseColorTexture"];
            let has_picture = texture.is_object();
            let transform = &texture["extensions"]["KHR_texture_transform"];
            let pair = |key: &str, usual: f32| {
                let x = |i: usize| transform[key][i].as_f64().map_or(usual, |x| x as f32);
                vec2(x(0), x(1))
            };
            let (offset, scale) = (pair("offset", 0.0), pair("scale", 1.0));
            let uvs =
                read("TEXCOORD_0").iter().map(|v| vec2(v[0] as f32, v[1] as f32) * scale + offset).collect();
            let positions = read("POSITION");
            let stand = |place: &Mat4| {
                positions.iter().map(|at| place.transform_point3(vec3(at))).collect::<Vec<_>>()
            };
            let normals = read("NORMAL").iter().map(|n| vec3(n)).collect();
            let indices = numbers(&json, bytes, &primitive["indices"]);
            seen.push((places.iter().flat_map(stand).collect(), normals, uvs, indices, has_picture));
        }
    }
    seen
}

/// Compares the files of floats and of whole numbers, and returns their sizes.
fn compare(meshers: &[Mesher<'_>], plain: &Scene<'_>) -> [usize; 2] {
    let grid = Some(Grid::new(meshers).unwrap());
    let [floats, whole] = [glb(meshers, plain), glb(meshers, &Scene { grid, ..plain.clone() })];
    let json = json_of(&whole);
    assert!(json["extensionsRequired"].as_array().unwrap().contains(&"KHR_mesh_quantization".into()));
    let (a, b) = (seen(&floats), seen(&whole));
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(&b) {
        // A tree of 13 m in 65,536 steps, and forests are a few times as wide as a tree.
        let off = a.0.iter().zip(&b.0).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
        assert!(a.0.len() == b.0.len() && off < 5e-4, "{off} m");
        assert!(a.1.iter().zip(&b.1).all(|(a, b)| a.dot(b.normalize()) > 0.9998));
        // What no picture shows is left out.
        assert_eq!(b.2.len(), if a.4 { a.2.len() } else { 0 });
        let off = a.2.iter().zip(&b.2).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
        assert!(off < 3e-3, "{off} tiles");
        assert_eq!(a.3, b.3);
    }
    [floats.len(), whole.len()]
}

#[test]
fn whole_numbers_say_what_floats_do() {
    let (species, tree) = grow("hill_cherry");
    let plain = scene(&species, &tree, 1);
    let [floats, whole] = compare(&[Mesher::new(&tree, MeshSettings::default())], &plain);
    assert!(5 * whole < 4 * floats, "{whole} of {floats} bytes");
    let _ = compare(&[Mesher::new(&tree, MeshSettings::default()).with_instanced_leaves()], &plain);
    let pictures = Scene { pictures: vec![bark()], ..plain.clone() };
    let [floats, whole] = compare(&[Mesher::new(&tree, MeshSettings::default())], &pictures);
    assert!(3 * whole < 2 * floats, "{whole} of {floats} bytes");

    let levels = lod::levels(&tree, MeshSettings::default(), 2);
    let meshers: Vec<Mesher<'_>> = levels.iter().map(lod::Level::mesher).collect();
    let site = |x: f32| Site { position: Vec3::new(x, 2.0, 0.0), turn: 0.4 * x, scale: 1.0 + 0.01 * x };
    for sites in [vec![Site::ORIGIN], vec![site(3.0)], vec![site(3.0), site(-7.0), site(11.0)]] {
        for count in [1, 2] {
            let placed = Placed { sites: sites.clone(), ..Placed::at_origin("cherry", count) };
            let _ =
                compare(&meshers[..count], &Scene { placed: vec![placed], ..scene(&species, &tree, count) });
        }
    }
}
