//! All goals with what the first method made of them.

use super::goals::Problem;
use super::spec::TreefitSpec;
use super::{Outputs, fit_file, guess_file};
use crate::pictured::{self, SIZE};
use anyhow::Context;
use pleach_silhouette::{Bitmap, picture};
use std::path::Path;

/// Goals in a row where one generator is fitted.
const ACROSS: usize = 2;

pub(super) const SHEET: &str = "sheet.png";

/// Goal, first guess, fit, and a tree of the fit with another seed, from the species files of the fits.
/// Where several generators are fitted, the goal and the fit of each.
pub(super) fn draw(folder: &Path, spec: &TreefitSpec, outputs: &Outputs) -> anyhow::Result<()> {
    let kept = spec.kept();
    let mut cells = Vec::new();
    for goal in spec.goals() {
        let problem = Problem::read(folder, goal)?;
        let view = &problem.fit.goals[0];
        let small = |bitmap: &Bitmap| bitmap.downscaled(0.5);
        let drawn = |file: String, further: u64| -> anyhow::Result<Bitmap> {
            let path = folder.join(file);
            // Searches from random lists have no guess, and not every method fits every goal.
            if !path.exists() {
                return Ok(small(&Bitmap::new(SIZE, SIZE)));
            }
            let species = pleach_generators::species(&path.to_string_lossy())?;
            let seed = species.tree_seed.with_context(|| format!("{} has no seed", path.display()))?;
            Ok(small(&pictured::draw(&species, seed + further, problem.fit.foliage, view)?))
        };
        let name = &problem.name;
        cells.push((name.clone(), small(&view.goal)));
        if kept.len() > 1 {
            for (place, method) in kept.iter().enumerate() {
                let fit = drawn(fit_file(name, &kept, place), 0)?;
                cells.push((method.sort().to_owned(), fit));
            }
            continue;
        }
        let fit = fit_file(name, &kept, 0);
        cells.push(("first guess".to_owned(), drawn(guess_file(name), 0)?));
        cells.push(("fit".to_owned(), drawn(fit.clone(), 0)?));
        cells.push(("another seed".to_owned(), drawn(fit, 1)?));
    }
    let columns = if kept.len() > 1 { kept.len() + 1 } else { 4 * ACROSS };
    outputs.picture(SHEET, &picture::sheet(&cells, columns))
}
