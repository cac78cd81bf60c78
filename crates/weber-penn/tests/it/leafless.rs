//! Species that lose all leaves say which number did it.

use pleach_tree::species::preset;
use pleach_tree::{Family as _, Generator as _, Limits, Species};
use pleach_weber_penn::{WeberPenn, WeberPennFamily, space};

fn set(values: &mut [f64], name: &str, value: f64) {
    let slot = space().slots().find(|slot| space().slot_name(*slot) == name).unwrap();
    values[slot.index()] = value;
}

fn get(species: &Species, name: &str) -> f64 {
    let slot = space().slots().find(|slot| space().slot_name(*slot) == name).unwrap();
    species.params.get(slot)
}

/// All species that have leaves, as they are.
fn leafy() -> Vec<Species> {
    let all = WeberPennFamily.presets().iter().map(|(name, _)| preset(&WeberPennFamily, name).unwrap());
    all.filter(|species| get(species, "leaf_blos_num") != 0.0).collect()
}

fn has_leaves(species: &Species, values: &[f64]) -> bool {
    let params = space().check(values.to_vec()).unwrap();
    let limits = Limits { leaves: 50_000_000, work: 4_000_000_000, ..Limits::DEFAULT };
    let growth = pleach_tree::Growth { limits, ..pleach_tree::Growth::seed(1) };
    let tree = Species { params, ..species.clone() }.grow_with(&growth).unwrap();
    !tree.leaves.is_empty() || !tree.blossoms.is_empty()
}

#[test]
fn species_as_they_are_have_their_leaves() {
    let all = leafy();
    assert!(all.len() > 10);
    for species in all {
        assert_eq!(WeberPenn::default().leafless(species.params.values()), None, "{}", species.name);
    }
}

#[test]
fn one_more_level_without_a_length_is_told_wherever_it_takes_the_leaves() {
    let mut told = 0;
    for species in leafy().into_iter().filter(|species| get(species, "levels") < 4.0) {
        let levels = get(&species, "levels");
        let mut values = species.params.values().to_vec();
        set(&mut values, "levels", levels + 1.0);
        let leafless = WeberPenn::default().leafless(&values);
        assert_eq!(leafless.is_none(), has_leaves(&species, &values), "{}: {leafless:?}", species.name);
        if let Some(leafless) = leafless {
            told += 1;
            let said = leafless.to_string();
            assert!(said.contains(&format!("[{levels}]` is 0")), "{said}");
            assert!(said.contains(&format!("lower `levels` to {levels}")), "{said}");
        }
    }
    assert!(told > 5, "{told}");
}

#[test]
fn each_number_that_takes_the_leaves_is_told() {
    let acer = preset(&WeberPennFamily, "acer").unwrap();
    let with = |changes: &[(&str, f64)]| {
        let mut values = acer.params.values().to_vec();
        changes.iter().for_each(|(name, value)| set(&mut values, name, *value));
        let leafless = WeberPenn::default().leafless(&values);
        assert_eq!(leafless.is_none(), has_leaves(&acer, &values), "{changes:?}: {leafless:?}");
        leafless.map(|leafless| leafless.parameter)
    };
    assert_eq!(with(&[("branches[1]", 0.0)]).as_deref(), Some("branches[1]"));
    assert_eq!(with(&[("length[1]", 0.0), ("length_v[1]", 0.0)]).as_deref(), Some("length[1]"));
    assert_eq!(with(&[("levels", 1.0)]).as_deref(), Some("levels"));
    assert_eq!(with(&[]), None);
    // Nobody asks for leaves.
    let mut values = acer.params.values().to_vec();
    set(&mut values, "branches[1]", 0.0);
    set(&mut values, "leaf_blos_num", 0.0);
    assert_eq!(WeberPenn::default().leafless(&values), None);
}
