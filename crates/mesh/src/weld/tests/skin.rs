//! Pictures of bark on welded stems, and welded stems of a level of detail.

use super::*;
use crate::block::Wind;
use crate::settings::MeshSettings;
use crate::stream::send;
use crate::wind::{Breeze, moved};
use crate::{Material, Mesh, Welded, lod};
use std::collections::BTreeMap;

/// How much wider than high a picture is drawn on a triangle, and its area.
fn stretch(corners: [Vertex; 3]) -> (f32, f32) {
    let [a, b, c] = corners;
    let (p, q) = (b.position - a.position, c.position - a.position);
    let (s, t) = (b.uv - a.uv, c.uv - a.uv);
    let area = s.perp_dot(t);
    let (across, along) = ((p * t.y - q * s.y) / area, (q * s.x - p * t.x) / area);
    (across.length() / along.length(), p.cross(q).length())
}

/// The part of the surface on which pictures are drawn at most twice as wide as high, and at most twice as high as wide,
/// and that on which they are not mirrored.
fn well_drawn(block: &Block) -> (f32, f32) {
    let (mut good, mut upright, mut all) = (0.0, 0.0, 0.0);
    for triangle in &block.triangles {
        let corners = triangle.map(|i| block.vertices[i as usize]);
        let (stretch, area) = stretch(corners);
        let [a, b, c] = corners.map(|corner| corner.uv);
        all += area;
        good += if (0.5..=2.0).contains(&stretch) { area } else { 0.0 };
        // v grows downwards.
        upright += if (b - a).perp_dot(c - a) < 0.0 { area } else { 0.0 };
    }
    (good / all, upright / all)
}

/// The same surface with one corner in each place.
fn sewn(block: &Block) -> Block {
    let mut numbers = BTreeMap::new();
    let mut sewn = Block::default();
    for triangle in &block.triangles {
        sewn.triangles.push(triangle.map(|corner| {
            let vertex = block.vertices[corner as usize];
            *numbers.entry(vertex.position.to_array().map(f32::to_bits)).or_insert_with(|| {
                sewn.vertices.push(vertex);
                sewn.vertices.len() as u32 - 1
            })
        }));
    }
    sewn
}

#[test]
fn pictures_of_bark_are_not_stretched_and_the_surface_stays_where_it_is() {
    // Crooked stems that are nearly as thick as they are long have more that is no tube.
    for (name, cell, least) in [("acer", 0.03, 0.95), ("stylised_oak", 0.05, 0.85)] {
        let tree = pleach_generators::preset(name).unwrap().grow_bare(1).unwrap();
        let settings = WeldSettings { fillet: 1.0, ..WeldSettings::new(cell) };
        let whole = surface(&tree, &settings).unwrap();
        let cut = Skin::whole(&tree, &settings, true).unwrap().bark;
        assert_eq!(cut.triangles.len(), whole.triangles.len());
        assert!(cut.vertices.len() < whole.vertices.len() * 5 / 4, "{name}: {}", cut.vertices.len());
        let at = |block: &Block, corner: u32| {
            let Vertex { position, normal, .. } = block.vertices[corner as usize];
            (position, normal)
        };
        for (a, b) in whole.triangles.iter().zip(&cut.triangles) {
            assert_eq!(a.map(|corner| at(&whole, corner)), b.map(|corner| at(&cut, corner)));
        }
        let (good, upright) = well_drawn(&cut);
        assert!(good > least && upright > 0.95, "{name}: {good} {upright}");
        assert!(cut.vertices.iter().all(|vertex| vertex.uv.is_finite()));
    }
}

#[test]
fn a_trunk_has_the_tiles_of_its_tube() {
    let mut tree = pleach_generators::preset("palm").unwrap().grow_bare(1).unwrap();
    tree.stems.truncate(1);
    let tube = Mesh::new(&tree, MeshSettings::default());
    let tube = tube.part(Material::Bark).unwrap();
    let skin = Skin::whole(&tree, &WeldSettings::new(0.02), true).unwrap().bark;
    let extent = |block: &Block, axis: usize| {
        // Nothing goes around at the very tip.
        let all =
            block.vertices.iter().filter(|vertex| vertex.position.z < 4.0).map(|vertex| vertex.uv[axis]);
        all.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
    };
    let (u, v) = (extent(&skin, 0), extent(&skin, 1));
    let (around, along) = (extent(tube, 0), extent(tube, 1));
    assert!((u.1 - u.0 - around.1).abs() < 0.6, "{u:?} {around:?}");
    assert!((v.0 / along.0 - 1.0).abs() < 0.1, "{v:?} {along:?}");
}

#[test]
fn levels_with_welded_stems_keep_to_their_budgets() {
    for name in ["acer", "stylised_oak"] {
        let tree = pleach_generators::preset(name).unwrap().grow(1).unwrap();
        let budgets = [30_000, 8_000, 2_000];
        let levels = lod::budgets(&[&tree], MeshSettings::default(), &budgets).unwrap().remove(0);
        for (level, budget) in levels.iter().zip(budgets) {
            let settings = WeldSettings { fillet: 1.0, ..WeldSettings::new(0.02) };
            let skin = Skin::of_level(level, &settings, true).unwrap();
            assert_eq!(skin, Skin::of_level(level, &settings, true).unwrap());
            let welded = skin.stems.iter().filter(|is_welded| **is_welded).count();
            assert!(welded > 0, "{name} {budget}: {welded}");
            let mesher = level.mesher_without(&skin.stems);
            let mut mesh = Mesh::default();
            send(&[Welded::new(&skin, mesher)], &mut mesh).unwrap();
            let triangles = mesh.triangles() as u64;
            let before = level.mesher().count().triangles;
            assert!(
                (before * 97 / 100..=before).contains(&triangles),
                "{name} {budget}: {triangles} of {before}"
            );
            // Every corner that a triangle names is there, and is its own.
            let (part, bark) = mesh.parts.iter().find(|(part, _)| part.material == Material::Bark).unwrap();
            assert_eq!(part.count.vertices, bark.vertices.len() as u64);
            let rest = &bark.triangles[skin.bark.triangles.len()..];
            let first = skin.bark.vertices.len() as u32;
            assert!(rest.iter().flatten().all(|corner| (first..bark.vertices.len() as u32).contains(corner)));
            sound::check_closed(&sewn(&skin.bark));
            assert!(well_drawn(&skin.bark).0 > 0.85, "{name} {budget}");
        }
    }
}

/// The grid sees nothing that is thinner than a cell; what is drawn is as thin as the stem.
#[test]
fn ends_of_welded_stems_of_a_level_are_thin() {
    let mut tree = pleach_generators::preset("palm").unwrap().grow_bare(1).unwrap();
    tree.stems.truncate(1);
    let top = tree.knots.iter_mut().take(tree.stems[0].knot_count as usize).last().unwrap();
    top.radius = 0.001;
    let tip = top.point.as_vec3();
    let level = &lod::budgets(&[&tree], MeshSettings::default(), &[u32::MAX]).unwrap()[0][0];
    let settings = WeldSettings::new(0.05);
    let nearest = |block: &Block| {
        let far = block.vertices.iter().map(|vertex| vertex.position.distance(tip));
        far.fold(f32::INFINITY, f32::min)
    };
    let skin = Skin::of_level(level, &settings, false).unwrap();
    assert!(nearest(&skin.bark) < 0.01, "{}", nearest(&skin.bark));
    assert!(nearest(&Skin::whole(&tree, &settings, false).unwrap().bark) > 0.04);
}

#[test]
fn a_level_without_thick_stems_keeps_its_tubes() {
    let tree = pleach_generators::preset("acer").unwrap().grow_bare(1).unwrap();
    let level = &lod::budgets(&[&tree], MeshSettings::default(), &[2_000]).unwrap()[0][0];
    let skin = Skin::of_level(level, &WeldSettings::new(0.9), false).unwrap();
    assert!(skin.bark.triangles.is_empty() && skin.stems.iter().all(|is_welded| !is_welded));
    assert!(matches!(
        Skin::of_level(level, &WeldSettings::new(f64::NAN), false),
        Err(WeldError::NotPositive { .. })
    ));
    assert_eq!(level.mesher_without(&skin.stems).count(), level.mesher().count());
}

/// By how many metres the edges of `block` between vertices that are moved by different stems are longer or shorter after
/// `to` has moved these, the most last.
fn strains(block: &Block, wind: &[Wind], to: impl Fn(usize) -> Vec3) -> Vec<f32> {
    let edges = block.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let edges = edges.map(|(a, b)| (a as usize, b as usize));
    let at = |corner: usize| block.vertices[corner].position;
    let between = edges.filter(|&(a, b)| wind[a] != wind[b]);
    let mut all: Vec<f32> =
        between.map(|(a, b)| (to(a).distance(to(b)) - at(a).distance(at(b))).abs()).collect();
    all.sort_by(f32::total_cmp);
    all
}

#[test]
fn wind_moves_the_surface_and_does_not_tear_it() {
    for name in ["acer", "weeping_willow"] {
        let tree = pleach_generators::preset(name).unwrap().grow_bare(1).unwrap();
        let settings = WeldSettings { fillet: 1.0, ..WeldSettings::new(0.03) };
        let own = MeshSettings { wind: true, ..MeshSettings::default() };
        let level = &lod::budgets(&[&tree], own, &[20_000]).unwrap()[0][0];
        let skin = Skin::of_level(level, &settings, true).unwrap();
        let mut mesh = Mesh::default();
        send(&[Welded::new(&skin, level.mesher_without(&skin.stems))], &mut mesh).unwrap();
        let bark = mesh.part(Material::Bark).unwrap();
        assert_eq!(bark.wind.len(), bark.vertices.len());
        let surface = skin.bark.vertices.len();
        assert!(surface > 1000, "{name}: {surface}");
        // Vertices in one place stay in one place.
        let mut places = BTreeMap::new();
        for (i, vertex) in bark.vertices[..surface].iter().enumerate() {
            let first = *places.entry(vertex.position.to_array().map(f32::to_bits)).or_insert(i);
            assert_eq!(bark.wind[first], bark.wind[i], "{name} {i}");
        }
        assert!(places.len() < surface, "{name}: a picture begins again somewhere");
        let height = skin.bark.vertices.iter().map(|vertex| vertex.position.z).fold(0.0, f32::max);
        let levels: Vec<f32> = bark.wind[..surface].iter().map(|wind| wind.level).collect();
        assert!(levels.contains(&0.0) && levels.contains(&1.0), "{name}");
        let breeze = Breeze { wind: Vec3::X, time: 1.9, height };
        let blown = |i: usize| {
            let Vertex { position, normal, .. } = bark.vertices[i];
            moved(position, normal, &bark.wind[i], &breeze)
        };
        let far = (0..surface).map(|i| blown(i).distance(bark.vertices[i].position));
        let (far, strains) = (far.fold(0.0, f32::max), strains(&skin.bark, &bark.wind, blown));
        assert!(strains.len() > 100, "{name}: {} edges", strains.len());
        let most = strains[strains.len() - 1];
        assert!(far > 0.05 && most < 0.01, "{name}: {far} m, {most} m");
    }
}
