//! From bytes to brightness and opacity, without trusting them.

use super::error::GoalError;
use super::limits::{MAX_BESIDE, MAX_BYTES, MAX_SIDE, MIN_SIDE};
use super::source::{self, Encoded};
use super::structure::{Structure, structure};
use super::tiff::{self, Uncommon};
use image::metadata::Orientation;
use image::{DynamicImage, ImageDecoder, ImageError, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// Most pixels that are sampled to distinguish photographs from silhouettes.
const MAX_SAMPLES: usize = 1 << 17;

/// A decoded picture: per pixel how bright and how opaque it is, 0 to 255, row by row.
#[derive(Debug)]
pub(crate) struct Tones {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) light: Vec<u8>,
    pub(crate) opacity: Vec<u8>,
    /// Colours of every `stride`-th pixel.
    pub(crate) colors: Vec<[u8; 3]>,
    pub(crate) stride: usize,
    /// Whether the file holds further pictures.
    pub(crate) several: bool,
}

/// Decodes a picture to what goals are made of.
pub(super) fn tones(source: &Encoded) -> Result<Tones, GoalError> {
    let (picture, several) = picture(source)?;
    let pixels = picture.width() as usize * picture.height() as usize;
    let stride = pixels.div_ceil(MAX_SAMPLES).max(1);
    let colors = colors(&picture, stride);
    let both = picture.into_luma_alpha8();
    let (width, height) = both.dimensions();
    let both = both.into_raw();
    let (pairs, _) = both.as_chunks::<2>();
    let light = pairs.iter().map(|p| p[0]).collect();
    let opacity = pairs.iter().map(|p| p[1]).collect();
    Ok(Tones { width, height, light, opacity, colors, stride, several })
}

/// Colours of every `stride`-th pixel of a picture with 8 bits a channel; greys are not looked at, nor are
/// deeper pictures.
fn colors(picture: &DynamicImage, stride: usize) -> Vec<[u8; 3]> {
    match picture {
        DynamicImage::ImageRgb8(p) => p.as_raw().as_chunks::<3>().0.iter().step_by(stride).copied().collect(),
        DynamicImage::ImageRgba8(p) => {
            p.as_raw().as_chunks::<4>().0.iter().step_by(stride).map(|&[r, g, b, _]| [r, g, b]).collect()
        }
        DynamicImage::ImageRgb16(p) => {
            let eight = |p: &[u16; 3]| p.map(|v| (v >> 8) as u8);
            p.as_raw().as_chunks::<3>().0.iter().step_by(stride).map(eight).collect()
        }
        _ => Vec::new(),
    }
}

/// Decodes a picture and turns it upright; of several in a file, the first. The sizes of
/// the file and of its header are checked before any pixel is decoded. Also whether there are several.
pub(crate) fn picture(source: &Encoded) -> Result<(DynamicImage, bool), GoalError> {
    if let Some(painted) = source.painted()? {
        return picture(&painted);
    }
    let check_bytes = |bytes| match bytes > MAX_BYTES {
        true => Err(GoalError::TooManyBytes { path: source.name().into(), bytes, limit: MAX_BYTES }),
        false => Ok(()),
    };
    if let Some((found, several)) = uncommon(source)? {
        check_bytes(found.total_bytes())?;
        let mut picture = found
            .decode(source.bytes())
            .map_err(|error| GoalError::Damaged { path: source.name().into(), detail: error.to_string() })?;
        picture.apply_orientation(found.orientation);
        return Ok((picture, several));
    }
    let (mut decoder, several) = open(source)?;
    check_bytes(decoder.total_bytes())?;
    let damaged = |e| undecoded(source, e);
    let mut limits = Limits::default();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(2 * MAX_BYTES);
    decoder.set_limits(limits).map_err(damaged)?;
    // Apply the EXIF orientation, if any.
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    let mut picture = DynamicImage::from_decoder(decoder).map_err(damaged)?;
    picture.apply_orientation(orientation);
    Ok((picture, several))
}

/// Width and height that the header of a picture claims, the note on orientation followed.
pub(super) fn dimensions(source: &Encoded) -> Result<(u32, u32), GoalError> {
    use Orientation::{Rotate90, Rotate90FlipH, Rotate270, Rotate270FlipH};
    if let Some(painted) = source.painted()? {
        return dimensions(&painted);
    }
    let ((width, height), orientation) = match uncommon(source)? {
        Some((found, _)) => (found.size, Ok(found.orientation)),
        None => {
            let (mut decoder, _) = open(source)?;
            (decoder.dimensions(), decoder.orientation())
        }
    };
    Ok(match orientation {
        Ok(Rotate90 | Rotate90FlipH | Rotate270 | Rotate270FlipH) => (height, width),
        _ => (width, height),
    })
}

/// A TIFF that the usual decoder does not read, if it is one, and whether there are further pictures.
fn uncommon(source: &Encoded) -> Result<Option<(Uncommon, bool)>, GoalError> {
    if source.format() != Some(ImageFormat::Tiff) {
        return Ok(None);
    }
    let Some(found) = tiff::uncommon(source.bytes()) else { return Ok(None) };
    check(source, found.size)?;
    let several = structure(ImageFormat::Tiff, source.bytes()).is_ok_and(|structure| structure.several);
    Ok(Some((found, several)))
}

/// A decoder of a picture whose structure and size are right, and whether there are further pictures.
fn open(source: &Encoded) -> Result<(impl ImageDecoder, bool), GoalError> {
    let path = || source.name().into();
    let format = source.format().ok_or_else(|| source::refused(path(), source.bytes()))?;
    let Structure { size, several, end } = structure(format, source.bytes())
        .map_err(|detail| GoalError::Damaged { path: path(), detail: detail.to_owned() })?;
    if let Some(size) = size {
        check(source, size)?;
    }
    let mut reader = ImageReader::with_format(Cursor::new(&source.bytes()[..end]), format);
    // Of what is read before the pixels, only PNG's colour profile and texts can unpack to more than the
    // file has. Limits on sizes come with sentences of our own.
    let mut limits = Limits::no_limits();
    if format == ImageFormat::Png {
        limits.max_alloc = Some(MAX_BESIDE);
    }
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(|e| match e {
        ImageError::Limits(_) => GoalError::TooMuchBeside { path: path(), limit: MAX_BESIDE },
        other => undecoded(source, other),
    })?;
    check(source, decoder.dimensions())?;
    Ok((decoder, several))
}

/// What a decoder reports; it reads from memory, so that it is never the file's reader that failed.
fn undecoded(source: &Encoded, error: ImageError) -> GoalError {
    let path = source.name().into();
    match error {
        ImageError::Unsupported(what) => GoalError::Unsupported { path, detail: what.to_string() },
        ImageError::IoError(cause) if cause.kind() == std::io::ErrorKind::UnexpectedEof => {
            GoalError::Damaged { path, detail: "it breaks off".to_owned() }
        }
        other => GoalError::Damaged { path, detail: other.to_string() },
    }
}

fn check(source: &Encoded, (width, height): (u32, u32)) -> Result<(), GoalError> {
    if width.max(height) > MAX_SIDE {
        return Err(GoalError::TooLarge { path: source.name().into(), width, height });
    }
    if width.min(height) < MIN_SIDE {
        return Err(GoalError::TooSmall { name: source.name().display().to_string(), width, height });
    }
    Ok(())
}
