//! How good trees look to a person, and how well numbers agree with that.

use anyhow::{Context, bail};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// The best that a person can say; 0 is the worst.
const BEST: f64 = 5.0;

/// What a person says of the trees of a picture: 0 to 5, empty where one was not looked at.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub(super) struct Eye {
    pub(super) picture: String,
    /// Of the kind's own tree.
    pub(super) kind: Option<f64>,
    /// Of this very tree.
    pub(super) tree: Option<f64>,
}

/// Where they are kept.
pub(super) fn path(folder: &Path) -> PathBuf {
    folder.join("eye.csv")
}

/// What a person said of pictures called `names`; empty if nothing was written down.
pub(super) fn read(folder: &Path, names: &[String]) -> anyhow::Result<Vec<Eye>> {
    let path = path(folder);
    if !path.exists() {
        return Ok(Vec::new());
    }
    let unreadable = || format!("cannot use {}", path.display());
    let mut csv = csv::Reader::from_path(&path).with_context(unreadable)?;
    let said = csv.deserialize().collect::<Result<Vec<Eye>, _>>().with_context(unreadable)?;
    for eye in &said {
        let place = || format!("{}: {}", path.display(), pleach_tree::param::shown(&eye.picture));
        if !names.contains(&eye.picture) {
            bail!("{} is not a picture of the experiment", place());
        }
        if let Some(wrong) =
            [eye.kind, eye.tree].into_iter().flatten().find(|score| !(0.0..=BEST).contains(score))
        {
            bail!("{} has the score {wrong}, expected a number from 0 to {BEST}", place());
        }
    }
    Ok(said)
}

/// Spearman's rank correlation of pairs, in -1..=1, equal values with the mean of their ranks; `None` of less than
/// three pairs, or where all values of one side are equal.
pub(super) fn spearman(pairs: &[(f64, f64)]) -> Option<f64> {
    if pairs.len() < 3 {
        return None;
    }
    let a = ranks(&pairs.iter().map(|pair| pair.0).collect::<Vec<_>>());
    let b = ranks(&pairs.iter().map(|pair| pair.1).collect::<Vec<_>>());
    // Ties leave the mean of ranks as it is.
    let mean = (pairs.len() - 1) as f64 / 2.0;
    let product =
        |x: &[f64], y: &[f64]| -> f64 { x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum() };
    let spread = (product(&a, &a) * product(&b, &b)).sqrt();
    (spread > 0.0).then(|| product(&a, &b) / spread)
}

/// The place of each value among all, from 0.
fn ranks(values: &[f64]) -> Vec<f64> {
    let rank = |value: &f64| {
        let lower = values.iter().filter(|other| *other < value).count();
        let equal = values.iter().filter(|other| *other == value).count();
        lower as f64 + (equal - 1) as f64 / 2.0
    };
    values.iter().map(rank).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_agree_whatever_the_scale() {
        let with = |b: [f64; 5]| spearman(&[1.0, 2.0, 3.0, 4.0, 5.0].into_iter().zip(b).collect::<Vec<_>>());
        assert_eq!(with([0.1, 0.2, 5.0, 7.0, 100.0]), Some(1.0));
        assert_eq!(with([9.0, 8.0, 2.0, 1.0, 0.0]), Some(-1.0));
        // By hand: ranks 0.5, 0.5, 2, 3.5, 3.5.
        assert!((with([1.0, 1.0, 2.0, 3.0, 3.0]).unwrap() - 9.0 / 90.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(with([1.0; 5]), None);
        assert_eq!(spearman(&[(0.0, 1.0), (1.0, 2.0)]), None);
    }

    #[test]
    fn scores_of_unknown_pictures_and_beyond_the_scale_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let names = ["oak".to_owned(), "elm".to_owned()];
        let read = |text: &str| {
            std::fs::write(path(folder.path()), text).unwrap();
            read(folder.path(), &names).map_err(|error| format!("{error:#}"))
        };
        let said = read("picture,kind,tree\noak,3,4.5\nelm,,2\n").unwrap();
        let eye = |picture: &str, kind, tree| Eye { picture: picture.to_owned(), kind, tree };
        assert_eq!(said, [eye("oak", Some(3.0), Some(4.5)), eye("elm", None, Some(2.0))]);
        assert!(read("picture,kind,tree\nash,3,4\n").unwrap_err().contains("ash is not a picture"));
        assert!(
            read("picture,kind,tree\noak,3,6\n").unwrap_err().contains("6, expected a number from 0 to 5")
        );
        assert!(read("picture,kind,looks\noak,3,3\n").unwrap_err().contains("looks"));
        std::fs::remove_file(path(folder.path())).unwrap();
        assert_eq!(super::read(folder.path(), &names).unwrap(), []);
    }
}
