//! Textures for Unreal beside a GLB file, read back as Unreal's functions read them.

use crate::export::{glb, names};
use pleach_tests::Dir;
use std::collections::BTreeMap;
use std::path::Path;

/// The numbers of all `VEC2` accessors of one name in a file, primitive by primitive.
fn pairs(path: &Path, name: &str) -> Vec<[f32; 2]> {
    let (bytes, json) = (std::fs::read(path).unwrap(), glb(path));
    let start = 28 + u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let whole = |value: &serde_json::Value| value.as_u64().unwrap_or(0) as usize;
    let mut pairs = Vec::new();
    for mesh in json["meshes"].as_array().unwrap() {
        for primitive in mesh["primitives"].as_array().unwrap() {
            let accessor = &json["accessors"][whole(&primitive["attributes"][name])];
            assert_eq!((&accessor["type"], &accessor["componentType"]), (&"VEC2".into(), &5126.into()));
            let view = &json["bufferViews"][whole(&accessor["bufferView"])];
            let first = start + whole(&view["byteOffset"]) + whole(&accessor["byteOffset"]);
            for i in 0..whole(&accessor["count"]) {
                let at = first + i * whole(&view["byteStride"]);
                let float = |at: usize| f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
                pairs.push([float(at), float(at + 4)]);
            }
        }
    }
    pairs
}

/// A texture of half floats: its width, and the bits of red, green, blue and alpha of each pixel.
struct Halves {
    width: usize,
    pixels: Vec<[u16; 4]>,
}

/// Reads an OpenEXR file of one part, of scan lines of half floats that are not compressed.
fn exr(path: &Path) -> Halves {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(bytes[..8], [0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]);
    let mut at = 8;
    let text = |at: &mut usize| {
        let length = bytes[*at..].iter().position(|byte| *byte == 0).unwrap();
        let text = String::from_utf8(bytes[*at..*at + length].to_vec()).unwrap();
        *at += length + 1;
        text
    };
    let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    let mut values = BTreeMap::new();
    loop {
        let name = text(&mut at);
        if name.is_empty() {
            break;
        }
        let kind = text(&mut at);
        let length = number(at);
        let _ = values.insert(name, (kind, at + 4..at + 4 + length));
        at += 4 + length;
    }
    let needed = [
        "channels",
        "compression",
        "dataWindow",
        "displayWindow",
        "lineOrder",
        "pixelAspectRatio",
        "screenWindowCenter",
        "screenWindowWidth",
    ];
    assert!(needed.iter().all(|name| values.contains_key(*name)), "{values:?}");
    assert_eq!(bytes[values["compression"].1.clone()], [0]);
    let (_, window) = values["dataWindow"].clone();
    let (width, height) = (number(window.start + 8) + 1, number(window.start + 12) + 1);
    let (_, list) = values["channels"].clone();
    let mut channels = Vec::new();
    let mut from = list.start;
    while bytes[from] != 0 {
        channels.push(text(&mut from));
        assert_eq!(number(from), 1, "half floats");
        from += 16;
    }
    assert_eq!(channels, ["A", "B", "G", "R"], "in the order of the alphabet");
    let mut pixels = vec![[0; 4]; width * height];
    for y in 0..height {
        let line = u64::from_le_bytes(bytes[at + 8 * y..at + 8 * y + 8].try_into().unwrap()) as usize;
        assert_eq!((number(line), number(line + 4)), (y, 8 * width));
        for (channel, place) in [3, 2, 1, 0].into_iter().enumerate() {
            for x in 0..width {
                let at = line + 8 + 2 * (channel * width + x);
                pixels[y * width + x][place] = u16::from_le_bytes([bytes[at], bytes[at + 1]]);
            }
        }
    }
    assert_eq!(bytes.len(), at + 8 * height + height * (8 + 8 * width));
    Halves { width, pixels }
}

/// The number that the bits of a half float stand for.
fn half(bits: u16) -> f32 {
    let size = f32::from_bits(u32::from(bits & 0x7fff) << 13) * 2.0_f32.powi(112);
    if bits & 0x8000 == 0 { size } else { -size }
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f32>().sqrt()
}

/// `--wind` gives the same vertices the same pivots as numbers, which is what the textures are compared with.
#[test]
fn vertices_find_their_pivots_in_the_textures() {
    let dir = Dir::new();
    for (name, more) in [("acer", &["--triangles", "20000,3000"][..]), ("quaking_aspen", &[])] {
        let run = |option: &str, file: &str| {
            let _ = dir.run([&["grow", name, option, "-o", file], more].concat()).ok();
        };
        run("--pivot-painter", "tree.glb");
        run("--wind", "wind.glb");
        let (positions, axes) = (exr(&dir.path("tree-pivots.exr")), image::open(dir.path("tree-axes.png")));
        let axes = axes.unwrap().to_rgba8();
        assert_eq!(axes.width() as usize, positions.width);
        let size = [positions.width as f32, axes.height() as f32];
        let pixels = pairs(&dir.path("tree.glb"), "TEXCOORD_1");
        let set = |number: u32| pairs(&dir.path("wind.glb"), &format!("TEXCOORD_{number}"));
        let [one, two, four, five] = [1, 2, 4, 5].map(set);
        assert_eq!(pixels.len(), one.len(), "{name}");
        let mut seen = std::collections::BTreeSet::new();
        for (i, [u, v]) in pixels.into_iter().enumerate() {
            let (x, y) = ((u * size[0]).floor() as usize, (v * size[1]).floor() as usize);
            let [red, green, blue, parent] = positions.pixels[x + y * positions.width];
            let parent = usize::from(parent - 1024);
            // In metres of the file: Unreal's y is its z, and Unreal's z its y.
            let metres = |bits: [u16; 3]| {
                let [x, y, z] = bits.map(half);
                [x / 100.0, z / 100.0, y / 100.0]
            };
            let allowed = 0.01;
            let pivot = metres([red, green, blue]);
            assert!(distance(pivot, [one[i][0], one[i][1], two[i][0]]) < allowed, "{name} {i}");
            let [red, green, blue, _] = positions.pixels[parent];
            let carrier = metres([red, green, blue]);
            assert!(distance(carrier, [four[i][0], four[i][1], five[i][0]]) < allowed, "{name} {i}");
            let axis = axes.get_pixel(x as u32, y as u32).0;
            let length = axis[..3].iter().map(|byte| (f32::from(*byte) / 127.5 - 1.0).powi(2)).sum::<f32>();
            assert!((length.sqrt() - 1.0).abs() < 0.02 && axis[3] > 0, "{name} {i}: {axis:?}");
            let _ = seen.insert((x, y));
        }
        assert!(seen.len() > 20, "{name}: {} pixels", seen.len());
    }
}

#[test]
fn levels_share_the_textures_and_what_cannot_have_them_is_refused() {
    let dir = Dir::new();
    let levels = ["grow", "acer", "--triangles", "8000,2000", "--billboard", "2", "--pivot-painter"];
    let _ = dir.run([&levels[..], &["--lod-files", "--collision", "-o", "own.glb"]].concat()).ok();
    assert!(dir.path("own_LOD0-pivots.exr").exists() && dir.path("own_LOD0-axes.png").exists());
    assert!(dir.path("own_LOD1.glb").exists() && !dir.path("own_LOD1-pivots.exr").exists());
    let _ = dir.run([&levels[..], &["-o", "all.glb"]].concat()).ok();
    assert_eq!(names(&glb(&dir.path("all.glb"))["meshes"]).len(), 3);
    let read = |name: &str| std::fs::read(dir.path(name)).unwrap();
    assert!(read("all-pivots.exr") == read("own_LOD0-pivots.exr"));
    let _ = dir.run(["grow", "acer", "--pivot-painter", "-o", "usual.glb"]).ok();
    assert!(read("all-axes.png") == read("usual-axes.png"), "textures are of the whole tree");

    for other in [&["--wind"][..], &["--growth"], &["--sway"], &["--forest", "9x9"], &["--weld", "20"]] {
        let args = [&["grow", "acer", "--pivot-painter", "-o", "x.glb"], other].concat();
        dir.run(args).fails(2, &["--pivot-painter", other[0]]);
    }
    let small = ["grow", "acer", "--pivot-painter", "--compress", "quantize", "-o", "x.glb"];
    dir.run(small).fails(2, &["--pivot-painter", "--compress"]);
    let instances = ["grow", "acer", "--pivot-painter", "--leaves", "instances", "-o", "x.glb"];
    dir.run(instances).fails(1, &["`pivot_painter`", "`leaves` as instances"]);
    dir.run(["grow", "acer", "--pivot-painter", "-o", "x.ply"]).fails(1, &["--pivot-painter", ".glb"]);
    let stdout = ["grow", "acer", "--pivot-painter", "--format", "glb", "-o", "-"];
    dir.run(stdout).fails(1, &["--pivot-painter", "standard output"]);
    assert!(!dir.path("x.glb").exists());
}
