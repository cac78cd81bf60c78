//! What every mesh of every species promises.

use glam::Vec3;
use pleach_mesh::{LeafStyle, Material, Mesh, MeshSettings, Mesher, Rig, lod, send};
use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::{Blob, Knot, Leaf, Parts, Stem, StemKind, Tree};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

const SPECIES: [&str; 8] =
    ["quaking_aspen", "bamboo", "palm", "acer", "hill_cherry", "small_pine", "fan_palm", "european_larch"];

fn grow(name: &str, seed: u64) -> Tree {
    pleach_generators::preset(name).unwrap().grow(seed).unwrap()
}

#[test]
fn bark_is_closed_and_no_face_is_degenerate_or_twice_there() {
    for name in SPECIES {
        let tree = pleach_generators::preset(name).unwrap().grow_bare(2).unwrap();
        let mesh = Mesh::new(&tree, MeshSettings::default());
        let bark = mesh.part(Material::Bark).unwrap();
        let bits = |i: u32| bark.vertices[i as usize].position.to_array().map(f32::to_bits);
        let mut edges: HashMap<_, i32> = HashMap::new();
        let mut faces = HashSet::new();
        for t in &bark.triangles {
            let mut corners = t.map(bits);
            for (p, q) in [(0, 1), (1, 2), (2, 0)] {
                *edges.entry((corners[p], corners[q])).or_default() += 1;
                *edges.entry((corners[q], corners[p])).or_default() -= 1;
            }
            let [a, b, c] = t.map(|i| bark.vertices[i as usize].position.as_dvec3());
            assert!((b - a).cross(c - a).length() > 0.0, "{name}: a face without area at {a}");
            corners.sort_unstable();
            assert!(faces.insert(corners), "{name}: a face is there twice, at {a}");
        }
        assert!(edges.values().all(|n| *n == 0), "{name}: every edge has two faces");
    }
}

#[test]
fn corners_are_finite_with_unit_normals_and_textures_in_range() {
    for name in SPECIES {
        let mesh = Mesh::new(&grow(name, 1), MeshSettings::default());
        for (part, block) in &mesh.parts {
            for v in &block.vertices {
                assert!(v.to_array().iter().all(|x| x.is_finite()), "{name}: {v:?}");
                assert!((v.normal.length() - 1.0).abs() < 1e-3, "{name} {:?}: {v:?}", part.material);
                // Bark has tiles, which grow upwards: against v.
                let (u, v_range) = match part.material {
                    Material::Bark => (100.0, -1e4..=1e-5),
                    _ => (1.0, -1e-5..=1.0 + 1e-5),
                };
                assert!((-1e-5..=u + 1e-5).contains(&v.uv.x) && v_range.contains(&v.uv.y), "{name}: {v:?}");
            }
            let used: HashSet<u32> = block.triangles.iter().flatten().copied().collect();
            assert_eq!(used.len(), block.vertices.len(), "{name}: every corner is used");
        }
    }
}

/// Area of a triangle of bark, and how much wider than high a picture is drawn on it; `None` without a picture.
fn stretch([a, b, c]: [&pleach_mesh::Vertex; 3]) -> (f32, Option<f32>) {
    let (p, q) = (b.position - a.position, c.position - a.position);
    let (s, t) = (b.uv - a.uv, c.uv - a.uv);
    let area = s.perp_dot(t);
    // A picture with v downwards is upright and not mirrored if u, v and the normal are a left-handed system.
    let (across, along) = ((p * t.y - q * s.y) / area, (q * s.x - p * t.x) / area);
    let is_upright = across.cross(along).dot(a.normal + b.normal + c.normal) < 0.0;
    (p.cross(q).length(), is_upright.then(|| across.length() / along.length()))
}

#[test]
fn pictures_of_bark_keep_their_form_and_are_not_mirrored() {
    for name in SPECIES {
        let tree = pleach_generators::preset(name).unwrap().grow_bare(1).unwrap();
        let mesh = Mesh::new(&tree, MeshSettings::default());
        let bark = mesh.part(Material::Bark).unwrap();
        let (mut good, mut all) = (0.0, 0.0);
        for triangle in &bark.triangles {
            let corners = triangle.map(|i| &bark.vertices[i as usize]);
            let (area, stretch) = stretch(corners);
            all += area;
            good += if stretch.is_some_and(|ratio| (0.5..=2.0).contains(&ratio)) { area } else { 0.0 };
        }
        assert!(good >= 0.95 * all, "{name}: {:.1} % of the area", 100.0 * good / all);
    }
}

#[test]
fn bark_runs_on_through_forks() {
    let tree = pleach_generators::preset("acer").unwrap().grow_bare(1).unwrap();
    let mesher = Mesher::new(&tree, MeshSettings::default());
    let mesh = Mesh::new(&tree, MeshSettings::default());
    let bark = &mesh.part(Material::Bark).unwrap().vertices;
    let mut forks = 0;
    for (i, stem) in tree.stems.iter().enumerate() {
        let (StemKind::Fork, Some(parent)) = (stem.kind, stem.parent) else { continue };
        // The parent's corner that is nearest to where the fork begins.
        let first = mesher.first_vertex(i) as usize;
        let foot = bark[first].uv.y;
        let of_parent =
            mesher.first_vertex(parent as usize) as usize..mesher.first_vertex(parent as usize + 1) as usize;
        let place = tree.knots_of(stem)[0].point.as_vec3();
        let nearest = bark[of_parent]
            .iter()
            .min_by(|a, b| a.position.distance_squared(place).total_cmp(&b.position.distance_squared(place)));
        let apart = (nearest.unwrap().uv.y - foot).abs();
        assert!(apart < 1.5, "fork {i} begins {apart} tiles from where its parent is left");
        forks += usize::from(foot < -1.0);
    }
    assert!(forks > 5, "{forks}");
}

#[test]
fn every_leaf_is_there_with_its_area() {
    for name in SPECIES {
        let tree = grow(name, 1);
        for (style, triangles) in [(LeafStyle::Outline, None), (LeafStyle::CrossedCards, Some(4))] {
            let mesh = Mesh::new(&tree, MeshSettings { leaves: style, ..MeshSettings::default() });
            let Some(leaves) = mesh.part(Material::Leaf) else {
                assert!(tree.leaves.is_empty(), "{name}");
                continue;
            };
            let each = triangles.unwrap_or(tree.leaf_shapes[0].corners().len() - 2);
            assert_eq!(leaves.triangles.len(), each * tree.leaves.len(), "{name} {style:?}");
            if style == LeafStyle::Outline {
                let corner = |i: u32| leaves.vertices[i as usize].position;
                let area = |t: &[u32; 3]| {
                    let [a, b, c] = t.map(corner);
                    f64::from((b - a).cross(c - a).length()) / 2.0
                };
                let found: f64 = leaves.triangles.iter().map(area).sum();
                let expected = pleach_tree::TreeStats::new(&tree).leaf_area_m2;
                assert!((found / expected - 1.0).abs() < 1e-3, "{name}: {found} is not {expected}");
            }
        }
    }
}

#[test]
fn leaves_face_the_way_of_their_normals() {
    let mesh = Mesh::new(&grow("quaking_aspen", 1), MeshSettings::default());
    let leaves = mesh.part(Material::Leaf).unwrap();
    for t in &leaves.triangles {
        let [a, b, c] = t.map(|i| leaves.vertices[i as usize].position);
        assert!((b - a).cross(c - a).dot(leaves.vertices[t[0] as usize].normal) > 0.0);
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let tree = grow("apple", 3);
    let settings = MeshSettings { wind: true, ..MeshSettings::default() };
    let [one, three] = [1, 3].map(|n| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().unwrap();
        pool.install(|| Mesh::new(&tree, settings))
    });
    assert!(one == three);
}

#[test]
fn a_tree_without_leaves_and_one_without_anything() {
    let bare = pleach_generators::preset("acer").unwrap().grow_bare(1).unwrap();
    let mesh = Mesh::new(&bare, MeshSettings::default());
    assert_eq!(mesh.parts.len(), 1);
    assert!(Mesh::new(&Tree::default(), MeshSettings::default()).parts.is_empty());
    for level in lod::levels(&bare, MeshSettings::default(), 6) {
        assert_eq!(Mesh::new(&level.tree, level.settings).parts.len(), 1);
    }
}

#[test]
fn settings_out_of_range_are_moved_into_it() {
    let tree = pleach_generators::preset("palm").unwrap().grow_bare(1).unwrap();
    let settings =
        MeshSettings { tolerance: f64::NAN, min_sides: 0, max_sides: 0, ..MeshSettings::default() };
    let mesh = Mesh::new(&tree, settings);
    assert!(mesh.triangles() > tree.stems.len() && mesh.triangles() < 100 * tree.knots.len());
}

/// A pole with a root, leaves of two shapes and a blob: what no Weber–Penn tree has.
fn mixed() -> Tree {
    let stem = |kind, first_knot| Stem {
        parent: None,
        level: 0,
        kind,
        number: 0,
        offset: 0.0,
        first_knot,
        knot_count: 2,
    };
    let knot = |x: f64, z: f64| {
        let point = glam::dvec3(x, 0.0, z);
        Knot { point, handle_in: point, handle_out: point, radius: 0.1 }
    };
    let leaf = |z: f32, shape| Leaf {
        position: glam::vec3(0.0, 0.0, z),
        along: Vec3::Z,
        across: Vec3::X,
        stem: 0,
        shape,
    };
    Tree {
        stems: vec![stem(StemKind::Trunk, 0), stem(StemKind::Root, 2)],
        knots: vec![knot(0.0, 0.0), knot(0.0, 3.0), knot(0.0, 0.0), knot(2.0, 0.0)],
        leaves: vec![leaf(1.0, 0), leaf(2.0, 1), leaf(3.0, 0)],
        leaf_shapes: [LeafShape::Maple, LeafShape::Triangle].map(|s| Arc::clone(s.outline())).to_vec(),
        blobs: vec![Blob { stem: 0, first_vertex: 0, vertex_count: 4, first_triangle: 0, triangle_count: 4 }],
        blob_vertices: [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|v| v + Vec3::Z * 3.0).to_vec(),
        blob_triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        ..Tree::default()
    }
}

#[test]
fn leaves_of_several_shapes_and_blobs_are_one_part() {
    let tree = mixed();
    tree.well_formed().unwrap();
    let rig = Rig::new(&tree);
    let settings = MeshSettings { wind: true, ..MeshSettings::default() };
    let mut mesh = Mesh::default();
    send(&[Mesher::new(&tree, settings).with_rig(&rig)], &mut mesh).unwrap();
    let foliage = mesh.part(Material::Leaf).unwrap();
    assert_eq!(foliage.vertices.len(), 25 + 3 + 25 + 4);
    assert_eq!((foliage.wind.len(), foliage.joints.len()), (57, 57));
    assert_eq!(foliage.triangles.len(), 23 + 1 + 23 + 4);
    assert!(foliage.triangles[47..].iter().flatten().all(|i| (53..57).contains(i)));
    // Outwards: away from the middle of the blob.
    let middle = glam::vec3(0.25, 0.25, 3.25);
    assert!(foliage.vertices[53..].iter().all(|v| (v.position - middle).dot(v.normal) > 0.0));
    let mut instanced = Mesh::default();
    send(&[Mesher::new(&tree, settings).with_instanced_leaves()], &mut instanced).unwrap();
    assert!(instanced.part(Material::Leaf).unwrap().instances.is_empty());
}

#[test]
fn roots_are_meshed_where_they_are_asked_for() {
    let tree = mixed();
    let width = |parts| {
        let mesh = Mesh::new(&tree, MeshSettings { parts, ..MeshSettings::default() });
        mesh.part(Material::Bark).unwrap().vertices.iter().map(|v| v.position.x).fold(0.0, f32::max)
    };
    assert!(width(Parts::LEAFY) < 0.2 && width(Parts::ALL) > 1.9);
    assert!(
        Mesh::new(&tree, MeshSettings { parts: Parts::BARE, ..MeshSettings::default() })
            .part(Material::Leaf)
            .is_none()
    );
}
