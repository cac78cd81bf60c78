//! How well whole fits do on pictures of real trees.

mod eye;
mod report;
mod row;
mod sheet;
mod spec;
#[cfg(test)]
mod tests;
mod verdict;
mod whole_fit;

pub(super) use spec::PhotographsSpec;

use super::record;
use super::{Journal, Kind, Outputs, Slice, Table, progress, stop};
use anyhow::{Context, bail};
use pleach_console::files;
use pleach_render::png_file;
use row::Row;
use std::path::{Path, PathBuf};

/// The species that was found for the picture of this name.
fn species_file(picture: &str) -> String {
    format!("fits/{picture}.toml")
}

fn sheet_file(set: &str) -> String {
    format!("sheet-{set}.png")
}

impl Kind for PhotographsSpec {
    fn columns(&self) -> anyhow::Result<Vec<String>> {
        record::columns(&Row::default())
    }

    fn files(&self, folder: &Path) -> (Vec<String>, Vec<PathBuf>) {
        let fits = self.pictures().map(|picture| species_file(&picture.name()));
        let sheets = self.sets().into_iter().map(sheet_file);
        let read = self.pictures().map(|picture| folder.join(&picture.file));
        let eye = Some(eye::path(folder)).filter(|path| path.exists());
        (fits.chain(sheets).collect(), read.chain(eye).collect())
    }

    /// The rows of each picture; a slice has the first pictures.
    fn rows(&self, folder: &Path, slice: Slice, journal: &mut Journal) -> anyhow::Result<()> {
        if self.evaluations.is_none() && !journal.is_kept() {
            bail!("fits that end by the clock find something else on every machine: nothing to check");
        }
        let (options, is_kept) = (self.options()?, journal.is_kept());
        let count = slice.take_of(self.pictures().len());
        let bar = progress("fits", count as u64);
        for picture in self.pictures().take(count) {
            let name = picture.name();
            let make = || {
                let found = whole_fit::fit(folder, picture, &options).with_context(|| name.clone())?;
                if is_kept && !stop::is_raised() {
                    let path = folder.join(species_file(&name));
                    files::make_folder(path.parent().unwrap_or(folder))?;
                    files::write_text(&path, &found.best.to_toml(&[]))?;
                }
                Ok(found.rows)
            };
            journal.job(|row: &Row| row.picture == name, make)?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn report(&self, folder: &Path, table: &Table, outputs: &Outputs) -> anyhow::Result<String> {
        let rows: Vec<Row> = table.records()?;
        let names: Vec<String> = self.pictures().map(|picture| picture.name()).collect();
        let eyes = eye::read(folder, &names)?;
        let sets = self.sets();
        for set in &sets {
            let pictures = self.pictures().filter(|picture| &*picture.set == *set);
            let sheet = sheet::draw(folder, pictures, &rows, species_file)?;
            let write = |file: &mut _| Ok(png_file::write_indexed(file, &sheet)?);
            files::write_whole(&outputs.path(&sheet_file(set))?, write)?;
        }
        Ok(report::report(&sets, &rows, &eyes))
    }
}
