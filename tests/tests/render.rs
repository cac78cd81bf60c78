//! `pleach render`, as a user runs it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

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
fn what_cannot_be_drawn_says_what_can() {
    let dir = Dir::new();
    dir.run(["render", "acer", "-o", "a.jpg"]).fails(1, &["`.jpg`", ".png"]);
    dir.run(["render", "acer", "--background", "blue"]).fails(2, &["transparent", "#dde6ee"]);
    dir.run(["render", "acer", "--season", "sumer"]).fails(2, &["summer"]);
    dir.run(["render", "acer", "--turntable", "1"]).fails(2, &["2..=360"]);
    dir.run(["render", "acer", "--size", "1000000"]).fails(2, &["4096"]);
    dir.run(["render", "acorn"]).fails(1, &["acorn"]);
    dir.run(["render", "all", "-o", "one.png"]).fails(1, &["folder"]);
}
