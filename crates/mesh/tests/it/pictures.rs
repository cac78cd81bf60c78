//! Pictures that materials show, in every format that holds them.

use crate::files::{dot, glb, grow, scene};
use glam::{Vec3, vec3};
use pleach_mesh::write::glb::Scene;
use pleach_mesh::write::{obj, usda};
use pleach_mesh::{Material, MeshSettings, Mesher, Palette, Pictures, send};

/// Bark with a colour, a relief and a roughness.
pub(crate) fn bark() -> Pictures<Vec<u8>> {
    Pictures { normal: Some(dot()), roughness: Some(dot()), ..Pictures::tiles(Material::Bark, dot()) }
}

/// A tree whose bark shows them.
pub(crate) fn textured(name: &str) -> Vec<u8> {
    let (species, tree) = grow(name);
    let scene = Scene { pictures: vec![bark()], ..scene(&species, &tree, 1) };
    glb(&[Mesher::new(&tree, MeshSettings::default())], &scene)
}

/// Without tangents each program would make its own of the texture coordinates.
#[test]
fn relief_comes_with_tangents() {
    let bytes = textured("acer");
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = file.blob.as_deref().unwrap();
    let parts: Vec<_> = file.meshes().next().unwrap().primitives().collect();
    assert!(parts[1].reader(|_| Some(blob)).read_tangents().is_none(), "leaves have no relief");
    let reader = parts[0].reader(|_| Some(blob));
    let tangents: Vec<[f32; 4]> = reader.read_tangents().unwrap().collect();
    let normals: Vec<Vec3> = reader.read_normals().unwrap().map(Vec3::from).collect();
    let positions: Vec<Vec3> = reader.read_positions().unwrap().map(Vec3::from).collect();
    let uv: Vec<[f32; 2]> = reader.read_tex_coords(0).unwrap().into_f32().collect();
    assert_eq!(tangents.len(), normals.len());
    for ([x, y, z, w], normal) in tangents.iter().zip(&normals) {
        let tangent = vec3(*x, *y, *z);
        assert!((tangent.length() - 1.0).abs() < 1e-4 && tangent.dot(*normal).abs() < 1e-3 && *w == 1.0);
    }
    // Along an edge of one height u grows with the tangent, but for those of caps and tips, where all u meet.
    let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
    let (mut right, mut all) = (0, 0);
    for corners in indices.chunks_exact(3) {
        let [a, b] = [corners[0] as usize, corners[1] as usize];
        let grows = uv[b][0] - uv[a][0];
        if uv[a][1] == uv[b][1] && grows != 0.0 {
            let [x, y, z, _] = tangents[a];
            all += 1;
            right += usize::from((positions[b] - positions[a]).dot(vec3(x, y, z)) * grows > 0.0);
        }
    }
    assert!(all > 1000 && right * 100 > all * 97, "{right} of {all}");
}

#[test]
fn bark_shows_tiles_with_their_relief() {
    let (species, tree) = grow("acer");
    let bark = bark();
    let card = Pictures::cut_out(Material::Card, dot(), 0.4);
    let scene = Scene { pictures: vec![card, bark], ..scene(&species, &tree, 1) };
    let bytes = glb(&[Mesher::new(&tree, MeshSettings::default())], &scene);
    let file = gltf::Gltf::from_slice(&bytes).unwrap();
    assert_eq!(file.images().count(), 3, "no part is a card");
    let names: Vec<_> = file.images().map(|image| image.name().unwrap_or_default().to_owned()).collect();
    assert_eq!(names, ["bark", "bark normal", "bark roughness"]);
    let material = file.materials().next().unwrap();
    let physical = material.pbr_metallic_roughness();
    let textures = [
        physical.base_color_texture().unwrap().texture(),
        material.normal_texture().unwrap().texture(),
        physical.metallic_roughness_texture().unwrap().texture(),
        material.occlusion_texture().unwrap().texture(),
    ];
    assert_eq!(textures.each_ref().map(|texture| texture.source().index()), [0, 1, 2, 2]);
    for texture in textures {
        assert_eq!(texture.sampler().wrap_s(), gltf::texture::WrappingMode::Repeat);
        assert_eq!(texture.sampler().wrap_t(), gltf::texture::WrappingMode::Repeat);
    }
    assert!(!material.double_sided() && material.alpha_mode() == gltf::material::AlphaMode::Opaque);

    let of = |what: &str| format!("acer-{what}.png");
    let named = Pictures {
        material: Material::Bark,
        repeats: true,
        cutoff: None,
        color: of("bark"),
        normal: Some(of("normal")),
        roughness: Some(of("roughness")),
    };
    let palette = Palette::new(&species.appearance, None);
    let materials = obj::materials(&palette, std::slice::from_ref(&named));
    for line in ["map_Kd acer-bark.png", "norm acer-normal.png", "map_Pr acer-roughness.png"] {
        assert!(materials.lines().any(|one| one == line), "{line}: {materials}");
    }
    assert!(!materials.contains("map_d"), "bark is not cut out");
    let notes = usda::Notes { name: "acer".into(), pictures: vec![named], ..usda::Notes::default() };
    let mut bytes = Vec::new();
    let mesher = Mesher::new(&tree, MeshSettings::default()).with_instanced_leaves();
    send(&[mesher], &mut usda::Usda::new(&mut bytes, &notes, palette)).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    assert_eq!(text.matches("\"repeat\"").count(), 6);
    assert!(text.contains("inputs:normal.connect = </acer/materials/bark/normal.outputs:rgb>"));
}
