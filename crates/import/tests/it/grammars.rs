//! Grammars of L-Py and cpfg.

use pleach_import::{GrammarProgram, translate_grammar};

fn read(text: &str, program: GrammarProgram) -> Vec<String> {
    let grammar = translate_grammar("it", text, program).unwrap_or_else(|error| panic!("{error}"));
    grammar.text.lines().map(str::to_owned).collect()
}

fn told(text: &str) -> String {
    translate_grammar("it", text, GrammarProgram::Cpfg).unwrap_err().to_string()
}

#[test]
fn l_py() {
    let text = "R = 1.456 # ratio\nmodule A(s), Leaf(x, y)\nAxiom: _(0.01);(2)A(1)\n\nderivation length: 11\nproduction:\nA(s) --> F(s)[+(85)A(s/R)]\n    [-(85)A(s/R)]@O(0.1)\n\ninterpretation:\n\nendlsystem\n";
    let lines = read(text, GrammarProgram::LPy);
    assert_eq!(
        lines,
        [
            "const R = 1.456",
            "module Leaf",
            "Axiom: !(0.01)A(1)",
            "",
            "derivation length: 11",
            "",
            "A(s) --> F(s)[+(85)A(s/R)]",
            "    [-(85)A(s/R)]",
            "",
            "",
            "",
            "",
            "angle: 60",
            "thickness: 1",
        ]
    );
    let grammar = translate_grammar("it", text, GrammarProgram::LPy).unwrap();
    assert_eq!(grammar.left_out, [";", "@O"]);
}

#[test]
fn cpfg() {
    let text = "#define STEPS 5\nLsystem: 1\n/* the\nbook's */ derivation length: STEPS\nignore: +-F\nAxiom: X\nX --> F-[[X]+X]+F[+FX]-X\nF --> FF\nendlsystem";
    let lines = read(text, GrammarProgram::Cpfg);
    assert_eq!(lines[0], "const STEPS = 5");
    assert_eq!(lines[1..4], ["", "", "derivation length: STEPS"]);
    assert_eq!(lines[4..], ["ignore: +-F", "Axiom: X", "X --> F-[[X]+X]+F[+FX]-X", "F --> FF", ""]);
}

#[test]
fn code_is_an_error_with_its_place() {
    for (text, at) in [
        ("Axiom: A\nimport math\n", "it:2:1"),
        ("A(s):\n  produce F(s)\n", "it:1:1"),
        ("Axiom: A\n  if x > 1:\n", "it:2:3"),
        ("#include <math.h>\n", "it:1:1"),
        ("#define SQ(x) x*x\n", "it:1:1"),
        ("Start: { x = 1; }\n", "it:1:1"),
        ("{ x = 1 }\n", "it:1:1"),
        ("name = \"tree\"\n", "it:1:1"),
        ("homomorphism:\nL --> ~l\n", "it:2:1"),
        ("A --> B : 0.3\n", "it:1:1"),
        ("A --> B /* never\n", "it:1:9"),
        ("A --> B /*/ C\n", "it:1:9"),
        ("homomorphism:\nmaximum depth: 3\nF --> FF\n", "it:3:1"),
        ("homomorphism:\ngroup 1\nF --> FF\n", "it:3:1"),
        ("Axiom: F@M(0,0,5)F\n", "it:1:9"),
        ("A --> ;(2 F[+A]\n", "it:1:8"),
    ] {
        let message = told(text);
        assert!(message.starts_with(&format!("{at}: ")), "{text}: {message}");
    }
    assert!(told("A --> B : 0.3\n").contains("`-0.3->`"));
}

#[test]
fn what_only_looks_like_a_header_a_symbol_or_a_comment_stays() {
    let text = "module Grouping\nAxiom: Grouping@Gs\nGrouping --> F@O(2)F # first, then; @ all\n";
    let translated = translate_grammar("it", text, GrammarProgram::Cpfg).unwrap();
    let lines: Vec<&str> = translated.text.lines().collect();
    assert_eq!(lines, ["module Grouping", "Axiom: Grouping", "Grouping --> FF # first, then; @ all"]);
    assert_eq!(translated.left_out, ["@Gs", "@O"]);
}

#[test]
fn pieces_with_a_radius_have_it_before_them() {
    let text = "module XF(a, b)\nAxiom: A(1, 2)F(1,0.1)\nproduction:\n  A(l, r) : l > 0 --> F(l*max(1, r), (r))XF(1, 2)F(l)F\n     F(2, r) # F(1, 2)\n";
    let lines = read(text, GrammarProgram::LPy);
    assert_eq!(
        lines[..5],
        [
            "module XF",
            "Axiom: A(1, 2)!(0.1)F(1)",
            "",
            "A(l, r) : l > 0 --> !((r))F(l*max(1, r))XF(1, 2)F(l)F",
            "     !(r)F(2) # F(1, 2)",
        ]
    );
    let rule = translate_grammar("it", "Axiom: F(1,2)\n F(l, r) --> F(l, r/2)\n", GrammarProgram::LPy);
    let told = rule.unwrap_err().to_string();
    assert!(told.starts_with("it:2:2: a rule for `F` with a radius"), "{told}");
    // In cpfg the second number is another one.
    assert_eq!(read("Axiom: F(1,2)\n", GrammarProgram::Cpfg), ["Axiom: F(1,2)"]);
}

#[test]
fn cpfg_sets_widths_where_others_have_comments() {
    let text = "# a comment\nAxiom: #(0.15)|X # another, with #(1)\nX --> #(0.1)FX\n";
    assert_eq!(
        read(text, GrammarProgram::Cpfg),
        ["# a comment", "Axiom: !(0.15)|X # another, with #(1)", "X --> !(0.1)FX"]
    );
    assert_eq!(read("Axiom: F#(0.15)\n", GrammarProgram::LPy)[0], "Axiom: F#(0.15)");
}
