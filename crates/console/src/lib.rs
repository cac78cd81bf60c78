//! What the program and the experiments say to people and write to disks.
//!
//! | module | idea |
//! | --- | --- |
//! | [`output`] | standard output and standard error: results, notes, warnings, tables |
//! | [`progress`] | bars that only a person sees |
//! | [`files`] | files that appear whole or not at all |
//! | [`regular`] | files that are opened in place: never through links |
//! | [`text`] | other people's text: escaped for terminals and tables |
//! | [`signals`] | ctrl-C and requests to end |
//! | [`interrupted`] | the error of a run that was asked to stop |
//!
//! The crates below this one neither print nor catch signals.

pub mod files;
pub mod interrupted;
pub mod output;
pub mod progress;
pub mod regular;
pub mod signals;
pub mod text;
