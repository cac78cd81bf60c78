use super::*;
use crate::testing::{fifteen, species, uniform};
use pleach_tree::TreeStats;
use rayon::prelude::*;
use std::sync::OnceLock;

fn map() -> &'static BlendMap {
    static MAP: OnceLock<BlendMap> = OnceLock::new();
    MAP.get_or_init(|| BlendMap::new(fifteen(), Settings::default()).unwrap())
}

fn raw() -> BlendMap {
    BlendMap::new(fifteen(), Settings { features: Encoding::Raw, dots: None }).unwrap()
}

/// Random points in the hull.
fn inside(count: usize) -> Vec<Point> {
    let dots = map().dots();
    let reach = dots.iter().fold(0.0_f64, |r, d| r.max(d.x.abs()).max(d.y.abs()));
    let mut draws = uniform(1);
    let mut draw = || (2.0 * draws.next().unwrap() - 1.0) * reach;
    let points = std::iter::repeat_with(|| Point { x: draw(), y: draw() });
    points.filter(|p| map().hull().contains(*p)).take(count).collect()
}

#[test]
fn landmarks_are_exact_and_located_at_their_dots() {
    for (species, &dot) in map().landmarks().species().iter().zip(map().dots()) {
        let blend = map().at(dot).unwrap();
        assert_eq!(blend.params, species.params, "{}", species.name);
        assert!(!blend.is_extrapolated());
        assert!(map().locate(species).distance(dot) < 1e-12);
    }
}

#[test]
fn raw_dots_are_not_exact() {
    let raw = raw();
    let exact = raw
        .landmarks()
        .species()
        .iter()
        .zip(raw.dots())
        .filter(|(s, d)| raw.at(**d).unwrap().params == s.params);
    assert_eq!(exact.count(), 0, "two axes of the plain list do not hold a species");
}

#[test]
fn the_blend_is_the_back_projection_and_the_interpolated_residual() {
    let map = map();
    for point in inside(20) {
        let (weights, _) = map.natural.weights(point);
        let average = map.landmarks.average(&weights);
        let back = map.pca.back(&[point.x, point.y]);
        for (f, average) in average.iter().enumerate() {
            let codes = map.landmarks.codes();
            if codes.iter().any(|c| c.values[f].is_none()) {
                continue;
            }
            let residual: f64 = weights
                .present()
                .map(|(l, w)| {
                    let held = map.pca.back(&[map.dots[l].x, map.dots[l].y])[f];
                    w * (codes[l].values[f].unwrap() - held)
                })
                .sum();
            assert!((average.unwrap() - back[f] - residual).abs() < 1e-5);
        }
    }
}

#[test]
fn explained_variance_sums_to_one_and_falls() {
    let explained = map().pca().explained();
    assert_eq!(explained.len(), 14);
    assert!((explained.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    assert!(explained.windows(2).all(|pair| pair[0] >= pair[1]));
}

#[test]
fn trees_inside_the_hull_grow_and_are_not_degenerate() {
    let heights = |species: &Species| TreeStats::new(&species.grow(1).unwrap());
    let known: Vec<TreeStats> = map().landmarks().species().iter().map(heights).collect();
    let range = |of: fn(&TreeStats) -> f64| {
        known.iter().map(of).fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)))
    };
    let (low, high) = range(|s| s.height_m);
    let most_stems = range(|s| s.stems.iter().sum::<usize>() as f64).1;
    inside(200).par_iter().for_each(|&point| {
        let species = map().species_at(&map().at(point).unwrap(), "mix");
        let stats = TreeStats::new(&species.grow(1).unwrap_or_else(|e| panic!("{point:?}: {e}")));
        assert!((0.5 * low..2.0 * high).contains(&stats.height_m), "{point:?}: {} m", stats.height_m);
        let stems = stats.stems.iter().sum::<usize>() as f64;
        assert!((5.0..3.0 * most_stems).contains(&stems), "{point:?}: {stems} stems");
        assert!(stats.leaves + stats.blossoms > 100, "{point:?}");
    });
}

#[test]
fn outside_says_so_and_still_is_valid() {
    let map = map();
    for dot in map.dots() {
        let blend = map.at(*dot * 3.0).unwrap();
        if blend.is_extrapolated() {
            map.species_at(&blend, "far").grow(1).unwrap();
        }
    }
    let far = map.at(Point { x: 50.0, y: 0.0 }).unwrap();
    assert!(far.is_extrapolated() && far.outside > 40.0);
    assert!(map.landmarks().space().check(far.params.values().to_vec()).is_ok());
    assert!(map.at(Point { x: f64::NAN, y: 0.0 }).is_err());
}

#[test]
fn a_given_layout_is_kept_and_exact() {
    let dots: Vec<Point> = (0..15).map(|i| Point { x: f64::from(i % 4), y: f64::from(i / 4) }).collect();
    let settings = Settings { dots: Some(dots.clone()), ..Settings::default() };
    let map = BlendMap::new(fifteen(), settings).unwrap();
    for (species, &dot) in map.landmarks().species().iter().zip(&dots) {
        assert_eq!(map.at(dot).unwrap().params, species.params, "{}", species.name);
        assert_eq!(map.locate(species), dot);
    }
}

#[test]
fn two_species_make_a_line() {
    let map = BlendMap::new(vec![species("palm"), species("acer")], Settings::default()).unwrap();
    assert_eq!(map.pca().explained(), [1.0]);
    assert!(map.hull().is_flat());
    let middle = map.at(map.between(0, 1, 0.5).unwrap()).unwrap();
    assert!((middle.weights.values()[0] - 0.5).abs() < 1e-12);
    assert_eq!(map.between(0, 1, -0.1), Err(BlendError::NotBetween { at: -0.1 }));
}

#[test]
fn explained_variance_of_the_fifteen_agrees_with_numpy() {
    // The codes of the fifteen written to a file, NaN where missing, then with numpy 2.4.6:
    //   x = np.where(np.isnan(x), np.nanmean(x, axis=0), x); x = np.nan_to_num(x); x -= x.mean(0)
    //   s = np.linalg.svd(x, compute_uv=False); (s**2 / sum(s**2))[:14]
    // The columns that are missing throughout are nan in the mean, and 0 after the second step.
    let numpy = [
        0.1859150105939151,
        0.13947134314670856,
        0.10992261030764548,
        0.09911003402582715,
        0.08372548673926326,
        0.07249745007657893,
        0.06912709258331058,
        0.058974846387619344,
        0.04769955879560327,
        0.04214680531957484,
        0.030796428641217052,
        0.023869549558377372,
        0.022567156908829343,
        0.014176626915529612,
    ];
    for (ours, theirs) in map().pca().explained().iter().zip(numpy) {
        assert!((ours - theirs).abs() < 1e-10, "{ours} is not {theirs}");
    }
}
