//! Promises about numbers.

use super::{SEED, all};
use crate::grow_error::GrowError;
use crate::growth::{Growth, Limits};
use crate::param::{CheckedParams, ParamSpace, Slot};
use crate::species::Family;
use crate::species::Species;
use pleach_plant::Key;
use pleach_plant::Tree;
use pleach_plant::math;
use std::sync::Arc;

/// Random lists that are tried with each species.
const LISTS: u64 = 9;
/// Limits of the trees that tests grow: tests should be quick.
const LIMITS: Limits = Limits { stems: 20_000, leaves: 50_000, knots: 100_000, work: 300_000 };

/// A list of allowed values, some of them the species' own.
fn random(species: &Species, case: u64) -> CheckedParams {
    let (space, key) = (species.generator.space(), Key::root(case));
    let value = |slot: Slot| {
        let (kind, number) = (space.kind_of(slot), slot.index() as u32);
        let (low, high) = match case % 3 {
            0 => kind.range(),
            _ => space.search_range(slot),
        };
        let is_changed = key.unit(0, number) < 0.3;
        let drawn = kind.repair(low + (high - low) * key.unit(1, number));
        if is_changed { drawn } else { species.params.get(slot) }
    };
    checked(space, space.slots().map(value).collect())
}

/// Allowed values for tests, one for each slot of `space`: 0 is the lowest, 1 the highest, and anything else that part
/// of the way through the search range.
///
/// # Panics
/// If there are fewer than slots.
#[must_use]
pub fn at_ends_or_between(space: &ParamSpace, drawn: &[(u32, f64)]) -> Vec<f64> {
    let value = |slot: Slot| {
        let ((low, high), (from, to)) = (space.kind_of(slot).range(), space.search_range(slot));
        let (end, part) = drawn[slot.index()];
        space.kind_of(slot).repair(match end {
            0 => low,
            1 => high,
            _ => from + (to - from) * part,
        })
    };
    space.slots().map(value).collect()
}

/// Random list number `case` of values that `space` allows, of one of five kinds: within the search's ranges,
/// within the declared ranges, at their ends, mostly the defaults with some ends, and within the declared
/// ranges with numbers that are mostly small.
#[must_use]
pub fn list_within(space: &ParamSpace, case: u64) -> Vec<f64> {
    let key = Key::root(case);
    let mut values = space.defaults();
    for (slot, value) in space.slots().zip(&mut values) {
        let (kind, number) = (space.kind_of(slot), slot.index() as u32);
        let (low, high) = kind.range();
        let (unit, end) = (key.unit(1, number), if key.unit(2, number) < 0.5 { low } else { high });
        let between = |(low, high): (f64, f64)| kind.repair(low + (high - low) * unit);
        *value = match case % 5 {
            0 => between(space.search_range(slot)),
            1 => between((low, high)),
            2 => end,
            3 if key.unit(3, number) < 0.1 => end,
            // Counts are mostly far below what is allowed.
            4 if !kind.is_choice() => kind.repair(between((low, high)) * math::powi(unit, 4)),
            _ => *value,
        };
    }
    values
}

fn checked(space: &Arc<ParamSpace>, values: Vec<f64>) -> CheckedParams {
    space.check(values).unwrap_or_else(|error| panic!("values are allowed: {error}"))
}

/// Breakpoints rise, a jitter of size may be zero, and defaults are allowed.
///
/// # Panics
/// If the promise is broken.
pub fn declarations_are_consistent(family: &dyn Family) {
    for species in all(family) {
        let space = species.generator.space();
        assert_eq!(space.check_all(&space.defaults()), Ok(()), "{}", species.name);
        for param in space.params() {
            let rising = param.breakpoints.windows(2).all(|pair| pair[0] < pair[1]);
            assert!(rising, "{}: breakpoints of {}", species.name, param.name);
        }
        for slot in space.size_jitters() {
            assert_eq!(space.check_slot(slot, 0.0), Ok(()), "{}: {}", species.name, space.slot_name(slot));
        }
    }
}

/// Numbers that are said not to be active change nothing that is there.
///
/// # Panics
/// If the promise is broken.
pub fn inactive_numbers_change_nothing(family: &dyn Family) {
    // The shape of leaves that are not there is of no concern.
    let parts = |tree: Tree| (tree.stems, tree.knots, tree.leaves, tree.blossoms);
    for species in all(family) {
        let (space, name) = (species.generator.space(), &species.name);
        let reference = species.grow(SEED).map(parts);
        for slot in space.slots() {
            if species.generator.is_active(species.params.values(), slot) {
                continue;
            }
            let (low, high) = space.search_range(slot);
            let mut values = species.params.values().to_vec();
            values[slot.index()] = if values[slot.index()] == high { low } else { high };
            let params = checked(space, values);
            let changed = Species { params, ..species.clone() }.grow(SEED).map(parts);
            let slot = space.slot_name(slot);
            assert!(changed == reference, "{name}: `{slot}` is said not to be active");
        }
    }
}

/// Values that break a rule between numbers are refused with the same conflict before growing and
/// while growing, and those of a known species break none; any other values grow, or there is an
/// error, and never a panic.
///
/// # Panics
/// If the promise is broken.
pub fn conflicts_are_told_before_growing(family: &dyn Family) {
    for species in all(family) {
        let name = &species.name;
        assert_eq!(species.generator.check(species.params.values()), Ok(()), "{name}");
        for case in 0..LISTS {
            let params = random(&species, case);
            let told = species.generator.check(params.values());
            let growth = Growth { limits: LIMITS, ..Growth::seed(case) };
            let grown = Species { params, ..species.clone() }.grow_with(&growth);
            match grown {
                Ok(tree) => assert_eq!((told, tree.well_formed()), (Ok(()), Ok(())), "{name}, list {case}"),
                Err(error) => {
                    if let Err(conflict) = told {
                        assert_eq!(error, GrowError::Conflict(conflict), "{name}, list {case}");
                    }
                }
            }
        }
    }
}

/// A tree of twice the size looks the same from twice as far; where the size is not possible, the values
/// stay as they are.
///
/// # Panics
/// If the promise is broken.
pub fn resizing_is_similar_or_refused(family: &dyn Family) {
    for species in all(family) {
        let (space, name) = (species.generator.space(), &species.name);
        let resized = |factor: f64| {
            let mut values = species.params.values().to_vec();
            let is_resized = species.generator.resize(&mut values, factor);
            if !is_resized {
                assert_eq!(values, species.params.values(), "{name}: what is not resized stays");
            }
            is_resized.then(|| checked(space, values))
        };
        if space.sizes().next().is_none() {
            assert_eq!(resized(2.0), None, "{name} has no size");
        }
        assert_eq!(resized(f64::INFINITY), None, "{name} cannot be of any size");
        let Some(params) = resized(2.0) else { continue };
        let tree =
            |species: &Species| species.grow(SEED).unwrap_or_else(|error| panic!("{name} grows: {error}"));
        let height = |tree: &Tree| tree.knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max);
        let (one, twice) = (tree(&species), tree(&Species { params, ..species.clone() }));
        let ratio = height(&twice) / height(&one);
        assert!((1.98..2.02).contains(&ratio), "{name}: twice the size is {ratio} times the height");
        if species.generator.grows_in_proportion() {
            let least = 1e-9 * height(&twice);
            assert_eq!(one.knots.len(), twice.knots.len(), "{name}: twice the size has as many knots");
            for (a, b) in one.knots.iter().zip(&twice.knots) {
                let is_twice =
                    (a.point * 2.0).distance(b.point) < least && (a.radius * 2.0 - b.radius).abs() < least;
                assert!(is_twice, "{name}: twice {a:?} is {b:?}");
            }
        }
    }
}
