//! How the vertices of whole trees grow.

use crate::files::{grow, json_of, plain};
use glam::Vec3;
use pleach_mesh::block::Block;
use pleach_mesh::growth::{LAST, grown};
use pleach_mesh::{LeafStyle, Material, Mesh, MeshSettings, lod, send};

const SPECIES: [&str; 6] =
    ["weeping_willow", "acer", "bamboo", "quaking_aspen", "velvet_mesquite", "stylised_oak"];

fn settings() -> MeshSettings {
    MeshSettings { growth: true, leaves: LeafStyle::Simple, ..MeshSettings::default() }
}

/// The positions of all vertices at `time`.
fn at(block: &Block, time: f32) -> Vec<Vec3> {
    assert_eq!(block.growth.len(), block.vertices.len());
    let own = |(vertex, growth): (&pleach_mesh::Vertex, _)| grown(vertex.position, growth, time);
    block.vertices.iter().zip(&block.growth).map(own).collect()
}

/// The area of all triangles, and the height up to which those are that are wider than what rounding leaves of them.
fn seen(block: &Block, time: f32) -> (f32, f32) {
    let points = at(block, time);
    block.triangles.iter().fold((0.0, 0.0_f32), |(sum, top), corners| {
        let [a, b, c] = corners.map(|corner| points[corner as usize]);
        let (area, longest) = ((b - a).cross(c - a).length() / 2.0, (b - a).length().max((c - b).length()));
        (sum + area, if area > 2e-5 * longest { top.max(a.z).max(b.z).max(c.z) } else { top })
    })
}

#[test]
fn trees_grow_from_nothing_to_what_is_in_the_file() {
    for name in SPECIES {
        let (_, tree) = grow(name);
        let mesh = Mesh::new(&tree, settings());
        for (part, block) in &mesh.parts {
            let material = part.material;
            assert!(block.growth.iter().all(|growth| (0.0..=LAST).contains(&growth.time)));
            assert_eq!(at(block, 1.0), block.vertices.iter().map(|v| v.position).collect::<Vec<_>>());
            let areas: Vec<f32> = (0..=10).map(|step| seen(block, step as f32 / 10.0).0).collect();
            assert!(areas[0] < 1e-4 * areas[10], "{name} {material:?}: {areas:?}");
            let steps = areas.windows(2).all(|pair| pair[0] <= pair[1] * (1.0 + 1e-5));
            assert!(steps, "{name} {material:?}: {areas:?}");
        }
        let bark = mesh.part(Material::Bark).unwrap();
        let tops = [0.3, 0.6, 1.0].map(|time| seen(bark, time).1);
        assert!(0.0 < tops[0] && tops[0] < tops[1] && tops[1] <= tops[2], "{name}: {tops:?}");
    }
}

#[test]
fn places_of_coarse_levels_have_the_times_of_the_finest() {
    for name in SPECIES {
        let (_, tree) = grow(name);
        let whole = Mesh::new(&tree, settings());
        let mut coarse = Mesh::default();
        let level = &lod::budgets(&[&tree], settings(), &[4_000]).unwrap()[0][0];
        send(&[level.mesher()], &mut coarse).unwrap();
        assert!(coarse.parts.iter().all(|(part, _)| part.growth), "{name}");
        // From the axes, which do not depend on how many sides a stem has.
        let axes = |mesh: &Mesh, step: usize| -> Vec<(Vec3, f32)> {
            let bark = mesh.part(Material::Bark).unwrap();
            let own = bark.vertices.iter().zip(&bark.growth).step_by(step);
            own.map(|(vertex, growth)| (vertex.position + growth.toward, growth.time)).collect()
        };
        let (fine, few) = (axes(&whole, 1), axes(&coarse, 23));
        let mut seen = 0;
        for (place, time) in few {
            let nearest = fine
                .iter()
                .min_by(|a, b| a.0.distance_squared(place).total_cmp(&b.0.distance_squared(place)));
            let (other, its) = nearest.unwrap();
            // Elsewhere no ring of the finest is near, or another stem passes.
            if other.distance(place) < 1e-3 {
                assert!((its - time).abs() < 0.01, "{name} at {place}: {its} and {time}");
                seen += 1;
            }
        }
        assert!(seen >= 10, "{name}: {seen}");
    }
}

#[test]
fn numbers_are_in_two_sets_that_engines_read() {
    let json = json_of(&plain("acer", settings()));
    for primitive in json["meshes"][0]["primitives"].as_array().unwrap() {
        let attributes = primitive["attributes"].as_object().unwrap();
        for set in 1..=2 {
            let number = attributes[&format!("TEXCOORD_{set}")].as_u64().unwrap() as usize;
            let accessor = &json["accessors"][number];
            assert_eq!((&accessor["type"], &accessor["componentType"]), (&"VEC2".into(), &5126.into()));
        }
        assert!(!attributes.contains_key("TEXCOORD_3"));
    }
    // The files of two trees that differ in nothing else: four numbers for each vertex.
    let (_, tree) = grow("acer");
    let mesh = Mesh::new(&tree, settings());
    let vertices: usize = mesh.parts.iter().map(|(_, block)| block.vertices.len()).sum();
    let plainer = plain("acer", MeshSettings { growth: false, ..settings() });
    let more = plain("acer", settings()).len() - plainer.len();
    assert!((16 * vertices..16 * vertices + 2000).contains(&more), "{more} bytes, {vertices} vertices");
}

#[test]
fn ply_files_have_the_numbers_as_properties() {
    let (species, tree) = grow("acer");
    let palette = pleach_mesh::Palette::new(&species.appearance, None);
    let mut bytes = Vec::new();
    let mesher = pleach_mesh::Mesher::new(&tree, settings());
    send(&[mesher], &mut pleach_mesh::write::ply::Ply::new(&mut bytes, palette)).unwrap();
    let end = bytes.windows(11).position(|some| some == b"end_header\n").unwrap() + 11;
    let head = std::str::from_utf8(&bytes[..end]).unwrap();
    assert!(head.contains("property float growth_time\nproperty float growth_toward_x\n"));
    let mesh = Mesh::new(&tree, settings());
    let vertices: usize = mesh.parts.iter().map(|(_, block)| block.vertices.len()).sum();
    // Eight numbers, a colour, four numbers.
    assert_eq!(bytes.len() - end, (32 + 3 + 16) * vertices + 13 * mesh.triangles());
}
