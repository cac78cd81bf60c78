//! Draws have the distributions that they say, and neighbours know nothing of each other.

use pleach_lsystem::{Derivation, LSystem};

/// Arguments of all symbols of the axiom with two numbers each.
fn values(axiom: &str, seed: u64) -> Vec<f64> {
    let system = LSystem::read("test", axiom).unwrap_or_else(|e| panic!("{e}"));
    let derived = system.derive(&Derivation { seed, ..Derivation::default() }).unwrap();
    derived.iter().flat_map(|(_, values)| values.to_vec()).collect()
}

/// Pearson's statistic of counts whose expectations are `share` of their sum.
fn chi_square(counts: &[usize], share: impl Fn(usize) -> f64) -> f64 {
    let n = counts.iter().sum::<usize>() as f64;
    let term = |(i, &count): (usize, &usize)| (count as f64 - n * share(i)).powi(2) / (n * share(i));
    counts.iter().enumerate().map(term).sum()
}

/// A bound that a sound generator passes once in far more than a million runs: mean and deviation of
/// chi-square are `free` and the root of twice that.
#[track_caller]
fn plausible(statistic: f64, free: usize, what: &str) {
    let free = free as f64;
    assert!(statistic < free + 6.0 * (2.0 * free).sqrt() + 12.0, "{what}: {statistic} for {free}");
    assert!(free < 10.0 || statistic > 0.3 * free, "{what}: {statistic} for {free} is too even");
}

#[test]
fn uniform_draws_are_uniform() {
    const BINS: usize = 40;
    let mut counts = vec![0; BINS];
    let mut pairs = vec![0; 64];
    for seed in 0..4 {
        let drawn = values("axiom: for i in 0..5000 { F(rand(-2, 6), rand()) }", seed);
        for two in drawn.chunks(2) {
            assert!((-2.0..6.0).contains(&two[0]) && (0.0..1.0).contains(&two[1]), "{two:?}");
            counts[((two[0] + 2.0) / 8.0 * BINS as f64) as usize] += 1;
            pairs[((two[0] + 2.0) as usize) * 8 + (two[1] * 8.0) as usize] += 1;
        }
    }
    plausible(chi_square(&counts, |_| 1.0 / BINS as f64), BINS - 1, "rand(a, b)");
    plausible(chi_square(&pairs, |_| 1.0 / 64.0), 63, "two draws of one module");
}

#[test]
fn normal_draws_are_normal() {
    // Quantiles of the standard normal distribution at eighths.
    const EDGES: [f64; 7] = [-1.150_349, -0.674_490, -0.318_639, 0.0, 0.318_639, 0.674_490, 1.150_349];
    let drawn = values("axiom: for i in 0..9999 { F(nrand(5, 0.5)) }", 3);
    let mut counts = vec![0; 8];
    let bin = |x: f64| EDGES.iter().filter(|edge| x > **edge).count();
    drawn.iter().for_each(|x| counts[bin((x - 5.0) / 0.5)] += 1);
    plausible(chi_square(&counts, |_| 0.125), 7, "nrand");
    let mut pairs = vec![0; 64];
    drawn
        .windows(2)
        .step_by(2)
        .for_each(|w| pairs[bin((w[0] - 5.0) / 0.5) * 8 + bin((w[1] - 5.0) / 0.5)] += 1);
    plausible(chi_square(&pairs, |_| 1.0 / 64.0), 63, "neighbours");
    let beyond = drawn.iter().filter(|x| (*x - 5.0).abs() > 1.5).count() as f64;
    // 0.27 % beyond three deviations.
    assert!((beyond - 27.0).abs() < 26.0, "{beyond} beyond three deviations");
}

#[test]
fn successors_are_chosen_as_often_as_their_weights_say() {
    let text = "axiom: for i in 0..9000 { A(0.3) }\nA(p) -(p)-> B -(p/2)-> C -(1 - p*1.5)-> D";
    let system = LSystem::read("test", text).unwrap();
    let derived = system.derive(&Derivation { steps: Some(1), ..Derivation::default() }).unwrap();
    let counts = ["B", "C", "D"].map(|symbol| derived.count(symbol));
    plausible(chi_square(&counts, |i| [0.3, 0.15, 0.55][i]), 2, "choices");
    // The choice of a neighbour, and of the same place a step later, is another one.
    let text = "axiom: for i in 0..9000 { A }\nA -0.5-> B -0.5-> C\nB -0.5-> D -0.5-> E\nC -0.5-> G -0.5-> H";
    let system = LSystem::read("test", text).unwrap();
    let derive = |steps| system.derive(&Derivation { steps: Some(steps), ..Derivation::default() }).unwrap();
    let derived = derive(2);
    let counts = ["D", "E", "G", "H"].map(|symbol| derived.count(symbol));
    plausible(chi_square(&counts, |_| 0.25), 3, "steps");
    let derived = derive(1);
    let names: Vec<&str> = derived.iter().map(|(name, _)| name).collect();
    let mut pairs = [0; 4];
    names.chunks(2).for_each(|two| pairs[2 * usize::from(two[0] == "B") + usize::from(two[1] == "B")] += 1);
    plausible(chi_square(&pairs, |_| 0.25), 3, "neighbours");
    // The same place of other seeds.
    let mut counts = [0; 2];
    for seed in 0..2000 {
        let derivation = Derivation { seed, steps: Some(1), ..Derivation::default() };
        let first = system.derive(&derivation).unwrap();
        counts[usize::from(first.iter().next().unwrap().0 == "B")] += 1;
    }
    plausible(chi_square(&counts, |_| 0.5), 1, "seeds");
}
