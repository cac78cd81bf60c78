//! Pictures that are not of trees: every one has a reading.

use pleach_reading::{Reader, Reading, ReadingError, annotate};
use pleach_silhouette::Bitmap;

/// All numbers of a reading that have to be finite, or in 0..=1.
fn check(picture: &Bitmap) -> Reading {
    let reading = Reading::from_silhouette(picture);
    let value = serde_json::to_value(&reading).unwrap();
    for (key, value) in value.as_object().unwrap() {
        if key.ends_with("_confidence") {
            let confidence = value.as_f64().unwrap();
            assert!((0.0..=1.0).contains(&confidence), "{key} of {picture:?}: {confidence}");
        }
    }
    let back: Reading = serde_json::from_value(value).unwrap();
    assert_eq!(format!("{back:.9?}"), format!("{reading:.9?}"), "a number of {picture:?} is not finite");
    let _ = annotate(picture, &reading);
    assert!(!reading.to_string().is_empty());
    reading
}

#[test]
fn nothing_and_nearly_nothing() {
    for (width, height) in [(0, 0), (1, 1), (5, 0), (0, 5), (64, 64)] {
        assert_eq!(check(&Bitmap::new(width, height)), Reading::default());
    }
    for (width, height) in [(1, 1), (1, 300), (300, 1), (2, 2), (64, 64), (65, 200), (500, 3)] {
        let reading = check(&Bitmap::from_fn(width, height, |_, _| true));
        assert_eq!(reading.feet.len(), 1, "{width} {height}");
    }
    let mut dot = Bitmap::new(100, 100);
    dot.set(40, 70, true);
    assert_eq!(check(&dot).feet_confidence, 0.0);
}

#[test]
fn noise_and_patterns() {
    let mut state = 1_u64;
    let mut noise = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        state >> 33
    };
    for (i, share) in (0..60).zip([1, 3, 30, 200, 999].into_iter().cycle()) {
        let (width, height) = ((noise() % 300 + 1) as u32, (noise() % 300 + 1) as u32);
        check(&Bitmap::from_fn(width, height, |_, _| noise() % 1000 < share));
        check(&Bitmap::from_fn(width, height, |x, y| (x / (i + 1) + y / (i + 1)) % 2 == 0));
        check(&Bitmap::from_fn(width, height, |x, y| (x * x + y * i) % 7 == 0));
    }
    check(&Bitmap::from_fn(3000, 40, |x, _| x % 3 == 0));
    check(&Bitmap::from_fn(40, 3000, |_, y| y % 3 == 0));
}

#[test]
fn a_mask_of_another_size_is_an_error() {
    let tree = Bitmap::from_fn(50, 80, |x, _| x > 20 && x < 28);
    let error = Reading::from_silhouette_with_wood(&tree, &Bitmap::new(80, 50)).unwrap_err();
    assert_eq!(error, ReadingError::WoodSize { wood: (80, 50), silhouette: (50, 80) });
    assert!(error.to_string().contains("must be of one size"));
    // A mask of nothing says nothing.
    let without = Reading::from_silhouette_with_wood(&tree, &Bitmap::new(50, 80)).unwrap();
    assert_eq!(without, Reading::from_silhouette(&tree));
}

#[test]
fn memory_of_other_pictures_changes_nothing() {
    let pictures = [
        Bitmap::from_fn(200, 300, |x, y| x / 7 % 3 == 0 || y < 100),
        Bitmap::new(30, 30),
        Bitmap::from_fn(90, 90, |x, y| (x + y) % 4 == 0 || x > 40 && x < 50),
        Bitmap::from_fn(260, 120, |x, y| x > y && x < y + 30),
    ];
    let (mut reader, mut reading) = (Reader::new(), Reading::default());
    for picture in pictures.iter().chain(pictures.iter().rev()) {
        reader.read(picture, &mut reading);
        assert_eq!(reading, Reading::from_silhouette(picture));
    }
}
