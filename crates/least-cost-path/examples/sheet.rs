//! Draws the silhouettes of all species on one sheet, roots included: `docs/least-cost-path.png`.
//!
//! ```sh
//! cargo run -p pleach-least-cost-path --example sheet -- docs/least-cost-path.png
//! ```

use pleach_least_cost_path::LeastCostPathFamily;
use pleach_silhouette::picture::sheet;
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::{Family as _, Parts, StemKind, Tree, species};
use std::fs::File;
use std::io::{BufWriter, Error};

const SIZE: u32 = 280;
const COLUMNS: usize = 5;
const SEED: u64 = 1;

/// The frame of a tree with its roots, which are below the ground.
fn frame(tree: &Tree) -> Frame {
    let frame = Frame::automatic(tree, &View::FRONT, Parts::LEAFY, SIZE, SIZE);
    let roots = tree.stems.iter().filter(|stem| stem.kind == StemKind::Root);
    let depth = roots.flat_map(|stem| tree.knots_of(stem)).map(|knot| -knot.point.z).fold(0.0, f64::max);
    let above = f64::from(SIZE) * frame.meters_per_pixel;
    let meters_per_pixel = (above + depth) / f64::from(SIZE);
    Frame { meters_per_pixel, ground_row: above / meters_per_pixel, ..frame }
}

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1).ok_or_else(|| Error::other("expected the PNG to write"))?;
    let mut cells = Vec::new();
    for (name, _) in LeastCostPathFamily.presets() {
        let Some(species) = species::preset(&LeastCostPathFamily, name) else { continue };
        let tree = species.grow(SEED).map_err(Error::other)?;
        let mut bitmap = Bitmap::default();
        Rasterizer::new().draw(&tree, &View::FRONT, &frame(&tree), Parts::ALL, &mut bitmap);
        cells.push(((*name).to_owned(), bitmap));
    }
    sheet(&cells, COLUMNS).write_png(&mut BufWriter::new(File::create(path)?))
}
