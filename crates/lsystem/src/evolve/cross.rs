//! Two grammars make one.

use super::draws::{Draws, rounded};
use super::walk::{exprs, lists, literal, number};
use crate::syntax::{Grammar, Item};

/// Puts a part of `other` into `grammar`: numbers where both have the same form, else a part of a list
/// of items, a rule, or settings.
pub(super) fn cross(grammar: &mut Grammar, other: &Grammar, draws: &mut Draws) {
    if draws.chance(0.6) && numbers(grammar, other, draws) {
        return;
    }
    let mut other = other.clone();
    match draws.below(4) {
        0 => {
            // The header: leaves and tropism.
            for setting in &mut grammar.settings {
                let same = other.settings.iter().find(|s| s.key == setting.key);
                if let Some(same) = same.filter(|_| draws.chance(0.5)) {
                    setting.values.clone_from(&same.values);
                }
            }
        }
        1 => {
            let Some(rule) = draws.pick(&other.rules).cloned() else { return };
            let is_same = |r: &crate::syntax::Rule| {
                r.pred.name == rule.pred.name && r.pred.params.len() == rule.pred.params.len()
            };
            // All rules of a symbol: their conditions belong together.
            let theirs: Vec<_> = other.rules.iter().filter(|r| is_same(r)).cloned().collect();
            let at = grammar.rules.iter().position(is_same).unwrap_or(grammar.rules.len());
            grammar.rules.retain(|r| !is_same(r));
            let at = at.min(grammar.rules.len());
            grammar.rules.splice(at..at, theirs);
        }
        _ => {
            let Some(part) = any_item(&mut other, draws) else { return };
            let mut total = 0;
            lists(grammar, &mut |list, _| total += list.len());
            let mut left = draws.below(total) as isize;
            let replaces = draws.chance(0.6);
            lists(grammar, &mut |list, _| {
                let here = list.len() as isize;
                if (0..here).contains(&left) {
                    let end = left as usize + usize::from(replaces);
                    list.splice(left as usize..end, [part.clone()]);
                }
                left -= here;
            });
        }
    }
}

/// Any item of `grammar`, as likely as any other.
fn any_item(grammar: &mut Grammar, draws: &mut Draws) -> Option<Item> {
    let mut total = 0;
    lists(grammar, &mut |list, _| total += list.len());
    let mut left = draws.below(total) as isize;
    let mut found = None;
    lists(grammar, &mut |list, _| {
        if let Some(item) = usize::try_from(left).ok().and_then(|at| list.get(at)) {
            found.get_or_insert_with(|| item.clone());
        }
        left -= list.len() as isize;
    });
    found
}

/// Takes numbers of `other`, or goes some way towards them, where both grammars are the same but for
/// their numbers. Whether they are.
fn numbers(grammar: &mut Grammar, other: &Grammar, draws: &mut Draws) -> bool {
    let (own, theirs) = (literals(grammar), literals(&mut other.clone()));
    if own.len() != theirs.len() || form(grammar) != form(other) {
        return false;
    }
    let whole = draws.chance(0.5);
    let share = draws.between(0.1, 0.6);
    let way = draws.between(0.2, 1.3);
    let mut place = 0;
    exprs(grammar, &mut |expr, _| {
        if let Some(value) = literal(expr) {
            let there = theirs[place];
            place += 1;
            if value != there && draws.chance(share) {
                let is_count = value.fract() == 0.0 && there.fract() == 0.0;
                let between = rounded(value + way * (there - value));
                *expr = number(if whole || is_count { there } else { between });
            }
        }
    });
    true
}

fn literals(grammar: &mut Grammar) -> Vec<f64> {
    let mut values = Vec::new();
    exprs(grammar, &mut |expr, _| values.extend(literal(expr)));
    values
}

/// The text without its numbers.
fn form(grammar: &Grammar) -> String {
    let mut grammar = grammar.clone();
    exprs(&mut grammar, &mut |expr, _| {
        if literal(expr).is_some() {
            *expr = number(0.0);
        }
    });
    grammar.to_string()
}
