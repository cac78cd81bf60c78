//! Pictures that mean no good: bombs, files that break off, and bytes changed at random. Reading them ends
//! in a goal or an error, and takes no more memory than a large picture does.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use image::{DynamicImage, GrayImage, ImageFormat, Luma, RgbaImage};
use pleach_silhouette::goal::{Encoded, Goal, GoalError, GoalOptions, MAX_BYTES};
use pleach_silhouette::mask::{Mask, MaskOptions, Photo};
use pleach_tests::png_chunk;
use proptest::prelude::*;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::io::{Cursor, Read};
use std::sync::Mutex;

#[global_allocator]
static MEMORY: &StatsAlloc<std::alloc::System> = &INSTRUMENTED_SYSTEM;

/// One at a time: all threads' allocations are counted together.
static ALONE: Mutex<()> = Mutex::new(());

/// The result, and the sum of all that was allocated on the way, whether given back or not.
fn measured<T>(work: impl FnOnce() -> T) -> (T, usize) {
    let _alone = ALONE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let region = Region::new(MEMORY);
    let result = work();
    let change = region.change();
    (result, change.bytes_allocated)
}

fn goal(bytes: &[u8]) -> Result<Goal, GoalError> {
    Goal::from_bytes("picture", bytes.to_vec(), &GoalOptions::default())
}

/// A crown on a trunk, dark on light.
fn is_tree(x: u32, y: u32) -> bool {
    (f64::from(x) - 30.0).hypot(f64::from(y) - 16.0) < 12.0 || ((28..32).contains(&x) && y > 20)
}

fn picture() -> DynamicImage {
    RgbaImage::from_fn(60, 52, |x, y| {
        let v = if is_tree(x, y) { (x % 5 * 3) as u8 } else { 230 + (y % 5 * 2) as u8 };
        image::Rgba([v, v / 2 + 40, v, 255])
    })
    .into()
}

fn encoded(format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    let rgb = DynamicImage::from(picture().to_rgb8());
    rgb.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

const FORMATS: [ImageFormat; 4] = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::WebP, ImageFormat::Tiff];

/// A zlib stream of about `blocks` × 64 kB of zeros: fixed codes, and nothing but matches of 258 bytes.
///
/// RFC 1951, section 3.2.6: the literal 0 is 0011_0000; length 258 is the code of symbol 285, 1100_0101; the
/// distance 1 is 00000; the end of a block is 0000000. Codes are written with their first bit first.
fn zeros(megabytes: usize) -> Vec<u8> {
    let mut out = vec![0x78, 0x9c];
    let (mut bits, mut held) = (0_u64, 0);
    let mut put = |out: &mut Vec<u8>, code: &str| {
        for bit in code.bytes() {
            bits |= u64::from(bit == b'1') << held;
            held += 1;
            if held == 8 {
                out.push(bits as u8);
                (bits, held) = (0, 0);
            }
        }
    };
    // The last block, of fixed codes: 1, then 01 from its low bit.
    put(&mut out, "110");
    put(&mut out, "00110000");
    for _ in 0..megabytes * (1 << 20) / 258 {
        put(&mut out, "1100010100000");
    }
    put(&mut out, "0000000");
    put(&mut out, "0000000");
    out
}

/// The small picture with further chunks before its pixels.
fn png_with(chunks: &[Vec<u8>]) -> Vec<u8> {
    let png = encoded(ImageFormat::Png);
    // Signature and header are 8 and 25 bytes.
    [&png[..33], &chunks.concat(), &png[33..]].concat()
}

#[test]
fn what_a_png_carries_beside_its_pixels_does_not_unpack_to_a_gigabyte() {
    let bomb = zeros(1024);
    assert!(bomb.len() < 10 << 20, "{}", bomb.len());
    let (profile, compressed) = ([b"profile\0\0", &bomb[..]].concat(), [b"Comment\0\0", &bomb[..]].concat());
    let xmp = [b"XML:com.adobe.xmp\0\x01\0\0\0", &bomb[..]].concat();
    let iptc = [b"Raw profile type iptc\0\0", &bomb[..]].concat();
    for (name, chunk) in [
        ("profile", png_chunk(b"iCCP", &profile)),
        ("text", png_chunk(b"zTXt", &compressed)),
        ("metadata", png_chunk(b"zTXt", &iptc)),
        ("international text", png_chunk(b"iTXt", &xmp)),
    ] {
        let bytes = png_with(&[chunk]);
        let (result, memory) = measured(|| goal(&bytes));
        assert_eq!(result.unwrap().bitmap, goal(&encoded(ImageFormat::Png)).unwrap().bitmap, "{name}");
        assert!(memory < 256 << 20, "{name}: {} MB", memory >> 20);
        let (result, memory) = measured(|| Photo::from_bytes("picture", bytes));
        assert!(result.is_ok() && memory < 256 << 20, "{name}: {} MB", memory >> 20);
    }
    // The stream is what it is meant to be: a profile that is not too large is unpacked.
    let small = [b"profile\0\0", &zeros(8)[..]].concat();
    let (result, memory) = measured(|| goal(&png_with(&[png_chunk(b"iCCP", &small)])));
    assert!(result.is_ok() && memory > 8 << 20, "{memory}");
    // More text than anybody reads is an error that says so.
    let text = png_chunk(b"tEXt", &[b"Comment\0", &vec![b'a'; 20 << 20][..]].concat());
    let (result, memory) = measured(|| goal(&png_with(&[text.clone(), text])));
    let error = result.unwrap_err();
    assert!(matches!(error, GoalError::TooMuchBeside { .. }), "{error}");
    assert!(memory < 256 << 20, "{memory}");
}

#[test]
fn sides_that_no_picture_has_are_told_as_sizes() {
    for side in [8193_u32, 1 << 20, 1 << 31, u32::MAX] {
        let head = [&side.to_be_bytes()[..], &side.to_be_bytes(), &[8, 6, 0, 0, 0]].concat();
        let png = [&b"\x89PNG\r\n\x1a\n"[..], &png_chunk(b"IHDR", &head), &png_chunk(b"IDAT", &[0x78, 0x9c])]
            .concat();
        let (result, memory) = measured(|| goal(&png));
        let error = result.unwrap_err();
        assert!(matches!(error, GoalError::TooLarge { width, .. } if width == side), "{side}: {error}");
        assert!(memory < 1 << 20);
        // The same of a TIFF: width and height are the long values of tags 256 and 257.
        let mut tiff = encoded(ImageFormat::Tiff);
        for tag in [256_u16, 257] {
            let entry = tiff
                .windows(8)
                .position(|w| w[..2] == tag.to_le_bytes() && w[4..] == [1, 0, 0, 0] && w[3] == 0)
                .unwrap();
            tiff[entry + 2..entry + 12]
                .copy_from_slice(&[&[4, 0, 1, 0, 0, 0][..], &side.to_le_bytes()].concat());
        }
        let (result, memory) = measured(|| goal(&tiff));
        let error = result.unwrap_err();
        let told =
            matches!(error, GoalError::TooLarge { width, height, .. } if (width, height) == (side, side));
        assert!(told, "{side}: {error}");
        assert!(memory < 1 << 20);
    }
}

#[test]
fn whatever_breaks_off_is_refused() {
    for format in FORMATS {
        let whole = encoded(format);
        assert!(goal(&whole).is_ok(), "{format:?}");
        for part in [20, 30, 50, 60, 75, 90, 99] {
            let cut = &whole[..whole.len() * part / 100];
            let error = goal(cut).expect_err(&format!("{format:?} cut at {part} %"));
            assert!(matches!(error, GoalError::Damaged { .. }), "{format:?} at {part} %: {error}");
        }
    }
    for whole in [&include_bytes!("pictures/baseline.jpg")[..], include_bytes!("pictures/progressive.jpg")] {
        let read = goal(whole).unwrap();
        for length in (whole.len() / 5..whole.len()).step_by(97).chain([whole.len() - 1]) {
            let error = goal(&whole[..length]).expect_err(&length.to_string());
            assert!(matches!(error, GoalError::Damaged { .. }), "{length}: {error}");
        }
        // Bytes after the picture are ignored, and so is a thumbnail's own end marker.
        let trailing = [whole, b"\0\0\0 and more \xff\xd8\xff\xe0"].concat();
        assert_eq!(goal(&trailing).unwrap().bitmap, read.bitmap);
        let thumbnail = encoded(ImageFormat::Jpeg);
        let length = u16::try_from(thumbnail.len() + 2).unwrap().to_be_bytes();
        let with = [&whole[..2], &[0xff, 0xed], &length, &thumbnail, &whole[2..]].concat();
        assert_eq!(goal(&with).unwrap().bitmap, read.bitmap);
        assert!(goal(&with[..with.len() / 2]).is_err());
    }
    let error = goal(include_bytes!("pictures/half.jpg")).unwrap_err();
    assert!(error.to_string().contains("picture is damaged or incomplete: it breaks off"), "{error}");
}

#[test]
fn chunks_of_a_webp_end_within_it() {
    let webp = encoded(ImageFormat::WebP);
    let image = &webp[12..];
    let canvas =
        |flags: u8, side: u8| [b"VP8X\x0a\0\0\0", &[flags, 0, 0, 0, side, 0, 0, 51, 0, 0][..]].concat();
    let riff = |chunks: &[&[u8]]| {
        let body = chunks.concat();
        [b"RIFF", &u32::try_from(body.len() + 4).unwrap().to_le_bytes()[..], b"WEBP", &body].concat()
    };
    // Notes on orientation that claim four gigabytes.
    let exif = [&b"EXIF"[..], &u32::MAX.to_le_bytes(), &[1, 2, 3]].concat();
    let (result, memory) = measured(|| goal(&riff(&[&canvas(8, 59), image, &exif])));
    assert!(matches!(result, Err(GoalError::Damaged { .. })), "{result:?}");
    assert!(memory < 1 << 20, "{memory}");
    // The same behind the end of the picture is not looked at.
    let (result, memory) = measured(|| goal(&[riff(&[&canvas(0, 59), image]), exif.clone()].concat()));
    assert_eq!(result.unwrap().bitmap, goal(&webp).unwrap().bitmap);
    assert!(memory < 4 << 20, "{memory}");
    // A picture that is larger than its canvas.
    let (result, memory) = measured(|| goal(&riff(&[&canvas(0, 20), image])));
    assert!(matches!(result, Err(GoalError::Damaged { .. })), "{result:?}");
    assert!(memory < 1 << 20, "{memory}");
}

#[test]
fn of_an_animation_and_of_pages_the_first_is_taken_and_that_is_said() {
    let one = goal(&encoded(ImageFormat::WebP)).unwrap();
    assert_eq!(one.warnings, []);
    // Two frames: the picture, and the same again.
    let image = &encoded(ImageFormat::WebP)[12..];
    let frame = [&[0; 6][..], &[59, 0, 0, 51, 0, 0], &[100, 0, 0, 0], image].concat();
    let frame = [b"ANMF", &u32::try_from(frame.len()).unwrap().to_le_bytes()[..], &frame].concat();
    let canvas = b"VP8X\x0a\0\0\0\x02\0\0\0\x3b\0\0\x33\0\0";
    let body = [&canvas[..], b"ANIM\x06\0\0\0\xff\xff\xff\xff\0\0", &frame, &frame].concat();
    let length = u32::try_from(body.len() + 4).unwrap().to_le_bytes();
    let animated = goal(&[b"RIFF", &length[..], b"WEBP", &body].concat()).unwrap();
    // An animated PNG, and a TIFF whose first page is followed by the same again.
    let control = png_chunk(b"acTL", &[0, 0, 0, 2, 0, 0, 0, 0]);
    let frame = png_chunk(
        b"fcTL",
        &[&[0; 4][..], &[0, 0, 0, 60, 0, 0, 0, 52], &[0; 8], &[0, 1, 0, 9, 0, 0]].concat(),
    );
    let png = goal(&png_with(&[control, frame])).unwrap();
    let mut pages = encoded(ImageFormat::Tiff);
    let first = u32::from_le_bytes(*pages[4..].first_chunk().unwrap()) as usize;
    let entries = usize::from(u16::from_le_bytes(*pages[first..].first_chunk().unwrap()));
    let next = first + 2 + 12 * entries;
    let second = u32::try_from(pages.len()).unwrap().to_le_bytes();
    pages.extend_from_within(first..next + 4);
    pages[next..next + 4].copy_from_slice(&second);
    for (name, found) in [("WebP", animated), ("PNG", png), ("TIFF", goal(&pages).unwrap())] {
        assert_eq!(found.bitmap, one.bitmap, "{name}");
        let kinds: Vec<_> = found.warnings.iter().map(|w| w.kind()).collect();
        assert_eq!(kinds, ["several-pictures"], "{name}");
    }
}

#[test]
fn tiff_is_read_in_its_common_kinds() {
    let expected = goal(&encoded(ImageFormat::Png)).unwrap().bitmap;
    let rgb = DynamicImage::from(picture().to_rgb8());
    let gray =
        DynamicImage::from(GrayImage::from_fn(60, 52, |x, y| Luma([if is_tree(x, y) { 0 } else { 255 }])));
    let clear =
        RgbaImage::from_fn(60, 52, |x, y| image::Rgba([9, 9, 9, if is_tree(x, y) { 255 } else { 0 }]));
    for picture in [
        rgb.clone(),
        rgb.to_rgba8().into(),
        rgb.to_rgb16().into(),
        gray.clone(),
        gray.to_luma16().into(),
        clear.into(),
    ] {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, ImageFormat::Tiff).unwrap();
        assert_eq!(goal(&bytes.into_inner()).unwrap().bitmap, expected, "{:?}", picture.color());
    }
}

#[test]
fn readers_are_read_to_their_end_and_no_further_than_may_be() {
    /// Gives what it has a few bytes at a time, as a pipe may, and then zeros for ever.
    struct Pipe<'a>(&'a [u8], usize);
    impl Read for Pipe<'_> {
        fn read(&mut self, to: &mut [u8]) -> std::io::Result<usize> {
            let n = to.len().min(if self.0.is_empty() { to.len() } else { 7.min(self.0.len()) });
            if self.0.is_empty() {
                to.fill(0);
            } else {
                to[..n].copy_from_slice(&self.0[..n]);
                self.0 = &self.0[n..];
            }
            self.1 += n;
            Ok(n)
        }
    }
    let png = encoded(ImageFormat::Png);
    let read = Goal::from_reader("pipe", Pipe(&png, 0).take(png.len() as u64), &GoalOptions::default());
    assert_eq!(read.unwrap(), goal(&png).unwrap());
    // Reading stops at what is not a picture.
    let mut zeros = Pipe(b"", 0);
    let error = Encoded::read("zeros", &mut zeros).unwrap_err();
    assert!(matches!(error, GoalError::NotAnImage { .. }) && zeros.1 <= 64, "{error}, {} bytes", zeros.1);
    // What begins as one and never ends is given up at the limit.
    let mut endless = Pipe(&png, 0);
    let error = Encoded::read("endless", &mut endless).unwrap_err();
    assert!(matches!(error, GoalError::TooManyBytes { .. }), "{error}");
    assert!(endless.1 as u64 <= MAX_BYTES + 64, "{}", endless.1);
}

/// Bytes of a picture with some of them changed: single ones, runs, lengths that are huge, a cut, a copy of
/// one part over another.
fn mutated() -> impl Strategy<Value = Vec<u8>> {
    let change = (any::<u16>(), any::<u16>(), any::<u32>(), 0..6_u8);
    (0..FORMATS.len(), proptest::collection::vec(change, 1..6)).prop_map(|(format, changes)| {
        let mut bytes = encoded(FORMATS[format]);
        for (at, other, value, how) in changes {
            let length = bytes.len();
            // Most of what can go wrong is at the beginning.
            let at = if other % 2 == 0 { usize::from(at) % length } else { usize::from(at) % length.min(96) };
            let other = usize::from(other) % length;
            match how {
                0 => bytes[at] ^= value as u8 | 1,
                1 => bytes[at] = value as u8,
                2 if at + 4 <= length => {
                    let huge = if value % 3 == 0 { u32::MAX } else { value };
                    bytes[at..at + 4].copy_from_slice(&if value % 2 == 0 {
                        huge.to_be_bytes()
                    } else {
                        huge.to_le_bytes()
                    });
                }
                3 => bytes.truncate(at.max(16)),
                4 => {
                    let run = (value as usize % 32).min(length - at.max(other));
                    bytes.copy_within(at..at + run, other);
                }
                _ => {
                    let run = (value as usize % 64).min(length - at);
                    bytes.drain(at..at + run);
                }
            }
            if bytes.len() < 16 {
                break;
            }
        }
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn changed_bytes_end_in_a_goal_or_an_error(bytes in mutated()) {
        let (result, memory) = measured(|| {
            let result = goal(&bytes);
            if let Ok(photo) = Photo::from_bytes("picture", bytes.clone()) {
                let _ = Mask::from_photo(&photo, &MaskOptions::default());
            }
            result
        });
        // A picture of the most pixels takes this much, once as a goal and once as a photograph.
        prop_assert!(memory as u64 <= 12 * MAX_BYTES, "{} MB", memory >> 20);
        if let Err(error) = result {
            prop_assert!(error.to_string().contains("picture"), "{error}");
        }
    }
}
