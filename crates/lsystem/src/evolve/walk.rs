//! Walks over all expressions and all lists of items of a grammar.

use crate::syntax::{Expr, ExprKind, Grammar, Item, SettingKey, Span, UnaryOp, Values};

/// Where an expression stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A setting of the header.
    Setting(SettingKey),
    /// An angle of the turtle.
    Angle,
    /// The number of leaves of a piece.
    Leaves,
    /// How often something is repeated.
    Count,
    /// One of the values of a repetition.
    Listed,
    /// A probability.
    Weight,
    /// Anything else: lengths, widths, factors.
    Plain,
}

/// An expression that stands nowhere.
pub(super) const fn expr(kind: ExprKind) -> Expr {
    Expr { kind, span: Span { start: 0, end: 0 } }
}

/// The literal `value`.
pub(super) fn number(value: f64) -> Expr {
    if value < 0.0 {
        expr(ExprKind::Unary(UnaryOp::Neg, Box::new(expr(ExprKind::Number(-value)))))
    } else {
        expr(ExprKind::Number(value))
    }
}

/// The value of a literal, with its sign.
pub(super) fn literal(expr: &Expr) -> Option<f64> {
    match &expr.kind {
        ExprKind::Number(value) => Some(*value),
        ExprKind::Unary(UnaryOp::Neg, inner) => match inner.kind {
            ExprKind::Number(value) => Some(-value),
            _ => None,
        },
        _ => None,
    }
}

type VisitExpr<'a> = &'a mut dyn FnMut(&mut Expr, Role);

/// Calls `visit` for every expression of `grammar`, outer ones first; the parts of literals are none.
pub(super) fn exprs(grammar: &mut Grammar, visit: VisitExpr<'_>) {
    for setting in &mut grammar.settings {
        let role = Role::Setting(setting.key);
        setting.values.iter_mut().for_each(|value| one(value, role, visit));
    }
    grammar.consts.iter_mut().for_each(|constant| one(&mut constant.value, Role::Plain, visit));
    of_items(&mut grammar.axiom, visit);
    for rule in &mut grammar.rules {
        rule.condition.iter_mut().for_each(|condition| one(condition, Role::Plain, visit));
        for successor in &mut rule.successors {
            successor.weight.iter_mut().for_each(|weight| one(weight, Role::Weight, visit));
            of_items(&mut successor.items, visit);
        }
    }
}

fn one(expr: &mut Expr, role: Role, visit: VisitExpr<'_>) {
    visit(expr, role);
    if literal(expr).is_some() {
        return;
    }
    match &mut expr.kind {
        ExprKind::Number(_) | ExprKind::Name(_) => {}
        ExprKind::Unary(_, inner) => one(inner, role, visit),
        ExprKind::Binary(_, parts) => parts.iter_mut().for_each(|part| one(part, role, visit)),
        ExprKind::Choose(parts) => parts.iter_mut().for_each(|part| one(part, role, visit)),
        ExprKind::Call(_, args) => args.iter_mut().for_each(|arg| one(arg, role, visit)),
    }
}

fn of_items(items: &mut [Item], visit: VisitExpr<'_>) {
    for item in items {
        match item {
            Item::Module { name, args } => {
                for (place, arg) in args.iter_mut().enumerate() {
                    one(arg, role_of(&name.text, place), visit);
                }
            }
            Item::Branch(inside) | Item::Polygon(inside) => of_items(inside, visit),
            Item::Let { value, .. } => one(value, Role::Plain, visit),
            Item::For { values, body, .. } => {
                match values {
                    Values::Range(from, to) => [from, to].map(|end| one(end, Role::Count, visit)),
                    Values::List(list) => {
                        list.iter_mut().for_each(|value| one(value, Role::Listed, visit));
                        [(); 2]
                    }
                };
                of_items(body, visit);
            }
        }
    }
}

/// Symbols that turn the turtle, all with an angle.
pub(super) const TURNS: [&str; 6] = ["+", "-", "&", "^", "/", "\\"];

fn role_of(symbol: &str, place: usize) -> Role {
    match (symbol, place) {
        ("F", 1) => Role::Leaves,
        ("F", 2 | 3) | ("L", _) => Role::Angle,
        _ if TURNS.contains(&symbol) => Role::Angle,
        _ => Role::Plain,
    }
}

/// Calls `visit` for every list of items of `grammar`, outer ones first, with the names that it may use.
pub(super) fn lists(grammar: &mut Grammar, visit: &mut dyn FnMut(&mut Vec<Item>, &[String])) {
    // A factor on all lengths is not itself a length.
    let scales = grammar.settings.iter().filter(|setting| setting.key == SettingKey::Scale);
    let scales: Vec<String> = scales.map(|setting| setting.values[0].to_string()).collect();
    let params = grammar.params.iter().map(|param| param.name.text.clone());
    let params = params.filter(|name| !scales.contains(name));
    let mut scope: Vec<String> =
        params.chain(grammar.consts.iter().map(|constant| constant.name.text.clone())).collect();
    let globals = scope.len();
    list(&mut grammar.axiom, &mut scope, visit);
    for rule in &mut grammar.rules {
        let names = rule.pred.params.iter().map(|name| name.text.clone());
        scope.extend(names);
        for successor in &mut rule.successors {
            list(&mut successor.items, &mut scope, visit);
        }
        scope.truncate(globals);
    }
}

fn list(items: &mut Vec<Item>, scope: &mut Vec<String>, visit: &mut dyn FnMut(&mut Vec<Item>, &[String])) {
    visit(items, scope);
    let known = scope.len();
    for item in items {
        match item {
            Item::Module { .. } => {}
            Item::Branch(inside) | Item::Polygon(inside) => list(inside, scope, visit),
            Item::Let { name, .. } => scope.push(name.text.clone()),
            Item::For { name, body, .. } => {
                scope.push(name.text.clone());
                list(body, scope, visit);
                scope.pop();
            }
        }
    }
    scope.truncate(known);
}
