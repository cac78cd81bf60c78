//! Billboards against silhouettes of the tree that they show.

use pleach_mesh::Palette;
use pleach_render::Billboards;
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
        let Billboards { picture, cards } = Billboards::paint(&[&tree], &palette, 2);
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
