//! Leaves that show pictures, and how a crown of them is lit.

use glam::Vec3;
use pleach_mesh::{Atlas, Block, LeafStyle, Material, Mesh, MeshSettings, Mesher, Source as _};
use pleach_tree::Tree;
use std::collections::BTreeSet;

fn grow(name: &str) -> Tree {
    pleach_generators::preset(name).unwrap().grow(1).unwrap()
}

fn part(name: &str, material: Material, settings: MeshSettings) -> Block {
    Mesh::new(&grow(name), settings).part(material).unwrap().clone()
}

/// Of each leaf the least and the largest texture coordinates.
fn extents(block: &Block, corners: usize) -> impl Iterator<Item = [f32; 4]> + '_ {
    block.vertices.chunks_exact(corners).map(|leaf| {
        leaf.iter().fold([1.0_f32, 1.0, 0.0, 0.0], |[l, t, r, b], v| {
            [l.min(v.uv.x), t.min(v.uv.y), r.max(v.uv.x), b.max(v.uv.y)]
        })
    })
}

#[test]
fn each_leaf_fills_a_cell_of_its_own_form() {
    for (name, material) in [("acer", Material::Leaf), ("hill_cherry", Material::Blossom)] {
        for style in [LeafStyle::Outline, LeafStyle::Card, LeafStyle::CrossedCards] {
            let settings = MeshSettings { leaves: style, pictured: true, ..MeshSettings::default() };
            let tree = grow(name);
            let count = if material == Material::Leaf { tree.leaves.len() } else { tree.blossoms.len() };
            let block = part(name, material, settings);
            let atlas = Atlas::new(1);
            let cells: Vec<[f32; 4]> = (0..atlas.forms).map(|form| atlas.sheet.cell(form)).collect();
            let mut worn = BTreeSet::new();
            for extent in extents(&block, block.vertices.len() / count) {
                let off = |cell: &[f32; 4]| (0..4).map(|k| (cell[k] - extent[k]).abs()).fold(0.0, f32::max);
                let cell = cells.iter().position(|cell| off(cell) < 0.02);
                worn.insert(cell.unwrap_or_else(|| panic!("{name} {style:?}: {extent:?}")));
            }
            assert_eq!(worn.len(), atlas.forms, "{name} {style:?}");
        }
    }
}

/// Programs reckon the tangents of leaves themselves, by this rule.
#[test]
fn pictures_of_leaves_are_upright_and_not_mirrored() {
    for style in [LeafStyle::Outline, LeafStyle::Card] {
        let settings = MeshSettings { leaves: style, pictured: true, ..MeshSettings::default() };
        let block = part("acer", Material::Leaf, settings);
        for triangle in &block.triangles {
            let [a, b, c] = triangle.map(|i| &block.vertices[i as usize]);
            let (p, q) = (b.position - a.position, c.position - a.position);
            let (s, t) = (b.uv - a.uv, c.uv - a.uv);
            let area = s.perp_dot(t);
            let (across, along) = ((p * t.y - q * s.y) / area, (q * s.x - p * t.x) / area);
            assert!(across.cross(along).dot(a.normal) < 0.0, "{style:?}");
        }
    }
}

#[test]
fn a_crown_is_lit_as_a_body_and_its_leaves_differ() {
    for name in ["quaking_aspen", "hill_cherry"] {
        let tree = grow(name);
        let leaves = tree.leaves.iter().chain(&tree.blossoms);
        let (low, high) = leaves.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), leaf| {
            (low.min(leaf.position), high.max(leaf.position))
        });
        // Low in the crown, so that it is lit from above.
        let middle = (low + high) / 2.0 - Vec3::Z * (0.25 * (high.z - low.z));
        // How far the normals of faces look outwards to someone outside: on average, and how much that varies.
        let outwards = |rounded: bool| {
            let mesh = Mesh::new(&tree, MeshSettings { rounded, ..MeshSettings::default() });
            let foliage = [Material::Leaf, Material::Blossom].into_iter().filter_map(|m| mesh.part(m));
            let (mut sum, mut squares, mut count) = (0.0, 0.0, 0.0);
            for block in foliage {
                for triangle in &block.triangles {
                    let [a, b, c] = triangle.map(|i| &block.vertices[i as usize]);
                    let out = (a.position - middle).normalize();
                    let face = (b.position - a.position).cross(c.position - a.position);
                    // In the middle of the face; what is seen from behind is turned.
                    let normal = (a.normal + b.normal + c.normal).normalize();
                    let seen = if face.dot(out) < 0.0 { -normal } else { normal };
                    let found = f64::from(seen.dot(out));
                    (sum, squares, count) = (sum + found, squares + found * found, count + 1.0);
                }
            }
            let mean: f64 = sum / count;
            (mean, (squares / count - mean * mean).sqrt())
        };
        let (flat, rounded) = (outwards(false), outwards(true));
        assert!(rounded.0 > 0.75 && rounded.0 > flat.0 + 0.15, "{name}: {flat:?} {rounded:?}");
        assert!(rounded.1 > 0.05, "{name}: {rounded:?}");
    }
}

#[test]
fn instances_show_one_form() {
    let tree = grow("acer");
    let settings = MeshSettings { pictured: true, ..MeshSettings::default() };
    let mesher = Mesher::new(&tree, settings).with_instanced_leaves();
    let leaf = mesher.parts(0).into_iter().find(|part| part.material == Material::Leaf).unwrap();
    assert_eq!(leaf.instances, tree.leaves.len() as u64);
    let mut block = Block::default();
    mesher.fill(Material::Leaf, mesher.ranges(Material::Leaf).remove(0), &mut block);
    assert_eq!(block.vertices.len() as u64, leaf.count.vertices);
}
