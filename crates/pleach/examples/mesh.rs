//! A tree as a mesh and as a shaded picture: `cargo run --release -p pleach --example mesh -- acer`

#![allow(clippy::print_stdout, reason = "an example says what it has done")]

use pleach::{Mesh, MeshSettings, Palette, Season};
use std::error::Error;
use std::fs::File;

fn main() -> Result<(), Box<dyn Error>> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "acer".to_owned());
    let species = pleach::species(&name)?;
    let mut tree = species.grow(1)?;
    let palette = Palette::new(&species.appearance, Some(Season::Autumn));
    palette.apply_season(&mut tree); // a winter tree would lose its leaves

    let mesh = Mesh::new(&tree, MeshSettings::with_tolerance(0.005));
    println!("{} triangles", mesh.triangles());
    pleach::write_glb(File::create(format!("{name}.glb"))?, &name, &tree, &palette)?;
    pleach::render(&tree, &palette, 512).write_png(&mut File::create(format!("{name}.png"))?)?;
    println!("wrote {name}.glb and {name}.png");
    Ok(())
}
