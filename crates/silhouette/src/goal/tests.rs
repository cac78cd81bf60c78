//! Goals from files.

use super::*;
use image::{DynamicImage, GrayImage, ImageFormat, Luma, Rgba, RgbaImage};
use std::fs;

/// A lollipop of a tree: crown, trunk, standing on row 90 of 100.
fn tree(x: u32, y: u32) -> bool {
    let crown = (f64::from(x) - 60.0).hypot(f64::from(y) - 40.0) < 25.0;
    crown || ((57..63).contains(&x) && (40..90).contains(&y))
}

fn expected() -> Bitmap {
    Bitmap::from_fn(120, 100, tree)
}

fn gray(on: u8, off: u8) -> DynamicImage {
    GrayImage::from_fn(120, 100, |x, y| Luma([if tree(x, y) { on } else { off }])).into()
}

struct Room(tempfile::TempDir);

impl Room {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn bytes(&self, name: &str, bytes: &[u8]) -> PathBuf {
        fs::write(self.path(name), bytes).unwrap();
        self.path(name)
    }

    fn picture(&self, name: &str, picture: &DynamicImage, format: ImageFormat) -> PathBuf {
        picture.save_with_format(self.path(name), format).unwrap();
        self.path(name)
    }
}

fn load(path: &Path) -> Result<Goal, GoalError> {
    Goal::load(path, &GoalOptions::default())
}

#[test]
fn every_format_and_polarity_shows_the_same_tree() {
    let room = Room::new();
    let alpha: DynamicImage =
        RgbaImage::from_fn(120, 100, |x, y| Rgba([9, 200, 9, if tree(x, y) { 255 } else { 0 }])).into();
    for (name, picture, format) in [
        ("a.png", gray(0, 255), ImageFormat::Png),
        ("b.png", gray(255, 0), ImageFormat::Png),
        ("c.webp", gray(20, 230), ImageFormat::WebP),
        ("d.png", alpha.clone(), ImageFormat::Png),
        ("e.webp", alpha, ImageFormat::WebP),
        ("misnamed.txt", gray(0, 255), ImageFormat::Png),
    ] {
        let goal = load(&room.picture(name, &picture, format)).unwrap();
        assert_eq!(goal.bitmap, expected(), "{name}");
        assert_eq!((goal.ground_row, goal.axis_column, goal.top_row), (90.0, 60.0, 16.0), "{name}");
    }
    let jpeg = load(&room.picture("f.jpg", &gray(0, 255), ImageFormat::Jpeg)).unwrap();
    assert!(jpeg.bitmap.differing(&expected()) < 20, "JPEG: {:?}", jpeg.bitmap);
}

#[test]
fn our_own_pictures_come_back() {
    let room = Room::new();
    let path = room.bytes("own.png", &expected().to_png());
    let goal = load(&path).unwrap();
    assert_eq!(goal.bitmap, expected());
    assert_eq!(Goal { detection: goal.detection, ..Goal::from_bitmap(expected()).unwrap() }, goal);
}

#[test]
fn the_frame_puts_the_top_at_the_height_asked_for() {
    let frame = Goal::from_bitmap(expected()).unwrap().frame(7.4);
    assert_eq!((frame.width, frame.height), (120, 100));
    assert!((frame.meters_per_pixel - 0.1).abs() < 1e-12);
    assert_eq!((frame.axis_column, frame.ground_row), (60.0, 90.0));
}

#[test]
fn places_set_by_hand_stand_and_scale() {
    let room = Room::new();
    let path = room.picture("a.png", &gray(0, 255), ImageFormat::Png);
    let options = GoalOptions {
        ground_row: Some(80.0),
        axis_column: Some(30.0),
        max_side: Some(60),
        ..GoalOptions::default()
    };
    let goal = Goal::load(&path, &options).unwrap();
    assert_eq!((goal.bitmap.width(), goal.bitmap.height()), (60, 50));
    assert_eq!((goal.ground_row, goal.axis_column, goal.top_row), (40.0, 15.0, 8.0));
    assert_eq!(goal.detection.ground, Origin::Given);
    for (ground_row, axis_column) in [(Some(101.0), None), (None, Some(-1.0)), (Some(f64::NAN), None)] {
        let options = GoalOptions { ground_row, axis_column, ..GoalOptions::default() };
        assert!(matches!(Goal::load(&path, &options), Err(GoalError::OutsidePicture { .. })));
    }
    let options = GoalOptions { ground_row: Some(10.0), ..GoalOptions::default() };
    assert!(matches!(Goal::load(&path, &options), Err(GoalError::GroundAboveTree { .. })));
    // The frame of a picture that was shrunk by no whole factor may end within its next pixel.
    let options = GoalOptions { ground_row: Some(100.6), ..GoalOptions::default() };
    assert_eq!(Goal::load(&path, &options).unwrap().ground_row, 100.6);
}

#[test]
fn a_mask_says_what_is_tree() {
    let room = Room::new();
    let noise = GrayImage::from_fn(120, 100, |x, y| Luma([(x * 37 + y * 91) as u8]));
    let photo = room.picture("photo.jpg", &noise.into(), ImageFormat::Jpeg);
    let mask = room.picture("mask.png", &gray(255, 0), ImageFormat::Png);
    let options = GoalOptions { mask: Some(mask.clone()), ..GoalOptions::default() };
    let goal = Goal::load(&photo, &options).unwrap();
    assert_eq!(goal.bitmap, expected());
    assert!(goal.detection.masked);
    let small = room.picture("small.png", &GrayImage::new(50, 50).into(), ImageFormat::Png);
    let error = Goal::load(&small, &options).unwrap_err();
    assert!(matches!(error, GoalError::MaskSize { .. }), "{error}");
}

#[test]
fn bad_files_are_errors_with_their_names() {
    let room = Room::new();
    let whole = fs::read(room.picture("whole.png", &gray(0, 255), ImageFormat::Png)).unwrap();
    let jpeg = fs::read(room.picture("whole.jpg", &gray(0, 255), ImageFormat::Jpeg)).unwrap();
    let even = |w, h, v| DynamicImage::from(GrayImage::from_pixel(w, h, Luma([v])));
    type Check = fn(&GoalError) -> bool;
    let cases: [(PathBuf, Check); 10] = [
        (room.path("missing.png"), |e| matches!(e, GoalError::Unreadable { .. })),
        (room.0.path().to_owned(), |e| matches!(e, GoalError::Unreadable { .. })),
        (room.bytes("text.png", b"not a picture at all"), |e| matches!(e, GoalError::NotAnImage { .. })),
        (room.bytes("nothing.png", b""), |e| matches!(e, GoalError::NotAnImage { .. })),
        (room.bytes("cut.png", &whole[..whole.len() / 2]), |e| matches!(e, GoalError::Damaged { .. })),
        (room.bytes("head.png", &whole[..20]), |e| matches!(e, GoalError::Damaged { .. })),
        (room.bytes("cut.jpg", &jpeg[..60]), |e| matches!(e, GoalError::Damaged { .. })),
        (room.picture("one.png", &even(1, 1, 0), ImageFormat::Png), |e| {
            matches!(e, GoalError::TooSmall { width: 1, height: 1, .. })
        }),
        (room.picture("white.png", &even(64, 64, 255), ImageFormat::Png), |e| {
            matches!(e, GoalError::NoInk { .. })
        }),
        (room.picture("black.png", &even(64, 64, 0), ImageFormat::Png), |e| {
            matches!(e, GoalError::AllInk { .. })
        }),
    ];
    for (path, check) in &cases {
        let error = load(path).expect_err(&path.display().to_string());
        assert!(check(&error), "{}: {error:?}", path.display());
        assert!(error.to_string().contains(&path.display().to_string()), "{error}");
    }
}

#[test]
fn a_header_that_claims_too_much_is_refused_before_decoding() {
    // 20,000 × 20,000 grey pixels in a file that holds none of them.
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 20_000, 20_000);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().unwrap();
    writer.write_chunk(png::chunk::IDAT, &[0x78, 0x9c, 0, 0]).unwrap();
    drop(writer);
    let room = Room::new();
    let error = load(&room.bytes("huge.png", &bytes)).unwrap_err();
    assert!(matches!(error, GoalError::TooLarge { width: 20_000, height: 20_000, .. }), "{error}");
    // Allowed sides, but sixteen bits of four channels.
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 8192, 8192);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Sixteen);
    let mut writer = encoder.write_header().unwrap();
    writer.write_chunk(png::chunk::IDAT, &[0x78, 0x9c, 0, 0]).unwrap();
    drop(writer);
    let error = load(&room.bytes("deep.png", &bytes)).unwrap_err();
    assert!(matches!(error, GoalError::TooManyBytes { bytes: 536_870_912, .. }), "{error}");
}

#[test]
fn a_goal_is_reduced_as_if_it_had_been_read_so() {
    let ink = Bitmap::from_fn(300, 200, |x, y| tree(x / 2, y / 2));
    for crop in [Crop::Keep, Crop::ToTree] {
        let options = GoalOptions { crop, ground_row: Some(181.5), ..GoalOptions::default() };
        let full = Goal::from_ink(ink.clone(), &options).unwrap();
        for side in [500, 100, 33] {
            let read = Goal::from_ink(ink.clone(), &GoalOptions { max_side: Some(side), ..options.clone() })
                .unwrap();
            assert_eq!(full.reduced(side).unwrap(), read, "{crop:?} {side}");
        }
    }
}
