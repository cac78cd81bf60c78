//! The folder of one fit: what it holds, who may write to it, and how a result is replaced.
//!
//! A run writes into the folder itself where there is no finished result, and into a stage inside it
//! where there is one. The result of an earlier fit is so untouched until the new one is complete.

mod lock;
pub(super) mod names;
mod swap;

use super::request::Request;
use crate::regular::{self, Found};
use crate::{files, output};
use anyhow::{Context, bail, ensure};
pub(super) use lock::Busy;
use lock::Lock;
use names::{CHECKPOINT, FILES, STATE, SUMMARY, is_ours};
use pleach_fit::is_checkpoint;
use serde_json::Value;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use swap::STAGE;

/// What to do about what is in the folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    /// Start, if nothing is lost by it.
    New,
    /// Start, whatever is there.
    Overwrite,
    /// Go on with an unfinished fit; start if it had not begun.
    Resume,
    /// Search on from where a finished fit ended.
    Continue,
    /// Go on with an unfinished fit, start if it had not begun, and leave a finished one as it is: for
    /// batches that several processes work at.
    Share,
}

/// The folder holds a finished fit of the same, and [`Mode::Share`] leaves it as it is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Finished {
    folder: PathBuf,
    pub(super) summary: Value,
}

impl std::fmt::Display for Finished {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} holds a finished fit of the same", self.folder.display())
    }
}

impl std::error::Error for Finished {}

/// A run folder as it is.
#[derive(Clone, Debug)]
pub(in crate::commands) struct RunFolder {
    home: PathBuf,
}

/// A run folder that is this fit's alone, until it is dropped.
#[derive(Debug)]
pub(super) struct Claim {
    home: PathBuf,
    /// Where files are written: the folder itself, or its stage.
    work: PathBuf,
    mode: Mode,
    /// Whether there is a checkpoint to go on from.
    resumes: bool,
    /// Folders that were made for this run, the deepest first.
    made: Vec<PathBuf>,
    lock: Option<Lock>,
}

impl RunFolder {
    pub(in crate::commands) const fn at(home: PathBuf) -> Self {
        Self { home }
    }

    pub(super) fn path(&self) -> &Path {
        &self.home
    }

    /// The summary of a finished fit, if the folder holds one.
    pub(in crate::commands) fn finished(&self) -> Option<Value> {
        let place = if swap::is_begun(&self.home) { self.home.join(STAGE) } else { self.home.clone() };
        // In the middle of a swap the summary may be at either place.
        let text = regular::read_text(&place.join(SUMMARY))
            .or_else(|_| regular::read_text(&self.home.join(SUMMARY)))
            .ok()?;
        let summary: Value = serde_json::from_str(&text).ok()?;
        (!self.home.join(CHECKPOINT).exists() && summary["finished"] == true).then_some(summary)
    }

    /// Whether there is a fit to go on with.
    pub(super) fn is_unfinished(&self) -> bool {
        self.checkpoint().is_some()
    }

    /// Whether what is there was left by a fit that is not finished: a checkpoint, and no other file that is called
    /// so, or a summary that is not a finished one's.
    pub(in crate::commands) fn was_left_unfinished(&self) -> bool {
        let checkpoint = self.checkpoint().map(|place| place.join(CHECKPOINT));
        checkpoint.is_some_and(|file| is_checkpoint(&file)) || self.home.join(SUMMARY).is_file()
    }

    /// The folder in which an unfinished fit is, if there is one.
    fn checkpoint(&self) -> Option<PathBuf> {
        if swap::is_begun(&self.home) {
            return None;
        }
        [self.home.join(STAGE), self.home.clone()].into_iter().find(|place| place.join(CHECKPOINT).exists())
    }

    /// Where the files are of a run that has just ended.
    pub(super) fn of_results(&self, interrupted: bool) -> PathBuf {
        let stage = self.home.join(STAGE);
        if interrupted && stage.join(SUMMARY).exists() { stage } else { self.home.clone() }
    }

    /// Whether another process is writing to the folder.
    pub(super) fn is_busy(&self) -> bool {
        self.home.is_dir() && Lock::take(&self.home).is_err_and(|error| error.is::<Busy>())
    }

    /// Tells whether `mode` may do what it says, and changes nothing.
    pub(super) fn check(&self, mode: Mode, request: &Request) -> anyhow::Result<()> {
        let path = self.home.display();
        if self.home.exists() {
            ensure!(self.home.is_dir(), "{path} is a file, expected a folder for the run");
        }
        regular::check_file(&self.home.join(lock::LOCK))?;
        let stage = self.home.join(STAGE);
        regular::check_folder(&stage)?;
        for place in [&self.home, &stage] {
            for name in FILES {
                let file = place.join(name);
                // A link to a file is replaced, never followed; but a search does not go on from one.
                let found = Found::at(&file)?;
                let is_state = [CHECKPOINT, STATE].contains(&name);
                let is_fine = matches!(found, Found::Nothing | Found::File)
                    || found == Found::Link && !is_state && !file.is_dir();
                ensure!(is_fine, "{} is {found}, and a fit writes a file of that name", file.display());
            }
        }
        let finished = self.finished();
        match mode {
            Mode::Overwrite => Ok(()),
            Mode::New if self.is_unfinished() => {
                bail!("{path} holds an unfinished fit; --resume goes on with it, --overwrite starts over")
            }
            Mode::Share if self.is_unfinished() => Ok(()),
            Mode::New | Mode::Share => {
                let differences = finished.map(|summary| request.differences(&summary)).unwrap_or_default();
                ensure!(
                    differences.is_empty(),
                    "{path} holds a finished fit of something else: {}; --overwrite replaces it, another --out \
                     keeps both",
                    differences.join(", ")
                );
                Ok(())
            }
            Mode::Resume => {
                ensure!(
                    self.is_unfinished() || finished.is_none(),
                    "{path} holds a finished fit, and no checkpoint to resume from; --continue searches on"
                );
                Ok(())
            }
            Mode::Continue => {
                ensure!(
                    finished.is_some() || !self.is_unfinished(),
                    "{path} holds an unfinished fit; end it with --resume before you --continue"
                );
                ensure!(finished.is_some(), "{path} holds no finished fit to continue");
                ensure!(
                    self.home.join(STATE).exists(),
                    "{path} holds a finished fit without {STATE}; --from {} starts a new search from it",
                    self.home.join("best.toml").display()
                );
                Ok(())
            }
        }
    }

    /// Takes the folder for a run, which will begin at [`Claim::begin`]; nothing of an earlier run is
    /// changed before that.
    pub(super) fn claim(self, mode: Mode, request: &Request) -> anyhow::Result<Claim> {
        self.check(mode, request)?;
        let made = make_folders(&self.home)?;
        let lock = match Lock::take(&self.home) {
            Ok(lock) => lock,
            Err(error) => {
                remove_empty(&made);
                return Err(error);
            }
        };
        let mut claim = Claim {
            home: self.home.clone(),
            work: self.home.clone(),
            mode,
            resumes: false,
            made,
            lock: Some(lock),
        };
        swap::finish(&self.home)?;
        // Another run may have ended since.
        self.check(mode, request)?;
        for place in [&self.home, &self.home.join(STAGE)] {
            swap::remove_temporary(place)?;
        }
        if let Some(summary) = self.finished() {
            if mode == Mode::Share && !self.is_unfinished() {
                return Err(Finished { folder: self.home, summary }.into());
            }
            claim.work = self.home.join(STAGE);
        }
        if matches!(mode, Mode::Resume | Mode::Continue | Mode::Share) {
            match self.checkpoint() {
                Some(place) => (claim.work, claim.resumes) = (place, true),
                None if mode != Mode::Resume => {}
                None => {
                    output::note(format!("{} holds no checkpoint yet: the fit starts", self.home.display()))
                }
            }
        }
        Ok(claim)
    }
}

impl Claim {
    /// Makes room for the new run: only now is anything of an unfinished one removed.
    pub(super) fn begin(&mut self) -> anyhow::Result<()> {
        self.made.extend(make_folders(&self.work)?);
        if !self.resumes {
            swap::clear(&self.work)?;
        }
        if self.mode == Mode::Continue && !self.resumes {
            let from = self.home.join(STATE);
            let state = std::fs::read(&from).with_context(|| format!("cannot read {}", from.display()))?;
            files::write_whole(&self.checkpoint(), |file| Ok(file.write_all(&state)?))?;
            self.resumes = true;
        }
        Ok(())
    }

    /// A file of the run while it is unfinished.
    pub(super) fn file(&self, name: &str) -> PathBuf {
        debug_assert!(is_ours(name), "{name} would stay when the run is replaced");
        self.work.join(name)
    }

    /// Whether the search goes on from a checkpoint, which is there after [`Claim::begin`].
    pub(super) const fn resumes(&self) -> bool {
        self.resumes || matches!(self.mode, Mode::Continue)
    }

    /// Where the state of the search is kept while it runs.
    pub(super) fn checkpoint(&self) -> PathBuf {
        self.work.join(CHECKPOINT)
    }

    /// Makes the folder again if somebody removed it while the search ran.
    pub(super) fn ensure_there(&self) -> anyhow::Result<()> {
        files::make_folder(&self.work)
    }

    /// The run is complete, its summary written: it takes its place.
    pub(super) fn finish(&self) -> anyhow::Result<()> {
        let checkpoint = self.checkpoint();
        if checkpoint.exists() {
            swap::rename(&checkpoint, &self.work.join(STATE))?;
        }
        if self.work == self.home { Ok(()) } else { swap::swap(&self.home) }
    }
}

impl Drop for Claim {
    /// Gives the folder back, and removes folders that this run made and left empty.
    fn drop(&mut self) {
        drop(self.lock.take());
        remove_empty(&self.made);
    }
}

/// Makes `path` and the folders above it; returns those that were made, the deepest first.
fn make_folders(path: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let missing = path.ancestors().take_while(|p| !p.as_os_str().is_empty() && !p.exists());
    let missing: Vec<PathBuf> = missing.map(Path::to_owned).collect();
    files::make_folder(path)?;
    Ok(missing)
}

/// Removes those of `folders` that hold nothing.
fn remove_empty(folders: &[PathBuf]) {
    for folder in folders {
        // A folder that is not empty stays, and that is all that can go wrong.
        let _ = std::fs::remove_dir(folder);
    }
}
