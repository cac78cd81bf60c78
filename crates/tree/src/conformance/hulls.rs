//! Promises about crowns that grow into hulls.

use super::{SEED, all, read};
use crate::growth::Growth;
use crate::param::Problem;
use crate::species::{Family, Species, SpeciesDoc};
use pleach_plant::{DENSEST, Hull, HullView, Individual, Tree};

/// A hull to the right of the trunk, seen a little from aside.
fn aside() -> Hull {
    let row = |is_in: bool| vec![if is_in { DENSEST } else { 0 }; 8];
    let rows = (0..20).map(|row_number| row((7..18).contains(&row_number))).collect();
    let view = HullView { azimuth: 20.0_f64.to_radians(), cell: 0.05, left: 0.0, rows };
    Hull { views: vec![view], trunk: vec![[0.0, 0.0], [0.01, 0.1], [0.05, 0.3]], seed: 5 }
}

fn grown(species: &Species, growth: &Growth<'_>) -> Tree {
    species.grow_with(growth).unwrap_or_else(|error| panic!("{} grows: {error}", species.name))
}

/// The part of the branches' knots that is not in the hull.
fn outside(tree: &Tree, hull: &Hull, height: f64) -> f64 {
    let branches = tree.stems.iter().filter(|stem| stem.level > 0);
    let (mut all, mut out) = (0.0_f64, 0.0);
    for knot in branches.flat_map(|stem| tree.knots_of(stem)) {
        all += 1.0;
        out += f64::from(hull.density(knot.point / height) == 0.0);
    }
    out / all.max(1.0)
}

/// Where a family has a [`hull_height`](crate::Generator::hull_height), the individual with a hull lies more in it than
/// the free tree does, is the same on any number of threads and from its file, and other seeds are of the kind. Other
/// families refuse such files.
///
/// # Panics
/// If the promise is broken.
pub fn crowns_grow_into_hulls(family: &dyn Family) {
    for species in all(family) {
        let (name, hull) = (&species.name, aside());
        let one = species.with_individual(SEED, Individual::with_hull(hull.clone()));
        let text = one.to_toml(&[]);
        let Some(height) = species.generator.hull_height(species.params.values()) else {
            let error = SpeciesDoc::parse("again.toml", &text).and_then(|doc| doc.species(family));
            let error = error.expect_err("refused");
            let is_told = |problem: &Problem| problem.to_string().contains("a crown to fill");
            assert!(error.issues.iter().any(|issue| is_told(&issue.problem)), "{name}: {error}");
            continue;
        };
        let again = read(family, &text);
        assert_eq!(again.to_toml(&[]), text, "{name}");
        let (free, tree) = (grown(&species, &Growth::seed(SEED)), grown(&one, &Growth::seed(SEED)));
        assert_eq!(tree.well_formed(), Ok(()), "{name}");
        assert!(grown(&again, &Growth::seed(SEED)) == tree, "{name}: the same individual");
        let parallel = Growth { parallel: true, ..Growth::seed(SEED) };
        assert!(grown(&one, &parallel) == tree, "{name}: threads change nothing");
        let other = Growth::seed(SEED + 1);
        assert!(grown(&one, &other) == grown(&species, &other), "{name}: other seeds are of the kind");
        let [before, after] = [&free, &tree].map(|tree| outside(tree, &hull, height));
        assert!(after < before || before == 0.0, "{name}: {after} is outside, {before} of the free tree");
    }
}
