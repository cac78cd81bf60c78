//! Threads that help, whenever they come, change neither a tree nor whether it grows.

use pleach_tree::conformance::{Volunteers, list_within};
use pleach_tree::{CheckedParams, Foliage, Generator as _, GrowError, Growth, Limits, Tree, Workspace};
use pleach_weber_penn::{HEWITT_2017, WeberPenn, preset, space};

fn grow(params: &CheckedParams, growth: &Growth) -> Result<Tree, GrowError> {
    let mut tree = Tree::default();
    let grown = WeberPenn::default().grow(params, growth, &mut Workspace::default(), &mut tree);
    grown.map(|()| tree)
}

#[test]
fn known_species_are_the_same_with_help() {
    let mut calls = 0;
    for name in HEWITT_2017 {
        let species = preset(name).unwrap();
        for (threads, patience) in [(1, 0), (2, 0), (3, 7), (8, 30)] {
            for foliage in [Foliage::All, Foliage::None] {
                let growth = Growth { foliage, ..Growth::seed(3) };
                let helpers = Volunteers::new(threads, patience);
                let helped = grow(&species.params, &Growth { helpers: Some(&helpers), ..growth }).unwrap();
                assert!(helped == grow(&species.params, &growth).unwrap(), "{name} on {threads} threads");
                calls += helpers.calls();
            }
        }
    }
    assert!(calls > 100, "{calls}");
}

#[test]
fn the_same_lists_are_within_limits_with_help() {
    let (mut grown, mut refused) = ([0, 0], [0, 0]);
    for case in 0..600 {
        let params = space().check(list_within(space(), case)).unwrap();
        let part = 1 + case as usize % 5;
        let limits = Limits {
            stems: 20_000 / part,
            leaves: 100_000 / (1 + case as usize % 4),
            knots: 100_000 / (1 + case as usize % 3),
            work: 1_000_000,
        };
        let growth = Growth { limits, counts_ahead: case % 2 == 0, ..Growth::seed(case) };
        let alone = grow(&params, &growth);
        for (threads, patience) in [(1, 0), (3, 0), (8, case as usize % 20)] {
            let helpers = Volunteers::new(threads, patience);
            let helped = grow(&params, &Growth { helpers: Some(&helpers), ..growth });
            match (&alone, helped) {
                (Ok(alone), Ok(helped)) => {
                    assert!(*alone == helped, "case {case}: another tree");
                    grown[usize::from(helpers.calls() > 0)] += 1;
                }
                (Err(_), Err(_)) => refused[usize::from(helpers.calls() > 0)] += 1,
                (alone, helped) => {
                    panic!("case {case}: {:?}, with help {:?}", alone.as_ref().err(), helped.err())
                }
            }
        }
    }
    // With help, too.
    assert!(grown[1] > 30 && refused[1] > 100, "{grown:?} grew, {refused:?} did not");
}

#[test]
fn a_limit_that_is_just_met_is_met_with_help() {
    for name in HEWITT_2017 {
        let species = preset(name).unwrap();
        let growth = Growth::seed(2);
        let tree = grow(&species.params, &growth).unwrap();
        let exact = Limits {
            stems: tree.stems.len(),
            leaves: tree.leaves.len() + tree.blossoms.len(),
            knots: tree.knots.len(),
            ..Limits::DEFAULT
        };
        let less = [
            Limits { stems: exact.stems - 1, ..exact },
            Limits { leaves: exact.leaves.saturating_sub(1), ..exact },
            Limits { knots: exact.knots - 1, ..exact },
        ];
        for (threads, patience) in [(1, 0), (2, 3), (8, 0)] {
            for counts_ahead in [false, true] {
                let helped = |limits| {
                    let helpers = Volunteers::new(threads, patience);
                    grow(&species.params, &Growth { limits, counts_ahead, helpers: Some(&helpers), ..growth })
                };
                assert!(helped(exact).as_ref() == Ok(&tree), "{name}");
                for limits in less.into_iter().filter(|&limits| limits != exact) {
                    assert!(helped(limits).is_err(), "{name} within {limits:?}");
                }
            }
        }
    }
}
