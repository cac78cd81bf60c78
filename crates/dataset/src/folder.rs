//! The folder of a data set: files that appear whole or not at all, and names that are its own.

use crate::error::DatasetError;
use crate::options::Format;
use sha2::{Digest as _, Sha256};
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, BufWriter, IntoInnerError, Read as _};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

pub(crate) const MANIFEST: &str = "manifest.json";
pub(crate) const FAILURES: &str = "failures.csv";

/// How the names of temporary files end: those that a killed run leaves behind.
const TEMPORARY: &str = ".tmp";

/// The name of a shard.
pub(crate) fn shard_name(shard: u64, format: Format) -> String {
    format!("shard-{shard:05}.{}", format.suffix())
}

/// Whether a data set has files of this name.
fn is_own(name: &str) -> bool {
    let is_shard = |name: &str| {
        let rest = name.strip_prefix("shard-").and_then(|rest| rest.split_once('.'));
        rest.is_some_and(|(digits, suffix)| {
            digits.len() == 5
                && digits.bytes().all(|byte| byte.is_ascii_digit())
                && Format::ALL.iter().any(|format| format.suffix() == suffix)
        })
    };
    name == MANIFEST || name == FAILURES || is_shard(name)
}

/// Whether this is the temporary file of one of a data set.
fn is_temporary(name: &str) -> bool {
    let file = name.strip_suffix(TEMPORARY).and_then(|rest| rest.rsplit_once('.'));
    file.is_some_and(|(file, random)| !random.is_empty() && is_own(file))
}

/// A folder that data sets are written to.
#[derive(Clone, Debug)]
pub(crate) struct Folder {
    path: PathBuf,
}

impl Folder {
    /// The folder at `path`, which is made if it is missing, with those above it.
    pub(crate) fn open(path: &Path) -> Result<Self, DatasetError> {
        fs::create_dir_all(path).map_err(DatasetError::io(path, "cannot be made a folder"))?;
        Ok(Self { path: path.to_owned() })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    pub(crate) fn at(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// The names of what is in it, in order.
    fn names(&self) -> Result<Vec<String>, DatasetError> {
        let read = || -> io::Result<Vec<String>> {
            let entries = fs::read_dir(&self.path)?;
            entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned())).collect()
        };
        let mut names = read().map_err(DatasetError::io(&self.path, "cannot be read"))?;
        names.sort();
        Ok(names)
    }

    /// Removes what a killed run has left of files in progress.
    pub(crate) fn remove_temporaries(&self) -> Result<(), DatasetError> {
        self.names()?.iter().filter(|name| is_temporary(name)).try_for_each(|name| self.remove(name))
    }

    pub(crate) fn is_empty(&self) -> Result<bool, DatasetError> {
        Ok(self.names()?.is_empty())
    }

    /// Removes the files of a data set.
    ///
    /// # Errors
    /// If there are any others; then nothing is removed.
    pub(crate) fn clear(&self) -> Result<(), DatasetError> {
        let names = self.names()?;
        if let Some(other) = names.iter().find(|name| !is_own(name)) {
            return Err(DatasetError::Foreign { folder: self.path.clone(), name: other.clone() });
        }
        // The manifest first: without it, shards are those of no data set.
        let is_manifest = |name: &&String| *name == MANIFEST;
        let (first, rest): (Vec<_>, Vec<_>) = names.iter().partition(is_manifest);
        first.into_iter().chain(rest).try_for_each(|name| self.remove(name))
    }

    fn remove(&self, name: &str) -> Result<(), DatasetError> {
        let path = self.at(name);
        fs::remove_file(&path).map_err(DatasetError::io(&path, "cannot be removed"))
    }

    /// Writes a file through a temporary one beside it, so that a full disk or a killed program never leaves half a
    /// file or spoils a good one.
    pub(crate) fn write(
        &self,
        name: &str,
        write: impl FnOnce(&mut BufWriter<NamedTempFile>) -> io::Result<()>,
    ) -> Result<(), DatasetError> {
        let path = self.at(name);
        let whole = || -> io::Result<()> {
            let mut builder = tempfile::Builder::new();
            // With the permissions of any new file: a temporary one would be readable by its owner alone.
            #[cfg(unix)]
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
            let prefix = format!("{name}.");
            let mut file = BufWriter::new(builder.prefix(&prefix).suffix(TEMPORARY).tempfile_in(&self.path)?);
            write(&mut file)?;
            let file = file.into_inner().map_err(IntoInnerError::into_error)?;
            file.as_file().sync_all()?;
            file.persist(&path)?;
            Ok(())
        };
        whole().map_err(DatasetError::io(&path, "cannot be written"))?;
        // Flush the folder too, so that the rename survives a crash of the machine. Not every file system allows that,
        // and a killed process does not need it: best effort.
        let _ = File::open(&self.path).and_then(|folder| folder.sync_all());
        Ok(())
    }

    /// Length and SHA-256 of a file; `None` if there is no such file.
    pub(crate) fn digest(&self, name: &str) -> Result<Option<(u64, String)>, DatasetError> {
        let path = self.at(name);
        let read = |mut file: File| -> io::Result<(u64, String)> {
            let (mut hash, mut length, mut buffer) = (Sha256::new(), 0, vec![0; 1 << 16]);
            loop {
                let count = file.read(&mut buffer)?;
                if count == 0 {
                    break;
                }
                hash.update(&buffer[..count]);
                length += count as u64;
            }
            let mut digits = String::new();
            for byte in hash.finalize() {
                // Writing to a string cannot fail.
                let _ = write!(digits, "{byte:02x}");
            }
            Ok((length, digits))
        };
        match File::open(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            file => file.and_then(read).map(Some).map_err(DatasetError::io(&path, "cannot be read")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write as _;

    #[test]
    fn own_files_are_known_by_their_names() {
        for name in ["manifest.json", "failures.csv", "shard-00000.npz", "shard-12345.tar"] {
            assert!(is_own(name) && is_temporary(&format!("{name}.aB3dE6.tmp")), "{name}");
        }
        for name in
            ["shard-1.npz", "shard-00000.zip", "shard-0000a.npz", "notes.txt", "manifest.json.bak", "a.b.tmp"]
        {
            assert!(!is_own(name) && !is_temporary(name), "{name}");
        }
    }

    #[test]
    fn a_file_is_written_whole_or_stays_as_it_was() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(&place.path().join("a/b")).unwrap();
        folder.write(MANIFEST, |file| file.write_all(b"one")).unwrap();
        let failed = folder.write(MANIFEST, |file| {
            file.write_all(b"two")?;
            Err(io::Error::other("the disk is full"))
        });
        let told = failed.unwrap_err().to_string();
        assert!(told.contains("manifest.json cannot be written: the disk is full"), "{told}");
        assert_eq!(folder.names().unwrap(), [MANIFEST]);
        // By `printf one | sha256sum`.
        let digest = "7692c3ad3540bb803c020b3aee66cd8887123234ea0c6e7143c0add73ff431ed";
        assert_eq!(folder.digest(MANIFEST).unwrap(), Some((3, digest.to_owned())));
        assert_eq!(folder.digest(FAILURES).unwrap(), None);
    }

    #[test]
    fn only_files_of_a_data_set_are_removed() {
        let place = tempfile::tempdir().unwrap();
        let folder = Folder::open(place.path()).unwrap();
        for name in [MANIFEST, "shard-00003.npz", "shard-00004.npz.123456.tmp", "thesis.tex"] {
            folder.write(name, |_| Ok(())).unwrap();
        }
        folder.remove_temporaries().unwrap();
        let told = folder.clear().unwrap_err().to_string();
        assert!(told.contains("thesis.tex, which is not a file of a data set"), "{told}");
        assert_eq!(folder.names().unwrap(), [MANIFEST, "shard-00003.npz", "thesis.tex"]);
        fs::remove_file(folder.at("thesis.tex")).unwrap();
        folder.clear().unwrap();
        assert!(folder.is_empty().unwrap());
    }
}
