//! Welded trees are closed, whatever is welded.

mod random;
mod skin;
mod sound;

use super::*;
use proptest::prelude::*;
use sound::{check_apart, check_closed, check_outwards, check_sound, pieces, volume};

#[test]
fn an_acer_is_one_closed_piece_with_normals_outwards() {
    let tree = pleach_generators::preset("acer").unwrap().grow_bare(1).unwrap();
    let block = surface(&tree, &WeldSettings::new(0.02)).unwrap();
    check_sound(&block, 0.02);
    assert!(block.triangles.len() > 10_000);
    assert_eq!(pieces(&block), 1);
    for v in &block.vertices {
        assert!(v.position.is_finite() && (v.normal.length() - 1.0).abs() < 1e-4);
    }
    assert_eq!(block, surface(&tree, &WeldSettings::new(0.02)).unwrap());
}

#[test]
fn threads_do_not_matter() {
    let tree = pleach_generators::preset("stylised_oak").unwrap().grow_bare(1).unwrap();
    let settings = WeldSettings { fillet: 1.0, parts: Parts::ALL, ..WeldSettings::new(0.1) };
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| surface(&tree, &settings).unwrap())
    });
    assert_eq!(one, three);
}

#[test]
fn a_palm_keeps_the_volume_of_its_trunk() {
    let mut tree = pleach_generators::preset("palm").unwrap().grow_bare(1).unwrap();
    tree.stems.truncate(1);
    let wanted: f64 = {
        let mut path = Path::default();
        path.trace(&tree, &tree.stems[0], 0.001);
        let slice = |i: usize| {
            let (a, b) = (&path.rings[i], &path.rings[i + 1]);
            let (r, s) = (a.radius, b.radius);
            a.center.distance(b.center) * std::f64::consts::PI * (r * r + r * s + s * s) / 3.0
        };
        (0..path.rings.len() - 1).map(slice).sum()
    };
    let found = volume(&surface(&tree, &WeldSettings::new(0.02)).unwrap());
    assert!((found / wanted - 1.0).abs() < 0.02, "{found} {wanted}");
}

#[test]
fn cells_that_make_no_sense_are_refused() {
    let tree = pleach_generators::preset("acer").unwrap().grow_bare(1).unwrap();
    assert!(matches!(surface(&tree, &WeldSettings::new(0.0)), Err(WeldError::NotPositive { .. })));
    assert!(matches!(surface(&tree, &WeldSettings::new(f64::NAN)), Err(WeldError::NotPositive { .. })));
    assert!(matches!(surface(&tree, &WeldSettings::new(1e-9)), Err(WeldError::TooFine { .. })));
    assert_eq!(surface(&Tree::default(), &WeldSettings::new(0.01)).unwrap(), Block::default());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]
    #[test]
    fn every_edge_has_two_faces(seed in 0_u64..1000, species in 0_usize..4, cell in 0.02_f64..0.2) {
        let name = ["acer", "palm", "hill_cherry", "lombardy_poplar"][species];
        let tree = pleach_generators::preset(name).unwrap().grow_bare(seed).unwrap();
        let block = surface(&tree, &WeldSettings::new(cell)).unwrap();
        check_sound(&block, cell);
        prop_assert_eq!(pieces(&block), 1);
    }
}

/// A cross: a stem up and one aside from its middle.
fn cross() -> Tree {
    let stem = |parent: Option<u32>, first_knot: u32| pleach_plant::Stem {
        parent,
        level: parent.map_or(0, |p| p as u16 + 1),
        kind: if parent.is_some() { StemKind::Branch } else { StemKind::Trunk },
        number: 0,
        offset: parent.map_or(0.0, |_| 1.0),
        first_knot,
        knot_count: 2,
    };
    let knot = |x: f64, z: f64, along: glam::DVec3| {
        let point = glam::dvec3(x, 0.0, z);
        pleach_plant::Knot { point, handle_in: point - along, handle_out: point + along, radius: 0.2 }
    };
    let (up, aside) = (glam::DVec3::Z * 0.6, glam::DVec3::X * 0.3);
    Tree {
        stems: vec![stem(None, 0), stem(Some(0), 2)],
        knots: vec![knot(0.0, 0.0, up), knot(0.0, 2.0, up), knot(0.0, 1.0, aside), knot(1.0, 1.0, aside)],
        ..Tree::default()
    }
}

#[test]
fn a_fillet_fills_the_corner_and_nothing_else() {
    let tree = cross();
    let welded = |fillet: f64| surface(&tree, &WeldSettings { fillet, ..WeldSettings::new(0.03) }).unwrap();
    let [plain, filled] = [0.0, 2.0].map(welded);
    check_closed(&filled);
    let more = volume(&filled) - volume(&plain);
    assert!(more > 0.002 && more < 0.1 * volume(&plain), "{more}");
    // Away from the joint, here by the reach and more, both are the same.
    let away = |block: &Block| -> Vec<Vec3> {
        let all = block.vertices.iter().map(|v| v.position);
        all.filter(|p| p.distance(glam::vec3(0.0, 0.0, 1.0)) > 1.7).collect()
    };
    assert_eq!(away(&plain), away(&filled));
    let corner = |block: &Block| {
        let all = block.vertices.iter().map(|v| v.position);
        all.map(|p| p.distance(glam::vec3(0.25, 0.0, 1.25))).fold(f32::INFINITY, f32::min)
    };
    assert!(corner(&filled) < corner(&plain) - 0.01, "{} {}", corner(&filled), corner(&plain));
}

#[test]
fn a_trunk_without_a_height_is_a_ball_that_holds_its_branches() {
    let mut tree = cross();
    let point = glam::dvec3(0.0, 0.0, 1.3);
    tree.knots[..2].fill(pleach_plant::Knot { point, handle_in: point, handle_out: point, radius: 0.5 });
    let block = surface(&tree, &WeldSettings::new(0.05)).unwrap();
    check_sound(&block, 0.05);
    assert_eq!(pieces(&block), 1);
    let top = block.vertices.iter().map(|v| v.position.z).fold(0.0, f32::max);
    assert!((top - 1.8).abs() < 0.02, "{top}");
}

#[test]
#[should_panic = "two faces meet"]
fn faces_that_meet_are_found() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let through = [[0.2, 0.2, -1.0], [0.3, 0.2, 1.0], [0.2, 0.3, 1.0]];
    let vertex = |p: [f32; 3]| Vertex { position: p.into(), normal: Vec3::Z, uv: vec2(0.0, 0.0) };
    let vertices = corners.into_iter().chain(through).map(vertex).collect();
    check_apart(&Block { vertices, triangles: vec![[0, 1, 2], [3, 4, 5]], ..Block::default() });
}

#[test]
#[should_panic = "a face is turned"]
fn turned_faces_are_found() {
    let settings = WeldSettings::new(0.1);
    let mut block = surface(&cross(), &settings).unwrap();
    block.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    let shape = Shape::new(&cross(), &settings, &[true; 9]).unwrap();
    check_outwards(&block, &shape.stems, settings.cell);
}

#[test]
fn roots_are_welded_where_they_are_asked_for() {
    let tree = pleach_generators::preset("stylised_oak").unwrap().grow_bare(1).unwrap();
    let width = |parts: Parts| {
        let block = surface(&tree, &WeldSettings { parts, ..WeldSettings::new(0.05) }).unwrap();
        check_closed(&block);
        block.vertices.iter().filter(|v| v.position.z < 0.2).map(|v| v.position.x.abs()).fold(0.0, f32::max)
    };
    assert!(width(Parts::ALL) > 1.5 * width(Parts::LEAFY));
}
