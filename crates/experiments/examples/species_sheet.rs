//! The fifteen species, ours beside the reference generator's: the contact sheet of the README.
//!
//! ```text
//! cargo run --release -p pleach-experiments --example species_sheet -- tests/data/silhouettes docs/species.png
//! ```

use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View, picture};
use pleach_tree::Parts;
use std::error::Error;
use std::path::Path;

/// Pixels of a cell.
const SIDE: u32 = 120;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [reference, out] = arguments.as_slice() else {
        return Err("expected the folder of the reference silhouettes and the picture to write".into());
    };
    let mut cells = Vec::new();
    for names in pleach_generators::HEWITT_2017.chunks(5) {
        for foliage in [true, false] {
            for name in names {
                let label = if foliage { (*name).replace('_', " ") } else { String::new() };
                cells.push((label, drawn(name, foliage)?));
                cells.push(("reference".to_owned(), read(reference, name, foliage)?));
            }
        }
    }
    let sheet = picture::sheet(&cells, 10);
    sheet.write_png(&mut std::fs::File::create(out)?)?;
    Ok(())
}

fn drawn(name: &str, foliage: bool) -> Result<Bitmap, Box<dyn Error>> {
    let tree = pleach_generators::species(name)?.grow(1)?;
    let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIDE, SIDE);
    let mut bitmap = Bitmap::default();
    Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::with_foliage(foliage), &mut bitmap);
    Ok(bitmap)
}

fn read(folder: &str, name: &str, foliage: bool) -> Result<Bitmap, Box<dyn Error>> {
    let file = format!("{name}_1_front{}.png", if foliage { "" } else { "_bare" });
    let options = GoalOptions { max_side: Some(SIDE), ..GoalOptions::default() };
    Ok(Goal::load(Path::new(folder).join(file), &options)?.bitmap)
}
