//! Draws species: `cargo run --release -p pleach-mesh --example preview -- FOLDER SIZE [SPECIES …]`.

use pleach_mesh::{Palette, Preview, PreviewSettings};
use pleach_tree::Growth;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [folder, size, names @ ..] = &arguments[..] else {
        return Err("expected: FOLDER SIZE [SPECIES …]".into());
    };
    let size: u32 = size.parse()?;
    for name in
        pleach_generators::names().into_iter().filter(|n| names.is_empty() || names.iter().any(|o| o == n))
    {
        let species = pleach_generators::species(name)?;
        let tree = species.grow_with(&Growth { parallel: true, ..Growth::seed(1) })?;
        let palette = Palette::of(&species, None);
        let settings = PreviewSettings { width: size, height: size, ..PreviewSettings::default() };
        let picture = Preview::new(&tree, &palette, size).picture(&settings);
        let mut file = std::fs::File::create(format!("{folder}/{name}.png"))?;
        pleach_mesh::png_file::write(&mut file, &[picture], 100)?;
    }
    Ok(())
}
