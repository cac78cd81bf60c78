//! The exam as it is asked for on the command line: its `experiment.toml` is written.

use super::contestant::Contestant;
use super::goal::{AROUND, Goal, Origin, only};
use super::goals;
use crate::spec::Source;
use anyhow::{Context, bail};
use pleach_console::files;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Which part of the exam is asked for; by default all of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct BenchOptions {
    /// The rows of the leaderboard.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows: Option<Vec<String>>,
    /// Sets of goals, or goals, by name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub only: Option<Vec<String>>,
    /// Goals around each species, 1 to 4.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub around: Option<u64>,
    /// Trees of searches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trees: Option<Vec<u64>>,
    /// Seconds of fits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<Vec<f64>>,
    /// A folder of pictures of trees.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub photographs: Option<PathBuf>,
}

/// An `experiment.toml`.
#[derive(Serialize)]
struct Written<'a> {
    kind: &'static str,
    #[serde(flatten)]
    options: &'a BenchOptions,
}

impl BenchOptions {
    /// The name of a row, if there is such a one.
    ///
    /// # Errors
    /// With the nearest name, and all of them.
    pub fn row(name: &str) -> Result<String, String> {
        let known = name.parse::<Contestant>().map_err(|error| error.to_string())?;
        Ok(known.name().to_owned())
    }

    /// The goals that are asked for.
    pub(super) fn origins(&self) -> anyhow::Result<Vec<Origin>> {
        let all = Origin::all(self.around.unwrap_or(AROUND), self.photographs.as_deref())?;
        match &self.only {
            None => Ok(all),
            Some(words) => {
                let words: Vec<&str> = words.iter().map(String::as_str).collect();
                only(all, &words).map_err(anyhow::Error::msg)
            }
        }
    }

    pub(super) fn goals(&self) -> anyhow::Result<Vec<Goal>> {
        goals(&self.origins()?)
    }

    /// Writes the `experiment.toml` of this exam into `folder`, which is made. One of another exam is only replaced
    /// where it is to be `overwritten`; that of another kind of experiments never is.
    ///
    /// # Errors
    /// If an option says what cannot be, if another exam is there, or if the file cannot be written.
    pub fn write(&self, folder: &Path, overwritten: bool) -> anyhow::Result<()> {
        self.origins()?;
        let mut options = self.clone();
        if let Some(photographs) = &self.photographs {
            // The file is in another folder than the one that the path is from.
            let whole = photographs.canonicalize();
            options.photographs =
                Some(whole.with_context(|| format!("cannot open {}", photographs.display()))?);
        }
        let text = toml::to_string(&Written { kind: "bench", options: &options })?;
        files::make_folder(folder)?;
        let path = folder.join("experiment.toml");
        if path.exists() {
            let found = Source::read(folder)?;
            if found.text == text {
                return Ok(());
            }
            if found.head()?.kind != crate::spec::Kind::Bench {
                bail!("{} is of another kind of experiments: choose another folder", path.display());
            }
            if !overwritten {
                bail!(
                    "{} is of an exam with other options: give the same ones, choose another folder, or \
                     --overwrite starts over",
                    path.display()
                );
            }
        }
        files::write_text(&path, &text)
    }
}
