//! Output of the program and the experiments: terminal and files.
//!
//! | module | idea |
//! | --- | --- |
//! | [`output`] | standard output and standard error: results, notes, warnings, tables |
//! | [`progress`] | bars, on a terminal only |
//! | [`files`] | files that appear whole or not at all |
//! | [`regular`] | files that are opened in place: never through links |
//! | [`text`] | text from outside: escaped for terminals and tables |
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
