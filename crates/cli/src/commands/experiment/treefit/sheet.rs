//! All goals with what the first method made of them.

use super::SIZE;
use super::goals::{self, Problem};
use super::spec::TreefitSpec;
use crate::files;
use anyhow::Context;
use pleach_fit::Genome;
use pleach_silhouette::{Bitmap, picture};
use std::path::Path;

/// Pictures in a row: two goals.
const COLUMNS: usize = 8;

/// Goal, first guess, fit, and a tree of the fit with another seed, from the species files of the fits.
pub(super) fn draw(folder: &Path, spec: &TreefitSpec) -> anyhow::Result<()> {
    let fits = folder.join("fits");
    let mut cells = Vec::new();
    for goal in &spec.goals {
        let problem = Problem::of(folder, goal)?;
        let view = &problem.fit.goals[0];
        let small = |bitmap: &Bitmap| bitmap.shrunk(0.5);
        let drawn = |file: String, further: u64| -> anyhow::Result<Bitmap> {
            let path = fits.join(file);
            let species = pleach_generators::species(&path.to_string_lossy())?;
            let seed = species.tree_seed.with_context(|| format!("{} has no seed", path.display()))?;
            let genome = Genome::new(species.params.values().to_vec(), seed + further);
            Ok(small(&goals::draw(&problem.fit, &genome, view)?))
        };
        let name = &problem.name;
        cells.push((name.clone(), small(&view.goal)));
        let guess = format!("{name}-guess.toml");
        // Searches from random lists have none.
        let guess =
            if fits.join(&guess).exists() { drawn(guess, 0)? } else { small(&Bitmap::new(SIZE, SIZE)) };
        cells.push(("first guess".to_owned(), guess));
        cells.push(("fit".to_owned(), drawn(format!("{name}.toml"), 0)?));
        cells.push(("another seed".to_owned(), drawn(format!("{name}.toml"), 1)?));
    }
    let picture = picture::sheet(&cells, COLUMNS);
    files::write_whole(&folder.join("sheet.png"), |file| Ok(picture.write_png(file)?))
}
