//! Welded stems: watertight for printers, and with bark within budgets.

use crate::export::glb;
use pleach_tests::Dir;

/// Every edge of the triangles of an STL file lies between two of them.
#[test]
fn a_welded_tree_is_watertight() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "acer", "--leaves", "none", "--weld", "20", "-o", "print.stl"]).ok();
    let bytes = std::fs::read(dir.path("print.stl")).unwrap();
    let mut edges = std::collections::BTreeMap::<_, i32>::new();
    for triangle in bytes[84..].chunks_exact(50) {
        let corner = |k: usize| <[u8; 12]>::try_from(&triangle[12 + 12 * k..24 + 12 * k]).unwrap();
        for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(a, b)| (corner(a), corner(b))) {
            // There and back: a closed surface goes along each edge once each way.
            *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
        }
    }
    assert!(edges.len() > 10_000 && edges.values().all(|n| *n == 0));
    dir.run(["grow", "acer", "--weld", "0.1", "-o", "x.stl"]).fails(2, &["--weld", "1 to 1000"]);
    dir.run(["grow", "acer", "--weld", "20", "--lod", "2", "-o", "x.glb"]).fails(2, &["--weld", "--lod"]);
}

/// The thick stems are one surface with bark on it, beside tubes and cards, and within the budgets.
#[test]
fn welded_levels_keep_to_their_budgets_and_show_bark() {
    let dir = Dir::new();
    let grow = ["grow", "acer", "--triangles", "20000,4000", "-o"];
    let weld = ["--weld", "30", "--fillet", "2"];
    let _ = dir.run(grow.into_iter().chain(["tubes.glb"])).ok();
    let _ = dir.run(grow.into_iter().chain(["welded.glb"]).chain(weld)).ok();
    let _ = dir.run(grow.into_iter().chain(["again.glb"]).chain(weld).chain(["--threads", "1"])).ok();
    let bytes = |name: &str| std::fs::read(dir.path(name)).unwrap();
    assert!(bytes("welded.glb") == bytes("again.glb"));
    let triangles = |name: &str| -> Vec<u64> {
        let json = glb(&dir.path(name));
        let of = |primitive: &serde_json::Value| {
            let accessor = primitive["indices"].as_u64().unwrap() as usize;
            json["accessors"][accessor]["count"].as_u64().unwrap() / 3
        };
        let meshes = json["meshes"].as_array().unwrap().iter();
        meshes.map(|mesh| mesh["primitives"].as_array().unwrap().iter().map(of).sum()).collect()
    };
    let (welded, tubes) = (triangles("welded.glb"), triangles("tubes.glb"));
    for (welded, tubes) in welded.iter().zip(&tubes) {
        assert!((tubes * 95 / 100..=*tubes).contains(welded), "{welded} of {tubes}");
    }
    // As many triangles are not the same triangles.
    let corners = |name: &str| {
        let json = glb(&dir.path(name));
        let position = json["meshes"][0]["primitives"][0]["attributes"]["POSITION"].as_u64().unwrap();
        json["accessors"][position as usize]["count"].as_u64().unwrap()
    };
    assert_ne!(corners("welded.glb"), corners("tubes.glb"), "nothing is welded");
    let json = glb(&dir.path("welded.glb"));
    let bark =
        json["materials"].as_array().unwrap().iter().find(|material| material["name"] == "bark").unwrap();
    assert!(
        bark["pbrMetallicRoughness"]["baseColorTexture"].is_object() && bark["normalTexture"].is_object()
    );
    let attributes = &json["meshes"][0]["primitives"][0]["attributes"];
    assert!(attributes["TEXCOORD_0"].is_u64() && attributes["TANGENT"].is_u64(), "{attributes}");
}

/// What wind needs is in the welded bark as in all else.
#[test]
fn welded_stems_carry_numbers_for_shaders() {
    let dir = Dir::new();
    let weld = ["grow", "acer", "--triangles", "4000", "--weld", "40", "-o", "tree.glb"];
    let _ = dir.run(weld.into_iter().chain(["--wind"])).ok();
    let json = glb(&dir.path("tree.glb"));
    for primitive in json["meshes"][0]["primitives"].as_array().unwrap() {
        for set in 1..=7 {
            assert!(primitive["attributes"][&format!("TEXCOORD_{set}")].is_u64(), "{primitive}");
        }
    }
    dir.run(weld.into_iter().chain(["--growth"])).fails(2, &["--weld", "--growth"]);
}
