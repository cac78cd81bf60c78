//! Species from files and streams: bounded, and distinguished from other files.

use crate::error::{MAX_BYTES, RegistryError};
use crate::families::{default_family, family, family_names};
use pleach_tree::param::Problem;
use pleach_tree::species::{Issue, safe_name};
use pleach_tree::{Species, SpeciesDoc, SpeciesError};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Reads a species file; a file without a name is called by its own.
///
/// # Errors
/// See [`RegistryError`].
pub fn read_file(path: &Path) -> Result<Species, RegistryError> {
    let file =
        File::open(path).map_err(|source| RegistryError::Unreadable { path: path.to_owned(), source })?;
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    from(file, path, &stem)
}

/// Reads a species from a stream to its end, or to the 4 MiB that a species may have. `name` is what
/// messages call it, and the species too if it has no name of its own.
///
/// # Errors
/// See [`RegistryError`].
pub fn read(reader: impl Read, name: &str) -> Result<Species, RegistryError> {
    from(reader, Path::new(name), name)
}

fn from(reader: impl Read, path: &Path, name: &str) -> Result<Species, RegistryError> {
    // One byte more distinguishes a file of the largest size from a larger one. The size that a device
    // reports cannot be trusted, so it is not asked.
    let mut bytes = Vec::new();
    reader
        .take(MAX_BYTES + 1)
        .read_to_end(&mut bytes)
        .map_err(|source| RegistryError::Unreadable { path: path.to_owned(), source })?;
    if let Some(kind) = picture(&bytes) {
        return Err(RegistryError::Picture { path: path.to_owned(), kind });
    }
    if bytes.len() as u64 > MAX_BYTES {
        return Err(RegistryError::TooLarge { path: path.to_owned() });
    }
    let origin = path.display().to_string();
    let text = utf8(&bytes, &origin)?;
    let mut species = read_text(&origin, text)?;
    if species.name.is_empty() {
        species.name = safe_name(name);
    }
    Ok(species)
}

/// Reads the text of a species file; `origin` is for messages.
///
/// # Errors
/// Every problem of the text, with line and column.
pub fn read_text(origin: &str, text: &str) -> Result<Species, SpeciesError> {
    let doc = SpeciesDoc::parse(origin, text)?;
    let wrong = |issue| doc.wrong(vec![issue]);
    let name = doc.text("generator").map_err(wrong)?.unwrap_or_else(|| default_family().name());
    let Ok(family) = family(name) else {
        let span = doc.get("generator").map_or(0..0, |node| node.span.clone());
        let problem = Problem::UnknownChoice {
            value: name.to_owned(),
            known: family_names().into_iter().map(str::to_owned).collect(),
            nearest: None,
        };
        return Err(wrong(doc.issue(span, "generator", problem)));
    };
    doc.species(family)
}

/// `bytes` as text, or where they stop to be any.
fn utf8<'a>(bytes: &'a [u8], origin: &str) -> Result<&'a str, SpeciesError> {
    std::str::from_utf8(bytes).map_err(|error| {
        let at = error.valid_up_to();
        let before = std::str::from_utf8(&bytes[..at]).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().map_or(0, |last| last.chars().count()) + 1;
        let message = format!("the byte 0x{:02x} is not UTF-8 text, expected a species file", bytes[at]);
        let issue = Issue {
            origin: origin.to_owned(),
            line,
            column,
            span: at..at + 1,
            parameter: String::new(),
            problem: Problem::Syntax { message },
            help: None,
        };
        // The line as far as it is text, which has the place right before its end.
        SpeciesError::new(before, vec![issue])
    })
}

/// The format of a picture, by its first bytes.
fn picture(bytes: &[u8]) -> Option<&'static str> {
    const STARTS: [(&[u8], &str); 7] = [
        (b"\x89PNG", "PNG"),
        (b"\xff\xd8\xff", "JPEG"),
        (b"GIF8", "GIF"),
        (b"II*\0", "TIFF"),
        (b"MM\0*", "TIFF"),
        (b"BM", "BMP"),
        (b"RIFF", "WebP"),
    ];
    let (_, kind) = STARTS.into_iter().find(|(start, _)| bytes.starts_with(start))?;
    let sure = match kind {
        "WebP" => bytes.get(8..12) == Some(b"WEBP"),
        // Two letters may begin a species file.
        "BMP" => bytes.get(6..10) == Some(&[0; 4]),
        _ => true,
    };
    sure.then_some(kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(bytes: &[u8]) -> String {
        read(bytes, "it").map(|s| s.name).unwrap_err().to_string()
    }

    #[test]
    fn a_stream_without_an_end_is_read_to_the_limit() {
        let told = read(std::io::repeat(b'#'), "it").unwrap_err();
        assert!(matches!(told, RegistryError::TooLarge { .. }), "{told}");
        let all = vec![b'#'; MAX_BYTES as usize];
        assert_eq!(read(all.as_slice(), "a/b").unwrap().name, "a_b");
    }

    #[test]
    fn what_is_no_text_is_told_with_its_place() {
        assert_eq!(
            message(b"levels = 3\nname = \"B\xe4umchen\""),
            "it:2:10: the byte 0xe4 is not UTF-8 text, expected a species file"
        );
        assert!(message(b"\x89PNG\r\n\x1a\n").contains("it is a PNG picture"));
        assert!(message(b"RIFF\0\0\0\0WEBPVP8 ").contains("WebP picture"));
        assert!(message(b"\xff\xd8\xff\xe0").contains("JPEG picture"));
        assert!(message(b"BM = 3").contains("`BM` is not a known name"));
    }
}
