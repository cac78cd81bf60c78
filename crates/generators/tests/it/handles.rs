//! The few numbers that are shown first, in every family.

use pleach_generators::families;
use pleach_tree::param::Handle;
use std::collections::HashMap;

#[test]
fn every_family_of_trees_has_handles_and_each_once() {
    for family in families() {
        let name = family.name();
        let (preset, _) = family.presets()[0];
        let species = pleach_generators::preset(preset).unwrap();
        let space = species.generator.space();
        let mut found = HashMap::new();
        for slot in space.slots() {
            if let Some(handle) = space.handle_of(slot)
                && let Some(other) = found.insert(handle, space.slot_name(slot))
            {
                panic!("{name}: {handle:?} is {other} and {}", space.slot_name(slot));
            }
        }
        // The numbers of a grammar are its own.
        if name == "lsystem" {
            assert!(found.is_empty(), "{found:?}");
            continue;
        }
        for wanted in [Handle::Height, Handle::Density, Handle::Trunk, Handle::Leaves, Handle::LeafSize] {
            assert!(found.contains_key(&wanted), "{name} has no {wanted:?}");
        }
    }
}

/// What a handle is called is true: a step up makes the tree higher, thicker and so on.
#[test]
fn handles_do_what_they_say() {
    let height = |species: &pleach_tree::Species| {
        species.grow(3).unwrap().knots.iter().map(|knot| knot.point.z).fold(0.0, f64::max)
    };
    let leaves = |species: &pleach_tree::Species| species.grow(3).unwrap().leaves.len() as f64;
    let cases: [(&str, Handle, &dyn Fn(&pleach_tree::Species) -> f64); 6] = [
        ("quaking_aspen", Handle::Height, &height),
        ("english_oak", Handle::Height, &height),
        ("stylised_oak", Handle::Height, &height),
        ("leafy_oak", Handle::Height, &height),
        ("quaking_aspen", Handle::Leaves, &leaves),
        ("leafy_oak", Handle::Leaves, &leaves),
    ];
    for (name, handle, measure) in cases {
        let species = pleach_generators::preset(name).unwrap();
        let space = species.generator.space().clone();
        let slot = space.slots().find(|&slot| space.handle_of(slot) == Some(handle)).unwrap();
        let mut values = species.params.values().to_vec();
        values[slot.index()] *= 1.5;
        space.repair(&mut values);
        let mut more = species.clone();
        more.params.set(&values).unwrap();
        assert!(measure(&more) > 1.1 * measure(&species), "{name} {handle:?}");
    }
}
