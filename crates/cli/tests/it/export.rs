//! Meshes from `pleach grow`, as a user makes them.

use pleach_tests::{Dir, tool};
use std::path::Path;

/// The JSON part of a GLB file.
pub(crate) fn glb(path: &Path) -> serde_json::Value {
    let bytes = std::fs::read(path).unwrap();
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!(u32::from_le_bytes(bytes[8..12].try_into().unwrap()) as usize, bytes.len());
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).unwrap()
}

pub(crate) fn names(list: &serde_json::Value) -> Vec<String> {
    list.as_array().unwrap().iter().map(|item| item["name"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn a_glb_has_levels_materials_and_the_recipe() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "acer", "--seed", "3", "-o", "tree.glb", "--lod", "3"]).ok();
    let file = glb(&dir.path("tree.glb"));
    assert_eq!(names(&file["materials"]), ["bark", "leaves"]);
    assert_eq!(file["meshes"].as_array().unwrap().len(), 3);
    let extras = &file["scenes"][0]["extras"];
    assert_eq!((&extras["species"], &extras["seed"]), (&"acer".into(), &3.into()));
    assert_eq!(extras["parameters"]["branches"].as_array().unwrap().len(), 4);
}

#[test]
fn the_same_command_writes_the_same_bytes() {
    let dir = Dir::new();
    for suffix in ["glb", "obj", "ply", "stl", "usda"] {
        let [one, two] = ["1", "2"].map(|threads| {
            let name = format!("{threads}.{suffix}");
            let _ = dir.run(["--threads", threads, "grow", "acer", "-o", &name]).ok();
            std::fs::read(dir.path(&name)).unwrap()
        });
        // An OBJ file names its material file.
        let same = if suffix == "obj" { one[40..] == two[40..] } else { one == two };
        assert!(same, "{suffix}");
    }
}

#[test]
fn an_obj_comes_with_its_materials() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "palm", "-o", "my palm.obj"]).ok();
    let text = std::fs::read_to_string(dir.path("my palm.obj")).unwrap();
    assert!(text.contains("mtllib my palm.mtl"), "{}", &text[..80]);
    assert!(std::fs::read_to_string(dir.path("my palm.mtl")).unwrap().contains("newmtl bark"));
}

#[test]
fn a_forest_is_a_few_meshes_in_many_places() {
    let dir = Dir::new();
    let forest = ["grow", "acer", "--forest", "40x30m", "--spacing", "8", "--variants", "2", "-o", "f.glb"];
    let _ = dir.run(forest).ok();
    let file = glb(&dir.path("f.glb"));
    assert_eq!(file["meshes"].as_array().unwrap().len(), 2);
    let nodes = |file: &serde_json::Value| file["scenes"][0]["nodes"].as_array().unwrap().len();
    assert_eq!(nodes(&file), 2, "a node for each variant");
    assert_eq!(file["extensionsRequired"][0], "EXT_mesh_gpu_instancing");
    let _ =
        dir.run(["grow", "acer", "--forest", "40x30m", "--variants", "2", "--separate", "-o", "s.glb"]).ok();
    let separate = glb(&dir.path("s.glb"));
    assert!(separate["extensionsRequired"].is_null());
    assert!((8..30).contains(&nodes(&separate)), "{} trees", nodes(&separate));
    assert_eq!(file["scenes"][0]["extras"]["seed"].as_array().unwrap().len(), 2);
}

/// Triangles of each mesh of a GLB file.
pub(crate) fn triangles(file: &serde_json::Value) -> Vec<u64> {
    let count = |primitive: &serde_json::Value| {
        file["accessors"][primitive["indices"].as_u64().unwrap() as usize]["count"].as_u64().unwrap() / 3
    };
    let meshes = file["meshes"].as_array().unwrap();
    meshes.iter().map(|mesh| mesh["primitives"].as_array().unwrap().iter().map(count).sum()).collect()
}

#[test]
fn levels_keep_to_budgets_of_triangles() {
    let dir = Dir::new();
    let levels = ["grow", "acer", "--triangles", "8000,2000", "--billboard", "2"];
    let _ = dir.run([&levels[..], &["-o", "b.glb"]].concat()).ok();
    let file = glb(&dir.path("b.glb"));
    assert_eq!(names(&file["meshes"]), ["acer_LOD0", "acer_LOD1", "acer_LOD2"]);
    let found = triangles(&file);
    assert!((6_800..=8_000).contains(&found[0]) && (1_700..=2_000).contains(&found[1]), "{found:?}");
    assert!(names(&file["materials"]).contains(&"twigs".to_owned()));
    let threads = |threads: &str| {
        let _ = dir.run([&["--threads", threads], &levels[..], &["-o", "t.glb"]].concat()).ok();
        std::fs::read(dir.path("t.glb")).unwrap()
    };
    assert!(threads("1") == threads("2"));

    let _ = dir.run([&levels[..], &["--lod-files", "-o", "own.glb"]].concat()).ok();
    assert!(!dir.path("own.glb").exists());
    for (level, expected) in found.iter().enumerate() {
        let file = glb(&dir.path(&format!("own_LOD{level}.glb")));
        assert_eq!(names(&file["meshes"]), [format!("acer_LOD{level}")]);
        assert_eq!(triangles(&file), [*expected]);
    }
    let _ = dir.run(["grow", "acer", "--triangles", "2000", "-o", "one.obj"]).ok();
    let materials = std::fs::read_to_string(dir.path("one.mtl")).unwrap();
    assert!(materials.contains("map_d one-twigs.png") && dir.path("one-twigs.png").exists());

    for wrong in ["0", "10", "2000,2000", "2000,8000", "many", "99999999"] {
        let run = dir.run(["grow", "acer", "--triangles", wrong, "-o", "x.glb"]);
        assert!(run.code() != 0 && run.to_string().contains("triangles"), "{wrong}: {run}");
    }
    dir.run(["grow", "acer", "--triangles", "400", "-o", "x.glb"]).fails(1, &["400", "the least"]);
    dir.run(["grow", "acer", "--triangles", "8000,2000", "-o", "x.obj"]).fails(1, &["triangles", ".glb"]);
    dir.run(["grow", "acer", "--triangles", "8000", "-o", "x.stl"]).fails(1, &["--triangles", ".usda"]);
    dir.run(["grow", "acer", "--lod", "2", "--lod-files", "-o", "-"]).fails(1, &["--lod-files"]);
    assert!(!dir.path("x.glb").exists());
}

#[test]
fn sway_wind_and_instances_are_in_the_file() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "acer", "--sway", "-o", "sway.glb"]).ok();
    assert_eq!(names(&glb(&dir.path("sway.glb"))["animations"]), ["sway"]);
    let _ = dir.run(["grow", "acer", "--wind", "-o", "wind.glb"]).ok();
    assert!(glb(&dir.path("wind.glb")).to_string().contains("TEXCOORD_7"));
    let _ = dir.run(["grow", "acer", "--growth", "-o", "growth.glb"]).ok();
    let json = glb(&dir.path("growth.glb")).to_string();
    assert!(json.contains("TEXCOORD_2") && !json.contains("TEXCOORD_3"));
    let _ = dir.run(["grow", "acer", "--leaves", "instances", "-o", "leaves.glb"]).ok();
    assert_eq!(glb(&dir.path("leaves.glb"))["extensionsRequired"][0], "EXT_mesh_gpu_instancing");
}

#[test]
fn billboards_are_the_last_level() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "acer", "--lod", "2", "--billboard", "4", "-o", "b.glb"]).ok();
    let file = glb(&dir.path("b.glb"));
    assert_eq!(names(&file["materials"]), ["bark", "leaves", "card"]);
    assert_eq!(names(&file["meshes"]), ["acer_LOD0", "acer_LOD1", "acer_LOD2"]);
    let extension = ["grow", "acer", "--lod", "2", "--billboard", "4", "--lod-extension", "-o", "b.glb"];
    let _ = dir.run(extension).ok();
    let file = glb(&dir.path("b.glb"));
    let root = &file["nodes"][file["scenes"][0]["nodes"][0].as_u64().unwrap() as usize];
    assert_eq!(root["extensions"]["MSFT_lod"]["ids"].as_array().unwrap().len(), 2);
    let wood = ["grow", "acer", "--forest", "20x20", "--variants", "2", "--billboard", "2", "-o", "f.glb"];
    let _ = dir.run(wood).ok();
    let file = glb(&dir.path("f.glb"));
    assert_eq!(file["meshes"].as_array().unwrap().len(), 4);
    let images = ["bark", "bark normal", "bark roughness", "leaves", "leaves normal", "card", "card normal"];
    assert_eq!(names(&file["images"]), images, "all trees share their pictures");
    dir.run(["grow", "acer", "-o", "b.glb", "--billboard", "9"]).fails(2, &["--billboard", "1..=8"]);
    dir.run(["grow", "acer", "-o", "b.obj", "--billboard", "2"]).fails(1, &["billboards", ".glb"]);
}

#[test]
fn what_things_bump_into_stands_beside_the_finest_level() {
    let dir = Dir::new();
    let levels = ["grow", "acer", "--triangles", "8000,2000", "--textures", "none", "--collision"];
    let _ = dir.run([&levels[..], &["-o", "c.glb"]].concat()).ok();
    let file = glb(&dir.path("c.glb"));
    let roots = file["scenes"][0]["nodes"].as_array().unwrap();
    let name = |node: &serde_json::Value| &file["nodes"][node.as_u64().unwrap() as usize]["name"];
    assert_eq!(name(&roots[0]), "acer");
    let pieces = names(&file["meshes"]);
    assert_eq!(pieces[..3], ["acer_LOD0", "acer_LOD1", "UCX_acer_LOD0_00"]);
    assert!((4..=34).contains(&pieces.len()), "{pieces:?}");
    for (node, piece) in roots[1..].iter().zip(&pieces[2..]) {
        assert_eq!(name(node), piece, "an object of its own");
    }
    assert_eq!(triangles(&file)[2..], vec![28; pieces.len() - 2]);
    let small = ["grow", "acer", "--collision", "--compress", "quantize", "-o", "q.glb"];
    let _ = dir.run(small).ok();
    assert!(names(&glb(&dir.path("q.glb"))["meshes"]).contains(&"UCX_acer_00".to_owned()));
    let _ = dir.run([&levels[..], &["--lod-files", "-o", "f.glb"]].concat()).ok();
    let of_level = |level: u32| names(&glb(&dir.path(&format!("f_LOD{level}.glb")))["meshes"]);
    assert_eq!(of_level(0), [&pieces[..1], &pieces[2..]].concat());
    assert_eq!(of_level(1), ["acer_LOD1"]);
    dir.run(["grow", "acer", "--collision", "-o", "c.obj"]).fails(1, &["--collision", ".glb"]);
}

#[test]
fn nothing_is_written_of_nothing() {
    let dir = Dir::new();
    let _ = dir.file("nothing.toml", "generator = \"stylised\"\ntrunk_height = 0\n");
    for more in [&[][..], &["--billboard", "2"], &["--lod", "3", "--billboard", "8"], &["--forest", "20x20"]]
    {
        let grow = [&["grow", "nothing.toml", "-o", "nothing.glb"], more].concat();
        dir.run(grow).fails(1, &["there is nothing to write"]);
        assert!(!dir.path("nothing.glb").exists(), "{more:?}");
    }
    let forest = ["grow", "nothing.toml", "-o", "nothing.glb", "--forest", "20x20", "--billboard", "2"];
    dir.run(forest).fails(1, &["there is nothing to write"]);
}

#[test]
fn a_usda_places_leaves_and_names_its_pictures() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "palm", "--seed", "2", "--leaves", "cards", "-o", "a palm.usda"]).ok();
    let text = std::fs::read_to_string(dir.path("a palm.usda")).unwrap();
    assert!(text.starts_with("#usda 1.0\n"));
    for words in
        ["string seed = \"2\"", "upAxis = \"Z\"", "@./a palm-leaves.png@", "def PointInstancer \"leaves\""]
    {
        assert!(text.contains(words), "{words}");
    }
    let leaves = dir.run(["grow", "palm", "--seed", "2", "--stats-only", "--json"]).json()["leaves"].clone();
    let places = text.lines().find(|l| l.contains("protoIndices")).unwrap().matches('0').count();
    assert_eq!(leaves, places);
    assert!(dir.path("a palm-leaves.png").exists());
}

#[test]
fn cards_bring_pictures_of_leaves() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "acer", "--leaves", "cards", "-o", "cards.glb"]).ok();
    let file = glb(&dir.path("cards.glb"));
    let images = ["bark", "bark normal", "bark roughness", "leaves", "leaves normal"];
    assert_eq!(names(&file["images"]), images);
    assert_eq!(file["materials"][1]["alphaMode"], "MASK");
    let _ = dir.run(["grow", "acer", "--leaves", "cards", "-o", "cards.obj"]).ok();
    assert!(std::fs::read_to_string(dir.path("cards.mtl")).unwrap().contains("map_Kd cards-leaves.png"));
    assert!(image::open(dir.path("cards-leaves.png")).unwrap().color().has_alpha());
}

#[test]
fn bark_has_pictures_of_the_size_that_was_asked_for() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "palm", "--textures", "512", "--lod", "2", "-o", "palm.glb"]).ok();
    let file = glb(&dir.path("palm.glb"));
    let bark = ["bark", "bark normal", "bark roughness"];
    assert_eq!(names(&file["images"]), [&bark[..], &["leaves", "leaves normal"]].concat());
    assert_eq!(file["samplers"][file["textures"][0]["sampler"].as_u64().unwrap() as usize]["wrapS"], 10_497);
    let _ = dir.run(["grow", "palm", "--textures", "512", "-o", "palm.obj"]).ok();
    assert!(std::fs::read_to_string(dir.path("palm.mtl")).unwrap().contains("norm palm-bark-normal.png"));
    let bark = ["palm-bark.png", "palm-bark-normal.png", "palm-bark-roughness.png"];
    for name in bark.into_iter().chain(["palm-leaves.png", "palm-leaves-normal.png"]) {
        let picture = image::open(dir.path(name)).unwrap();
        assert_eq!((picture.width(), picture.height()), (512, 512), "{name}");
    }
    let one_thread = ["grow", "palm", "--textures", "512", "--threads", "1", "-o", "palm.usda"];
    let before = std::fs::read(dir.path("palm-bark.png")).unwrap();
    let _ = dir.run(one_thread).ok();
    assert_eq!(std::fs::read(dir.path("palm-bark.png")).unwrap(), before);
    for wrong in ["0", "1000", "65536", "many"] {
        dir.run(["grow", "palm", "--textures", wrong, "-o", "x.glb"]).fails(2, &["512, 1024, 2048, or none"]);
    }
    dir.run(["grow", "palm", "--textures", "512", "-o", "x.stl"]).fails(1, &["--textures"]);
    dir.run(["grow", "palm", "--textures", "512", "-o", "-", "--format", "obj"])
        .fails(1, &["--textures", ".glb"]);
}

/// Leaves as triangles need no cutting; leaves as rectangles have their outline in the picture.
#[test]
fn leaves_show_pictures_and_let_light_through() {
    let dir = Dir::new();
    let material = |options: &[&str]| {
        let _ = dir.run([&["grow", "hill_cherry", "-o", "t.glb"], options].concat()).ok();
        let file = glb(&dir.path("t.glb"));
        assert_eq!(file["extensionsUsed"][0], "KHR_materials_diffuse_transmission");
        let all = file["materials"].as_array().unwrap().clone();
        all.into_iter().find(|material| material["name"] == "blossom").unwrap()
    };
    let through = |material: &serde_json::Value| {
        material["extensions"]["KHR_materials_diffuse_transmission"]["diffuseTransmissionFactor"].as_f64()
    };
    let plain = material(&["--textures", "none"]);
    assert!(plain["normalTexture"].is_null() && through(&plain) == Some(0.4));
    let triangles = material(&["--textures", "512", "--leaves", "outline"]);
    assert!(triangles["normalTexture"].is_object() && triangles["alphaMode"].is_null());
    let rectangles = material(&["--textures", "512", "--leaves", "simple"]);
    assert_eq!((&rectangles["alphaMode"], through(&rectangles)), (&"MASK".into(), Some(0.4)));
    // Fewer triangles of leaves that look the same.
    let _ = dir.run(["grow", "acer", "--textures", "512", "--triangles", "16000", "-o", "t.glb"]).ok();
    assert_eq!(glb(&dir.path("t.glb"))["materials"][1]["alphaMode"], "MASK");
}

#[test]
fn a_tree_without_leaves_has_one_material() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "acer", "--no-leaves", "-o", "bare.glb"]).ok();
    let _ = dir.run(["grow", "acer", "--season", "winter", "-o", "winter.glb", "--lod", "2"]).ok();
    let _ = dir.run(["grow", "acer", "--leaves", "none", "-o", "none.glb"]).ok();
    let _ = dir.file("leafless.toml", "levels = 2\nleaf_blos_num = 0");
    let _ = dir.run(["grow", "leafless.toml", "--leaves", "cards", "-o", "leafless.glb"]).ok();
    for name in ["bare.glb", "winter.glb", "none.glb", "leafless.glb"] {
        assert_eq!(names(&glb(&dir.path(name))["materials"]), ["bark"], "{name}");
    }
}

#[test]
fn species_without_leaves_fit_every_format_and_style() {
    let dir = Dir::new();
    let _ = dir.file("leafless.toml", "levels = 2\nleaf_blos_num = 0");
    for suffix in ["obj", "ply", "stl", "usda"] {
        let name = format!("tree.{suffix}");
        let _ = dir.run(["grow", "leafless.toml", "-o", &name]).ok();
        assert!(std::fs::metadata(dir.path(&name)).unwrap().len() > 1000, "{suffix}");
    }
    for style in ["outline", "simple", "cards", "instances", "none"] {
        let levels = ["grow", "leafless.toml", "--leaves", style, "--lod", "6", "--billboard", "1"];
        let _ = dir.run([&levels[..], &["--season", "winter", "-o", "t.glb"]].concat()).ok();
        assert_eq!(names(&glb(&dir.path("t.glb"))["materials"]), ["bark", "card"], "{style}");
    }
    let _ = dir.run(["render", "leafless.toml", "--size", "32", "-o", "tree.png"]).ok();
}

#[test]
fn colours_come_from_the_species_file() {
    let dir = Dir::new();
    let species = std::fs::read_to_string(pleach_tests::root().join("species/weber-penn/palm.toml")).unwrap();
    // The table comes last in a species file.
    let species = species.split("\n[appearance]").next().unwrap().to_owned();
    let _ = dir.file("red.toml", format!("{species}\n[appearance]\nleaf = \"#ff0000\"\n"));
    let _ = dir.run(["grow", "red.toml", "-o", "red.glb", "--textures", "none"]).ok();
    let leaves = &glb(&dir.path("red.glb"))["materials"][1];
    assert_eq!(leaves["pbrMetallicRoughness"]["baseColorFactor"], serde_json::json!([1.0, 0.0, 0.0, 1.0]));
    let _ = dir.file("wrong.toml", format!("{species}\n[appearance]\nleaf = \"green\"\n"));
    dir.run(["grow", "wrong.toml", "-o", "x.glb"]).fails(1, &["wrong.toml:", "appearance.leaf", "#rrggbb"]);
}

/// What Blender imports: skipped, and told so, where there is no Blender or half of one.
#[test]
fn blender_opens_what_was_written() {
    let script = pleach_tests::root().join("experiments/export/blender.py");
    let blender = || {
        let mut blender = std::process::Command::new("blender");
        blender.args(["--background", "--factory-startup", "--python-exit-code", "1", "--python"]);
        blender.arg(&script).arg("--");
        blender
    };
    let needs = "Blender with NumPy for its Python (Debian: apt-get install blender python3-numpy)";
    if !tool::is_usable(needs, blender().arg("--check")) {
        return;
    }
    let dir = Dir::new();
    let _ = dir.run(["grow", "acer", "--seed", "1", "--finest", "-o", "acer.glb"]).ok();
    let run = blender().arg("--csv").args([dir.path("b.csv"), dir.path("acer.glb")]).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let committed = pleach_tests::root().join("experiments/export/blender.csv");
    let row = |path: &Path| {
        let text = std::fs::read_to_string(path).unwrap();
        let row = text.lines().find(|l| l.starts_with("acer,")).unwrap().to_owned();
        // The last column is a time.
        row.rsplit_once(',').unwrap().0.to_owned()
    };
    assert_eq!(row(&dir.path("b.csv")), row(&committed));
}

/// Sizes of `experiments/export` again, for two small species.
#[test]
fn files_are_as_large_as_measured() {
    let dir = Dir::new();
    for (results, more) in [("results.csv", &["--finest"][..]), ("usual.csv", &[])] {
        let results = pleach_tests::root().join("experiments/export").join(results);
        let results = std::fs::read_to_string(results).unwrap();
        for name in ["acer", "palm"] {
            let _ = dir.run([&["grow", name, "--seed", "1", "-o", "tree.glb"], more].concat()).ok();
            let file = glb(&dir.path("tree.glb"));
            let corners: u64 = file["meshes"][0]["primitives"]
                .as_array()
                .unwrap()
                .iter()
                .map(|primitive| {
                    let accessor = primitive["attributes"]["POSITION"].as_u64().unwrap();
                    file["accessors"][accessor as usize]["count"].as_u64().unwrap()
                })
                .sum();
            let bytes = std::fs::metadata(dir.path("tree.glb")).unwrap().len();
            let row = format!("{name},1,{corners},{},{bytes}", triangles(&file)[0]);
            let is_row = |line: &str| line == row || line.starts_with(&format!("{row},"));
            assert!(results.lines().any(is_row), "{row} is not in the results");
        }
    }
}

#[test]
fn what_cannot_be_written_says_what_can() {
    let dir = Dir::new();
    dir.run(["grow", "acer", "-o", "tree.fbx"])
        .fails(1, &["`.fbx`", ".glb", ".obj", ".ply", ".stl", ".usda", ".png"]);
    for level in ["0", "99"] {
        dir.run(["grow", "acer", "-o", "tree.glb", "--lod", level]).fails(2, &["--lod", "1..=6"]);
    }
    dir.run(["grow", "acer", "-o", "tree.glb", "--billboard", "0"]).fails(2, &["--billboard", "1..=8"]);
    dir.run(["grow", "acer", "-o", "tree.glb", "--leaves", "some"]).fails(2, &["outline", "cards", "none"]);
    dir.run(["grow", "acer", "-o", "tree.usda", "--lod", "2"]).fails(1, &["levels of detail", ".glb"]);
    dir.run(["grow", "acer", "-o", "tree.usda", "--sway"]).fails(1, &["animation", ".glb"]);
    dir.run(["grow", "weeping_willow", "--weld", "1", "-o", "tree.stl"]).fails(1, &["too fine", "larger"]);
    assert!(!dir.path("tree.stl").exists());
    dir.run(["grow", "acer", "-o", "tree.obj", "--lod", "2"]).fails(1, &["levels of detail", ".glb"]);
    dir.run(["grow", "acer", "-o", "tree.ply", "--forest", "9x9"]).fails(1, &["forest", ".glb"]);
    dir.run(["grow", "acer", "-o", "tree.glb", "--forest", "big"]).fails(2, &["40x30m"]);
    dir.run(["grow", "acer", "-o", "f.glb", "--forest", "9e9x9e9"]).fails(1, &["more than", "spacing"]);
    dir.run(["grow", "acer", "-o", "f.glb", "--forest", "9x9", "--spacing", "0"]).fails(1, &["positive"]);
    dir.run(["grow", "acer", "-o", "tree.glb", "--tolerance", "0"]).fails(2, &["millimetres"]);
    std::fs::create_dir(dir.path("folder.glb")).unwrap();
    dir.run(["grow", "acer", "-o", "folder.glb"]).fails(1, &["folder.glb", "is a folder"]);
    assert_eq!(std::fs::read_dir(dir.path("folder.glb")).unwrap().count(), 0);
    dir.run(["grow", "acer", "-o", "no/such/tree.glb"]).fails(1, &["no/such/tree.glb"]);
}

/// A limit on the size of files stands for a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_is_told_of_by_every_format() {
    for suffix in ["glb", "obj", "ply", "stl", "usda"] {
        let dir = Dir::new();
        let name = format!("tree.{suffix}");
        let script = "trap '' XFSZ; ulimit -f 200; exec \"$0\" grow acer -o \"$1\"";
        let mut shell = std::process::Command::new("sh");
        shell.current_dir(dir.path(".")).args(["-c", script]).arg(pleach_tests::program()).arg(&name);
        let output = shell.output().unwrap();
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{suffix}: {message}");
        assert!(message.contains(&format!("cannot write {name}")), "{suffix}: {message}");
        assert!(!message.contains("panicked"), "{message}");
        assert_eq!(std::fs::read_dir(dir.path(".")).unwrap().count(), 0, "{suffix}: no half file is left");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_device_is_told_of() {
    let dir = Dir::new();
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = dir.command(["grow", "acer", "--stats-only"]).stdout(full()).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("error:") && !message.contains("panicked"), "{message}");
}

/// A limit on the size of files stands for a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_leaves_the_good_file_and_nothing_else() {
    let dir = Dir::new();
    let good = dir.file("tree.glb", "a good file");
    let script = "trap '' XFSZ; ulimit -f 200; \"$0\" grow acer -o tree.glb";
    let mut shell = std::process::Command::new("sh");
    shell.current_dir(good.parent().unwrap()).arg("-c").arg(script).arg(pleach_tests::program());
    let output = shell.output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("cannot write tree.glb") && !message.contains("panicked"), "{message}");
    assert_eq!(std::fs::read(&good).unwrap(), b"a good file");
    assert_eq!(std::fs::read_dir(good.parent().unwrap()).unwrap().count(), 1, "no half file is left");
}
