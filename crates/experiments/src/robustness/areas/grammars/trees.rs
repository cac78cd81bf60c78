//! Syntax trees whose parts are exchanged, repeated, nested or left out.

use pleach_fit::Stream;
use pleach_lsystem::Grammar;
use pleach_lsystem::syntax::{
    BinaryOp, Context, Dialect, Expr, ExprKind, Function, Item, Name, Predecessor, Rule, Setting, SettingKey,
    Shape, Span, Successor, UnaryOp, Values,
};

/// Most edits of a tree.
const EDITS: usize = 6;
/// Most items that an edit leaves in one place.
const MAX_ITEMS: usize = 2_000;
/// Numbers at and beyond the ends of sensible ranges.
const NUMBERS: [f64; 16] = [
    0.0,
    1.0,
    2.0,
    0.5,
    1e-9,
    1e-300,
    5e-324,
    1e9,
    1e300,
    f64::MAX,
    10_000.0,
    10_001.0,
    90.0,
    360.0,
    20_000_000.0,
    65_536.0,
];
const SYMBOLS: [&str; 16] = ["F", "A", "B", "L", "f", "+", "-", "&", "/", "!", "$", "%", "|", "G", "X", "."];

/// A copy of one of `known` with parts of the others in it.
pub(super) fn mutated(known: &[Grammar], draws: &mut Stream) -> Grammar {
    let mut grammar = known[draws.below(known.len())].clone();
    let edits = if draws.chance(0.5) { 1 } else { 1 + draws.below(EDITS) };
    for _ in 0..edits {
        let other = &known[draws.below(known.len())];
        edit(&mut grammar, other, draws);
    }
    grammar
}

fn name(text: &str) -> Name {
    Name { text: text.to_owned(), span: Span::default() }
}

fn edit(grammar: &mut Grammar, other: &Grammar, draws: &mut Stream) {
    match draws.below(16) {
        0 => grammar.dialect = Dialect::ALL[draws.below(2)],
        1 => setting(grammar, draws),
        2 => {
            // A rule of another grammar, or the same again, or one less.
            match draws.below(3) {
                0 => {
                    if let Some(rule) = pick(&other.rules, draws) {
                        let at = draws.below(grammar.rules.len() + 1);
                        grammar.rules.insert(at, rule.clone());
                    }
                }
                1 => {
                    if let Some(rule) = pick(&grammar.rules, draws).cloned() {
                        grammar.rules.push(rule);
                    }
                }
                _ if grammar.rules.is_empty() => {}
                _ => drop(grammar.rules.remove(draws.below(grammar.rules.len()))),
            }
        }
        3 => {
            grammar.axiom = pick(&other.rules, draws).map_or_else(Vec::new, |r| r.successors[0].items.clone())
        }
        4 => {
            if let Some(rule) = pick_mut(&mut grammar.rules, draws) {
                head(rule, draws);
            }
        }
        5 => {
            if let Some(rule) = pick_mut(&mut grammar.rules, draws) {
                weights(rule, draws);
            }
        }
        6 => {
            if let Some(constant) = pick_mut(&mut grammar.consts, draws) {
                expression(&mut constant.value, draws);
            }
        }
        7 => {
            if let Some(param) = pick_mut(&mut grammar.params, draws) {
                param.default = NUMBERS[draws.below(NUMBERS.len())];
                if draws.chance(0.7) {
                    param.range = (param.default - 1.0, param.default + 1.0);
                }
            }
        }
        _ => {
            let source: Vec<Item> =
                pick(&other.rules, draws).map_or_else(Vec::new, |r| r.successors[0].items.clone());
            let at = draws.below(grammar.rules.len() + 1);
            match grammar.rules.get_mut(at) {
                None => items(&mut grammar.axiom, &source, draws),
                Some(rule) => {
                    let at = draws.below(rule.successors.len());
                    items(&mut rule.successors[at].items, &source, draws);
                }
            }
        }
    }
}

fn pick<'a, T>(list: &'a [T], draws: &mut Stream) -> Option<&'a T> {
    if list.is_empty() { None } else { Some(&list[draws.below(list.len())]) }
}

fn pick_mut<'a, T>(list: &'a mut [T], draws: &mut Stream) -> Option<&'a mut T> {
    if list.is_empty() { None } else { Some(&mut list[draws.below(list.len())]) }
}

fn setting(grammar: &mut Grammar, draws: &mut Stream) {
    let key = SettingKey::ALL[draws.below(SettingKey::ALL.len())];
    grammar.settings.retain(|setting| setting.key != key);
    if draws.chance(0.8) {
        let count = if key.shape() == Shape::Vector { 3 } else { 1 };
        let values = (0..count).map(|_| any_expression(2, draws)).collect();
        grammar.settings.push(Setting { key, values, span: Span::default() });
        grammar.settings.sort_by_key(|setting| setting.key);
    }
}

/// Context, condition or name of a rule.
fn head(rule: &mut Rule, draws: &mut Stream) {
    let module = |draws: &mut Stream| {
        let params = (0..draws.below(3)).map(|i| name(["x", "y", "z"][i])).collect();
        Predecessor { name: name(SYMBOLS[draws.below(5)]), params }
    };
    match draws.below(6) {
        0 => rule.left = (0..draws.below(3)).map(|_| module(draws)).collect(),
        1 => {
            rule.right = (0..draws.below(3))
                .map(|_| {
                    let inside = Context::Module(module(draws));
                    if draws.chance(0.4) { Context::Branch(vec![inside]) } else { inside }
                })
                .collect();
        }
        2 => rule.condition = None,
        3 => rule.condition = Some(any_expression(3, draws)),
        4 => rule.pred.name = name(SYMBOLS[draws.below(SYMBOLS.len())]),
        _ => match &mut rule.condition {
            Some(condition) => expression(condition, draws),
            None => rule.pred.params.truncate(draws.below(3)),
        },
    }
}

fn weights(rule: &mut Rule, draws: &mut Stream) {
    if let Some(successor) = pick(&rule.successors, draws).cloned() {
        rule.successors.push(successor);
    }
    let count = rule.successors.len() as f64;
    let is_right = draws.chance(0.7);
    for Successor { weight, .. } in &mut rule.successors {
        *weight = Some(if is_right { number(1.0 / count) } else { any_expression(2, draws) });
    }
}

/// Changes a list of items, or one somewhere within it.
fn items(list: &mut Vec<Item>, source: &[Item], draws: &mut Stream) {
    if !list.is_empty() && draws.chance(0.6) {
        let at = draws.below(list.len());
        match &mut list[at] {
            Item::Branch(inside) | Item::Polygon(inside) => return items(inside, source, draws),
            Item::For { body, .. } if draws.chance(0.6) => return items(body, source, draws),
            Item::For { values: Values::Range(from, to), .. } => {
                return expression(if draws.chance(0.3) { from } else { to }, draws);
            }
            Item::For { values: Values::List(values), .. } => {
                if let Some(value) = pick_mut(values, draws) {
                    expression(value, draws);
                }
                return;
            }
            Item::Let { value, .. } => return expression(value, draws),
            Item::Module { args, .. } if !args.is_empty() => {
                let at = draws.below(args.len());
                return expression(&mut args[at], draws);
            }
            Item::Module { .. } => {}
        }
    }
    let at = draws.below(list.len() + 1);
    match draws.below(9) {
        0 if !list.is_empty() => drop(list.remove(at.min(list.len() - 1))),
        1 if !list.is_empty() => {
            let other = draws.below(list.len());
            let last = list.len() - 1;
            list.swap(at.min(last), other);
        }
        2 => list.splice(at..at, source.iter().cloned()).for_each(drop),
        3 if list.len() < MAX_ITEMS => {
            let copy = list.clone();
            list.extend(copy);
        }
        4 => *list = vec![Item::Branch(std::mem::take(list))],
        5 => {
            let body = std::mem::take(list);
            let values = if draws.chance(0.7) {
                Values::Range(number(0.0), any_expression(1, draws))
            } else {
                Values::List((0..1 + draws.below(3)).map(|_| any_expression(1, draws)).collect())
            };
            *list = vec![Item::For { name: name("i"), values, body }];
        }
        6 => {
            // Layer upon layer.
            for _ in 0..1 << draws.below(8) {
                let inside = std::mem::take(list);
                *list = vec![if draws.chance(0.9) { Item::Branch(inside) } else { Item::Polygon(inside) }];
            }
        }
        7 => list.insert(at, Item::Let { name: name("a"), value: any_expression(3, draws) }),
        _ => {
            let args = (0..draws.below(4)).map(|_| any_expression(2, draws)).collect();
            list.insert(at, Item::Module { name: name(SYMBOLS[draws.below(SYMBOLS.len())]), args });
        }
    }
}

const fn number(value: f64) -> Expr {
    Expr { kind: ExprKind::Number(value), span: Span { start: 0, end: 0 } }
}

/// Changes an expression, or one somewhere within it.
fn expression(expr: &mut Expr, draws: &mut Stream) {
    if draws.chance(0.6) {
        match &mut expr.kind {
            ExprKind::Unary(_, inside) => return expression(inside, draws),
            ExprKind::Binary(op, parts) => {
                if draws.chance(0.3) {
                    *op = BinaryOp::ALL[draws.below(BinaryOp::ALL.len())];
                    return;
                }
                let at = draws.below(parts.len());
                return expression(&mut parts[at], draws);
            }
            ExprKind::Choose(parts) => {
                let at = draws.below(parts.len());
                return expression(&mut parts[at], draws);
            }
            ExprKind::Call(_, args) if !args.is_empty() => {
                let at = draws.below(args.len());
                return expression(&mut args[at], draws);
            }
            _ => {}
        }
    }
    let old = std::mem::replace(expr, number(0.0));
    let kind = match draws.below(5) {
        0 => ExprKind::Unary(if draws.chance(0.8) { UnaryOp::Neg } else { UnaryOp::Not }, Box::new(old)),
        1 => {
            let op = BinaryOp::ALL[draws.below(BinaryOp::ALL.len())];
            ExprKind::Binary(op, Box::new([old, any_expression(1, draws)]))
        }
        2 => ExprKind::Call(any_function(draws), vec![old]),
        _ => any_expression(2, draws).kind,
    };
    expr.kind = kind;
}

fn any_function(draws: &mut Stream) -> String {
    Function::ALL[draws.below(Function::ALL.len())].name().to_owned()
}

/// An expression of at most `depth` layers.
fn any_expression(depth: usize, draws: &mut Stream) -> Expr {
    let kind = match if depth == 0 { draws.below(2) } else { draws.below(7) } {
        0 => ExprKind::Number(NUMBERS[draws.below(NUMBERS.len())]),
        1 => ExprKind::Name(["x", "l", "w", "i", "t", "size"][draws.below(6)].to_owned()),
        2 => ExprKind::Unary(UnaryOp::Neg, Box::new(any_expression(depth - 1, draws))),
        3 => {
            let parts = std::array::from_fn(|_| any_expression(depth - 1, draws));
            ExprKind::Choose(Box::new(parts))
        }
        4 => {
            let count = draws.below(3);
            ExprKind::Call(
                any_function(draws),
                (0..count).map(|_| any_expression(depth - 1, draws)).collect(),
            )
        }
        _ => {
            let op = BinaryOp::ALL[draws.below(BinaryOp::ALL.len())];
            ExprKind::Binary(
                op,
                Box::new([any_expression(depth - 1, draws), any_expression(depth - 1, draws)]),
            )
        }
    };
    Expr { kind, span: Span::default() }
}
