//! An end that was asked for.

use std::fmt;

/// The command was asked to stop before it was done; holds what to tell about it. The program then ends
/// with code 130, as shells expect of an interrupted command.
#[derive(Debug)]
pub(crate) struct Interrupted(pub(crate) String);

impl fmt::Display for Interrupted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Interrupted {}
