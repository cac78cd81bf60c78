//! Pictures of telephones, converted by a program of the system.

use crate::{other_program, output};
use anyhow::{Context, bail};
use pleach_silhouette::goal::{Encoded, GoalError, MAX_BYTES};
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;
use std::time::Duration;

/// A picture takes a second or two.
const MAX_TIME: Duration = Duration::from_secs(60);

/// The format that is converted, as errors call it.
const FORMAT: &str = "HEIC";

/// Programs that read HEIC and write PNG, with their arguments: of libheif, its newer name, of macOS, of ImageMagick.
const PROGRAMS: [&[&str]; 4] = [
    &["heif-convert", "{in}", "{out}"],
    &["heif-dec", "{in}", "{out}"],
    &["sips", "-s", "format", "png", "{in}", "--out", "{out}"],
    &["magick", "{in}", "{out}"],
];

/// That the file at `path` has to be converted first, by its first bytes.
pub(crate) fn reason(path: &Path) -> Option<GoalError> {
    let mut head = Vec::new();
    let _ = File::open(path).ok()?.take(16).read_to_end(&mut head).ok()?;
    Encoded::read(path, &*head).err().filter(is_for)
}

/// Whether `error` is that a picture has to be converted first.
fn is_for(error: &GoalError) -> bool {
    matches!(error, GoalError::OtherFormat { format, .. } if *format == FORMAT)
}

/// The picture at `path` as PNG, if `error` is that it is HEIC and a program of the system converts it.
///
/// # Errors
/// `error`, if the picture is of another format or no program is there; otherwise what the program said.
pub(crate) fn converted(path: &Path, error: GoalError) -> anyhow::Result<Encoded> {
    if !is_for(&error) {
        return Err(error.into());
    }
    let folder = tempfile::tempdir().context("no temporary folder")?;
    let [input, out, log] = ["photo.heic", "photo.png", "log.txt"].map(|name| folder.path().join(name));
    // A copy, since a name may begin with a hyphen.
    let mut bytes = Vec::new();
    File::open(path)?.take(MAX_BYTES).read_to_end(&mut bytes)?;
    std::fs::write(&input, &bytes)?;
    for program in PROGRAMS {
        let place = |word: &&str| match *word {
            "{in}" => input.display().to_string(),
            "{out}" => out.display().to_string(),
            word => word.to_owned(),
        };
        let words: Vec<String> = program.iter().map(place).collect();
        let said = || format!("{} does not convert {}", program[0], path.display());
        match other_program::run(&words, &log, MAX_TIME) {
            Err(error) if is_missing(&error) => continue,
            ended => {
                let status = ended.with_context(said)?;
                if !status.success() || !out.is_file() {
                    bail!("{}: {status}{}", said(), other_program::last_of(&log));
                }
            }
        }
        output::note(format!("{}: converted by {}", path.display(), program[0]));
        let picture = Encoded::load(&out).with_context(said)?;
        // Converters write dates, so what a run is known by is the file itself.
        return Ok(Encoded::new(path, picture.bytes().to_vec()).converted_from(bytes));
    }
    let names: Vec<&str> = PROGRAMS.iter().map(|program| program[0]).collect();
    Err(anyhow::Error::from(error).context(format!(
        "{} is a {FORMAT} picture, and none of the programs that convert it is installed ({}); libheif has \
         heif-convert, in the package libheif-examples of Debian and libheif of others",
        path.display(),
        names.join(", ")
    )))
}

/// Whether a program is not there.
fn is_missing(error: &anyhow::Error) -> bool {
    let cause = error.root_cause().downcast_ref::<std::io::Error>();
    cause.is_some_and(|cause| cause.kind() == ErrorKind::NotFound)
}
