//! Reference values for a likeness: those of other trees, and of the best ellipse, for the same goal.

use super::candidate::Candidate;
use super::found::{Reference, References};
use super::library::{Entry, Resemblance};
use crate::problem::FitProblem;
use pleach_silhouette::Bitmap;
use pleach_silhouette::score::best_ellipse;
use pleach_silhouette::score::likeness::Likeness;

impl References {
    /// Reference values for the goals of `problem` from those of each candidate's trees. `named` is the candidate
    /// that the goals look like, and `trees` are pictures of it, view by view.
    pub(super) fn new(
        problem: &FitProblem,
        candidates: &[Candidate],
        by_candidate: &[Vec<Reference>],
        named: Option<usize>,
        trees: &[Vec<Bitmap>],
    ) -> Self {
        let others: Vec<Reference> = (0..candidates.len())
            .filter(|&candidate| Some(candidate) != named)
            .filter_map(|candidate| mean(by_candidate[candidate].iter().copied()))
            .collect();
        let pairs = (0..trees.len()).flat_map(|a| (a + 1..trees.len()).map(move |b| (a, b)));
        let same_species = mean(pairs.filter_map(|(a, b)| compare(&trees[a], &trees[b])));
        let ellipses: Vec<Bitmap> = problem.goals.iter().map(|goal| best_ellipse(&goal.goal)).collect();
        let goals: Vec<Bitmap> = problem.goals.iter().map(|goal| goal.goal.clone()).collect();
        Self {
            species: named.map(|candidate| candidates[candidate].species.name.clone()),
            same_species,
            other_species: median(&others),
            best_ellipse: compare(&ellipses, &goals).unwrap_or(Reference { likeness: 0.0, iou: 0.0 }),
        }
    }
}

/// Likeness and overlap of the unvaried trees of each of `count` candidates.
pub(super) fn by_candidate(
    count: usize,
    entries: &[Entry],
    found: &[Option<Resemblance>],
) -> Vec<Vec<Reference>> {
    let mut lists = vec![Vec::new(); count];
    for (Entry { sample, .. }, found) in entries.iter().zip(found) {
        if let (true, Some(one)) = (sample.is_species, found) {
            lists[sample.candidate].push(Reference { likeness: one.likeness, iou: one.iou });
        }
    }
    lists
}

/// The mean over views.
fn compare(one: &[Bitmap], other: &[Bitmap]) -> Option<Reference> {
    mean(one.iter().zip(other).map(|(a, b)| {
        let both = a.intersection(b);
        let either = a.ink() + b.ink() - both;
        let iou = if either == 0 { 1.0 } else { both as f64 / either as f64 };
        Reference { likeness: Likeness::between(a, b).value(), iou }
    }))
}

fn mean(of: impl Iterator<Item = Reference>) -> Option<Reference> {
    let (mut sum, mut count) = (Reference { likeness: 0.0, iou: 0.0 }, 0.0);
    for one in of {
        sum.likeness += one.likeness;
        sum.iou += one.iou;
        count += 1.0;
    }
    (count > 0.0).then(|| Reference { likeness: sum.likeness / count, iou: sum.iou / count })
}

/// The median of each number.
fn median(of: &[Reference]) -> Option<Reference> {
    let middle = |number: fn(&Reference) -> f64| {
        let mut sorted: Vec<f64> = of.iter().map(number).collect();
        sorted.sort_by(f64::total_cmp);
        let half = sorted.len() / 2;
        if sorted.len() % 2 == 1 { sorted[half] } else { sorted[half - 1].midpoint(sorted[half]) }
    };
    (!of.is_empty()).then(|| Reference { likeness: middle(|one| one.likeness), iou: middle(|one| one.iou) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_and_medians() {
        let list = [0.1, 0.4, 0.2, 0.9].map(|likeness| Reference { likeness, iou: 1.0 - likeness });
        let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
        let middle = median(&list).unwrap();
        assert!(near(middle.likeness, 0.3) && near(middle.iou, 0.7), "{middle:?}");
        assert_eq!(median(&list[..3]), Some(list[2]));
        assert_eq!((median(&[]), mean(std::iter::empty())), (None, None));
        assert!(near(mean(list.into_iter()).unwrap().likeness, 0.4));
    }
}
