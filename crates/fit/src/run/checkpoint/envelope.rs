//! The line of text before a checkpoint's body, and its checksum.

use super::error::CheckpointError;
use std::path::Path;

/// The number in the header; files of other formats are refused.
const FORMAT: u32 = 6;
const MAGIC: &str = "pleach-checkpoint";
/// Longest header in bytes: names of generators and optimisers are short.
const MAX_HEADER: usize = 200;

/// Header and body; `of` is the name of the run.
pub(crate) fn sealed(name: &str, body: &[u8]) -> Vec<u8> {
    let start = format!("{MAGIC} {FORMAT} {name} {} ", body.len());
    let checksum = checksum(start.as_bytes(), body);
    [format!("{start}{checksum:08x}\n").as_bytes(), body].concat()
}

/// Whether a file that begins with `bytes` is a checkpoint by its first word, of whatever format.
pub(super) fn begins(bytes: &[u8]) -> bool {
    bytes.strip_prefix(MAGIC.as_bytes()).is_some_and(|rest| rest.first() == Some(&b' '))
}

/// Bytes that are enough for [`begins`].
pub(super) const BEGINNING: usize = MAGIC.len() + 1;

/// The body of `bytes`, if header, length and checksum agree.
pub(super) fn opened<'a>(path: &Path, bytes: &'a [u8]) -> Result<&'a [u8], CheckpointError> {
    let not_one = || CheckpointError::NotACheckpoint { path: path.to_owned() };
    let end = bytes.iter().take(MAX_HEADER).position(|&b| b == b'\n').ok_or_else(not_one)?;
    let header = std::str::from_utf8(&bytes[..end]).map_err(|_| not_one())?;
    let rest = header.strip_prefix(MAGIC).and_then(|rest| rest.strip_prefix(' ')).ok_or_else(not_one)?;
    let format = rest.split(' ').next().unwrap_or_default();
    if format.is_empty() || !format.bytes().all(|b| b.is_ascii_digit()) {
        return Err(not_one());
    }
    if format != FORMAT.to_string() {
        return Err(CheckpointError::OtherFormat {
            path: path.to_owned(),
            found: format.to_owned(),
            expected: FORMAT,
        });
    }
    let [_, _, length, digits] = rest.split(' ').collect::<Vec<_>>()[..] else {
        return Err(not_one());
    };
    let expected: usize = length.parse().map_err(|_| not_one())?;
    let body = &bytes[end + 1..];
    if body.len() != expected {
        return Err(CheckpointError::WrongLength { path: path.to_owned(), expected, found: body.len() });
    }
    let start = &header.as_bytes()[..header.len() - digits.len()];
    // One way to write a checksum, so that no byte of the file can change unnoticed.
    if format!("{:08x}", checksum(start, body)) != digits {
        return Err(CheckpointError::WrongChecksum { path: path.to_owned() });
    }
    Ok(body)
}

fn checksum(start: &[u8], body: &[u8]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(start);
    hasher.update(body);
    hasher.finalize()
}
