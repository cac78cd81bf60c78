//! Grows a species and writes it as GLB: `cargo run --release -p pleach-mesh --example export -- acer 1 acer.glb`.

use pleach_mesh::write::glb::{Glb, Placed, Scene};
use pleach_mesh::{LeafStyle, MeshSettings, Mesher, Palette, Rig, send};
use pleach_tree::Growth;
use std::io::BufWriter;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [name, seed, path, options @ ..] = &arguments[..] else {
        return Err("expected: SPECIES SEED FILE.glb [wind] [rig] [simple] [cards] [instanced]".into());
    };
    let has = |option: &str| options.iter().any(|o| o == option);
    let species = pleach_generators::species(name)?;
    let tree = species.grow_with(&Growth { parallel: true, ..Growth::seed(seed.parse()?) })?;
    let leaves = match () {
        () if has("simple") => LeafStyle::Simple,
        () if has("cards") => LeafStyle::CrossedCards,
        () => LeafStyle::Outline,
    };
    let settings = MeshSettings { leaves, wind: has("wind"), ..MeshSettings::default() };
    let rig = has("rig").then(|| Rig::of(&tree));
    let mut mesher = Mesher::new(&tree, settings);
    if let Some(rig) = &rig {
        mesher = mesher.with_rig(rig);
    }
    if has("instanced") {
        mesher = mesher.with_instanced_leaves();
    }
    let scene = Scene {
        name: species.name.clone(),
        palette: Palette::of(&species, None),
        extras: serde_json::json!({"species": species.name, "seed": seed}),
        placed: vec![Placed::at_origin(&species.name, 1)],
        rig: rig.as_ref(),
        pictures: Vec::new(),
    };
    let file = BufWriter::new(std::fs::File::create(path)?);
    send(&[mesher], &mut Glb::new(file, &scene))?;
    Ok(())
}
