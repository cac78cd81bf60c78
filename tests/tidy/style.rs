//! Words that `docs/style.md` rules out, in sources, messages and documents.

use crate::tree::{Tree, text};
use std::fmt::Write as _;

/// Ways of writing that are ruled out together, and what to write instead.
struct Rule {
    /// The row of the guide.
    guide: &'static str,
    phrases: &'static [&'static str],
    better: &'static str,
}

const fn rule(guide: &'static str, phrases: &'static [&'static str], better: &'static str) -> Rule {
    Rule { guide, phrases, better }
}

/// In lower case but for names of constants. A phrase that begins or ends with a letter begins or ends a word there;
/// one that ends in `_` begins a name.
const RULES: &[Rule] = &[
    rule("is no range", &["is no range", "is no grid"], "is not a …"),
    rule("vouches", &["vouch", "vouches"], "outside the hull: extrapolated"),
    rule("anew", &["anew"], "again, from the start"),
    rule("whoever", &["whoever"], "anyone who, a user who"),
    rule("by turns", &["by turns"], "alternately"),
    rule("of late", &["of late"], "recently"),
    rule("put into words", &["put into words"], "serialised"),
    rule(
        "could not be had",
        &["could not be had", "cannot be had", "can be had", "to be had"],
        "failed; is available",
    ),
    rule(
        "dealt",
        &["dealt anew", "dealt other", "dealt out", "deals out", "deal out"],
        "re-sampled, distributed",
    ),
    rule("swap storms", &["swap storm", "swap storms"], "runaway memory"),
    rule("what is made small", &["made small", "made large"], "cost, minimised; maximised"),
    rule("champions", &["champion", "champions"], "elites"),
    rule(
        "metres a pixel",
        &["metres a pixel", "meters a pixel", "bytes a pixel", "samples a pixel"],
        "per pixel",
    ),
    rule(
        "none where",
        &["; none where", "; none if", "; none for", "; none outside", "; none is"],
        "`None` where …",
    ),
    rule("nobody's concern", &["nobody's concern", "serve nobody", "serves nobody"], "is ignored"),
    rule("MOST_SIDE", &["MOST_"], "MAX_"),
    rule("LEAST_RADIUS", &["LEAST_"], "MIN_"),
    rule("| `of` |", &["fn of("], "new, from_…, get, or the noun"),
];

/// What is still there, at most this often: folder, phrase, times. An entry that is not needed any more has to go.
const KNOWN: &[(&str, &str, usize)] = &[];

/// The guide names what it rules out, and so do these tests. The log says what was.
const EXEMPT: [&str; 4] = ["docs/style.md", "tests/tidy/style.rs", "tests/tidy/documents.rs", "CHANGELOG.md"];

/// Terms of the field that begin like a name that is ruled out: least cost, least squares.
const TERMS: [&str; 2] = ["COST", "SQUARES"];

/// How often a line has the phrase, as words of its own.
fn count(line: &str, phrase: &str) -> usize {
    let is_name = phrase.ends_with('_');
    let lowered = if is_name { line.to_owned() } else { line.to_lowercase() };
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    lowered
        .match_indices(phrase)
        .filter(|(at, _)| {
            let (before, after) = (&lowered[..*at], &lowered[at + phrase.len()..]);
            let begins = !before.ends_with(is_word) || !phrase.starts_with(is_word);
            let is_term = |term: &&str| after.starts_with(*term);
            let ends = if is_name {
                !TERMS.iter().any(is_term)
            } else {
                !after.starts_with(is_word) || !phrase.ends_with(is_word)
            };
            begins && ends
        })
        .count()
}

#[test]
fn no_source_and_no_document_has_a_word_that_the_guide_rules_out() {
    let (tree, mut faults, mut left) = (Tree::read(), String::new(), vec![0; KNOWN.len()]);
    let files = tree.with_extension(&["rs", "md", "ts", "tsx", "mjs", "py", "pyi", "sh", "toml"]);
    for file in files.filter(|file| !EXEMPT.contains(file)) {
        for (index, line) in text(file).lines().enumerate() {
            for rule in RULES {
                for phrase in rule.phrases {
                    let found = count(line, phrase);
                    if found == 0 {
                        continue;
                    }
                    let known =
                        KNOWN.iter().position(|(place, known, _)| file.starts_with(place) && known == phrase);
                    if let Some(known) = known {
                        left[known] += found;
                    }
                    if known.is_none_or(|known| left[known] > KNOWN[known].2) {
                        let _ = writeln!(faults, "{file}:{}: `{phrase}`, better: {}", index + 1, rule.better);
                    }
                }
            }
        }
    }
    for ((place, phrase, times), left) in KNOWN.iter().zip(left) {
        if left == 0 {
            let _ = writeln!(
                faults,
                "{place} has `{phrase}` no more, not {times} times: take the entry out of `KNOWN`"
            );
        }
    }
    assert!(faults.is_empty(), "words that docs/style.md rules out:\n{faults}");
}

#[test]
fn every_rule_is_in_the_guide() {
    let guide = text("docs/style.md");
    for rule in RULES {
        assert!(guide.contains(rule.guide), "docs/style.md says nothing of `{}`", rule.guide);
    }
}

#[test]
fn phrases_are_found_as_words() {
    assert_eq!(count("/// Begins Anew, anew.", "anew"), 2);
    assert_eq!(count("renewed, manew", "anew"), 0);
    assert_eq!(count("const MOST_SIDE: f64", "MOST_"), 1);
    assert_eq!(count("ALMOST_, let most_side", "MOST_"), 0);
    assert_eq!(count("LEAST_COST_PATH, LEAST_RADIUS", "LEAST_"), 1);
    assert_eq!(count("pub fn of(self)", "fn of("), 1);
    assert_eq!(count("the lock; none where there is none", "; none where"), 1);
}
