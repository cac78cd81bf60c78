//! Every listing of docs/grammars.md is run.

use pleach_lsystem::{Derivation, LSystem, LSystemFamily};
use pleach_tree::SpeciesDoc;

const PAGE: &str = include_str!("../../../../docs/grammars.md");

fn listings(kind: &str) -> impl Iterator<Item = &'static str> {
    let fence = format!("```{kind}\n");
    let parts: Vec<&str> = PAGE.split(&fence).skip(1).collect();
    parts.into_iter().map(|part| part.split("```").next().unwrap())
}

#[test]
fn listings_grow() {
    let mut lengths = Vec::new();
    for text in listings("lsystem") {
        let system = LSystem::read("docs/grammars.md", text).unwrap_or_else(|e| panic!("{e}"));
        lengths.push(system.derive(&Derivation::default()).unwrap_or_else(|e| panic!("{e}")).len());
    }
    assert_eq!(lengths.len(), 6);
    assert!(lengths.iter().all(|&n| n > 12), "{lengths:?}");
    for text in listings("toml") {
        let doc = SpeciesDoc::parse("docs/grammars.md", text).unwrap();
        let species = doc.species(&LSystemFamily).unwrap_or_else(|e| panic!("{e}"));
        assert!(species.grow(1).unwrap().stems.len() > 100);
    }
}
