//! Counting ahead gives up the trees that would be given up anyway, and no others.

use pleach_tree::conformance::list_within;
use pleach_tree::{
    CheckedParams, Draw, Foliage, Generator as _, GrowError, Growth, Individual, Limits, StemPath, Tree,
    Workspace,
};
use pleach_weber_penn::{HEWITT_2017, WeberPenn, preset, space};

/// The tree, or what there was of it when it was given up, with the error.
fn try_to_grow(params: &CheckedParams, growth: &Growth) -> (Tree, Result<(), GrowError>) {
    let mut tree = Tree::default();
    let grown = WeberPenn::default().grow(params, growth, &mut Workspace::default(), &mut tree);
    (tree, grown)
}

fn grow(params: &CheckedParams, growth: &Growth) -> Result<Tree, GrowError> {
    let (tree, grown) = try_to_grow(params, growth);
    grown.map(|()| tree)
}

#[test]
fn the_same_trees_grow() {
    let (mut grown, mut refused) = (0, 0);
    for case in 0..400 {
        let params = space().check(list_within(space(), case)).unwrap();
        let part = 1 + case % 7;
        let limits = Limits {
            stems: 3000 / part as usize,
            leaves: 20_000 / (1 + (case / 7) % 5) as usize,
            knots: 30_000 / (1 + (case / 3) % 4) as usize,
            work: 500_000,
        };
        let foliage = if case % 3 == 0 { Foliage::None } else { Foliage::All };
        let growth = Growth { limits, foliage, ..Growth::seed(case) };
        let (whole, ahead) =
            (grow(&params, &growth), grow(&params, &Growth { counts_ahead: true, ..growth }));
        match (whole, ahead) {
            (Ok(whole), Ok(ahead)) => {
                assert!(whole == ahead, "case {case}: another tree");
                grown += 1;
            }
            (Err(_), Err(_)) => refused += 1,
            (whole, ahead) => panic!("case {case}: {:?}, counted ahead {:?}", whole.err(), ahead.err()),
        }
    }
    assert!(grown > 30 && refused > 100, "{grown} grew, {refused} did not");
}

#[test]
fn a_limit_that_is_just_met_is_met() {
    for name in HEWITT_2017 {
        let species = preset(name).unwrap();
        let mut individual = Individual::default();
        individual.set(StemPath::trunk(0), Draw { length: 1.1, ..Draw::OWN });
        let draws = individual.draws();
        let growth = Growth { draws: Some(&draws), ..Growth::seed(2) };
        let tree = grow(&species.params, &growth).unwrap();
        let exact = Limits {
            stems: tree.stems.len(),
            leaves: tree.leaves.len() + tree.blossoms.len(),
            knots: tree.knots.len(),
            work: least_work(&species.params, &growth),
        };
        let growth = Growth { limits: exact, counts_ahead: true, ..growth };
        assert!(grow(&species.params, &growth).as_ref() == Ok(&tree), "{name}");
        let less = [
            Limits { stems: exact.stems - 1, ..exact },
            Limits { leaves: exact.leaves.saturating_sub(1), ..exact },
            Limits { knots: exact.knots - 1, ..exact },
            Limits { work: exact.work - 1, ..exact },
        ];
        for limits in less.into_iter().filter(|&limits| limits != exact) {
            assert!(grow(&species.params, &Growth { limits, ..growth }).is_err(), "{name} within {limits:?}");
        }
    }
}

/// The least work within which the tree grows.
fn least_work(params: &CheckedParams, growth: &Growth) -> u64 {
    let (mut too_little, mut enough) = (0, Limits::DEFAULT.work);
    while enough - too_little > 1 {
        let work = too_little.midpoint(enough);
        let limits = Limits { work, ..Limits::DEFAULT };
        if grow(params, &Growth { limits, ..*growth }).is_ok() { enough = work } else { too_little = work }
    }
    enough
}

#[test]
fn what_is_too_large_is_given_up_early() {
    for name in HEWITT_2017 {
        let species = preset(name).unwrap();
        let slot = space().select("prune_ratio").unwrap()[0].index();
        let mut values = species.params.values().to_vec();
        values[slot] = 0.0;
        let params = space().check(values).unwrap();
        let stems = grow(&params, &Growth::seed(1)).unwrap().stems.len();
        let growth = Growth { limits: Limits { stems: stems * 3 / 4, ..Limits::DEFAULT }, ..Growth::seed(1) };
        let (whole, error) = try_to_grow(&params, &growth);
        let (ahead, sooner) = try_to_grow(&params, &Growth { counts_ahead: true, ..growth });
        assert!(error.is_err() && sooner.is_err(), "{name}");
        if whole.stems.len() > 200 {
            let (grown, most) = (ahead.stems.len(), whole.stems.len() / 2);
            assert!(grown < most, "{name}: {grown} stems were grown, {} without counting", whole.stems.len());
        }
    }
}
