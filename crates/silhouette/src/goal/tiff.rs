//! TIFF files that the usual decoder does not know: colours from a palette, and grey values of 32 and 64 bits.

use super::limits::MAX_BYTES;
use image::metadata::Orientation;
use image::{DynamicImage, ImageBuffer};
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError, TiffResult};

/// Grey values that are counted from black, and colours from a palette, as the photometric interpretation names them.
const BLACK_IS_ZERO: u16 = 1;
const PALETTE: u16 = 3;

/// A picture that only this module reads.
pub(super) struct Uncommon {
    pub(super) size: (u32, u32),
    pub(super) orientation: Orientation,
    kind: Kind,
}

enum Kind {
    /// Indices of so many bits.
    Palette(u8),
    Gray,
}

/// What is uncommon about the first page of a TIFF; nothing if the usual decoder reads it.
pub(super) fn uncommon(bytes: &[u8]) -> Option<Uncommon> {
    let mut decoder = Decoder::new(Cursor::new(bytes)).ok()?;
    let mut tag = |tag| decoder.find_tag_unsigned::<u16>(tag).ok().flatten();
    // The decoder has no colour type for palettes.
    let kind = if tag(Tag::PhotometricInterpretation) == Some(PALETTE) {
        match tag(Tag::BitsPerSample)? {
            bits @ (1 | 2 | 4 | 8) => Kind::Palette(bits as u8),
            _ => return None,
        }
    } else {
        match decoder.colortype().ok()? {
            ColorType::Gray(32 | 64) => Kind::Gray,
            _ => return None,
        }
    };
    let orientation = decoder.find_tag_unsigned::<u8>(Tag::Orientation).ok().flatten();
    let orientation = orientation.and_then(Orientation::from_exif).unwrap_or(Orientation::NoTransforms);
    Some(Uncommon { size: decoder.dimensions().ok()?, orientation, kind })
}

impl Uncommon {
    /// Bytes of the picture once it is decoded.
    pub(super) fn total_bytes(&self) -> u64 {
        let (width, height) = self.size;
        // Indices become three bytes each; grey values may have eight.
        let each = if matches!(self.kind, Kind::Gray) { 8 } else { 3 };
        u64::from(width) * u64::from(height) * each
    }

    /// Decodes the picture; `bytes` are those that it was found in.
    pub(super) fn decode(&self, bytes: &[u8]) -> TiffResult<DynamicImage> {
        match self.kind {
            Kind::Palette(bits) => self.palette(bytes, bits),
            Kind::Gray => self.gray(bytes),
        }
    }

    fn palette(&self, bytes: &[u8], bits: u8) -> TiffResult<DynamicImage> {
        let colors = decoder(bytes)?.get_tag_u16_vec(Tag::ColorMap)?;
        // As grey values the indices are read.
        let DecodingResult::U8(rows) = decoder(&as_gray(bytes)?)?.read_image()? else {
            return Err(damaged("indices of a palette are not whole numbers of 8 bits"));
        };
        let (width, height) = (self.size.0 as usize, self.size.1 as usize);
        let in_row = (width * usize::from(bits)).div_ceil(8);
        let count = 1 << bits;
        if rows.len() < in_row * height || colors.len() < 3 * count {
            return Err(damaged("the palette or the picture breaks off"));
        }
        // Colours have 16 bits, but some programs write 8.
        let surplus = if colors.iter().all(|&value| value <= 0xff) { 0 } else { 8 };
        let mut pixels = Vec::with_capacity(3 * width * height);
        for row in rows.chunks_exact(in_row).take(height) {
            for x in 0..width {
                let at = x * usize::from(bits);
                let shift = 8 - usize::from(bits) - at % 8;
                let index = usize::from(row[at / 8] >> shift) & (count - 1);
                pixels.extend([0, 1, 2].map(|channel| (colors[channel * count + index] >> surplus) as u8));
            }
        }
        let (width, height) = self.size;
        let picture = ImageBuffer::from_raw(width, height, pixels).map(DynamicImage::ImageRgb8);
        picture.ok_or_else(|| damaged("the picture breaks off"))
    }

    /// Values from 0 to 1 are brightness; if any is above 1, those of 8 bits, of 16 bits, or the largest there is are white.
    fn gray(&self, bytes: &[u8]) -> TiffResult<DynamicImage> {
        let values: Vec<f64> = match decoder(bytes)?.read_image()? {
            DecodingResult::F32(values) => values.into_iter().map(f64::from).collect(),
            DecodingResult::F64(values) => values,
            DecodingResult::U32(values) => values.into_iter().map(f64::from).collect(),
            DecodingResult::I32(values) => values.into_iter().map(f64::from).collect(),
            DecodingResult::U64(values) => values.into_iter().map(|value| value as f64).collect(),
            DecodingResult::I64(values) => values.into_iter().map(|value| value as f64).collect(),
            _ => return Err(damaged("its values are of another kind than it says")),
        };
        let most = values.iter().copied().filter(|value| value.is_finite()).fold(0.0, f64::max);
        let white = [1.0, 255.0, 65535.0].into_iter().find(|white| most <= *white).unwrap_or(most);
        // What is no number is black.
        let pixels = values.iter().map(|value| (value / white * 65535.0 + 0.5) as u16).collect();
        let (width, height) = self.size;
        let picture = ImageBuffer::from_raw(width, height, pixels).map(DynamicImage::ImageLuma16);
        picture.ok_or_else(|| damaged("the picture breaks off"))
    }
}

fn decoder(bytes: &[u8]) -> TiffResult<Decoder<Cursor<&[u8]>>> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = MAX_BYTES as usize;
    limits.intermediate_buffer_size = MAX_BYTES as usize;
    Ok(Decoder::new(Cursor::new(bytes))?.with_limits(limits))
}

/// The file with another photometric interpretation in its first page.
fn as_gray(bytes: &[u8]) -> TiffResult<Vec<u8>> {
    let place = super::structure::tiff_value(bytes, Tag::PhotometricInterpretation.to_u16());
    let mut changed = bytes.to_vec();
    let value = place.and_then(|place| changed.get_mut(place..place + 2));
    let value = value.ok_or_else(|| damaged("it breaks off"))?;
    let (from, to) = match bytes.starts_with(b"MM") {
        true => (PALETTE.to_be_bytes(), BLACK_IS_ZERO.to_be_bytes()),
        false => (PALETTE.to_le_bytes(), BLACK_IS_ZERO.to_le_bytes()),
    };
    if *value != from {
        return Err(damaged("its colours are of another kind than it says"));
    }
    value.copy_from_slice(&to);
    Ok(changed)
}

fn damaged(what: &str) -> TiffError {
    TiffError::IoError(std::io::Error::new(std::io::ErrorKind::InvalidData, what.to_owned()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::goal::{Encoded, Goal, GoalOptions};
    use tiff::encoder::{TiffEncoder, colortype};

    const SIDE: u32 = 12;

    /// A tree: a trunk with a crown above it.
    fn is_tree(x: u32, y: u32) -> bool {
        (3..9).contains(&x) && (2..8).contains(&y) || (5..7).contains(&x) && (8..12).contains(&y)
    }

    fn each<T>(value: impl Fn(bool) -> T) -> Vec<T> {
        (0..SIDE * SIDE).map(|at| value(is_tree(at % SIDE, at / SIDE))).collect()
    }

    /// A TIFF with a palette of `1 << bits` colours, of which the last is dark green and all others are white.
    fn palette(bits: u16, big_endian: bool) -> Vec<u8> {
        let short = |value: u16| if big_endian { value.to_be_bytes() } else { value.to_le_bytes() };
        let long = |value: u32| if big_endian { value.to_be_bytes() } else { value.to_le_bytes() };
        let last = (1_u16 << bits) - 1;
        let in_row = (SIDE as usize * usize::from(bits)).div_ceil(8);
        let mut rows = vec![0_u8; in_row * SIDE as usize];
        for y in 0..SIDE {
            for x in (0..SIDE).filter(|x| is_tree(*x, y)) {
                let at = x as usize * usize::from(bits);
                rows[y as usize * in_row + at / 8] |= (last as u8) << (8 - usize::from(bits) - at % 8);
            }
        }
        let colors = |dark: u16| (0..=last).map(move |index| if index == last { dark } else { 0xffff });
        let map: Vec<u8> = [0x1000, 0x3000, 0x1000].into_iter().flat_map(colors).flat_map(short).collect();
        const ENTRIES: u16 = 9;
        let behind = 8 + 2 + 12 * u32::from(ENTRIES) + 4;
        let mut file = Vec::from(if big_endian { *b"MM\0*" } else { *b"II*\0" });
        file.extend(long(8));
        file.extend(short(ENTRIES));
        let map_at = behind + rows.len() as u32;
        for (tag, value) in [
            (256, SIDE),
            (257, SIDE),
            (258, u32::from(bits)),
            (259, 1),
            (262, 3),
            (273, behind),
            (278, SIDE),
            (279, rows.len() as u32),
            (320, map_at),
        ] {
            let is_map = tag == 320;
            let is_short = is_map || [258, 259, 262].contains(&tag);
            file.extend(short(tag));
            file.extend(short(if is_short { 3 } else { 4 }));
            file.extend(long(if is_map { map.len() as u32 / 2 } else { 1 }));
            if is_short && !is_map {
                file.extend(short(value as u16));
                file.extend(short(0));
            } else {
                file.extend(long(value));
            }
        }
        file.extend(long(0));
        file.extend(rows);
        file.extend(map);
        file
    }

    fn assert_shows_the_tree(file: Vec<u8>, what: &str) {
        let goal = Goal::from_encoded(&Encoded::new("t.tif", file), &GoalOptions::default());
        let ink = goal.unwrap_or_else(|error| panic!("{what}: {error}")).bitmap;
        for (x, y) in (0..SIDE * SIDE).map(|at| (at % SIDE, at / SIDE)) {
            assert_eq!(ink.get(x, y), is_tree(x, y), "{what}: {x}, {y}");
        }
    }

    #[test]
    fn palettes_of_every_depth_are_read() {
        for bits in [1, 2, 4, 8] {
            for big_endian in [false, true] {
                assert_shows_the_tree(palette(bits, big_endian), &format!("{bits} bits, {big_endian}"));
            }
        }
    }

    fn encoded<C: colortype::ColorType>(values: &[C::Inner]) -> Vec<u8>
    where
        [C::Inner]: tiff::encoder::TiffValue,
    {
        let mut file = Cursor::new(Vec::new());
        TiffEncoder::new(&mut file).unwrap().write_image::<C>(SIDE, SIDE, values).unwrap();
        file.into_inner()
    }

    #[test]
    fn values_of_any_range_are_read() {
        for white in [1.0, 255.0, 4000.0, 1e9] {
            let of = |tree| if tree { 0.1 * white } else { white };
            let values = each(of);
            let single: Vec<f32> = values.iter().map(|value| *value as f32).collect();
            assert_shows_the_tree(encoded::<colortype::Gray32Float>(&single), &format!("f32, {white}"));
            assert_shows_the_tree(encoded::<colortype::Gray64Float>(&values), &format!("f64, {white}"));
            let whole: Vec<u32> = values.iter().map(|value| (*value * 2.0) as u32).collect();
            assert_shows_the_tree(encoded::<colortype::Gray32>(&whole), &format!("u32, {white}"));
        }
        let odd = each(|tree| if tree { f32::NAN } else { 1.0 });
        assert_shows_the_tree(encoded::<colortype::Gray32Float>(&odd), "not a number is black");
        assert_shows_the_tree(
            encoded::<colortype::Gray16>(&each(|tree| if tree { 9 } else { 60_000 })),
            "u16",
        );
    }

    #[test]
    fn what_breaks_off_is_damaged() {
        let whole = palette(8, false);
        for length in (8..whole.len()).step_by(7) {
            let read =
                Goal::from_encoded(&Encoded::new("t.tif", whole[..length].to_vec()), &GoalOptions::default());
            assert!(read.is_err(), "{length} of {}", whole.len());
        }
    }
}
