//! Pictures that materials show, in every format that holds them.

use crate::files::{dot, glb, grow, scene};
use pleach_mesh::write::glb::Scene;
use pleach_mesh::write::{obj, usda};
use pleach_mesh::{Material, MeshSettings, Mesher, Palette, Pictures, send};

#[test]
fn bark_shows_tiles_with_their_relief() {
    let (species, tree) = grow("acer");
    let bark =
        Pictures { normal: Some(dot()), roughness: Some(dot()), ..Pictures::colors(Material::Bark, dot()) };
    let card = Pictures::colors(Material::Card, dot());
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
