//! The state of a fit in a file that survives a crash at any moment.
//!
//! A checkpoint is one line of header and one of JSON:
//!
//! ```text
//! pleach-checkpoint 3 <length of the body in bytes> <checksum of the body, 16 hexadecimal digits>
//! {"fingerprint": …, "search": …, "history": […], "elapsed_s": …}
//! ```
//!
//! It is written to a temporary file in the same folder, flushed to the disk, and renamed over the
//! old one: whoever reads it finds the old state or the new, never half of one. Costs and values are
//! written as their bits, so that a resumed run is the same run.

use crate::fingerprint::{Fingerprint, Fnv};
use crate::history::Row;
use crate::search::SearchState;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

/// The number in the header; files of other versions are refused.
const VERSION: u32 = 3;
const MAGIC: &str = "pleach-checkpoint";

/// What a checkpoint holds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint<M> {
    /// What the run was asked to do.
    pub fingerprint: Fingerprint,
    /// Where the search stands.
    pub search: SearchState<M>,
    /// One row for every finished generation.
    pub history: Vec<Row>,
    /// Seconds used so far by the caller's clock.
    pub elapsed_s: f64,
    /// How many of them had passed when the search began.
    pub before_search_s: f64,
}

/// Why a checkpoint was not read or written.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// The file could not be read or written.
    #[error("{path}: {action}: {source}")]
    Io {
        /// The checkpoint's path.
        path: PathBuf,
        /// What was tried.
        action: &'static str,
        /// What the operating system said.
        source: io::Error,
    },
    /// The file is no checkpoint at all.
    #[error("{path} is not a checkpoint of pleach")]
    NotACheckpoint {
        /// The file.
        path: PathBuf,
    },
    /// A checkpoint of another version of pleach.
    #[error("{path} is a checkpoint of version {found}, this pleach reads version {VERSION}")]
    OtherVersion {
        /// The file.
        path: PathBuf,
        /// The version in its header.
        found: String,
    },
    /// The file ends too early, or goes on too long.
    #[error("{path} is damaged: the header promises {expected} bytes, there are {found}")]
    WrongLength {
        /// The file.
        path: PathBuf,
        /// Length in the header.
        expected: usize,
        /// Length that is there.
        found: usize,
    },
    /// Bytes have changed.
    #[error("{path} is damaged: the checksum does not match")]
    WrongChecksum {
        /// The file.
        path: PathBuf,
    },
    /// The body has not the shape that this version writes.
    #[error("{path} does not hold the state of this optimiser: {message}")]
    WrongBody {
        /// The file.
        path: PathBuf,
        /// What the parser said.
        message: String,
    },
    /// A checkpoint of another run.
    #[error("{path} is the checkpoint of another run: it differs in {}", differences.join(", "))]
    OtherRun {
        /// The file.
        path: PathBuf,
        /// What differs: goal, species, settings …
        differences: Vec<&'static str>,
    },
}

impl<M: Serialize> Checkpoint<M> {
    /// Writes the checkpoint to `path`, at once or not at all.
    ///
    /// # Errors
    /// [`CheckpointError::Io`]; what was at `path` is then still there.
    pub fn write(&self, path: &Path) -> Result<(), CheckpointError> {
        let io = |action| move |source| CheckpointError::Io { path: path.to_owned(), action, source };
        let body =
            serde_json::to_vec(self).map_err(io::Error::other).map_err(io("cannot be put into words"))?;
        let header = format!("{MAGIC} {VERSION} {} {:016x}\n", body.len(), Fnv::of(&body));
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut name = path.file_name().unwrap_or_default().to_owned();
        name.push(".");
        let write = || -> io::Result<()> {
            // A new file under a name that nobody has: no link that lies there is followed, and two
            // programs do not write into one file. It goes if anything fails.
            let mut builder = tempfile::Builder::new();
            #[cfg(unix)]
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
            let mut file = builder.prefix(&name).suffix(".tmp").tempfile_in(folder)?;
            file.write_all(header.as_bytes())?;
            file.write_all(&body)?;
            file.as_file().sync_all()?;
            file.persist(path)?;
            Ok(())
        };
        write().map_err(io("cannot be written"))?;
        // The rename itself lasts once the folder is on the disk. Not every file system lets folders
        // be flushed, and none needs it against a killed process: best effort.
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
        Ok(())
    }
}

impl<M: DeserializeOwned> Checkpoint<M> {
    /// Reads the checkpoint at `path` of the run that `fingerprint` describes.
    ///
    /// # Errors
    /// Every variant of [`CheckpointError`]; a damaged file is never taken for a good one.
    pub fn read(path: &Path, fingerprint: &Fingerprint) -> Result<Self, CheckpointError> {
        let path_buf = || path.to_owned();
        let bytes = fs::read(path).map_err(|source| CheckpointError::Io {
            path: path_buf(),
            action: "cannot be read",
            source,
        })?;
        let body = check_envelope(path, &bytes)?;
        // The fingerprint first: another optimiser's state would not parse, and that says less.
        let head: Head = serde_json::from_slice(body)
            .map_err(|e| CheckpointError::WrongBody { path: path_buf(), message: e.to_string() })?;
        let differences = head.fingerprint.differences(fingerprint);
        if !differences.is_empty() {
            return Err(CheckpointError::OtherRun { path: path_buf(), differences });
        }
        let wrong = |message: String| CheckpointError::WrongBody { path: path_buf(), message };
        let checkpoint: Self = serde_json::from_slice(body).map_err(|e| wrong(e.to_string()))?;
        checkpoint.check().map_err(wrong)?;
        Ok(checkpoint)
    }
}

/// Most seconds that a run can have used: three hundred years.
const MAX_SECONDS: f64 = 1e10;

impl<M> Checkpoint<M> {
    /// What no run writes though the file's form allows it.
    fn check(&self) -> Result<(), String> {
        for (name, seconds) in [("elapsed_s", self.elapsed_s), ("before_search_s", self.before_search_s)] {
            if !(0.0..=MAX_SECONDS).contains(&seconds) {
                return Err(format!("`{name}` is {seconds}, expected 0 to {MAX_SECONDS:e}"));
            }
        }
        if self.before_search_s > self.elapsed_s {
            return Err("`before_search_s` is more than `elapsed_s`".to_owned());
        }
        let (rows, generations) = (self.history.len() as u64, self.search.generation);
        if rows != generations {
            return Err(format!("the history has {rows} rows for {generations} generations"));
        }
        let number = |i: usize| i as u64 + 1;
        if let Some((i, row)) = self.history.iter().enumerate().find(|(i, row)| row.generation != number(*i))
        {
            return Err(format!("row {} of the history is of generation {}", i + 1, row.generation));
        }
        let evaluated = self.history.windows(2).all(|pair| pair[0].evaluations <= pair[1].evaluations)
            && self.history.last().is_none_or(|last| last.evaluations <= self.search.evaluations);
        if !evaluated {
            return Err("the evaluations in the history do not add up".to_owned());
        }
        if self.search.evaluations > 0 && self.search.best.is_none() {
            return Err(format!("{} evaluations and no best individual", self.search.evaluations));
        }
        Ok(())
    }
}

#[derive(Deserialize)]
struct Head {
    fingerprint: Fingerprint,
}

/// The body of `bytes`, if header, length and checksum agree.
fn check_envelope<'a>(path: &Path, bytes: &'a [u8]) -> Result<&'a [u8], CheckpointError> {
    let not_one = || CheckpointError::NotACheckpoint { path: path.to_owned() };
    // Whatever precedes the first line end is short in a true checkpoint.
    let end = bytes.iter().take(100).position(|&b| b == b'\n').ok_or_else(not_one)?;
    let header = std::str::from_utf8(&bytes[..end]).map_err(|_| not_one())?;
    let [magic, version, length, checksum] = header.split(' ').collect::<Vec<_>>()[..] else {
        return Err(not_one());
    };
    if magic != MAGIC {
        return Err(not_one());
    }
    if version != VERSION.to_string() {
        return Err(CheckpointError::OtherVersion { path: path.to_owned(), found: version.to_owned() });
    }
    let expected: usize = length.parse().map_err(|_| not_one())?;
    let checksum = u64::from_str_radix(checksum, 16).map_err(|_| not_one())?;
    let body = &bytes[end + 1..];
    if body.len() != expected {
        return Err(CheckpointError::WrongLength { path: path.to_owned(), expected, found: body.len() });
    }
    if Fnv::of(body) != checksum {
        return Err(CheckpointError::WrongChecksum { path: path.to_owned() });
    }
    Ok(body)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::genome::{Genome, Score, Scored};
    use crate::method::{Hewitt, HewittSettings, Start};

    fn sample() -> Checkpoint<Hewitt> {
        let mut search =
            SearchState::new(Hewitt::new(HewittSettings::default(), 7, Start::Random), &Start::Random);
        let genome =
            Genome { nuisances: vec![40.0 / 3.0], ..Genome::new(vec![0.1 + 0.2, -0.0, 1e-300], u64::MAX) };
        search.best = Some(Scored {
            genome,
            score: Score { cost: f64::INFINITY, iou: 1.0 / 3.0, ..Score::of_cost(0.0) },
        });
        let fingerprint = Fingerprint::default().with("goal", &1).with("settings", &2);
        Checkpoint { fingerprint, search, history: Vec::new(), elapsed_s: 0.3, before_search_s: 0.1 }
    }

    #[test]
    fn what_is_written_comes_back_exactly() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint");
        let sample = sample();
        for _ in 0..2 {
            sample.write(&path).unwrap();
        }
        let back = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap();
        assert_eq!(back, sample);
        let zero = back.search.best.unwrap().genome.values[1];
        assert!(zero == 0.0 && zero.is_sign_negative());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays");
    }

    #[test]
    fn every_way_to_cut_or_change_it_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint");
        let sample = sample();
        sample.write(&path).unwrap();
        let whole = fs::read(&path).unwrap();
        for length in 0..whole.len() {
            fs::write(&path, &whole[..length]).unwrap();
            let error = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap_err();
            assert!(
                matches!(error, CheckpointError::NotACheckpoint { .. } | CheckpointError::WrongLength { .. }),
                "{length}: {error}"
            );
        }
        for at in 0..whole.len() {
            let mut damaged = whole.clone();
            damaged[at] ^= 4;
            fs::write(&path, damaged).unwrap();
            assert!(Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).is_err(), "byte {at}");
        }
    }

    #[test]
    #[cfg(unix)]
    fn links_under_the_temporary_name_are_not_followed() {
        let folder = tempfile::tempdir().unwrap();
        let (path, victim) = (folder.path().join("checkpoint"), folder.path().join("victim"));
        fs::write(&victim, "precious").unwrap();
        std::os::unix::fs::symlink(&victim, folder.path().join("checkpoint.tmp")).unwrap();
        // Nor is a link at the checkpoint's own name: it is replaced.
        std::os::unix::fs::symlink(&victim, &path).unwrap();
        sample().write(&path).unwrap();
        assert_eq!(fs::read_to_string(&victim).unwrap(), "precious");
        assert!(fs::symlink_metadata(&path).unwrap().is_file());
    }

    #[test]
    fn what_no_run_can_have_written_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint");
        let read = |checkpoint: &Checkpoint<Hewitt>| {
            checkpoint.write(&path).unwrap();
            Checkpoint::<Hewitt>::read(&path, &checkpoint.fingerprint)
        };
        let row = Row {
            generation: 1,
            evaluations: 20,
            best_cost: 0.5,
            generation_best_cost: 0.5,
            iou: 0.5,
            accuracy: 0.5,
            likeness: None,
            elapsed_s: 0.1,
        };
        let mut good = Checkpoint { history: vec![row], ..sample() };
        good.search.generation = 1;
        good.search.evaluations = 25;
        assert_eq!(read(&good).unwrap(), good);
        let with = |change: fn(&mut Checkpoint<Hewitt>)| {
            let mut forged = good.clone();
            change(&mut forged);
            let error = read(&forged).unwrap_err();
            assert!(matches!(error, CheckpointError::WrongBody { .. }), "{error}");
            error.to_string()
        };
        assert!(with(|c| c.elapsed_s = -1.0).contains("`elapsed_s` is -1"));
        assert!(with(|c| c.elapsed_s = 1e308).contains("expected 0 to 1e10"));
        assert!(with(|c| c.before_search_s = 5.0).contains("more than `elapsed_s`"));
        assert!(with(|c| c.history.clear()).contains("0 rows for 1 generations"));
        assert!(with(|c| c.history[0].generation = 7).contains("row 1 of the history is of generation 7"));
        assert!(with(|c| c.search.evaluations = 3).contains("do not add up"));
        assert!(with(|c| c.search.best = None).contains("no best individual"));
    }

    #[test]
    fn other_runs_versions_and_missing_files_say_so() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint");
        let sample = sample();
        let missing = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap_err();
        assert!(missing.to_string().contains("cannot be read"), "{missing}");
        sample.write(&path).unwrap();
        let other = Fingerprint::default().with("goal", &5).with("settings", &2);
        let error = Checkpoint::<Hewitt>::read(&path, &other).unwrap_err().to_string();
        assert!(error.ends_with("it differs in goal"), "{error}");
        let text = String::from_utf8(fs::read(&path).unwrap()).unwrap();
        fs::write(&path, text.replacen(" 3 ", " 9 ", 1)).unwrap();
        let error = Checkpoint::<Hewitt>::read(&path, &sample.fingerprint).unwrap_err().to_string();
        assert!(error.contains("version 9"), "{error}");
        let nowhere = folder.path().join("no/such/folder");
        assert!(matches!(sample.write(&nowhere), Err(CheckpointError::Io { .. })));
    }
}
