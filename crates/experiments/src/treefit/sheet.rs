//! All goals with what the first method made of them.

use super::goals::{self, Problem};
use super::spec::TreefitSpec;
use super::{Outputs, fit_file, guess_file};
use crate::pictured::SIZE;
use anyhow::Context;
use pleach_silhouette::{Bitmap, picture};
use std::path::Path;

/// Pictures in a row: two goals.
const COLUMNS: usize = 8;

pub(super) const SHEET: &str = "sheet.png";

/// Goal, first guess, fit, and a tree of the fit with another seed, from the species files of the fits.
pub(super) fn draw(folder: &Path, spec: &TreefitSpec, outputs: &Outputs) -> anyhow::Result<()> {
    let mut cells = Vec::new();
    for goal in spec.goals() {
        let problem = Problem::of(folder, goal)?;
        let view = &problem.fit.goals[0];
        let small = |bitmap: &Bitmap| bitmap.downscaled(0.5);
        let drawn = |file: String, further: u64| -> anyhow::Result<Bitmap> {
            let path = folder.join(file);
            let species = pleach_generators::species(&path.to_string_lossy())?;
            let seed = species.tree_seed.with_context(|| format!("{} has no seed", path.display()))?;
            Ok(small(&goals::draw(&species, seed + further, problem.fit.foliage, view)?))
        };
        let name = &problem.name;
        cells.push((name.clone(), small(&view.goal)));
        let guess = guess_file(name);
        // Searches from random lists have none.
        let guess =
            if folder.join(&guess).exists() { drawn(guess, 0)? } else { small(&Bitmap::new(SIZE, SIZE)) };
        cells.push(("first guess".to_owned(), guess));
        cells.push(("fit".to_owned(), drawn(fit_file(name), 0)?));
        cells.push(("another seed".to_owned(), drawn(fit_file(name), 1)?));
    }
    let picture = picture::sheet(&cells, COLUMNS);
    outputs.picture(SHEET, &picture)
}
