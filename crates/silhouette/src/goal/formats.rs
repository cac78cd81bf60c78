//! Formats that are read, and those that are not, recognised by their first bytes, with what converts them.

use image::ImageFormat;

/// Bytes at a file's start that [`foreign`] looks at.
pub(super) const HEAD: usize = 16;

/// The formats that are read, some of them by a feature.
pub(super) const READ: [(ImageFormat, &str); 6] = [
    (ImageFormat::Png, "PNG"),
    (ImageFormat::Jpeg, "JPEG"),
    (ImageFormat::WebP, "WebP"),
    (ImageFormat::Tiff, "TIFF"),
    (ImageFormat::Gif, "GIF"),
    (ImageFormat::Bmp, "BMP"),
];

/// The names of the formats that are read.
pub(super) fn known() -> String {
    let names: Vec<&str> =
        READ.iter().filter(|(read, _)| read.reading_enabled()).map(|(_, name)| *name).collect();
    let drawings = cfg!(feature = "pictures").then_some("SVG");
    let names: Vec<&str> = names.into_iter().chain(drawings).collect();
    let (last, others) = names.split_last().map_or(("", &names[..]), |(last, others)| (*last, others));
    format!("{} and {last}", others.join(", "))
}

/// The name of a format that is not read, and a command that converts it to PNG.
pub(super) fn foreign(head: &[u8]) -> Option<(&'static str, &'static str)> {
    const MAGICK: &str = "ImageMagick does: magick IN out.png";
    if head.get(4..8) == Some(b"ftyp") {
        return match head.get(8..12)? {
            b"avif" | b"avis" => Some(("AVIF", "libavif does: avifdec IN out.png")),
            b"heic" | b"heix" | b"heim" | b"heis" | b"hevc" | b"hevx" | b"mif1" | b"msf1" => {
                Some(("HEIC", "libheif and ImageMagick do: heif-convert IN out.png, or magick IN out.png"))
            }
            _ => None,
        };
    }
    let begins = |with: &[u8]| head.starts_with(with);
    if begins(b"GIF8") {
        Some(("GIF", "ImageMagick does: magick IN[0] out.png"))
    } else if is_bmp(head) {
        Some(("BMP", MAGICK))
    } else if begins(b"\x00\x00\x00\x0cjP  ") || begins(b"\xff\x4f\xff\x51") {
        Some(("JPEG 2000", MAGICK))
    } else if begins(b"\xff\x0a") || begins(b"\x00\x00\x00\x0cJXL ") {
        Some(("JPEG XL", "libjxl does: djxl IN out.png"))
    } else if begins(b"8BPS") {
        Some(("Photoshop", "ImageMagick does: magick IN[0] out.png"))
    } else if begins(b"%PDF") {
        Some(("PDF", "poppler does: pdftoppm -png -singlefile IN out"))
    } else if is_svg(head) {
        Some(("SVG", "librsvg does: rsvg-convert IN -o out.png"))
    } else {
        None
    }
}

/// Whether a file begins as a drawing in SVG does.
pub(super) fn is_svg(head: &[u8]) -> bool {
    // White space and a mark of the order of bytes may go before a tag.
    let text = head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head).trim_ascii_start();
    let begins = |tag: &&[u8]| text.get(..tag.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(tag));
    [&b"<svg"[..], b"<?xml", b"<!--", b"<!doctype svg"].iter().any(begins)
}

/// Whether a file begins as a BMP does: two letters, its length, and nothing.
pub(super) fn is_bmp(head: &[u8]) -> bool {
    head.starts_with(b"BM") && head.get(6..10) == Some(&[0; 4])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_known_by_their_first_bytes() {
        for (head, name) in [
            (&b"\0\0\0\x18ftypheic\0\0\0\0"[..], Some("HEIC")),
            (b"\0\0\0\x20ftypavif\0\0\0\0", Some("AVIF")),
            (b"\0\0\0\x20ftypisom\0\0\0\0", None),
            (b"GIF89a\x01\0\x01\0", Some("GIF")),
            (b"BM\x36\x01\0\0\0\0\0\0\x36", Some("BMP")),
            (b"BMW and other cars", None),
            (b"\n <svg xmlns=", Some("SVG")),
            (b"\xef\xbb\xbf<?xml ", Some("SVG")),
            (b"<!doctype svg>", Some("SVG")),
            (b"<!-- drawn by", Some("SVG")),
            (b"plain text", None),
            (b"", None),
        ] {
            assert_eq!(foreign(head).map(|found| found.0), name, "{head:?}");
        }
    }
}
