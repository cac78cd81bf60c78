//! Expressions, by precedence climbing.

use super::cursor::{Cursor, Parsed};
use crate::diagnostic::Fault;
use crate::syntax::{BinaryOp, Expr, ExprKind, Span, UnaryOp};

/// Most numbers, names and operators of one expression: bounds the depth of its tree.
const MAX_NODES: usize = 1000;
const CHOOSE: u8 = 1;

impl Cursor<'_> {
    /// Reads an expression.
    pub(super) fn expr(&mut self) -> Parsed<Expr> {
        self.nodes = 0;
        self.choose()
    }

    fn choose(&mut self) -> Parsed<Expr> {
        self.descend()?;
        let condition = self.binary(CHOOSE + 1)?;
        let expr = if self.take('?') {
            let yes = self.choose()?;
            self.expect(':', "`:` and the value otherwise")?;
            let no = self.choose()?;
            let span = condition.span.to(no.span);
            self.node(ExprKind::Choose(Box::new([condition, yes, no])), span)?
        } else {
            condition
        };
        self.depth -= 1;
        Ok(expr)
    }

    fn binary(&mut self, least: u8) -> Parsed<Expr> {
        let mut left = self.unary()?;
        while let Some(op) = self.operator().filter(|op| op.precedence() >= least) {
            let start = self.at;
            op.sign().chars().for_each(|_| self.bump());
            let right = self.binary(op.precedence() + 1)?;
            let is_comparison = |op: BinaryOp| op.precedence() == BinaryOp::Lt.precedence();
            if is_comparison(op) && self.operator().is_some_and(is_comparison) {
                let found = "a second comparison".to_owned();
                let expected = "one comparison, or two joined by `&&`";
                return Err(self.fault(self.since(start), Fault::Expected { expected, found }));
            }
            let span = left.span.to(right.span);
            left = self.node(ExprKind::Binary(op, Box::new([left, right])), span)?;
        }
        Ok(left)
    }

    /// The operator that stands here, unless it is an arrow.
    fn operator(&mut self) -> Option<BinaryOp> {
        self.skip();
        if self.arrow() > 0 || self.weighted_arrow() {
            return None;
        }
        let mut signs = self.rest().chars();
        let first = self.peek()?;
        signs.next();
        let second = signs.next();
        BinaryOp::ALL.into_iter().find(|op| {
            let mut sign = op.sign().chars();
            sign.next() == Some(first) && sign.next().is_none_or(|c| second == Some(c))
        })
    }

    fn unary(&mut self) -> Parsed<Expr> {
        self.skip();
        let start = self.at;
        let op = match self.peek() {
            Some('-') => UnaryOp::Neg,
            Some('!') => UnaryOp::Not,
            _ => {
                let base = self.atom()?;
                if self.operator() != Some(BinaryOp::Pow) {
                    return Ok(base);
                }
                self.bump();
                self.descend()?;
                let exponent = self.unary()?;
                self.depth -= 1;
                let span = base.span.to(exponent.span);
                return self.node(ExprKind::Binary(BinaryOp::Pow, Box::new([base, exponent])), span);
            }
        };
        self.bump();
        self.descend()?;
        let operand = self.unary()?;
        self.depth -= 1;
        self.node(ExprKind::Unary(op, Box::new(operand)), self.since(start))
    }

    /// Reads a number, a name, a call, or an expression in parentheses.
    pub(super) fn expr_atom(&mut self) -> Parsed<Expr> {
        self.nodes = 0;
        self.atom()
    }

    fn atom(&mut self) -> Parsed<Expr> {
        self.skip();
        let start = self.at;
        if let Some(number) = self.number() {
            if !number.is_finite() {
                let found = "a number beyond all bounds".to_owned();
                let expected = "a number";
                return Err(self.fault(self.since(start), Fault::Expected { expected, found }));
            }
            return self.node(ExprKind::Number(number), self.since(start));
        }
        let word = self.word();
        if !word.is_empty() {
            self.at += word.len();
            if self.take('(') {
                let args = self.list(')')?;
                return self.node(ExprKind::Call(word.to_owned(), args), self.since(start));
            }
            let span = Span { start, end: start + word.len() };
            return self.node(ExprKind::Name(word.to_owned()), span);
        }
        if self.take('(') {
            let inside = self.choose()?;
            self.close('(', ')', start)?;
            return Ok(inside);
        }
        Err(self.unexpected("a number, a name or `(`"))
    }

    /// Reads expressions with commas between, up to `close`.
    pub(super) fn list(&mut self, close: char) -> Parsed<Vec<Expr>> {
        let start = self.at - 1;
        let mut items = Vec::new();
        if self.take(close) {
            return Ok(items);
        }
        loop {
            items.push(self.choose()?);
            if !self.take(',') {
                let open = if close == ')' { '(' } else { '[' };
                self.close(open, close, start)?;
                return Ok(items);
            }
        }
    }

    fn close(&mut self, open: char, close: char, start: usize) -> Parsed<()> {
        if self.take(close) {
            return Ok(());
        }
        if self.rest().is_empty() {
            return Err(self.fault(Span { start, end: start + 1 }, Fault::Unclosed { open, close }));
        }
        Err(self.unexpected(if close == ')' { "`)`, `,` or an operator" } else { "`]`, `,` or an operator" }))
    }

    fn node(&mut self, kind: ExprKind, span: Span) -> Parsed<Expr> {
        self.nodes += 1;
        if self.nodes > MAX_NODES {
            return Err(
                self.fault(span, Fault::TooMany { what: "parts of one expression", limit: MAX_NODES })
            );
        }
        Ok(Expr { kind, span })
    }
}
