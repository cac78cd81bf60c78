//! `pleach map`, as a user would run it.

use pleach_tests::Dir;

fn species_file(dir: &Dir, name: &str, change: impl Fn(String) -> String) -> String {
    let text = Dir::new().run(["species", "silver_birch"]).ok();
    let text = change(text.replace("name = \"silver_birch\"", &format!("name = \"{name}\"")));
    dir.file(&format!("{name}.toml"), text).to_str().unwrap().to_owned()
}

#[test]
fn the_fifteen_are_laid_out() {
    let dir = Dir::new();
    let printed = dir.run(["map", "--grid", "3x2", "--out", "m"]).ok();
    assert!(printed.contains("explained") && printed.contains("100.0 %"), "{printed}");
    assert!(printed.contains("height to width"), "{printed}");
    // Two axes are on the picture; the others share a line.
    assert!(printed.contains("\n3–14") && printed.lines().count() < 15, "{printed}");
    let dots = std::fs::read_to_string(dir.path("m/map.csv")).unwrap();
    assert_eq!(dots.lines().count(), 16);
    assert!(dots.starts_with("species,x,y,residual\nquaking_aspen,"), "{dots}");
    let loadings = std::fs::read_to_string(dir.path("m/loadings.csv")).unwrap();
    assert!(
        loadings.starts_with("parameter,feature,axis_1,axis_2,")
            && loadings.contains("\ntaper[0],taper[0] from 2,")
    );
    let svg = std::fs::read_to_string(dir.path("m/map.svg")).unwrap();
    assert!(svg.contains(">weeping willow</text>"));
    assert!(svg.contains(">15 species, on two axes that show 33 % of how they differ</text>"), "{svg}");
    for (name, width, height) in [("map.png", 1500, 1060), ("grid.png", 3 * 136 + 8, 2 * 150 + 8)] {
        let picture = image::open(dir.path("m").join(name)).unwrap();
        assert_eq!((picture.width(), picture.height()), (width, height), "{name}");
    }
}

#[test]
fn explained_variance_is_that_of_numpy() {
    // See `explained_variance_of_the_fifteen_agrees_with_numpy` in crates/blend.
    let report = Dir::new().run(["map", "--no-thumbnails", "--json", "--out", "m"]).json();
    let share = |axis: usize| report["explained_variance"][axis].as_f64().unwrap();
    assert!((share(0) - 0.185_915_010_593_915).abs() < 1e-9);
    assert!((share(13) - 0.014_176_626_915_529).abs() < 1e-9);
}

#[test]
fn the_same_map_on_one_thread_and_on_four() {
    let dir = Dir::new();
    for (threads, out) in [("1", "one"), ("4", "four")] {
        let args = ["map", "--threads", threads, "--traits", "ink", "--layout", "looks", "--out", out];
        let _ = dir.run([&args[..], &["--only", "palm,acer,apple,small_pine"]].concat()).ok();
    }
    for file in ["map.png", "map.svg", "map.csv", "loadings.csv"] {
        let read = |out: &str| std::fs::read(dir.path(out).join(file)).unwrap();
        assert!(read("one") == read("four"), "{file}");
    }
}

#[test]
fn few_species_have_no_correlations() {
    let dir = Dir::new();
    for (names, has_table) in
        [("acer,palm", false), ("acer,palm,apple,bamboo", false), ("acer,palm,apple,bamboo,small_pine", true)]
    {
        let printed = dir.run(["map", "--only", names, "-o", "m"]).ok();
        assert_eq!(printed.contains("height to width"), has_table, "{names}\n{printed}");
        assert!(!printed.contains("1.00"), "{names}\n{printed}");
        assert!(printed.contains("100.0 %"), "{printed}");
        let report = dir.run(["map", "--only", names, "-o", "m", "--json"]).json();
        assert_eq!(report["traits"].as_object().unwrap().len(), if has_table { 5 } else { 0 });
    }
}

#[test]
fn own_species_stand_beside_the_built_in_ones() {
    let dir = Dir::new();
    std::fs::create_dir(dir.path("mine")).unwrap();
    let _ = species_file(&dir, "mine/tall_birch", |t| t.replace("g_scale = 20", "g_scale = 40"));
    let rename = std::fs::read_to_string(dir.path("mine/tall_birch.toml")).unwrap().replace("mine/", "");
    std::fs::write(dir.path("mine/tall_birch.toml"), rename).unwrap();
    let args = ["map", "--no-thumbnails", "--json", "--species", "mine", "--out", "m"];
    let report = dir.run(args).json();
    assert_eq!(report["species"].as_array().unwrap().len(), 16);
    assert_eq!(report["species"][15]["species"], "tall_birch");

    // One broken file is named; the rest goes on if asked to.
    let _ = dir.file("mine/broken.toml", "generator = \"weber-penn\"\ng_scale = \"tall\"\n");
    dir.run(args).fails(1, &["broken.toml", "g_scale", "--keep-going"]);
    let run = dir.run([&args[..], &["--keep-going"]].concat());
    assert_eq!(run.json()["species"].as_array().unwrap().len(), 16);
    assert!(run.stderr().contains("broken.toml"), "{run}");
}

#[test]
fn maps_that_cannot_be() {
    let dir = Dir::new();
    dir.run(["map", "--only", "palm", "--out", "m"]).fails(1, &["at least two species", "found 1"]);
    dir.run(["map", "--only", "palm", "--layout", "looks", "--out", "m"]).fails(1, &["at least two species"]);
    dir.run(["map", "--only", "palm,quaking_aspn", "--out", "m"]).fails(1, &["did you mean `quaking_aspen`"]);
    dir.run(["map", "--grid", "9by9", "--out", "m"]).fails(2, &["9x9"]);
    dir.run(["map", "--grid", "0x9", "--out", "m"]).fails(2, &["9x9"]);
    dir.run(["map", "--traits", "inc", "--out", "m"]).fails(2, &["inc", "did you mean `ink`? Known are"]);
    dir.run(["map", "--traits", "foo", "--out", "m"]).fails(2, &["called `foo`. Known are height_to_width"]);
    dir.run(["map", "-o", "-"]).fails(2, &["several files", "standard output", "folder"]);
    assert!(!dir.path("-").exists());
    dir.run(["map", "--species", "nowhere", "--out", "m"]).fails(1, &["nowhere"]);
    std::fs::create_dir(dir.path("empty")).unwrap();
    dir.run(["map", "--species", "empty", "--out", "m"]).fails(1, &["empty", ".toml"]);
    let _ = dir.file("file", "");
    dir.run(["map", "--no-thumbnails", "--out", "file"]).fails(1, &["file"]);
    // A twin of one species under another name is not an error on a map of many.
    let twin = species_file(&dir, "twin", |t| t);
    let run = dir.run(["map", "--no-thumbnails", "--species", &twin, "--out", "m"]);
    let _ = run.ok();
    assert!(run.stderr().contains("`silver_birch` and `twin`"), "{run}");
    // And the only difference there is on a map of two.
    dir.run(["map", "--only", "silver_birch", "--species", &twin, "--out", "m"])
        .fails(1, &["same parameters"]);
    // The same name twice cannot be told apart.
    let again = species_file(&dir, "palm", |t| t);
    dir.run(["map", "--species", &again, "--out", "m"])
        .fails(1, &["two species are called `palm`", "`name`"]);
}
