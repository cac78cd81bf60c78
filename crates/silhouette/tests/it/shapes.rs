//! Small silhouettes as pictures, and what must hold for any tree.

use glam::{DVec3, Vec3, dvec3, vec3};
use pleach_silhouette::{Bitmap, Detail, Frame, Rasterizer, View};
use pleach_tree::Bounds;
use pleach_tree::leaf_shape::{LeafShape, Outline};
use pleach_tree::{Blob, Knot, Leaf, Parts, Stem, StemKind, Tree};
use proptest::prelude::*;
use std::sync::Arc;

fn straight(from: DVec3, to: DVec3, r0: f64, r1: f64) -> [Knot; 2] {
    let third = (to - from) / 3.0;
    let knot =
        |point: DVec3, radius| Knot { point, handle_in: point - third, handle_out: point + third, radius };
    [knot(from, r0), knot(to, r1)]
}

fn tree(stems: &[[Knot; 2]], leaves: Vec<Leaf>) -> Tree {
    let mut tree =
        Tree { leaves, leaf_shapes: vec![Arc::clone(LeafShape::Rectangle.outline())], ..Tree::default() };
    for (i, knots) in stems.iter().enumerate() {
        tree.stems.push(Stem {
            parent: None,
            level: 0,
            kind: StemKind::Trunk,
            number: 0,
            offset: 0.0,
            first_knot: 2 * i as u32,
            knot_count: 2,
        });
        tree.knots.extend_from_slice(knots);
    }
    tree
}

/// One metre a pixel, the trunk in the middle of the bottom edge.
fn frame(width: u32, height: u32) -> Frame {
    Frame {
        width,
        height,
        meters_per_pixel: 1.0,
        axis_column: f64::from(width) / 2.0,
        ground_row: f64::from(height),
    }
}

fn drawn(tree: &Tree, view: &View, frame: &Frame) -> Bitmap {
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(tree, view, frame, Parts::LEAFY, &mut bitmap);
    bitmap
}

#[track_caller]
fn assert_silhouette(found: &Bitmap, expected: &str) {
    let expected = Bitmap::from_ascii(expected);
    let (found_text, expected_text) = (found.to_ascii(), expected.to_ascii());
    if found_text != expected_text {
        let differs = |(a, b): (char, char)| if a == b { a } else { '!' };
        let map: String = found_text.chars().zip(expected_text.chars()).map(differs).collect();
        panic!("expected\n{expected_text}\nfound\n{found_text}\ndiffering\n{map}");
    }
}

#[test]
fn a_pole_a_fork_and_a_leaf() {
    let pole = straight(DVec3::ZERO, dvec3(0.0, 0.0, 5.0), 1.0, 1.0);
    assert_silhouette(
        &drawn(&tree(&[pole], vec![]), &View::FRONT, &frame(6, 6)),
        "
        ......
        ..##..
        ..##..
        ..##..
        ..##..
        ..##..",
    );
    let fork = [
        straight(DVec3::ZERO, dvec3(0.0, 0.0, 3.0), 0.5, 0.5),
        straight(dvec3(0.0, 0.0, 3.0), dvec3(3.0, 0.0, 6.0), 0.7, 0.7),
        straight(dvec3(0.0, 0.0, 3.0), dvec3(-3.0, 0.0, 6.0), 0.7, 0.7),
    ];
    let narrow = Frame { axis_column: 4.5, ..frame(9, 7) };
    assert_silhouette(
        &drawn(&tree(&fork, vec![]), &View::FRONT, &narrow),
        "
        .........
        .##...##.
        ..##.##..
        ...###...
        ....#....
        ....#....
        ....#....",
    );
    let leaf = Leaf {
        position: vec3(-2.0, 0.0, 2.0),
        along: vec3(0.0, 0.0, 3.0),
        across: vec3(2.0, 0.0, 0.0),
        stem: 0,
        shape: 0,
    };
    let leafy = tree(&[straight(DVec3::ZERO, dvec3(0.0, 0.0, 1.0), 0.5, 0.5)], vec![leaf]);
    let narrow = Frame { axis_column: 4.5, ..frame(9, 6) };
    let mut shifted = leafy.clone();
    shifted.leaves[0].position.x = -2.5;
    assert_silhouette(
        &drawn(&shifted, &View::FRONT, &narrow),
        "
        .........
        .##......
        .##......
        .##......
        .........
        ....#....",
    );
}

#[test]
fn from_above_a_trunk_is_a_disc() {
    let pole = straight(DVec3::ZERO, dvec3(0.0, 0.0, 20.0), 3.2, 3.2);
    let middle = Frame { ground_row: 4.0, ..frame(8, 8) };
    assert_silhouette(
        &drawn(&tree(&[pole], vec![]), &View::degrees(0.0, 90.0), &middle),
        "
        ........
        ..####..
        .######.
        .######.
        .######.
        .######.
        ..####..
        ........",
    );
}

fn any_vec(reach: f32) -> impl Strategy<Value = Vec3> {
    (-reach..reach, -reach..reach, -reach..reach).prop_map(|(x, y, z)| vec3(x, y, z))
}

fn any_tree(reach: f32) -> impl Strategy<Value = Tree> {
    let stem = (any_vec(reach), any_vec(reach), 0.0..5.0_f64, 0.0..5.0_f64)
        .prop_map(|(a, b, r0, r1)| straight(a.as_dvec3(), b.as_dvec3(), r0, r1));
    let leaf = (any_vec(reach), any_vec(4.0), any_vec(4.0)).prop_map(|(position, along, across)| Leaf {
        position,
        along,
        across,
        stem: 0,
        shape: 0,
    });
    (prop::collection::vec(stem, 1..8), prop::collection::vec(leaf, 0..20), 0..10_usize).prop_map(
        |(stems, leaves, shape)| {
            let leaf_shapes = vec![Arc::clone(LeafShape::ALL[shape].outline())];
            Tree { leaf_shapes, ..tree(&stems, leaves) }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, ..ProptestConfig::default() })]

    /// Huge, tiny, in and out of the picture, from anywhere: drawing ends, and twice the same.
    #[test]
    fn any_tree_can_be_drawn(tree in any_tree(1e4), azimuth in -10.0..10.0_f64, elevation in -90.0..90.0_f64, scale in -6.0..6.0_f64, distance in 1.0..1e5_f64) {
        let view = View { projection: pleach_silhouette::Projection::Perspective { distance }, ..View::degrees(azimuth * 50.0, elevation) };
        let frame = Frame { meters_per_pixel: 10.0_f64.powf(scale), ..frame(70, 50) };
        for view in [view, View::FRONT] {
            prop_assert!(drawn(&tree, &view, &frame) == drawn(&tree, &view, &frame));
        }
    }

    /// Moving the frame by two pixels moves the picture by two pixels (one would swap the turns of ties).
    #[test]
    fn whole_pixels_shift_the_picture(tree in any_tree(20.0), dx in -4..5_i32, dy in -4..5_i32) {
        let still = Frame { axis_column: 40.0, ground_row: 40.0, ..frame(80, 80) };
        let moved = Frame { axis_column: 40.0 + 2.0 * f64::from(dx), ground_row: 40.0 + 2.0 * f64::from(dy), ..still };
        let (a, b) = (drawn(&tree, &View::FRONT, &still), drawn(&tree, &View::FRONT, &moved));
        let mut off = 0;
        for y in 10..70_u32 {
            for x in 10..70_u32 {
                let there = b.get(x.wrapping_add_signed(2 * dx), y.wrapping_add_signed(2 * dy));
                off += u32::from(a.get(x, y) != there);
            }
        }
        // Single precision may round a sample across an edge.
        prop_assert!(off <= 6, "{off} pixels differ");
    }

    /// Leaves add ink and take none away.
    #[test]
    fn leaves_only_add(tree in any_tree(30.0)) {
        let bare = Tree { leaves: vec![], ..tree.clone() };
        let (with, without) = (drawn(&tree, &View::FRONT, &frame(64, 64)), drawn(&bare, &View::FRONT, &frame(64, 64)));
        // Thin leaves are sampled more finely, which moves a pixel here and there.
        let lost = without.ink() - without.intersection(&with);
        prop_assert!(lost * 50 <= without.ink() + 100, "{lost} of {}", without.ink());
    }

    /// Ink stays where the tree is.
    #[test]
    fn ink_stays_within_the_bounds(tree in any_tree(15.0)) {
        let bounds = pleach_tree::Bounds::new(&tree, Parts::LEAFY).unwrap();
        let frame = Frame { axis_column: 32.0, ground_row: 32.0, ..frame(64, 64) };
        if let Some((left, top, right, bottom)) = drawn(&tree, &View::FRONT, &frame).ink_box() {
            let slack = 6.5; // the caps of stems reach a radius beyond their ends
            prop_assert!(f64::from(left) - 32.0 >= bounds.min.x - slack && f64::from(right) - 31.0 <= bounds.max.x + slack);
            prop_assert!(32.0 - f64::from(top) <= bounds.max.z + slack && 31.0 - f64::from(bottom) >= bounds.min.z - slack);
        }
    }
}

/// A blade 3 m high at `x`, of shape number `shape`.
fn blade(x: f32, shape: u16) -> Leaf {
    let (along, across) = (vec3(0.0, 0.0, 3.0), vec3(2.0, 0.0, 0.0));
    Leaf { position: vec3(x, 0.0, 1.0), along, across, stem: 0, shape }
}

#[test]
fn each_leaf_has_its_own_shape() {
    let mut mixed = tree(&[], vec![blade(-2.5, 0), blade(0.5, 1), blade(3.5, 0)]);
    // A wedge that leans to the right: no half of it mirrors the other.
    let wedge = Outline::new("wedge", vec![[-0.5, 0.0], [0.5, 0.0], [0.5, 1.0]]).unwrap();
    mixed.leaf_shapes.push(Arc::new(wedge));
    let narrow = Frame { axis_column: 4.5, ..frame(9, 5) };
    assert_silhouette(
        &drawn(&mixed, &View::FRONT, &narrow),
        "
        .........
        .##....##
        .##..#.##
        .##.##.##
        .........",
    );
}

/// A box with its faces counter-clockwise seen from outside.
fn boxed(min: Vec3, max: Vec3) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let pick =
        |bit: u32, i: usize| if i as u32 >> bit & 1 == 0 { min[bit as usize] } else { max[bit as usize] };
    let corners = (0..8).map(|i| vec3(pick(0, i), pick(1, i), pick(2, i))).collect();
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    (corners, faces.iter().flat_map(|f| [[f[0], f[1], f[2]], [f[0], f[2], f[3]]]).collect())
}

#[test]
fn blobs_are_drawn_from_every_side() {
    let mut bush = tree(&[straight(DVec3::ZERO, dvec3(0.0, 0.0, 3.0), 1.0, 1.0)], Vec::new());
    (bush.blob_vertices, bush.blob_triangles) = boxed(vec3(-3.0, -2.0, 2.0), vec3(3.0, 2.0, 4.0));
    bush.blobs =
        vec![Blob { stem: 0, first_vertex: 0, vertex_count: 8, first_triangle: 0, triangle_count: 12 }];
    bush.well_formed().unwrap();
    let frame = Frame { axis_column: 4.5, ..frame(9, 5) };
    let centered = Frame { axis_column: 4.0, ..frame };
    assert_silhouette(
        &drawn(&bush, &View::FRONT, &centered),
        "
        .........
        .######..
        .######..
        ...##....
        ...##....",
    );
    for azimuth in [90.0, 180.0, 270.0] {
        let side = drawn(&bush, &View::degrees(azimuth, 0.0), &centered);
        let expected = if azimuth == 180.0 { 16 } else { 12 };
        assert_eq!(side.ink(), expected, "{azimuth}: {}", side.to_ascii());
    }
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(&bush, &View::FRONT, &centered, Parts::BARE, &mut bitmap);
    assert_eq!(bitmap.ink(), 6, "{}", bitmap.to_ascii());
}

#[test]
fn roots_are_drawn_where_they_are_asked_for() {
    let mut rooted = tree(
        &[
            straight(DVec3::ZERO, dvec3(0.0, 0.0, 3.0), 0.5, 0.5),
            straight(DVec3::ZERO, dvec3(3.0, 0.0, 1.0), 0.5, 0.5),
        ],
        Vec::new(),
    );
    rooted.stems[1].kind = StemKind::Root;
    let frame = frame(8, 4);
    let ink = |parts: Parts| {
        let mut bitmap = Bitmap::default();
        Rasterizer::new().draw(&rooted, &View::FRONT, &frame, parts, &mut bitmap);
        bitmap.ink()
    };
    assert_eq!(ink(Parts::LEAFY), ink(Parts::BARE));
    assert!(ink(Parts::ALL) > ink(Parts::LEAFY) && ink(Parts::ROOTS) > 2);
    let reach = |parts| Bounds::new(&rooted, parts).unwrap().max.x;
    assert!(reach(Parts::LEAFY) < 0.6 && reach(Parts::ALL) > 3.0);
}

/// What is not drawn because it lies on what is black already would not have been seen.
#[test]
fn black_pixels_that_are_marked_change_no_picture() {
    for name in ["quaking_aspen", "weeping_willow", "balsam_fir", "apple", "hill_cherry"] {
        let tree = pleach_generators::preset(name).unwrap().grow(1).unwrap();
        for (size, detail) in [(256, Detail::Half), (100, Detail::Draft), (77, Detail::Full)] {
            let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, size, size);
            // Larger than the picture as well, so that leaves lie across its edges.
            for frame in [frame, Frame { meters_per_pixel: 0.4 * frame.meters_per_pixel, ..frame }] {
                let [mut plain, mut marked] = [Bitmap::default(), Bitmap::default()];
                Rasterizer::with_detail(detail).draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut plain);
                let mut marking = Rasterizer::with_detail(detail);
                marking.saturates = true;
                marking.draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut marked);
                assert_eq!(marked.differing(&plain), 0, "{name} at {size}, {detail:?}");
            }
        }
    }
}

/// Nor would pieces of stems that are not drawn for the same reason.
#[test]
fn hidden_pieces_of_stems_change_no_picture() {
    for (name, thicker) in [("quaking_aspen", 4.0), ("weeping_willow", 3.0), ("black_oak", 6.0)] {
        let mut tree = pleach_generators::preset(name).unwrap().grow(1).unwrap();
        tree.knots.iter_mut().for_each(|knot| knot.radius *= thicker);
        let whole = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
        // Larger than the picture as well, so that stems lie across its edges.
        for frame in [whole, Frame { meters_per_pixel: 0.4 * whole.meters_per_pixel, ..whole }] {
            for (view, parts) in [(View::FRONT, Parts::BARE), (View::degrees(40.0, 30.0), Parts::LEAFY)] {
                let [mut plain, mut marked] = [Bitmap::default(), Bitmap::default()];
                let mut marking = Rasterizer::for_searches(Detail::Half);
                marking.draw(&tree, &view, &frame, parts, &mut marked);
                marking.saturates = false;
                marking.draw(&tree, &view, &frame, parts, &mut plain);
                assert_eq!(marked.differing(&plain), 0, "{name}, {parts:?}");
                assert!(plain.ink() > 5000, "{name}: too little is black for anything to be hidden");
            }
        }
    }
}

/// Stems evaluated in the plane are those in space, but for pixels that are half covered to rounding.
#[test]
fn flattened_stems_are_where_others_are() {
    for name in pleach_generators::HEWITT_2017 {
        let tree = pleach_generators::preset(name).unwrap().grow(1).unwrap();
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, 256, 256);
        for view in [View::FRONT, View::degrees(40.0, 30.0)] {
            let [mut plain, mut flat] = [Bitmap::default(), Bitmap::default()];
            Rasterizer::with_detail(Detail::Half).draw(&tree, &view, &frame, Parts::BARE, &mut plain);
            Rasterizer::for_searches(Detail::Half).draw(&tree, &view, &frame, Parts::BARE, &mut flat);
            let share = f64::from(flat.differing(&plain) as u32) / f64::from(plain.ink() as u32);
            assert!(share < 0.02, "{name}: {share} of the ink");
        }
    }
}
