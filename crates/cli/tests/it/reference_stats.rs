//! Our trees against those that the reference generator grew, species by species.
//!
//! `data/reference_stats.csv` was measured on the public Blender add-on, ten seeds a species (three
//! of the willow). The two draw other random numbers, so means are compared: within 10 %, or within
//! two standard errors of the difference.

use pleach_tree::TreeStats;
use std::collections::BTreeMap;

const SEEDS: std::ops::RangeInclusive<u64> = 1..=20;

/// Figures that may differ by more, and why: species, the beginning of the figure's name, how much.
const EXCEPTIONS: &[(&str, &str, f64, &str)] = &[(
    "weeping_willow",
    "",
    0.25,
    "only three reference trees, whose scales (13.5, 12.5 and 15.6 m for 15 ± 3) are 7 % below the mean: \
     every length follows, and radii by the power 1.2 a level",
)];

#[derive(Default)]
struct Sample(Vec<f64>);

impl Sample {
    fn mean(&self) -> f64 {
        self.0.iter().sum::<f64>() / self.0.len() as f64
    }

    /// Squared standard error of the mean.
    fn error2(&self) -> f64 {
        let (n, mean) = (self.0.len() as f64, self.mean());
        self.0.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0) / n
    }
}

type Figures = BTreeMap<String, Sample>;

fn reference() -> BTreeMap<String, Figures> {
    let path = pleach_tests::root().join("tests/data/reference_stats.csv");
    let mut reader = csv::Reader::from_path(path).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let mut species: BTreeMap<String, Figures> = BTreeMap::new();
    for row in reader.records() {
        let row = row.unwrap();
        let figures = species.entry(row[0].to_owned()).or_default();
        for (name, value) in names.iter().zip(&row).skip(3) {
            figures.entry(name.clone()).or_default().0.push(value.parse().unwrap());
        }
    }
    species
}

fn ours(name: &str) -> Figures {
    let species = pleach_generators::species(name).unwrap();
    let mut figures = Figures::new();
    for seed in SEEDS {
        let stats = TreeStats::new(&species.grow(seed).unwrap());
        let mut add = |name: String, value: f64| figures.entry(name).or_default().0.push(value);
        for level in 0..4 {
            let get = |list: &[f64]| list.get(level).copied().unwrap_or(0.0);
            add(format!("stems_l{level}"), stats.stems.get(level).map_or(0.0, |&n| n as f64));
            add(format!("length_mean_l{level}"), get(&stats.length_mean_m));
            add(format!("radius_mean_l{level}"), get(&stats.radius_mean_m));
        }
        add("leaves".to_owned(), stats.leaves as f64);
        add("blossoms".to_owned(), stats.blossoms as f64);
        add("height".to_owned(), stats.height_m);
        add("crown_width_x".to_owned(), stats.crown_width_x_m);
        add("crown_width_y".to_owned(), stats.crown_width_y_m);
        add("lowest_branch_z".to_owned(), stats.lowest_branch_m);
        add("leaf_area".to_owned(), stats.leaf_area_m2);
    }
    figures
}

#[test]
fn fifteen_species_have_the_reference_statistics() {
    let reference = reference();
    assert_eq!(reference.len(), 15);
    let mut wrong = Vec::new();
    for (name, expected) in &reference {
        let found = ours(name);
        for (figure, expected) in expected {
            let found = &found[figure];
            let (mean, aim) = (found.mean(), expected.mean());
            if mean == aim {
                continue;
            }
            let relative = (mean - aim).abs() / aim.abs().max(1e-12);
            let errors = (mean - aim).abs() / (found.error2() + expected.error2()).sqrt();
            let excepted = EXCEPTIONS
                .iter()
                .any(|(s, f, most, _)| s == name && figure.starts_with(f) && relative <= *most);
            if relative > 0.10 && errors > 2.0 && !excepted {
                wrong.push(format!(
                    "{name} {figure}: {mean:.4}, reference {aim:.4}, off by {errors:.1} standard errors"
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
