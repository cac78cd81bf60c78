//! `pleach render`, as a user runs it.

use pleach_tests::Dir;

fn open(path: &std::path::Path) -> image::DynamicImage {
    image::open(path).unwrap()
}

#[test]
fn a_picture_of_a_tree() {
    let dir = Dir::new();
    let _ = dir.run(["render", "acer", "--seed", "2", "--size", "96"]).ok();
    let picture = open(&dir.path("acer-2.png"));
    assert_eq!((picture.width(), picture.height()), (96, 96));
    let _ = dir.run(["render", "acer", "--size", "96", "--background", "transparent", "-o", "t.png"]).ok();
    let picture = open(&dir.path("t.png")).into_rgba8();
    assert_eq!(picture.get_pixel(0, 0)[3], 0);
    assert!(picture.pixels().any(|p| p[3] == 255));
}

#[test]
fn the_same_command_draws_the_same_picture() {
    let dir = Dir::new();
    let [one, two] = ["1", "2"].map(|threads| {
        let name = format!("{threads}.png");
        let _ = dir.run(["--threads", threads, "render", "palm", "--size", "64", "-o", &name]).ok();
        std::fs::read(dir.path(&name)).unwrap()
    });
    assert!(one == two);
}

#[test]
fn a_turntable_is_an_animation_or_a_folder_of_frames() {
    let dir = Dir::new();
    let _ = dir.run(["render", "palm", "--size", "48", "--turntable", "4", "-o", "turn.png"]).ok();
    let bytes = std::fs::read(dir.path("turn.png")).unwrap();
    assert!(bytes.windows(4).any(|w| w == b"acTL"), "an animated PNG");
    let _ = dir.run(["render", "palm", "--size", "48", "--turntable", "4", "-o", "frames/"]).ok();
    assert_eq!(std::fs::read_dir(dir.path("frames")).unwrap().count(), 4);
    assert!(dir.path("frames/palm-1-003.png").exists());
}

#[test]
fn seasons_change_the_picture() {
    let dir = Dir::new();
    let picture = |season: &str| {
        let name = format!("{season}.png");
        let _ = dir.run(["render", "acer", "--size", "64", "--season", season, "-o", &name]).ok();
        std::fs::read(dir.path(&name)).unwrap()
    };
    let all = ["spring", "summer", "autumn", "winter"].map(picture);
    for (i, one) in all.iter().enumerate() {
        assert!(all[..i].iter().all(|other| other != one));
    }
}

#[test]
fn looks_belong_to_the_file_and_not_to_its_name() {
    let dir = Dir::new();
    let birch = dir.run(["species", "silver_birch"]).ok();
    assert!(birch.contains("[appearance]\nbark = \"#d9d6cc\"\nbark_pattern = \"banded\""), "{birch}");
    let picture = |name: &str, text: String| {
        let _ = dir.file(&format!("{name}.toml"), text);
        let out = format!("{name}.png");
        let _ = dir.run(["render", &format!("{name}.toml"), "--size", "64", "-o", &out]).ok();
        std::fs::read(dir.path(&out)).unwrap()
    };
    let renamed =
        |text: &str, name: &str| text.replace("name = \"silver_birch\"", &format!("name = \"{name}\""));
    let silent = birch.split("\n[appearance]").next().unwrap();
    let itself = picture("itself", birch.clone());
    assert!(itself == picture("renamed", renamed(&birch, "mybirch")), "the name changes nothing");
    let plain = picture("plain", renamed(silent, "mybirch"));
    assert!(itself != plain, "the table does");
    assert!(plain == picture("plain_palm", renamed(silent, "palm")), "no name has colours");
    let bad = birch.replace("banded", "bandd") + "evergreen = 1\n";
    let _ = dir.file("bad.toml", bad);
    dir.run(["render", "bad.toml"])
        .fails(1, &["did you mean `banded`?", "`appearance.evergreen` is a number, expected true or false"]);
    let _ = dir.file("top.toml", format!("season = \"autumn\"\n{silent}"));
    dir.run(["render", "top.toml"]).fails(1, &["top.toml:1:1", "did you mean `appearance.season`?"]);
}

#[test]
fn the_gallery_is_one_sheet_of_fifteen_species_twice() {
    let dir = Dir::new();
    let _ = dir.run(["render", "--gallery", "--size", "24", "-o", "sheet.png"]).ok();
    let sheet = open(&dir.path("sheet.png")).into_rgb8();
    // Three species a row, two pictures each, a sixth of a picture around them.
    assert_eq!(sheet.width(), 3 * (2 * 24 + 4) + 4);
    for (row, column) in (0..5).flat_map(|r| (0..6).map(move |c| (r, c))) {
        let (x, y) = (4 + column / 2 * 52 + column % 2 * 24, 2 + row * 30);
        let ink = (0..24 * 24).filter(|i| sheet.get_pixel(x + i % 24, y + i / 24)[1] < 230).count();
        assert!(ink > 12, "picture {column} of row {row}: {ink} dark pixels");
    }
}

#[test]
fn the_gallery_may_be_of_another_generator() {
    let dir = Dir::new();
    let args = ["render", "--gallery", "--generator", "fractal", "--size", "24", "-o", "sheet.png"];
    let _ = dir.run(args).ok();
    let sheet = open(&dir.path("sheet.png"));
    // Ten species, three in a row.
    assert_eq!((sheet.width(), sheet.height()), (3 * (2 * 24 + 4) + 4, 4 * 30 + 4));
    dir.run(["render", "--gallery", "--generator", "oaks"])
        .fails(2, &["unknown generator `oaks`", "fractal"]);
    dir.run(["render", "acer", "--generator", "fractal"]).fails(2, &["--generator", "SPECIES"]);
    dir.run(["render", "--generator", "fractal"]).fails(2, &["--gallery"]);
}

#[test]
fn the_gallery_may_be_of_species_that_are_named() {
    let dir = Dir::new();
    let species = dir.run(["species", "palm"]).ok();
    let _ = dir.file("mine.toml", species);
    let sheet = |only: &str, file: &str| {
        dir.run(["render", "--gallery", "--only", only, "--columns", "2", "--size", "24", "-o", file])
    };
    let _ = sheet("acer,mine.toml", "one.png").ok();
    let _ = sheet("mine.toml,acer", "other.png").ok();
    let [one, other] = ["one.png", "other.png"].map(|file| open(&dir.path(file)).into_rgb8());
    // Two in a row, in the order of the names.
    assert_eq!(one.dimensions(), (2 * (2 * 24 + 4) + 4, 30 + 4));
    assert!(one.dimensions() == other.dimensions() && one != other);
    sheet("acer,acorn", "x.png").fails(1, &["acorn"]);
    dir.run(["render", "--gallery", "--size", "4096"]).fails(1, &["too large", "--size"]);
    dir.run(["render", "--gallery", "--columns", "0"]).fails(2, &["1..=100"]);
    dir.run(["render", "--gallery", "--only", "acer", "--generator", "all"]).fails(2, &["--generator"]);
    dir.run(["render", "--only", "acer"]).fails(2, &["--gallery"]);
}

#[test]
fn what_cannot_be_drawn_says_what_can() {
    let dir = Dir::new();
    dir.run(["render", "acer", "-o", "a.jpg"]).fails(1, &["`.jpg`", ".png"]);
    dir.run(["render", "acer", "--background", "blue"]).fails(2, &["transparent", "#dde6ee"]);
    dir.run(["render", "acer", "--season", "sumer"]).fails(2, &["summer"]);
    dir.run(["render", "acer", "--turntable", "1"]).fails(2, &["2..=360"]);
    dir.run(["render", "acer", "--size", "1000000"]).fails(2, &["4096"]);
    dir.run(["render", "acorn"]).fails(1, &["acorn"]);
    dir.run(["render", "all", "-o", "one.png"]).fails(1, &["folder"]);
    dir.run(["render"]).fails(2, &["SPECIES"]);
    dir.run(["render", "acer", "--gallery"]).fails(2, &["--gallery"]);
    dir.run(["render", "--gallery", "-o", "sheet.jpg"]).fails(1, &["`.jpg`", ".png"]);
}
