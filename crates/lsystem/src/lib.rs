//! L-systems: a grammar language, derivation and a turtle that grows trees.
//!
//! Prusinkiewicz and Lindenmayer 1990, *The Algorithmic Beauty of Plants*; Hewitt 2017, §3.1.
//!
//! ```
//! use pleach_lsystem::{Derivation, LSystem};
//!
//! let plant = LSystem::read("plant.lsystem", "steps: 2\nangle: 25\naxiom: F\nF -> F[+F]F\n")?;
//! let string = plant.derive(&Derivation::default())?;
//! assert_eq!(string.to_text(), "F[+F]F[+F[+F]F]F[+F]F");
//! assert_eq!(string.count("F"), 9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A grammar grows trees as the generator of a species ([`GrammarGenerator`], [`LSystemFamily`]):
//!
//! ```
//! use pleach_lsystem::LSystemFamily;
//!
//! let species = pleach_tree::species::preset(&LSystemFamily, "hewitt_palm").unwrap();
//! let tree = species.grow(7)?;
//! assert!(!tree.stems.is_empty() && !tree.leaves.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(not(test), warn(clippy::disallowed_methods, clippy::disallowed_types))]

mod derive;
pub mod diagnostic;
mod edit;
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
pub use edit::{Edited, with_grammar};
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
