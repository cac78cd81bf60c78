//! Whatever list of numbers is grown: memory stays in proportion to the limits, and threads change
//! neither the tree nor the error.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pleach_tree::conformance::list_within;
use pleach_tree::{CheckedParams, Foliage, GrowError, Growth, Knot, Leaf, Limits, Stem, Tree, Workspace};
use pleach_weber_penn::{WeberPenn, space};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static GLOBAL: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const LIMITS: Limits = Limits { stems: 1000, leaves: 8000, knots: 12_000, work: 200_000 };

/// Bytes that limits allow: each part twice over, once where it grows and once where it is put
/// together, and twice that for arrays that double as they grow; and something for each thread.
fn allowed(limits: &Limits) -> usize {
    let tree = limits.stems * size_of::<Stem>()
        + limits.knots * size_of::<Knot>()
        + limits.leaves * size_of::<Leaf>();
    // A stem that waits takes a quarter of a kilobyte.
    4 * (tree + 256 * limits.stems) + (4 << 20)
}

fn grow(params: &CheckedParams, growth: &Growth) -> (Result<Tree, GrowError>, usize) {
    use pleach_tree::Generator as _;
    let region = Region::new(GLOBAL);
    let mut tree = Tree::default();
    let grown = WeberPenn::default().grow(params, growth, &mut Workspace::default(), &mut tree);
    (grown.map(|()| tree), region.change().bytes_allocated)
}

/// One test, since the counter counts every thread of the process.
#[test]
fn memory_is_bounded_and_threads_change_nothing() {
    let (mut grown, mut refused) = (0, [0; 4]);
    for case in 0..240 {
        let params = space().check(list_within(space(), case)).unwrap();
        let foliage = if case % 3 == 0 { Foliage::None } else { Foliage::All };
        let growth = Growth { limits: LIMITS, foliage, ..Growth::seed(case) };
        let (serial, bytes) = grow(&params, &growth);
        assert!(bytes < allowed(&LIMITS), "case {case} took {bytes} bytes");
        let (parallel, bytes) = grow(&params, &Growth { parallel: true, ..growth });
        assert!(bytes < 2 * allowed(&LIMITS), "case {case} took {bytes} bytes on threads");
        assert!(serial == parallel, "case {case}: {:?} and {:?}", serial.err(), parallel.err());
        match serial {
            Ok(tree) => {
                grown += 1;
                tree.well_formed().unwrap_or_else(|broken| panic!("case {case}: {broken}"));
                assert!(tree.stems.len() <= LIMITS.stems && tree.knots.len() <= LIMITS.knots);
                assert!(tree.leaves.len() + tree.blossoms.len() <= LIMITS.leaves);
            }
            Err(GrowError::TooManyStems { blame, .. }) => {
                refused[0] += 1;
                assert!(blame.0[0].contains('['), "case {case}: {blame}");
            }
            Err(GrowError::TooManyLeaves { blame, .. }) => {
                refused[1] += 1;
                assert!(blame.0[0] == "leaf_blos_num", "case {case}: {blame}");
            }
            Err(GrowError::TooManyKnots { blame, .. } | GrowError::TooMuchWork { blame, .. }) => {
                refused[2] += 1;
                assert!(!blame.0.is_empty(), "case {case}");
            }
            Err(GrowError::Conflict(_) | GrowError::TooManyWaiting { .. } | GrowError::NotFinite { .. }) => {
                refused[3] += 1;
            }
            Err(error) => panic!("case {case}: {error}"),
        }
    }
    assert!(grown > 10 && refused.iter().all(|&n| n > 2), "{grown} grew, {refused:?} did not");

    // The same tree fits exactly: the limits are of the whole tree on any number of threads.
    let species = pleach_weber_penn::preset("black_tupelo").unwrap();
    let tree = species.grow(3).unwrap();
    let exact = Limits {
        stems: tree.stems.len(),
        leaves: tree.leaves.len() + tree.blossoms.len(),
        knots: tree.knots.len(),
        ..Limits::default()
    };
    let growth = Growth { limits: exact, parallel: true, ..Growth::seed(3) };
    assert!(species.grow_with(&growth).as_ref() == Ok(&tree), "a limit that is just met is met");
    let less = [
        Limits { stems: exact.stems - 1, ..exact },
        Limits { leaves: exact.leaves - 1, ..exact },
        Limits { knots: exact.knots - 1, ..exact },
    ];
    for limits in less {
        let refused = species.grow_with(&Growth { limits, ..growth });
        let alone = species.grow_with(&Growth { limits, parallel: false, ..growth });
        assert!(refused.is_err() && refused == alone, "{:?} and {:?}", refused.err(), alone.err());
    }
}
