//! The state of a fit in a file that survives a crash at any moment.
//!
//! A checkpoint is one line of text and a binary body:
//!
//! ```text
//! pleach-checkpoint 6 weber-penn/evolution <length of the body> <checksum, 8 hexadecimal digits>
//! ```
//!
//! The line names the program, the number of the format, and the name of the run: a family of generators and an
//! optimiser. The checksum (CRC-32) is of the line up to it and of the body. The body is [`Checkpoint`] in the
//! postcard format, where numbers keep their bits, so that a resumed run is the same run.
//!
//! It is written to a temporary file in the same folder, flushed to the disk, and renamed over the
//! old one: a reader finds the old state or the new, never half of one.

mod envelope;
mod error;

pub use error::{BodyProblem, CheckpointError};

use super::fingerprint::Fingerprint;
use crate::control::Row;
use crate::search::SearchState;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::fs::{self, File};
use std::io::{self, Read as _, Write as _};
use std::path::Path;

#[cfg(test)]
pub(crate) use envelope::sealed;

/// Whether there is a checkpoint at `path`: a regular file that begins as one, of any format and run.
///
/// It may still be damaged or belong to another run; reading it will tell. False for a file that cannot be read.
#[must_use]
pub fn is_checkpoint(path: &Path) -> bool {
    // Reading a pipe would block.
    if !path.metadata().is_ok_and(|file| file.is_file()) {
        return false;
    }
    let mut start = [0; envelope::BEGINNING];
    File::open(path).and_then(|mut file| file.read_exact(&mut start)).is_ok() && envelope::begins(&start)
}

/// The contents of a checkpoint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Checkpoint<M> {
    /// The identity of the run. It comes first: another optimiser's state would not parse, which is a worse error
    /// message.
    pub(crate) fingerprint: Fingerprint,
    /// Where the search stands.
    pub(crate) search: SearchState<M>,
    /// One row for every finished generation.
    pub(crate) history: Vec<Row>,
    /// Seconds used so far by the caller's clock.
    pub(crate) elapsed_s: f64,
    /// How many of them had passed when the search began.
    pub(crate) before_search_s: f64,
}

impl<M: Serialize> Checkpoint<M> {
    /// Writes the checkpoint to `path`, at once or not at all.
    ///
    /// # Errors
    /// [`CheckpointError::Io`]; what was at `path` is then still there.
    pub(crate) fn write(&self, path: &Path) -> Result<(), CheckpointError> {
        let io = |action| move |source| CheckpointError::Io { path: path.to_owned(), action, source };
        let body = postcard::to_stdvec(self).map_err(io::Error::other).map_err(io("cannot be serialized"))?;
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(".");
        let write = || -> io::Result<()> {
            // A new file under an unused name: no existing link is followed, and two programs do not write into one
            // file. It is removed if anything fails.
            let mut builder = tempfile::Builder::new();
            #[cfg(unix)]
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
            let mut file = builder.prefix(&name).suffix(".tmp").tempfile_in(folder)?;
            file.write_all(&envelope::sealed(self.fingerprint.name(), &body))?;
            file.as_file().sync_all()?;
            file.persist(path)?;
            Ok(())
        };
        write().map_err(io("cannot be written"))?;
        // Flush the folder too, so that the rename survives a crash of the machine. Not every file system
        // allows that, and a killed process does not need it: best effort.
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
        Ok(())
    }
}

impl<M: DeserializeOwned> Checkpoint<M> {
    /// Reads the checkpoint at `path` of the run that `fingerprint` describes.
    ///
    /// # Errors
    /// Every variant of [`CheckpointError`]; a damaged file is always detected.
    pub(crate) fn read(path: &Path, fingerprint: &Fingerprint) -> Result<Self, CheckpointError> {
        let path_buf = || path.to_owned();
        let io = |source| CheckpointError::Io { path: path_buf(), action: "cannot be read", source };
        let wrong = |problem| CheckpointError::WrongBody { path: path_buf(), problem };
        let bytes = fs::read(path).map_err(io)?;
        let body = envelope::opened(path, &bytes)?;
        let (found, _) = postcard::take_from_bytes::<Fingerprint>(body)
            .map_err(|error| wrong(BodyProblem::Form(error)))?;
        let differences = found.differences(fingerprint);
        if !differences.is_empty() {
            return Err(CheckpointError::OtherRun { path: path_buf(), differences });
        }
        let (checkpoint, rest) =
            postcard::take_from_bytes::<Self>(body).map_err(|error| wrong(BodyProblem::Form(error)))?;
        if !rest.is_empty() {
            return Err(wrong(BodyProblem::Trailing { bytes: rest.len() }));
        }
        checkpoint.check().map_err(wrong)?;
        Ok(checkpoint)
    }
}

/// Most seconds that a run can have used: three hundred years.
const MAX_SECONDS: f64 = 1e10;
/// Most trees that a run can have evaluated.
const MAX_EVALUATIONS: u64 = 1 << 53;

impl<M> Checkpoint<M> {
    /// Refuses contents that the format allows and that no run writes.
    fn check(&self) -> Result<(), BodyProblem> {
        for (name, seconds) in [("elapsed_s", self.elapsed_s), ("before_search_s", self.before_search_s)] {
            if !(0.0..=MAX_SECONDS).contains(&seconds) {
                return Err(BodyProblem::Seconds { name, seconds, max: MAX_SECONDS });
            }
        }
        if self.before_search_s > self.elapsed_s {
            return Err(BodyProblem::BeforeSearch);
        }
        let (rows, generations) = (self.history.len() as u64, self.search.generation);
        if rows != generations {
            return Err(BodyProblem::Rows { rows, generations });
        }
        for (row, expected) in self.history.iter().zip(1..) {
            if row.generation != expected {
                return Err(BodyProblem::Row { row: expected, generation: row.generation });
            }
        }
        let evaluations = self.search.evaluations;
        let adds_up = self.history.windows(2).all(|pair| pair[0].evaluations <= pair[1].evaluations)
            && self.history.last().is_none_or(|last| last.evaluations <= evaluations)
            && evaluations <= MAX_EVALUATIONS;
        if !adds_up {
            return Err(BodyProblem::Evaluations);
        }
        if evaluations > 0 && self.search.best.is_none() {
            return Err(BodyProblem::NoBest { evaluations });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
