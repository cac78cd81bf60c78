//! Parameters, each declared once.
//!
//! From a [`Param`] follow reading and checking of species files, `pleach params`, the genome that
//! optimisers see, the features that blends see, and CSV columns. A [`ParamSpace`] lays the
//! parameters of one generator out as a flat list of *slots*, one number each: a scalar has one
//! slot, a per-level parameter four, a vector three.
//!
//! Raw numbers become [`CheckedParams`] only through [`ParamSpace::check`] or
//! [`CheckedParams::set`]; only those grow.

mod checked;
mod declaration;
mod error;
mod select;
mod shown;
mod space;

pub use checked::CheckedParams;
pub use declaration::{Kind, Layout, Param, Source, Unit};
pub use error::{Problem, SlotError};
pub use error::{is_word_of, nearest};
pub use shown::shown;
pub(crate) use shown::{escaped, is_hidden};
pub use space::{ParamSpace, Slot};
