//! Threads that help to draw, whenever they come, change no bit of a picture.

use pleach_plant::leaf_shape::LeafShape;
use pleach_silhouette::{Bitmap, Detail, Frame, Projection, Rasterizer, View};
use pleach_tree::conformance::Volunteers;
use pleach_tree::{Leaf, Parts, Tree};
use std::sync::Arc;

/// Trees with much to draw: stems, leaves, blossoms, blobs, and leaves of which each has another size, or all have one.
fn trees() -> Vec<(String, Tree)> {
    let names = ["quaking_aspen", "weeping_willow", "balsam_fir", "apple", "hill_cherry", "stylised_oak"];
    let grown = |name: &&str| ((*name).to_owned(), pleach_generators::preset(name).unwrap().grow(1).unwrap());
    let mut trees: Vec<(String, Tree)> = names.iter().map(grown).collect();
    let mut thick = trees[0].1.clone();
    thick.knots.iter_mut().for_each(|knot| knot.radius *= 4.0);
    trees.push(("thick stems".to_owned(), thick));
    for drift in [0.0, 1e-5, 1e-3] {
        let mut tree = trees[0].1.clone();
        tree.leaf_shapes = vec![Arc::clone(LeafShape::Maple.outline())];
        let leaf = |(i, leaf): (usize, &Leaf)| {
            let size = 1.0 + drift * (i % 2000) as f32;
            let length = leaf.along.normalize() * 0.1 * size;
            Leaf { along: length, across: leaf.across.normalize() * 0.1 * size, shape: 0, ..*leaf }
        };
        tree.leaves = tree.leaves.iter().enumerate().map(leaf).collect();
        trees.push((format!("leaves that drift by {drift}"), tree));
    }
    trees
}

#[test]
fn pictures_are_the_same_with_help() {
    let near = Projection::Perspective { distance: 60.0 };
    let mut calls = 0;
    for (name, tree) in trees() {
        for view in [View::degrees(40.0, 30.0), View { projection: near, ..View::FRONT }] {
            let whole = Frame::automatic(&tree, &view, Parts::LEAFY, 160, 150);
            // Larger than the picture as well, so that the tree lies across its edges.
            for frame in [whole, Frame { meters_per_pixel: 0.4 * whole.meters_per_pixel, ..whole }] {
                for mut rasterizer in
                    [Rasterizer::for_searches(Detail::Half), Rasterizer::with_detail(Detail::Draft)]
                {
                    let [mut stems, mut alone] = [Bitmap::default(), Bitmap::default()];
                    let pictures = [&mut stems, &mut alone];
                    rasterizer.draw_with_stems(&tree, &view, &frame, Parts::LEAFY, pictures);
                    for (threads, patience) in [(1, 0), (2, 5), (3, 40), (8, 0)] {
                        let helpers = Volunteers::new(threads, patience);
                        let [mut helped_stems, mut helped] = [Bitmap::default(), Bitmap::default()];
                        let pictures = [&mut helped_stems, &mut helped];
                        let drawing = rasterizer.helped(Some(&helpers));
                        drawing.draw_with_stems(&tree, &view, &frame, Parts::LEAFY, pictures);
                        assert_eq!(helped_stems.differing(&stems), 0, "stems of {name}, {threads} threads");
                        assert_eq!(helped.differing(&alone), 0, "{name}, {threads} threads");
                        calls += helpers.calls();
                        let mut again = Bitmap::default();
                        rasterizer.draw(&tree, &view, &frame, Parts::LEAFY, &mut again);
                        assert_eq!(again.differing(&alone), 0, "{name}: help leaves no trace");
                    }
                }
            }
        }
    }
    assert!(calls > 200, "{calls}");
}

#[test]
fn what_is_covered_is_the_same_with_help() {
    for (name, tree) in trees() {
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 150, 150);
        let (mut rasterizer, mut picture) = (Rasterizer::with_detail(Detail::Half), Bitmap::default());
        let [mut alone, mut helped] = [Vec::new(), Vec::new()];
        rasterizer.draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
        rasterizer.coverage(&mut alone);
        let helpers = Volunteers::new(4, 2);
        rasterizer.helped(Some(&helpers)).draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut picture);
        rasterizer.coverage(&mut helped);
        assert!(helped == alone, "{name}");
        assert!(name == "stylised_oak" || helpers.calls() > 0, "{name} is large enough for help");
    }
}
