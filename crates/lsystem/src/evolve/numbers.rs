//! Changes of a grammar's numbers.

use super::draws::{Draws, rounded};
use super::walk::{Role, exprs, literal, number};
use crate::syntax::{Grammar, Item, SettingKey, Values};
use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::math;

/// Steps are drawn by ratio between these parts of a number, or of [`TURN`].
const STEPS: (f64, f64) = (0.004, 0.5);
/// Angles change by differences: a step of 1 is this many degrees.
const TURN: f64 = 60.0;
/// Tropisms too, a step of 1 by this much.
const TROPISM: f64 = 6.0;
/// Numbers near zero change by differences too.
const SMALL: f64 = 0.01;
/// Largest magnitude of a number.
const MAX_NUMBER: f64 = 1000.0;
/// Most repeats, steps and leaves that a change leads to; what was more may stay.
const MAX_REPEATS: f64 = 40.0;
const MAX_LEAVES: f64 = 400.0;
/// Changes one number, a few, many a little, or all values of a repetition together.
pub(super) fn vary(grammar: &mut Grammar, draws: &mut Draws) {
    let kind = draws.unit();
    if kind < 0.12 && bend_list(grammar, draws) {
        return;
    }
    if kind > 0.97 {
        shape(grammar, draws);
        return;
    }
    let mut count = 0;
    exprs(grammar, &mut |expr, _| count += usize::from(literal(expr).is_some()));
    let (low, high) = STEPS;
    let step = low * math::pow(high / low, draws.unit());
    let (share, step) = match draws.unit() {
        u if u < 0.45 => (0.0, step),
        u if u < 0.8 => (2.5 / count.max(1) as f64, step),
        _ => (0.3, 0.3 * step),
    };
    let chosen = draws.below(count);
    let mut place = 0;
    exprs(grammar, &mut |expr, role| {
        if let Some(value) = literal(expr) {
            if place == chosen || draws.chance(share) {
                *expr = number(stepped(value, role, step, draws));
            }
            place += 1;
        }
    });
}

/// `value` with one step.
fn stepped(value: f64, role: Role, step: f64, draws: &mut Draws) -> f64 {
    let whole = |draws: &mut Draws, most: f64| {
        let by = (value * step * draws.normal()).round();
        let by = if by == 0.0 { if draws.chance(0.5) { 1.0 } else { -1.0 } } else { by };
        (value + by).clamp(0.0, most.max(value))
    };
    match role {
        Role::Count | Role::Setting(SettingKey::Steps) if value.fract() == 0.0 => whole(draws, MAX_REPEATS),
        Role::Leaves if value.fract() == 0.0 => whole(draws, MAX_LEAVES),
        Role::Angle => {
            let flips = draws.chance(0.03);
            let turned = if flips { -value } else { value + TURN * step * draws.normal() };
            rounded(turned.clamp(-360.0, 360.0))
        }
        // Degrees per piece, about zero.
        Role::Setting(SettingKey::Tropism) => {
            rounded((value + TROPISM * step * draws.normal()).clamp(-MAX_NUMBER, MAX_NUMBER))
        }
        Role::Weight => rounded((value + 0.3 * step * draws.normal()).clamp(0.0, 1.0)),
        _ => {
            let moved = if value.abs() < SMALL {
                value + SMALL * step * draws.normal()
            } else {
                value * math::exp(step * draws.normal())
            };
            rounded(moved.clamp(-MAX_NUMBER, MAX_NUMBER))
        }
    }
}

/// Makes the values of one repetition larger or smaller, more at one end or in the middle: the outline of
/// a crown. Whether there was one.
fn bend_list(grammar: &mut Grammar, draws: &mut Draws) -> bool {
    let mut count = 0;
    for_lists(grammar, &mut |_| count += 1);
    let chosen = draws.below(count);
    let (all, end, middle) = (0.15 * draws.normal(), 0.2 * draws.normal(), 0.2 * draws.normal());
    let edit = draws.unit();
    let place = draws.unit();
    let mut number_of_list = 0;
    for_lists(grammar, &mut |list| {
        if number_of_list == chosen && !list.is_empty() {
            let at = (place * list.len() as f64) as usize;
            if edit < 0.15 {
                list.insert(at, list[at].clone());
            } else if edit < 0.3 && list.len() > 1 {
                list.remove(at);
            } else {
                let last = (list.len() - 1).max(1) as f64;
                for (i, value) in list.iter_mut().enumerate() {
                    let along = 2.0 * i as f64 / last - 1.0;
                    if let Some(old) = literal(value) {
                        let factor = math::exp(all + end * along + middle * (1.0 - along * along));
                        *value = number(rounded((old * factor).clamp(-MAX_NUMBER, MAX_NUMBER)));
                    }
                }
            }
        }
        number_of_list += 1;
    });
    count > 0
}

fn for_lists(grammar: &mut Grammar, visit: &mut dyn FnMut(&mut Vec<crate::syntax::Expr>)) {
    super::walk::lists(grammar, &mut |items, _| {
        for item in items {
            if let Item::For { values: Values::List(list), .. } = item {
                visit(list);
            }
        }
    });
}

/// Another shape of the leaves.
fn shape(grammar: &mut Grammar, draws: &mut Draws) {
    let setting = grammar.settings.iter_mut().find(|setting| setting.key == SettingKey::LeafShape);
    if let (Some(setting), Some(shape)) = (setting, draws.pick(&LeafShape::ALL)) {
        setting.values = vec![super::walk::expr(crate::syntax::ExprKind::Name(shape.name().to_owned()))];
    }
}
