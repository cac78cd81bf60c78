//! Every optimiser on functions whose minimum is known, before any tree.

use super::{ArgminSolver, Search};
use crate::method::{Optimizer, Start};
use crate::space::{Freedom, SearchSpace, TreeSeed};
use crate::testing::{Function, choice, cube, flagged, integer, params, real};
use argmin::core::Executor;
use argmin_testfunctions::{ackley, levy, rastrigin, rosenbrock, sphere};
use pleach_tree::ParamSpace;
use std::sync::Arc;

/// Mean cost over three seeds after `evaluations`, by argmin's executor.
fn reached(name: &str, function: fn(&[f64]) -> f64, params: &Arc<ParamSpace>, evaluations: u64) -> f64 {
    let run = |seed| {
        let base = params.defaults();
        let space =
            SearchSpace::from_params(params.clone(), &base, &Freedom::default(), TreeSeed::Fixed(1)).unwrap();
        let optimizer: Optimizer = name.parse().unwrap();
        let mut search = Search::new(optimizer.method(seed, Start::Random), &Start::Random, Arc::new(space));
        search.evaluation_limit = evaluations;
        let result = Executor::new(Function(function), ArgminSolver(search)).ctrlc(false).run().unwrap();
        result.solver.0.state.best.unwrap().score.cost
    };
    (1..=3).map(run).sum::<f64>() / 3.0
}

#[test]
fn the_default_finds_the_minima_of_the_test_functions() {
    // Ranges are not centred on the minimum, so that no search falls into it.
    type Case = (&'static str, fn(&[f64]) -> f64, f64, f64, f64);
    let cases: [Case; 5] = [
        ("sphere", |x| sphere(x), -3.0, 5.0, 1e-3),
        ("rosenbrock", |x| rosenbrock(x), -3.0, 5.0, 8.0),
        ("rastrigin", |x| rastrigin(x), -3.0, 5.0, 2.0),
        ("ackley", |x| ackley(x), -20.0, 30.0, 0.05),
        ("levy", |x| levy(x), -7.0, 10.0, 1e-2),
    ];
    for (function_name, function, low, high, most) in cases {
        let space = cube(8, low, high);
        let ours = reached("evolution", function, &space, 4000);
        assert!(ours < most, "{function_name}: {ours}");
        let random = reached("random", function, &space, 4000);
        assert!(ours < 0.2 * random, "{function_name}: {ours} against {random} at random");
    }
}

#[test]
fn the_rivals_find_the_minima_of_smooth_functions() {
    type Case = (&'static str, fn(&[f64]) -> f64, f64, f64, [f64; 2]);
    // What CMA-ES and SHADE reach at most.
    let cases: [Case; 4] = [
        ("sphere", |x| sphere(x), -3.0, 5.0, [1e-8, 1e-6]),
        ("rosenbrock", |x| rosenbrock(x), -3.0, 5.0, [4.0, 8.0]),
        ("ackley", |x| ackley(x), -20.0, 30.0, [1e-6, 0.01]),
        ("levy", |x| levy(x), -7.0, 10.0, [1e-6, 0.01]),
    ];
    for (function_name, function, low, high, most) in cases {
        for (name, most) in ["cma", "de"].into_iter().zip(most) {
            let cost = reached(name, function, &cube(8, low, high), 4000);
            assert!(cost < most, "{name} on {function_name}: {cost}");
        }
    }
}

/// Where numbers only do well together, a distribution that learns which beats steps number by number.
#[test]
fn a_long_narrow_valley_is_what_cma_is_for() {
    // Not at zero, which evolution tries for its own sake.
    fn ellipsoid(x: &[f64]) -> f64 {
        let mixed = |i: usize| {
            x.iter().enumerate().map(|(j, v)| (v - 0.7) * ((i * (j + 1)) as f64).cos()).sum::<f64>()
        };
        (0..x.len()).map(|i| 10_f64.powf(i as f64 / 2.0) * mixed(i).powi(2)).sum()
    }
    let space = cube(8, -3.0, 5.0);
    let cma = reached("cma", ellipsoid, &space, 6000);
    let evolution = reached("evolution", ellipsoid, &space, 6000);
    assert!(cma < 1e-6 && cma < 1e-2 * evolution, "{cma} against {evolution}");
}

/// Four kinds of numbers with one needle: distance in each, and a whole step for each wrong name.
fn needle(x: &[f64]) -> f64 {
    let names = [3.0, 1.0].iter().zip(&x[6..8]).filter(|(a, b)| a != b).count() as f64;
    let reals = (x[0] - 0.7).abs() + (x[1] - 0.2).abs();
    let flags = (x[2] + 30.0).abs() / 90.0 + (x[3] - 45.0).abs() / 90.0;
    let wholes = (x[4] - 7.0).abs() / 9.0 + (x[5] - 2.0).abs() / 9.0;
    reals + flags + wholes + names
}

fn mixed() -> Arc<ParamSpace> {
    params(vec![
        real("a", 0.0, 1.0),
        real("b", 0.0, 1.0),
        flagged("f", 90.0),
        flagged("g", 90.0),
        integer("m", 0, 9),
        integer("n", 0, 9),
        choice("c"),
        choice("d"),
    ])
}

#[test]
fn needles_among_mixed_variables_are_found() {
    for (name, most) in [("evolution", 0.02), ("cma", 1e-3), ("de", 1e-3), ("hewitt", 0.5)] {
        let cost = reached(name, needle, &mixed(), 3000);
        assert!(cost < most, "{name}: {cost}");
    }
    assert!(reached("random", needle, &mixed(), 3000) > 0.3);
}

#[test]
fn a_switch_that_is_set_the_wrong_way_is_turned() {
    // Both slopes lead to zero, and only the negative side has the minimum: −60, not +60.
    fn two_sided(x: &[f64]) -> f64 {
        (x[0].abs() - 60.0).abs() / 90.0 + f64::from(u8::from(x[0] > 0.0))
    }
    for name in ["evolution", "cma", "de", "hewitt"] {
        let cost = reached(name, two_sided, &params(vec![flagged("f", 90.0)]), 400);
        assert!(cost < 0.05, "{name}: {cost}");
    }
}
