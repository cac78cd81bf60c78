//! Species from files and streams, of pleach and of other programs: bounded, and distinguished from other files.

use crate::error::{MAX_BYTES, RegistryError};
use crate::families::{default_family, family, family_names};
use crate::measured;
use pleach_import::{Foreign, MAX_SKELETON_BYTES};
use pleach_tree::param::Problem;
use pleach_tree::species::{Issue, safe_name};
use pleach_tree::{Species, SpeciesDoc, SpeciesError};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// Reads a species file, one of another program, or a measured tree ([`pleach_import`]); a file without a name is called by its own.
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
    let origin = path.display().to_string();
    let bytes = load(reader, path)?;
    if is_skeleton(&origin, &bytes) {
        return Ok(named(measured::species(pleach_import::read_skeleton(&origin, &bytes)?), name));
    }
    let text = utf8(&bytes, &origin)?;
    let species = if pleach_import::is_foreign(&origin, text) {
        foreign(&origin, text)?.0
    } else {
        read_text(&origin, text)?
    };
    Ok(named(species, name))
}

/// Reads a species of another program from a stream, and what is to be said of its translation. `name` is what messages
/// call the stream; the species is called by its file name without ending, where it has no name of its own.
///
/// # Errors
/// See [`RegistryError`]; a species file of pleach is one.
pub fn import(reader: impl Read, name: &str) -> Result<(Species, Foreign), RegistryError> {
    let path = Path::new(name);
    let bytes = load(reader, path)?;
    let text = utf8(&bytes, name)?;
    if !pleach_import::is_foreign(name, text) {
        return Err(RegistryError::NotForeign { path: path.to_owned() });
    }
    let (species, foreign) = foreign(name, text)?;
    Ok((named(species, &path.file_stem().unwrap_or_default().to_string_lossy()), foreign))
}

/// The bytes of a file that may be a species.
fn load(reader: impl Read, path: &Path) -> Result<Vec<u8>, RegistryError> {
    // One byte more distinguishes a file of the largest size from a larger one. The size that a device
    // reports cannot be trusted, so it is not asked.
    let (mut reader, mut bytes) = (reader, Vec::new());
    let unreadable = |source| RegistryError::Unreadable { path: path.to_owned(), source };
    reader.by_ref().take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
    if is_skeleton(&path.to_string_lossy(), &bytes) {
        // One more is told by the error of the skeleton.
        let rest = (MAX_SKELETON_BYTES + 1).saturating_sub(bytes.len() as u64);
        reader.take(rest).read_to_end(&mut bytes).map_err(unreadable)?;
        return Ok(bytes);
    }
    if let Some(kind) = picture(&bytes) {
        return Err(RegistryError::Picture { path: path.to_owned(), kind });
    }
    if bytes.len() as u64 > MAX_BYTES {
        return Err(RegistryError::TooLarge { path: path.to_owned() });
    }
    Ok(bytes)
}

/// Whether the file holds a measured tree. In the page it does not: there are no files but species', and the readers
/// would make its module 0.1 MB larger.
fn is_skeleton(origin: &str, start: &[u8]) -> bool {
    cfg!(not(target_arch = "wasm32")) && pleach_import::is_skeleton(origin, start)
}

/// `species`, which is called `name` if it has no name of its own.
fn named(mut species: Species, name: &str) -> Species {
    if species.name.is_empty() {
        species.name = safe_name(name);
    }
    species
}

/// The species that a file of another program describes.
fn foreign(origin: &str, text: &str) -> Result<(Species, Foreign), SpeciesError> {
    let foreign = pleach_import::translate(origin, text)?;
    match read_text(origin, &foreign.toml) {
        Ok(species) => Ok((species, foreign)),
        Err(error) => Err(foreign.relocated(origin, text, error)),
    }
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
