//! No part of a stem is lost in its mesh, however sharply it turns.

use glam::{DVec3, dvec3};
use pleach_mesh::{Block, Material, Mesh, MeshSettings, Mesher, Source as _};
use pleach_tree::conformance::list_within;
use pleach_tree::{Foliage, Growth, Knot, Limits, Parts, Species, Stem, StemKind, Tree};

/// A stem of one thickness through `points`, straight between them.
fn polyline(points: &[DVec3], radius: f64) -> Tree {
    let toward = |from: DVec3, to: DVec3| from + (to - from) / 3.0;
    let knot = |i: usize| {
        let here = points[i];
        let before = if i > 0 { points[i - 1] } else { here };
        let after = points.get(i + 1).copied().unwrap_or(here);
        Knot { point: here, handle_in: toward(here, before), handle_out: toward(here, after), radius }
    };
    let stem = Stem {
        parent: None,
        level: 0,
        kind: StemKind::Trunk,
        number: 0,
        offset: 0.0,
        first_knot: 0,
        knot_count: points.len() as u32,
    };
    Tree { stems: vec![stem], knots: (0..points.len()).map(knot).collect(), ..Tree::default() }
}

/// Metres from `p` to a triangle.
fn distance(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let to_edge = |a: DVec3, b: DVec3| {
        let t = (p - a).dot(b - a) / (b - a).length_squared();
        p.distance(a + (b - a) * t.clamp(0.0, 1.0))
    };
    let normal = (b - a).cross(c - a).normalize();
    let is_left = |a: DVec3, b: DVec3| (b - a).cross(p - a).dot(normal) >= 0.0;
    if is_left(a, b) && is_left(b, c) && is_left(c, a) {
        return (p - a).dot(normal).abs();
    }
    to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a))
}

/// How far the worst knot of `tree` is outside of radius and tolerance of the mesh of its own stem, in
/// metres; no more than 0 if all is well. Stems too short to be drawn have no mesh.
fn worst(tree: &Tree, settings: MeshSettings) -> f64 {
    let mesher = Mesher::new(tree, settings);
    let mut bark = Block::default();
    for range in mesher.ranges(Material::Bark) {
        mesher.fill(Material::Bark, range, &mut bark);
    }
    let mut triangles = bark.triangles.iter().peekable();
    let mut worst = f64::NEG_INFINITY;
    for (i, stem) in tree.stems.iter().enumerate() {
        let end = if i + 1 < tree.stems.len() { mesher.first_vertex(i + 1) } else { u64::MAX };
        let mut own = Vec::new();
        while let Some(t) = triangles.next_if(|t| u64::from(t[0]) < end) {
            own.push(t.map(|c| bark.vertices[c as usize].position.as_dvec3()));
        }
        if !settings.parts.has_stem(stem.kind) || (own.is_empty() && tree.length_of(stem) < 2e-4) {
            continue;
        }
        let collar = collar(tree, stem);
        let base = tree.knots_of(stem)[0].point;
        for knot in tree.knots_of(stem) {
            let swell = if knot.point.distance(base) < collar { 1.6 } else { 1.0 };
            let reach = swell * knot.radius.max(2e-4) + settings.tolerance;
            // Far triangles are not looked at closely.
            let mut nearest = f64::INFINITY;
            for t in &own {
                let size = t[0].distance(t[1]).max(t[0].distance(t[2]));
                if knot.point.distance(t[0]) - size < nearest {
                    nearest = nearest.min(distance(knot.point, *t));
                }
            }
            worst = worst.max(nearest - reach);
        }
    }
    worst
}

/// How far from its base a stem may be wider than it is, where it leaves the side of its parent, in metres.
fn collar(tree: &Tree, stem: &Stem) -> f64 {
    let Some(parent) = stem.parent.filter(|_| stem.kind == StemKind::Branch) else { return 0.0 };
    let radius = |stem: &Stem| tree.knots_of(stem).iter().map(|knot| knot.radius).fold(0.0, f64::max);
    let beyond = radius(&tree.stems[parent as usize]) / 0.35 + 2.0 * radius(stem);
    beyond.min(tree.length_of(stem) / 2.0)
}

fn settings() -> MeshSettings {
    MeshSettings { parts: Parts::LEAFY | Parts::ROOTS, ..MeshSettings::default() }
}

#[test]
fn every_knot_of_every_species_is_in_its_mesh() {
    let mut lost = Vec::new();
    for name in pleach_generators::names() {
        let species = pleach_generators::preset(name).unwrap();
        for seed in 1..3 {
            let tree = species.grow_bare(seed).unwrap();
            let worst = worst(&tree, settings());
            if worst > 0.0 {
                lost.push(format!("{name} of seed {seed}: {worst:.4} m"));
            }
            if tree.stems.len() > 10_000 {
                break;
            }
        }
    }
    assert!(lost.is_empty(), "{}", lost.join("\n"));
}

#[test]
fn every_knot_is_in_coarser_meshes() {
    for name in ["abop_hilbert_space", "abop_dragon", "palm", "leafy_willow", "acer"] {
        let tree = pleach_generators::preset(name).unwrap().grow_bare(1).unwrap();
        for tolerance in [0.0002, 0.02, 0.2] {
            let worst = worst(&tree, MeshSettings { tolerance, ..settings() });
            assert!(worst <= 0.0, "{name} at {tolerance}: {worst} m");
        }
    }
}

/// Trees that a search meets: any numbers within its ranges, which bend stems more than known species do.
#[test]
fn every_knot_of_random_trees_is_in_its_mesh() {
    let species = pleach_generators::preset("quaking_aspen").unwrap();
    let space = species.generator.space();
    let limits = Limits { stems: 5_000, knots: 40_000, ..Limits::default() };
    let growth = Growth { foliage: Foliage::None, limits, ..Growth::seed(1) };
    // Every fifth list is of the search's ranges; some are larger than the limits. Numbers that a search leaves alone
    // unless it is asked for them are left alone here too. Known gap: with any lean and outline as well, a waist of the
    // thick stem of list 375 is drawn 3 mm too wide.
    let trees = (0..600).step_by(5).filter_map(|case| {
        let mut values = list_within(space, case);
        for slot in space.slots().filter(|slot| space.param_of(*slot).opt_in) {
            values[slot.index()] = space.default_of(slot);
        }
        let params = space.check(values).unwrap();
        Some((case, Species { params, ..species.clone() }.grow_with(&growth).ok()?))
    });
    let mut count = 0;
    for (case, tree) in trees.take(25) {
        let worst = worst(&tree, settings());
        assert!(worst <= 0.0, "list {case}: {worst} m");
        count += 1;
    }
    assert_eq!(count, 25, "{count} trees grew");
}

/// What a first guess makes of known species: trunks that lean and come back, crowns of another outline.
#[test]
fn every_knot_of_trees_that_stand_otherwise_is_in_its_mesh() {
    for name in ["acer", "silver_birch", "black_tupelo"] {
        let species = pleach_generators::preset(name).unwrap();
        let space = species.generator.space();
        let mut values = species.params.values().to_vec();
        for (name, value) in [("lean", 30.0), ("bow", -40.0), ("side", 0.6), ("outline[1]", 0.4)] {
            let slot = space.select(name).unwrap()[0];
            values[slot.index()] = value;
        }
        let params = space.check(values).unwrap();
        let tree = Species { params, ..species.clone() }.grow_bare(1).unwrap();
        let worst = worst(&tree, settings());
        assert!(worst <= 0.0, "{name}: {worst} m");
    }
}

/// Twigs that a strong pull bends within their own width.
#[test]
fn every_knot_of_a_tree_that_is_pulled_down_is_in_its_mesh() {
    let text = pleach_generators::preset("quaking_aspen").unwrap().to_toml(&[]);
    let line = |line: &str| match line.strip_prefix("tropism = ") {
        Some(_) => "tropism = [0, 0, -20]\n".to_owned(),
        None => format!("{line}\n"),
    };
    let text: String = text.lines().map(line).collect();
    let tree = pleach_generators::read_text("pulled.toml", &text).unwrap().grow_bare(1).unwrap();
    assert!(tree.stems.len() > 500 && text.contains("-20]"));
    let worst = worst(&tree, settings());
    assert!(worst <= 0.0, "{worst} m");
}

/// Any turn, in thin and thick stems, between long and short pieces.
#[test]
fn a_stem_is_there_after_any_turn() {
    for degrees in [30.0, 44.0, 46.0, 60.0, 90.0, 120.0, 150.0, 179.0, 180.0_f64] {
        for radius in [0.005, 0.1, 0.7] {
            for length in [1.0, 0.05] {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let turned = dvec3(sin, 0.0, cos);
                let points = [DVec3::ZERO, DVec3::Z, DVec3::Z + turned * length];
                let tree = polyline(&points, radius);
                let worst = worst(&tree, settings());
                assert!(worst <= 0.0, "{degrees} degrees, {radius} m thick, {length} m long: {worst} m");
            }
        }
    }
}

#[test]
fn curves_that_close_have_all_their_sides() {
    let square = [DVec3::ZERO, DVec3::X, dvec3(1.0, 0.0, 1.0), DVec3::Z, DVec3::ZERO];
    let bow = [DVec3::ZERO, dvec3(1.0, 0.0, 1.0), DVec3::X, DVec3::Z, DVec3::ZERO];
    for points in [&square[..], &bow[..], &square[..4]] {
        for radius in [0.01, 0.1] {
            assert!(worst(&polyline(points, radius), settings()) <= 0.0, "{points:?}");
        }
    }
}

/// A bend tighter than the stem is thick, smooth at every knot.
#[test]
fn a_bend_within_the_stems_width_does_not_end_it() {
    for bend in [0.01, 0.05, 0.1, 0.2] {
        let mut points = vec![DVec3::Z * -1.0];
        points.extend((0..=12).map(|i| {
            let (sin, cos) = (f64::from(i) * std::f64::consts::PI / 12.0).sin_cos();
            dvec3(bend * (1.0 - cos), 0.0, bend * sin)
        }));
        points.push(dvec3(2.0 * bend, 0.0, -1.0));
        let worst = worst(&polyline(&points, 0.1), settings());
        assert!(worst <= 0.0, "a bend of {bend} m: {worst} m");
    }
}

/// The volume of what the tubes cover is at least that of the straight pieces; inside out they would be less.
#[test]
fn tubes_around_a_corner_face_outwards_and_are_closed() {
    for degrees in [60.0, 90.0, 120.0, 179.0, 180.0_f64] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let tree = polyline(&[DVec3::ZERO, DVec3::Z, DVec3::Z + dvec3(sin, 0.0, cos)], 0.1);
        let mesh = Mesh::new(&tree, settings());
        let bark = mesh.part(Material::Bark).unwrap();
        let corner = |i: u32| bark.vertices[i as usize].position.as_dvec3();
        let volume: f64 =
            bark.triangles.iter().map(|t| t.map(corner)).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum();
        // Two pieces of 1 m, half a ball at the corner, a dome half as high at the tip.
        let round = std::f64::consts::PI * 0.01;
        let wanted = 2.0 * round + round * 0.1 * (2.0 / 3.0 + 1.0 / 3.0);
        assert!((volume / wanted - 1.0).abs() < 0.05, "{degrees}: {volume} {wanted}");
        for v in &bark.vertices {
            assert!((v.normal.length() - 1.0).abs() < 1e-4, "{v:?}");
        }
    }
}
