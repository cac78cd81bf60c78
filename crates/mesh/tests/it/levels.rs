//! Levels of detail in a GLB file.

use crate::files::{glb, grow, json_of, levels_glb, scene};
use pleach_mesh::lod::{self, Level};
use pleach_mesh::write::glb::Scene;
use pleach_mesh::{MeshSettings, Mesher};

#[test]
fn levels_are_named_nodes_below_the_tree() {
    let json = json_of(&levels_glb("acer", 4));
    let nodes = &json["scenes"][0]["nodes"];
    assert_eq!(nodes.as_array().unwrap().len(), 1);
    let tree = &json["nodes"][nodes[0].as_u64().unwrap() as usize];
    assert_eq!(tree["name"], "acer");
    for (level, node) in tree["children"].as_array().unwrap().iter().enumerate() {
        let node = &json["nodes"][node.as_u64().unwrap() as usize];
        let mesh = &json["meshes"][node["mesh"].as_u64().unwrap() as usize];
        assert_eq!(node["name"], format!("acer_LOD{level}"));
        assert_eq!(node["name"], mesh["name"]);
    }
    // Nothing that a program has to know.
    assert!(json["extensionsRequired"].is_null());
    assert_eq!(json["extensionsUsed"], serde_json::json!(["KHR_materials_diffuse_transmission"]));
}

#[test]
fn levels_of_the_extension_hang_on_the_finest_and_extras_name_the_tree() {
    let (species, tree) = grow("acer");
    let levels = lod::levels(&tree, MeshSettings::default(), 4);
    let meshers: Vec<Mesher<'_>> = levels.iter().map(Level::mesher).collect();
    let json = json_of(&glb(&meshers, &Scene { lod_extension: true, ..scene(&species, &tree, 4) }));
    let root = &json["nodes"][json["scenes"][0]["nodes"][0].as_u64().unwrap() as usize];
    let levels = root["extensions"]["MSFT_lod"]["ids"].as_array().unwrap();
    assert_eq!(levels.len(), 3);
    assert_eq!(root["extras"]["MSFT_screencoverage"].as_array().unwrap().len(), 4);
    assert_eq!(json["scenes"][0]["nodes"].as_array().unwrap().len(), 1, "coarse levels are not in the scene");
    assert_eq!(json["scenes"][0]["extras"]["species"], "acer");
    assert_eq!(json["scenes"][0]["extras"]["seed"], 1);
}
