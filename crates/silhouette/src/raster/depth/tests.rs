use super::*;
use crate::view::Projection;
use glam::{dvec3, vec3};
use pleach_plant::leaf_shape::LeafShape;
use pleach_plant::{Blob, Knot, Stem, StemKind};
use std::sync::Arc;

const SIZE: u32 = 64;

/// A tenth of a metre per pixel, the foot below the middle.
fn frame() -> Frame {
    Frame { width: SIZE, height: SIZE, meters_per_pixel: 0.1, axis_column: 32.0, ground_row: 64.0 }
}

fn stem(knots: &[(DVec3, f64)]) -> Tree {
    let third = |a: DVec3, b: DVec3| a + (b - a) / 3.0;
    let knots: Vec<Knot> = (0..knots.len())
        .map(|i| {
            let (point, radius) = knots[i];
            let before = i.checked_sub(1).map_or(point, |i| knots[i].0);
            let after = knots.get(i + 1).map_or(point, |next| next.0);
            Knot { point, handle_in: third(point, before), handle_out: third(point, after), radius }
        })
        .collect();
    let stem = Stem {
        parent: None,
        level: 0,
        kind: StemKind::Trunk,
        number: 0,
        offset: 0.0,
        first_knot: 0,
        knot_count: knots.len() as u32,
    };
    Tree { stems: vec![stem], knots, ..Tree::default() }
}

fn drawn(tree: &Tree, view: &View, parts: Parts) -> (Bitmap, Vec<f32>) {
    let (mut rasterizer, mut picture, mut depth) = (Rasterizer::new(), Bitmap::default(), Vec::new());
    rasterizer.draw(tree, view, &frame(), parts, &mut picture);
    rasterizer.depth(tree, view, &frame(), parts, &picture, &mut depth);
    (picture, depth)
}

fn at(depth: &[f32], x: u32, y: u32) -> f32 {
    depth[(y * SIZE + x) as usize]
}

#[test]
fn a_pole_is_as_round_as_it_is() {
    // A metre thick, three metres behind the foot.
    let tree = stem(&[(dvec3(0.0, 3.0, 0.0), 1.0), (dvec3(0.0, 3.0, 5.0), 1.0)]);
    let (picture, depth) = drawn(&tree, &View::FRONT, Parts::BARE);
    for x in 0..SIZE {
        // Metres from the axis to the middle of a pixel. The nearest part of the pixel may be half a pixel nearer to it.
        let off = (f64::from(x) + 0.5 - 32.0) / 10.0;
        let found = at(&depth, x, 40);
        assert_eq!(found.is_finite(), picture.get(x, 40), "column {x}");
        if off.abs() < 0.94 {
            let round = 3.0 - (1.0 - off * off).sqrt();
            assert!((f64::from(found) - round).abs() < 0.02, "{found} and not {round} at {off}");
        }
    }
    // From behind it is four metres nearer.
    let (_, behind) = drawn(&tree, &View::degrees(180.0, 0.0), Parts::BARE);
    assert!((at(&behind, 31, 40) + 4.0).abs() < 0.01, "{}", at(&behind, 31, 40));
}

#[test]
fn a_stem_that_leans_towards_the_viewer_is_cut_aslant() {
    // 45° towards the viewer: the ray through the axis meets the surface √2 radii before it.
    let tree = stem(&[(dvec3(0.0, 0.0, 0.0), 0.3), (dvec3(0.0, -5.0, 5.0), 0.3)]);
    let (_, depth) = drawn(&tree, &View::FRONT, Parts::BARE);
    for y in 25..55 {
        // The axis passes between two columns, each half a pixel away.
        let height = (64.0 - f64::from(y) - 0.5) / 10.0;
        let expected = -height - 2_f64.sqrt() * (0.09_f64 - 0.0025).sqrt();
        let found = f64::from(at(&depth, 31, y));
        assert!((found - expected).abs() < 0.02, "{found} and not {expected} at {height} m");
    }
    // One that points at the viewer ends where it ends.
    let tree = stem(&[(dvec3(0.0, 2.0, 3.0), 0.5), (dvec3(0.0, -2.0, 3.0), 0.5)]);
    let (picture, depth) = drawn(&tree, &View::FRONT, Parts::BARE);
    assert!(picture.ink() > 60, "{}", picture.ink());
    assert!((-2.5..=-2.0).contains(&at(&depth, 31, 33)), "{}", at(&depth, 31, 33));
}

#[test]
fn leaves_and_blobs_are_planes_and_the_nearest_counts() {
    let leaf = |y: f32, rise: f32| Leaf {
        position: vec3(0.0, y, 1.0),
        along: vec3(0.0, rise, 4.0),
        across: vec3(4.0, 0.0, 0.0),
        stem: 0,
        shape: 0,
    };
    let pole = stem(&[(dvec3(0.0, 0.0, 0.0), 0.05), (dvec3(0.0, 0.0, 0.5), 0.05)]);
    let tree = Tree {
        leaves: vec![leaf(2.0, 0.0), leaf(-1.0, 2.0)],
        leaf_shapes: vec![Arc::clone(LeafShape::Ovate.outline())],
        ..pole.clone()
    };
    let (_, depth) = drawn(&tree, &View::FRONT, Parts::LEAFY);
    // The nearer leaf recedes by half a metre per metre of height.
    for y in 20..50 {
        let height = (64.0 - y as f32 - 0.5) / 10.0;
        let expected = -1.0 + (height - 1.0) / 2.0;
        assert!((at(&depth, 32, y) - expected).abs() < 0.01, "row {y}: {}", at(&depth, 32, y));
    }
    // From behind, the other one is before it where it is nearer.
    let (_, behind) = drawn(&tree, &View::degrees(180.0, 0.0), Parts::LEAFY);
    assert!((20..50).all(|y| (at(&behind, 32, y) + 2.0).abs() < 1e-3));

    let vertices = vec![vec3(-2.0, 1.0, 1.0), vec3(2.0, 1.0, 1.0), vec3(0.0, 3.0, 1.0), vec3(0.0, 1.5, 5.0)];
    let blob = Blob { stem: 0, first_vertex: 0, vertex_count: 4, first_triangle: 0, triangle_count: 4 };
    let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
    let tree = Tree { blobs: vec![blob], blob_vertices: vertices, blob_triangles: triangles, ..pole };
    let (_, depth) = drawn(&tree, &View::FRONT, Parts::LEAFY);
    for y in 20..50 {
        let height = (64.0 - y as f32 - 0.5) / 10.0;
        // The face that looks at the viewer rises from y = 1 at z = 1 to y = 1.5 at z = 5.
        let expected = 1.0 + (height - 1.0) / 8.0;
        assert!((at(&depth, 32, y) - expected).abs() < 0.01, "row {y}: {}", at(&depth, 32, y));
    }
}

#[test]
fn all_that_is_ink_has_a_distance_within_the_tree() {
    // One of each family, dense and sparse crowns, needles, blossoms and blobs.
    let names = [
        "quaking_aspen",
        "palm",
        "coffey_winter_oak",
        "stylised_oak",
        "english_oak",
        "scots_pine",
        "hill_cherry",
    ];
    for name in names {
        let tree = pleach_generators::species(name).unwrap().grow(3).unwrap();
        let bounds = pleach_plant::Bounds::new(&tree, Parts::LEAFY).unwrap();
        let reach = bounds.max.abs().max(bounds.min.abs()).truncate().length() as f32;
        for (azimuth, elevation, projection) in [
            (0.0, 0.0, Projection::Orthographic),
            (215.0, 30.0, Projection::Orthographic),
            (90.0, 0.0, Projection::Perspective { distance: 60.0 }),
        ] {
            let view = View { projection, ..View::degrees(azimuth, elevation) };
            let frame = Frame::automatic(&tree, &view, Parts::LEAFY, 96, 96);
            let (mut rasterizer, mut picture, mut depth) =
                (Rasterizer { saturates: true, ..Rasterizer::new() }, Bitmap::default(), Vec::new());
            rasterizer.draw(&tree, &view, &frame, Parts::LEAFY, &mut picture);
            rasterizer.depth(&tree, &view, &frame, Parts::LEAFY, &picture, &mut depth);
            let seen = depth.iter().filter(|depth| depth.is_finite());
            assert_eq!(seen.clone().count() as u64, picture.ink(), "{name} at {azimuth}");
            let far = reach + if elevation > 0.0 { bounds.max.z as f32 } else { 0.0 };
            assert!(seen.clone().all(|depth| depth.abs() <= far), "{name} at {azimuth}: beyond {far} m");
        }
    }
}

#[test]
fn opposite_sides_enclose_the_tree() {
    let tree = pleach_generators::species("quaking_aspen").unwrap().grow(1).unwrap();
    let (front, near) = drawn(&tree, &View::FRONT, Parts::LEAFY);
    let (back, far) = drawn(&tree, &View::degrees(180.0, 0.0), Parts::LEAFY);
    let mut compared = 0;
    for y in 0..SIZE {
        for x in 0..SIZE {
            // Seen from behind, left is right.
            if front.get(x, y) && back.get(SIZE - 1 - x, y) {
                compared += 1;
                let (near, far) = (at(&near, x, y), -at(&far, SIZE - 1 - x, y));
                assert!(near <= far + 0.1, "{near} m and {far} m at {x}, {y}");
            }
        }
    }
    assert!(compared > 300, "{compared}");
}
