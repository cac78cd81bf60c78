use super::*;
use proptest::prelude::*;

/// Any picture of a size: noise of any density in a box.
fn pictures() -> impl Strategy<Value = [Bitmap; 2]> {
    (1_u32..150, 1_u32..150, [0_u32..=8, 0_u32..=8], any::<u32>()).prop_map(|(width, height, ink, seed)| {
        std::array::from_fn(|k| {
            Bitmap::from_fn(width, height, |x, y| {
                let mixed = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77) ^ seed;
                let noise = mixed.wrapping_mul(0xc2b2_ae3d + 2 * k as u32);
                (noise >> 13) % 8 < ink[k]
            })
        })
    })
}

proptest! {
    #[test]
    fn likeness_is_bounded_symmetric_and_one_for_equal_pictures([a, b] in pictures()) {
        let there = Likeness::between(&a, &b);
        for part in there.parts().into_iter().chain([there.value()]) {
            prop_assert!((0.0..=1.0).contains(&part), "{:?}", there);
        }
        prop_assert_eq!(there, Likeness::between(&b, &a));
        prop_assert_eq!(Likeness::between(&a, &a).value(), 1.0);
    }

    #[test]
    fn memory_that_was_used_before_leaves_no_trace([a, b] in pictures(), [c, d] in pictures()) {
        let mut used = Scratch::default();
        let _ = [Descriptor::new(&c, &mut used), Descriptor::new(&d, &mut used)];
        for picture in [a, b] {
            prop_assert_eq!(Descriptor::new(&picture, &mut used), Descriptor::new(&picture, &mut Scratch::default()));
        }
    }
}

fn value(a: &Bitmap, b: &Bitmap) -> f64 {
    Likeness::between(a, b).value()
}

#[test]
fn pictures_without_ink_or_paper_have_a_likeness() {
    for (width, height) in [(1, 1), (64, 64), (100, 3), (1, 300)] {
        let (empty, full) = (Bitmap::new(width, height), Bitmap::from_fn(width, height, |_, _| true));
        assert_eq!([value(&empty, &empty), value(&full, &full)], [1.0, 1.0]);
        assert_eq!([value(&empty, &full), value(&full, &empty)], [0.0, 0.0]);
    }
    assert_eq!(value(&Bitmap::new(0, 0), &Bitmap::new(0, 0)), 1.0);
}

#[test]
fn a_comb_is_more_like_another_comb_than_like_its_own_blob() {
    // A crown of thin twigs, the same a little aside, and its outline filled.
    let inside = |x: u32, y: u32| (40..216).contains(&x) && (30..200).contains(&y);
    let comb = |phase: u32| Bitmap::from_fn(256, 256, move |x, y| inside(x, y) && (x + phase) % 12 < 5);
    let blob = Bitmap::from_fn(256, 256, inside);
    let (goal, other) = (comb(0), comb(6));
    assert!(goal.intersection(&other) < goal.intersection(&blob), "overlap prefers the blob");
    let (like, unlike) = (value(&goal, &other), value(&goal, &blob));
    assert!(like > 0.9 && unlike < 0.4, "{like} {unlike}");
}

#[test]
fn a_pinhole_costs_little() {
    let disc = |hole: bool| {
        Bitmap::from_fn(256, 256, move |x, y| {
            x.abs_diff(128).pow(2) + y.abs_diff(128).pow(2) < 80 * 80 && !(hole && (x, y) == (120, 100))
        })
    };
    let likeness = value(&disc(false), &disc(true));
    assert!(likeness > 0.98 && likeness < 1.0, "{likeness}");
}

#[test]
fn likeness_falls_as_a_picture_moves_grows_or_thickens() {
    let comb = |moved: u32, grown: u32, thick: u32| {
        Bitmap::from_fn(256, 256, move |x, y| {
            (60 + moved..160 + moved + grown).contains(&x)
                && (60 - grown..200).contains(&y)
                && (x + y) % 16 < 4 + thick
        })
    };
    let goal = comb(0, 0, 0);
    let ways: [fn(u32) -> [u32; 3]; 3] = [|i| [4 * i, 0, 0], |i| [0, 6 * i, 0], |i| [0, 0, i]];
    for way in ways {
        let values: Vec<f64> = (0..6)
            .map(|i| {
                let [moved, grown, thick] = way(i);
                value(&goal, &comb(moved, grown, thick))
            })
            .collect();
        assert!(values.windows(2).all(|w| w[1] < w[0]), "{values:?}");
    }
}

#[test]
fn twice_the_size_is_about_the_same_likeness() {
    let draw = |side: u32, slope: u32| {
        Bitmap::from_fn(side, side, move |x, y| {
            let (x, y) = (256 * x / side, 256 * y / side);
            (x * slope + y) % 40 < 14 && x.abs_diff(128) < y / 2 + 10 && y > 20
        })
    };
    let at = |side: u32| value(&draw(side, 1), &draw(side, 2));
    assert!((at(256) - at(512)).abs() < 0.03, "{} {}", at(256), at(512));
}

#[test]
fn without_a_part_the_others_make_the_mean() {
    let likeness = Likeness { mass: 0.5, rim: 1.0, strokes: 1.0, gaps: 0.0 };
    assert!((likeness.value() - 0.65).abs() < 1e-12);
    assert!((likeness.without(0) - 2.0 / 3.0).abs() < 1e-12);
    assert!((likeness.without(3) - 0.65 / 0.7).abs() < 1e-12);
}
