//! Files that appear whole or not at all.

use crate::text;
use anyhow::Context;
use std::io::{BufWriter, Cursor, IntoInnerError, Seek, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Writes `path` through a temporary file beside it, so that a full disk or a killed program never
/// leaves half a file or spoils a good one.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<NamedTempFile>) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let what = || format!("cannot write {}", text::path(path));
    if path.is_dir() {
        anyhow::bail!("{} is a folder, expected a file", text::path(path));
    }
    let result = (|| {
        let mut file = BufWriter::new(beside(path)?);
        write(&mut file)?;
        let file = file.into_inner().map_err(IntoInnerError::into_error)?;
        file.as_file().sync_all()?;
        file.persist(path)?;
        anyhow::Ok(())
    })();
    result.with_context(what)
}

/// How the names of temporary files end, and how many random letters and digits stand before that.
const TEMPORARY: &str = ".tmp";
const RANDOM: usize = 6;

/// The file that a temporary file of this name was to become, if it is named like one of ours:
/// `NAME.XXXXXX.tmp`. A program that is killed while it writes leaves such a file behind.
#[must_use]
pub fn temporary_of(name: &str) -> Option<&str> {
    let (file, random) = name.strip_suffix(TEMPORARY)?.rsplit_once('.')?;
    let is_random = random.len() == RANDOM && random.bytes().all(|byte| byte.is_ascii_alphanumeric());
    (is_random && !file.is_empty()).then_some(file)
}

/// An empty file in the folder of `path`, which goes away unless it is persisted.
fn beside(path: &Path) -> std::io::Result<NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".");
    let mut builder = tempfile::Builder::new();
    builder.prefix(&name).suffix(TEMPORARY).rand_bytes(RANDOM);
    // With the permissions of any new file: a temporary one would be readable by its owner alone.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder.unwrap_or(Path::new(".")))
}

/// Writes `text` to `path`, whole or not at all.
pub fn write_text(path: &Path, text: &str) -> anyhow::Result<()> {
    write_whole(path, |file| Ok(file.write_all(text.as_bytes())?))
}

/// Creates a folder and those above it.
pub fn make_folder(path: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(path).with_context(|| format!("cannot make the folder {}", text::path(path)))
}

/// `folder/name`; creates the folder if it is missing.
pub fn inside(folder: &Path, name: impl AsRef<Path>) -> anyhow::Result<PathBuf> {
    make_folder(folder)?;
    Ok(folder.join(name))
}

/// A file, or a buffer for standard output.
pub trait Out: Write + Seek {}

impl<T: Write + Seek> Out for T {}

/// Whether `path` is `-`, which stands for standard output. A file of that name is `./-`.
pub fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

/// Whether `path` names a file: it has a suffix, does not end in a slash, and is not a folder.
pub fn is_file(path: &Path) -> bool {
    let slash = path.to_string_lossy().ends_with(std::path::is_separator);
    path.extension().is_some() && !slash && !path.is_dir()
}

/// Writes `path` whole or not at all; standard output where `path` is `-`. Standard output is
/// kept in memory until it is complete.
pub fn write_out(path: &Path, write: impl FnOnce(&mut dyn Out) -> anyhow::Result<()>) -> anyhow::Result<()> {
    if !is_stdout(path) {
        return write_whole(path, |file| write(file));
    }
    let mut buffer = Cursor::new(Vec::new());
    write(&mut buffer)?;
    let mut out = std::io::stdout().lock();
    out.write_all(buffer.get_ref())?;
    Ok(out.flush()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_written_whole_or_stays_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_text(&path, "one").unwrap();
        let failed = write_whole(&path, |file| {
            file.write_all(b"two")?;
            anyhow::bail!("the disk is full")
        });
        assert!(failed.unwrap_err().to_string().contains("a.txt"));
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "one");
        // Nothing is left beside it.
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        assert!(write_text(folder.path(), "a").unwrap_err().to_string().contains("is a folder"));
    }

    #[test]
    fn temporary_files_are_known_by_their_names() {
        let folder = tempfile::tempdir().unwrap();
        let file = beside(&folder.path().join("best.toml")).unwrap();
        let name = file.path().file_name().unwrap().to_str().unwrap();
        assert_eq!(temporary_of(name), Some("best.toml"), "{name}");
        for other in
            ["best.toml", "best.toml.tmp", "notes.tmp", "best.toml.12345.tmp", ".aB3dE6.tmp", "a.aB-dE6.tmp"]
        {
            assert_eq!(temporary_of(other), None, "{other}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_file_may_be_read_by_whoever_may_read_new_files() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
        write_text(&ours, "a").unwrap();
        std::fs::write(&plain, "a").unwrap();
        let mode = |path| std::fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(ours), mode(plain));
    }
}
