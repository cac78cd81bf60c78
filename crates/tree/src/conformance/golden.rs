//! Texts as they were when someone last looked at them.

use std::path::Path;

/// Compares `found` with the file at `path`. With `PLEACH_BLESS` in the environment it writes the file
/// again; look at what has changed before you commit it.
///
/// # Panics
/// If they differ, with both, or if there is no such file.
pub fn assert_golden(path: &Path, found: &str) {
    if std::env::var_os("PLEACH_BLESS").is_some() {
        std::fs::write(path, found).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
    let expected =
        std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(found == expected, "{} has changed; found\n{found}\nexpected\n{expected}", path.display());
}
