//! The bush in everything that pleach does with a family: nothing in pleach knows its name.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use binary_bush::BinaryBushes;
use pleach::{Family, Palette, Parts, Species, SpeciesDoc, View};

/// A species that comes with the family.
fn bush(name: &str) -> Species {
    let (_, text) = BinaryBushes.presets().iter().find(|(known, _)| *known == name).unwrap();
    SpeciesDoc::parse(name, text).unwrap().species(&BinaryBushes).unwrap()
}

mod conformance {
    use super::BinaryBushes;

    pleach_tree::conformance!(BinaryBushes);
}

#[test]
fn it_is_drawn() {
    let tree = bush("low").grow(1).unwrap();
    assert_eq!((tree.stems.len(), tree.leaves.len()), (127, 64));
    assert!(pleach::silhouette(&tree, View::FRONT, 24).ink() > 60);
    assert!(pleach::Bounds::new(&tree, Parts::LEAFY).unwrap().max.z > 0.5);
}

#[test]
fn it_is_blended() {
    let between = pleach::mix(vec![bush("low"), bush("broom")], &[0.5, 0.5], "between").unwrap();
    let angle = between.params.values()[2];
    assert!((20.0..32.0).contains(&angle), "{angle}");
    // What a blend writes, the family reads.
    let text = between.to_toml(&[]);
    let read = SpeciesDoc::parse("between", &text).unwrap().species(&BinaryBushes).unwrap();
    assert_eq!(read.params, between.params);
}

#[test]
fn it_is_exported() {
    let species = bush("broom");
    let mut glb = std::io::Cursor::new(Vec::new());
    pleach::write_glb(&mut glb, "broom", &species.grow(1).unwrap(), &Palette::of(&species, None)).unwrap();
    let bytes = glb.into_inner();
    assert!(bytes.starts_with(b"glTF") && bytes.len() > 10_000, "{}", bytes.len());
}
