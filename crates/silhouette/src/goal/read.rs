//! From a file to brightness and opacity, without trusting it.

use super::error::GoalError;
use image::{DynamicImage, ImageDecoder, ImageReader, Limits};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// Most pixels to a side that are read.
pub const MOST_SIDE: u32 = 8192;
/// Fewest pixels to a side that make a goal.
pub const LEAST_SIDE: u32 = 8;
/// Most bytes that a file, or a decoded picture, may have: 8192² pixels of four bytes.
pub const MOST_BYTES: u64 = 4 * MOST_SIDE as u64 * MOST_SIDE as u64;

/// A decoded picture: per pixel how bright and how opaque it is, 0 to 255, row by row.
#[derive(Debug)]
pub(super) struct Tones {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) light: Vec<u8>,
    pub(super) opacity: Vec<u8>,
}

/// Decodes a file to what goals are made of.
pub(super) fn tones(path: &Path) -> Result<Tones, GoalError> {
    let both = picture(path)?.into_luma_alpha8();
    let (width, height) = both.dimensions();
    let both = both.into_raw();
    let (pairs, _) = both.as_chunks::<2>();
    let light = pairs.iter().map(|p| p[0]).collect();
    let opacity = pairs.iter().map(|p| p[1]).collect();
    Ok(Tones { width, height, light, opacity })
}

/// Decodes a file and turns it upright. Its size and the size that its header claims are checked
/// before any pixel is.
pub(crate) fn picture(path: &Path) -> Result<DynamicImage, GoalError> {
    let mut decoder = open(path)?;
    checked_dimensions(path, &decoder)?;
    let bytes = decoder.total_bytes();
    if bytes > MOST_BYTES {
        return Err(GoalError::TooManyBytes { path: path.into(), bytes, limit: MOST_BYTES });
    }
    let damaged = |e: image::ImageError| GoalError::Damaged { path: path.into(), detail: e.to_string() };
    let mut limits = Limits::default();
    limits.max_image_width = Some(MOST_SIDE);
    limits.max_image_height = Some(MOST_SIDE);
    limits.max_alloc = Some(2 * MOST_BYTES);
    decoder.set_limits(limits).map_err(damaged)?;
    // Photographs lie on their side more often than not; a picture without a note stands as it is.
    let orientation = decoder.orientation().unwrap_or(image::metadata::Orientation::NoTransforms);
    let mut picture = DynamicImage::from_decoder(decoder).map_err(damaged)?;
    picture.apply_orientation(orientation);
    Ok(picture)
}

/// Width and height that the header of a file claims, the note on orientation followed.
pub(super) fn dimensions(path: &Path) -> Result<(u32, u32), GoalError> {
    use image::metadata::Orientation::{Rotate90, Rotate90FlipH, Rotate270, Rotate270FlipH};
    let mut decoder = open(path)?;
    let (width, height) = checked_dimensions(path, &decoder)?;
    Ok(match decoder.orientation() {
        Ok(Rotate90 | Rotate90FlipH | Rotate270 | Rotate270FlipH) => (height, width),
        _ => (width, height),
    })
}

fn open(path: &Path) -> Result<impl ImageDecoder, GoalError> {
    let unreadable = |cause| GoalError::Unreadable { path: path.into(), cause };
    let file = File::open(path).map_err(unreadable)?;
    let meta = file.metadata().map_err(unreadable)?;
    if meta.is_dir() {
        return Err(unreadable(std::io::ErrorKind::IsADirectory.into()));
    }
    // Some decoders read the whole file at once.
    if meta.len() > MOST_BYTES {
        return Err(GoalError::TooManyBytes { path: path.into(), bytes: meta.len(), limit: MOST_BYTES });
    }
    let mut reader = ImageReader::new(BufReader::new(file)).with_guessed_format().map_err(unreadable)?;
    if reader.format().is_none() {
        return Err(GoalError::NotAnImage { path: path.into() });
    }
    // The limits come with a sentence of our own, once the header has been read.
    reader.no_limits();
    reader.into_decoder().map_err(|e| match e {
        image::ImageError::Unsupported(_) => GoalError::NotAnImage { path: path.into() },
        image::ImageError::IoError(cause) if cause.kind() != std::io::ErrorKind::UnexpectedEof => {
            GoalError::Unreadable { path: path.into(), cause }
        }
        other => GoalError::Damaged { path: path.into(), detail: other.to_string() },
    })
}

fn checked_dimensions(path: &Path, decoder: &impl ImageDecoder) -> Result<(u32, u32), GoalError> {
    let (width, height) = decoder.dimensions();
    if width.max(height) > MOST_SIDE {
        return Err(GoalError::TooLarge { path: path.into(), width, height });
    }
    if width.min(height) < LEAST_SIDE {
        return Err(GoalError::TooSmall { name: path.display().to_string(), width, height });
    }
    Ok((width, height))
}
