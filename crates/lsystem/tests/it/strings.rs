//! The strings of the papers' worked examples.

use crate::table::rows;
use pleach_lsystem::{Derivation, Derived, LSystem};

fn grammar(case: &str) -> &'static str {
    match case {
        "hewitt_2_3_1_plain" => "axiom: a\na -> bab\nb -> c",
        "hewitt_2_3_1_parametric" => {
            "axiom: A(1)\nA(x) : * -> A(2*x) B(0)\nB(x) : x <= 3 -> B(x+1)\nB(x) : x > 4 -> B(x-1)"
        }
        "coffey_from_A" => "axiom: A\nA -> BCA\nB -> AB",
        "coffey_from_B" => "axiom: B\nA -> BCA\nB -> AB",
        "abop_1_2_algae" => "axiom: b\na -> ab\nb -> a",
        "abop_1_2_anabaena" => {
            "module al, ar, bl, br\naxiom: ar\nar -> al br\nal -> bl ar\nbr -> ar\nbl -> al"
        }
        "abop_1_10_parametric" => {
            "axiom: B(2) A(4,4)\nA(x,y) : y <= 3 -> A(x*2, x+y)\nA(x,y) : y > 3 -> B(x) A(x/y, 0)
B(x) : x < 1 -> C\nB(x) : x >= 1 -> B(x-1)"
        }
        "steen_2_1_parametric" => "axiom: a(1)\na(x) -> a(2*x) b(0)",
        other => panic!("{other} has no grammar"),
    }
}

/// As the table writes numbers: six digits, no space after a comma.
fn text(derived: &Derived<'_>, spaced: bool) -> String {
    let round = |x: &f64| format!("{}", (x * 1e5).round() / 1e5);
    let module = |(name, values): (&str, &[f64])| match values {
        [] => name.to_owned(),
        values => format!("{name}({})", values.iter().map(round).collect::<Vec<_>>().join(",")),
    };
    derived.iter().map(module).collect::<Vec<_>>().join(if spaced { " " } else { "" })
}

#[test]
fn the_papers_strings_come_out() {
    for row in rows(include_str!("../data/lsystems_tests.csv")) {
        let [case, step, symbols, string, _] = &row[..] else { panic!("{row:?}") };
        let system = LSystem::read(case, grammar(case)).unwrap_or_else(|e| panic!("{e}"));
        let steps = Some(step.parse().unwrap());
        let derived = system.derive(&Derivation { steps, ..Derivation::default() }).unwrap();
        assert_eq!(text(&derived, case.contains("anabaena")), *string, "{case} after {step}");
        assert_eq!(derived.len().to_string(), *symbols, "{case} after {step}");
    }
}

#[test]
fn alternatives_come_as_often_as_they_say() {
    // Hewitt 2017, §2.3.1: nine words after two steps.
    let text = "axiom: a\na -0.25-> ab -0.25-> ba -0.5-> bab\nb -> c";
    let system = LSystem::read("stochastic", text).unwrap();
    let n = 8000;
    let mut counts = std::collections::BTreeMap::new();
    for seed in 0..n {
        let derivation = Derivation { seed, steps: Some(2), ..Derivation::default() };
        *counts.entry(system.derive(&derivation).unwrap().to_text()).or_insert(0_u32) += 1;
    }
    let sixteenths =
        [("abc", 1), ("bac", 1), ("cab", 1), ("cba", 1), ("babc", 2), ("cabc", 2), ("cbab", 2), ("cbac", 2)];
    assert_eq!(counts.len(), 9, "{counts:?}");
    for (word, share) in sixteenths.into_iter().chain([("cbabc", 4)]) {
        let (p, count) = (f64::from(share) / 16.0, f64::from(counts[word]));
        let deviation = (n as f64 * p * (1.0 - p)).sqrt();
        assert!((count - n as f64 * p).abs() < 4.5 * deviation, "{word}: {count} of {n}");
    }
}
