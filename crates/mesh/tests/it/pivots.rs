//! Which points the vertices of whole trees turn about, as the textures for Unreal say.

use crate::files::{glb, grow, json_of, scene};
use glam::{Vec2, Vec3, vec3};
use pleach_mesh::wind::Bodies;
use pleach_mesh::{Block, Material, Mesh, MeshSettings, Mesher, Pivots, lod, send};
use pleach_plant::Tree;

const SPECIES: [&str; 6] =
    ["weeping_willow", "acer", "bamboo", "quaking_aspen", "velvet_mesquite", "stylised_oak"];

/// The number that the bits of a half float which is not very small stand for.
fn half(bits: u16) -> f32 {
    let size = f32::from_bits(u32::from(bits & 0x7fff) << 13) * 2.0_f32.powi(112);
    if bits & 0x8000 == 0 { size } else { -size }
}

/// What Unreal reads of a pixel: the pivot in metres, z up, and the number of the parent.
fn read(pixel: [u16; 4]) -> (Vec3, u32) {
    let [x, y, z, parent] = pixel;
    (vec3(half(x), -half(y), half(z)) / 100.0, u32::from(parent) - 1024)
}

/// The number that Unreal makes of texture coordinates.
fn element(pivots: &Pivots, pixel: Vec2) -> u32 {
    let at = (pixel * pivots.size().as_vec2()).floor().as_uvec2();
    at.x + at.y * pivots.size().x
}

/// Checks the vertices of the stems of a tree, or of what a level has left of it; returns how far pivots are off at most.
fn check(pivots: &Pivots, tree: &Tree, mesher: &Mesher<'_>, bark: &Block) -> f32 {
    let bodies = Bodies::new(tree);
    assert_eq!(bark.pixels.len(), bark.vertices.len());
    let (pixels, positions) = (pivots.pixels(tree), pivots.positions());
    let own = |stem: usize| element(pivots, pixels[stem]);
    let mut off = 0.0_f32;
    for (i, stem) in tree.stems.iter().enumerate() {
        let first = mesher.first_vertex(i) as usize;
        let last =
            if i + 1 < tree.stems.len() { mesher.first_vertex(i + 1) as usize } else { bark.vertices.len() };
        assert!(bark.pixels[first..last].iter().all(|pixel| *pixel == pixels[i]), "stem {i}");
        let (body, number) = (bodies.of_stem(i), own(i));
        let (pivot, parent) = read(positions[number as usize]);
        assert_eq!(pivots.elements()[number as usize].pivot, body.pivot, "stem {i}");
        assert_eq!(pivots.elements()[parent as usize].pivot, body.parent_pivot, "stem {i}");
        off = off.max(pivot.distance(body.pivot));
        // A branch that turns by itself does so about its base, and so that stays on what it grows from.
        if let Some(carrier) =
            stem.parent.map(|carrier| own(carrier as usize)).filter(|other| *other != number)
        {
            assert_eq!(body.pivot, tree.knots_of(stem)[0].point.as_vec3(), "stem {i}");
            assert_eq!(parent, carrier, "stem {i}");
        }
    }
    off
}

#[test]
fn every_vertex_names_the_pivot_of_what_it_turns_with_at_every_level() {
    for name in SPECIES {
        let (_, tree) = grow(name);
        let pivots = Pivots::new(&tree).unwrap();
        assert!((2..=Pivots::MAX_ELEMENTS).contains(&pivots.elements().len()), "{name}");
        let highest = tree.knots.iter().map(|knot| knot.point.abs().max_element()).fold(0.0, f64::max);
        // A half float has eleven bits, so that it is off by up to a part in 2,048.
        let allowed = 3.0_f32.sqrt() * highest as f32 / 2048.0;
        let mut levels = lod::levels(&tree, MeshSettings::default(), 5);
        levels.extend(lod::budgets(&[&tree], MeshSettings::default(), &[20_000, 4_000]).unwrap().remove(0));
        for (number, level) in levels.iter().enumerate() {
            let mesher = level.mesher().with_pivots(&pivots);
            let mut mesh = Mesh::default();
            send(&[level.mesher().with_pivots(&pivots)], &mut mesh).unwrap();
            for (part, block) in &mesh.parts {
                assert!(part.pixels, "{name} {number}");
                assert_eq!(block.pixels.len(), block.vertices.len(), "{name} {number} {:?}", part.material);
                let last = pivots.elements().len() as u32;
                assert!(block.pixels.iter().all(|pixel| element(&pivots, *pixel) < last));
            }
            let off = check(&pivots, &level.tree, &mesher, mesh.part(Material::Bark).unwrap());
            assert!(off <= allowed, "{name} {number}: {off} m of {allowed}");
        }
    }
}

/// Leaves turn with the stem that they hang on.
#[test]
fn leaves_and_cards_have_the_pixels_of_their_stems() {
    let (_, tree) = grow("acer");
    let pivots = Pivots::new(&tree).unwrap();
    let of_stems = pivots.pixels(&tree);
    let mut mesh = Mesh::default();
    send(&[Mesher::new(&tree, MeshSettings::default()).with_pivots(&pivots)], &mut mesh).unwrap();
    let leaves = mesh.part(Material::Leaf).unwrap();
    let each = leaves.vertices.len() / tree.leaves.len();
    for (leaf, pixels) in tree.leaves.iter().zip(leaves.pixels.chunks_exact(each)) {
        assert!(pixels.iter().all(|pixel| *pixel == of_stems[leaf.stem as usize]));
    }
    let level = &lod::budgets(&[&tree], MeshSettings::default(), &[2_000]).unwrap()[0][0];
    let mut coarse = Mesh::default();
    send(&[level.mesher().with_pivots(&pivots)], &mut coarse).unwrap();
    let of_stems = pivots.pixels(&level.tree);
    let cards = level.twigs.as_ref().unwrap().cards.iter();
    for (card, pixels) in cards.zip(coarse.part(Material::Twig).unwrap().pixels.chunks_exact(4)) {
        assert!(pixels.iter().all(|pixel| *pixel == of_stems[card.stem as usize]));
    }
}

#[test]
fn a_file_has_the_pixels_in_its_second_texture_coordinates() {
    let (species, tree) = grow("acer");
    let pivots = Pivots::new(&tree).unwrap();
    let mesher = || Mesher::new(&tree, MeshSettings::default());
    let with = glb(&[mesher().with_pivots(&pivots)], &scene(&species, &tree, 1));
    let plain = glb(&[mesher()], &scene(&species, &tree, 1));
    for primitive in json_of(&with)["meshes"][0]["primitives"].as_array().unwrap() {
        let attributes = primitive["attributes"].as_object().unwrap();
        assert!(attributes.contains_key("TEXCOORD_1") && !attributes.contains_key("TEXCOORD_2"));
    }
    assert!(!json_of(&plain).to_string().contains("TEXCOORD_1"));
}
