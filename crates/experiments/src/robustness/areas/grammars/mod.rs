//! Spoilt grammars: random text, texts with edits, and syntax trees with parts that moved.

mod soup;
mod trees;

use super::{Area, draws, refused};
use crate::robustness::mutate;
use crate::robustness::verdict::Verdict;
use pleach_fit::Stream;
use pleach_lsystem::{Derivation, Derived, Grammar, LSystem, LSystemFamily, Limits, Report};
use pleach_tree::{Family, Foliage, SpeciesDoc, Tree};
use std::path::Path;

const LANE: u32 = 6;

/// The listings of docs/grammars.md, with lines of `---` between them.
const LISTINGS: &str = include_str!("../../templates/grammars.txt");

/// Bounds of derivation in most cases.
const SMALL: Limits = Limits { symbols: 20_000, work: 100_000 };
/// Bounds in a few cases: enough for strings that are derived in parallel.
const LARGE: Limits = Limits { symbols: 150_000, work: 600_000 };
/// One case in this many has the large bounds.
const RARELY: u64 = 64;
/// Most bytes of the drawing of all mistakes.
const MAX_DRAWING: usize = 30_000;

/// The grammars of all species and of the manual.
pub(in super::super) struct Grammars {
    texts: Vec<String>,
    trees: Vec<Grammar>,
}

impl Grammars {
    pub(in super::super) fn new() -> anyhow::Result<Self> {
        let mut texts: Vec<String> = LISTINGS.split("---\n").map(str::to_owned).collect();
        for (name, file) in LSystemFamily.presets() {
            let doc = SpeciesDoc::parse(name, file)?;
            texts.extend(doc.text("grammar").ok().flatten().map(str::to_owned));
        }
        let trees: Result<Vec<Grammar>, Report> =
            texts.iter().map(|text| Grammar::parse("grammar", text)).collect();
        Ok(Self { trees: trees?, texts })
    }

    fn spoilt(&self, draws: &mut Stream) -> Vec<u8> {
        match draws.below(10) {
            0 => soup::bytes(draws),
            1 => soup::words(draws),
            2..=5 => mutate::text(&self.texts[draws.below(self.texts.len())], draws),
            _ => trees::mutated(&self.trees, draws).to_string().into_bytes(),
        }
    }
}

impl Area for Grammars {
    fn name(&self) -> &'static str {
        "grammars"
    }

    fn input(&self, case: u64) -> Vec<u8> {
        self.spoilt(&mut draws(LANE, case))
    }

    fn judge(&self, case: u64, _: &Path) -> Verdict {
        let input = self.input(case);
        // A file that is not text is refused before it is a grammar; here it is read as far as it can be.
        let text = String::from_utf8_lossy(&input);
        let system = match LSystem::read("spoilt.lsys", &text) {
            Ok(system) => system,
            Err(report) => return told(&report),
        };
        if let Some(wrong) = printed_otherwise(system.grammar()) {
            return Verdict::Wrong(wrong);
        }
        let limits = if case.is_multiple_of(RARELY) { LARGE } else { SMALL };
        let derivation = Derivation {
            seed: case,
            steps: case.is_multiple_of(2).then_some((case / 2 % 8) as usize),
            limits,
            ..Derivation::default()
        };
        let serial = system.derive(&derivation);
        if limits == LARGE {
            let parallel = system.derive(&Derivation { parallel: true, ..derivation });
            let is_same = match (&serial, &parallel) {
                (Ok(one), Ok(other)) => is_same(one, other),
                // As text: an error that holds nan is not equal to itself.
                (Err(one), Err(other)) => format!("{one:?}") == format!("{other:?}"),
                _ => false,
            };
            if !is_same {
                return Verdict::Wrong("another string on one thread than on many".to_owned());
            }
        }
        match serial {
            Ok(derived) if derived.len() > limits.symbols => {
                Verdict::Wrong("more symbols than the limit allows".to_owned())
            }
            Ok(derived) => drawn(&derived, case),
            Err(error) => told(&system.report(&error)),
        }
    }
}

/// A refusal, if every mistake has a place in the text and can be read.
fn told(report: &Report) -> Verdict {
    let drawing = report.to_string();
    let lines = report.text.matches('\n').count() + 1;
    for diagnostic in &report.diagnostics {
        let (line, column) = report.place(diagnostic.span.start);
        let message = format!("spoilt.lsys:{line}:{column}: {}", diagnostic.fault);
        if line > lines {
            return Verdict::Wrong(format!("{message}: there are {lines} lines"));
        }
        let verdict = refused(message, true);
        if verdict != Verdict::Refused {
            return verdict;
        }
    }
    let is_drawn = drawing.len() <= MAX_DRAWING
        && drawing.contains("error")
        && !drawing.contains(|c: char| c.is_control() && c != '\n');
    if is_drawn { Verdict::Refused } else { Verdict::Unclear(drawing) }
}

/// What is wrong with printing, if the text of `grammar` is not read as the same grammar.
fn printed_otherwise(grammar: &Grammar) -> Option<String> {
    let text = grammar.to_string();
    match Grammar::parse("printed", &text) {
        Ok(again) if again != *grammar => Some(format!("printed it is another grammar:\n{text}")),
        Ok(again) if again.to_string() != text => Some(format!("printed twice it differs:\n{text}")),
        Ok(_) => None,
        Err(error) => Some(format!("printed it cannot be read again: {error}")),
    }
}

fn is_same(one: &Derived<'_>, other: &Derived<'_>) -> bool {
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    one.len() == other.len()
        && one.iter().zip(other.iter()).all(|(a, b)| a.0 == b.0 && bits(a.1) == bits(b.1))
}

/// Grows the string and, now and then, draws it in the plane.
fn drawn(derived: &Derived<'_>, case: u64) -> Verdict {
    let mut tree = Tree::default();
    let limits = super::LIMITS;
    let foliage = if case.is_multiple_of(5) { Foliage::None } else { Foliage::All };
    if case.is_multiple_of(7)
        && let Ok(svg) = derived.to_svg()
        && (svg.contains("NaN") || svg.contains("inf"))
    {
        return Verdict::Wrong("a drawing with numbers that are not finite".to_owned());
    }
    match derived.grow(&limits, foliage, &mut tree) {
        Err(fault) => refused(fault.to_string(), false),
        Ok(()) => match tree.well_formed() {
            Err(what) => Verdict::Wrong(what.to_string()),
            Ok(())
                if tree.stems.len() > limits.stems
                    || tree.knots.len() > limits.knots
                    || tree.leaves.len() > limits.leaves =>
            {
                Verdict::Wrong("more than the limits allow".to_owned())
            }
            Ok(()) => Verdict::Accepted,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Grammars written by people; the one that a search has found is left out.
    const MANUAL: &str = include_str!("../../../../../../docs/grammars.md");

    #[test]
    fn listings_are_those_of_the_manual() {
        let written = MANUAL.split("## Evolving rules").next().unwrap_or_default();
        let listings: Vec<&str> = written
            .split("```lsystem\n")
            .skip(1)
            .map(|part| part.split("```").next().unwrap_or_default())
            .collect();
        assert_eq!(LISTINGS.split("---\n").collect::<Vec<_>>(), listings);
    }

    #[test]
    fn grammars_are_sound_until_they_are_spoilt() {
        let grammars = Grammars::new().unwrap();
        assert!(grammars.texts.len() > 30);
        for tree in &grammars.trees {
            assert_eq!(printed_otherwise(tree), None);
        }
    }

    #[test]
    fn all_sorts_come_of_spoilt_grammars() {
        let grammars = Grammars::new().unwrap();
        let verdicts: Vec<Verdict> =
            (0..300).map(|case| grammars.judge(case, Path::new("nowhere"))).collect();
        let count = |verdict: &Verdict| verdicts.iter().filter(|v| *v == verdict).count();
        assert!(count(&Verdict::Accepted) > 30 && count(&Verdict::Refused) > 30, "{verdicts:?}");
    }
}
