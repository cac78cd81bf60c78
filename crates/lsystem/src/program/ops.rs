//! Expressions as lists of operations for a stack.

use super::Program;
use crate::syntax::{BinaryOp, Expr, ExprKind, Function, Span, UnaryOp};

/// A slice of [`Program::ops`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Code {
    pub(crate) start: u32,
    pub(crate) end: u32,
}

/// An operation on one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unary {
    Neg,
    Not,
    /// 1 for anything but 0.
    Truth,
    Call(Function),
}

/// An operation on two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Binary {
    Op(BinaryOp),
    Call(Function),
}

/// An operation.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Op {
    Const(f64),
    Global(u16),
    Local(u16),
    Unary(Unary),
    Binary(Binary),
    /// Uniform between the two numbers on the stack.
    Rand(u32),
    /// Normal with the mean and the standard deviation on the stack.
    Nrand(u32),
    Jump(u32),
    /// Takes a number; jumps if it is 0.
    JumpIfZero(u32),
}

/// A placeholder for names without meaning. Programs with errors are never run.
const UNKNOWN: Op = Op::Local(0);

/// Where names are looked up.
pub(super) trait Names {
    fn find(&self, name: &str) -> Option<Op>;
    /// A number for the next draw of this block.
    fn draw(&mut self) -> u32;
    fn complain(&mut self, span: Span, expr: &ExprKind, found: usize);
}

impl Program {
    /// Appends the operations of `expr`.
    pub(super) fn expr(&mut self, expr: &Expr, names: &mut dyn Names) -> Code {
        let start = self.ops.len() as u32;
        let depth = self.push_expr(expr, names);
        self.stack = self.stack.max(depth);
        Code { start, end: self.ops.len() as u32 }
    }

    fn op(&mut self, op: Op, span: Span) {
        self.ops.push(op);
        self.spans.push(span);
    }

    /// Returns the depth of the stack that is needed.
    fn push_expr(&mut self, expr: &Expr, names: &mut dyn Names) -> usize {
        let span = expr.span;
        match &expr.kind {
            ExprKind::Number(number) => self.op(Op::Const(*number), span),
            ExprKind::Name(name) => {
                if let Some(op) = names.find(name) {
                    self.op(op, span);
                } else {
                    names.complain(span, &expr.kind, 0);
                    self.op(UNKNOWN, span);
                }
            }
            ExprKind::Unary(op, operand) => {
                let depth = self.push_expr(operand, names);
                let op = if *op == UnaryOp::Neg { Unary::Neg } else { Unary::Not };
                self.op(Op::Unary(op), span);
                return depth;
            }
            ExprKind::Binary(op @ (BinaryOp::And | BinaryOp::Or), operands) => {
                return self.logic(*op == BinaryOp::And, operands, span, names);
            }
            ExprKind::Binary(op, operands) => {
                let left = self.push_expr(&operands[0], names);
                let right = self.push_expr(&operands[1], names);
                self.op(Op::Binary(Binary::Op(*op)), span);
                return left.max(right + 1);
            }
            ExprKind::Choose(parts) => {
                let [condition, yes, no] = &**parts;
                let depth = self.push_expr(condition, names);
                let skip_yes = self.hole(span);
                let yes = self.push_expr(yes, names);
                let skip_no = self.hole(span);
                self.ops[skip_yes] = Op::JumpIfZero(self.ops.len() as u32);
                let no = self.push_expr(no, names);
                self.ops[skip_no] = Op::Jump(self.ops.len() as u32);
                return depth.max(yes).max(no);
            }
            ExprKind::Call(name, args) => {
                let known = Function::from_name(name).filter(|f| {
                    let (min, max) = f.arity();
                    (min..=max).contains(&args.len())
                });
                let Some(function) = known else {
                    names.complain(span, &expr.kind, args.len());
                    self.op(UNKNOWN, span);
                    return 1;
                };
                return self.call(function, args, span, names);
            }
        }
        1
    }

    fn hole(&mut self, span: Span) -> usize {
        self.op(Op::Jump(0), span);
        self.ops.len() - 1
    }

    /// `a && b` is `a ? b != 0 : 0`, and `a || b` is `a ? 1 : b != 0`.
    fn logic(&mut self, and: bool, operands: &[Expr; 2], span: Span, names: &mut dyn Names) -> usize {
        let left = self.push_expr(&operands[0], names);
        if !and {
            self.op(Op::Unary(Unary::Not), span);
        }
        let short = self.hole(span);
        let right = self.push_expr(&operands[1], names);
        self.op(Op::Unary(Unary::Truth), span);
        let done = self.hole(span);
        self.ops[short] = Op::JumpIfZero(self.ops.len() as u32);
        self.op(Op::Const(if and { 0.0 } else { 1.0 }), span);
        self.ops[done] = Op::Jump(self.ops.len() as u32);
        left.max(right)
    }

    fn call(&mut self, function: Function, args: &[Expr], span: Span, names: &mut dyn Names) -> usize {
        let mut depth = 2;
        // rand() and rand(b) are rand(0, 1) and rand(0, b).
        if function == Function::Rand && args.len() < 2 {
            self.op(Op::Const(0.0), span);
        }
        for (i, arg) in args.iter().enumerate() {
            depth =
                depth.max(self.push_expr(arg, names) + i.min(1) + usize::from(function == Function::Rand));
            if matches!(function, Function::Min | Function::Max) && i > 0 {
                self.op(Op::Binary(Binary::Call(function)), span);
            }
        }
        match function {
            Function::Min | Function::Max => {}
            Function::Rand => {
                if args.is_empty() {
                    self.op(Op::Const(1.0), span);
                }
                let site = names.draw();
                self.op(Op::Rand(site), span);
            }
            Function::Nrand => {
                let site = names.draw();
                self.op(Op::Nrand(site), span);
            }
            Function::Atan2 => self.op(Op::Binary(Binary::Call(function)), span),
            _ => self.op(Op::Unary(Unary::Call(function)), span),
        }
        depth
    }

    /// Whether `code` reads nothing but numbers.
    pub(super) fn is_constant(&self, code: Code) -> bool {
        let ops = &self.ops[code.start as usize..code.end as usize];
        !ops.iter().any(|op| matches!(op, Op::Global(_) | Op::Local(_) | Op::Rand(_) | Op::Nrand(_)))
    }

    /// Whether `code` draws.
    pub(super) fn draws(&self, code: Code) -> bool {
        let ops = &self.ops[code.start as usize..code.end as usize];
        ops.iter().any(|op| matches!(op, Op::Rand(_) | Op::Nrand(_)))
    }
}
