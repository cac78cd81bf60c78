//! A grammar compiled once: names looked up, expressions as lists of operations, runs of symbols as
//! slices.

mod command;
mod compile;
mod ops;
mod rules;
mod scope;

pub use command::{Axis, Command};
pub(crate) use compile::compile;
pub(crate) use ops::{Binary, Code, Op, Unary};
pub(crate) use rules::SUM_TOLERANCE;

use crate::syntax::{Dialect, ParamDecl, SettingKey, Span};

/// Number of a kind of module: a symbol with a number of arguments.
pub(crate) type KindIndex = u16;

/// The kinds of brackets, which every program has.
pub(crate) const OPEN: KindIndex = 0;
pub(crate) const CLOSE: KindIndex = 1;
pub(crate) const OPEN_POLYGON: KindIndex = 2;
pub(crate) const CLOSE_POLYGON: KindIndex = 3;

/// A symbol with a number of arguments.
#[derive(Clone, Debug)]
pub(crate) struct Kind {
    pub(crate) name: String,
    pub(crate) arity: usize,
    pub(crate) command: Command,
    /// Numbers of its rules, in the order in which they are tried.
    pub(crate) rules: Vec<usize>,
    /// Whether anything that grows from it draws, so that its address is kept.
    pub(crate) keyed: bool,
    /// The slice of [`Program::runs`] that always replaces it, where there is one.
    pub(crate) run: Option<(u32, u32)>,
    /// It leaves at least this many modules after a step.
    pub(crate) min_len: u64,
}

/// One module of a context: its kind and the first of the locals that take its arguments.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Formal {
    pub(crate) kind: KindIndex,
    pub(crate) local: u16,
}

/// One piece of a right context.
#[derive(Clone, Debug)]
pub(crate) enum Pattern {
    Module(Formal),
    Branch(Vec<Pattern>),
}

#[derive(Clone, Debug)]
pub(crate) struct Rule {
    /// As messages call it.
    pub(crate) name: String,
    pub(crate) span: Span,
    /// Nearest last.
    pub(crate) left: Vec<Formal>,
    pub(crate) right: Vec<Pattern>,
    pub(crate) condition: Option<Code>,
    /// Weights (empty for a single successor) and where their sum is known to be 1.
    pub(crate) weights: Vec<Code>,
    /// Work of condition and weights, as of a [`Block`].
    pub(crate) toll: u32,
    pub(crate) successors: Vec<Block>,
}

/// Operations of one block or condition that are one more step of work: none that people write has so
/// many.
pub(crate) const OPS_PER_WORK: u32 = 64;

/// A slice of [`Program::acts`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    pub(crate) start: u32,
    pub(crate) end: u32,
    /// Work of its expressions beyond that of being read: one for [`OPS_PER_WORK`] operations.
    pub(crate) toll: u32,
}

/// What a successor does, in order.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Act {
    /// Writes a slice of [`Program::runs`]; `position` is the address of the first.
    Run { start: u32, len: u32, position: u32 },
    /// Writes a module whose arguments are [`Program::codes`] from `args` on.
    Module { kind: KindIndex, args: u32, position: u32 },
    /// Gives a local name its value.
    Let { local: u16, value: u32 },
    /// Repeats the acts up to `end`; `from` and `to` are codes. `toll` is that of the [`Block`].
    Range { local: u16, from: u32, to: u32, end: u32, toll: u32, site: u32 },
    /// Repeats the acts up to `end` once for each of `count` codes.
    List { local: u16, first: u32, count: u32, end: u32, toll: u32, site: u32 },
}

/// A compiled grammar.
#[derive(Clone, Debug)]
pub(crate) struct Program {
    pub(crate) dialect: Dialect,
    pub(crate) params: Vec<ParamDecl>,
    pub(crate) kinds: Vec<Kind>,
    pub(crate) rules: Vec<Rule>,
    pub(crate) acts: Vec<Act>,
    pub(crate) runs: Vec<KindIndex>,
    pub(crate) codes: Vec<Code>,
    pub(crate) ops: Vec<Op>,
    /// Where each operation stands in the text.
    pub(crate) spans: Vec<Span>,
    pub(crate) axiom: Block,
    /// Constants, whose values follow those of the parameters.
    pub(crate) consts: Vec<Code>,
    pub(crate) settings: Vec<(SettingKey, Vec<Code>)>,
    /// Kinds that contexts skip.
    pub(crate) ignored: Vec<bool>,
    /// Whether anything draws at all.
    pub(crate) random: bool,
    /// Whether a condition draws, so that a step that changes nothing need not be the last.
    pub(crate) waits: bool,
    /// Whether any rule has a context.
    pub(crate) has_context: bool,
    /// Largest number of local names of a rule.
    pub(crate) locals: usize,
    /// Largest depth of an expression's stack.
    pub(crate) stack: usize,
}
