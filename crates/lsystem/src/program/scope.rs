//! Names in sight while a rule or the header is compiled.

use super::ops::{Names, Op};
use crate::diagnostic::{Diagnostic, Fault};
use crate::syntax::{ExprKind, Function, Name, SettingKey, Shape, Span};
use pleach_tree::param::nearest;

/// Most local names in sight at once.
const MAX_LOCALS: usize = 200;
/// Problems after which no name is suggested.
const MAX_SUGGESTIONS: usize = 100;

/// Names in sight, the innermost last.
pub(super) struct Scope<'a> {
    pub(super) globals: &'a [String],
    /// Words of the setting that is compiled.
    pub(super) words: &'static [&'static str],
    locals: Vec<String>,
    /// Largest number of locals so far.
    pub(super) most: usize,
    /// Draws of the current block so far.
    pub(super) site: u32,
    pub(super) problems: &'a mut Vec<Diagnostic>,
}

impl<'a> Scope<'a> {
    pub(super) const fn new(globals: &'a [String], problems: &'a mut Vec<Diagnostic>) -> Self {
        Self { globals, words: &[], locals: Vec::new(), most: 0, site: 0, problems }
    }

    /// The scope of a setting, whose words are names.
    pub(super) const fn with_words(mut self, key: SettingKey) -> Self {
        if let Shape::Word(words) = key.shape() {
            self.words = words;
        }
        self
    }

    pub(super) const fn len(&self) -> usize {
        self.locals.len()
    }

    pub(super) fn truncate(&mut self, len: usize) {
        self.locals.truncate(len);
    }

    /// Adds a local name and returns its number.
    pub(super) fn add(&mut self, name: &Name) -> u16 {
        if self.locals.len() == MAX_LOCALS {
            let fault = Fault::TooMany { what: "local names", limit: MAX_LOCALS };
            self.problems.push(Diagnostic::new(name.span, fault));
            return 0;
        }
        self.locals.push(name.text.clone());
        self.most = self.most.max(self.locals.len());
        self.locals.len() as u16 - 1
    }

    pub(super) fn problem(&mut self, span: Span, fault: Fault) {
        self.problems.push(Diagnostic::new(span, fault));
    }
}

impl Names for Scope<'_> {
    fn find(&self, name: &str) -> Option<Op> {
        if let Some(i) = self.words.iter().position(|w| *w == name) {
            return Some(Op::Const(i as f64));
        }
        if let Some(i) = self.locals.iter().rposition(|l| l == name) {
            return Some(Op::Local(i as u16));
        }
        self.globals.iter().position(|g| g == name).map(|i| Op::Global(i as u16))
    }

    fn draw(&mut self) -> u32 {
        self.site += 1;
        self.site - 1
    }

    fn complain(&mut self, span: Span, expr: &ExprKind, found: usize) {
        // Looking for similar names takes time, so only the first problems get suggestions.
        let nearest = |name: &str, known: &mut dyn Iterator<Item = &str>| {
            if self.problems.len() < MAX_SUGGESTIONS { nearest(name, known) } else { None }
        };
        let fault = match expr {
            ExprKind::Call(name, _) => match Function::from_name(name) {
                Some(function) => {
                    let (min, max) = function.arity();
                    Fault::Arguments { name: name.clone(), found, min, max }
                }
                None => {
                    let nearest = nearest(name, &mut Function::ALL.into_iter().map(Function::name));
                    Fault::Unknown { what: "function", name: name.clone(), nearest }
                }
            },
            ExprKind::Name(name) => {
                let known = self.words.iter().copied();
                let mut known = known.chain(self.locals.iter().chain(self.globals).map(String::as_str));
                let what = if self.words.is_empty() { "name" } else { "word here" };
                Fault::Unknown { what, name: name.clone(), nearest: nearest(name, &mut known) }
            }
            _ => return,
        };
        self.problem(span, fault);
    }
}
