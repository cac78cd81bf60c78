//! What is known of an encoded picture before it is decoded: its size, whether it is all there, and
//! whether it holds more pictures than one.
//!
//! Decoders trust lengths and sizes that a file claims, and some take what is missing for grey. So the
//! outer structure of a file is walked first, within the bytes that are there.

use image::ImageFormat;

/// What the structure of a file says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Structure {
    /// Width and height in pixels, where they are known before decoding.
    pub(super) size: Option<(u32, u32)>,
    /// Whether it holds further pictures: an animation, or pages.
    pub(super) several: bool,
    /// Bytes from the start that belong to the picture.
    pub(super) end: usize,
}

/// Walks the file; the error says what is wrong with it.
pub(super) fn structure(format: ImageFormat, bytes: &[u8]) -> Result<Structure, &'static str> {
    let whole = Structure { size: None, several: false, end: bytes.len() };
    match format {
        ImageFormat::Png => Ok(Structure { size: png_size(bytes), several: is_animated_png(bytes), ..whole }),
        ImageFormat::Jpeg => Ok(Structure { end: jpeg_end(bytes).ok_or("it breaks off")?, ..whole }),
        ImageFormat::WebP => webp(bytes),
        ImageFormat::Tiff => {
            let (size, several) = tiff(bytes).unwrap_or_default();
            Ok(Structure { size, several, ..whole })
        }
        ImageFormat::Gif => gif(bytes),
        ImageFormat::Bmp => Ok(Structure { size: bmp_size(bytes), ..whole }),
        _ => Ok(whole),
    }
}

fn be32(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|b| u32::from_be_bytes(*b))
}

fn le32(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|b| u32::from_le_bytes(*b))
}

fn le16(bytes: &[u8], at: usize) -> Option<u32> {
    bytes.get(at..)?.first_chunk().map(|b| u32::from(u16::from_le_bytes(*b)))
}

fn png_size(bytes: &[u8]) -> Option<(u32, u32)> {
    (bytes.get(12..16)? == b"IHDR").then_some((be32(bytes, 16)?, be32(bytes, 20)?))
}

/// Whether there is an animation of more than one frame.
fn is_animated_png(bytes: &[u8]) -> bool {
    let mut at = 8;
    while let (Some(length), Some(kind)) = (be32(bytes, at), bytes.get(at + 4..at + 8)) {
        match kind {
            b"acTL" => return be32(bytes, at + 8).is_some_and(|frames| frames > 1),
            b"IDAT" => return false,
            _ => at = at.saturating_add(12).saturating_add(length as usize),
        }
    }
    false
}

/// Where a JPEG ends, behind its end marker; `None` if it breaks off before.
///
/// ITU-T T.81, annex B: segments with a length, and after a start of scan coded data in which 0xFF is
/// followed by 0 or a restart marker. Pictures within a segment (thumbnails) are stepped over with it, and
/// what follows the end marker is not looked at.
fn jpeg_end(bytes: &[u8]) -> Option<usize> {
    const END: u8 = 0xd9;
    const SCAN: u8 = 0xda;
    let mut at = 2;
    loop {
        // To the next marker, over stuffed zeros, restart markers and coded data.
        let ff = at + bytes.get(at..)?.iter().position(|b| *b == 0xff)?;
        let marker = *bytes.get(ff + 1)?;
        at = match marker {
            0xff => ff + 1,
            0x00 | 0x01 | 0xd0..=0xd8 => ff + 2,
            END => return Some(ff + 2),
            _ => {
                let length = u16::from_be_bytes(*bytes.get(ff + 2..)?.first_chunk()?);
                let next = ff + 2 + usize::from(length.max(2));
                // A scan has at least one byte of data.
                if marker == SCAN && next >= bytes.len() {
                    return None;
                }
                next
            }
        };
    }
}

/// Size of a TIFF's first page, and whether it has another (TIFF 6.0, section 2); `None` if it breaks off.
fn tiff(bytes: &[u8]) -> Option<(Option<(u32, u32)>, bool)> {
    const WIDTH: u64 = 256;
    const HEIGHT: u64 = 257;
    let big_endian = bytes.starts_with(b"MM");
    let number = |at: usize, length: usize| -> Option<u64> {
        let bytes = bytes.get(at..at.checked_add(length)?)?;
        let join = |sum: u64, b: &u8| sum << 8 | u64::from(*b);
        Some(if big_endian { bytes.iter().fold(0, join) } else { bytes.iter().rev().fold(0, join) })
    };
    let place = |at, length| usize::try_from(number(at, length)?).ok();
    // 43 is BigTIFF: wider offsets, counts and entries.
    let (offset, count, entry, start) = if number(2, 2)? == 43 { (8, 8, 20, 8) } else { (4, 2, 12, 4) };
    let first = place(start, offset)?;
    let entries = place(first, count)?;
    let first = first.checked_add(count)?;
    let (mut width, mut height) = (None, None);
    // Entries are sorted by their tags.
    for at in (0..entries).map_while(|i| first.checked_add(i * entry).filter(|at| *at < bytes.len())) {
        // A short, a long, or what BigTIFF adds.
        let length = match number(at + 2, 2)? {
            3 => 2,
            16 => 8,
            _ => 4,
        };
        let value = || number(at + entry - offset, length).map(|v| u32::try_from(v).unwrap_or(u32::MAX));
        match number(at, 2)? {
            WIDTH => width = value(),
            HEIGHT => height = value(),
            tag if tag > HEIGHT => break,
            _ => {}
        }
    }
    let next = first.checked_add(entries.checked_mul(entry)?)?;
    Some((width.zip(height), number(next, offset).is_some_and(|next| next != 0)))
}

/// Where the value of a field of a TIFF's first page stands, if it is a short; in `BigTIFF` too.
pub(super) fn tiff_value(bytes: &[u8], tag: u16) -> Option<usize> {
    let big_endian = bytes.starts_with(b"MM");
    let number = |at: usize, length: usize| -> Option<usize> {
        let bytes = bytes.get(at..at.checked_add(length)?)?;
        let join = |sum: u64, b: &u8| sum << 8 | u64::from(*b);
        let number = if big_endian { bytes.iter().fold(0, join) } else { bytes.iter().rev().fold(0, join) };
        usize::try_from(number).ok()
    };
    let (offset, count, entry, start) = if number(2, 2)? == 43 { (8, 8, 20, 8) } else { (4, 2, 12, 4) };
    let first = number(start, offset)?;
    let entries = number(first, count)?;
    let first = first.checked_add(count)?;
    let mut places = (0..entries).map_while(|i| first.checked_add(i * entry).filter(|at| *at < bytes.len()));
    let place = places.find(|at| number(*at, 2) == Some(usize::from(tag)))?;
    const SHORT: usize = 3;
    (number(place + 2, 2)? == SHORT).then_some(place + entry - offset)
}

/// Size that the header of a BMP claims; a negative height stands for rows from the top.
fn bmp_size(bytes: &[u8]) -> Option<(u32, u32)> {
    /// Bytes of the oldest header, whose sizes are short.
    const OLDEST: u32 = 12;
    if le32(bytes, 14)? == OLDEST {
        return Some((le16(bytes, 18)?, le16(bytes, 20)?));
    }
    let side = |at| le32(bytes, at).map(|side| side.cast_signed().unsigned_abs());
    Some((side(18)?, side(22)?))
}

/// Walks the blocks of a GIF (GIF89a specification, CompuServe 1990) to the end of its first picture, and looks whether
/// another follows. The first picture must lie on the screen.
fn gif(bytes: &[u8]) -> Result<Structure, &'static str> {
    const CUT: &str = "it breaks off";
    const EXTENSION: u8 = 0x21;
    const PICTURE: u8 = 0x2c;
    // Bytes of a table of colours, if the flags say that there is one.
    let table = |flags: u8| if flags & 0x80 == 0 { 0 } else { 3 << ((flags & 7) + 1) };
    // Behind blocks of data that each say their length, up to one without any.
    let behind_data = |mut at: usize| loop {
        match *bytes.get(at).ok_or(CUT)? {
            0 => return Ok::<usize, &'static str>(at + 1),
            length => at += 1 + usize::from(length),
        }
    };
    let screen = le16(bytes, 6).zip(le16(bytes, 8)).ok_or(CUT)?;
    let mut at = 13 + table(*bytes.get(10).ok_or(CUT)?);
    let mut pictures = 0;
    while pictures < 2 {
        match bytes.get(at) {
            Some(&EXTENSION) => at = behind_data(at + 2)?,
            Some(&PICTURE) => {
                let field = |offset| le16(bytes, at + offset).ok_or(CUT);
                let [left, top, width, height] = [field(1)?, field(3)?, field(5)?, field(7)?];
                if pictures == 0 && (left + width > screen.0 || top + height > screen.1) {
                    return Err("its first picture does not lie on its screen");
                }
                let flags = *bytes.get(at + 9).ok_or(CUT)?;
                at = match (behind_data(at + 11 + table(flags)), pictures) {
                    (Ok(at), _) => at,
                    (Err(cut), 0) => return Err(cut),
                    // The first picture is whole.
                    _ => break,
                };
                pictures += 1;
            }
            _ => break,
        }
    }
    if pictures == 0 {
        return Err("it has no picture");
    }
    Ok(Structure { size: Some(screen), several: pictures > 1, end: bytes.len() })
}

/// Walks the chunks of a WebP (RFC 9649, section 2): all must end within the file, and pictures within
/// must not be larger than the canvas.
fn webp(bytes: &[u8]) -> Result<Structure, &'static str> {
    const CUT: &str = "it breaks off";
    let riff = le32(bytes, 4).ok_or(CUT)? as usize;
    let end = bytes.len().min(riff.saturating_add(8));
    let bytes = &bytes[..end];
    let mut found = Structure { size: None, several: false, end };
    let mut at = 12;
    let mut first = true;
    let mut canvas = None;
    while let (Some(kind), Some(length)) = (bytes.get(at..at + 4), le32(bytes, at + 4)) {
        let data = bytes.get(at + 8..(at + 8).saturating_add(length as usize)).ok_or(CUT)?;
        if first && kind == b"VP8X" {
            found.several = data.first().is_some_and(|flags| flags & 2 != 0);
            let side = |at| data.get(at..at + 3).map(|b| 1 + (le32(&[b, &[0]].concat(), 0).unwrap_or(0)));
            canvas = side(4).zip(side(7));
            found.size = canvas;
        }
        // Frames of an animation have sixteen bytes before their chunks.
        let size = match kind {
            b"ANMF" => data.get(16..).and_then(frame_size),
            _ => picture_size(kind, data),
        };
        if let (Some((width, height)), Some((most_width, most_height))) = (size, canvas)
            && (width > most_width || height > most_height)
        {
            return Err("a picture in it is larger than its canvas");
        }
        found.size = found.size.or(size);
        first = false;
        at = (at + 8).saturating_add(length as usize).saturating_add(length as usize & 1);
    }
    Ok(found)
}

/// Size of the picture in a frame of an animation: in its first chunks, one of which may be opacity.
fn frame_size(mut frame: &[u8]) -> Option<(u32, u32)> {
    loop {
        let (kind, length) = (frame.get(..4)?, le32(frame, 4)? as usize);
        let data = frame.get(8..)?;
        if let Some(size) = picture_size(kind, data) {
            return Some(size);
        }
        frame = data.get(length.saturating_add(length & 1)..)?;
    }
}

/// Size that a bitstream claims, lossy or lossless.
fn picture_size(kind: &[u8], data: &[u8]) -> Option<(u32, u32)> {
    const SIDE: u32 = 0x3fff;
    match kind {
        b"VP8 " => Some((le16(data, 6)? & SIDE, le16(data, 8)? & SIDE)),
        b"VP8L" => {
            let bits = le32(data, 1)?;
            Some((1 + (bits & SIDE), 1 + (bits >> 14 & SIDE)))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jpeg_ends_at_its_own_end_marker() {
        // A thumbnail with an end marker of its own, stuffing, a restart marker and fill bytes.
        let thumbnail = [0xff, 0xe1, 0, 6, 0xff, 0xd8, 0xff, 0xd9];
        let scan = [0xff, 0xda, 0, 3, 1, 7, 0xff, 0, 9, 0xff, 0xd3, 0xff, 0xff, 0xc4, 0, 2, 5];
        let head = [0xff, 0xd8].iter().chain(&thumbnail).chain(&scan).copied().collect::<Vec<u8>>();
        assert_eq!(jpeg_end(&head), None);
        for length in 0..head.len() {
            assert_eq!(jpeg_end(&head[..length]), None, "{length}");
        }
        let whole = [&head[..], &[0xff, 0xd9]].concat();
        assert_eq!(jpeg_end(&whole), Some(whole.len()));
        assert_eq!(jpeg_end(&[&whole[..], b"and more \xff\xd8\xff"].concat()), Some(whole.len()));
    }

    #[test]
    fn the_first_picture_of_a_gif_is_whole_and_on_its_screen() {
        let head = [b"GIF89a", &[4, 0, 3, 0, 0x80, 0, 0][..], &[0, 0, 0, 9, 9, 9]].concat();
        let note = [0x21, 0xfe, 2, b'h', b'i', 0];
        let picture = |width: u8| [0x2c, 1, 0, 0, 0, width, 0, 3, 0, 0, 2, 3, 7, 7, 7, 0];
        let file = [&head[..], &note, &picture(3), &[0x3b]].concat();
        let size = Some((4, 3));
        assert_eq!(gif(&file), Ok(Structure { size, several: false, end: file.len() }));
        let two = [&file[..file.len() - 1], &picture(2), &[0x3b]].concat();
        assert_eq!(gif(&two), Ok(Structure { size, several: true, end: two.len() }));
        for length in 0..file.len() - 1 {
            assert!(gif(&file[..length]).is_err(), "{length}");
        }
        let wide = [&head[..], &picture(4), &[0x3b]].concat();
        assert_eq!(gif(&wide), Err("its first picture does not lie on its screen"));
    }

    #[test]
    fn pages_and_sizes_are_read_in_either_order_of_bytes() {
        for (next, several) in [(0, false), (200, true)] {
            let entries =
                [[0, 1, 3, 0, 1, 0, 0, 0, 44, 1, 9, 9], [1, 1, 4, 0, 1, 0, 0, 0, 7, 0, 1, 0]].concat();
            let little = [b"II*\0", &[8, 0, 0, 0][..], &[2, 0], &entries, &[next, 0, 0, 0]].concat();
            assert_eq!(tiff(&little), Some((Some((300, 65_543)), several)));
            let entries =
                [[1, 0, 0, 3, 0, 0, 0, 1, 1, 44, 9, 9], [1, 1, 0, 4, 0, 0, 0, 1, 0, 1, 0, 7]].concat();
            let big = [b"MM\0*", &[0, 0, 0, 8][..], &[0, 2], &entries, &[0, 0, 0, next]].concat();
            assert_eq!(tiff(&big), Some((Some((300, 65_543)), several)));
        }
        assert_eq!(tiff(b"II*\0\xff\xff\xff\xff"), None);
        assert_eq!(tiff(b"II+\0\x08\0\0\0\x10\0\0\0\0\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff"), None);
    }
}
