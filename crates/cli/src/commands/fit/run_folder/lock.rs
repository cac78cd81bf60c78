//! One process at a time in a run folder.

use crate::regular;
use anyhow::{Context, bail};
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read as _, Seek as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// The name of the lock file in a run folder.
pub(super) const LOCK: &str = "lock";

/// How often a lock file that vanishes between opening and locking it is tried again.
const MAX_TRIES: usize = 100;

/// A run folder that no other process may write to while this value lives.
///
/// The lock is the operating system's and ends with the process, however it ends: a `lock` file that a
/// killed run left behind blocks no one. It is removed on drop.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    /// Holds the lock; `None` if the file system has no locks.
    file: Option<File>,
}

/// Another process has the run folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::commands::fit) struct Busy {
    folder: PathBuf,
    /// Its number, where the lock file could be read.
    process: Option<String>,
}

impl std::fmt::Display for Busy {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("another pleach")?;
        if let Some(process) = &self.process {
            write!(f, " (process {process})")?;
        }
        write!(f, " is writing to {}; wait until it ends, or name another --out", self.folder.display())
    }
}

impl std::error::Error for Busy {}

impl Lock {
    /// Locks `folder`, which must exist; the error is a [`Busy`] if another process has it.
    pub(super) fn take(folder: &Path) -> anyhow::Result<Self> {
        let path = folder.join(LOCK);
        let cannot = || format!("cannot write {}", path.display());
        for _ in 0..MAX_TRIES {
            let mut file =
                regular::open(&path, OpenOptions::new().read(true).write(true).create(true).truncate(false))?;
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    let mut owner = String::new();
                    // Who it is only helps: an unreadable file is not another error.
                    let _ = file.read_to_string(&mut owner);
                    let process = owner.split(' ').next().filter(|id| !id.is_empty()).map(str::to_owned);
                    return Err(Busy { folder: folder.to_owned(), process }.into());
                }
                Err(TryLockError::Error(error)) if error.kind() == std::io::ErrorKind::Unsupported => {
                    return Ok(Self { path, file: None });
                }
                Err(TryLockError::Error(error)) => return Err(error).with_context(cannot),
            }
            let owner = owner();
            file.set_len(0)
                .and_then(|()| file.rewind())
                .and_then(|()| file.write_all(owner.as_bytes()))
                .with_context(cannot)?;
            // The run that held it may have removed the file after we opened it. Then ours is another
            // file than the one that the next run will find at this path.
            if std::fs::read_to_string(&path).is_ok_and(|found| found == owner) {
                return Ok(Self { path, file: Some(file) });
            }
        }
        bail!("{} is taken and given back all the time", path.display())
    }
}

/// This process, and which of its locks.
fn owner() -> String {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    format!("{} {}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed))
}

impl Drop for Lock {
    fn drop(&mut self) {
        // First the file, then the lock: no process can lock a file that this removes.
        let _ = std::fs::remove_file(&self.path);
        drop(self.file.take());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_has_one_owner_and_stale_files_block_no_one() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(LOCK), "4294967295 0").unwrap();
        let lock = Lock::take(folder.path()).unwrap();
        let error = Lock::take(folder.path()).unwrap_err().to_string();
        assert!(error.contains(&format!("process {}", std::process::id())), "{error}");
        drop(lock);
        assert!(!folder.path().join(LOCK).exists());
        drop(Lock::take(folder.path()).unwrap());
    }

    #[test]
    fn of_many_that_try_at_once_one_has_it_at_a_time() {
        use std::sync::atomic::AtomicU32;
        let folder = tempfile::tempdir().unwrap();
        let (inside, owned) = (AtomicU32::new(0), AtomicU32::new(0));
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..200 {
                        if let Ok(lock) = Lock::take(folder.path()) {
                            assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0, "two at a time");
                            owned.fetch_add(1, Ordering::SeqCst);
                            inside.fetch_sub(1, Ordering::SeqCst);
                            drop(lock);
                        }
                    }
                });
            }
        });
        assert!(owned.into_inner() > 0);
    }
}
