//! Species with leaves of natural size.

use pleach_generators::{HEWITT_2017, families, names, names_like, natural_names, preset, read_text};

/// The shortest and the longest leaf of a full-grown shoot, in metres: floras.
const BLADES: [(&str, f64, f64); 4] = [
    ("natural_aspen", 0.03, 0.08),
    ("natural_oak", 0.07, 0.14),
    ("natural_maple", 0.08, 0.18),
    // A tuft of needles of 2 to 4 cm.
    ("natural_larch", 0.04, 0.08),
];

#[test]
fn their_leaves_are_of_natural_size() {
    let mut seen = 0;
    for (name, shortest, longest) in BLADES {
        let tree = preset(name).unwrap().grow(1).unwrap();
        let length = f64::from(tree.leaves[0].along.length());
        assert!((shortest..=longest).contains(&length), "{name}: {length} m");
        assert!(tree.leaves.len() > 50_000, "{name}: {} leaves", tree.leaves.len());
        seen += 1;
    }
    assert_eq!(seen, natural_names().count());
}

#[test]
fn they_are_known_and_no_family_has_them_in_its_list() {
    let known = names();
    for name in natural_names() {
        assert!(known.contains(&name) && !HEWITT_2017.contains(&name), "{name}");
        assert!(families().iter().all(|family| family.presets().iter().all(|(other, _)| *other != name)));
        let species = preset(name).unwrap();
        assert_eq!(species.name, name);
        let again = read_text(name, &species.to_toml(&[])).unwrap();
        assert_eq!(again.grow(3).unwrap(), species.grow(3).unwrap(), "{name}");
    }
    assert_eq!(names_like("natural"), natural_names().collect::<Vec<_>>());
    assert_eq!(names_like("aspen"), ["quaking_aspen"], "as in all files that were written before");
}
