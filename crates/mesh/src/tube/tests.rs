//! Every tube is closed and right side out, whatever the spline does.

use super::*;
use glam::{DVec3, dvec3};
use pleach_plant::{Knot, Stem, StemKind, Tree};
use proptest::prelude::*;
use std::collections::HashMap;

/// A tree of one stem with these knots.
fn tree_of(knots: Vec<Knot>) -> Tree {
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

/// Knots that turn sharply, stand still, swell and shrink: worse than any generator's.
fn wild_knots() -> impl Strategy<Value = Vec<Knot>> {
    let step = (-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64);
    let radius = prop_oneof![Just(0.0), 0.0..0.01_f64, 0.0..2.0_f64];
    let knot = (step.clone(), step, prop_oneof![Just(0.0), 0.0..1.5_f64], radius);
    prop::collection::vec(knot, 2..8).prop_map(|steps| {
        let mut point = dvec3(3.0, -2.0, 5.0);
        let mut knots = Vec::new();
        for ((x, y, z), (hx, hy, hz), reach, radius) in steps {
            let handle = dvec3(hx, hy, hz) * reach * 0.5;
            knots.push(Knot { point, handle_in: point - handle, handle_out: point + handle, radius });
            point += dvec3(x, y, z);
        }
        knots
    })
}

fn tube(knots: Vec<Knot>, tolerance: f64) -> (Rings, Count, Block) {
    let tree = tree_of(knots);
    let tubes = Tubes::new(MeshSettings::with_tolerance(tolerance).clamped());
    let (mut rings, mut block) = (Rings::default(), Block::default());
    rings.sample(&tree, &tree.stems[0], tolerance);
    let count = tubes.count(&rings);
    tubes.push(&rings, 0, 0.0, &mut block, &mut Vec::new());
    (rings, count, block)
}

/// The first broken promise of a closed tube.
fn broken(block: &Block) -> Result<(), String> {
    let corner = |i: u32| block.vertices[i as usize].position.as_dvec3();
    let key = |i: u32| block.vertices[i as usize].position.to_array().map(f32::to_bits);
    let mut edges: HashMap<_, i32> = HashMap::new();
    let mut volume = 0.0;
    let origin = corner(0);
    for (k, t) in block.triangles.iter().enumerate() {
        let [a, b, c] = t.map(corner);
        let area = (b - a).cross(c - a);
        if area.length() <= 0.0 {
            return Err(format!("triangle {k} is degenerate: {a} {b} {c}"));
        }
        volume += (a - origin).dot((b - origin).cross(c - origin));
        for (p, q) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            *edges.entry((key(p), key(q))).or_default() += 1;
            *edges.entry((key(q), key(p))).or_default() -= 1;
        }
    }
    if edges.values().any(|&n| n != 0) {
        return Err("an edge has no partner".to_owned());
    }
    // Threads thinner than the tolerance that leave their base sideways are slivers of no volume.
    if volume <= -1e-5 {
        return Err(format!("the tube is inside out: volume {volume}"));
    }
    for v in &block.vertices {
        if v.to_array().iter().any(|x| !x.is_finite()) || (v.normal.length() - 1.0).abs() > 1e-4 {
            return Err(format!("a corner is not finite or its normal not of length 1: {v:?}"));
        }
        if v.uv.x < 0.0 || v.uv.y > 0.0 {
            return Err(format!("texture coordinates out of range: {v:?}"));
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, ..ProptestConfig::default() })]

    #[test]
    fn wild_stems_make_closed_tubes(knots in wild_knots(), tolerance in 0.001..0.05_f64) {
        let (rings, count, block) = tube(knots, tolerance);
        prop_assert_eq!(count.vertices, block.vertices.len() as u64);
        prop_assert_eq!(count.triangles, block.triangles.len() as u64);
        for (tube, run) in tubes(&block, &rings) {
            broken(&tube).map_err(TestCaseError::fail)?;
            for pair in run.rings.windows(2) {
                prop_assert!((pair[1].center - pair[0].center).dot(pair[0].tangent) > 0.0);
                prop_assert!((pair[1].center - pair[0].center).dot(pair[1].tangent) > 0.0);
                prop_assert!(pair[0].side.dot(pair[0].tangent).abs() < 1e-9);
            }
            faces_outwards(&tube, run.rings).map_err(TestCaseError::fail)?;
        }
    }
}

/// No face between two rings is inside out: the corners of each ring lie ahead of the plane of the
/// one before and behind the plane of the one after.
fn faces_outwards(block: &Block, rings: &[Ring]) -> Result<(), String> {
    let corner = |i: u32| block.vertices[i as usize].position.as_dvec3();
    let apex = block.vertices.len() as u32 - 1;
    let sides = block.triangles.iter().filter(|t| t.contains(&apex)).count() as u32;
    for (k, t) in block.triangles.iter().enumerate().skip(sides as usize - 2) {
        let ring = |i: u32| &rings[((i / (sides + 1)) as usize).min(rings.len() - 1)];
        let lowest = ring(t.iter().copied().min().unwrap_or(0));
        let highest = ring(t.iter().copied().max().unwrap_or(0));
        for edge in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            let (from, to) = (edge.0.min(edge.1), edge.0.max(edge.1));
            if from / (sides + 1) == to / (sides + 1) {
                continue;
            }
            let along = corner(to) - corner(from);
            if along.dot(lowest.tangent) <= 0.0 || along.dot(highest.tangent) <= 0.0 {
                return Err(format!("face {k} looks inwards"));
            }
        }
    }
    Ok(())
}

/// The closed surfaces of a stem with their rings; the last vertex of each is the one that closes it.
fn tubes<'a>(block: &Block, rings: &'a Rings) -> Vec<(Block, Run<'a>)> {
    let mut apexes = Vec::new();
    let mut end = 0;
    for t in &block.triangles {
        // Each tube's triangles begin with its base, whose vertices follow the tube before.
        if t[0] > end {
            apexes.push(end);
        }
        end = end.max(t[0]).max(t[1]).max(t[2]);
    }
    if !block.triangles.is_empty() {
        apexes.push(end);
    }
    let mut first = 0;
    let part = |end: u32| {
        let own = first..=end;
        let triangles = block.triangles.iter().filter(|t| own.contains(&t[0]));
        let tube = Block {
            vertices: block.vertices[first as usize..=end as usize].to_vec(),
            triangles: triangles.map(|t| t.map(|i| i - first)).collect(),
            ..Block::default()
        };
        first = end + 1;
        tube
    };
    let parts: Vec<Block> = apexes.into_iter().map(part).collect();
    assert_eq!(parts.len(), rings.runs().count());
    parts.into_iter().zip(rings.runs()).collect()
}

fn straight(radii: &[f64]) -> Vec<Knot> {
    let knot = |(i, &radius): (usize, &f64)| {
        let point = dvec3(0.0, 0.0, i as f64);
        Knot {
            point,
            handle_in: point - dvec3(0.0, 0.0, 1.0 / 3.0),
            handle_out: point + dvec3(0.0, 0.0, 1.0 / 3.0),
            radius,
        }
    };
    radii.iter().enumerate().map(knot).collect()
}

#[test]
fn a_cone_has_the_volume_of_a_cone() {
    let (_, _, block) = tube(straight(&[0.5, 0.25, 0.0]), 1e-4);
    let corner = |i: u32| block.vertices[i as usize].position.as_dvec3();
    let volume: f64 =
        block.triangles.iter().map(|t| t.map(corner)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
    let cone = PI * 0.25 * 2.0 / 3.0;
    assert!((volume / cone - 1.0).abs() < 0.01, "{volume} is not {cone}");
    broken(&block).unwrap();
}

#[test]
fn normals_of_a_cone_lean_by_its_taper() {
    let (_, _, block) = tube(straight(&[1.0, 0.5, 0.0]), 1e-3);
    let lean = 0.5_f64.atan();
    for v in block.vertices.iter().filter(|v| (v.position.z - 1.0).abs() < 1e-6) {
        assert!((f64::from(v.normal.z) - lean.sin()).abs() < 1e-3, "{v:?}");
    }
}

/// How much wider than high a picture is drawn on a triangle.
fn stretch(corners: &[Vertex; 3]) -> f64 {
    let [a, b, c] = corners;
    let (p, q) = (b.position - a.position, c.position - a.position);
    let (s, t) = (b.uv - a.uv, c.uv - a.uv);
    let area = s.perp_dot(t);
    let across = (p * t.y - q * s.y) / area;
    let along = (q * s.x - p * t.x) / area;
    f64::from(across.length() / along.length())
}

#[test]
fn a_whole_number_of_upright_tiles_goes_around() {
    for (radius, tiles) in [(0.01, 1.0), (0.1, 1.0), (0.13, 2.0), (0.4, 5.0)] {
        let (_, _, block) = tube(straight(&[radius; 3]), 1e-3);
        let at_foot = block.vertices.iter().filter(|v| v.position.z == 0.0);
        let around: Vec<f32> = at_foot.map(|v| v.uv.x).collect();
        assert_eq!((around[0], around[around.len() - 1]), (0.0, tiles), "{radius}");
        // As wide as high.
        let side = std::f64::consts::TAU * radius / f64::from(tiles);
        for v in block.vertices.iter().filter(|v| v.position.z <= 2.0) {
            let wanted = -f64::from(v.position.z) / side;
            assert!((f64::from(v.uv.y) - wanted).abs() < 1e-3 * wanted.abs().max(1.0), "{v:?}");
        }
    }
}

#[test]
fn tiles_keep_their_form_on_a_cone() {
    let (_, _, block) =
        tube(straight(&[0.2, 0.18, 0.16, 0.14, 0.12, 0.1, 0.08, 0.06, 0.04, 0.02, 0.0]), 1e-3);
    let (mut good, mut all) = (0.0, 0.0);
    for t in &block.triangles {
        let [a, b, c] = t.map(|i| block.vertices[i as usize]);
        let area = f64::from((b.position - a.position).cross(c.position - a.position).length());
        let stretch = stretch(&[a, b, c]);
        // Its base is a flat cap inside the parent.
        if t.iter().any(|&i| block.vertices[i as usize].position.z > 0.0) {
            all += area;
            good += if (0.5..2.0).contains(&stretch) { area } else { 0.0 };
        }
    }
    assert!(good > 0.97 * all, "{good} of {all}");
}

#[test]
fn a_blunt_tip_gets_a_dome_and_a_thin_one_a_point() {
    let top = |radii: &[f64]| {
        let (rings, _, block) = tube(straight(radii), 1e-3);
        (
            rings.runs().last().is_some_and(|run| run.end == End::Point),
            block.vertices.iter().map(|v| v.position.z).fold(0.0, f32::max),
        )
    };
    assert_eq!(top(&[0.1, 0.05, 0.0]), (true, 2.0));
    let (pointed, height) = top(&[0.1, 0.1, 0.1]);
    assert!(!pointed && (height - 2.05).abs() < 1e-6, "{height}");
}

#[test]
fn stems_too_short_to_draw_are_left_out() {
    let mut knots = straight(&[0.1, 0.1]);
    for knot in &mut knots {
        (knot.point, knot.handle_in, knot.handle_out) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
    }
    let (rings, count, block) = tube(knots, 1e-3);
    assert!(rings.runs().next().is_none() && count == Count::default() && block == Block::default());
}

/// A stem that turns through three quarters of a circle keeps all its rings.
#[test]
fn a_stem_that_turns_back_follows_its_spline() {
    let knots = (0..=12).map(|i| {
        let angle = f64::from(i) * PI / 8.0;
        let (sin, cos) = angle.sin_cos();
        let (point, along) = (dvec3(cos, 0.0, sin), dvec3(-sin, 0.0, cos) * (PI / 24.0));
        Knot { point, handle_in: point - along, handle_out: point + along, radius: 0.01 }
    });
    let (rings, ..) = tube(knots.collect(), 1e-3);
    let runs: Vec<Run<'_>> = rings.runs().collect();
    let [Run { rings, .. }] = runs[..] else { panic!("it is one tube") };
    let length = rings.last().unwrap().along;
    assert!(rings.len() > 20 && (length - 1.5 * PI).abs() < 0.02, "{length}");
    for ring in rings {
        assert!((ring.center.length() - 1.0).abs() < 1e-3);
    }
}
