//! What wind does to the vertices of whole trees.

use crate::files::{grow, json_of, plain};
use glam::{Vec3, vec3};
use pleach_mesh::block::{Block, Wind};
use pleach_mesh::wind::{Breeze, moved};
use pleach_mesh::{Material, Mesh, MeshSettings, Mesher, lod, send};
use pleach_plant::Tree;

const SPECIES: [&str; 6] =
    ["weeping_willow", "acer", "bamboo", "quaking_aspen", "black_oak", "velvet_mesquite"];

fn settings() -> MeshSettings {
    MeshSettings { wind: true, ..MeshSettings::default() }
}

/// Fresh breezes from several sides at several times.
fn breezes(height: f32) -> Vec<Breeze> {
    let winds = [Vec3::X, Vec3::NEG_Y, vec3(-0.6, 0.8, 0.0)];
    winds.into_iter().zip([0.3, 1.9, 7.7]).map(|(wind, time)| Breeze { wind, time, height }).collect()
}

fn height(block: &Block) -> f32 {
    block.vertices.iter().map(|vertex| vertex.position.z).fold(0.0, f32::max)
}

/// The largest distance in metres between where the vertices of a stem's base go, and where what carries it would take
/// them; over all stems.
fn gap(tree: &Tree, mesher: &Mesher<'_>, bark: &Block) -> f32 {
    let breezes = breezes(height(bark));
    let (mut largest, mut seen, mut children) = (0.0_f32, 0, 0);
    for (i, stem) in tree.stems.iter().enumerate() {
        let Some(parent) = stem.parent else { continue };
        let base = tree.knots_of(stem)[0];
        let carrier: &Wind = &bark.wind[mesher.first_vertex(parent as usize) as usize];
        let first = mesher.first_vertex(i) as usize;
        let last =
            if i + 1 < tree.stems.len() { mesher.first_vertex(i + 1) as usize } else { bark.wind.len() };
        // Its first ring, which has four vertices at least, lies across its direction.
        let along = (base.handle_out - base.point).as_vec3().normalize_or(Vec3::Z);
        let at_base = |k: &usize| {
            let off = bark.vertices[*k].position - base.point.as_vec3();
            *k < first + 4 || off.dot(along).abs() < 1e-4
        };
        children += 1;
        for k in (first..last).take_while(at_base) {
            seen += 1;
            let vertex = &bark.vertices[k];
            for breeze in &breezes {
                let own = moved(vertex.position, vertex.normal, &bark.wind[k], breeze);
                largest = largest.max(own.distance(moved(vertex.position, vertex.normal, carrier, breeze)));
            }
        }
    }
    assert!(seen >= 4 * children, "{seen} vertices at the bases of {children} stems");
    largest
}

#[test]
fn every_base_stays_on_what_carries_it() {
    for name in SPECIES {
        let (_, tree) = grow(name);
        let mesher = Mesher::new(&tree, settings());
        let mesh = Mesh::new(&tree, settings());
        let largest = gap(&tree, &mesher, mesh.part(Material::Bark).unwrap());
        assert!(largest < 1e-3, "{name}: {largest} m");
        let level = &lod::budgets(&[&tree], settings(), &[8_000]).unwrap()[0][0];
        let mesher = level.mesher();
        let mut mesh = Mesh::default();
        send(&[level.mesher()], &mut mesh).unwrap();
        let largest = gap(&level.tree, &mesher, mesh.part(Material::Bark).unwrap());
        assert!(largest < 1e-3, "{name} with few triangles: {largest} m");
    }
}

#[test]
fn limbs_move_on_trunks_and_twigs_on_limbs() {
    for name in SPECIES {
        let (_, tree) = grow(name);
        let mesh = Mesh::new(&tree, settings());
        let bark = mesh.part(Material::Bark).unwrap();
        // How far a body moves beyond what carries it, on average over its vertices.
        let mut sums = [(0.0_f64, 0_u32); 3];
        for breeze in breezes(height(bark)) {
            for (vertex, wind) in bark.vertices.iter().zip(&bark.wind) {
                let carried = Wind { bend: Vec3::ZERO, ..*wind };
                let own = moved(vertex.position, vertex.normal, wind, &breeze);
                let sum = &mut sums[wind.level as usize];
                let off = own.distance(moved(vertex.position, vertex.normal, &carried, &breeze));
                *sum = (sum.0 + f64::from(off), sum.1 + 1);
            }
        }
        let means = sums.map(|(sum, count)| sum / f64::from(count.max(1)));
        assert!(means[0] == 0.0 && (0.005..0.5).contains(&means[1]), "{name}: {means:?}");
        assert!(sums[2].1 == 0 || (0.002..0.5).contains(&means[2]), "{name}: {means:?}");
    }
}

#[test]
fn leaves_flutter_at_their_tips_and_hang_on_at_their_stalks() {
    let (_, tree) = grow("acer");
    let mesh = Mesh::new(&tree, settings());
    let leaves = mesh.part(Material::Leaf).unwrap();
    let (mut still, mut most) = (0, 0.0_f32);
    for (vertex, wind) in leaves.vertices.iter().zip(&leaves.wind) {
        assert!((0.0..=0.03).contains(&wind.flutter) && wind.level >= 1.0);
        // To a thousandth of a millimetre.
        let is_still = wind.flutter < 1e-6;
        assert_eq!(is_still, vertex.uv.y >= 1.0, "{vertex:?}");
        still += usize::from(is_still);
        most = most.max(wind.flutter);
    }
    assert!(still >= tree.leaves.len() && most > 0.005, "{still} {most}");
}

#[test]
fn all_parts_carry_numbers_in_the_sets_that_engines_read() {
    let (_, tree) = grow("acer");
    let level = &lod::budgets(&[&tree], settings(), &[2_000]).unwrap()[0][0];
    let mut cards = Mesh::default();
    send(&[level.mesher()], &mut cards).unwrap();
    assert!(cards.part(Material::Twig).is_some());
    for (part, block) in Mesh::new(&tree, settings()).parts.iter().chain(&cards.parts) {
        assert_eq!(block.wind.len(), block.vertices.len(), "{:?}", part.material);
        for wind in &block.wind {
            assert!((0.0..1.0).contains(&wind.phase) && (0.0..1.0).contains(&wind.parent_phase));
            let [.., own, parent] = wind.to_array();
            assert_eq!((own.floor(), parent.floor()), (wind.level, (1000.0 * wind.flutter).round()));
            assert!(wind.bend.length() < 3.0);
        }
    }
    let json = json_of(&plain("acer", settings()));
    let attributes = json["meshes"][0]["primitives"][0]["attributes"].as_object().unwrap();
    for set in 1..=7 {
        let accessor = &json["accessors"][attributes[&format!("TEXCOORD_{set}")].as_u64().unwrap() as usize];
        assert_eq!((&accessor["type"], &accessor["componentType"]), (&"VEC2".into(), &5126.into()));
    }
    assert!(attributes.keys().all(|name| !name.starts_with('_') && name != "COLOR_0"));
}
