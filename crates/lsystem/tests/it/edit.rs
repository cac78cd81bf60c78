//! Grammars that are edited as text.

use pleach_lsystem::{GrammarGenerator, LSystemFamily, with_grammar};
use pleach_tree::species::preset;
use pleach_tree::{GrowError, Species, SpeciesDoc};

fn palm() -> Species {
    preset(&LSystemFamily, "hewitt_palm").unwrap()
}

fn read(toml: &str) -> Species {
    SpeciesDoc::parse("test", toml).and_then(|doc| doc.species(&LSystemFamily)).unwrap()
}

/// The grammar as the file has it.
fn written(species: &Species) -> String {
    let doc = SpeciesDoc::parse("test", &species.to_toml(&[])).unwrap();
    doc.text("grammar").unwrap().unwrap().to_owned()
}

fn number(species: &Species, name: &str) -> f64 {
    let space = species.generator.space();
    let slot = space.slots().find(|&slot| space.slot_name(slot) == name).unwrap();
    species.params.values()[slot.index()]
}

fn with_number(species: &Species, name: &str, value: f64) -> Species {
    let space = species.generator.space();
    let slot = space.slots().find(|&slot| space.slot_name(slot) == name).unwrap();
    let mut values = species.params.values().to_vec();
    values[slot.index()] = value;
    Species { params: space.check(values).unwrap(), ..species.clone() }
}

#[test]
fn files_have_the_grammar_as_it_was_written() {
    let text = "# A bush.\nsteps:   3\naxiom: F  # one piece\nF -> F[+F]F\n";
    let bush = with_grammar(&palm(), text).unwrap().species;
    assert_eq!(written(&bush), text);
    assert_eq!(written(&read(&bush.to_toml(&[]))), text);
    assert!(!bush.generator.structure().contains('#'), "what tells models apart has no comments");
    assert_eq!(bush.appearance, palm().appearance);
    assert!(bush.grow(1).unwrap() == read(&bush.to_toml(&[])).grow(1).unwrap());
}

#[test]
fn texts_that_no_plain_string_can_have_survive_files() {
    for comment in ["'''", "\"\"\" \\ \\u0041", "a\u{7}b", "tab\there", "é 木"] {
        let text = format!("axiom: F\n# {comment}\n");
        let species = with_grammar(&palm(), &text).unwrap().species;
        assert_eq!(written(&species), text, "{comment:?}");
    }
    let unended = with_grammar(&palm(), "axiom: F").unwrap().species;
    assert_eq!(written(&unended), "axiom: F\n");
}

#[test]
fn numbers_stay_unless_the_text_says_others() {
    let text = "param a = 2 in 0..9\nparam n = 3 in 1..9 count\nsteps: n\naxiom: F(a)\nF(x) -> F(x)F(x)\n";
    let species = with_grammar(&palm(), text).unwrap().species;
    let species = with_number(&with_number(&species, "a", 5.0), "n", 4.0);
    let edit = |from: &str, to: &str| {
        let edited = with_grammar(&species, &text.replace(from, to)).unwrap().species;
        (number(&edited, "a"), number(&edited, "n"))
    };
    assert_eq!(edit("-> F(x)F(x)", "-> F(x)[+F(x)]"), (5.0, 4.0));
    assert_eq!(edit("a = 2", "a = 3"), (3.0, 4.0), "what was changed last counts");
    assert_eq!(edit("in 0..9", "in 0..4"), (2.0, 4.0), "a number that is not allowed any more");
    let renamed =
        with_grammar(&species, &text.replace("param a", "param b").replace("F(a)", "F(b)")).unwrap();
    assert_eq!(number(&renamed.species, "b"), 2.0);
}

#[test]
fn every_mistake_has_its_place() {
    let places = |text: &str| {
        let report = with_grammar(&palm(), text).unwrap_err();
        let place = |at| report.place(at);
        report.diagnostics.iter().map(|d| (place(d.span.start), place(d.span.end))).collect::<Vec<_>>()
    };
    assert_eq!(places("axiom: F[\nF -> F(fooo)\n"), [((1, 9), (1, 10)), ((2, 8), (2, 12))]);
    assert_eq!(places("axiom: F\nparam name = 1 in 0..2\n"), [((2, 7), (2, 11))]);
    let error = GrammarGenerator::read("axiom: F\nparam name = 1 in 0..2\n").unwrap_err();
    assert!(
        error.to_string().contains("cannot be called `name`, which is a key of species files"),
        "{error}"
    );
    // A count between two whole numbers.
    assert_eq!(places("axiom: F\nparam k = 1.5 in 1.2..1.8 count\n"), [((2, 7), (2, 8))]);
    let odd = with_grammar(&palm(), "axiom: F Q\n").unwrap().warnings.unwrap();
    assert_eq!(odd.place(odd.diagnostics[0].span.start), (1, 10));
}

#[test]
fn what_runs_away_names_a_rule_that_has_a_place() {
    let text = "steps: 99\naxiom: A\n# twice as many each time\nA -> AF\nF -> FF\n";
    let system = GrammarGenerator::read(text).unwrap();
    let error = with_grammar(&palm(), text).unwrap().species.grow(1).unwrap_err();
    let GrowError::TooMuchWork { blame, .. } = &error else { panic!("{error}") };
    assert_eq!(system.system().place_of(&blame.0[0]), Some((5, 1)), "{error}");
    assert_eq!(system.system().place_of("nothing"), None);
    let error = with_grammar(&palm(), "axiom: A(1)\nsteps: 3\nA(x) -> F A(1/(x - 1))\n").unwrap();
    let error = error.species.grow(1).unwrap_err();
    assert!(matches!(error, GrowError::Rule { line: 3, .. }), "{error}");
}
