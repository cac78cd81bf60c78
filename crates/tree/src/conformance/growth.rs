//! Promises about growing.

use super::{SEED, Volunteers, all};
use crate::grow_error::GrowError;
use crate::growth::{Growth, Limits, Workspace};
use crate::param::{ForeignParams, Kind, Param, ParamSpace};
use crate::species::Family;
use crate::species::Species;
use pleach_plant::Tree;
use std::sync::Arc;

fn grown(species: &Species) -> Tree {
    species.grow(SEED).unwrap_or_else(|error| panic!("{} grows: {error}", species.name))
}

/// Every tree has stems and is what the plant model promises.
///
/// # Panics
/// If the promise is broken.
pub fn trees_are_well_formed(family: &dyn Family) {
    for species in all(family) {
        let tree = grown(&species);
        assert_eq!(tree.well_formed(), Ok(()), "{}", species.name);
        assert!(!tree.stems.is_empty(), "{} has stems", species.name);
    }
}

/// The same parameters and the same seed give the same tree, on any number of threads and whatever
/// workspace and tree were used for before.
///
/// # Panics
/// If the promise is broken.
pub fn the_same_seed_is_the_same_tree(family: &dyn Family) {
    let (mut workspace, mut reused) = (Workspace::default(), Tree::default());
    for species in all(family) {
        let (name, tree) = (&species.name, grown(&species));
        for growth in [Growth::seed(SEED + 1), Growth::seed(SEED)] {
            let result = species.generator.grow(&species.params, &growth, &mut workspace, &mut reused);
            assert_eq!(result, Ok(()), "{name} grows again");
        }
        assert!(tree == reused, "{name}: reused memory changes nothing");
        let parallel = species.grow_with(&Growth { parallel: true, ..Growth::seed(SEED) });
        assert!(Ok(&tree) == parallel.as_ref(), "{name}: growing in parallel changes nothing");
        let helpers = Volunteers::new(3, 2);
        let helped = species.grow_with(&Growth { helpers: Some(&helpers), ..Growth::seed(SEED) });
        assert!(Ok(&tree) == helped.as_ref(), "{name}: help changes nothing");
    }
}

/// Stems do not depend on whether there are leaves.
///
/// # Panics
/// If the promise is broken.
pub fn stems_do_not_depend_on_leaves(family: &dyn Family) {
    for species in all(family) {
        let (name, tree) = (&species.name, grown(&species));
        let bare = species.grow_bare(SEED).unwrap_or_else(|error| panic!("{name} grows bare: {error}"));
        assert!(bare.leaves.is_empty() && bare.blossoms.is_empty(), "{name}: bare means bare");
        assert!(bare.stems == tree.stems && bare.knots == tree.knots, "{name}: leaves do not move stems");
    }
}

/// What would have more parts, or take more work, than is allowed is an error that names the limit.
///
/// # Panics
/// If the promise is broken.
pub fn limits_are_errors(family: &dyn Family) {
    for species in all(family) {
        let (name, tree) = (&species.name, grown(&species));
        let all = Limits::default();
        let refused = |limits: Limits, parallel: bool| {
            let growth = Growth { limits, parallel, ..Growth::seed(SEED) };
            let result = species.grow_with(&growth).map(|tree| tree.stems.len());
            let shown = format!("{name} within {limits:?}: {result:?}");
            (result, shown)
        };
        let stems = tree.stems.len() - 1;
        let (result, shown) = refused(Limits { stems, ..all }, false);
        assert!(matches!(result, Err(GrowError::TooManyStems { limit, .. }) if limit == stems), "{shown}");

        let knots = tree.knots.len() - 1;
        let (result, shown) = refused(Limits { knots, ..all }, true);
        assert!(matches!(result, Err(GrowError::TooManyKnots { limit, .. }) if limit == knots), "{shown}");

        let (result, shown) = refused(Limits { work: 0, ..all }, false);
        assert!(matches!(result, Err(GrowError::TooMuchWork { limit: 0, .. })), "{shown}");

        let Some(leaves) = (tree.leaves.len() + tree.blossoms.len()).checked_sub(1) else { continue };
        for parallel in [false, true] {
            let (result, shown) = refused(Limits { leaves, ..all }, parallel);
            assert!(
                matches!(result, Err(GrowError::TooManyLeaves { limit, .. }) if limit == leaves),
                "{shown}"
            );
        }
    }
}

/// Values of another generator's space are refused, however many they are.
///
/// # Panics
/// If the promise is broken.
pub fn values_of_another_space_are_refused(family: &dyn Family) {
    for species in all(family) {
        let len = species.generator.space().len();
        for count in [1, len, len + 1] {
            let foreign =
                Param::list("a parameter of nobody", "number", Kind::real(0.0, 1.0), vec![0.5; count]);
            let space = ParamSpace::new(vec![foreign]).unwrap_or_else(|error| panic!("{error}"));
            let params = Arc::new(space).check(vec![0.5; count]).unwrap_or_else(|error| panic!("{error}"));
            let result = Species { params, ..species.clone() }.grow(SEED).map(|tree| tree.stems.len());
            assert_eq!(result, Err(GrowError::Foreign(ForeignParams)), "{}", species.name);
        }
    }
}
