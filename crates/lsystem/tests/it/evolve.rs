//! Grammars that evolve stay grammars.

use pleach_lsystem::{Derivation, Grammar, LSystem, LSystemFamily, Limits};
use pleach_tree::species::preset;
use pleach_tree::{Family, Foliage, Generator, Growth, Key, SpeciesDoc, Tree, Workspace};
use std::sync::Arc;

fn blank() -> Arc<dyn Generator> {
    let doc = SpeciesDoc::parse("blank", LSystemFamily.blank().unwrap()).unwrap();
    doc.species(&LSystemFamily).unwrap().generator
}

/// Whether `structure` is a grammar in normal form that keeps `parent`'s parameters, and derives or says
/// why not.
fn is_sound(parent: &Arc<dyn Generator>, structure: &str) -> bool {
    let grammar = Grammar::parse("child", structure).unwrap_or_else(|e| panic!("{e}\n{structure}"));
    assert_eq!(grammar.to_string(), structure);
    let system = LSystem::read("child", structure).unwrap_or_else(|e| panic!("{e}\n{structure}"));
    let child = parent.variation().unwrap().generator(structure).unwrap();
    assert!(child.space() == parent.space(), "{structure}");
    let limits = Limits { symbols: 20_000, work: 100_000 };
    let derived = system.derive(&Derivation { limits, ..Derivation::default() });
    let mut tree = Tree::default();
    let limits = pleach_tree::Limits { stems: 2000, leaves: 5000, knots: 5000, work: 100_000 };
    let does_grow = derived.is_ok_and(|derived| derived.grow(&limits, Foliage::All, &mut tree).is_ok());
    if does_grow {
        tree.well_formed().unwrap();
    }
    does_grow
}

#[test]
fn any_sequence_of_changes_ends_in_a_grammar() {
    let presets = LSystemFamily.presets().iter();
    let known = presets.map(|(name, _)| preset(&LSystemFamily, name).unwrap().generator);
    let mut grown = 0;
    for (number, parent) in known.chain([blank()]).enumerate() {
        let variation = parent.variation().unwrap();
        let own = variation.own();
        let mut one = own.clone();
        for step in 0..25 {
            let key = Key::root(number as u64).child(0, step);
            one = if step % 5 == 4 { variation.cross(&one, &own, key) } else { variation.vary(&one, key) };
            grown += usize::from(is_sound(&parent, &one));
        }
        assert_ne!(one, own);
    }
    // Searches have something to choose from.
    assert!(grown > 200, "{grown} of 900 grow");
}

#[test]
fn random_grammars_differ_and_most_of_them_grow() {
    let parent = blank();
    let variation = parent.variation().unwrap();
    let sketches: Vec<String> = (0..200).map(|n| variation.fresh(Key::root(n))).collect();
    let grown = sketches.iter().filter(|sketch| is_sound(&parent, sketch)).count();
    assert!(grown > 120, "{grown} of 200 grow");
    assert_eq!(sketches[3], variation.fresh(Key::root(3)));
    let mut distinct = sketches.clone();
    distinct.sort();
    distinct.dedup();
    assert_eq!(distinct.len(), sketches.len());
    for pair in sketches.windows(2) {
        let _ = is_sound(&parent, &variation.cross(&pair[0], &pair[1], Key::root(7)));
    }
}

#[test]
fn changes_are_of_every_kind() {
    let parent = preset(&LSystemFamily, "grammar_acer").unwrap().generator;
    let variation = parent.variation().unwrap();
    let own = variation.own();
    let letters =
        |text: &str| -> String { text.chars().filter(|c| !c.is_ascii_digit() && *c != '.').collect() };
    let children: Vec<String> = (0..300).map(|n| variation.vary(&own, Key::root(n))).collect();
    let numbers = children.iter().filter(|child| letters(child) == letters(&own)).count();
    assert!((100..250).contains(&numbers), "{numbers} of 300 change numbers only");
    let length = |text: &String| variation.length(text);
    assert!(children.iter().any(|child| length(child) > length(&own) + 3), "none has grown");
    assert!(children.iter().any(|child| length(child) + 3 < length(&own)), "none was cut");
    let rules = |text: &String| Grammar::parse("child", text).unwrap().rules.len();
    assert!(children.iter().any(|child| rules(child) > rules(&own)), "no rule is new");
    let weights = |text: &String| text.matches("  -").count();
    assert!(children.iter().any(|child| weights(child) > weights(&own)), "no successor is new");
}

#[test]
fn a_tree_whose_size_is_read_by_its_scale_alone_grows_in_proportion() {
    let parent = blank();
    let variation = parent.variation().unwrap();
    let header =
        "dialect: hewitt\nscale: size\nparam size = 10 in 0.0001..10000 search 1..100 m \"height\"\n";
    let grown = |body: &str, size: f64| {
        let generator = variation.generator(&format!("{header}{body}")).unwrap();
        let params = generator.space().check(vec![size]).unwrap();
        let mut tree = Tree::default();
        generator.grow(&params, &Growth::seed(1), &mut Workspace::default(), &mut tree).unwrap();
        (generator.grows_in_proportion(), tree)
    };
    let body =
        "tropism: (0, 0, 3)\naxiom: !(0.1) F(0.5) [ +(40) F(0.4, 8, 45, 137.5) ] F(0.5, 3, 45, 137.5) %";
    let ((is_one, small), (_, large)) = (grown(body, 2.0), grown(body, 6.0));
    assert!(is_one);
    for (a, b) in small.knots.iter().zip(&large.knots) {
        assert!((a.point * 3.0).distance(b.point) < 1e-9 && (a.radius * 3.0 - b.radius).abs() < 1e-9);
    }
    for (a, b) in small.leaves.iter().zip(&large.leaves) {
        assert!((a.position * 3.0).distance(b.position) < 1e-4 && (a.along * 3.0).distance(b.along) < 1e-4);
    }
    assert_eq!((small.leaves.len(), large.leaves.len()), (11, 11));
    assert!(!grown("axiom: F(0.5) +(size) F(0.5)", 2.0).0);
}

#[test]
fn length_counts_words_and_signs() {
    let parent = blank();
    let length = |text: &str| parent.variation().unwrap().length(text);
    assert_eq!(length(""), 0);
    assert_eq!(length("F(0.5, 8) [ +(35) A ]"), 3 + 1 + 2 + 1 + 1);
    assert_eq!(length("param size = 10"), 4);
}

#[test]
fn what_is_not_a_grammar_stays_as_it_is() {
    let parent = blank();
    let variation = parent.variation().unwrap();
    for text in ["", "axiom: [", "axiom: F\nF -> G(x)"] {
        assert!(variation.generator(text).is_none(), "{text}");
        let _ = variation.vary(text, Key::root(1));
        assert_eq!(variation.cross(text, "[", Key::root(1)), text);
    }
}

#[test]
fn a_search_from_nothing_begins_with_a_stick() {
    let parent = blank();
    let params = parent.space().check(parent.space().defaults()).unwrap();
    let mut tree = Tree::default();
    parent.grow(&params, &Growth::seed(1), &mut Workspace::default(), &mut tree).unwrap();
    assert_eq!((tree.stems.len(), tree.leaves.len()), (1, 0));
}
