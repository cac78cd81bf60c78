//! The outputs of an experiment: declared before anything runs, and never over its inputs.

use anyhow::{Context, bail};
use pleach_console::files;
use pleach_silhouette::picture::Picture;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Files that every experiment has: what to run, and what it is about.
const READ: [&str; 2] = ["experiment.toml", "README.md"];

/// The files of a run, in its folder.
#[derive(Debug)]
pub(super) struct Outputs {
    folder: PathBuf,
    declared: Vec<PathBuf>,
}

impl Outputs {
    /// `names` in `folder`, and the results that every experiment has.
    ///
    /// Fails if one of them is one of `inputs`, by whatever links, or if two of them are one file, be
    /// it only where case does not count.
    pub(super) fn declare(
        folder: &Path,
        names: impl IntoIterator<Item = String>,
        inputs: impl IntoIterator<Item = PathBuf>,
    ) -> anyhow::Result<Self> {
        let always = ["results.csv", "results.csv.partial"].map(str::to_owned);
        let declared: Vec<PathBuf> = always.into_iter().chain(names).map(PathBuf::from).collect();
        let inputs: Vec<PathBuf> = READ.map(|name| folder.join(name)).into_iter().chain(inputs).collect();
        let mut seen: BTreeMap<String, &Path> = BTreeMap::new();
        for name in &declared {
            let path = folder.join(name);
            for input in &inputs {
                if is_same(&path, input) {
                    bail!(
                        "{} would be written over, and the experiment reads it: move it out of the way, or \
                         give the goal another name",
                        input.display()
                    );
                }
            }
            let place = place(&path).to_string_lossy().to_lowercase();
            if let Some(first) = seen.insert(place, name) {
                bail!(
                    "{} and {} would be one file: give one of their goals another name",
                    first.display(),
                    name.display()
                );
            }
        }
        Ok(Self { folder: folder.to_owned(), declared })
    }

    /// The path of a declared file, its folder made.
    pub(super) fn path(&self, name: &str) -> anyhow::Result<PathBuf> {
        if !self.declared.iter().any(|declared| declared == Path::new(name)) {
            bail!("the experiment has not declared that it writes {name}");
        }
        let path = self.folder.join(name);
        files::make_folder(path.parent().unwrap_or(&self.folder))?;
        Ok(path)
    }

    pub(super) fn text(&self, name: &str, text: &str) -> anyhow::Result<()> {
        files::write_text(&self.path(name)?, text)
    }

    pub(super) fn picture(&self, name: &str, picture: &Picture) -> anyhow::Result<()> {
        files::write_whole(&self.path(name)?, |file| Ok(picture.write_png(file)?))
    }

    /// Writes the results and takes away what an unfinished run would need.
    pub(super) fn results(&self, table: &super::Table) -> anyhow::Result<()> {
        table.write(&self.path("results.csv")?)?;
        let partial = self.path("results.csv.partial")?;
        match std::fs::remove_file(&partial) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                Err(error).with_context(|| format!("cannot remove {}", partial.display()))
            }
            _ => Ok(()),
        }
    }
}

/// Whether writing `output` would change `input`: one file by symbolic or hard links, or one place.
fn is_same(output: &Path, input: &Path) -> bool {
    same_file::is_same_file(output, input).unwrap_or(false) || place(output) == place(input)
}

/// Where a file is or would be, links to its folder followed.
fn place(path: &Path) -> PathBuf {
    let folder = path.parent().unwrap_or(Path::new("."));
    // A folder that is not there yet is in one that is.
    let folder = folder.canonicalize().unwrap_or_else(|_| match folder.file_name() {
        Some(_) => place(folder),
        None => folder.to_owned(),
    });
    folder.join(path.file_name().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn declare(folder: &Path, names: &[&str], inputs: &[PathBuf]) -> Result<Outputs, String> {
        let names = names.iter().map(|name| (*name).to_owned());
        Outputs::declare(folder, names, inputs.to_vec()).map_err(|e| e.to_string())
    }

    #[test]
    fn inputs_are_not_written_over_whatever_they_are_called() {
        let folder = tempfile::tempdir().unwrap();
        let here = |name: &str| folder.path().join(name);
        std::fs::write(here("goal.png"), "goal").unwrap();
        std::fs::hard_link(here("goal.png"), here("hard.png")).unwrap();
        std::fs::create_dir(here("sub")).unwrap();
        let inputs = [here("sub/../goal.png")];
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(here("goal.png"), here("soft.png")).unwrap();
            std::os::unix::fs::symlink(folder.path(), here("loop")).unwrap();
            for name in ["soft.png", "loop/goal.png"] {
                assert!(
                    declare(folder.path(), &[name], &inputs).unwrap_err().contains("written over"),
                    "{name}"
                );
            }
        }
        for name in ["goal.png", "hard.png", "experiment.toml", "sub/../README.md"] {
            assert!(declare(folder.path(), &[name], &inputs).unwrap_err().contains("written over"), "{name}");
        }
        // An input that is not there is not made either.
        assert!(declare(folder.path(), &["late.png"], &[here("late.png")]).is_err());
        declare(folder.path(), &["other.png", "fits/goal.png"], &inputs).unwrap();
    }

    #[test]
    fn outputs_are_told_apart_and_are_the_only_ones() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["fits/a.png", "fits/A.png", "./fits/a.png"] {
            let error = declare(folder.path(), &["fits/a.png", name], &[]).unwrap_err();
            assert!(error.contains("one file"), "{error}");
        }
        assert!(declare(folder.path(), &["results.csv"], &[]).is_err());
        let outputs = declare(folder.path(), &["fits/a.svg"], &[]).unwrap();
        outputs.text("fits/a.svg", "a").unwrap();
        assert_eq!(std::fs::read_to_string(folder.path().join("fits/a.svg")).unwrap(), "a");
        assert!(outputs.text("b.svg", "b").unwrap_err().to_string().contains("not declared"));
    }
}
