//! What is said about grammars that are wrong.

use pleach_lsystem::{Fault, LSystem, MAX_BYTES};

fn faults(text: &str) -> Vec<Fault> {
    match LSystem::read("test", text) {
        Ok(_) => Vec::new(),
        Err(report) => report.diagnostics.into_iter().map(|d| d.fault).collect(),
    }
}

#[test]
fn several_mistakes_are_drawn_at_once() {
    let text = "axiom: F[+F
F(x) -> F(x*fooo) G(sinn(x))
A -0.5-> F -0.6-> G
stepz: 4
";
    let report = LSystem::read("my.lsys", text).unwrap_err();
    let drawing = report.to_string();
    let expected = [
        "error: `[` is not closed: there is no `]`",
        "--> my.lsys:1:9",
        "error: `fooo` is not a known name",
        "--> my.lsys:2:13",
        "error: `sinn` is not a known function",
        "did you mean `sin`?",
        "error: the probabilities sum to 1.1, expected 1",
        "error: `stepz` is not a known setting",
        "did you mean `step`?",
    ];
    for line in expected {
        assert!(drawing.contains(line), "{line} is missing in\n{drawing}");
    }
    assert!(drawing.contains("^^^^"), "{drawing}");
    assert_eq!(report.place(report.diagnostics[1].span.start), (2, 13));
}

#[test]
fn bad_input_is_refused() {
    assert_eq!(faults(""), [Fault::NoAxiom]);
    assert_eq!(faults("# nothing\n\n"), [Fault::NoAxiom]);
    let large = format!("axiom: {}", "F".repeat(MAX_BYTES));
    assert!(matches!(faults(&large)[..], [Fault::TooLarge { .. }]));
    for deep in ["[", "(", "{"] {
        let text = format!("axiom: F{}", deep.repeat(100_000));
        assert!(matches!(faults(&text)[0], Fault::TooDeep { .. } | Fault::Expected { .. }), "{deep}");
    }
    assert!(matches!(faults(&format!("axiom: F({}1)", "-".repeat(100_000)))[..], [Fault::TooDeep { .. }]));
    assert!(matches!(faults(&format!("axiom: F({}1)", "1+".repeat(100_000)))[..], [Fault::TooMany { .. }]));
    assert!(matches!(faults("axiom: F\nF -(-1)-> F -2-> G")[..], [Fault::OutOfRange { value: -1.0, .. }]));
    let default = faults("param a = 5 in 0..1\naxiom: F");
    assert!(matches!(default[..], [Fault::OutOfRange { value: 5.0, min: 0.0, max: 1.0, .. }]));
    assert!(matches!(faults("param for = 5 in 0..9\naxiom: F")[..], [Fault::Reserved { .. }]));
    assert!(matches!(faults("const sin = 5\naxiom: F")[..], [Fault::Reserved { .. }]));
    assert!(matches!(faults("axiom: F]")[..], [Fault::Unopened { close: ']' }]));
    assert!(matches!(faults("axiom: F?")[..], [Fault::NotASymbol { found: '?' }]));
    assert!(matches!(faults("axiom: F\nF -> FF\nF -> F")[..], [Fault::Hidden { .. }]));
    assert!(matches!(faults("axiom: F\nF -0.5-> FF -> F")[..], [Fault::NoProbability, ..]));
    assert!(matches!(faults("axiom: F\naxiom: G")[..], [Fault::Duplicate { .. }]));
    assert!(matches!(faults("axiom: F\nF(a) : 1 < a < 2 -> F")[..], [Fault::Expected { .. }]));
    assert!(matches!(faults("axiom: F(rand(1,2,3))")[..], [Fault::Arguments { max: 2, .. }]));
    assert!(matches!(faults("dialect: cpfg\naxiom: F")[..], [Fault::Unknown { what: "dialect", .. }]));
    assert!(matches!(faults("leaf_shape: heart\naxiom: F")[..], [Fault::Unknown { .. }]));
}

#[test]
fn odd_symbols_are_warnings() {
    let system = LSystem::read("test", "axiom: A(1) Q\nA(x, y) -> F").unwrap();
    let warnings = system.warnings().unwrap().to_string();
    assert!(warnings.contains("no rule takes `A` with 1 arguments, only with 2"), "{warnings}");
    assert!(warnings.contains("`Q` has no rule and no meaning"), "{warnings}");
}
