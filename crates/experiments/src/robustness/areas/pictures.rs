//! Spoilt pictures, of every format that can be written here.

use super::{Area, draws, refused};
use crate::robustness::mutate;
use crate::robustness::verdict::Verdict;
use anyhow::Context;
use image::{DynamicImage, GrayImage, ImageFormat, RgbImage, RgbaImage};
use pleach_silhouette::goal::{Goal, GoalOptions};
use pleach_silhouette::mask::{Mask, MaskOptions, Photo};
use pleach_silhouette::{Bitmap, Frame, Rasterizer, View};
use pleach_tree::Parts;
use std::io::Cursor;
use std::path::Path;

const LANE: u32 = 3;
/// Side of the pictures in pixels.
const SIDE: u32 = 64;
/// A file that breaks off before this part of it lacks pixels, and is not a picture.
const WHOLE: f64 = 0.9;

/// Pictures of a tree.
pub(in super::super) struct Pictures {
    files: Vec<Vec<u8>>,
}

impl Pictures {
    pub(in super::super) fn new() -> anyhow::Result<Self> {
        let species = pleach_generators::preset("acer").context("a known species")?;
        let tree = species.grow(1)?;
        let frame = Frame::automatic(&tree, &View::FRONT, Parts::LEAFY, SIDE, SIDE);
        let mut ink = Bitmap::default();
        Rasterizer::new().draw(&tree, &View::FRONT, &frame, Parts::LEAFY, &mut ink);
        let tone = |x, y| if ink.get(x, y) { 20 } else { 200 + (x + y) as u8 % 40 };
        let gray = GrayImage::from_fn(SIDE, SIDE, |x, y| image::Luma([tone(x, y)]));
        let color = RgbImage::from_fn(SIDE, SIDE, |x, y| image::Rgb([tone(x, y), 90, tone(x, y)]));
        let clear = RgbaImage::from_fn(SIDE, SIDE, |x, y| {
            image::Rgba([0, 0, 0, if ink.get(x, y) { 255 } else { 0 }])
        });
        let pictures: [DynamicImage; 3] = [gray.into(), color.into(), clear.into()];
        let mut files = Vec::new();
        for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP, ImageFormat::Tiff] {
            for picture in &pictures {
                let mut file = Cursor::new(Vec::new());
                // Not every format takes every picture, or is built in.
                if picture.write_to(&mut file, format).is_ok() {
                    files.push(file.into_inner());
                }
            }
        }
        Ok(Self { files })
    }

    /// A spoilt file, and whether all that was done to it is that it breaks off.
    fn spoilt(&self, case: u64) -> (Vec<u8>, bool) {
        let mut draws = draws(LANE, case);
        let file = &self.files[draws.below(self.files.len())];
        if draws.chance(0.1) {
            let length = draws.below((WHOLE * file.len() as f64) as usize);
            return (file[..length].to_vec(), true);
        }
        let mut bytes = mutate::binary(file, &mut draws);
        if draws.chance(0.5) {
            mend_png(&mut bytes);
        }
        (bytes, false)
    }
}

impl Area for Pictures {
    fn name(&self) -> &'static str {
        "pictures"
    }

    fn input(&self, case: u64) -> Vec<u8> {
        self.spoilt(case).0
    }

    fn judge(&self, case: u64, folder: &Path) -> Verdict {
        let (input, breaks_off) = self.spoilt(case);
        let file = folder.join("goal");
        if let Err(error) = std::fs::write(&file, &input) {
            return Verdict::Wrong(format!("the case could not be made: {error}"));
        }
        let named = |message: String| refused(message.replace(&*file.to_string_lossy(), "goal"), false);
        let options = GoalOptions { max_side: Some(SIDE), ..GoalOptions::default() };
        let goal = match Goal::load(&file, &options) {
            Ok(goal) => goal,
            Err(error) => return named(error.to_string()),
        };
        if breaks_off {
            return Verdict::Wrong(format!("a file that breaks off after {} bytes is taken", input.len()));
        }
        let height = goal.height_in_pixels();
        if goal.bitmap.ink() == 0 || !(height.is_finite() && height > 0.0) {
            return Verdict::Wrong(format!("a goal of {} pixels and height {height}", goal.bitmap.ink()));
        }
        // Larger ones take longer and show nothing new.
        if goal.detection.original_size.0.max(goal.detection.original_size.1) <= 4 * SIDE {
            let mask = match Photo::load(&file) {
                Ok(photo) => Mask::from_photo(&photo, &MaskOptions::default()).map_err(|e| e.to_string()),
                Err(error) => Err(error.to_string()),
            };
            if let Err(message) = mask {
                return named(message);
            }
        }
        Verdict::Accepted
    }
}

/// Gives every chunk of a PNG the checksum that it should have, so that decoders look further.
fn mend_png(bytes: &mut [u8]) {
    const HEAD: usize = 8;
    if !bytes.starts_with(b"\x89PNG") {
        return;
    }
    let mut at = HEAD;
    while let Some(length) = bytes.get(at..at + 4).and_then(|four| four.try_into().ok()) {
        let length = u32::from_be_bytes(length) as usize;
        let end = at + 8 + length;
        let Some(data) = bytes.get(at + 4..end) else { return };
        let sum = crc32fast::hash(data);
        let Some(place) = bytes.get_mut(end..end + 4) else { return };
        place.copy_from_slice(&sum.to_be_bytes());
        at = end + 4;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_pictures_until_they_are_spoilt() {
        let pictures = Pictures::new().unwrap();
        let kinds: Vec<&[u8]> = pictures.files.iter().map(|file| &file[..3]).collect();
        for kind in [b"\x89PN", b"\xff\xd8\xff", b"RIF"] {
            assert!(kinds.contains(&&kind[..]), "{kinds:?}");
        }
        for file in &pictures.files {
            let decoded = image::load_from_memory(file).unwrap();
            assert_eq!((decoded.width(), decoded.height()), (SIDE, SIDE));
        }
    }

    #[test]
    fn chunks_are_mended() {
        let whole = &Pictures::new().unwrap().files[0];
        let mut spoilt = whole.clone();
        for byte in &mut spoilt[29..33] {
            *byte ^= 0x55;
        }
        assert!(image::load_from_memory(&spoilt).is_err());
        mend_png(&mut spoilt);
        assert_eq!(spoilt, *whole);
    }
}
