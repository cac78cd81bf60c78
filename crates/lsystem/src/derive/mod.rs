//! Derivation: from the axiom, step by step.
//!
//! Every draw has an address: the line of descent of the module whose rule draws, the step, the
//! rule, the repetitions around it and its place among the draws there. A change late in a grammar
//! leaves the draws before it alone, and modules may be rewritten in any order.

mod context;
mod machine;
mod step;
mod string;
mod writer;

pub(crate) use machine::{Machine, purpose};
pub(crate) use string::Modules;

use crate::diagnostic::{Diagnostic, Fault};
use crate::program::{CLOSE, Command, OPEN, Program};
use context::Surroundings;
use machine::Trouble;
use pleach_tree::Key;
use step::Step;
use writer::Writer;

/// How large a string may become, and how much work may go into it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Most modules of a string.
    pub symbols: usize,
    /// Most modules read and repeats made, over all steps. One takes 5 to 100 ns.
    pub work: u64,
}

impl Limits {
    /// 20 million modules, which take at most 1 GB with a few arguments each, and 100 million steps
    /// of work.
    pub const DEFAULT: Self = Self { symbols: 20_000_000, work: 100_000_000 };
}

impl Default for Limits {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Why a grammar does not grow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("step {step}: {}", diagnostic.fault)]
pub struct DeriveError {
    /// The step, from 1; 0 for the axiom and the header.
    pub step: usize,
    /// What went wrong, and where in the grammar.
    pub diagnostic: Diagnostic,
    /// The rule that was applied, such as `F(x)`; none in the axiom and the header.
    pub rule: Option<String>,
}

/// The number of the axiom among the rules.
pub(crate) const NO_RULE: usize = usize::MAX;

/// What went wrong in which rule.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stop {
    pub(crate) rule: usize,
    pub(crate) trouble: Trouble,
}

impl Stop {
    pub(crate) fn error(self, program: &Program, step: usize) -> DeriveError {
        let rule = program.rules.get(self.rule);
        let name = rule.map_or_else(|| "the axiom".to_owned(), |r| format!("the rule for `{}`", r.name));
        let span = self.trouble.span().or(rule.map(|r| r.span)).unwrap_or_default();
        let diagnostic = Diagnostic::new(span, self.trouble.fault(&name));
        DeriveError { step, diagnostic, rule: rule.map(|rule| rule.name.clone()) }
    }
}

/// What is to be derived.
#[derive(Clone, Copy)]
pub(crate) struct Request<'a> {
    /// Values of parameters and constants.
    pub(crate) globals: &'a [f64],
    pub(crate) key: Key,
    pub(crate) steps: usize,
    pub(crate) limits: Limits,
    pub(crate) parallel: bool,
}

/// The string after `request.steps` steps, or after the step that changed nothing.
pub(crate) fn derive(program: &Program, request: &Request<'_>) -> Result<Modules, DeriveError> {
    let Request { globals, limits, .. } = *request;
    let mut writer = Writer::new(program, globals, Modules::default(), limits.symbols, (0, limits.work));
    let key = request.key.child(purpose::AXIOM, 0);
    let axiom = writer.block(program.axiom, key).and_then(|()| writer.check());
    axiom.map_err(|trouble| Stop { rule: NO_RULE, trouble }.error(program, 0))?;
    let Writer { out: mut string, mut work, .. } = writer;
    cut(program, &mut string);
    let mut spare = Modules::default();
    for number in 0..request.steps {
        let surroundings = program.has_context.then(|| Surroundings::new(program, &string));
        let step = Step {
            program,
            globals,
            string: &string,
            number: number as u32,
            limits,
            spent: work,
            surroundings: surroundings.as_ref(),
        };
        let fail = |stop: Stop| stop.error(program, number + 1);
        let (mut next, changed, more) = step.rewrite(spare, request.parallel).map_err(fail)?;
        work += more;
        cut(program, &mut next);
        spare = std::mem::replace(&mut string, next);
        if !changed && !program.waits {
            break;
        }
    }
    Ok(string)
}

/// Drops what follows a `%` of the book's dialect up to the end of its branch.
fn cut(program: &Program, string: &mut Modules) {
    if !program.kinds.iter().any(|k| k.command == Command::Cut) {
        return;
    }
    let mut kept = Modules::default();
    let (mut value, mut dropped) = (0, None);
    for (at, &number) in string.kinds.iter().enumerate() {
        let kind = &program.kinds[usize::from(number)];
        let values = &string.values[value..value + kind.arity];
        value += kind.arity;
        // `dropped` is the number of brackets that are open since the cut.
        match (&mut dropped, number) {
            (Some(depth), OPEN) => *depth += 1,
            (Some(0), CLOSE) => dropped = None,
            (Some(depth), CLOSE) => *depth -= 1,
            _ => {}
        }
        if dropped.is_some() {
            continue;
        }
        kept.kinds.push(number);
        kept.values.extend_from_slice(values);
        kept.keys.extend(string.keys.get(at));
        if kind.command == Command::Cut {
            dropped = Some(0_usize);
        }
    }
    *string = kept;
}

/// The values of all parameters and constants.
pub(crate) fn globals(program: &Program, params: &[f64], key: Key) -> Result<Vec<f64>, DeriveError> {
    let mut values = params.to_vec();
    for (number, &code) in program.consts.iter().enumerate() {
        let mut machine = Machine::with_globals(program, &values);
        machine.key = key.child(purpose::CONSTANT, number as u32);
        let value = machine.eval(code).map_err(|trouble| header_error(program, code.start, trouble))?;
        values.push(value);
    }
    Ok(values)
}

/// A failure in the header.
pub(crate) fn header_error(program: &Program, op: u32, trouble: Trouble) -> DeriveError {
    let span = trouble.span().unwrap_or(program.spans[op as usize]);
    let fault: Fault = trouble.fault("the header");
    DeriveError { step: 0, diagnostic: Diagnostic::new(span, fault), rule: None }
}
