//! Files that appear whole or not at all.

use anyhow::Context;
use std::io::{Cursor, Seek, Write};
use std::path::{Path, PathBuf};

/// Writes `path` through a temporary file beside it, so that a full disk or a killed program never
/// leaves half a file or spoils a good one.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut std::io::BufWriter<std::fs::File>) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    let what = || format!("cannot write {}", path.display());
    if path.is_dir() {
        anyhow::bail!("{} is a folder, expected a file", path.display());
    }
    let mut name = path.file_name().with_context(what)?.to_owned();
    name.push(format!(".{}.tmp", std::process::id()));
    let temporary = path.with_file_name(name);
    let result = (|| {
        let mut file = std::io::BufWriter::new(std::fs::File::create(&temporary)?);
        write(&mut file)?;
        file.flush()?;
        file.into_inner().map_err(std::io::IntoInnerError::into_error)?.sync_all()?;
        std::fs::rename(&temporary, path)?;
        anyhow::Ok(())
    })();
    if result.is_err() {
        // The first error is the one to tell.
        let _ = std::fs::remove_file(&temporary);
    }
    result.with_context(what)
}

/// Writes `text` to `path`, whole or not at all.
pub fn write_text(path: &Path, text: &str) -> anyhow::Result<()> {
    write_whole(path, |file| Ok(file.write_all(text.as_bytes())?))
}

/// Makes a folder and those above it.
pub fn make_folder(path: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(path).with_context(|| format!("cannot make the folder {}", path.display()))
}

/// `folder/name`, the folder made if it is not there.
pub fn inside(folder: &Path, name: impl AsRef<Path>) -> anyhow::Result<PathBuf> {
    make_folder(folder)?;
    Ok(folder.join(name))
}

/// A file, or what becomes standard output.
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

/// Writes `path` whole or not at all; standard output where `path` is `-`. What goes to standard
/// output is kept in memory until it is complete.
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
