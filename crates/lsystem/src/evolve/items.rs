//! Changes of what is written: items grow, go, move and become others.

use super::draws::{Draws, rounded};
use super::walk::{TURNS, expr, exprs, lists, literal, number};
use crate::syntax::{BinaryOp, Expr, ExprKind, Grammar, Item, Name, Span, Values};

/// What grows where: symbols with rules and the number of their parameters.
pub(super) type Symbols = Vec<(String, usize)>;

/// Symbols that have rules.
pub(super) fn symbols(grammar: &Grammar) -> Symbols {
    let mut symbols: Symbols =
        grammar.rules.iter().map(|r| (r.pred.name.text.clone(), r.pred.params.len())).collect();
    symbols.sort();
    symbols.dedup();
    symbols
}

/// Grows, cuts, copies, swaps or alters an item, or makes a number chance or chance a number.
pub(super) fn vary(grammar: &mut Grammar, draws: &mut Draws) {
    match draws.below(7) {
        0 | 1 => {
            let symbols = symbols(grammar);
            in_a_list(grammar, draws, &mut |list, scope, draws| {
                let at = draws.below(list.len() + 1);
                list.insert(at, item(&symbols, scope, draws));
            });
        }
        2 => in_a_list(grammar, draws, &mut |list, _, draws| {
            if !list.is_empty() {
                list.remove(draws.below(list.len()));
            }
        }),
        3 => in_a_list(grammar, draws, &mut |list, _, draws| {
            if let Some(copy) = draws.pick(list).cloned() {
                let at = draws.below(list.len() + 1);
                list.insert(at, copy);
            }
        }),
        4 => in_a_list(grammar, draws, &mut |list, _, draws| {
            if list.len() > 1 {
                let at = draws.below(list.len() - 1);
                list.swap(at, at + 1);
            }
        }),
        5 => {
            let symbols = symbols(grammar);
            in_a_list(grammar, draws, &mut |list, scope, draws| alter(list, &symbols, scope, draws));
        }
        _ => chance(grammar, draws),
    }
}

/// Calls `change` with one list of items and the names that it may use.
fn in_a_list(
    grammar: &mut Grammar,
    draws: &mut Draws,
    change: &mut dyn FnMut(&mut Vec<Item>, &[String], &mut Draws),
) {
    // A long list is as likely as its items.
    let mut total = 0;
    lists(grammar, &mut |list, _| total += list.len() + 1);
    let mut left = draws.below(total) as isize;
    lists(grammar, &mut |list, scope| {
        let here = (list.len() + 1) as isize;
        if (0..here).contains(&left) {
            change(list, scope, draws);
        }
        left -= here;
    });
}

pub(super) fn name(text: impl Into<String>) -> Name {
    Name { text: text.into(), span: Span::default() }
}

fn module(symbol: &str, args: Vec<Expr>) -> Item {
    Item::Module { name: name(symbol), args }
}

/// A number, or a name times a number.
fn length(scope: &[String], draws: &mut Draws) -> Expr {
    let factor = number(rounded(draws.between(0.2, 1.1)));
    match draws.pick(scope) {
        Some(known) if draws.chance(0.7) => {
            let known = expr(ExprKind::Name(known.clone()));
            expr(ExprKind::Binary(BinaryOp::Mul, Box::new([known, factor])))
        }
        _ => number(rounded(0.3 * draws.unit())),
    }
}

/// A random item.
fn item(symbols: &Symbols, scope: &[String], draws: &mut Draws) -> Item {
    match draws.below(8) {
        0 | 1 => turn(draws),
        2 => {
            let leaves = (20.0 * draws.unit()).round();
            module("F", vec![length(scope, draws), number(leaves), number(45.0), number(137.5)])
        }
        3 => module("F", vec![length(scope, draws)]),
        4 => module("!", vec![length(scope, draws)]),
        5 => called(symbols, scope, draws),
        6 => Item::For {
            name: name(unused("i", scope)),
            values: Values::Range(number(0.0), number(2.0 + draws.below(4) as f64)),
            body: vec![turn(draws), Item::Branch(vec![turn(draws), called(symbols, scope, draws)])],
        },
        _ => Item::Branch(vec![turn(draws), turn(draws), called(symbols, scope, draws)]),
    }
}

fn turn(draws: &mut Draws) -> Item {
    let angle = rounded(draws.between(0.0, 90.0));
    module(draws.pick(&TURNS).unwrap_or(&"/"), vec![number(angle)])
}

/// A symbol with a rule, or a leafy piece where there is none.
fn called(symbols: &Symbols, scope: &[String], draws: &mut Draws) -> Item {
    match draws.pick(symbols) {
        Some((symbol, count)) => {
            let args = (0..*count).map(|_| length(scope, draws)).collect();
            module(symbol, args)
        }
        None => module("F", vec![length(scope, draws), number(8.0), number(45.0), number(137.5)]),
    }
}

/// A name that nothing in `scope` has.
fn unused(stem: &str, scope: &[String]) -> String {
    let is_free = |candidate: &String| !scope.contains(candidate);
    (0..)
        .map(|n| if n == 0 { stem.to_owned() } else { format!("{stem}{n}") })
        .find(is_free)
        .unwrap_or_default()
}

/// Makes an item another one of its kind, puts one into brackets or takes brackets away.
fn alter(list: &mut Vec<Item>, symbols: &Symbols, scope: &[String], draws: &mut Draws) {
    if list.is_empty() {
        return;
    }
    let at = draws.below(list.len());
    match &mut list[at] {
        Item::Module { name, .. } if TURNS.contains(&name.text.as_str()) => {
            if let Some(other) = draws.pick(&TURNS) {
                name.text = (*other).to_owned();
            }
        }
        Item::Branch(inside) if draws.chance(0.5) => {
            let inside = std::mem::take(inside);
            list.splice(at..=at, inside);
        }
        Item::For { body, .. } if draws.chance(0.3) => {
            let body = std::mem::take(body);
            list.splice(at..=at, body);
        }
        Item::Module { .. } if draws.chance(0.3) => {
            let inside = list.remove(at);
            list.insert(at, Item::Branch(vec![turn(draws), inside]));
        }
        _ => list[at] = item(symbols, scope, draws),
    }
}

/// Makes a number chance (`rand` about it), or a draw a number.
fn chance(grammar: &mut Grammar, draws: &mut Draws) {
    let is_draw = |e: &Expr| matches!(&e.kind, ExprKind::Call(f, _) if f == "rand" || f == "nrand");
    let mut count = 0;
    exprs(grammar, &mut |e, _| count += usize::from(literal(e).is_some_and(|v| v != 0.0) || is_draw(e)));
    let chosen = draws.below(count);
    let spread = draws.between(0.05, 0.3);
    let mut place = 0;
    exprs(grammar, &mut |e, _| {
        let value = literal(e).filter(|v| *v != 0.0);
        if value.is_none() && !is_draw(e) {
            return;
        }
        place += 1;
        if place != chosen + 1 {
            return;
        }
        if let Some(value) = value {
            let ends = [value * (1.0 - spread), value * (1.0 + spread)];
            *e = expr(ExprKind::Call("rand".to_owned(), ends.map(|end| number(rounded(end))).to_vec()));
            // The ends of the new draw are visited next and are not meant.
            place += usize::MAX / 2;
        } else if let ExprKind::Call(function, args) = &e.kind {
            let ends: Vec<f64> = args.iter().filter_map(literal).collect();
            match (function.as_str(), &ends[..]) {
                ("rand", [a, b]) => *e = number(rounded(f64::midpoint(*a, *b))),
                ("nrand", [mean, _]) => *e = number(*mean),
                _ => {}
            }
        }
    });
}
