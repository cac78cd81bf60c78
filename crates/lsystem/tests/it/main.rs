//! Tests of the whole crate, in one program so that it is linked once.

mod classics;
mod diagnostics;
mod language;
mod normal_form;
mod strings;
mod table;
