//! From text to the syntax tree.
//!
//! A statement begins in the first column of a line and goes on through all lines that are indented
//! or begin with a closing bracket, so that a mistake in one statement leaves the next readable and
//! several mistakes are reported at once.

mod cursor;
mod expr;
mod header;
mod items;

use crate::diagnostic::{Diagnostic, Fault};
use crate::syntax::{Function, Grammar, Rule, Span, Successor};
use cursor::{Cursor, Parsed};

/// Most bytes of a grammar.
pub const MAX_BYTES: usize = 1 << 20;
/// Most names of modules: each is compared with every place of the text.
const MAX_MODULES: usize = 256;
/// Most parameters, and most constants: each name is compared with those before it.
const MAX_NAMES: usize = 1000;
/// Most rules: a module may try them all.
const MAX_RULES: usize = 10_000;
/// Problems after which nothing more is read.
const MAX_PROBLEMS: usize = 1000;

/// Words that cannot be names of parameters, constants or local definitions.
fn is_reserved(word: &str) -> bool {
    matches!(word, "for" | "in" | "let") || Function::from_name(word).is_some()
}

/// Reads `text`. What could be read comes back beside the problems, if there are any.
pub(crate) fn parse(text: &str) -> (Grammar, Vec<Diagnostic>) {
    let mut grammar = Grammar::default();
    let mut problems = Vec::new();
    if text.len() > MAX_BYTES {
        let fault = Fault::TooLarge { bytes: text.len(), limit: MAX_BYTES };
        return (grammar, vec![Diagnostic::new(Span::default(), fault)]);
    }
    let statements = statements(text);
    // Names of modules come first: they decide how every other line is cut into symbols.
    let mut is_module = vec![false; statements.len()];
    for (&span, done) in statements.iter().zip(&mut is_module) {
        let mut cursor = Cursor::new(text, span, &[]);
        if cursor.take_word("module") {
            *done = true;
            if let Err(problem) = cursor.module(&mut grammar) {
                problems.push(*problem);
            }
        }
    }
    let mut modules: Vec<String> = grammar.modules.iter().map(|m| m.name.text.clone()).collect();
    modules.sort_by_key(|name| std::cmp::Reverse(name.len()));

    let mut has_axiom = false;
    for (&span, _) in statements.iter().zip(&is_module).filter(|(_, done)| !**done) {
        let mut cursor = Cursor::new(text, span, &modules);
        let read = match cursor.header(&mut grammar, &mut has_axiom) {
            Ok(true) => Ok(()),
            Ok(false) => cursor.rule().map(|rule| grammar.add(rule)),
            Err(problem) => Err(problem),
        };
        if let Err(problem) = read.and_then(|()| cursor.end()) {
            problems.push(*problem);
        }
        let counts = [
            ("parameters", grammar.params.len(), MAX_NAMES),
            ("constants", grammar.consts.len(), MAX_NAMES),
            ("rules", grammar.rules.len(), MAX_RULES),
        ];
        if let Some((what, _, limit)) = counts.into_iter().find(|(_, count, limit)| count > limit) {
            problems.push(Diagnostic::new(span, Fault::TooMany { what, limit }));
            break;
        }
        if problems.len() >= MAX_PROBLEMS {
            break;
        }
    }
    grammar.settings.sort_by_key(|setting| setting.key);
    if !has_axiom {
        problems.push(Diagnostic::new(Span::default(), Fault::NoAxiom));
    }
    (grammar, problems)
}

/// The bytes of each statement.
fn statements(text: &str) -> Vec<Span> {
    let mut found: Vec<Span> = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let first = line.chars().next();
        let begins = first.is_some_and(|c| !(c.is_whitespace() || "#)]}".contains(c)));
        let end = start + line.trim_end().len();
        match found.last_mut() {
            Some(last) if !begins => last.end = last.end.max(end),
            None if !begins && line.trim_start().starts_with(|c| c != '#') => {
                found.push(Span { start, end });
            }
            _ if begins => found.push(Span { start, end }),
            _ => {}
        }
        start += line.len();
    }
    found
}

impl Cursor<'_> {
    /// Nothing may be left of the statement.
    fn end(&mut self) -> Parsed<()> {
        self.skip();
        match self.peek() {
            None => Ok(()),
            Some(close @ (']' | '}' | ')')) => {
                let span = Span { start: self.at, end: self.at + 1 };
                Err(self.fault(span, Fault::Unopened { close }))
            }
            Some(_) => Err(self.unexpected("the end of the statement")),
        }
    }

    fn rule(&mut self) -> Parsed<Rule> {
        self.skip();
        let start = self.at;
        let (left, pred, right) = self.head()?;
        let condition = if self.take(':') {
            self.skip();
            // `*` is the book's sign for no condition.
            if self.take('*') { None } else { Some(self.expr()?) }
        } else {
            None
        };
        let mut successors = Vec::new();
        loop {
            self.skip();
            let weight = if self.weighted_arrow() {
                self.bump();
                let weight = self.expr_atom()?;
                Some(weight)
            } else {
                None
            };
            let arrow = self.arrow();
            if arrow == 0 {
                if successors.is_empty() {
                    return Err(self.unexpected("`->` and the successor"));
                }
                return Ok(Rule { left, pred, right, condition, successors, span: self.since(start) });
            }
            self.at += arrow;
            let items = self.items()?;
            successors.push(Successor { weight, items });
        }
    }
}

impl Grammar {
    /// Appends a rule, or its successors to those of the last rule if that is the same but for them.
    fn add(&mut self, rule: Rule) {
        let weighted = |rule: &Rule| rule.successors.iter().all(|s| s.weight.is_some());
        let same = |a: &Rule, b: &Rule| {
            a.left == b.left && a.pred == b.pred && a.right == b.right && a.condition == b.condition
        };
        match self.rules.last_mut() {
            Some(last) if weighted(last) && weighted(&rule) && same(last, &rule) => {
                last.successors.extend(rule.successors);
            }
            _ => self.rules.push(rule),
        }
    }
}
