//! Changes of rules: new ones, further successors, probabilities, conditions.

use super::draws::{Draws, rounded};
use super::items::name;
use super::walk::{literal, number};
use crate::syntax::{Grammar, Item, Rule, Successor};

/// Most successors of a rule, and most rules.
const MAX_SUCCESSORS: usize = 4;
const MAX_RULES: usize = 12;
/// Most successors whose probabilities are drawn: each is at least a hundredth.
const MAX_WEIGHED: usize = 50;

/// Adds a successor or takes one away, moves probability between two, or copies a rule under a new name.
pub(super) fn vary(grammar: &mut Grammar, draws: &mut Draws) {
    let count = grammar.rules.len();
    if count == 0 {
        return;
    }
    let chosen = draws.below(count);
    let kind = draws.unit();
    if kind < 0.3 {
        duplicate(grammar, chosen, draws);
    } else {
        let rule = &mut grammar.rules[chosen];
        if rule.successors.len() < 2 || (kind < 0.5 && rule.successors.len() < MAX_SUCCESSORS) {
            let copy = rule.successors[draws.below(rule.successors.len())].clone();
            rule.successors.push(copy);
        } else if kind < 0.75 {
            rule.successors.remove(draws.below(rule.successors.len()));
        }
        weigh(rule, draws);
    }
}

/// Copies a rule under a name that nothing has, and lets one place use the copy.
fn duplicate(grammar: &mut Grammar, chosen: usize, draws: &mut Draws) {
    let text = grammar.to_string();
    let is_free = |letter: &char| !text.split(|c: char| !c.is_alphanumeric()).any(|w| w.contains(*letter));
    let Some(letter) = ('B'..='Z').filter(|c| !"FLG".contains(*c)).find(is_free) else { return };
    if grammar.rules.len() >= MAX_RULES {
        return;
    }
    let old = grammar.rules[chosen].pred.clone();
    let is_of = |rule: &Rule| rule.pred.name == old.name && rule.pred.params.len() == old.params.len();
    // All rules of a symbol: their conditions belong together.
    let copies: Vec<Rule> = grammar.rules.iter().filter(|rule| is_of(rule)).cloned().collect();
    for mut copy in copies {
        copy.pred.name = name(letter);
        grammar.rules.push(copy);
    }
    let mut uses = 0;
    let is_use = |item: &Item| matches!(item, Item::Module { name, args } if *name == old.name && args.len() == old.params.len());
    super::walk::lists(grammar, &mut |list, _| uses += list.iter().filter(|item| is_use(item)).count());
    let mut left = draws.below(uses) as isize;
    super::walk::lists(grammar, &mut |list, _| {
        for item in list {
            if is_use(item) {
                if let (0, Item::Module { name: symbol, .. }) = (left, &mut *item) {
                    *symbol = name(letter);
                }
                left -= 1;
            }
        }
    });
}

/// Gives the successors of `rule` probabilities that sum to 1, one of them drawn again.
fn weigh(rule: &mut Rule, draws: &mut Draws) {
    if let [only] = &mut rule.successors[..] {
        only.weight = None;
        return;
    }
    let count = rule.successors.len();
    if count > MAX_WEIGHED {
        return;
    }
    let mut weights: Vec<f64> = rule.successors.iter().map(weight).collect();
    weights[draws.below(count)] = draws.between(0.1, 1.0);
    let sum: f64 = weights.iter().sum();
    let mut left = 100.0;
    for (i, successor) in rule.successors.iter_mut().enumerate() {
        let rest = (count - 1 - i) as f64;
        let share =
            if rest == 0.0 { left } else { (100.0 * weights[i] / sum).round().clamp(1.0, left - rest) };
        left -= share;
        successor.weight = Some(number(rounded(share / 100.0)));
    }
}

fn weight(successor: &Successor) -> f64 {
    successor.weight.as_ref().and_then(literal).filter(|w| *w > 0.0 && *w <= 1.0).unwrap_or(0.5)
}
