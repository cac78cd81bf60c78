//! Billboards against silhouettes of the tree that they show.

use pleach_mesh::Palette;
use pleach_render::{Billboards, Picture};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;

const SPECIES: [&str; 6] = ["quaking_aspen", "acer", "palm", "small_pine", "apple", "lombardy_poplar"];

/// What a card shows where it is seen from its front, cut out as engines do.
#[test]
fn billboards_show_the_silhouette_of_their_tree() {
    for name in SPECIES {
        let species = pleach_generators::preset(name).unwrap();
        let tree = species.grow(1).unwrap();
        let palette = Palette::new(&species.appearance, None);
        let Billboards { pictures, cards } = Billboards::paint(&[&tree], &palette, 2);
        let picture = pictures.color;
        assert_eq!(cards[0].len(), 2);
        for (card, view) in cards[0].iter().zip([View::FRONT, View::degrees(90.0, 0.0)]) {
            let frame = Frame::automatic(&tree, &view, Parts::LEAFY, 128, 128);
            let mut direct = Bitmap::new(128, 128);
            Rasterizer::new().draw(&tree, &view, &frame, Parts::LEAFY, &mut direct);
            let half = card.corners[1].distance(card.corners[0]) / 2.0;
            let (bottom, top) = (card.corners[0].z, card.corners[3].z);
            let seen = Bitmap::from_fn(128, 128, |x, y| {
                let meters = frame.meters_per_pixel as f32;
                let across = (x as f32 + 0.5 - frame.axis_column as f32) * meters;
                let up = (frame.ground_row as f32 - y as f32 - 0.5) * meters;
                let (s, t) = (0.5 + 0.5 * across / half, (top - up) / (top - bottom));
                if !(0.0..1.0).contains(&s) || !(0.0..1.0).contains(&t) {
                    return false;
                }
                let [left, above, right, below] = card.uv;
                let u = ((left + (right - left) * s) * picture.width as f32) as usize;
                let v = ((above + (below - above) * t) * picture.height as f32) as usize;
                picture.rgba[(v * picture.width as usize + u) * 4 + 3] > 102
            });
            let both = direct.intersection(&seen);
            let found = both as f64 / (direct.ink() + seen.ink() - both) as f64;
            assert!(found > 0.75, "{name} {view:?}: {found}");
        }
    }
}

#[test]
fn what_is_not_seen_has_no_card() {
    let species = pleach_generators::preset("acer").unwrap();
    let (tree, nothing) = (species.grow(1).unwrap(), pleach_tree::Tree::default());
    let palette = Palette::new(&species.appearance, None);
    let billboards = Billboards::paint(&[&nothing, &tree], &palette, 2);
    assert_eq!(billboards.cards.iter().map(Vec::len).collect::<Vec<_>>(), [0, 2]);
    assert!(!billboards.is_empty() && Billboards::paint(&[&nothing], &palette, 3).is_empty());
}

/// The mean of bytes over what a picture shows, and how many pixels that are.
fn mean(picture: &Picture, shown: &Picture, part: impl Fn(u32, u32) -> bool) -> [f64; 3] {
    let (mut sum, mut count) = ([0.0; 3], 0.0);
    for (i, (pixel, own)) in picture.rgba.chunks_exact(4).zip(shown.rgba.chunks_exact(4)).enumerate() {
        if own[3] > 127 && part(i as u32 % picture.width, i as u32 / picture.width) {
            (0..3).for_each(|c| sum[c] += f64::from(pixel[c]));
            count += 1.0;
        }
    }
    sum.map(|s| s / count)
}

#[test]
fn pictures_have_the_sizes_that_engines_want_and_say_where_a_crown_looks() {
    let species = pleach_generators::preset("quaking_aspen").unwrap();
    let (one, two) = (species.grow(1).unwrap(), species.grow(2).unwrap());
    let palette = Palette::new(&species.appearance, None);
    let Billboards { pictures, cards } = Billboards::paint(&[&one, &two], &palette, 3);
    let (color, normal) = (&pictures.color, pictures.normal.as_ref().unwrap());
    assert!(color.width.is_power_of_two() && color.height.is_power_of_two());
    assert_eq!((color.width, color.height), (normal.width, normal.height));
    for card in cards.iter().flatten() {
        let [left, top, right, bottom] = card.uv;
        let height = (bottom - top) * color.height as f32;
        assert!((505.0..=512.0).contains(&height), "{height} pixels high");
        // Pixels are square.
        let metres = [card.corners[1].distance(card.corners[0]), card.corners[3].distance(card.corners[0])];
        let pixels = [(right - left) * color.width as f32, height];
        assert!((metres[0] / pixels[0] / (metres[1] / pixels[1]) - 1.0).abs() < 0.01);
        // The left half looks to the left, the right half to the right, and the upper part up.
        let place = |part: f32, of: u32| (part * of as f32) as u32;
        let (x0, x1) = (place(left, color.width), place(right, color.width));
        let (y0, y1) = (place(top, color.height), place(bottom, color.height));
        let inside = |x: u32, y: u32| (x0..x1).contains(&x) && (y0..y1).contains(&y);
        let middle = (x0 + x1) / 2;
        let of_left = mean(normal, color, |x, y| inside(x, y) && x < middle);
        let of_right = mean(normal, color, |x, y| inside(x, y) && x >= middle);
        let of_top = mean(normal, color, |x, y| inside(x, y) && y < y0 + (y1 - y0) / 4);
        assert!(of_left[0] < 118.0 && of_right[0] > 138.0, "{of_left:?} {of_right:?}");
        assert!(of_top[1] > 150.0 && of_left[2] > 150.0, "{of_top:?} {of_left:?}");
    }
}

/// Nothing casts these shadows again, so that they are in the picture: a dense crown is darker than its leaves.
#[test]
fn a_dense_crown_shows_its_own_shadow() {
    let light = |name: &str| {
        let species = pleach_generators::preset(name).unwrap();
        let tree = species.grow(1).unwrap();
        let palette = Palette::new(&species.appearance, None);
        let pictures = Billboards::paint(&[&tree], &palette, 1).pictures;
        mean(&pictures.color, &pictures.color, |_, y| y < 256)[1] / f64::from(palette.leaf.0[1])
    };
    let (dense, sparse) = (light("quaking_aspen"), light("acer"));
    assert!((0.5..0.9).contains(&dense) && sparse > dense + 0.03, "{dense} {sparse}");
}
