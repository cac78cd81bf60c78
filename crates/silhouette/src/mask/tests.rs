use super::*;
use crate::raster::Rasterizer;
use crate::view::{Frame, View};
use pleach_plant::Parts;

/// A number from 0 to 1 for a place, without order: what noise looks like.
pub(super) fn chance(x: u32, y: u32, salt: u32) -> f64 {
    let mut h = u64::from(x) << 40 ^ u64::from(y) << 20 ^ u64::from(salt);
    for _ in 0..3 {
        h = (h ^ h >> 31).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
    (h >> 40) as f64 / f64::from(1 << 24)
}

/// About normal, of standard deviation 1.
pub(super) fn noise(x: u32, y: u32, salt: u32) -> f64 {
    (0..3).map(|i| 2.0 * chance(x, y, salt * 8 + i) - 1.0).sum()
}

/// Smooth changes from −1 to 1 over some `size` pixels.
pub(super) fn waves(x: u32, y: u32, size: f64) -> f64 {
    let (x, y) = (f64::from(x) / size, f64::from(y) / size);
    ((x + 0.7 * y).sin() + (1.3 * x - y).sin() + (0.3 * x + 1.7 * y + 1.0).sin()) / 3.0
}

pub(super) fn mix(a: [f64; 3], b: [f64; 3], share: f64) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + share * (b[i] - a[i]))
}

/// A tree in front of something, and where it really is.
pub(super) struct Scene {
    pub(super) photo: Photo,
    pub(super) truth: Bitmap,
}

pub(super) const SIDE: u32 = 256;

/// Part of the picture's height at which the ground begins.
pub(super) const GROUND: f64 = 0.85;

/// Draws a species with its greens and browns, shaded at random, before `background(x, y)`, with
/// camera noise of `grain` (of 255) over all. The trunk's foot is at 92 % of the height.
pub(super) fn scene(species: &str, grain: f64, background: impl Fn(u32, u32) -> [f64; 3]) -> Scene {
    let tree = pleach_generators::species(species).unwrap().grow(3).unwrap();
    let upright = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIDE, SIDE);
    let frame = Frame {
        meters_per_pixel: upright.meters_per_pixel / 0.88,
        ground_row: 0.92 * f64::from(SIDE),
        ..upright
    };
    let mut raster = Rasterizer::new();
    let (mut truth, mut stems, mut all) = (Bitmap::default(), Vec::new(), Vec::new());
    let mut coverage = |parts: Parts, out: &mut Vec<u8>| {
        let mut bitmap = Bitmap::default();
        raster.draw(&tree, &View::FRONT, &frame, parts, &mut bitmap);
        raster.coverage(out);
        truth = bitmap;
        f64::from(raster.samples())
    };
    let whole_stems = coverage(Parts::STEMS, &mut stems);
    let whole = coverage(Parts::STEMS | Parts::LEAVES, &mut all);
    let photo = Photo::from_fn(SIDE, SIDE, |x, y| {
        let i = (y * SIDE + x) as usize;
        let (wood, cover) = (f64::from(stems[i]) / whole_stems, f64::from(all[i]) / whole);
        // Leaves in sun and shade, of greens from yellowish to bluish; bark that is lit from the left.
        let light = 0.75 + 0.25 * waves(x, y, 12.0) + 0.2 * (chance(x, y, 1) - 0.5);
        let green = mix([70.0, 120.0, 40.0], [120.0, 150.0, 50.0], chance(x, y, 2)).map(|v| v * light);
        let brown = mix([70.0, 50.0, 35.0], [120.0, 95.0, 70.0], chance(x, y, 3));
        let tree = mix(green, brown, if cover > 0.0 { wood / cover } else { 0.0 }.min(1.0));
        let seen = mix(background(x, y), tree, cover);
        let [r, g, b] =
            [0, 1, 2].map(|c| (seen[c] + grain * noise(x, y, 10 + c as u32)).clamp(0.0, 255.0) as u8);
        [r, g, b, 255]
    });
    Scene { photo, truth }
}

pub(super) fn sky(_: u32, y: u32) -> [f64; 3] {
    mix([90.0, 140.0, 215.0], [205.0, 222.0, 238.0], f64::from(y) / f64::from(SIDE))
}

pub(super) fn cloudy(x: u32, y: u32) -> [f64; 3] {
    mix(sky(x, y), [245.0; 3], (0.5 + 0.8 * waves(x, y, 60.0)).clamp(0.0, 1.0))
}

pub(super) fn sky_and_lawn(x: u32, y: u32) -> [f64; 3] {
    if f64::from(y) < GROUND * f64::from(SIDE) {
        return sky(x, y);
    }
    mix([95.0, 150.0, 55.0], [125.0, 175.0, 75.0], chance(x, y, 5))
}

pub(super) fn wall(x: u32, y: u32) -> [f64; 3] {
    let light = 1.0 - 0.25 * f64::from(x) / f64::from(SIDE) - 0.1 * f64::from(y) / f64::from(SIDE);
    [225.0, 215.0, 195.0].map(|v| v * light)
}

pub(super) fn iou(a: &Bitmap, b: &Bitmap) -> f64 {
    let both = a.intersection(b);
    both as f64 / (a.ink() + b.ink() - both) as f64
}

#[test]
fn trees_are_found_before_sky_clouds_lawn_and_wall() {
    type Scenery = (&'static str, fn(u32, u32) -> [f64; 3], Background);
    let scenes: [Scenery; 4] = [
        ("sky", sky, Background::Sky),
        ("clouds", cloudy, Background::Sky),
        ("sky and lawn", sky_and_lawn, Background::Sky),
        ("wall", wall, Background::Plain),
    ];
    for species in ["quaking_aspen", "acer", "palm", "small_pine", "silver_birch"] {
        for (name, background, kind) in scenes {
            let scene = scene(species, 6.0, background);
            for background in [kind, Background::Auto] {
                let mask =
                    Mask::from_photo(&scene.photo, &MaskOptions { background, ..MaskOptions::default() });
                let mask = mask.unwrap_or_else(|error| panic!("{species}, {name}: {error}"));
                let iou = iou(&mask.bitmap, &scene.truth);
                assert!(iou >= 0.9, "{species}, {name}, {background:?}: {iou:.3}");
                assert_eq!(mask.touches, Touches::default(), "{species}, {name}");
                if name == "sky and lawn" {
                    let Segmentation::Color { horizon: Some(horizon), .. } = mask.segmentation else {
                        panic!("{species}: no horizon")
                    };
                    assert!((horizon.left - GROUND * f64::from(SIDE)).abs() <= 2.0, "{horizon:?}");
                }
            }
        }
    }
}

/// Pictures without a tree, with as much noise as those with one.
#[test]
fn nothing_is_made_up_where_there_is_no_tree() {
    let empty = |background: fn(u32, u32) -> [f64; 3], grain: f64| {
        Photo::from_fn(SIDE, SIDE, |x, y| {
            let seen = background(x, y);
            let [r, g, b] = [0, 1, 2].map(|c| (seen[c] + grain * noise(x, y, 20 + c as u32)) as u8);
            [r, g, b, 255]
        })
    };
    for grain in [0.0, 6.0] {
        for background in [sky, sky_and_lawn, wall] {
            let error = Mask::from_photo(&empty(background, grain), &MaskOptions::default()).unwrap_err();
            assert!(matches!(error, MaskError::NoTree { .. }), "{error}");
            assert!(error.to_string().contains("A box around the tree"), "{error}");
        }
    }
    let even = Photo::from_fn(64, 64, |_, _| [90, 120, 60, 255]);
    assert!(matches!(Mask::from_photo(&even, &MaskOptions::default()), Err(MaskError::NoTree { .. })));
    // What fills the picture up to a thin frame is not a tree either, nor is a spot.
    let filled = Photo::from_fn(200, 200, |x, y| {
        if (5..195).contains(&x) && (5..195).contains(&y) { [20, 60, 20, 255] } else { [200, 220, 250, 255] }
    });
    assert!(matches!(Mask::from_photo(&filled, &MaskOptions::default()), Err(MaskError::NoTree { .. })));
    let spot = Photo::from_fn(200, 200, |x, y| {
        if (90..99).contains(&x) && (90..99).contains(&y) { [20, 60, 20, 255] } else { [200, 220, 250, 255] }
    });
    assert!(matches!(Mask::from_photo(&spot, &MaskOptions::default()), Err(MaskError::NoTree { .. })));
    // Whatever the picture, there is an answer.
    for (width, height) in [(8, 8), (8, 300), (300, 8), (61, 47)] {
        let random = Photo::from_fn(width, height, |x, y| {
            [0, 1, 2, 3].map(|c| if c == 3 { 255 } else { (256.0 * chance(x, y, 40 + c)) as u8 })
        });
        for background in [Background::Auto, Background::Sky, Background::Plain] {
            let _ = Mask::from_photo(&random, &MaskOptions { background, ..MaskOptions::default() });
        }
    }
}

/// A dark post and a wider one before a sky, and the seed point on either.
fn posts(left: u32) -> Photo {
    Photo::from_fn(120, 100, |x, y| {
        let post = (left..left + 8).contains(&x) || (70..90).contains(&x);
        let [r, g, b] = sky(x, 2 * y).map(|v| v as u8);
        if post && y >= 30 { [60, 50, 30, 255] } else { [r, g, b, 255] }
    })
}

#[test]
fn the_seed_point_chooses_the_tree() {
    let photo = posts(20);
    let at =
        |x, y| Mask::from_photo(&photo, &MaskOptions { seed_point: Some((x, y)), ..MaskOptions::default() });
    let ink = |left: u32, right: u32| Bitmap::from_fn(120, 100, |x, y| x >= left && x < right && y >= 30);
    assert_eq!(at(24, 60).unwrap().bitmap, ink(20, 28));
    assert_eq!(at(80, 60).unwrap().bitmap, ink(70, 90));
    let largest = Mask::from_photo(&photo, &MaskOptions::default()).unwrap();
    assert_eq!((largest.bitmap, largest.dropped), (ink(70, 90), 8 * 70));
    assert_eq!(at(50, 50), Err(MaskError::SeedOnBackground { x: 50, y: 50 }));
    assert_eq!(at(120, 5), Err(MaskError::SeedOutside { x: 120, y: 5, width: 120, height: 100 }));
    assert!(matches!(at(5, 100), Err(MaskError::SeedOutside { .. })));
}

#[test]
fn a_crown_that_touches_the_frame_is_reported() {
    let photo = Photo::from_fn(120, 100, |x, y| {
        let crown = x < 50 && (20..60).contains(&y);
        let trunk = (25..32).contains(&x) && y >= 60;
        let [r, g, b] = sky(x, 2 * y).map(|v| v as u8);
        if crown || trunk { [40, 80, 30, 255] } else { [r, g, b, 255] }
    });
    let options = MaskOptions { background: Background::Sky, ..MaskOptions::default() };
    let mask = Mask::from_photo(&photo, &options).unwrap();
    assert_eq!(mask.touches, Touches { left: true, ..Touches::default() });
    assert_eq!(mask.bitmap.ink(), 50 * 40 + 7 * 40);
}

#[test]
fn an_alpha_channel_is_the_mask() {
    let photo = Photo::from_fn(60, 60, |x, y| [10, 200, 10, if x > 20 && y > 9 { 255 } else { 30 }]);
    let mask = Mask::from_photo(&photo, &MaskOptions::default()).unwrap();
    assert_eq!(mask.segmentation, Segmentation::Opacity);
    assert_eq!(mask.bitmap, Bitmap::from_fn(60, 60, |x, y| x > 20 && y > 9));
}

#[test]
fn small_holes_are_filled_as_far_as_is_asked() {
    let photo = Photo::from_fn(100, 100, |x, y| {
        let tree = (30..70).contains(&x) && y > 20;
        // A glint of 2 × 2 pixels and a gap of 8 × 8.
        let hole = x / 2 == 25 && y / 2 == 25 || (40..48).contains(&x) && (70..78).contains(&y);
        let [r, g, b] = sky(x, 2 * y).map(|v| v as u8);
        if tree && !hole { [40, 60, 30, 255] } else { [r, g, b, 255] }
    });
    for (most, filled) in [(Some(0), 0), (None, 0), (Some(4), 4), (Some(64), 68)] {
        let options = MaskOptions { fill_holes: most, background: Background::Sky, ..MaskOptions::default() };
        let mask = Mask::from_photo(&photo, &options).unwrap();
        assert_eq!(mask.filled, filled, "{most:?}");
        assert_eq!(mask.bitmap.ink(), 40 * 79 - 68 + filled);
    }
}

#[test]
fn an_overlay_keeps_the_tree_and_fades_the_rest() {
    let photo = posts(20);
    let overlay = Mask::from_photo(&photo, &MaskOptions::default()).unwrap().overlay(&photo);
    assert_eq!((overlay.width(), overlay.height()), (120, 100));
    assert_eq!(overlay.get(80, 60), [60, 50, 30]);
    assert_eq!(overlay.get(69, 60), MISSED);
    assert!(overlay.get(24, 60).iter().all(|v| *v > 170));
}

/// A tree in autumn before a wood in sun and shade with a ragged rim, a road and a meadow.
#[test]
fn a_tree_before_a_wood_is_found_by_its_colours() {
    let behind = |x: u32, y: u32| {
        let row = f64::from(y) / f64::from(SIDE);
        let rim = 0.5 + 0.15 * waves(x, 7, 9.0);
        if row < rim {
            sky(x, y)
        } else if row < 0.75 {
            mix([20.0, 35.0, 20.0], [125.0, 150.0, 80.0], chance(x / 3, y / 3, 71))
        } else if row < GROUND {
            [140.0, 140.0, 145.0]
        } else {
            sky_and_lawn(x, y)
        }
    };
    let is_tree = |x: u32, y: u32| {
        let (dx, dy) = (f64::from(x) - 128.0, f64::from(y) - 115.0);
        dx.hypot(dy) < 85.0 + 8.0 * waves(x, y, 6.0) || dx.abs() < 7.0 && (180..235).contains(&y)
    };
    let truth = Bitmap::from_fn(SIDE, SIDE, is_tree);
    for leaf in [[200.0, 90.0, 30.0], [220.0, 130.0, 70.0], [150.0, 40.0, 50.0]] {
        let photo = Photo::from_fn(SIDE, SIDE, |x, y| {
            let light = 0.75 + 0.25 * waves(x, y, 5.0) + 0.3 * (chance(x, y, 73) - 0.5);
            let tone = if y < 180 { leaf } else { [80.0, 65.0, 55.0] };
            let seen = if is_tree(x, y) { tone.map(|v| v * light) } else { behind(x, y) };
            let [r, g, b] = [0, 1, 2].map(|c| (seen[c] + 4.0 * noise(x, y, 74 + c as u32)) as u8);
            [r, g, b, 255]
        });
        let made =
            |background| Mask::from_photo(&photo, &MaskOptions { background, ..MaskOptions::default() });
        let found = made(Background::Auto).unwrap();
        let other =
            [Background::Sky, Background::Plain].map(|b| made(b).map_or(0.0, |m| iou(&m.bitmap, &truth)));
        let found_iou = iou(&found.bitmap, &truth);
        assert!(
            found_iou > 0.85 && other.iter().all(|o| *o < found_iou),
            "{leaf:?}: {found_iou:.3} {other:.3?}"
        );
        // The colours alone, whether or not a cut comes first.
        let colors = colors::foreground(&photo).unwrap();
        let by_colors = Mask::by_color(&colors, &MaskOptions::default()).unwrap();
        assert_eq!(by_colors.segmentation, Segmentation::Colors, "{leaf:?}");
        let colors_iou = iou(&by_colors.bitmap, &truth);
        assert!(
            colors_iou > 0.85 && other.iter().all(|o| *o < colors_iou),
            "{leaf:?}: {colors_iou:.3} {other:.3?}"
        );
    }
}

#[test]
fn the_more_confident_of_two_backgrounds_is_kept() {
    for background in [sky, sky_and_lawn, wall, cloudy] {
        let scene = scene("quaking_aspen", 4.0, background);
        let made = |background| {
            Mask::from_photo(&scene.photo, &MaskOptions { background, ..MaskOptions::default() })
        };
        let auto = made(Background::Auto).unwrap().confidence;
        for one in [Background::Sky, Background::Plain] {
            assert!(made(one).is_ok_and(|mask| mask.confidence <= auto) || made(one).is_err(), "{one:?}");
        }
    }
}

#[test]
fn an_alpha_channel_can_be_ignored() {
    // A cut-out of the wrong thing: the right half of the picture.
    let photo = Photo::from_fn(120, 100, |x, y| {
        let [r, g, b, _] = posts(20).pixels()[(y * 120 + x) as usize];
        [r, g, b, if x > 60 { 255 } else { 0 }]
    });
    let cut = Mask::from_photo(&photo, &MaskOptions::default()).unwrap();
    assert_eq!((cut.segmentation, cut.bitmap.ink()), (Segmentation::Opacity, 59 * 100));
    let options = MaskOptions { alpha: AlphaUse::Ignore, ..MaskOptions::default() };
    let seen = Mask::from_photo(&photo, &options).unwrap();
    assert_eq!(seen.bitmap, Mask::from_photo(&posts(20), &MaskOptions::default()).unwrap().bitmap);
}
