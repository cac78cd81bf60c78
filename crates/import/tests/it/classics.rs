//! Ten systems of *The Algorithmic Beauty of Plants*, written here in the notations of L-Py and of cpfg.

use pleach_import::{GrammarProgram, translate_grammar};
use pleach_lsystem::{Derivation, LSystem, LSystemFamily};
use pleach_tree::{SpeciesDoc, Tree};

/// Names of the files, and how many pieces are drawn after the last step (`crates/lsystem/tests/data`).
const SYSTEMS: [(&str, usize); 10] = [
    ("koch_island", 2048),
    ("quadratic_snowflake", 625),
    ("islands_and_lakes", 1296),
    ("hilbert", 63),
    ("plant_a", 3125),
    ("plant_c", 4096),
    ("plant_f", 1488),
    ("monopodial", 1023),
    ("sympodial", 1023),
    ("ternary", 1457),
];

fn translated(name: &str, ending: &str, program: GrammarProgram) -> String {
    let path = format!("{}/tests/data/{name}.{ending}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    translate_grammar(&path, &text, program).unwrap_or_else(|error| panic!("{error}")).text
}

fn grown(grammar: &str) -> Tree {
    let toml = format!("generator = \"lsystem\"\ngrammar = '''\n{grammar}'''\n");
    let species = SpeciesDoc::parse("it", &toml).and_then(|doc| doc.species(&LSystemFamily));
    species.unwrap_or_else(|error| panic!("{error}")).grow(1).unwrap()
}

#[test]
fn both_notations_grow_what_the_book_has() {
    for (name, pieces) in SYSTEMS {
        let grammars =
            [translated(name, "lpy", GrammarProgram::LPy), translated(name, "l", GrammarProgram::Cpfg)];
        let trees = grammars.map(|grammar| {
            let system = LSystem::read(name, &grammar).unwrap_or_else(|report| panic!("{report}\n{grammar}"));
            let derived = system.derive(&Derivation::default()).unwrap();
            assert_eq!(derived.count("F"), pieces, "{name}");
            grown(&grammar)
        });
        let [one, other] = &trees;
        assert!(!one.stems.is_empty(), "{name}");
        assert_eq!(one.stems.len(), other.stems.len(), "{name}");
        for (one, other) in one.knots.iter().zip(&other.knots) {
            assert!(one.point.distance(other.point) <= 1e-9 * one.point.length().max(1.0), "{name}");
        }
        let thickest = |tree: &Tree| tree.knots.iter().map(|knot| knot.radius).fold(0.0, f64::max);
        // Only where widths are said, they are the same: without any, each program has its own.
        if ["monopodial", "sympodial", "ternary"].contains(&name) {
            assert!((thickest(one) / thickest(other) - 1.0).abs() < 1e-9, "{name}");
        }
    }
}
