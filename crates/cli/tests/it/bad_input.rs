//! Whatever a user may throw at the program ends in a clear message and exit code 1 or 2: no panic,
//! no hang, no memory eaten.

use pleach_tests::{Dir, png_chunk};

/// A grey PNG of one value.
fn plain(dir: &Dir, name: &str, side: u32, value: u8) -> String {
    let path = dir.path(name);
    image::GrayImage::from_pixel(side, side, image::Luma([value])).save(&path).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The head of a PNG of 20,000 × 20,000 pixels and next to no data: what a decoder sees first.
fn huge(dir: &Dir) -> String {
    let side = 20_000_u32.to_be_bytes();
    let head = [side.as_slice(), &side, &[8, 6, 0, 0, 0]].concat();
    // A deflate stream that promises more than it holds.
    let body = [0x78, 0x9c, 0x63, 0x00, 0x00];
    let png = [
        b"\x89PNG\r\n\x1a\n".to_vec(),
        png_chunk(b"IHDR", &head),
        png_chunk(b"IDAT", &body),
        png_chunk(b"IEND", &[]),
    ]
    .concat();
    dir.file("huge.png", png).to_str().unwrap().to_owned()
}

#[test]
fn goals_that_are_no_goals() {
    let dir = Dir::new();
    let text = dir.file("text.png", "this is no picture").to_str().unwrap().to_owned();
    let nothing = dir.file("nothing.png", "").to_str().unwrap().to_owned();
    let good = std::fs::read(pleach_tests::root().join("targets/acer.png")).unwrap();
    let cut = dir.file("cut.png", &good[..good.len() / 2]).to_str().unwrap().to_owned();
    let cases: [(&str, &[&str]); 8] = [
        ("missing.png", &["missing.png"]),
        (&text, &["text.png"]),
        (&nothing, &["nothing.png"]),
        (&cut, &["cut.png"]),
        (&plain(&dir, "white.png", 64, 255), &["white.png"]),
        (&plain(&dir, "black.png", 64, 0), &["black.png"]),
        (&plain(&dir, "dot.png", 1, 0), &["dot.png", "1"]),
        (&huge(&dir), &["huge.png", "20000"]),
    ];
    for (goal, words) in cases {
        let run = dir.run(["fit", goal, "--out", "run", "--evaluations", "10"]);
        run.fails(1, words);
        assert!(!dir.path("run").exists(), "a goal that is none leaves no folder\n{run}");
        dir.run(["score", goal, goal]).fails(1, words);
    }
}

#[test]
fn species_files_with_mistakes() {
    let dir = Dir::new();
    let cases: [(&str, &[&str]); 8] = [
        ("colour = 3", &["bad.toml:1:1", "`colour`", "is not a known name"]),
        ("g_scale = 10\nratio = nan", &["bad.toml:2:9", "`ratio`", "not a finite number"]),
        ("branches = [1, 5, 5, -20000]", &["`branches[3]`", "-20000", "-10000 to 10000"]),
        ("leaf_scale = -0.2", &["`leaf_scale`", "0 to 100"]),
        ("levels = 9", &["`levels` is 9", "1 to 4"]),
        ("branches = 1e9", &["`branches`", "1 value", "expected 4"]),
        ("generator = \"oak-o-matic\"", &["`oak-o-matic`", "weber-penn"]),
        ("levels = = 3", &["bad.toml:1:"]),
    ];
    for (text, words) in cases {
        let file = dir.file("bad.toml", text);
        dir.run(["grow", file.to_str().unwrap(), "--stats-only"]).fails(1, words);
    }
    dir.run(["grow", "no_such_file.toml"]).fails(1, &["no_such_file.toml"]);
    dir.run(["grow", "quaking_aspn"]).fails(1, &["did you mean `quaking_aspen`?"]);
    let big = dir.file("big.toml", vec![b'#'; 5 << 20]);
    dir.run(["grow", big.to_str().unwrap()]).fails(1, &["big.toml", "bytes"]);
    dir.run(["grow", "oak"]).fails(1, &["`oak` may be black_oak or cambridge_oak"]);
    let _ = dir.file("mine.toml", "levels = 2");
    dir.run(["grow", "mine"]).fails(1, &["did you mean `mine.toml`?"]);
    let latin = dir.file("latin.toml", b"levels = 2\nname = \"B\xe4umchen\"");
    dir.run(["grow", latin.to_str().unwrap()]).fails(1, &["latin.toml:2:10", "0xe4", "UTF-8"]);
    let picture = pleach_tests::root().join("targets/acer.png");
    dir.run(["grow", picture.to_str().unwrap()]).fails(1, &["acer.png", "PNG picture", "pleach fit"]);
    let long =
        dir.file("long.toml", format!("{} = 3\nshape = \"{}\"", "k".repeat(10_000), "v".repeat(10_000)));
    let run = dir.run(["grow", long.to_str().unwrap()]);
    run.fails(1, &["long.toml:1:1", "kkk…", "vvv…"]);
    assert!(run.stderr().len() < 1500, "{run}");
}

/// A name is part of file names: nothing is written but where it was asked for.
#[test]
fn names_that_are_paths() {
    let dir = Dir::new();
    std::fs::create_dir_all(dir.path("a/b")).unwrap();
    let elsewhere = dir.path("elsewhere").display().to_string();
    let names =
        ["../../escaped", elsewhere.as_str(), "a/b", "..", "", "a\\\\b", "a\\nb", "\\u001b[2J", "a\\u202eb"];
    for name in names {
        let text = format!("generator = \"weber-penn\"\nlevels = 1\nname = \"{name}\"");
        let file = dir.file("a/b/evil.toml", text);
        let run = dir.run(["grow", file.to_str().unwrap(), "-o", "a/b/"]);
        run.fails(1, &["evil.toml:3:8: `name` "]);
        assert!(!run.stderr().chars().any(|c| c.is_control() && c != '\n'), "{run}");
    }
    let files: Vec<_> =
        std::fs::read_dir(dir.path("")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(files, ["a"], "nothing was written");
}

#[test]
fn no_leaves_have_no_area() {
    let dir = Dir::new();
    let bare = dir.file("bare.toml", "levels = 1\nbranches = [0, 0, 0, 0]\nleaf_blos_num = 0");
    let said = dir.run(["grow", bare.to_str().unwrap(), "--stats-only"]).ok();
    assert!(said.contains("0.00 m²") && !said.contains("-0.00"), "{said}");
}

#[test]
fn monsters_end_at_the_limit() {
    let dir = Dir::new();
    let monster = dir.file(
        "monster.toml",
        "levels = 4\nbranches = [1, 10000, 10000, 10000]\ncurve_res = [200, 200, 200, 200]",
    );
    let monster = monster.to_str().unwrap();
    dir.run(["grow", monster, "--stats-only"]).fails(1, &["more than", "does not grow"]);
    dir.run(["grow", "quaking_aspen", "--stats-only", "--max-stems", "100"])
        .fails(1, &["more than 100 stems"]);
    dir.run(["grow", "quaking_aspen", "--stats-only", "--max-leaves", "9"]).fails(1, &["more than 9 leaves"]);
    dir.run(["silhouette", monster]).fails(1, &["does not grow"]);
}

#[test]
fn places_that_cannot_be_written() {
    let dir = Dir::new();
    let goal = pleach_tests::root().join("targets/acer.png");
    let goal = goal.to_str().unwrap();
    // A file where a folder should be: works for root as well, whom no permission stops.
    let file = dir.file("file", "");
    let inside = file.join("run");
    dir.run(["fit", goal, "--out", inside.to_str().unwrap(), "--evaluations", "10"])
        .fails(1, &["cannot make the folder"]);
    dir.run(["grow", "palm", "-o", file.join("x.json").to_str().unwrap()]).fails(1, &["cannot write"]);
    dir.run(["silhouette", "palm", "-o", file.join("x.png").to_str().unwrap()]).fails(1, &["cannot write"]);
    dir.run(["grow", "palm", "--seeds", "0..2", "-o", "palms.json"]).fails(1, &["need a folder"]);
}

#[test]
fn wrong_usage_is_two() {
    let dir = Dir::new();
    dir.run(["grow"]).fails(2, &["SPECIES"]);
    dir.run(["grow", "acer", "--seeds", "9..3"]).fails(2, &["A..B"]);
    dir.run(["grow", "acer", "--seed", "-1"]).fails(2, &["-1"]);
    dir.run(["grow", "acer", "--seed", "1.5"]).fails(2, &["whole number"]);
    dir.run(["grwo"]).fails(2, &["grow"]);
    dir.run(["fit", "x.png", "--timeout", "soon"]).fails(2, &["90s, 10m or 2h"]);
    dir.run(["fit", "x.png", "--target-iou", "2"]).fails(2, &["from 0 to 1"]);
    dir.run(["fit", "x.png", "--height=-3"]).fails(2, &["metres"]);
    dir.run(["fit", "x.png", "--generator", "arbaro"])
        .fails(2, &["unknown generator `arbaro`, known are weber-penn, lsystem, fractal", "auto for all"]);
}

#[test]
fn experiments_that_are_none() {
    let dir = Dir::new();
    dir.run(["experiment", "run", "nowhere"]).fails(1, &["experiment.toml"]);
    let _ = dir.file("experiment.toml", "kind = \"magic\"");
    dir.run(["experiment", "run", "."]).fails(1, &["experiment.toml", "magic"]);
}
