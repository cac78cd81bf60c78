//! The suite that every generator passes.
//!
//! One line a generator: `conformance::check(&species)` for each of its species.

use crate::generator::{Foliage, GrowError, Growth, Limits, Workspace};
use crate::plant::Parts;
use crate::plant::Tree;
use crate::species::{Species, SpeciesDoc};
use crate::stats::Bounds;

/// Runs every check on `species`; `reread` parses a species file again.
///
/// # Panics
/// When a promise of [`crate::Generator`] is broken, with the promise as the message.
pub fn check(species: &Species, reread: impl Fn(&SpeciesDoc) -> Species) {
    let name = &species.name;
    let tree = species.grow(7).unwrap_or_else(|e| panic!("{name} grows: {e}"));
    tree.well_formed().unwrap_or_else(|e| panic!("{name} is well formed: {e}"));
    assert!(!tree.stems.is_empty(), "{name} has stems");

    // Deterministic, whatever the memory was used for before and however many threads grow it.
    let mut workspace = Workspace::default();
    let mut reused = Tree::default();
    for growth in [Growth::seed(8), Growth::seed(7)] {
        let result = species.generator.grow(&species.params, &growth, &mut workspace, &mut reused);
        result.unwrap_or_else(|e| panic!("{name} grows again: {e}"));
    }
    assert_eq!(tree, reused, "{name}: reused memory changes nothing");
    let parallel = species.grow_with(&Growth { parallel: true, ..Growth::seed(7) });
    assert!(Ok(&tree) == parallel.as_ref(), "{name}: growing in parallel changes nothing");
    assert_ne!(tree, species.grow(8).unwrap_or_default(), "{name}: another seed is another tree");

    // Leaves hang on stems and never move them.
    let bare = species.grow_bare(7).unwrap_or_default();
    assert!(bare.leaves.is_empty() && bare.blossoms.is_empty(), "{name}: bare means bare");
    assert!(bare.stems == tree.stems && bare.knots == tree.knots, "{name}: leaves do not move stems");
    let coarse =
        species.grow_with(&Growth { foliage: Foliage::OneIn(4), ..Growth::seed(7) }).unwrap_or_default();
    assert!(coarse.stems == tree.stems, "{name}: coarse foliage does not move stems");
    if tree.leaves.len() > 1000 {
        let ratio = coarse.leaves.len() as f64 / tree.leaves.len() as f64;
        assert!((0.2..0.3).contains(&ratio), "{name}: one leaf in four, not {ratio}");
        let area = |t: &Tree| t.leaves.iter().map(|l| f64::from(l.unit_area())).sum::<f64>();
        assert!(
            (area(&coarse) / area(&tree) - 1.0).abs() < 0.05,
            "{name}: coarse foliage keeps the leaf area"
        );
    }

    // A tree of twice the size looks the same from twice as far.
    let mut values = species.params.values().to_vec();
    if species.generator.resize(&mut values, 2.0) {
        let params = species.generator.space().check(values);
        let params = params.unwrap_or_else(|e| panic!("{name} resized is allowed: {e}"));
        let twice = Species { params, ..species.clone() }.grow(7);
        let twice = twice.unwrap_or_else(|e| panic!("{name} grows at twice the size: {e}"));
        let height = |tree: &Tree| Bounds::new(tree, Parts::LEAFY).map_or(0.0, |bounds| bounds.max.z);
        let ratio = height(&twice) / height(&tree);
        assert!((1.98..2.02).contains(&ratio), "{name}: twice the size is {ratio} times the height");
    }

    // Limits are errors, not swap storms.
    let limits = Limits { stems: tree.stems.len() - 1, ..Limits::default() };
    let refused = species.grow_with(&Growth { limits, ..Growth::seed(7) });
    assert!(
        matches!(&refused, Err(GrowError::TooManyStems { limit, .. }) if *limit == limits.stems),
        "{name}: stems are limited, but {refused:?}"
    );
    let limits = Limits { work: 10, ..Limits::default() };
    let refused = species.grow_with(&Growth { limits, ..Growth::seed(7) });
    assert!(
        matches!(&refused, Err(GrowError::TooMuchWork { limit: 10, .. })),
        "{name}: work is limited, but {refused:?}"
    );
    if !tree.leaves.is_empty() {
        let limits = Limits { leaves: tree.leaves.len() + tree.blossoms.len() - 1, ..Limits::default() };
        for parallel in [false, true] {
            let refused = species.grow_with(&Growth { limits, parallel, ..Growth::seed(7) });
            assert!(
                matches!(&refused, Err(GrowError::TooManyLeaves { limit, .. }) if *limit == limits.leaves),
                "{name}: leaves are limited, but {refused:?}"
            );
        }
    }

    // Written and read back, it is the same species.
    let text = species.to_toml(&["a comment".to_owned()]);
    let doc = SpeciesDoc::parse("again.toml", &text).unwrap_or_else(|e| panic!("{name} parses: {e}"));
    let again = reread(&doc);
    assert_eq!(species.params, again.params, "{name}: parameters survive the file");
    assert_eq!(species.appearance, again.appearance, "{name}: its looks survive the file");
    for group in species.generator.space().groups() {
        let headings = text.lines().filter(|line| line.strip_prefix("# ") == Some(group)).count();
        assert_eq!(headings, 1, "{name}: one heading for {group}");
    }
    assert!(Ok(tree) == again.grow(7), "{name}: the file grows the same tree");

    // Slots that are not read change nothing that is there.
    let space = species.generator.space();
    let parts = |tree: Tree| (tree.stems, tree.knots, tree.leaves, tree.blossoms);
    let reference = parts(species.grow(7).unwrap_or_default());
    for slot in 0..space.len() {
        if species.generator.reads(species.params.values(), slot) {
            continue;
        }
        let mut values = species.params.values().to_vec();
        let (low, high) = space.search_range(slot);
        values[slot] = if values[slot] == high { low } else { high };
        if let Ok(params) = space.check(values) {
            let changed = Species { params, ..species.clone() }.grow(7).map(parts);
            let slot = space.slot_name(slot);
            assert!(changed.as_ref() == Ok(&reference), "{name}: `{slot}` is said not to be read");
        }
    }
}
