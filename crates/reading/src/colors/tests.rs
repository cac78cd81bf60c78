//! Drawn trees whose colours are known.

use super::*;
use pleach_plant::{Appearance, BarkPattern};

const SIZE: u32 = 200;
const BARK: [u8; 3] = [0x6b, 0x4c, 0x30];
const GREEN: [u8; 3] = [0x5c, 0x83, 0x36];
const ORANGE: [u8; 3] = [0xd9, 0x7a, 0x1e];

/// A number in 0..1 that differs from pixel to pixel.
fn noise(x: u32, y: u32) -> f64 {
    let mut v =
        u64::from(x).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ u64::from(y).wrapping_mul(0xD1B5_4A32_D192_ED03);
    v ^= v >> 29;
    v = v.wrapping_mul(0x94D0_49BB_1331_11EB);
    (v >> 40) as f64 / (1_u64 << 24) as f64
}

fn lit([r, g, b]: [u8; 3], light: f64) -> [u8; 4] {
    let [r, g, b] = [r, g, b].map(|v| (f64::from(v) * light).min(255.0) as u8);
    [r, g, b, 255]
}

fn in_trunk(x: u32, y: u32) -> bool {
    (92..108).contains(&x) && y >= 120
}

fn in_crown(x: u32, y: u32) -> bool {
    let (dx, dy) = (f64::from(x) - 100.0, f64::from(y) - 75.0);
    dx * dx + dy * dy < 68.0 * 68.0
}

/// A trunk under a round crown, of which the part `petals` is in the colour of blossoms.
fn round(leaf: [u8; 3], petals: f64, petal: [u8; 3]) -> Photo {
    Photo::from_fn(SIZE, SIZE, |x, y| match (in_crown(x, y), in_trunk(x, y)) {
        (true, _) if noise(x / 3, y / 3) < petals => lit(petal, 0.95 + 0.05 * noise(x, y)),
        (true, _) => lit(leaf, 0.6 + 0.55 * noise(x / 2 + 900, y / 2)),
        (_, true) => lit(BARK, 0.9 + 0.2 * noise(x, y)),
        _ => [0; 4],
    })
}

/// A trunk with level and rising limbs, `snow` on top of them.
fn limbs(bark: [u8; 3], snow: bool) -> Photo {
    Photo::from_fn(SIZE, SIZE, |x, y| {
        let away = (f64::from(x) - 100.0).abs();
        let rise = f64::from(y) + 0.5 * away;
        let limb =
            (0..6).map(|i| rise - 40.0 - 25.0 * f64::from(i)).find(|d| (0.0..6.0).contains(d) && away < 80.0);
        match (away < 7.0 && y > 10, limb) {
            (_, Some(d)) if snow && d < 3.0 => [0xf2, 0xf4, 0xf8, 255],
            (true, _) | (_, Some(_)) => lit(bark, 0.85 + 0.3 * noise(x, y)),
            _ => [0; 4],
        }
    })
}

fn mask(photo: &Photo) -> Bitmap {
    Bitmap::from_fn(photo.width(), photo.height(), |x, y| {
        photo.pixels()[(y * photo.width() + x) as usize][3] >= 128
    })
}

fn read(photo: &Photo) -> Colors {
    Colors::read(photo, &mask(photo)).unwrap()
}

#[track_caller]
fn assert_near(read: Option<Color>, given: [u8; 3], most: u8) {
    let Some(Color(read)) = read else { panic!("no color instead of {given:?}") };
    let distance = (0..3).map(|i| read[i].abs_diff(given[i])).max().unwrap();
    assert!(distance <= most, "{read:?} is not {given:?}");
}

#[test]
fn a_green_and_an_orange_crown_are_what_they_are() {
    for (leaf, season) in [(GREEN, Season::Summer), (ORANGE, Season::Autumn)] {
        let colors = read(&round(leaf, 0.0, [0; 3]));
        assert_eq!((colors.leaves, colors.season), (Some(true), Some(season)));
        assert!(
            colors.leaves_confidence > 0.8 && colors.leaf_confidence > 0.8 && colors.season_confidence > 0.8
        );
        assert_near(colors.leaf, leaf, 32);
        assert_near(colors.bark, BARK, 20);
        assert_eq!(colors.blossom, None);
        let wood = Bitmap::from_fn(SIZE, SIZE, |x, y| in_trunk(x, y) && !in_crown(x, y));
        let crown = Bitmap::from_fn(SIZE, SIZE, in_crown);
        assert!(colors.wood.intersection(&wood) * 10 > wood.ink() * 8, "trunk");
        assert!(colors.foliage.intersection(&crown) * 10 > crown.ink() * 9, "crown");
        assert_eq!(colors.wood.intersection(&colors.foliage), 0, "a pixel is one of the two");
    }
}

#[test]
fn blossom_is_spring() {
    for petal in [[0xf8, 0xf4, 0xf2], [0xf4, 0xc4, 0xd4]] {
        let colors = read(&round(GREEN, 0.4, petal));
        assert_eq!((colors.leaves, colors.season), (Some(true), Some(Season::Spring)), "{petal:?}");
        assert_near(colors.blossom, petal, 16);
        assert!(colors.blossom_confidence > 0.7);
        assert_near(colors.leaf, GREEN, 40);
        // All in blossom and without a leaf.
        let colors = read(&round(GREEN, 1.0, petal));
        assert_eq!((colors.leaves, colors.season), (Some(true), Some(Season::Spring)), "{petal:?}");
    }
}

#[test]
fn bare_limbs_are_wood_and_snow_is_not_blossom() {
    for photo in [limbs(BARK, false), limbs([0x80, 0x77, 0x6a], false), limbs(BARK, true)] {
        let colors = read(&photo);
        assert_eq!((colors.leaves, colors.season, colors.leaf), (Some(false), Some(Season::Winter), None));
        assert_eq!((colors.wood.clone(), colors.foliage.ink()), (mask(&photo), 0));
        assert_eq!(colors.blossom, None);
        assert!(colors.leaves_confidence > 0.6, "{}", colors.leaves_confidence);
    }
}

#[test]
fn silhouettes_and_greys_have_no_colors() {
    let grey =
        |v: u8| move |x: u32, y: u32| if in_crown(x, y) || in_trunk(x, y) { [v, v, v, 255] } else { [0; 4] };
    let greys = Photo::from_fn(SIZE, SIZE, |x, y| {
        let v = (200.0 * noise(x, y)) as u8;
        if in_crown(x, y) || in_trunk(x, y) { [v, v, v, 255] } else { [255; 4] }
    });
    let tree = mask(&Photo::from_fn(SIZE, SIZE, grey(0)));
    for photo in [Photo::from_fn(SIZE, SIZE, grey(0)), Photo::from_fn(SIZE, SIZE, grey(90)), greys] {
        let colors = Colors::read(&photo, &tree).unwrap();
        let nothing =
            Colors { wood: Bitmap::new(SIZE, SIZE), foliage: Bitmap::new(SIZE, SIZE), ..Colors::default() };
        assert_eq!(colors, nothing);
        let start = Appearance { leaf: Some(Color(GREEN)), ..Appearance::default() };
        assert_eq!(colors.appearance(&start), start);
    }
}

#[test]
fn bad_input_is_an_error_or_nothing_and_never_a_panic() {
    let photo = round(GREEN, 0.0, [0; 3]);
    let error = Colors::read(&photo, &Bitmap::new(3, 4)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "the mask is 3 × 4 pixels, but the photograph is 200 × 200: the two must be of one size"
    );
    assert_eq!(Colors::read(&photo, &Bitmap::new(SIZE, SIZE)).unwrap().leaf, None, "empty");
    let full = |w: u32, h: u32| Bitmap::from_fn(w, h, |_, _| true);
    for (width, height) in [(0, 0), (1, 1), (1, 300), (300, 1), (2, 2), (1500, 2)] {
        for pixel in [
            [0; 4],
            [0, 0, 0, 255],
            [255; 4],
            [0x5c, 0x83, 0x36, 255],
            [200, 30, 20, 255],
            [9, 200, 250, 127],
        ] {
            let colors =
                Colors::read(&Photo::from_fn(width, height, |_, _| pixel), &full(width, height)).unwrap();
            assert_eq!((colors.wood.width(), colors.wood.height()), (width, height));
            let _ = colors.appearance(&Appearance::default());
        }
    }
}

#[test]
fn large_pictures_are_read_as_small_ones() {
    let small = round(GREEN, 0.0, [0; 3]);
    let large = Photo::from_fn(4 * SIZE, 4 * SIZE, |x, y| small.pixels()[(y / 4 * SIZE + x / 4) as usize]);
    let (a, b) = (read(&small), read(&large));
    assert_eq!((a.leaves, a.season), (b.leaves, b.season));
    assert_near(b.leaf, a.leaf.unwrap().0, 12);
    assert_eq!((b.wood.width(), b.wood.height()), (800, 800));
    let four_times = Bitmap::from_fn(4 * SIZE, 4 * SIZE, |x, y| a.foliage.get(x / 4, y / 4));
    assert!(20 * four_times.differing(&b.foliage) < four_times.ink(), "the same foliage");
}

#[test]
fn the_same_bits_twice_and_from_json() {
    let photo = round(GREEN, 0.3, [0xf4, 0xc4, 0xd4]);
    let colors = read(&photo);
    assert_eq!(colors, read(&photo));
    let json = serde_json::to_string(&colors).unwrap();
    assert!(json.contains("\"season\":\"spring\"") && json.contains("\"bark\":\"#"), "{json}");
    let back: Colors = serde_json::from_str(&json).unwrap();
    assert_eq!(back, Colors { wood: Bitmap::default(), foliage: Bitmap::default(), ..colors });
    let wrong = |from: &str, to: &str| {
        serde_json::from_str::<Colors>(&json.replace(from, to)).unwrap_err().to_string()
    };
    assert!(wrong("\"spring\"", "\"sprint\"").starts_with("`sprint` is not a season: allowed are `spring`"));
    assert!(wrong("\"bark\":\"#", "\"bark\":\"").contains("a color is written `#rrggbb`"));
}

#[test]
fn an_orange_maple_is_orange_whatever_it_started_from() {
    let start = Appearance {
        leaf: Some(Color([1, 2, 3])),
        evergreen: Some(true),
        bark_pattern: Some(BarkPattern::Banded),
        season: Some(Season::Summer),
        ..Appearance::default()
    };
    let colors = read(&round(ORANGE, 0.0, [0; 3]));
    let found = colors.appearance(&start);
    assert_eq!((found.autumn, found.bark, found.season), (colors.leaf, colors.bark, Some(Season::Autumn)));
    assert_eq!((found.leaf, found.evergreen), (start.leaf, Some(false)));
    assert_eq!(found.bark_pattern, Some(BarkPattern::Furrowed), "bark this dark is not a birch's");
    let green = read(&round(GREEN, 0.0, [0; 3])).appearance(&start);
    assert_eq!((green.season, green.evergreen, green.autumn), (Some(Season::Summer), Some(true), None));
    assert_ne!(green.leaf, start.leaf);
    let bare = read(&limbs(BARK, false)).appearance(&start);
    assert_eq!((bare.season, bare.evergreen, bare.leaf), (Some(Season::Winter), Some(false), start.leaf));
    let doubtful = Colors { leaf_confidence: 0.2, season_confidence: 0.2, bark_confidence: 0.2, ..colors };
    assert_eq!(doubtful.appearance(&start), start);
}

#[test]
fn drawings_in_flat_colors_are_told_from_photographs() {
    let tree =
        |photo: &Photo| Bitmap::from_fn(SIZE, SIZE, |x, y| photo.pixels()[(y * SIZE + x) as usize][3] > 0);
    let read = |photo: Photo| Colors::read(&photo, &tree(&photo)).unwrap();
    let photograph = read(Photo::from_fn(SIZE, SIZE, |x, y| match (in_crown(x, y), in_trunk(x, y)) {
        (true, _) => lit(GREEN, 0.6 + 0.55 * noise(x, y)),
        (_, true) => lit(BARK, 0.9 + 0.2 * noise(x, y)),
        _ => [0; 4],
    }));
    assert!(!photograph.is_drawn() && photograph.flat_share.unwrap() < 0.1, "{:?}", photograph.flat_share);
    let icon = read(Photo::from_fn(SIZE, SIZE, |x, y| match (in_crown(x, y), in_trunk(x, y)) {
        (true, _) => lit(GREEN, 1.0),
        (_, true) => lit(BARK, 1.0),
        _ => [0; 4],
    }));
    assert!(icon.is_drawn() && icon.flat_share.unwrap() > 0.9, "{:?}", icon.flat_share);
}
