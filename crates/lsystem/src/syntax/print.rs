//! The normal form: one text per syntax tree, which parses to the same tree.

use super::expr::{ATOM, CHOOSE, POWER, UNARY};
use super::{
    BinaryOp, Context, Expr, ExprKind, Grammar, Item, ParamDecl, ParamUnit, Predecessor, Rule, Shape,
    UnaryOp, Values,
};
use std::fmt::{self, Display, Formatter, Write as _};

impl Display for Expr {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.kind {
            ExprKind::Number(number) => write!(f, "{number}"),
            ExprKind::Name(name) => f.write_str(name),
            ExprKind::Unary(op, operand) => {
                f.write_char(if *op == UnaryOp::Neg { '-' } else { '!' })?;
                bracketed(f, operand, operand.kind.precedence() < UNARY)
            }
            ExprKind::Binary(op, operands) => {
                let [a, b] = &**operands;
                let own = op.precedence();
                let (left, right) = (a.kind.precedence(), b.kind.precedence());
                // Powers group to the right, comparisons not at all, the rest to the left.
                let (left_open, right_open) = match own {
                    POWER => (left < ATOM, right < UNARY),
                    4 => (left <= own, right <= own),
                    _ => (left < own, right <= own),
                };
                bracketed(f, a, left_open)?;
                match op {
                    BinaryOp::Mul | BinaryOp::Div | BinaryOp::Pow => f.write_str(op.sign())?,
                    _ => write!(f, " {} ", op.sign())?,
                }
                bracketed(f, b, right_open)
            }
            ExprKind::Choose(parts) => {
                let [condition, yes, no] = &**parts;
                bracketed(f, condition, condition.kind.precedence() <= CHOOSE)?;
                write!(f, " ? {yes} : {no}")
            }
            ExprKind::Call(name, args) => {
                f.write_str(name)?;
                list(f, args)
            }
        }
    }
}

fn bracketed(f: &mut Formatter<'_>, expr: &Expr, yes: bool) -> fmt::Result {
    if yes { write!(f, "({expr})") } else { write!(f, "{expr}") }
}

fn list(f: &mut impl fmt::Write, items: &[impl Display]) -> fmt::Result {
    for (i, item) in items.iter().enumerate() {
        write!(f, "{}{item}", if i == 0 { "(" } else { ", " })?;
    }
    f.write_str(if items.is_empty() { "()" } else { ")" })
}

/// Writes items, with spaces where two would run together and beside those with arguments.
struct Writer<'a, 'b> {
    f: &'a mut Formatter<'b>,
    /// The letters before this place, without a space between them; `None` if a space is wanted.
    letters: Option<String>,
    /// Whether letters may stand side by side.
    dense: bool,
}

impl Writer<'_, '_> {
    fn space(&mut self) -> fmt::Result {
        if self.letters.as_ref().is_none_or(|l| !l.is_empty()) { self.f.write_char(' ') } else { Ok(()) }
    }

    fn sign(&mut self, sign: char) -> fmt::Result {
        if self.letters.is_none() {
            self.f.write_char(' ')?;
        }
        self.letters = Some(sign.to_string());
        self.f.write_char(sign)
    }

    fn items(&mut self, items: &[Item]) -> fmt::Result {
        for item in items {
            match item {
                Item::Module { name, args } => self.module(&name.text, args)?,
                Item::Branch(inside) => self.group('[', inside, ']')?,
                Item::Polygon(inside) => self.group('{', inside, '}')?,
                Item::Let { name, value } => {
                    self.space()?;
                    write!(self.f, "let {} = {value};", name.text)?;
                    self.letters = None;
                }
                Item::For { name, values, body } => {
                    self.space()?;
                    write!(self.f, "for {} in ", name.text)?;
                    match values {
                        Values::Range(from, to) => {
                            bracketed(self.f, from, from.kind.precedence() < ATOM)?;
                            self.f.write_str("..")?;
                            bracketed(self.f, to, to.kind.precedence() < ATOM)?;
                        }
                        Values::List(values) => {
                            for (i, value) in values.iter().enumerate() {
                                write!(self.f, "{}{value}", if i == 0 { "[" } else { ", " })?;
                            }
                            self.f.write_char(']')?;
                        }
                    }
                    self.f.write_str(" {")?;
                    self.letters = None;
                    self.items(body)?;
                    self.f.write_str(" }")?;
                    self.letters = None;
                }
            }
        }
        Ok(())
    }

    fn group(&mut self, open: char, inside: &[Item], close: char) -> fmt::Result {
        self.sign(open)?;
        self.items(inside)?;
        self.sign(close)
    }

    fn module(&mut self, name: &str, args: &[Expr]) -> fmt::Result {
        let is_letter = name.starts_with(|c: char| c.is_ascii_alphabetic());
        let crowded = match &self.letters {
            None => true,
            Some(before) if is_letter && before.ends_with(|c: char| c.is_ascii_alphanumeric()) => {
                let run = format!("{before}{name}");
                !self.dense || run.ends_with("for") || run.ends_with("let")
            }
            Some(_) => false,
        };
        let touches = self.letters.as_ref().is_some_and(|l| !l.is_empty());
        if crowded || !args.is_empty() && touches {
            self.f.write_char(' ')?;
            self.letters = Some(String::new());
        }
        self.f.write_str(name)?;
        if args.is_empty() {
            self.letters.get_or_insert_default().push_str(name);
            return Ok(());
        }
        list(self.f, args)?;
        self.letters = None;
        Ok(())
    }
}

fn items(f: &mut Formatter<'_>, items: &[Item], dense: bool) -> fmt::Result {
    Writer { f, letters: None, dense }.items(items)
}

impl Display for Predecessor {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.name.text)?;
        let names: Vec<&str> = self.params.iter().map(|p| p.text.as_str()).collect();
        if names.is_empty() { Ok(()) } else { list(f, &names) }
    }
}

impl Display for Context {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Module(module) => write!(f, "{module}"),
            Self::Branch(inside) => {
                f.write_char('[')?;
                for (i, part) in inside.iter().enumerate() {
                    write!(f, "{}{part}", if i == 0 { "" } else { " " })?;
                }
                f.write_char(']')
            }
        }
    }
}

impl Rule {
    /// The rule up to its condition, as errors name it.
    #[must_use]
    pub fn head(&self) -> String {
        let mut text = String::new();
        for module in &self.left {
            let _ = write!(text, "{module} ");
        }
        if !self.left.is_empty() {
            text.push_str("< ");
        }
        let _ = write!(text, "{}", self.pred);
        if !self.right.is_empty() {
            text.push_str(" >");
        }
        for part in &self.right {
            let _ = write!(text, " {part}");
        }
        text
    }
}

impl Display for ParamDecl {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let (low, high) = self.range;
        write!(f, "param {} = {} in {low}..{high}", self.name.text, self.default)?;
        if let Some((low, high)) = self.search {
            write!(f, " search {low}..{high}")?;
        }
        if self.unit != ParamUnit::Ratio {
            write!(f, " {}", self.unit.name())?;
        }
        if !self.doc.is_empty() {
            write!(f, " \"{}\"", self.doc)?;
        }
        Ok(())
    }
}

impl Display for Grammar {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "dialect: {}", self.dialect.name())?;
        for setting in &self.settings {
            write!(f, "{}: ", setting.key.name())?;
            if setting.key.shape() == Shape::Vector {
                list(f, &setting.values)?;
            } else if let Some(value) = setting.values.first() {
                write!(f, "{value}")?;
            }
            writeln!(f)?;
        }
        for module in &self.modules {
            write!(f, "module {}", module.name.text)?;
            if let Some(alias) = &module.alias {
                write!(f, " = {}", alias.text)?;
            }
            writeln!(f)?;
        }
        if !self.ignore.is_empty() {
            write!(f, "ignore:")?;
            for name in &self.ignore {
                write!(f, " {}", name.text)?;
            }
            writeln!(f)?;
        }
        for param in &self.params {
            writeln!(f, "{param}")?;
        }
        for constant in &self.consts {
            writeln!(f, "const {} = {}", constant.name.text, constant.value)?;
        }
        let dense = self.modules.iter().all(|m| m.name.text.len() == 1);
        f.write_str("axiom:")?;
        items(f, &self.axiom, dense)?;
        writeln!(f)?;
        for rule in &self.rules {
            f.write_str(&rule.head())?;
            if let Some(condition) = &rule.condition {
                write!(f, " : {condition}")?;
            }
            for successor in &rule.successors {
                match &successor.weight {
                    None => f.write_str(" ->")?,
                    Some(weight) => write!(f, "\n  -({weight})->")?,
                }
                items(f, &successor.items, dense)?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}
