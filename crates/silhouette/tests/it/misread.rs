//! Pictures that are easily misread: masks of near values, frames, transparency that cuts nothing out, uneven
//! paper, outlines. What is tree is found all the same, or it is told that something is odd.

use image::{DynamicImage, GrayAlphaImage, GrayImage, ImageFormat, Luma, LumaA, Rgba, RgbaImage};
use pleach_silhouette::goal::{Goal, GoalError, GoalOptions, GoalWarning};
use pleach_silhouette::mask::{Mask, MaskOptions, Photo};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;
use std::io::Cursor;

const SIDE: u32 = 256;

/// A species with a margin of a tenth of the picture around it.
fn drawn(species: &str) -> Bitmap {
    let tree = pleach_generators::species(species).unwrap().grow(1).unwrap();
    let upright = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIDE, SIDE);
    let frame = Frame {
        meters_per_pixel: upright.meters_per_pixel / 0.75,
        ground_row: 0.88 * f64::from(SIDE),
        ..upright
    };
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut bitmap);
    bitmap
}

fn gray(at: impl Fn(u32, u32) -> u8) -> DynamicImage {
    GrayImage::from_fn(SIDE, SIDE, |x, y| Luma([at(x, y)])).into()
}

fn encoded(picture: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn try_read(picture: &DynamicImage) -> Result<Goal, GoalError> {
    Goal::from_bytes("goal", encoded(picture, ImageFormat::Png), &GoalOptions::default())
}

fn read(picture: &DynamicImage) -> Goal {
    try_read(picture).unwrap()
}

fn masked(picture: &DynamicImage) -> Mask {
    let photo = Photo::from_bytes("photo", encoded(picture, ImageFormat::Png)).unwrap();
    Mask::from_photo(&photo, &MaskOptions::default()).unwrap()
}

fn kinds(warnings: &[GoalWarning]) -> Vec<&'static str> {
    warnings.iter().map(GoalWarning::kind).collect()
}

fn iou(a: &Bitmap, b: &Bitmap) -> f64 {
    let both = a.intersection(b);
    both as f64 / (a.ink() + b.ink() - both) as f64
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
fn two_values_are_split_however_near_they_are() {
    let tree = drawn("quaking_aspen");
    let dir = tempfile::tempdir().unwrap();
    for (on, off) in [(1, 0), (0, 1), (254, 255), (128, 127), (7, 16)] {
        let picture = gray(|x, y| if tree.get(x, y) { on } else { off });
        let goal = read(&picture);
        assert_eq!((&goal.bitmap, &goal.warnings[..]), (&tree, &[][..]), "{on} on {off}");
        let mask = masked(&picture);
        assert_eq!((&mask.bitmap, &mask.warnings[..]), (&tree, &[][..]), "{on} on {off}");
        assert_eq!(mask.confidence, 1.0);
        // As a mask of a picture.
        picture.save(dir.path().join("mask.png")).unwrap();
        let options = GoalOptions { mask: Some(dir.path().join("mask.png")), ..GoalOptions::default() };
        let photo = gray(|x, y| (255.0 * chance(x, y)) as u8);
        let goal = Goal::from_bytes("photo", encoded(&photo, ImageFormat::Png), &options).unwrap();
        assert_eq!((goal.bitmap, goal.warnings), (tree.clone(), vec![]), "{on} on {off}");
    }
}

#[test]
fn too_little_contrast_is_told_in_numbers() {
    let tree = drawn("quaking_aspen");
    let faint = gray(|x, y| if tree.get(x, y) { 100 } else { 105 + (x % 3) as u8 });
    let error = try_read(&faint).unwrap_err();
    assert!(error.to_string().contains("values go from 100 to 107 of 255"), "{error}");
}

/// Frames of some widths on some sides, before and after JPEG.
#[test]
fn a_frame_around_the_paper_is_left_out() {
    let tree = drawn("quaking_aspen");
    for wide in [1, 2, 5, 20] {
        for sides in
            [[true; 4], [true, false, false, false], [false, true, false, true], [false, true, true, false]]
        {
            let is_frame = |x: u32, y: u32| {
                let from = [x, y, SIDE - 1 - x, SIDE - 1 - y];
                from.iter().zip(sides).any(|(at, side)| side && *at < wide)
            };
            let picture = gray(|x, y| match (is_frame(x, y), tree.get(x, y)) {
                (true, _) => 25,
                (_, true) => 10,
                _ => 245,
            });
            let expected = Bitmap::from_fn(SIDE, SIDE, |x, y| tree.get(x, y) && !is_frame(x, y));
            let goal = read(&picture);
            let about = format!("{wide} on {sides:?}: {:?}", goal.warnings);
            assert_eq!(kinds(&goal.warnings), ["frame"], "{about}");
            assert!(goal.warnings[0].to_string().contains(&wide.to_string()), "{about}");
            assert_eq!(goal.bitmap, expected, "{about}");
            let mask = masked(&picture);
            assert!(kinds(&mask.warnings).contains(&"frame"), "{about}");
            assert!(iou(&mask.bitmap, &expected) > 0.9, "{about}");
            let jpeg = encoded(&picture, ImageFormat::Jpeg);
            let goal = Goal::from_bytes("goal", jpeg, &GoalOptions::default()).unwrap();
            assert!(kinds(&goal.warnings).contains(&"frame"), "{about}");
            assert!(iou(&goal.bitmap, &expected) > 0.97, "{about}");
        }
    }
    // A rectangle that is drawn in the margin.
    let inset = gray(|x, y| {
        let edge = x.min(y).min(SIDE - 1 - x).min(SIDE - 1 - y);
        if tree.get(x, y) || (6..8).contains(&edge) { 0 } else { 255 }
    });
    let goal = read(&inset);
    assert_eq!((goal.bitmap, kinds(&goal.warnings)), (tree, vec!["frame"]));
}

#[test]
fn a_tree_that_a_frame_cuts_off_is_told() {
    let tree = drawn("black_oak");
    let (left, _, right, _) = tree.ink_box().unwrap();
    let end = (left + 2 * right) / 3;
    let shown = |x: u32, y: u32| (x + end + 3).checked_sub(SIDE).is_some_and(|x| tree.get(x, y));
    let picture = gray(|x, y| if x >= SIDE - 3 || shown(x, y) { 0 } else { 255 });
    let goal = read(&picture);
    assert_eq!(kinds(&goal.warnings), ["frame", "touches-frame"]);
    assert!(goal.warnings[1].to_string().contains("right;"), "{}", goal.warnings[1]);
}

/// A border that is too wide for a frame, so that the paper is taken for the tree.
#[test]
fn paper_that_counts_as_tree_is_told() {
    let tree = drawn("quaking_aspen");
    let picture = gray(|x, y| {
        let is_paper = (60..SIDE - 60).contains(&x) && (60..SIDE - 60).contains(&y);
        if is_paper && !tree.get(x, y) { 255 } else { 0 }
    });
    assert!(kinds(&read(&picture).warnings).contains(&"mostly-ink"));
    let forced = GoalOptions { polarity: pleach_silhouette::Polarity::LightTree, ..GoalOptions::default() };
    let picture = gray(|x, y| if tree.get(x, y) { 0 } else { 255 });
    let goal = Goal::from_bytes("goal", encoded(&picture, ImageFormat::Png), &forced).unwrap();
    assert!(kinds(&goal.warnings).contains(&"mostly-ink"), "{:?}", goal.warnings);
}

/// The tree before a sky, turned, with nothing in its corners.
fn turned(degrees: f64) -> (DynamicImage, Bitmap) {
    let tree = drawn("quaking_aspen");
    let (sin, cos) = degrees.to_radians().sin_cos();
    let side = (f64::from(SIDE) * (sin + cos)).ceil() as u32;
    let from = |x: u32, y: u32| {
        let (x, y) = (f64::from(x) + 0.5 - f64::from(side) / 2.0, f64::from(y) + 0.5 - f64::from(side) / 2.0);
        let (a, b) = (cos * x + sin * y + f64::from(SIDE) / 2.0, cos * y - sin * x + f64::from(SIDE) / 2.0);
        let within = |v: f64| (0.0..f64::from(SIDE)).contains(&v);
        (within(a) && within(b)).then_some((a as u32, b as u32))
    };
    let picture = RgbaImage::from_fn(side, side, |x, y| match from(x, y) {
        None => Rgba([0; 4]),
        Some((a, b)) if tree.get(a, b) => Rgba([40 + (30.0 * chance(a, b)) as u8, 70, 30, 255]),
        Some((a, b)) => Rgba([150 + (b / 8) as u8, 190, 230 + (9.0 * chance(a, b)) as u8, 255]),
    });
    let truth = Bitmap::from_fn(side, side, |x, y| from(x, y).is_some_and(|(a, b)| tree.get(a, b)));
    (picture.into(), truth)
}

#[test]
fn corners_that_are_transparent_say_nothing() {
    for degrees in [1.0, 2.0, 8.0] {
        let (picture, truth) = turned(degrees);
        let goal = read(&picture);
        assert!(kinds(&goal.warnings).contains(&"alpha-ignored"), "{degrees}: {:?}", goal.warnings);
        assert!(iou(&goal.bitmap, &truth) > 0.95, "{degrees}: {}", iou(&goal.bitmap, &truth));
        let mask = masked(&picture);
        assert!(kinds(&mask.warnings).contains(&"alpha-ignored"), "{degrees}: {:?}", mask.warnings);
        assert!(iou(&mask.bitmap, &truth) > 0.9, "{degrees}: {}", iou(&mask.bitmap, &truth));
        assert!(mask.confidence > 0.45, "{degrees}: {}", mask.confidence);
    }
    let tree = drawn("acer");
    let rounded = RgbaImage::from_fn(SIDE, SIDE, |x, y| {
        let away = |at: u32| (24.0 - f64::from(at.min(SIDE - 1 - at))).max(0.0);
        let tone = if tree.get(x, y) { 30 } else { 220 };
        Rgba([tone, tone, tone, if away(x).hypot(away(y)) < 24.0 { 255 } else { 0 }])
    });
    let goal = read(&rounded.into());
    assert_eq!((goal.bitmap, kinds(&goal.warnings)), (tree, vec!["alpha-ignored"]));
}

#[test]
fn a_hole_in_the_form_of_a_tree_is_the_tree() {
    let tree = drawn("acer");
    for textured in [false, true] {
        let stencil = GrayAlphaImage::from_fn(SIDE, SIDE, |x, y| {
            let tone = if textured { (255.0 * chance(x, y)) as u8 } else { 255 };
            LumaA([tone, if tree.get(x, y) { 0 } else { 255 }])
        });
        let goal = read(&stencil.clone().into());
        assert_eq!((&goal.bitmap, kinds(&goal.warnings)), (&tree, vec!["transparent-tree"]));
        let mask = masked(&stencil.into());
        assert_eq!((&mask.bitmap, kinds(&mask.warnings)), (&tree, vec!["transparent-tree"]));
    }
}

#[test]
fn confidence_of_a_cut_out_follows_how_sharply_it_was_cut() {
    let tree = drawn("quaking_aspen");
    let cut = |soft: bool| {
        let picture = RgbaImage::from_fn(SIDE, SIDE, |x, y| {
            let noise = if soft { (150.0 * chance(x, y)) as u8 } else { 0 };
            Rgba([60, 90, 40, if tree.get(x, y) { 255 - noise } else { noise }])
        });
        masked(&picture.into()).confidence
    };
    let (sharp, soft) = (cut(false), cut(true));
    assert!(sharp == 1.0 && soft < 0.5, "{sharp} {soft}");
}

/// A pencil drawing whose paper darkens towards the corners.
#[test]
fn uneven_paper_is_read_by_what_differs_from_it() {
    let tree = drawn("black_oak");
    let picture = gray(|x, y| {
        let part = |v: u32| f64::from(v) / f64::from(SIDE) - 0.5;
        let paper = 250.0 - 230.0 * (part(x).powi(2) + part(y).powi(2));
        (if tree.get(x, y) { paper - 45.0 } else { paper } + 3.0 * chance(x, y)) as u8
    });
    let goal = read(&picture);
    let found = iou(&goal.bitmap, &tree);
    assert!(found > 0.9 && kinds(&goal.warnings) == ["by-color"], "{found} {:?}", goal.warnings);
}

#[test]
fn outline_drawings_are_told() {
    for species in ["quaking_aspen", "black_oak", "lombardy_poplar"] {
        let tree = drawn(species);
        // The rim of the tree without its gaps, and with a few of the line's pixels missing.
        let near = |x: u32, y: u32, reach: i32| {
            let at = |v: u32, by: i32| v.checked_add_signed(by);
            (-reach..=reach).any(|dx| {
                (-reach..=reach).any(|dy| match (at(x, dx), at(y, dy)) {
                    (Some(x), Some(y)) => tree.get(x, y),
                    _ => false,
                })
            })
        };
        let shape = Bitmap::from_fn(SIDE, SIDE, |x, y| near(x, y, 9));
        let outline = Bitmap::from_fn(SIDE, SIDE, |x, y| {
            let is = |dx: u32, dy: u32| match ((x + dx).checked_sub(2), (y + dy).checked_sub(2)) {
                (Some(x), Some(y)) => x < SIDE && y < SIDE && shape.get(x, y),
                _ => false,
            };
            let inner = (0..5).all(|dx| (0..5).all(|dy| is(dx, dy)));
            shape.get(x, y) && !inner && chance(x, y) > 0.03
        });
        let warnings = Goal::from_bitmap(outline).unwrap().warnings;
        assert!(kinds(&warnings).contains(&"outline"), "{species}: {warnings:?}");
        let told = warnings.iter().map(ToString::to_string).collect::<String>();
        assert!(told.contains("fill the outline"), "{told}");
    }
}

#[test]
fn a_mask_of_another_size_is_fitted_to_its_picture() {
    let tree = drawn("black_oak");
    let dir = tempfile::tempdir().unwrap();
    let photo = gray(|x, y| (255.0 * chance(x, y)) as u8);
    for side in [128, 512, 200] {
        let at = |v: u32| (f64::from(v) + 0.5) * f64::from(SIDE) / f64::from(side);
        let mask = GrayImage::from_fn(side, side, |x, y| {
            Luma([if tree.get(at(x) as u32, at(y) as u32) { 255 } else { 0 }])
        });
        mask.save(dir.path().join("mask.png")).unwrap();
        let options = GoalOptions { mask: Some(dir.path().join("mask.png")), ..GoalOptions::default() };
        let goal = Goal::from_bytes("photo", encoded(&photo, ImageFormat::Png), &options).unwrap();
        assert_eq!((goal.bitmap.width(), goal.bitmap.height()), (SIDE, SIDE));
        assert!(iou(&goal.bitmap, &tree) > 0.85, "{side}: {}", iou(&goal.bitmap, &tree));
    }
    GrayImage::new(128, 140).save(dir.path().join("mask.png")).unwrap();
    let options = GoalOptions { mask: Some(dir.path().join("mask.png")), ..GoalOptions::default() };
    let error = Goal::from_bytes("photo", encoded(&photo, ImageFormat::Png), &options).unwrap_err();
    assert!(error.to_string().contains("must have the same shape"), "{error}");
}

#[test]
fn formats_that_are_not_read_name_what_converts_them() {
    for (head, words) in [
        (&b"\0\0\0\x18ftypheic\0\0\0\0mif1heic"[..], ["HEIC", "heif-convert"]),
        (b"\0\0\0\x20ftypavif\0\0\0\0avifmif1", ["AVIF", "avifdec"]),
        // With the feature `pictures` they are read, and these break off.
        (
            b"GIF89a\x01\0\x01\0\0\0\0\0\0\0\0\0",
            if cfg!(feature = "pictures") { ["damaged"; 2] } else { ["GIF", "magick"] },
        ),
        (
            b"BM\x36\x01\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0",
            if cfg!(feature = "pictures") { ["damaged"; 2] } else { ["BMP", "magick"] },
        ),
        (
            b"<svg xmlns='http://www.w3.org/2000/svg'>",
            if cfg!(feature = "pictures") { ["drawing", "as PNG"] } else { ["SVG", "rsvg-convert"] },
        ),
    ] {
        let whole = Goal::from_bytes("picture", head.to_vec(), &GoalOptions::default()).unwrap_err();
        let piped = Goal::from_reader("picture", head, &GoalOptions::default()).unwrap_err();
        for error in [whole, piped] {
            let said = error.to_string();
            assert!(words.iter().all(|word| said.contains(word)), "{said}");
        }
    }
}
