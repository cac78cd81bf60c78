//! Evaluates expressions.

use crate::diagnostic::Fault;
use crate::program::{Binary, Code, Op, Program, Unary};
use crate::syntax::{BinaryOp, Function, Span};
use pleach_tree::Key;
use pleach_tree::math;
use pleach_tree::trig::{atan2, sin_cos};
use std::f64::consts::TAU;

/// What draws are for; see [`Key`].
pub(crate) mod purpose {
    pub(crate) const MODULE: u32 = 0;
    pub(crate) const STEP: u32 = 1;
    pub(crate) const REPEAT: u32 = 2;
    pub(crate) const CHOICE: u32 = 3;
    pub(crate) const DRAW: u32 = 4;
    pub(crate) const NORMAL: u32 = 5;
    pub(crate) const CONSTANT: u32 = 6;
    pub(crate) const AXIOM: u32 = 7;
    pub(crate) const BEND: u32 = 8;
    pub(crate) const RULE: u32 = 9;
    pub(crate) const SUCCESSOR: u32 = 10;
}

/// Why an expression has no value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Trouble {
    DivisionByZero(Span),
    NotFinite(Span, f64),
    Repeats(Span, f64),
    TooManySymbols(usize),
    TooMuchWork(u64),
    ProbabilitySum(f64),
}

/// Most repeats of one repetition.
pub(crate) const MAX_REPEATS: usize = 10_000;

impl Trouble {
    /// The fault in `rule`.
    pub(crate) fn fault(self, rule: &str) -> Fault {
        let rule = rule.to_owned();
        match self {
            Self::DivisionByZero(_) => Fault::DivisionByZero { rule },
            Self::NotFinite(_, value) => Fault::NotFinite { rule, value },
            Self::Repeats(_, count) => Fault::TooManyRepeats { rule, count, limit: MAX_REPEATS },
            Self::TooManySymbols(limit) => Fault::TooManySymbols { rule, limit },
            Self::TooMuchWork(limit) => Fault::TooMuchWork { limit },
            Self::ProbabilitySum(sum) => Fault::ProbabilitySum { sum },
        }
    }

    /// Where it happened, if that is one expression.
    pub(crate) const fn span(self) -> Option<Span> {
        match self {
            Self::DivisionByZero(span) | Self::NotFinite(span, _) | Self::Repeats(span, _) => Some(span),
            Self::TooManySymbols(_) | Self::TooMuchWork(_) | Self::ProbabilitySum(_) => None,
        }
    }
}

/// A stack, the names in sight, and the address of the next draws.
pub(crate) struct Machine<'a> {
    pub(crate) program: &'a Program,
    stack: Vec<f64>,
    /// Values of local names.
    pub(crate) frame: Vec<f64>,
    /// Values of parameters, then of constants.
    pub(crate) globals: &'a [f64],
    /// The block that draws.
    pub(crate) key: Key,
}

impl<'a> Machine<'a> {
    pub(crate) fn new(program: &'a Program) -> Self {
        Self::with_globals(program, &[])
    }

    pub(crate) fn with_globals(program: &'a Program, globals: &'a [f64]) -> Self {
        let stack = vec![0.0; program.stack + 2];
        Self { program, stack, frame: vec![0.0; program.locals], globals, key: Key::root(0) }
    }

    /// The value of `code`, which is finite.
    #[inline]
    pub(crate) fn eval(&mut self, code: Code) -> Result<f64, Trouble> {
        let value = match self.program.ops[code.start as usize] {
            Op::Const(number) if code.end - code.start == 1 => number,
            Op::Local(i) if code.end - code.start == 1 => self.frame[usize::from(i)],
            _ => self.run(code)?,
        };
        if value.is_finite() {
            return Ok(value);
        }
        Err(Trouble::NotFinite(self.span(code), value))
    }

    /// All of an expression: what its operations came from, the last of which stands for the whole, but for
    /// those that end in a jump.
    #[cold]
    fn span(&self, code: Code) -> Span {
        let spans = &self.program.spans[code.start as usize..code.end as usize];
        spans
            .iter()
            .fold(spans[0], |all, one| Span { start: all.start.min(one.start), end: all.end.max(one.end) })
    }

    fn run(&mut self, code: Code) -> Result<f64, Trouble> {
        let Self { program, stack, frame, globals, key } = self;
        let (mut at, mut top) = (code.start as usize, 0);
        while at < code.end as usize {
            let op = program.ops[at];
            at += 1;
            match op {
                Op::Const(number) => {
                    stack[top] = number;
                    top += 1;
                }
                Op::Global(i) => {
                    stack[top] = globals[usize::from(i)];
                    top += 1;
                }
                Op::Local(i) => {
                    stack[top] = frame[usize::from(i)];
                    top += 1;
                }
                Op::Unary(op) => stack[top - 1] = unary(op, stack[top - 1]),
                Op::Binary(op) => {
                    top -= 1;
                    let (a, b) = (stack[top - 1], stack[top]);
                    if b == 0.0 && matches!(op, Binary::Op(BinaryOp::Div | BinaryOp::Rem)) {
                        return Err(Trouble::DivisionByZero(program.spans[at - 1]));
                    }
                    stack[top - 1] = binary(op, a, b);
                }
                Op::Rand(site) => {
                    top -= 1;
                    let (a, b) = (stack[top - 1], stack[top]);
                    stack[top - 1] = a + (b - a) * key.unit(purpose::DRAW, site);
                }
                Op::Nrand(site) => {
                    top -= 1;
                    let (mean, deviation) = (stack[top - 1], stack[top]);
                    // Box and Muller: 1 - u is in (0, 1].
                    let far = (-2.0 * math::ln(1.0 - key.unit(purpose::NORMAL, site))).sqrt();
                    let (_, cos) = sin_cos(TAU * key.unit(purpose::DRAW, site));
                    stack[top - 1] = mean + deviation * far * cos;
                }
                Op::Jump(to) => at = to as usize,
                Op::JumpIfZero(to) => {
                    top -= 1;
                    if stack[top] == 0.0 {
                        at = to as usize;
                    }
                }
            }
        }
        Ok(stack[0])
    }
}

fn unary(op: Unary, x: f64) -> f64 {
    match op {
        Unary::Neg => -x,
        Unary::Not => f64::from(x == 0.0),
        Unary::Truth => f64::from(x != 0.0),
        Unary::Call(function) => call(function, x),
    }
}

fn call(function: Function, x: f64) -> f64 {
    match function {
        Function::Sin => sin_cos(x.to_radians()).0,
        Function::Cos => sin_cos(x.to_radians()).1,
        Function::Tan => {
            let (sin, cos) = sin_cos(x.to_radians());
            sin / cos
        }
        Function::Asin => math::asin(x).to_degrees(),
        Function::Acos => math::acos(x).to_degrees(),
        Function::Atan => math::atan(x).to_degrees(),
        Function::Sqrt => x.sqrt(),
        Function::Exp => math::exp(x),
        Function::Log => math::ln(x),
        Function::Abs => x.abs(),
        Function::Sign => f64::from(i8::from(x > 0.0) - i8::from(x < 0.0)),
        Function::Floor => x.floor(),
        Function::Ceil => x.ceil(),
        Function::Round => x.round(),
        Function::Trunc => x.trunc(),
        Function::Deg => x.to_degrees(),
        Function::Rad => x.to_radians(),
        // Functions of two numbers and draws have operations of their own.
        Function::Atan2 | Function::Min | Function::Max | Function::Rand | Function::Nrand => f64::NAN,
    }
}

fn binary(op: Binary, a: f64, b: f64) -> f64 {
    match op {
        Binary::Call(Function::Min) => a.min(b),
        Binary::Call(Function::Max) => a.max(b),
        Binary::Call(_) => atan2(a, b).to_degrees(),
        Binary::Op(op) => match op {
            BinaryOp::Lt => f64::from(a < b),
            BinaryOp::Le => f64::from(a <= b),
            BinaryOp::Gt => f64::from(a > b),
            BinaryOp::Ge => f64::from(a >= b),
            BinaryOp::Eq => f64::from(a == b),
            BinaryOp::Ne => f64::from(a != b),
            BinaryOp::Add => a + b,
            BinaryOp::Sub => a - b,
            BinaryOp::Mul => a * b,
            BinaryOp::Div => a / b,
            BinaryOp::Rem => a % b,
            BinaryOp::Pow => power(a, b),
            // Compiled to jumps.
            BinaryOp::And | BinaryOp::Or => f64::NAN,
        },
    }
}

/// Whole powers by multiplication alone, which gives the same bits everywhere.
fn power(a: f64, b: f64) -> f64 {
    if b.fract() != 0.0 || b.abs() > 64.0 {
        return math::pow(a, b);
    }
    let (mut result, mut square, mut rest) = (1.0, a, b.abs() as u32);
    while rest > 0 {
        if rest % 2 == 1 {
            result *= square;
        }
        square *= square;
        rest /= 2;
    }
    if b < 0.0 { 1.0 / result } else { result }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_powers_agree_with_the_platform() {
        for (a, b) in [(2.0, 10.0), (0.7, 6.0), (-1.5, 3.0), (3.0, -2.0), (0.0, 0.0), (1.5, 0.5)] {
            assert!((power(a, b) - f64::powf(a, b)).abs() < 1e-9, "{a}^{b}");
        }
        assert!(power(0.0, -1.0).is_infinite());
    }
}
