//! Genetic programming on grammars: changes of the syntax tree, and of the numbers in it.
//!
//! After Koza 1993 (subtrees that change places), Jacob 1994 and Ochoa 1998 (the same for L-systems). A
//! change is made on the syntax tree, the tree is printed, and the text is read and compiled as any
//! other: what is not a grammar then never leaves this module. Declared parameters stay as they are, so
//! that all descendants of a grammar have the same parameters.

mod cross;
mod draws;
mod items;
mod numbers;
mod rules;
mod sketch;
mod tidy;
mod walk;

use crate::generator::{GrammarGenerator, MAX_TEXT};
use crate::syntax::Grammar;
use crate::system::LSystem;
use draws::Draws;
use pleach_tree::{Generator, Key, Variation};
pub(crate) use sketch::blank;
use std::sync::Arc;

/// Times that a change is tried before the grammar stays as it was.
const TRIES: u32 = 8;

/// Chances of changes to numbers only, to items, and to rules otherwise.
const NUMBERS: f64 = 0.6;
const ITEMS: f64 = 0.3;

/// The text of `grammar` in normal form, if it can be read and grown; not whether its tree is small.
fn printed(mut grammar: Grammar) -> Option<String> {
    tidy::tidy(&mut grammar);
    let text = grammar.to_string();
    (text.len() <= MAX_TEXT && LSystem::read("grammar", &text).is_ok()).then_some(text)
}

/// The first text other than `structure` that `change` makes of its grammar.
fn changed(structure: &str, key: Key, change: impl Fn(&mut Grammar, &mut Draws)) -> String {
    let Ok(grammar) = Grammar::parse("grammar", structure) else { return structure.to_owned() };
    let attempt = |number| {
        let mut child = grammar.clone();
        change(&mut child, &mut Draws::new(key.child(0, number)));
        printed(child).filter(|text| text != structure)
    };
    (0..TRIES).find_map(attempt).unwrap_or_else(|| structure.to_owned())
}

impl Variation for GrammarGenerator {
    fn own(&self) -> String {
        self.system().grammar().to_string()
    }

    fn fresh(&self, key: Key) -> String {
        let sketch = |number| {
            let text = sketch::sketch(&mut Draws::new(key.child(0, number)));
            Grammar::parse("sketch", &text).ok().and_then(printed)
        };
        (0..TRIES).find_map(sketch).unwrap_or_else(|| self.own())
    }

    fn vary(&self, structure: &str, key: Key) -> String {
        changed(structure, key, |grammar, draws| {
            let kind = draws.unit();
            if kind < NUMBERS {
                numbers::vary(grammar, draws);
            } else if kind < NUMBERS + ITEMS {
                items::vary(grammar, draws);
            } else {
                rules::vary(grammar, draws);
            }
            // A new part seldom has the right size at once.
            if kind >= NUMBERS && draws.chance(0.3) {
                numbers::vary(grammar, draws);
            }
        })
    }

    fn cross(&self, one: &str, other: &str, key: Key) -> String {
        let Ok(other) = Grammar::parse("grammar", other) else { return one.to_owned() };
        changed(one, key, |grammar, draws| cross::cross(grammar, &other, draws))
    }

    fn length(&self, structure: &str) -> usize {
        // A word or a number is one, and so is every sign but those that only separate.
        let mut length = 0;
        let mut in_word = false;
        for c in structure.chars() {
            let is_word = c.is_alphanumeric() || c == '_' || c == '.';
            length +=
                usize::from(if is_word { !in_word } else { !c.is_whitespace() && !",;:()".contains(c) });
            in_word = is_word;
        }
        length
    }

    fn generator(&self, structure: &str) -> Option<Arc<dyn Generator>> {
        let system = LSystem::read("grammar", structure).ok()?;
        Some(Arc::new(Self::new(system).ok()?))
    }
}
