use super::tests::{chance, iou, noise, scene, sky_and_lawn};
use super::*;

/// A round crown on a trunk, twigs of a pixel beyond it, and a hedge of nearly the same green at both sides.
fn hedged() -> (Photo, Bitmap) {
    let is_tree = |x: u32, y: u32| {
        let (dx, dy) = (f64::from(x) - 100.0, f64::from(y) - 90.0);
        dx * dx + dy * dy < 55.0 * 55.0 || dx.abs() < 6.0 && (140..200).contains(&y)
    };
    let truth = Bitmap::from_fn(200, 220, is_tree);
    let photo = Photo::from_fn(200, 220, |x, y| {
        let light = 0.7 + 0.5 * chance(x, y, 91);
        let seen = match (is_tree(x, y), y) {
            (true, 0..145) => [95.0, 130.0, 40.0].map(|v| v * light),
            (true, _) => [85.0, 65.0, 50.0],
            (_, 0..120) => [130.0, 175.0, 225.0],
            (_, 120..180) => [45.0, 80.0, 55.0].map(|v| v * light),
            _ => [150.0, 170.0, 110.0],
        };
        let [r, g, b] =
            [0, 1, 2].map(|c| (seen[c] + 3.0 * noise(x, y, 92 + c as u32)).clamp(0.0, 255.0) as u8);
        [r, g, b, 255]
    });
    (photo, truth)
}

const AROUND: PixelBox = PixelBox { x: 38, y: 30, width: 124, height: 174 };

fn shown(options: MaskOptions) -> Result<Mask, MaskError> {
    Mask::from_photo(&hedged().0, &options)
}

fn boxed(region: PixelBox) -> MaskOptions {
    MaskOptions { region: Some(region), ..MaskOptions::default() }
}

#[test]
fn a_box_finds_a_tree_before_a_hedge() {
    let (_, truth) = hedged();
    let mask = shown(boxed(AROUND)).unwrap();
    let found = iou(&mask.bitmap, &truth);
    assert!(found > 0.9, "{found:.3}");
    assert_eq!(mask.segmentation, Segmentation::Cut { region: AROUND });
    let outside = (0..220).any(|y| mask.bitmap.ink_in_row(y).any(|x| !AROUND.contains(x, y)));
    assert!(!outside);
    // The same bits again: nothing is drawn by chance.
    assert_eq!(shown(boxed(AROUND)).unwrap(), mask);
}

#[test]
fn strokes_add_and_take_away() {
    let with = |include: Vec<Stroke>, exclude: Vec<Stroke>| {
        shown(MaskOptions { include, exclude, ..boxed(AROUND) }).unwrap().bitmap
    };
    let hedge = || Stroke::path(vec![(45, 150), (80, 165)], 3);
    let cut = with(vec![Stroke::point(100, 90)], vec![hedge()]);
    assert!(cut.get(100, 90) && !cut.get(60, 156));
    let crown = Stroke::path(vec![(60, 90), (140, 90)], 5);
    let without = with(Vec::new(), vec![crown]);
    assert!((65..135).all(|x| !without.get(x, 90)));
    let added = with(vec![Stroke::point(100, 90), hedge()], Vec::new());
    assert!(added.get(60, 156) && added.get(100, 90), "what is included is tree");
}

#[test]
fn painted_strokes_are_green_and_red() {
    let layer = Photo::from_fn(200, 220, |x, y| match (x, y) {
        (90..110, 80..100) => [30, 220, 40, 255],
        (45..60, 150..160) => [200, 20, 20, 200],
        (0..20, _) => [0, 255, 0, 100],
        _ => [128, 128, 128, 255],
    });
    let (include, exclude) = Stroke::painted(&layer);
    let ink = |x0: u32, x1: u32, y0: u32, y1: u32| {
        Some(Stroke::area(Bitmap::from_fn(200, 220, |x, y| x >= x0 && x < x1 && y >= y0 && y < y1)))
    };
    assert_eq!((&include, &exclude), (&ink(90, 110, 80, 100), &ink(45, 60, 150, 160)));
    let mask = shown(MaskOptions {
        include: vec![include.unwrap()],
        exclude: vec![exclude.unwrap()],
        ..boxed(AROUND)
    });
    let bitmap = mask.unwrap().bitmap;
    assert!(bitmap.get(100, 90) && !bitmap.get(50, 155));
    assert_eq!(Stroke::painted(&Photo::from_fn(9, 9, |_, _| [255, 255, 255, 255])), (None, None));
}

#[test]
fn bad_boxes_and_strokes_are_errors() {
    let at = |x, y, width, height| PixelBox { x, y, width, height };
    for region in [at(5, 5, 0, 10), at(5, 5, 10, 0)] {
        assert_eq!(shown(boxed(region)), Err(MaskError::EmptyRegion { region }));
    }
    for region in [at(5, 5, 196, 10), at(200, 0, 1, 1), at(u32::MAX, 0, 2, 2), at(0, 0, 10, 221)] {
        assert_eq!(shown(boxed(region)), Err(MaskError::RegionOutside { region, width: 200, height: 220 }));
    }
    let include = |stroke: Stroke| shown(MaskOptions { include: vec![stroke], ..boxed(AROUND) });
    assert_eq!(
        include(Stroke::path(vec![(9, 9), (200, 9)], 1)),
        Err(MaskError::StrokeOutside { x: 200, y: 9, width: 200, height: 220 })
    );
    assert_eq!(include(Stroke::path(Vec::new(), 1)), Err(MaskError::EmptyStroke));
    assert_eq!(include(Stroke::area(Bitmap::new(200, 220))), Err(MaskError::EmptyStroke));
    assert_eq!(
        include(Stroke::area(Bitmap::new(9, 220))),
        Err(MaskError::StrokeSize { stroke: (9, 220), width: 200, height: 220 })
    );
    assert_eq!(include(Stroke::point(3, 3)), Err(MaskError::IncludesNothing));
    let excluded = |exclude, include| shown(MaskOptions { exclude: vec![exclude], include, ..boxed(AROUND) });
    assert_eq!(excluded(Stroke::path(vec![(100, 100)], u32::MAX), Vec::new()), Err(MaskError::ExcludesAll));
    let point = Stroke::point(100, 90);
    assert_eq!(excluded(point.clone(), vec![point]), Err(MaskError::IncludesNothing));
    for error in [
        MaskError::EmptyRegion { region: at(0, 0, 0, 1) },
        MaskError::IncludesNothing,
        MaskError::ExcludesAll,
    ] {
        assert!(error.to_string().len() > 20, "{error}");
    }
}

#[test]
fn any_box_of_any_picture_has_an_answer() {
    for (width, height) in [(8, 8), (8, 300), (300, 8), (61, 47)] {
        let random = Photo::from_fn(width, height, |x, y| {
            [0, 1, 2, 3].map(|c| if c == 3 { 255 } else { (256.0 * chance(x, y, 40 + c)) as u8 })
        });
        let even = Photo::from_fn(width, height, |_, _| [90, 120, 60, 255]);
        for photo in [random, even] {
            for (x, y, w, h) in
                [(0, 0, width, height), (0, 0, 1, 1), (width - 1, height - 1, 1, 1), (2, 2, 3, 5)]
            {
                let region = PixelBox { x, y, width: w, height: h };
                let _ = Mask::from_photo(&photo, &boxed(region));
            }
        }
    }
}

#[test]
fn twigs_of_a_pixel_survive_before_the_sky() {
    // A crown with twigs, in a picture that is reduced to less than half before it is cut.
    let is_twig = |x: u32, y: u32| (300..600).contains(&x) && y.is_multiple_of(40) && (120..480).contains(&y);
    let is_crown = |x: u32, y: u32| {
        let (dx, dy) = (f64::from(x) - 450.0, f64::from(y) - 300.0);
        dx * dx + dy * dy < 130.0 * 130.0
    };
    let is_trunk = |x: u32, y: u32| (435..465).contains(&x) && (300..800).contains(&y);
    let photo = Photo::from_fn(900, 900, |x, y| {
        if is_crown(x, y) || is_trunk(x, y) || is_twig(x, y) {
            [60, 50, 30, 255]
        } else {
            [150, 190, 235, 255]
        }
    });
    let mask =
        Mask::from_photo(&photo, &boxed(PixelBox { x: 290, y: 110, width: 320, height: 700 })).unwrap();
    // Twigs that begin in the crown, as far as 15 pixels beyond its rim.
    let beyond = (300..600).filter(|&x| !is_crown(x, 280) && x.abs_diff(450) < 145);
    let (count, kept) = beyond.fold((0, 0), |(n, k), x| (n + 1, k + u32::from(mask.bitmap.get(x, 280))));
    assert!(count > 20 && kept == count, "{kept} of {count}");
    // And no sky beside them.
    assert!((300..600).all(|x| is_crown(x, 277) || !mask.bitmap.get(x, 277)));
}

#[test]
fn a_box_does_no_worse_than_no_box_before_a_sky() {
    for species in ["quaking_aspen", "acer", "small_pine"] {
        let scene = scene(species, 6.0, sky_and_lawn);
        let (left, top, right, bottom) = scene.truth.ink_box().unwrap();
        let region = PixelBox { x: left, y: top, width: right + 1 - left, height: bottom + 1 - top };
        let mask = Mask::from_photo(&scene.photo, &boxed(region)).unwrap();
        let found = iou(&mask.bitmap, &scene.truth);
        assert!(found > 0.85, "{species}: {found:.3}");
    }
}
