//! What a grammar cannot do: take time or memory without end.

use pleach_lsystem::{Derivation, Fault, LSystem, Limits};
use pleach_tree::{Foliage, Tree};
use std::time::{Duration, Instant};

/// Time that none of these may take, on a machine that is busy with other things.
const PATIENCE: Duration = Duration::from_secs(20);

/// How deriving ends within small limits.
fn fault(text: &str, limits: Limits) -> Fault {
    let started = Instant::now();
    let system = LSystem::read("test", text).unwrap_or_else(|e| panic!("{e}"));
    let fault = system.derive(&Derivation { limits, ..Derivation::default() }).unwrap_err().diagnostic.fault;
    assert!(started.elapsed() < PATIENCE, "{:?} for {fault}", started.elapsed());
    fault
}

const LIMITS: Limits = Limits { symbols: 100_000, work: 1_000_000 };

#[test]
fn repetitions_that_write_nothing_end() {
    let inside = "for a in 0..9999 { for b in 0..9999 { for c in 0..9999 { let d = a; } } }";
    let in_axiom = fault(&format!("axiom: {inside}"), LIMITS);
    assert_eq!(in_axiom, Fault::TooMuchWork { limit: LIMITS.work });
    let in_rule = fault(&format!("steps: 1\naxiom: A\nA -> {inside}"), LIMITS);
    assert_eq!(in_rule, Fault::TooMuchWork { limit: LIMITS.work });
}

#[test]
fn long_expressions_are_work() {
    // A sum of 500 numbers is 999 operations.
    let sum = vec!["x"; 500].join("+");
    let lets: String = (0..40).map(|i| format!("let l{i} = {sum};")).collect();
    let text = format!("axiom: for x in 0..9000 {{ {lets} }}");
    assert_eq!(fault(&text, LIMITS), Fault::TooMuchWork { limit: LIMITS.work });
}

#[test]
fn rules_that_do_not_apply_are_work() {
    let rules: String = (0..9000).map(|i| format!("A(x) : x == {} -> F\n", i + 1)).collect();
    let text = format!("steps: 1\naxiom: for i in 0..9000 {{ A(0) }}\n{rules}");
    assert_eq!(fault(&text, LIMITS), Fault::TooMuchWork { limit: LIMITS.work });
}

#[test]
fn contexts_that_are_far_away_are_work() {
    // Every B looks past all the branches before it.
    let text = "steps: 16\naxiom: [B]\nB -> B\nA < B -> C\n";
    assert!(LSystem::read("test", text).unwrap_err().to_string().contains("never applies"));
    let text = "steps: 1\naxiom: for i in 0..9000 { [B] }\nA < B -> C\n";
    assert_eq!(fault(text, LIMITS), Fault::TooMuchWork { limit: LIMITS.work });
}

#[test]
fn arguments_take_memory_too() {
    let text = "steps: 20\naxiom: A(1,2,3,4,5,6,7,8,9)\n\
                A(a,b,c,d,e,f,g,h,i) -> A(a,b,c,d,e,f,g,h,i) A(a,b,c,d,e,f,g,h,i)";
    let limits = Limits { symbols: 4000, work: 1_000_000 };
    assert!(matches!(fault(text, limits), Fault::TooManySymbols { limit: 4000, .. }));
    // The same number of modules is allowed where they have no arguments.
    let plain = LSystem::read("test", "steps: 11\naxiom: A\nA -> AA").unwrap();
    assert_eq!(plain.derive(&Derivation { limits, ..Derivation::default() }).unwrap().len(), 2048);
    let wide = LSystem::read("test", &text.replace("20", "11")).unwrap();
    assert!(wide.derive(&Derivation { limits, ..Derivation::default() }).is_err());
}

#[test]
fn a_megabyte_of_statements_is_read_or_refused_quickly() {
    let lines = |line: &dyn Fn(usize) -> String| (0..60_000).map(line).collect::<String>();
    let texts = [
        lines(&|i| format!("module M{i}\n")),
        lines(&|i| format!("const c{i}=1\n")),
        lines(&|i| format!("param p{i}=1 in 0..2\n")),
        lines(&|_| "A:1->\n".to_owned()),
        lines(&|i| format!("A->F(n{i})\n")),
        lines(&|i| format!("s{i}tep: 1\n")),
        lines(&|_| "A -> ]\n".to_owned()),
        format!("ignore: {}", "+ - ".repeat(200_000)),
        format!("axiom: {}", "-(".repeat(400_000)),
        format!("axiom: {}", "F(1-(1)".repeat(100_000)),
    ];
    for text in texts {
        let started = Instant::now();
        let text = format!("axiom: F\n{text}");
        let report = LSystem::read("test", &text).err().map(|report| report.to_string());
        let start: String = text.chars().take(40).collect();
        assert!(started.elapsed() < PATIENCE, "{:?} for {start}", started.elapsed());
        assert!(report.is_none_or(|drawing| drawing.len() < 50_000), "{start}");
    }
}

/// Who is blamed for a tree beyond `limits`.
fn blamed(grammar: &str, limits: pleach_tree::Limits) -> String {
    let text = format!("grammar = '''\n{grammar}'''\n");
    let doc = pleach_tree::SpeciesDoc::parse("test", &text).unwrap();
    let species = doc.species(&pleach_lsystem::LSystemFamily).unwrap_or_else(|e| panic!("{e}"));
    let growth = pleach_tree::Growth { limits, ..pleach_tree::Growth::seed(1) };
    species.grow_with(&growth).unwrap_err().to_string()
}

#[test]
fn the_rule_that_grows_is_named() {
    let grammar = "dialect: hewitt\nsteps: n\nparam n = 9 in 1..64 count\naxiom: A(1)\n\
                   A(l) -> F(l) [ B(l) ] A(l) [ C ]\nB(l) -> F(l, 40) B(l)\nC -> [ F(1) ] C F(1) F(1)\n";
    let limits = pleach_tree::Limits::DEFAULT;
    let told = blamed(grammar, pleach_tree::Limits { stems: 5, ..limits });
    assert!(told.contains("because of `A(l)` and `C`"), "{told}");
    let told = blamed(grammar, pleach_tree::Limits { knots: 5, ..limits });
    assert!(told.contains("because of `C` and `A(l)`"), "{told}");
    let told = blamed(grammar, pleach_tree::Limits { leaves: 5, ..limits });
    assert!(told.contains("because of `B(l)`;"), "{told}");
    let told = blamed(grammar, pleach_tree::Limits { work: 100, ..limits });
    assert!(told.contains("`n`") && told.contains("because of `"), "{told}");
}

/// Numbers that are finite and whose products are not.
#[test]
fn huge_numbers_end_in_an_error_or_in_a_finite_tree() {
    let wide = LSystem::read("wide", "steps: 1\naxiom: !(1.7e308) F(0.001) f\n").unwrap();
    let derived = wide.derive(&Derivation::default()).unwrap();
    assert!(derived.to_svg().is_err());
    let turned = LSystem::read("turned", "dialect: hewitt\naxiom: F(10, 8, 45, 1e308)\n").unwrap();
    let derived = turned.derive(&Derivation::default()).unwrap();
    let mut tree = Tree::default();
    derived.grow(&pleach_tree::Limits::default(), Foliage::All, &mut tree).unwrap();
    assert_eq!(tree.leaves.len(), 8);
    tree.well_formed().unwrap();
    let thick = LSystem::read("thick", "dialect: hewitt\naxiom: !(1e60) F(10, 8, 45, 137.5)\n").unwrap();
    let derived = thick.derive(&Derivation::default()).unwrap();
    assert!(derived.grow(&pleach_tree::Limits::default(), Foliage::All, &mut tree).is_err());
}

/// Of a line as long as a book, a mistake shows what is around it: where it begins, here at the start of the
/// line and far along it.
#[test]
fn long_lines_are_cut() {
    let many = format!("F({}1)", "1+".repeat(20_000));
    let late = format!("{}F(1 +)", "F".repeat(20_000));
    for (successor, begins) in [(many, '1'), (late, ')')] {
        let text = format!("axiom: F\n# {}\nF -> {successor}\n", "x".repeat(50_000));
        let report = LSystem::read("long", &text).unwrap_err();
        let drawing = report.to_string();
        assert!(drawing.len() < 2000 && drawing.contains("--> long:3:"), "{drawing}");
        let lines: Vec<&str> = drawing.lines().collect();
        let caret = lines.iter().position(|line| line.ends_with('^')).unwrap();
        let under = lines[caret].chars().position(|c| c == '^').unwrap();
        assert_eq!(lines[caret - 1].chars().nth(under), Some(begins), "{drawing}");
    }
}
