//! The suite that every family of generators passes: what the documentation of
//! [`Generator`](crate::Generator) and [`Family`](crate::Family) promises, sentence by sentence, and
//! nothing else.
//!
//! One line in a test of the family's crate, with the feature `conformance`:
//!
//! ```ignore
//! pleach_tree::conformance!(WeberPennFamily);
//! ```
//!
//! It makes one test of each promise, which all species of the family have to keep. [`assert_golden`] is for
//! what a promise cannot say: that trees look as they did.

mod files;
mod golden;
mod growth;
mod hulls;
mod individuals;
mod numbers;
mod volunteers;

pub use files::{
    files_name_their_family, misplaced_names_are_told, models_are_told_apart_by_structure,
    one_mistake_is_one_issue, written_files_are_read_back,
};
pub use golden::assert_golden;
pub use growth::{
    limits_are_errors, stems_do_not_depend_on_leaves, the_same_seed_is_the_same_tree, trees_are_well_formed,
    values_of_another_space_are_refused,
};
pub use hulls::crowns_grow_into_hulls;
pub use individuals::{draws_of_a_stem_are_its_own, individuals_are_read_back};
pub use numbers::{
    at_ends_or_between, conflicts_are_told_before_growing, declarations_are_consistent,
    inactive_numbers_change_nothing, list_within, resizing_is_similar_or_refused,
};
pub use volunteers::Volunteers;

use crate::species::Family;
use crate::species::{Species, SpeciesDoc, preset};

#[cfg(test)]
pub(crate) mod bush;
#[cfg(test)]
mod tests;

/// Makes the tests of a family: see [`conformance`](crate::conformance).
#[macro_export]
macro_rules! conformance {
    ($family:expr) => {
        $crate::conformance! { @tests $family;
            files_name_their_family,
            one_mistake_is_one_issue,
            misplaced_names_are_told,
            written_files_are_read_back,
            models_are_told_apart_by_structure,
            trees_are_well_formed,
            the_same_seed_is_the_same_tree,
            stems_do_not_depend_on_leaves,
            limits_are_errors,
            draws_of_a_stem_are_its_own,
            individuals_are_read_back,
            crowns_grow_into_hulls,
            values_of_another_space_are_refused,
            declarations_are_consistent,
            inactive_numbers_change_nothing,
            conflicts_are_told_before_growing,
            resizing_is_similar_or_refused,
        }
    };
    (@tests $family:expr; $($promise:ident,)*) => {
        $(
            #[test]
            fn $promise() {
                $crate::conformance::$promise(&$family);
            }
        )*
    };
}

/// The seed that trees are grown from where any will do.
const SEED: u64 = 7;

/// Every species that comes with `family`; at least one.
fn all(family: &dyn Family) -> Vec<Species> {
    let names = family.presets().iter().map(|(name, _)| *name);
    let species: Vec<Species> = names.filter_map(|name| preset(family, name)).collect();
    assert!(!species.is_empty(), "{} comes with a species", family.name());
    species
}

/// Reads the text of a species file.
fn read(family: &dyn Family, text: &str) -> Species {
    let species = SpeciesDoc::parse("again.toml", text).and_then(|doc| doc.species(family));
    species.unwrap_or_else(|error| panic!("{error}\nin\n{text}"))
}
