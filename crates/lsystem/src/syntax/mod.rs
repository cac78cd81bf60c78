//! The syntax tree of a grammar: what was written, before any name is looked up.

mod expr;
mod function;
mod print;
mod setting;

pub use expr::{BinaryOp, Expr, ExprKind, UnaryOp};
pub use function::Function;
pub use setting::{Setting, SettingKey, Shape};

/// Bytes of the text that a part of the tree came from.
///
/// Any two spans are equal, so that trees compare by what they say and not by where it stands.
#[derive(Clone, Copy, Debug, Default)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

impl PartialEq for Span {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Span {
    /// From the start of `self` to the end of `other`.
    #[must_use]
    pub const fn to(self, other: Self) -> Self {
        Self { start: self.start, end: other.end }
    }
}

/// What the symbols mean to the turtle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dialect {
    /// Prusinkiewicz and Lindenmayer 1990.
    #[default]
    Abop,
    /// Hewitt 2017, §3.1.2.
    Hewitt,
}

impl Dialect {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Abop, Self::Hewitt];

    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Abop => "abop",
            Self::Hewitt => "hewitt",
        }
    }
}

/// A grammar as it was written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grammar {
    /// Which symbols the turtle obeys.
    pub dialect: Dialect,
    /// The settings of the header but the dialect, in the order of [`SettingKey::ALL`].
    pub settings: Vec<Setting>,
    /// Modules whose names have several letters, or that stand for a command of the turtle.
    pub modules: Vec<ModuleName>,
    /// Symbols that contexts skip.
    pub ignore: Vec<Name>,
    /// Declared parameters.
    pub params: Vec<ParamDecl>,
    /// Constants, which may draw.
    pub consts: Vec<ConstDecl>,
    /// The string of step 0.
    pub axiom: Vec<Item>,
    /// Productions, in the order in which they are tried.
    pub rules: Vec<Rule>,
}

/// A name and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    /// The name.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

/// `module Fl = F`: a name of several letters, and the turtle's command that it stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct ModuleName {
    /// The module's name.
    pub name: Name,
    /// The symbol whose meaning it takes.
    pub alias: Option<Name>,
}

/// What a declared parameter's number measures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ParamUnit {
    /// `m`: metres.
    Meters,
    /// `deg`: degrees.
    Degrees,
    /// `count`: whole numbers.
    Count,
    /// No unit.
    #[default]
    Ratio,
}

impl ParamUnit {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Meters, Self::Degrees, Self::Count, Self::Ratio];

    /// Its word in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Meters => "m",
            Self::Degrees => "deg",
            Self::Count => "count",
            Self::Ratio => "ratio",
        }
    }
}

/// `param r = 0.9 in 0.5..1 search 0.8..0.95 "ratio of lengths"`.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamDecl {
    /// Its name.
    pub name: Name,
    /// The value where nothing else is said.
    pub default: f64,
    /// Smallest and largest allowed value.
    pub range: (f64, f64),
    /// The part of the range that searches draw from; all of it if absent.
    pub search: Option<(f64, f64)>,
    /// Unit.
    pub unit: ParamUnit,
    /// One line about it, possibly empty.
    pub doc: String,
}

/// `const s = rand(0.9, 1.1)`: evaluated once per plant.
#[derive(Clone, Debug, PartialEq)]
pub struct ConstDecl {
    /// Its name.
    pub name: Name,
    /// Its value.
    pub value: Expr,
}

/// One piece of an axiom or a successor.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// A symbol with its arguments.
    Module {
        /// The symbol.
        name: Name,
        /// Its arguments.
        args: Vec<Expr>,
    },
    /// `[ … ]`.
    Branch(Vec<Item>),
    /// `{ … }`, a filled polygon in the book's dialect.
    Polygon(Vec<Item>),
    /// `let n = …;`, drawn once and known to the end of the block.
    Let {
        /// The name.
        name: Name,
        /// Its value.
        value: Expr,
    },
    /// `for i in 0..n { … }` or `for w in [0.76, 0.6] { … }`.
    For {
        /// The name that changes.
        name: Name,
        /// Its values.
        values: Values,
        /// What is repeated.
        body: Vec<Item>,
    },
}

/// The values of a repetition's name.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// From the first in steps of 1, below the second.
    Range(Expr, Expr),
    /// These.
    List(Vec<Expr>),
}

/// The strict predecessor of a production.
#[derive(Clone, Debug, PartialEq)]
pub struct Predecessor {
    /// The symbol.
    pub name: Name,
    /// Names of its parameters.
    pub params: Vec<Name>,
}

/// One piece of a right context.
#[derive(Clone, Debug, PartialEq)]
pub enum Context {
    /// A symbol.
    Module(Predecessor),
    /// `[ … ]`: a side branch that begins like this.
    Branch(Vec<Context>),
}

/// A production: `left < A(x) > right : condition -> successor`.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// The left context, nearest last; empty for none.
    pub left: Vec<Predecessor>,
    /// What is replaced.
    pub pred: Predecessor,
    /// The right context, nearest first; empty for none.
    pub right: Vec<Context>,
    /// The condition, if any.
    pub condition: Option<Expr>,
    /// The successors; more than one if each has a weight.
    pub successors: Vec<Successor>,
    /// Where the rule stands.
    pub span: Span,
}

/// One successor and its probability.
#[derive(Clone, Debug, PartialEq)]
pub struct Successor {
    /// Probability, 1 if absent.
    pub weight: Option<Expr>,
    /// What is written.
    pub items: Vec<Item>,
}
