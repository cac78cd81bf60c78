//! `pleach mask` and `pleach fit --mask auto`, as a user runs them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use image::{Rgb, RgbImage, Rgba};
use pleach_tests::Dir;

const SIDE: u32 = 160;

/// Writes photo.png, a shaded acer before a sky that pales downwards, and truth.png, its silhouette;
/// `lawn` rows of the picture's bottom are grass.
fn photograph(dir: &Dir, lawn: u32) {
    let size = SIDE.to_string();
    let render = ["render", "acer", "--seed", "2", "--size", &size, "--background", "transparent"];
    let _ = dir.run([&render[..], &["-o", "tree.png"]].concat()).ok();
    let tree = image::open(dir.path("tree.png")).unwrap().to_rgba8();
    let (width, height) = tree.dimensions();
    let photo = RgbImage::from_fn(width, height + lawn / 2, |x, y| {
        // Grass without order, a camera's noise.
        let rough = (x * 7919 + y * 104_729 + x * y * 31) % 23;
        let sky = [110 + y / 2, 150 + y / 3, 220 + y / 8].map(|v| (v + rough / 4).min(255) as f32);
        let grass = [100 + rough, 150 + rough, 60 + rough / 2].map(|v| v as f32);
        let behind = if y + lawn > height + lawn / 2 { grass } else { sky };
        let Rgba([r, g, b, a]) = if y < height { *tree.get_pixel(x, y) } else { Rgba([0; 4]) };
        let share = f32::from(a) / 255.0;
        let mix = |tree: u8, behind: f32| (share * f32::from(tree) + (1.0 - share) * behind) as u8;
        Rgb([mix(r, behind[0]), mix(g, behind[1]), mix(b, behind[2])])
    });
    photo.save(dir.path("photo.png")).unwrap();
    let truth = RgbImage::from_fn(width, height + lawn / 2, |x, y| {
        Rgb([if y < height && tree.get_pixel(x, y)[3] >= 128 { 0 } else { 255 }; 3])
    });
    truth.save(dir.path("truth.png")).unwrap();
}

/// IoU of two pictures of black ink.
fn iou(dir: &Dir, a: &str, b: &str) -> f64 {
    let [a, b] = [a, b].map(|name| image::open(dir.path(name)).unwrap().to_luma8());
    assert_eq!(a.dimensions(), b.dimensions());
    let ink = a.pixels().zip(b.pixels()).map(|(a, b)| (a[0] < 128, b[0] < 128));
    let count = |both: fn(bool, bool) -> bool| ink.clone().filter(|(a, b)| both(*a, *b)).count() as f64;
    count(|a, b| a && b) / count(|a, b| a || b)
}

#[test]
fn a_shaded_tree_comes_out_of_its_photograph() {
    for (lawn, says) in [(0, "one background"), (40, "ground below")] {
        let dir = Dir::new();
        photograph(&dir, lawn);
        let said = dir.run(["mask", "photo.png", "-o", "mask.png", "--overlay", "look.png"]);
        let text = said.ok();
        for words in [says, "% ink", "ground at row", "trunk at column", "the crown is all in the picture"] {
            assert!(text.contains(words), "`{words}` is not in {text}");
        }
        let found = iou(&dir, "mask.png", "truth.png");
        assert!(found >= 0.9, "lawn of {lawn} rows: {found:.3}");
        let look = image::open(dir.path("look.png")).unwrap();
        assert_eq!(
            (look.width(), look.height()),
            (SIDE, image::open(dir.path("photo.png")).unwrap().height())
        );
    }
}

#[test]
fn what_was_found_is_there_as_json() {
    let dir = Dir::new();
    photograph(&dir, 40);
    let found = dir.run(["mask", "photo.png", "-o", "mask.png", "--json"]).json();
    assert_eq!(found["by"], "colour");
    let horizon = found["horizon_rows"][0].as_f64().unwrap();
    assert!((horizon - f64::from(SIDE - 20)).abs() <= 2.0, "{found}");
    let axis = found["axis_column"].as_f64().unwrap();
    assert!((axis - f64::from(SIDE) / 2.0).abs() <= 3.0, "{found}");
    let ground = found["ground_row"].as_f64().unwrap();
    // A picture with alpha is its own mask, and that is said.
    let found = dir.run(["mask", "tree.png", "-o", "mask.png", "--json"]).json();
    assert_eq!((&found["by"], &found["threshold"]), (&"opacity".into(), &serde_json::Value::Null));
    assert!((ground - found["ground_row"].as_f64().unwrap()).abs() <= 4.0, "{ground}, {found}");
    assert!(dir.run(["mask", "tree.png", "-o", "mask.png"]).ok().contains("alpha channel"));
}

#[test]
fn what_is_no_photograph_of_a_tree_is_told() {
    let dir = Dir::new();
    photograph(&dir, 0);
    let sky = RgbImage::from_fn(SIDE, SIDE, |x, y| Rgb([100, 150, (180 + y / 4 + (x * y) % 3) as u8]));
    sky.save(dir.path("sky.png")).unwrap();
    let mask = |photo: &str, more: &[&str]| dir.run([&["mask", photo, "-o", "m.png"], more].concat());
    mask("sky.png", &[]).fails(1, &["sky.png", "no tree found", "--background"]);
    mask("photo.png", &["--seed-point", "500,3"]).fails(1, &["500,3", "outside", "160"]);
    mask("photo.png", &["--seed-point", "2,2"]).fails(1, &["2,2", "on the background"]);
    for wrong in ["2", "a,b", "-1,4", "1.5,2"] {
        mask("photo.png", &[&format!("--seed-point={wrong}")]).fails(2, &["expected X,Y"]);
    }
    mask("photo.png", &["--background", "sea"]).fails(2, &["auto", "sky", "plain"]);
    mask("missing.png", &[]).fails(1, &["missing.png"]);
    let _ = dir.file("text.jpg", "no picture");
    mask("text.jpg", &[]).fails(1, &["text.jpg", "no picture"]);
    mask("photo.png", &["--overlay", "m.png"]).fails(1, &["m.png", "both"]);
    dir.run(["mask", "photo.png", "-o", "photo.png"]).fails(1, &["photo.png", "photograph itself"]);
    dir.run(["mask", "photo.png", "-o", "m.jpg"]).fails(1, &["m.jpg", "no .png"]);
    assert!(!dir.path("m.png").exists());
}

#[test]
fn a_fit_makes_the_same_mask() {
    let dir = Dir::new();
    photograph(&dir, 0);
    let _ = dir.run(["mask", "photo.png", "-o", "photo-mask.png"]).ok();
    let fit = |goal: &str, out: &str, more: &[&str]| {
        let args = ["fit", goal, "--out", out, "--size", "64", "--from", "acer", "--free", "crown", "-v"];
        dir.run([&args[..], &["--evaluations", "20"], more].concat())
    };
    let auto = fit("photo.png", "auto", &["--mask", "auto"]);
    let _ = auto.ok();
    assert!(auto.stderr().contains("spreads away in colour"), "{}", auto.stderr());
    let _ = fit("photo-mask.png", "file", &[]).ok();
    let best = |out: &str| std::fs::read(dir.path(out).join("best.png")).unwrap();
    assert!(best("auto") == best("file"));
    // In a batch, a photograph without a tree fails alone.
    RgbImage::from_pixel(64, 64, Rgb([9, 99, 200])).save(dir.path("blank.png")).unwrap();
    let batch = fit("photo.png", "batch", &["blank.png", "--mask", "auto"]);
    batch.fails(1, &["blank.png: failed: ", "no tree found", "1 of 2 goals failed"]);
    assert!(dir.path("batch/photo/best.toml").exists());
}
