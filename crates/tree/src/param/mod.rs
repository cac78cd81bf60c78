//! Parameters, each declared once.
//!
//! From a [`Param`] follow reading and checking of species files, `pleach params`, the genome that
//! optimisers see, the features that blends see, and CSV columns. A [`ParamSpace`] lays the
//! parameters of one generator out as a flat list of *slots*, one number each: a scalar has one
//! slot, a list as many as it has numbers, a vector three.
//!
//! Generators whose parameters are the same for every species declare them as a
//! [table](crate::parameters): one row gives the declaration, the field that it is read into and when it
//! matters.
//!
//! Declarations may be owned, so that a species file can declare parameters of its own: a grammar's
//! constants, for example.
//!
//! Raw numbers become [`CheckedParams`] only through [`ParamSpace::check`] or
//! [`CheckedParams::set`]; only those grow, and only in generators of the same space.

mod checked;
mod declaration;
mod declared;
mod error;
mod fault;
mod handle;
mod kind;
mod select;
mod shown;
mod space;
pub mod table;

pub use checked::{CheckedParams, ForeignParams};
pub use declaration::{Effect, Param, Scale, Shape, Unit};
pub use declared::{Declared, DeclaredSlot};
pub use error::{Problem, SlotError};
pub use error::{is_word_of, nearest};
pub use fault::{DeclarationError, Fault};
pub use handle::Handle;
pub use kind::Kind;
pub use shown::shown;
pub(crate) use shown::{escaped, is_hidden};
pub use space::{ParamSpace, Slot, SlotInfo};

#[cfg(test)]
mod tests;
