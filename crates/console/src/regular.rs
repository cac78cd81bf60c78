//! Regular files and folders: no links, pipes or devices.
//!
//! A program that opens a file under a fixed name in a user's folder may follow a link that was put there.
//! Files that pleach writes in place are therefore opened here; all others appear by a rename
//! ([`files`](crate::files)), which replaces a link and leaves its target alone.

use crate::text;
use anyhow::{Context, bail, ensure};
use std::fmt;
use std::fs::{File, OpenOptions};
use std::io::ErrorKind;
use std::path::Path;

/// The kind of thing at a path; links are not followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// Nothing.
    Nothing,
    /// A regular file.
    File,
    /// A folder.
    Folder,
    /// A symbolic link, wherever it leads.
    Link,
    /// A pipe, a socket or a device.
    Special,
}

impl Found {
    /// What lies at `path`.
    ///
    /// # Errors
    /// If the system reports none.
    pub fn at(path: &Path) -> anyhow::Result<Self> {
        match std::fs::symlink_metadata(path) {
            Ok(found) if found.is_symlink() => Ok(Self::Link),
            Ok(found) if found.is_dir() => Ok(Self::Folder),
            Ok(found) if found.is_file() => Ok(Self::File),
            Ok(_) => Ok(Self::Special),
            Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {
                Ok(Self::Nothing)
            }
            Err(error) => Err(error).with_context(|| format!("cannot look at {}", text::path(path))),
        }
    }
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Nothing => "nothing",
            Self::File => "a file",
            Self::Folder => "a folder",
            Self::Link => "a link",
            Self::Special => "a pipe or a device",
        })
    }
}

/// Checks that `path` is a regular file, or free.
///
/// # Errors
/// If anything else does.
pub fn check_file(path: &Path) -> anyhow::Result<()> {
    match Found::at(path)? {
        Found::Nothing | Found::File => Ok(()),
        found => bail!("{} is {found}, expected a file of pleach's own or none", text::path(path)),
    }
}

/// Checks that `path` is a folder, or free.
///
/// # Errors
/// If it is anything else, even a link to a folder.
pub fn check_folder(path: &Path) -> anyhow::Result<()> {
    match Found::at(path)? {
        Found::Nothing | Found::Folder => Ok(()),
        found => bail!("{} is {found}, expected a folder of pleach's own or none", text::path(path)),
    }
}

/// Opens the regular file at `path` with `options`, which say whether it may be created.
///
/// # Errors
/// If anything else is there, or the file cannot be opened.
pub fn open(path: &Path, options: &mut OpenOptions) -> anyhow::Result<File> {
    check_file(path)?;
    // A link or a pipe that takes its place after the check is not followed or waited for either.
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(options, libc::O_NOFOLLOW | libc::O_NONBLOCK);
    let cannot = || format!("cannot open {}", text::path(path));
    let file = options.open(path).with_context(cannot)?;
    let is_file = file.metadata().with_context(cannot)?.is_file();
    ensure!(is_file, "{} is not a file", text::path(path));
    Ok(file)
}

/// The text of the file at `path`, to which a link may lead; a pipe is not waited for.
///
/// # Errors
/// If it is not a file, or cannot be read, or is not UTF-8.
pub fn read_text(path: &Path) -> anyhow::Result<String> {
    let cannot = || format!("cannot read {}", text::path(path));
    ensure!(std::fs::metadata(path).with_context(cannot)?.is_file(), "{} is not a file", text::path(path));
    std::fs::read_to_string(path).with_context(cannot)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    #[test]
    fn only_what_is_itself_a_file_is_opened() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("victim"), "precious").unwrap();
        std::fs::create_dir(at("folder")).unwrap();
        symlink("victim", at("link")).unwrap();
        symlink("nowhere", at("dangling")).unwrap();
        symlink("folder", at("link to a folder")).unwrap();
        assert!(std::process::Command::new("mkfifo").arg(at("pipe")).status().unwrap().success());
        let open = |name: &str| open(&at(name), OpenOptions::new().write(true).create(true).truncate(true));
        for (name, what) in [
            ("link", "is a link, expected a file"),
            ("dangling", "is a link"),
            ("folder", "is a folder"),
            ("pipe", "is a pipe or a device"),
        ] {
            let told = open(name).unwrap_err().to_string();
            assert!(told.contains(name) && told.contains(what), "{told}");
        }
        assert!(open("new").is_ok() && open("new").is_ok());
        assert_eq!(std::fs::read_to_string(at("victim")).unwrap(), "precious");
        assert!(!at("nowhere").exists());

        assert!(check_folder(&at("folder")).is_ok() && check_folder(&at("none")).is_ok());
        let told = check_folder(&at("link to a folder")).unwrap_err().to_string();
        assert!(told.contains("is a link, expected a folder"), "{told}");
        assert!(check_folder(&at("victim")).is_err());

        assert_eq!(read_text(&at("link")).unwrap(), "precious");
        assert!(read_text(&at("pipe")).unwrap_err().to_string().contains("is not a file"));
    }
}
