//! Which options `pleach grow` takes for which kind of file: the table in its help, cell by cell.

use pleach_tests::{Dir, Run};

/// The columns of the table and its rows: an option, and whether each column takes it.
fn table(dir: &Dir) -> (Vec<String>, Vec<(String, Vec<bool>)>) {
    let help = dir.run(["grow", "--help"]).ok();
    let mut lines = help.lines().skip_while(|line| !line.starts_with("What takes which option")).skip(1);
    let columns: Vec<String> = lines.next().unwrap().split_whitespace().map(str::to_owned).collect();
    let rows = lines.map_while(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let (option, marks) = words.split_at_checked(words.len().checked_sub(columns.len())?)?;
        Some((option.join(" "), marks.iter().map(|mark| *mark == "x").collect()))
    });
    let rows: Vec<_> = rows.collect();
    (columns, rows)
}

/// A value for an option that wants one, so that its effect is seen.
fn value(option: &str) -> Option<&'static str> {
    match option {
        "--size" => Some("40"),
        "--season" => Some("winter"),
        "--tolerance" | "--weld" => Some("50"),
        "--lod" | "--billboard" => Some("2"),
        "--triangles" => Some("2000"),
        "--forest" => Some("10x10m"),
        "--textures" => Some("512"),
        "--compress" => Some("quantize"),
        _ => None,
    }
}

/// Grows an acer with `option` into `column`, and gives what was written or printed.
fn grow(dir: &Dir, option: &str, column: &str) -> (Run, Vec<u8>) {
    let mut args = vec!["grow", "acer"];
    args.extend(option.split_whitespace());
    args.extend(value(option));
    if column == "statistics" {
        args.extend(["--stats-only", "--json"]);
        let run = dir.run(args);
        let printed = run.stdout().into_bytes();
        return (run, printed);
    }
    // It is about levels, and files of one level are called after it.
    if option == "--lod-extension" && column == "glb" {
        args.extend(["--lod", "2"]);
    }
    let level = if option == "--lod-files" { "_LOD0" } else { "" };
    let name = format!("tree.{column}");
    let path = dir.path(&format!("tree{level}.{column}"));
    let _ = std::fs::remove_file(&path);
    args.extend(["-o", &name]);
    let run = dir.run(args);
    (run, std::fs::read(path).unwrap_or_default())
}

#[test]
fn every_cell_of_the_table_is_as_it_says() {
    let dir = Dir::new();
    let (columns, rows) = table(&dir);
    assert_eq!(
        columns,
        ["json", "png", "swc", "csv", "mtg", "glb", "obj", "ply", "stl", "usda", "statistics"]
    );
    assert!(rows.len() >= 15, "{rows:?}");
    for (i, column) in columns.iter().enumerate() {
        let (plain, without) = grow(&dir, "", column);
        assert_eq!(plain.code(), 0, "{plain}");
        for (option, takes) in &rows {
            if option == "--forest" && column == "statistics" {
                // Two ways of asking for the whole run, which the command line keeps apart.
                continue;
            }
            let (run, with) = grow(&dir, option, column);
            if !takes[i] {
                run.fails(1, &[option, "would do nothing", column]);
                assert!(with.is_empty(), "{option} {column}: nothing is written");
                continue;
            }
            assert_eq!(run.code(), 0, "{run}");
            // An OBJ file names its materials, which name the pictures.
            if option == "--textures" && column == "obj" {
                assert!(
                    std::fs::read_to_string(dir.path("tree.mtl")).unwrap().contains("map_Kd tree-bark.png")
                );
                continue;
            }
            // What is so by itself may be said.
            let usual = (matches!(&**option, "--leaves outline" | "--finest") && column != "glb")
                || (option == "--leaves instances" && column == "usda")
                || (option == "--lod-files" && matches!(&**column, "ply" | "stl"));
            assert_eq!(with == without, usual, "{option} {column}: does it do what it says?");
        }
    }
}

#[test]
fn what_would_do_nothing_is_refused_and_says_where_it_would() {
    let dir = Dir::new();
    dir.run(["grow", "acer", "-o", "x.obj", "--wind"]).fails(1, &["--wind", ".obj", ".glb, .ply"]);
    dir.run(["grow", "acer", "-o", "x.png", "--season", "autumn"]).fails(1, &["--season", ".png", ".glb"]);
    dir.run(["grow", "acer", "-o", "folder/", "--lod", "2"]).fails(1, &["--lod", ".json and .png", ".glb"]);
    dir.run(["grow", "acer", "--seeds", "0..3", "--size", "99"]).fails(1, &["--size", "statistics"]);
    dir.run(["grow", "acer", "--no-leaves", "--leaves", "cards", "-o", "x.glb"]).fails(2, &["--no-leaves"]);
    dir.run(["grow", "acer", "--weld", "20", "--tolerance", "1", "-o", "x.glb"]).fails(2, &["--tolerance"]);
    dir.run(["grow", "acer", "--forest", "9x9", "--seeds", "0..3", "-o", "x.glb"]).fails(2, &["--seeds"]);
    dir.run(["grow", "acer", "--forest", "9x9", "--json", "-o", "x.glb"]).fails(2, &["--json"]);
    dir.run(["grow", "acer", "-o", "x.png", "--format", "glb"]).fails(1, &["x.png", ".png", "glb"]);
    assert_eq!(std::fs::read_dir(dir.path("")).unwrap().count(), 0);
}

#[test]
fn a_format_names_what_a_suffix_does_not() {
    let dir = Dir::new();
    let _ = dir.run(["grow", "palm", "--format", "stl"]).ok();
    let _ = dir.run(["grow", "palm", "-o", "palm.stl"]).ok();
    let _ = dir.run(["grow", "palm", "-o", "palm.print", "--format", "stl"]).ok();
    let bytes = ["palm-1.stl", "palm.stl", "palm.print"].map(|name| std::fs::read(dir.path(name)).unwrap());
    assert!(bytes[0] == bytes[1] && bytes[1] == bytes[2]);
}

#[test]
fn statistics_are_of_the_tree_that_is_written() {
    let dir = Dir::new();
    let leaves = |args: &[&str]| {
        let stats = dir.run([&["grow"], args, &["--stats-only", "--json"]].concat()).json();
        (stats["leaves"].as_u64().unwrap(), stats["blossoms"].as_u64().unwrap())
    };
    assert!(leaves(&["acer"]).0 > 1000);
    for bare in [["--season", "winter"], ["--leaves", "none"]] {
        assert_eq!(leaves(&[&["acer"], &bare[..]].concat()), (0, 0), "{bare:?}");
    }
    assert!(leaves(&["small_pine", "--season", "winter"]).0 > 1000, "evergreen");
    let (spring, autumn) = (["hill_cherry", "--season", "spring"], ["hill_cherry", "--season", "autumn"]);
    assert!(leaves(&spring).1 > 0);
    assert_eq!(leaves(&autumn).1, 0);
    let many = dir.run(["grow", "acer", "--seeds", "0..3", "--season", "winter", "--json"]).ok();
    assert_eq!(many.matches("\"leaves\":0,").count(), 3, "{many}");
    let skeleton = dir.run(["grow", "acer", "--season", "winter", "-o", "-", "-q"]).json();
    assert_eq!(skeleton["leaves"]["list"].as_array().unwrap().len(), 0);
    let _ = dir.file("winter.toml", "[appearance]\nseason = \"winter\"\n");
    assert_eq!(leaves(&["winter.toml"]).0, 0, "the season of a species file counts as well");
}

#[test]
fn a_tree_without_leaves_has_no_leaf_area() {
    let dir = Dir::new();
    let _ = dir.file("bare.toml", "levels = 1\nbranches = [0, 0, 0, 0]\nleaf_blos_num = 0\n");
    let text = dir.run(["grow", "bare.toml", "--stats-only"]).ok();
    assert!(text.contains("0 leaves (0.00 m²)"), "{text}");
    let json = dir.run(["grow", "bare.toml", "--stats-only", "--json"]).ok();
    assert!(json.contains("\"leaf_area_m2\":0.0") && !json.contains("-0.0"), "{json}");
}

#[test]
fn shapes_have_the_names_of_species_files() {
    let dir = Dir::new();
    for shape in ["leaf_shape", "blossom_shape"] {
        let names = dir.run(["params", shape, "--json"]).json()["choices"].clone();
        for (number, name) in (1..).zip(names.as_array().unwrap()) {
            let file = format!("levels = 1\nbranches = [1, 0, 0, 0]\n{shape} = {number}\n");
            let _ = dir.file("one.toml", file);
            let skeleton = dir.run(["grow", "one.toml", "-o", "-", "-q"]).json();
            let key = if shape == "leaf_shape" { "leaves" } else { "blossoms" };
            assert_eq!(&skeleton[key]["shape"], name, "{shape} = {number}");
        }
    }
}
