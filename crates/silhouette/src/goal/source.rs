//! Pictures as they come: bytes with a name, from a file or a pipe, and never more than may be.

use super::error::GoalError;
use super::formats::{self, HEAD};
use super::limits::MAX_BYTES;
#[cfg(feature = "pictures")]
use super::svg;
use image::ImageFormat;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// A picture that is not yet decoded: its bytes, and what errors call it.
///
/// Files, pipes and standard input are all read to their end, since not all of them can be read twice.
/// What does not begin like a picture is refused before the rest of it is read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Encoded {
    name: PathBuf,
    bytes: Vec<u8>,
    /// The file that these were converted from, where they were.
    file: Option<Vec<u8>>,
}

impl Encoded {
    /// Bytes at hand; `name` is what errors call them. Whether they are a picture is checked when they are
    /// decoded.
    #[must_use]
    pub fn new(name: impl Into<PathBuf>, bytes: Vec<u8>) -> Self {
        Self { name: name.into(), bytes, file: None }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`GoalError::Unreadable`], [`GoalError::NotAnImage`], [`GoalError::TooManyBytes`], and [`GoalError::Drawing`] for an
    /// SVG file that is not painted.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, GoalError> {
        let path = path.as_ref();
        let unreadable = |cause| GoalError::Unreadable { path: path.into(), cause };
        let file = File::open(path).map_err(unreadable)?;
        let meta = file.metadata().map_err(unreadable)?;
        if meta.is_dir() {
            return Err(unreadable(std::io::ErrorKind::IsADirectory.into()));
        }
        if meta.len() > MAX_BYTES {
            return Err(GoalError::TooManyBytes { path: path.into(), bytes: meta.len(), limit: MAX_BYTES });
        }
        Self::read(path, file)
    }

    /// Reads any stream to its end, such as standard input; `name` is what errors call it.
    ///
    /// # Errors
    /// As [`Encoded::load`].
    pub fn read(name: impl Into<PathBuf>, mut from: impl Read) -> Result<Self, GoalError> {
        let (path, mut bytes) = (name.into(), Vec::new());
        let read = (|| {
            from.by_ref().take(HEAD as u64).read_to_end(&mut bytes)?;
            if format(&bytes).is_none() && !is_drawing(&bytes) {
                return Ok(false);
            }
            // One byte more, to notice that there is too much.
            from.take(MAX_BYTES + 1 - HEAD as u64).read_to_end(&mut bytes)?;
            Ok(true)
        })();
        match read {
            Err(cause) => Err(GoalError::Unreadable { path, cause }),
            Ok(false) => Err(refused(path, &bytes)),
            Ok(true) if bytes.len() as u64 > MAX_BYTES => {
                Err(GoalError::TooManyBytes { path, bytes: bytes.len() as u64, limit: MAX_BYTES })
            }
            Ok(true) => {
                let read = Self { name: path, bytes, file: None };
                // Once, whatever is asked of it.
                Ok(match read.painted()? {
                    Some(painted) => painted,
                    None => read,
                })
            }
        }
    }

    /// A drawing as a picture; nothing for what is a picture, or nothing that is read.
    #[cfg(feature = "pictures")]
    pub(super) fn painted(&self) -> Result<Option<Self>, GoalError> {
        if !is_drawing(&self.bytes) {
            return Ok(None);
        }
        match svg::painted(&self.bytes) {
            Ok(png) => Ok(Some(Self::new(&self.name, png).converted_from(self.bytes.clone()))),
            Err(detail) => Err(GoalError::Drawing { path: self.name.clone(), detail }),
        }
    }

    #[cfg(not(feature = "pictures"))]
    #[expect(clippy::unnecessary_wraps, clippy::unused_self, reason = "drawings are read by a feature")]
    pub(super) fn painted(&self) -> Result<Option<Self>, GoalError> {
        Ok(None)
    }

    /// The same, as the conversion of a file of another format with these bytes.
    #[must_use]
    pub fn converted_from(self, file: Vec<u8>) -> Self {
        Self { file: Some(file), ..self }
    }

    /// The bytes of its file: its own, unless it was converted.
    #[must_use]
    pub fn file_bytes(&self) -> &[u8] {
        self.file.as_deref().unwrap_or(&self.bytes)
    }

    /// What errors call it: the path of a file.
    #[must_use]
    pub fn name(&self) -> &Path {
        &self.name
    }

    /// The bytes as they came.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The format, by its first bytes; `None` if it is not one that is read.
    pub(super) fn format(&self) -> Option<ImageFormat> {
        format(&self.bytes)
    }
}

/// Why bytes that begin like none of the formats that are read are refused.
pub(super) fn refused(path: PathBuf, bytes: &[u8]) -> GoalError {
    match formats::foreign(&bytes[..bytes.len().min(HEAD)]) {
        Some((format, converter)) => GoalError::OtherFormat { path, format, converter },
        None => GoalError::NotAnImage { path },
    }
}

/// Whether it is a drawing, and drawings are read.
fn is_drawing(head: &[u8]) -> bool {
    cfg!(feature = "pictures") && formats::is_svg(head)
}

fn format(bytes: &[u8]) -> Option<ImageFormat> {
    let format = image::guess_format(bytes)
        .ok()
        .filter(|format| formats::READ.iter().any(|(read, _)| read == format))?;
    // Two letters may begin anything.
    let is_sure = format != ImageFormat::Bmp || formats::is_bmp(bytes);
    (is_sure && format.reading_enabled()).then_some(format)
}
