//! What the parts of the language mean.

use pleach_lsystem::{Derivation, Fault, Grammar, LSystem, Limits};

fn after(text: &str, steps: usize) -> String {
    let system = LSystem::read("test", text).unwrap_or_else(|e| panic!("{e}"));
    let derivation = Derivation { steps: Some(steps), ..Derivation::default() };
    system.derive(&derivation).unwrap_or_else(|e| panic!("{e}")).to_text()
}

fn fault(text: &str, steps: usize) -> Fault {
    let system = LSystem::read("test", text).unwrap_or_else(|e| panic!("{e}"));
    let limits = Limits { symbols: 100_000, work: 1_000_000 };
    let derivation = Derivation { steps: Some(steps), limits, ..Derivation::default() };
    system.derive(&derivation).unwrap_err().diagnostic.fault
}

#[test]
fn expressions_mean_what_they_say() {
    let cases = [
        ("1 + 2*3 - 4/8", 6.5),
        ("2^3^2", 512.0),
        ("-2^2", -4.0),
        ("2^-1", 0.5),
        ("7 % 4", 3.0),
        ("(1 < 2) + (2 <= 2) + (1 > 2) + (1 == 1) + (1 != 1)", 3.0),
        ("1 > 2 ? 5 : 2 > 1 ? 6 : 7", 6.0),
        ("0 && 1/0 > 1", 0.0),
        ("3 || 1/0 > 1", 1.0),
        ("2 && 3", 1.0),
        ("!0 + !5", 1.0),
        ("sin(30)", 0.5),
        ("sin(deg(1)) - 0.8414709848078965", 0.0),
        ("atan2(1, 1)", 45.0),
        ("acos(0)", 90.0),
        ("max(1, 5, 3) - min(4, 2)", 3.0),
        ("floor(-1.5) + trunc(-1.5) + ceil(1.2) + round(2.5)", 2.0),
        ("sqrt(16) + abs(-2) + sign(-3) + log(exp(2))", 7.0),
        ("4/0.1", 40.0),
        ("1e3 + .5", 1000.5),
    ];
    for (text, expected) in cases {
        let system = LSystem::read("test", &format!("axiom: A({text})")).unwrap_or_else(|e| panic!("{e}"));
        let derived = system.derive(&Derivation::default()).unwrap();
        let value = derived.iter().next().unwrap().1[0];
        assert!((value - expected).abs() < 1e-9, "{text} is {value}, expected {expected}");
    }
}

#[test]
fn repetition_and_local_names() {
    assert_eq!(after("axiom: A\nA -> for i in 0..3 { F(i) for j in 0..i { B } }", 1), "F(0)F(1)BF(2)BB");
    assert_eq!(after("axiom: for w in [3, 1] { let x = w*2; F(x, w) }", 0), "F(6, 3)F(2, 1)");
    // A draw with a name is drawn once.
    let text = after("axiom: let a = rand(0, 1); F(a) F(a) F(rand(0, 1))", 0);
    let values: Vec<&str> = text.split(['(', ')']).collect();
    assert!(values[1] == values[3] && values[1] != values[5], "{text}");
    // A loop is one step, and an unrolled one writes the same.
    let unrolled = "axiom: A(0)\nA(i) : i < 3 -> F(i) A(i+1)\nA(i) : i >= 3 -> B";
    assert_eq!(after("axiom: A\nA -> for i in 0..3 { F(i) } B", 1), after(unrolled, 4));
}

#[test]
fn contexts_skip_side_branches() {
    // Prusinkiewicz and Lindenmayer 1990, §1.8: a signal from the base, and one from a tip.
    let signal = "axiom: J[I]I[I]I[I]I\nJ < I -> J";
    assert_eq!(after(signal, 1), "J[J]J[I]I[I]I");
    assert_eq!(after(signal, 2), "J[J]J[J]J[I]I");
    assert_eq!(after("axiom: I[I]I[I]I[I]J\nI > J -> J", 1), "I[I]I[I]J[I]J");
    // Their example: BC < S > G[H]M fits in ABC[DE][SG[HI[JK]L]MNO].
    let text = "axiom: ABC[DE][SG[HI[JK]L]MNO]\nBC < S > G[H]M -> X";
    assert_eq!(after(text, 1), "ABC[DE][XG[HI[JK]L]MNO]");
    // Arguments of contexts are known to condition and successor.
    let text = "ignore: +\naxiom: A(2) + B(3) + C(4)\nA(x) < B(y) > C(z) : z > x -> D(x, y, z)";
    assert_eq!(after(text, 1), "A(2)+D(2, 3, 4)+C(4)");
}

#[test]
fn a_cut_drops_the_rest_of_the_branch() {
    assert_eq!(after("axiom: F[AF[B]C]F\nA -> %", 1), "F[%]F");
    assert_eq!(after("dialect: hewitt\naxiom: F[AF[B]C]F\nA -> %", 1), "F[%F[B]C]F");
}

#[test]
fn draws_have_addresses() {
    // One more draw at the end leaves those before it alone.
    let short = after("axiom: A A\nA -> F(rand(0, 1))", 1);
    let long = after("axiom: A A B\nA -> F(rand(0, 1))\nB -> F(rand(0, 1))", 1);
    assert!(long.starts_with(&short), "{short} {long}");
    assert_eq!(after("const s = rand(1, 2)\naxiom: F(s)", 0), after("const s = rand(1, 2)\naxiom: F(s)", 0));
    // A module that stays draws again at each step.
    let system = LSystem::read("test", "axiom: A\nA : rand() < 0.5 -> B").unwrap();
    let mean: f64 = (0..2000)
        .map(|seed| {
            let alive =
                |steps| system.derive(&Derivation { seed, steps: Some(steps), ..Derivation::default() });
            (1..20).filter(|&n| alive(n).unwrap().to_text() == "A").count() as f64
        })
        .sum::<f64>()
        / 2000.0;
    assert!((mean - 1.0).abs() < 0.15, "{mean}");
}

#[test]
fn threads_do_not_change_a_string() {
    let text =
        "axiom: A(1)\nA(x) -0.4-> A(x*0.9) [+(rand(0, 30)) A(x*0.8)] -0.6-> F(nrand(x, 0.1)) A(x) A(x)";
    let system = LSystem::read("test", text).unwrap();
    let derivation = Derivation { steps: Some(18), ..Derivation::default() };
    let alone = system.derive(&derivation).unwrap();
    let together = system.derive(&Derivation { parallel: true, ..derivation }).unwrap();
    assert!(alone.len() > 200_000, "{}", alone.len());
    assert!(alone.to_text() == together.to_text());
    for parallel in [false, true] {
        let limits = Limits { symbols: alone.len() - 1, ..Limits::DEFAULT };
        let error = system.derive(&Derivation { limits, parallel, ..derivation }).unwrap_err();
        assert!(matches!(error.diagnostic.fault, Fault::TooManySymbols { .. }), "{error}");
    }
}

#[test]
fn endless_growth_is_an_error() {
    let doubled = "axiom: A\nA -> AA";
    assert!(matches!(fault(doubled, 64), Fault::TooManySymbols { limit: 100_000, .. }));
    assert!(matches!(fault("axiom: A(1)\nA(x) -> A(x) A(x)", 64), Fault::TooManySymbols { .. }));
    assert!(matches!(fault("axiom: A\nA -> for i in 0..1e9 { B }", 1), Fault::TooManyRepeats { .. }));
    let nested = "axiom: A\nA -> for i in 0..9999 { for j in 0..9999 { for k in 0..9999 { F } } }";
    assert!(matches!(fault(nested, 1), Fault::TooManySymbols { .. }));
    let idle = "axiom: A\nA -> for i in 0..9999 { for j in 0..9999 { } }";
    assert!(matches!(fault(idle, 1), Fault::TooMuchWork { .. }));
    assert!(matches!(fault("axiom: A(0)\nA(x) -> A(x+1)", 2_000_000), Fault::TooMuchWork { .. }));
}

#[test]
fn numbers_that_are_none_are_errors() {
    let at = "the rule for `A(x)`".to_owned();
    assert_eq!(fault("axiom: A(0)\nA(x) -> F(1/x)", 1), Fault::DivisionByZero { rule: at.clone() });
    assert_eq!(fault("axiom: A(0)\nA(x) -> F(min(1, 5 % x))", 1), Fault::DivisionByZero { rule: at });
    assert!(matches!(fault("axiom: A(0)\nA(x) -> F(sqrt(x-1))", 1), Fault::NotFinite { .. }));
    assert!(matches!(fault("axiom: A(9)\nA(x) -> A(x^x)", 9), Fault::NotFinite { .. }));
    let sum = fault("axiom: A(0.3)\nA(p) -(p)-> F -(p)-> G", 1);
    assert_eq!(sum, Fault::ProbabilitySum { sum: 0.6 });
}

#[test]
fn pasted_signs_are_read() {
    let pdf = Grammar::parse("pdf", "axiom: F\u{2212}F\nF \u{2192} F(2\u{2212}1)").unwrap();
    assert_eq!(pdf, Grammar::parse("typed", "Axiom: F-F\nF --> F(2-1)").unwrap());
}

#[test]
fn a_byte_order_mark_is_no_part_of_a_grammar() {
    let text = "axiom: A\nsteps: 2\nA -> F A\n";
    let marked = format!("\u{feff}{text}");
    let (plain, read) = (LSystem::read("plain", text).unwrap(), LSystem::read("marked", &marked).unwrap());
    assert_eq!(read.text(), plain.text());
    assert!(Grammar::parse("marked", &marked).is_ok());
    // Columns are those that an editor shows, and a mark anywhere else is a mistake.
    let report = LSystem::read("marked", "\u{feff}axiom: A ?\n").unwrap_err().to_string();
    assert!(report.contains("marked:1:10"), "{report}");
    assert!(LSystem::read("test", "axiom: A\n\u{feff}steps: 2\n").is_err());
}
