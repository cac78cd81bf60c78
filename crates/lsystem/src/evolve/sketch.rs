//! Random grammars that a search from nothing begins with: a trunk that carries branches by some rule,
//! all numbers drawn. Lengths are parts of the tree's height.

use super::draws::{Draws, rounded};
use pleach_tree::math;

/// The header of a search from nothing.
macro_rules! blank {
    () => {
        concat!(
            "dialect: hewitt\nscale: size\n",
            "param size = 10 in 0.0001..10000 search 1..100 m \"about the height of the tree\"\n",
        )
    };
}
pub(crate) use blank;

/// The text of a random grammar.
pub(super) fn sketch(draws: &mut Draws) -> String {
    let body = match draws.below(10) {
        0..3 => rings(draws),
        3..6 => spiral(draws),
        6..8 => axis(draws),
        8 => forks(draws),
        _ => crown(draws),
    };
    let shape = ["ovate", "linear", "elliptic", "cordate", "triangle"][draws.below(5)];
    let lift = if draws.chance(0.5) { 0.0 } else { between(draws, -6.0, 4.0) };
    let lean = if draws.chance(0.7) { 0.0 } else { between(draws, -1.5, 1.5) };
    let leaf = rounded(0.012 * math::pow(5.0, draws.unit()));
    format!(
        "{}steps: {}\nthickness: 0.5\nthinning: {}\ntropism: ({lean}, 0, {lift})\nleaf_shape: {shape}\nleaf_scale: {leaf}\n\
         leaf_scale_x: {}\n{body}",
        blank!(),
        12 + draws.below(20),
        between(draws, 0.8, 0.98),
        between(draws, 0.3, 1.2),
    )
}

fn between(draws: &mut Draws, low: f64, high: f64) -> f64 {
    rounded(draws.between(low, high))
}

fn width(draws: &mut Draws) -> f64 {
    between(draws, 0.015, 0.06)
}

/// A way round the trunk.
fn around(draws: &mut Draws) -> String {
    match draws.below(3) {
        0 => "137.5".to_owned(),
        1 => between(draws, 60.0, 150.0).to_string(),
        _ => "rand(100, 180)".to_owned(),
    }
}

/// `B(r)`: a branch of length `r` with its leaves.
fn branch(draws: &mut Draws) -> String {
    let by_length = draws.chance(0.5);
    let leaves = |draws: &mut Draws| {
        let (count, down) = (4 + draws.below(24), between(draws, 20.0, 80.0));
        // Either as many on every piece or as many on every length.
        let count = if by_length { format!("r*{}", 4 * count) } else { count.to_string() };
        format!("{count}, {down}, 137.5")
    };
    let bend = between(draws, -25.0, 25.0);
    let side = between(draws, 20.0, 70.0);
    let (a, b) = (leaves(draws), leaves(draws));
    let long = between(draws, 0.3, 0.6);
    match draws.below(4) {
        0 => format!("B(r) -> !(0.05*r) F(r*0.5, {a}) ^({bend}) F(r*0.5, {b}) %\n"),
        1 => format!(
            "B(r) -> !(0.05*r) F(r*0.4, {a}) [ +({side}) F(r*{long}, {a}) % ] [ -({side}) F(r*{long}, {a}) % ] \
             ^({bend}) F(r*0.5, {b}) %\n"
        ),
        2 => format!(
            "B(r) -> !(0.05*r) for k in 0..{} {{ F(r*0.2, {a}) ^({bend}) /(90) [ +({side}) F(r*{}, {b}) % ] }}\n",
            3 + draws.below(3),
            rounded(0.5 * long),
        ),
        _ => {
            let least = between(draws, 0.05, 0.15);
            format!(
                "B(r) : r > {least} -> !(0.05*r) F(r*0.4, {a}) [ +({side}) B(r*{long}) ] [ -({side}) B(r*{long}) ] \
                 ^({bend}) /(90) B(r*0.6)\nB(r) : r <= {least} -> !(0.05*r) F(r, {b}) %\n"
            )
        }
    }
}

/// How long branches are along the crown, from its foot (0) to its top (1).
fn profile(draws: &mut Draws) -> impl Fn(f64) -> f64 + use<> {
    let most = 0.1 * math::pow(6.0, draws.unit());
    let widest = draws.between(0.0, 0.7);
    let (foot, top) = (draws.between(0.1, 1.0), draws.between(0.05, 0.6));
    move |h| {
        let (from, way) = if h < widest { (foot, h / widest) } else { (top, (1.0 - h) / (1.0 - widest)) };
        most * (from + (1.0 - from) * (1.0 - math::powi(1.0 - way, 2)).max(0.0).sqrt())
    }
}

/// Rings of branches whose lengths are listed.
fn rings(draws: &mut Draws) -> String {
    let (count, bare) = (5 + draws.below(8), between(draws, 0.02, 0.3));
    let profile = profile(draws);
    let lengths: Vec<String> = (0..count)
        .map(|i| rounded(profile((f64::from(i as u32) + 0.5) / f64::from(count as u32))).to_string())
        .collect();
    let each = 2 + draws.below(6);
    let step = rounded((1.0 - bare) / (count * each) as f64);
    let (low, high) = (between(draws, 40.0, 110.0), between(draws, -4.0, 2.0));
    let varied = if draws.chance(0.5) { "*rand(0.8, 1.2)" } else { "" };
    format!(
        "axiom: !({}) F({bare}) Q(0)\nQ(k) -> for r in [{}] {{ ! for j in 0..{each} {{ F({step}) /({}) \
         [ &({low} + rand({high}, 5)) B(r{varied}) ] }} }} F({step}) %\n{}",
        width(draws),
        lengths.join(", "),
        around(draws),
        branch(draws),
    )
}

/// One branch after the other around the trunk, each with a length of its own: a crown that need not be the
/// same on all sides.
fn spiral(draws: &mut Draws) -> String {
    let (count, bare) = (20 + draws.below(24), between(draws, 0.02, 0.3));
    let profile = profile(draws);
    let lengths: Vec<String> = (0..count)
        .map(|i| {
            let along = profile((f64::from(i as u32) + 0.5) / f64::from(count as u32));
            rounded(along * draws.between(0.85, 1.15)).to_string()
        })
        .collect();
    let step = rounded((1.0 - bare) / count as f64);
    let (low, rise) = (between(draws, 30.0, 100.0), between(draws, -40.0, 120.0));
    let turn = if draws.chance(0.5) { 137.5 } else { between(draws, 80.0, 180.0) };
    // More than one at a place fills the crown.
    let others = match draws.below(3) {
        0 => String::new(),
        1 => " [ /(180) &(a) B(r) ]".to_owned(),
        _ => " [ /(120) &(a) B(r) ] [ /(240) &(a) B(r) ]".to_owned(),
    };
    let wide = width(draws);
    format!(
        "axiom: !({wide}) F({bare}) for r in [{}] {{ let a = {low} + {rise}*r; ! F({step}) /({turn}) [ &(a) B(r) ]{others} }} \
         F({step}) %\n{}",
        lengths.join(", "),
        branch(draws),
    )
}

/// An axis of steps, branches by a formula of their height.
fn axis(draws: &mut Draws) -> String {
    let (bare, step) = (between(draws, 0.02, 0.3), between(draws, 0.03, 0.1));
    let each = 1 + draws.below(5);
    let (low, rise) = (between(draws, 50.0, 110.0), between(draws, 0.0, 70.0));
    let (long, short) = (between(draws, 0.1, 0.6), between(draws, 0.03, 0.1));
    let power = between(draws, 0.4, 1.5);
    let wide = width(draws);
    format!(
        "axiom: !({wide}) F({bare}) A({bare})\nA(h) : h < 1 -> !({wide}*(1 - h)) for j in 0..{each} {{ F({step}/{each}) \
         /({}) [ &({low} - {rise}*h + rand(-8, 8)) B({long}*(1 - h)^{power} + {short}) ] }} A(h + {step})\n\
         A(h) : h >= 1 -> F({short}) %\n{}",
        around(draws),
        branch(draws),
    )
}

/// A trunk that forks and forks again.
fn forks(draws: &mut Draws) -> String {
    let wide = width(draws);
    let (first, bare) = (between(draws, 0.15, 0.35), between(draws, 0.05, 0.4));
    let least = between(draws, 0.03, 0.08);
    let (keep, less) = (between(draws, 0.6, 0.85), between(draws, 0.5, 0.8));
    let (lean, other) = (between(draws, 10.0, 40.0), between(draws, 20.0, 60.0));
    let leaves = 4 + draws.below(20);
    format!(
        "axiom: !({wide}) F({bare}) A({first}, {wide})\nA(l, w) : l > {least} -> !(w) F(l) /({}) [ &({lean}) A(l*{keep}, \
         w*0.7) ] /(rand(100, 140)) [ &({other}) A(l*{less}, w*0.6) ]\nA(l, w) : l <= {least} -> !(w) F(l*2, {leaves}, 45, \
         137.5) %\n",
        around(draws)
    )
}

/// Stems from one place: a palm's fronds on their trunk, or a clump of canes.
fn crown(draws: &mut Draws) -> String {
    let (bare, count) = (between(draws, 0.01, 0.9), 6 + draws.below(24));
    let (long, pieces) = (between(draws, 0.2, 0.6), 3 + draws.below(4));
    let (low, high) = (between(draws, 0.0, 40.0), between(draws, 20.0, 120.0));
    let (bend, leaves) = (between(draws, -5.0, 25.0), 4 + draws.below(20));
    format!(
        "axiom: !({}) F({bare}) for i in 0..{count} {{ /({}) [ &({low} + {high}*i/{count}) !(0.01) B({long}) ] }}\n\
         B(r) -> for k in 0..{pieces} {{ F(r/{pieces}, {leaves}, {}, 137.5) &({bend}) }} %\n",
        width(draws),
        around(draws),
        between(draws, 20.0, 70.0),
    )
}
