//! `pleach mask` and `pleach fit --mask auto`, as a user runs them.

use image::{Rgb, RgbImage, Rgba};
use pleach_tests::Dir;

const SIDE: u32 = 160;

/// Writes photo.png, a shaded acer before a sky that pales downwards, and truth.png, its silhouette;
/// `lawn` rows of the picture's bottom are grass.
pub(crate) fn photograph(dir: &Dir, lawn: u32) {
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

/// `render` draws the tree's shadow on the floor.
#[test]
fn the_shadow_below_a_rendered_tree_is_not_tree() {
    let dir = Dir::new();
    for species in ["quaking_aspen", "black_tupelo"] {
        let render = ["render", species, "--size", "320", "--quiet"];
        let _ = dir.run([&render[..], &["-o", "photo.png"]].concat()).ok();
        let alone = ["--background", "transparent", "--ground", "none", "-o", "tree.png"];
        let _ = dir.run([&render[..], &alone].concat()).ok();
        let tree = image::open(dir.path("tree.png")).unwrap().to_rgba8();
        let ink = |x, y| Rgb([if tree.get_pixel(x, y)[3] >= 128 { 0 } else { 255 }; 3]);
        RgbImage::from_fn(320, 320, ink).save(dir.path("truth.png")).unwrap();
        let inked = |at: &(u32, u32)| tree.get_pixel(at.0, at.1)[3] >= 128;
        let all: Vec<(u32, u32)> =
            (0..320).flat_map(|y| (0..320).map(move |x| (x, y))).filter(inked).collect();
        let range = |values: Vec<u32>| (*values.iter().min().unwrap(), *values.iter().max().unwrap());
        let (left, right) = range(all.iter().map(|at| at.0).collect());
        let (top, bottom) = range(all.iter().map(|at| at.1).collect());
        let tight = format!("{left},{top},{},{}", right + 1 - left, bottom + 1 - top);
        for way in [["--background", "auto"], ["--box", &tight]] {
            let _ = dir.run([&["mask", "photo.png", "-o", "mask.png"][..], &way[..]].concat()).ok();
            let found = iou(&dir, "mask.png", "truth.png");
            assert!(found >= 0.88, "{species}, {way:?}: {found:.3}");
        }
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
    mask("text.jpg", &[]).fails(1, &["text.jpg", "not a picture"]);
    mask("photo.png", &["--overlay", "m.png"]).fails(1, &["m.png", "both"]);
    dir.run(["mask", "photo.png", "-o", "photo.png"]).fails(1, &["photo.png", "photograph itself"]);
    dir.run(["mask", "photo.png", "-o", "m.jpg"]).fails(1, &["m.jpg", "not a .png file"]);
    assert!(!dir.path("m.png").exists());
}

#[test]
fn a_fit_makes_the_same_mask() {
    let dir = Dir::new();
    photograph(&dir, 0);
    let _ = dir.run(["mask", "photo.png", "-o", "photo-mask.png"]).ok();
    let fit = |goal: &str, out: &str, more: &[&str]| {
        let args = ["fit", goal, "--out", out, "--size", "140", "--from", "acer", "--free", "crown", "-v"];
        dir.run([&args[..], &["--evaluations", "20", "--individual", "off"], more].concat())
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

#[test]
fn many_photographs_become_a_folder_and_a_table() {
    let dir = Dir::new();
    photograph(&dir, 0);
    std::fs::create_dir(dir.path("photos")).unwrap();
    std::fs::rename(dir.path("photo.png"), dir.path("photos/one.png")).unwrap();
    photograph(&dir, 40);
    std::fs::rename(dir.path("photo.png"), dir.path("photos/two.png")).unwrap();
    let blank = RgbImage::from_pixel(64, 64, Rgb([9, 99, 200]));
    blank.save(dir.path("photos/blank.png")).unwrap();
    let photos = ["photos/one.png", "photos/blank.png", "photos/two.png"];
    let run = dir.run([&["mask"], &photos[..], &["-o", "masks/", "--overlay", "looks/"]].concat());
    run.fails(1, &["[2/3] photos/blank.png: failed: ", "no tree found", "1 of 3 photographs have no mask"]);
    assert_eq!(run.stdout().trim(), "masks  masks/masks.csv");
    // The same bits as one by one.
    for name in ["one", "two"] {
        let _ = dir.run(["mask", &format!("photos/{name}.png"), "-o", "single.png"]).ok();
        let same = std::fs::read(dir.path("single.png")).unwrap();
        assert!(same == std::fs::read(dir.path(&format!("masks/{name}.png"))).unwrap(), "{name}");
        assert!(dir.path(&format!("looks/{name}.png")).exists());
    }
    assert!(!dir.path("masks/blank.png").exists());
    let table = std::fs::read_to_string(dir.path("masks/masks.csv")).unwrap();
    let lines: Vec<&str> = table.lines().collect();
    let head = "file,mask,confidence,ink,ground_row,trunk_column,top_row,touches,warnings,error";
    assert_eq!((lines.len(), lines[0]), (4, head));
    // What failed stands first, and then the least confident.
    assert!(
        lines[1].starts_with("photos/blank.png,,,,,,,,,") && lines[1].contains("no tree found"),
        "{table}"
    );
    let confidence = |line: &str| line.split(',').nth(2).unwrap().parse::<f64>().unwrap();
    assert!(confidence(lines[2]) <= confidence(lines[3]), "{table}");
    assert!(table.contains("\nphotos/one.png,masks/one.png,0."), "{table}");
    // The same as JSON, a line each.
    let json = dir.run(["mask", photos[0], photos[2], "-o", "masks", "--json"]).ok();
    let found: Vec<serde_json::Value> = json.lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    assert_eq!((&found[0]["file"], &found[1]["mask"]), (&photos[0].into(), &"masks/two.png".into()));
    assert!(found[0]["confidence"].as_f64().unwrap() > 0.5, "{json}");
    assert_eq!(found[0]["warnings"], serde_json::json!([]));
}

#[test]
fn many_photographs_are_refused_where_masks_would_be_lost() {
    let dir = Dir::new();
    photograph(&dir, 0);
    std::fs::create_dir(dir.path("other")).unwrap();
    std::fs::copy(dir.path("photo.png"), dir.path("other/photo.png")).unwrap();
    std::fs::copy(dir.path("photo.png"), dir.path("other/second.png")).unwrap();
    let mask = |args: &[&str]| dir.run([&["mask"], args].concat());
    mask(&["photo.png", "other/photo.png", "-o", "m/"])
        .fails(1, &["photo.png", "would both become m/photo.png"]);
    mask(&["photo.png", "other/second.png", "-o", "m.png"]).fails(1, &["m.png", "need a folder"]);
    mask(&["photo.png", "other/second.png", "-o", "-"]).fails(1, &["need a folder"]);
    mask(&["photo.png", "-o", "."]).fails(1, &["photo.png", "choose another folder"]);
    mask(&["photo.png", "other/second.png", "-o", "m/", "--overlay", "m/"]).fails(1, &["the same files"]);
    mask(&["photo.png", "other/second.png", "-o", "m/", "--seed-point", "4,4"]).fails(1, &["--seed-point"]);
    assert!(!dir.path("m").exists() && !dir.path("m.png").exists());
}

#[test]
fn masks_go_through_pipes() {
    let dir = Dir::new();
    photograph(&dir, 0);
    let _ = dir.run(["mask", "photo.png", "-o", "mask.png"]).ok();
    let photo = || std::process::Stdio::from(std::fs::File::open(dir.path("photo.png")).unwrap());
    let output = dir.command(["mask", "-", "-o", "-"]).stdin(photo()).output().unwrap();
    assert!(output.status.success());
    assert!(output.stdout == std::fs::read(dir.path("mask.png")).unwrap());
    assert!(String::from_utf8_lossy(&output.stderr).contains("the crown is all in the picture"));
    let output = dir.command(["mask", "-", "-o", "masks/"]).stdin(photo()).output().unwrap();
    assert!(output.status.success());
    assert!(output.stdout.starts_with(b"masks  masks/masks.csv") && dir.path("masks/stdin.png").exists());
    dir.run(["mask", "photo.png", "-o", "-", "--json"]).fails(1, &["--json", "standard output"]);
}

/// A tree that the frame cuts through: what the mask says, the fit says as well.
#[test]
fn a_fit_tells_what_its_mask_tells() {
    let dir = Dir::new();
    photograph(&dir, 0);
    let photo = image::open(dir.path("photo.png")).unwrap();
    photo.crop_imm(70, 0, SIDE - 70, photo.height()).save(dir.path("cut.png")).unwrap();
    let mask = dir.run(["mask", "cut.png", "-o", "m.png", "--background", "plain"]);
    let _ = mask.ok();
    assert!(mask.stderr().contains("warning: the crown touches the frame: left"), "{mask}");
    let args = ["fit", "cut.png", "--mask", "auto", "--size", "140", "--from", "acer", "--evaluations", "9"];
    let fit = dir.run(args);
    let _ = fit.ok();
    assert!(fit.stderr().contains("warning: cut.png: the crown touches the frame: left"), "{fit}");
}

/// Transparent corners, a frame and near values: told, and no longer taken for tree.
#[test]
fn what_is_not_of_the_picture_is_left_out() {
    let dir = Dir::new();
    photograph(&dir, 0);
    let photo = image::open(dir.path("photo.png")).unwrap().to_rgba8();
    let (width, height) = photo.dimensions();
    let corners = image::RgbaImage::from_fn(width, height, |x, y| {
        let Rgba([r, g, b, _]) = *photo.get_pixel(x, y);
        let corner = x.min(width - 1 - x) + y.min(height - 1 - y) < 9;
        Rgba([r, g, b, if corner { 0 } else { 255 }])
    });
    corners.save(dir.path("corners.png")).unwrap();
    let framed = image::RgbaImage::from_fn(width, height, |x, y| {
        let edge = x.min(y).min(width - 1 - x).min(height - 1 - y) < 3;
        if edge { Rgba([0, 0, 0, 255]) } else { *photo.get_pixel(x, y) }
    });
    framed.save(dir.path("framed.png")).unwrap();
    for (name, kind) in [("corners", "alpha-ignored"), ("framed", "frame")] {
        let found = dir.run(["mask", &format!("{name}.png"), "-o", "m.png", "--json"]).json();
        let kinds: Vec<_> = found["warnings"].as_array().unwrap().iter().map(|w| w["kind"].clone()).collect();
        assert!(kinds.contains(&kind.into()), "{found}");
        assert!(found["confidence"].as_f64().unwrap() < 1.0, "{found}");
        assert!(iou(&dir, "m.png", "truth.png") > 0.9, "{name}");
    }
    // An alpha channel that is a mask is one no more if it is to be ignored.
    let ignored = dir.run(["mask", "tree.png", "-o", "m.png", "--alpha", "ignore", "--json"]);
    assert!(!ignored.stdout().contains("\"by\":\"opacity\""), "{ignored}");
    dir.run(["mask", "tree.png", "-o", "m.png", "--alpha", "none"]).fails(2, &["auto", "ignore"]);
    let truth = image::open(dir.path("truth.png")).unwrap().to_luma8();
    let labels = image::GrayImage::from_fn(width, height, |x, y| {
        image::Luma([u8::from(truth.get_pixel(x, y)[0] == 0)])
    });
    labels.save(dir.path("labels.png")).unwrap();
    assert!(dir.run(["mask", "labels.png", "-o", "m.png"]).ok().contains("two tones"));
    assert!(iou(&dir, "m.png", "truth.png") > 0.999);
}

/// What the picture warns of, `mask` has an option for, or names the command that has one.
#[test]
fn warnings_of_masks_advise_nothing_that_mask_has_not() {
    let dir = Dir::new();
    let disc = image::RgbaImage::from_fn(100, 100, |x, y| {
        let inside = x.abs_diff(50).pow(2) + y.abs_diff(50).pow(2) < 900;
        Rgba([40, 90, 30, if inside { 255 } else { 0 }])
    });
    disc.save(dir.path("disc.png")).unwrap();
    let mask = dir.run(["mask", "disc.png", "-o", "m.png"]);
    let _ = mask.ok();
    assert!(mask.stderr().contains("`pleach fit` has --tree dark"), "{mask}");
}

/// Another program makes the mask, and says why it cannot.
#[test]
#[cfg(unix)]
fn another_programs_segmenter_is_run_and_its_mistakes_are_told() {
    let dir = Dir::new();
    photograph(&dir, 0);
    // A cut-out, and the same as white on black: truth.png is black on white.
    let white = image::open(dir.path("truth.png")).unwrap().to_luma8();
    image::GrayImage::from_fn(white.width(), white.height(), |x, y| {
        image::Luma([255 - white.get_pixel(x, y)[0]])
    })
    .save(dir.path("white.png"))
    .unwrap();
    let mask = |command: &str| dir.run(["mask", "photo.png", "-o", "m.png", "--mask-command", command]);
    for answer in ["tree.png", "white.png"] {
        let command = format!("sh -c 'test -s \"$1\" && cp {answer} \"$2\"' - {{in}} {{out}}");
        let _ = mask(&command).ok();
        assert!(iou(&dir, "m.png", "truth.png") > 0.99, "{answer}");
    }
    std::fs::remove_file(dir.path("m.png")).unwrap();
    for (script, words) in [
        ("echo no weights >&2; exit 3", &["exit status: 3", "no weights"][..]),
        ("exit 0", &["wrote no file"]),
        ("echo rubbish > \"$2\"", &["mask.png", "not a"]),
        ("cp photo.png \"$2\"", &["in colours", "cut-out"]),
    ] {
        mask(&format!("sh -c '{script}' - {{in}} {{out}}")).fails(1, words);
        assert!(!dir.path("m.png").exists(), "{script}");
    }
    mask("no-such-segmenter {in} {out}").fails(1, &["no-such-segmenter", "cannot be started"]);
    mask("rembg i {in}").fails(2, &["{out}", "rembg i {in} {out}"]);

    // A fit keeps the mask, and knows its command again.
    let fit = |command: &str, more: &[&str]| {
        let args =
            ["fit", "photo.png", "--out", "run", "--size", "140", "--from", "acer", "--evaluations", "5"];
        dir.run([&args[..], &["--individual", "off", "--mask-command", command], more].concat())
    };
    let command = "sh -c 'cp tree.png \"$2\"' - {in} {out}";
    let _ = fit(command, &[]).ok();
    assert!(iou(&dir, "run/mask.png", "truth.png") > 0.99);
    assert!(fit(command, &["--resume"]).stderr().contains("finished"));
    fit("sh -c 'cp white.png \"$2\"' - {in} {out}", &["--resume"]).fails(1, &["--mask-command was"]);
}
