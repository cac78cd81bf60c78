//! Trees side by side.

use pleach_mesh::Palette;
use pleach_render::{Picture, Preview, PreviewSettings};
use pleach_tree::{Species, Tree};

/// Trees in a row.
const ACROSS: usize = 4;

/// A shaded picture of `size` × `size` pixels of `tree`, which is of `species`.
pub(super) fn render(tree: &Tree, species: &Species, size: u32) -> Picture {
    let palette = Palette::new(&species.appearance, None);
    let tree = palette.dressed(tree);
    let settings = PreviewSettings { width: size, height: size, ..PreviewSettings::default() };
    Preview::new(&tree, &palette, size).picture(&settings)
}

/// Squares of `size` pixels in rows of four, from the upper left; places without a picture are white.
pub(super) fn sheet(pictures: &[Option<Picture>], size: u32) -> Picture {
    let (columns, rows) = (ACROSS.min(pictures.len()), pictures.len().div_ceil(ACROSS));
    let (width, height) = (columns as u32 * size, rows as u32 * size);
    let mut sheet = Picture { width, height, rgba: vec![255; width as usize * height as usize * 4] };
    for (place, picture) in pictures.iter().enumerate() {
        if let Some(picture) = picture {
            sheet.paste(picture, (place % ACROSS) as u32 * size, (place / ACROSS) as u32 * size);
        }
    }
    sheet
}
