//! What is said about goals that are not as a fit expects, and that nothing is said about those that are.

use image::{DynamicImage, GrayImage, ImageFormat, Luma, Rgb, RgbImage};
use pleach_silhouette::goal::{Goal, GoalOptions, GoalWarning};
use pleach_silhouette::mask::Touches;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;
use std::io::Cursor;
use std::path::PathBuf;

const SIDE: u32 = 256;

/// An aspen with a margin, as most goals are.
fn tree() -> Bitmap {
    drawn("quaking_aspen", 0.8)
}

/// A species that fills `share` of the picture's height, with a margin below.
fn drawn(species: &str, share: f64) -> Bitmap {
    let tree = pleach_generators::species(species).unwrap().grow(1).unwrap();
    let upright = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIDE, SIDE);
    let frame = Frame {
        meters_per_pixel: upright.meters_per_pixel / share,
        ground_row: 0.95 * f64::from(SIDE),
        ..upright
    };
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut bitmap);
    bitmap
}

fn kinds(warnings: &[GoalWarning]) -> Vec<&'static str> {
    warnings.iter().map(GoalWarning::kind).collect()
}

fn said(ink: Bitmap) -> Vec<&'static str> {
    kinds(&Goal::from_bitmap(ink).unwrap().warnings)
}

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn read(picture: &DynamicImage, format: ImageFormat) -> Goal {
    Goal::from_bytes("goal", encoded(picture, format), &GoalOptions::default()).unwrap()
}

/// A number from 0 to 1 for a place, without order.
fn chance(x: u32, y: u32) -> f64 {
    let mut h = u64::from(x) << 32 | u64::from(y);
    for _ in 0..3 {
        h = (h ^ h >> 31).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
    (h >> 40) as f64 / f64::from(1 << 24)
}

#[test]
fn nothing_is_said_about_good_goals() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut seen = 0;
    for folder in ["targets", "tests/data/silhouettes"] {
        for entry in root.join(folder).read_dir().unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|e| e != "png") {
                continue;
            }
            seen += 1;
            let goal = Goal::load(&path, &GoalOptions::default()).unwrap();
            assert_eq!(goal.warnings, [], "{}", path.display());
            // Nor about a tight crop, a picture of half the size, or a JPEG of it.
            let (left, top, right, bottom) = goal.bitmap.ink_box().unwrap();
            let crop = Bitmap::from_fn(right - left + 1, bottom - top + 1, |x, y| {
                goal.bitmap.get(left + x, top + y)
            });
            assert_eq!(said(crop), [""; 0], "{} cropped", path.display());
            assert_eq!(said(goal.bitmap.downscaled(0.5)), [""; 0], "{} at half the size", path.display());
            let picture = image::open(&path).unwrap().to_luma8().into();
            let jpeg = read(&picture, ImageFormat::Jpeg);
            assert_eq!(jpeg.warnings, [], "{} as JPEG", path.display());
        }
    }
    assert_eq!(seen, 55);
}

#[test]
fn noise_is_heard_in_every_goal() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    for folder in ["targets", "tests/data/silhouettes"] {
        for entry in root.join(folder).read_dir().unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_none_or(|e| e != "png") {
                continue;
            }
            let clean = Goal::load(&path, &GoalOptions::default()).unwrap().bitmap;
            for part in [0.02, 0.01] {
                let spoilt = Bitmap::from_fn(clean.width(), clean.height(), |x, y| {
                    clean.get(x, y) != (chance(x, y) < part)
                });
                assert!(said(spoilt).contains(&"noise"), "{}: {part} of all pixels", path.display());
            }
        }
    }
}

#[test]
fn a_crown_that_is_cut_off_names_the_sides() {
    let whole = drawn("black_oak", 0.9);
    let (left, top, right, _) = whole.ink_box().unwrap();
    let (tall, wide) = (SIDE, (right - left) * 2 / 3);
    let cut = Bitmap::from_fn(wide, tall, |x, y| whole.get(left + x, y));
    let warnings = Goal::from_bitmap(cut).unwrap().warnings;
    let touches = Touches { right: true, ..Touches::default() };
    assert_eq!(warnings, [GoalWarning::TouchesFrame(touches)]);
    assert!(warnings[0].to_string().contains("the crown touches the frame: right;"), "{}", warnings[0]);
    let cut = Bitmap::from_fn(SIDE, SIDE - top - 40, |x, y| whole.get(x, y + top + 40));
    let touches = Touches { top: true, ..Touches::default() };
    assert_eq!(Goal::from_bitmap(cut).unwrap().warnings, [GoalWarning::TouchesFrame(touches)]);
}

#[test]
fn two_trees_are_two_pieces() {
    let one = tree();
    let two = Bitmap::from_fn(2 * SIDE, SIDE, |x, y| one.get(x % SIDE, y));
    assert_eq!(Goal::from_bitmap(two).unwrap().warnings, [GoalWarning::SeveralPieces { pieces: 2 }]);
    // A bush beside the tree is a smaller one.
    let bush = |x: u32, y: u32| (f64::from(x) - 30.0).hypot(f64::from(y) - 230.0) < 12.0;
    assert_eq!(said(Bitmap::from_fn(SIDE, SIDE, |x, y| one.get(x, y) || bush(x, y))), [""; 0]);
}

#[test]
fn ground_is_seen_from_side_to_side_and_as_an_island() {
    let one = tree();
    let (_, _, _, bottom) = one.ink_box().unwrap();
    for island in [0, 30] {
        let strip = |x, y| y + 2 >= bottom && (island..SIDE - island).contains(&x);
        let ink = Bitmap::from_fn(SIDE, SIDE, |x, y| one.get(x, y) || strip(x, y));
        let warnings = Goal::from_bitmap(ink).unwrap().warnings;
        assert_eq!(warnings, [GoalWarning::Ground { row: bottom - 2 }], "{island}");
    }
    // A fir whose lowest branches sweep the ground is none.
    let fir = Bitmap::from_fn(SIDE, SIDE, |x, y| {
        f64::from(x.abs_diff(128)) < 0.45 * f64::from(y) && chance(x, y) < 0.9
    });
    assert!(!said(fir).contains(&"ground"));
}

#[test]
fn noise_is_heard_from_a_few_specks_on() {
    let one = tree();
    for share in [0.002, 0.02, 0.1, 0.5] {
        let ink = Bitmap::from_fn(SIDE, SIDE, |x, y| one.get(x, y) != (chance(x, y) < share));
        assert!(said(ink).contains(&"noise"), "{share}");
    }
    let all = Bitmap::from_fn(SIDE, SIDE, |x, y| chance(x, y) < 0.5);
    assert!(said(all).contains(&"noise"));
}

#[test]
fn a_square_a_disc_and_a_bar_are_solid() {
    let square = Bitmap::from_fn(SIDE, SIDE, |x, y| (60..200).contains(&x) && (60..200).contains(&y));
    let disc =
        Bitmap::from_fn(SIDE, SIDE, |x, y| (f64::from(x) - 128.0).hypot((f64::from(y) - 128.0) / 1.4) < 70.0);
    let tilted = Bitmap::from_fn(SIDE, SIDE, |x, y| {
        let (a, b) = (f64::from(x) + f64::from(y) - 256.0, f64::from(x) - f64::from(y));
        a.abs() < 120.0 && b.abs() < 60.0
    });
    for shape in [square, disc, tilted] {
        let warnings = Goal::from_bitmap(shape).unwrap().warnings;
        let [GoalWarning::Solid { solidity }] = warnings[..] else { panic!("{warnings:?}") };
        assert!(solidity > 0.96 && solidity <= 1.0, "{solidity}");
    }
}

#[test]
fn a_trunk_that_points_up_is_told() {
    for species in ["quaking_aspen", "acer", "palm"] {
        let upright = drawn(species, 0.8);
        let flipped = Bitmap::from_fn(SIDE, SIDE, |x, y| upright.get(x, SIDE - 1 - y));
        assert_eq!(said(upright), [""; 0], "{species}");
        assert_eq!(said(flipped), ["upside-down"], "{species}");
    }
}

/// A tree in two greens before a sky that pales downwards.
fn photograph() -> RgbImage {
    let ink = tree();
    RgbImage::from_fn(SIDE, SIDE, |x, y| {
        let pale = (y / 3) as u8;
        let light = (60.0 * chance(x, y)) as u8;
        if ink.get(x, y) { Rgb([30 + light, 60 + light, 20]) } else { Rgb([90 + pale, 140 + pale, 230]) }
    })
}

#[test]
fn a_photograph_is_told_from_a_silhouette_in_colours() {
    let color: DynamicImage = photograph().into();
    for (picture, format) in [
        (color.clone(), ImageFormat::Png),
        (color.clone(), ImageFormat::Jpeg),
        (color.to_luma8().into(), ImageFormat::Png),
    ] {
        assert!(kinds(&read(&picture, format).warnings).contains(&"photograph"), "{format:?}");
    }
    // Dark green on cream, with soft rims, is a silhouette.
    let ink = tree();
    let soft = RgbImage::from_fn(SIDE, SIDE, |x, y| {
        let near = (0..9).filter(|i| ink.get((x + i % 3).saturating_sub(1), (y + i / 3).saturating_sub(1)));
        let share = near.count() as f64 / 9.0;
        let mix = |on: f64, off: f64| (off + share * (on - off)) as u8;
        Rgb([mix(10.0, 250.0), mix(60.0, 245.0), mix(20.0, 220.0)])
    });
    assert_eq!(read(&soft.into(), ImageFormat::Png).warnings, []);
    // With a mask, the picture's colours do not matter.
    let dir = tempfile::tempdir().unwrap();
    let mask = GrayImage::from_fn(SIDE, SIDE, |x, y| Luma([if ink.get(x, y) { 255 } else { 0 }]));
    mask.save(dir.path().join("mask.png")).unwrap();
    let options = GoalOptions { mask: Some(dir.path().join("mask.png")), ..GoalOptions::default() };
    let goal = Goal::from_bytes("photo", encoded(&color, ImageFormat::Png), &options).unwrap();
    assert_eq!((goal.bitmap, goal.warnings), (ink, vec![]));
}

#[test]
fn warnings_are_data_for_scripts() {
    let json = serde_json::to_value(GoalWarning::SeveralPieces { pieces: 3 }).unwrap();
    assert_eq!(json["kind"], "several-pieces");
    assert!(json["message"].as_str().unwrap().starts_with("there are 3 pieces"), "{json}");
    assert_eq!(json.as_object().unwrap().len(), 2);
}
