//! A picture of half floats as an OpenEXR file: one part of scan lines that are not compressed.
//!
//! After "OpenEXR File Layout" (openexr.com). The textures are small, and a writer of all that the format has would be
//! many times as long as this one. All numbers are little-endian.

use glam::UVec2;

/// The first four bytes of every file.
const MAGIC: u32 = 20_000_630;
/// Version 2, with none of the flags that say tiles, long names, several parts or deep pixels.
const VERSION: u32 = 2;
/// The type of samples.
const HALF: i32 = 1;
/// Channels in the order in which files have them, each with its place in a pixel.
const CHANNELS: [(&str, usize); 4] = [("A", 3), ("B", 2), ("G", 1), ("R", 0)];

/// The file of a picture of this size, whose pixels are bits of half floats: red, green, blue, alpha, row by row from
/// the top.
pub(super) fn file(size: UVec2, pixels: &[[u16; 4]]) -> Vec<u8> {
    let mut file = header(size);
    let line = 2 * CHANNELS.len() as u32 * size.x;
    // Where each line is, and then the lines, each behind its number and its bytes.
    let first = file.len() as u64 + 8 * u64::from(size.y);
    for y in 0..u64::from(size.y) {
        file.extend((first + y * (8 + u64::from(line))).to_le_bytes());
    }
    for (y, row) in (0..size.y).zip(pixels.chunks_exact(size.x as usize)) {
        file.extend(y.to_le_bytes());
        file.extend(line.to_le_bytes());
        for (_, place) in CHANNELS {
            file.extend(row.iter().flat_map(|pixel| pixel[place].to_le_bytes()));
        }
    }
    file
}

fn header(size: UVec2) -> Vec<u8> {
    let mut file = Vec::new();
    file.extend(MAGIC.to_le_bytes());
    file.extend(VERSION.to_le_bytes());
    let window: Vec<u8> = [0, 0, size.x - 1, size.y - 1].iter().flat_map(|at| at.to_le_bytes()).collect();
    let one = 1.0_f32.to_le_bytes();
    for (name, kind, value) in [
        ("channels", "chlist", &channels()[..]),
        ("compression", "compression", &[0]),
        ("dataWindow", "box2i", &window),
        ("displayWindow", "box2i", &window),
        ("lineOrder", "lineOrder", &[0]),
        ("pixelAspectRatio", "float", &one),
        ("screenWindowCenter", "v2f", &[0; 8]),
        ("screenWindowWidth", "float", &one),
    ] {
        for text in [name, kind] {
            file.extend(text.as_bytes());
            file.push(0);
        }
        file.extend((value.len() as u32).to_le_bytes());
        file.extend(value);
    }
    file.push(0);
    file
}

/// The list of channels: of each its name, its type, four bytes that say nothing here, and that it has every pixel.
fn channels() -> Vec<u8> {
    let mut list = Vec::new();
    for (name, _) in CHANNELS {
        list.extend(name.as_bytes());
        list.push(0);
        for number in [HALF, 0, 1, 1] {
            list.extend(number.to_le_bytes());
        }
    }
    list.push(0);
    list
}
