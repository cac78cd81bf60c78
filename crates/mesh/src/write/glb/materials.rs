//! Materials of a GLB file: colours, pictures, and light that goes through leaves.

use super::Scene;
use crate::palette::linear;
use crate::part::Material;
use crate::pictures::Pictures;
use glam::Vec2;
use serde_json::{Value, json};

/// Numbers of the textures of a material.
pub(super) type Textures = Pictures<usize>;

pub(super) const TRANSFORM: &str = "KHR_texture_transform";

/// Light that goes through a surface and is scattered there; programs that do not know it show the material without.
pub(super) const TRANSMISSION: &str = "KHR_materials_diffuse_transmission";

/// What part of the light that a material scatters comes out on its other side, and in what colour against the one in
/// which it is reflected: light that has gone through a leaf is yellower.
pub(super) const fn transmitted(material: Material) -> Option<(f64, [f32; 3])> {
    match material {
        Material::Leaf => Some((0.4, [1.0, 1.0, 0.45])),
        Material::Blossom => Some((0.4, [1.0, 1.0, 1.0])),
        Material::Twig => Some((0.3, [1.0, 1.0, 0.45])),
        Material::Bark | Material::Card | Material::Collision => None,
    }
}

fn rounded(channels: [f32; 3]) -> [f64; 3] {
    channels.map(|c| (f64::from(c) * 1e4).round() / 1e4)
}

pub(super) fn material(scene: &Scene<'_>, textures: &[Textures], material: Material) -> Value {
    let own = textures.iter().find(|textures| textures.material == material);
    let color = linear(scene.palette.color(material));
    let mut value = json!({"name": material.name(), "pbrMetallicRoughness": {"metallicFactor": 0.0}});
    let (is_bark, is_rough) = (material == Material::Bark, material == Material::Card);
    let roughness = if is_bark {
        0.95
    } else if is_rough {
        1.0
    } else {
        0.7
    };
    value["pbrMetallicRoughness"]["roughnessFactor"] = json!(roughness);
    match own {
        Some(textures) => {
            value["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": textures.color})
        }
        None => {
            let [r, g, b] = rounded(color);
            value["pbrMetallicRoughness"]["baseColorFactor"] = json!([r, g, b, 1.0]);
        }
    }
    if let Some(normal) = own.and_then(|own| own.normal) {
        value["normalTexture"] = json!({"index": normal});
    }
    if let Some(roughness) = own.and_then(|own| own.roughness) {
        value["occlusionTexture"] = json!({"index": roughness});
        value["pbrMetallicRoughness"]["metallicRoughnessTexture"] = json!({"index": roughness});
        value["pbrMetallicRoughness"]["roughnessFactor"] = json!(1.0);
    }
    if !is_bark && material != Material::Collision {
        value["doubleSided"] = json!(true);
    }
    if let Some(cutoff) = own.and_then(|own| own.cutoff) {
        value["alphaMode"] = json!("MASK");
        value["alphaCutoff"] = json!((f64::from(cutoff) * 100.0).round() / 100.0);
    }
    if let Some((part, tint)) = transmitted(material) {
        let tint = if own.is_some() { tint } else { std::array::from_fn(|c| tint[c] * color[c]) };
        let mut through =
            json!({"diffuseTransmissionFactor": part, "diffuseTransmissionColorFactor": rounded(tint)});
        if let Some(own) = own {
            through["diffuseTransmissionColorTexture"] = json!({"index": own.color});
        }
        value["extensions"] = json!({(TRANSMISSION): through});
    }
    value
}

pub(super) fn has_picture(material: &Value) -> bool {
    material["pbrMetallicRoughness"]["baseColorTexture"].is_object()
}

/// Moves and scales all pictures of a material to the texture coordinates that whole numbers stand for.
pub(super) fn transform_textures(material: &mut Value, (offset, scale): (Vec2, Vec2)) {
    let transform = json!({(TRANSFORM): {"offset": offset.to_array(), "scale": scale.to_array()}});
    for path in [
        "/pbrMetallicRoughness/baseColorTexture",
        "/pbrMetallicRoughness/metallicRoughnessTexture",
        "/normalTexture",
        "/occlusionTexture",
        "/extensions/KHR_materials_diffuse_transmission/diffuseTransmissionColorTexture",
    ] {
        if let Some(texture) = material.pointer_mut(path) {
            texture["extensions"] = transform.clone();
        }
    }
}
