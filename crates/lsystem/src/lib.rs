//! L-systems: a grammar language, derivation and a turtle that grows trees.
//!
//! Prusinkiewicz and Lindenmayer 1990, *The Algorithmic Beauty of Plants*; Hewitt 2017, §3.1.
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod derive;
pub mod diagnostic;
mod evolve;
mod family;
mod generator;
mod header;
mod parse;
mod plane;
mod program;
pub mod syntax;
mod system;
mod turtle;

pub use derive::{DeriveError, Limits};
pub use diagnostic::{Diagnostic, Fault, Report};
pub use family::LSystemFamily;
pub use generator::GrammarGenerator;
pub use header::Header;
pub use parse::MAX_BYTES;
pub use program::{Axis, Command};
pub use syntax::Grammar;
pub use system::{Derivation, Derived, LSystem};
pub use turtle::GrowFault;

impl Grammar {
    /// Reads the syntax of a grammar; names are looked up later.
    ///
    /// # Errors
    /// Every statement that cannot be read, with its place. `origin` (a file name) is for messages.
    pub fn parse(origin: &str, text: &str) -> Result<Self, Report> {
        let text = without_mark(text);
        let (grammar, problems) = parse::parse(text);
        if problems.is_empty() { Ok(grammar) } else { Err(Report::new(origin, text, problems)) }
    }
}

/// `text` without the byte-order mark that some editors put before it.
pub(crate) fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}
