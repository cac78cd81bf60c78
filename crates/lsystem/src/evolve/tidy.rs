//! Takes away what changes nothing, so that grammars stay short.

use super::draws::rounded;
use super::walk::{exprs, lists, literal, number};
use crate::syntax::{BinaryOp, Expr, ExprKind, Grammar, Item};

/// Takes away empty brackets and repetitions, and rules for symbols that are never written; makes one
/// number of products of numbers.
pub(super) fn tidy(grammar: &mut Grammar) {
    exprs(grammar, &mut |expr, _| fold(expr));
    // Taking one away may empty the one around it.
    loop {
        let mut is_done = true;
        lists(grammar, &mut |list, _| {
            let before = list.len();
            list.retain(|item| match item {
                Item::Branch(inside) | Item::Polygon(inside) => !inside.is_empty(),
                Item::For { body, .. } => !body.is_empty(),
                Item::Module { .. } | Item::Let { .. } => true,
            });
            is_done &= list.len() == before;
        });
        let mut written: Vec<(String, usize)> = Vec::new();
        collect(&grammar.axiom, &mut written);
        let mut known = 0;
        while known < written.len() {
            let (symbol, count) = written[known].clone();
            known += 1;
            let rules = grammar
                .rules
                .iter()
                .filter(|rule| rule.pred.name.text == symbol && rule.pred.params.len() == count);
            for successor in rules.flat_map(|rule| &rule.successors) {
                collect(&successor.items, &mut written);
            }
        }
        let rules = grammar.rules.len();
        grammar.rules.retain(|rule| {
            written.iter().any(|(s, n)| *s == rule.pred.name.text && *n == rule.pred.params.len())
        });
        if is_done && grammar.rules.len() == rules {
            return;
        }
    }
}

/// Adds the symbols of `items` to `written`, each once.
fn collect(items: &[Item], written: &mut Vec<(String, usize)>) {
    for item in items {
        match item {
            Item::Module { name, args } => {
                if !written.iter().any(|(s, n)| *s == name.text && *n == args.len()) {
                    written.push((name.text.clone(), args.len()));
                }
            }
            Item::Branch(inside) | Item::Polygon(inside) => collect(inside, written),
            Item::For { body, .. } => collect(body, written),
            Item::Let { .. } => {}
        }
    }
}

/// `2*3` is 6, and `l*2*3` is `l*6`.
fn fold(expr: &mut Expr) {
    let ExprKind::Binary(BinaryOp::Mul, parts) = &mut expr.kind else { return };
    let [left, right] = &mut **parts;
    fold(left);
    let Some(factor) = literal(right) else { return };
    if let Some(value) = literal(left) {
        *expr = number(rounded(value * factor));
    } else if let ExprKind::Binary(BinaryOp::Mul, inner) = &mut left.kind
        && let Some(value) = literal(&inner[1])
    {
        inner[1] = number(rounded(value * factor));
        let folded = left.clone();
        *expr = folded;
    }
}
