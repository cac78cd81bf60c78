//! Expressions.

use super::Span;

/// An operator with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryOp {
    /// `-x`.
    Neg,
    /// `!x`: 1 if x is 0, else 0.
    Not,
}

/// An operator with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "named after their signs, see `sign`")]
pub enum BinaryOp {
    Or,
    And,
    Lt,
    Le,
    Gt,
    Ge,
    Eq,
    Ne,
    Add,
    Sub,
    Mul,
    Div,
    Rem,
    Pow,
}

impl BinaryOp {
    /// All of them; a sign that begins another one stands after it.
    pub const ALL: [Self; 14] = [
        Self::Or,
        Self::And,
        Self::Le,
        Self::Lt,
        Self::Ge,
        Self::Gt,
        Self::Eq,
        Self::Ne,
        Self::Add,
        Self::Sub,
        Self::Mul,
        Self::Div,
        Self::Rem,
        Self::Pow,
    ];

    /// The sign in files.
    #[must_use]
    pub const fn sign(self) -> &'static str {
        match self {
            Self::Or => "||",
            Self::And => "&&",
            Self::Lt => "<",
            Self::Le => "<=",
            Self::Gt => ">",
            Self::Ge => ">=",
            Self::Eq => "==",
            Self::Ne => "!=",
            Self::Add => "+",
            Self::Sub => "-",
            Self::Mul => "*",
            Self::Div => "/",
            Self::Rem => "%",
            Self::Pow => "^",
        }
    }

    /// How tightly it binds, from 2; `?:` is 1.
    #[must_use]
    pub const fn precedence(self) -> u8 {
        match self {
            Self::Or => 2,
            Self::And => 3,
            Self::Lt | Self::Le | Self::Gt | Self::Ge | Self::Eq | Self::Ne => 4,
            Self::Add | Self::Sub => 5,
            Self::Mul | Self::Div | Self::Rem => 6,
            Self::Pow => POWER,
        }
    }
}

/// How tightly `?:` binds.
pub(crate) const CHOOSE: u8 = 1;
/// How tightly a sign in front binds: less than a power, so that `-x^2` is −(x²).
pub(crate) const UNARY: u8 = 7;
/// How tightly a power binds.
pub(crate) const POWER: u8 = 8;
/// Numbers, names, calls.
pub(crate) const ATOM: u8 = 9;

/// An expression and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// Its kind.
    pub kind: ExprKind,
    /// Where it stands.
    pub span: Span,
}

/// The kind of an expression.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// A number, not negative.
    Number(f64),
    /// A parameter, constant or local name.
    Name(String),
    /// A sign in front.
    Unary(UnaryOp, Box<Expr>),
    /// A sign between.
    Binary(BinaryOp, Box<[Expr; 2]>),
    /// `condition ? yes : no`.
    Choose(Box<[Expr; 3]>),
    /// `f(x, y)`.
    Call(String, Vec<Expr>),
}

impl ExprKind {
    pub(crate) const fn precedence(&self) -> u8 {
        match self {
            Self::Number(_) | Self::Name(_) | Self::Call(..) => ATOM,
            Self::Unary(..) => UNARY,
            Self::Binary(op, _) => op.precedence(),
            Self::Choose(_) => CHOOSE,
        }
    }
}
