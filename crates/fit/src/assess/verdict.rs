//! The verdict on a fit, in words.
//!
//! A likeness says little by itself: how like each other two trees of one species are depends on the species. So the
//! rule is the position of a fit between the likeness of another species' tree to the goal (0) and that of two trees
//! of the goal's own species (1), see [`crate::References`]:
//!
//! | where | verdict |
//! | --- | --- |
//! | from [`OF_ITS_KIND`] | of its kind |
//! | from [`ROUGHLY`] | roughly of its kind |
//! | from [`NOT_AT_ALL`] | not of its kind |
//! | below | no more like the goal than another species |
//!
//! What counts is the likeness of fresh seeds: parameters are of a kind if all their trees are.
//!
//! Pictures of real trees have no species to compare with, and a likeness says little about them. There the rule is how
//! far trees are from the picture, [`Verdict::with_distance`]: their cost, of which the measures of the picture are a
//! part, and the distance of these measures once more. Its edges were chosen on kinds that a person had scored.

use crate::guess::References;
use pleach_silhouette::score::Crown;
use pleach_tree::math;
use serde::Serialize;
use std::fmt;

/// From here on a fit is of its kind: within the accuracy of the mean over a few pairs of trees.
const OF_ITS_KIND: f64 = 0.85;
/// From here on it is so roughly: nearer to the kind than to other species.
const ROUGHLY: f64 = 0.5;
/// Below it, it might as well be a tree of another species.
const NOT_AT_ALL: f64 = 0.1;
/// Minimum difference of likeness between 0 and 1 of the rule: where two trees of a species are no more alike than
/// two of any, the rule would divide by zero.
pub const MIN_VERDICT_SPAN: f64 = 0.05;

/// Up to these distances from a picture a tree is of its kind, roughly of its kind, and not of its kind.
///
/// Of 78 kinds of 24 pictures, scored from 0 to 5 by eye, those with 4 and more were all below 0.48 and those with 1 and
/// less all above 0.55.
const DISTANCES: [f64; 3] = [0.42, 0.53, 0.62];

/// A crown is too wide, or its tree too tall, from this factor on, and too narrow from its inverse.
const SIZE_OFF: f64 = 1.1;
/// Ink in the box around the tree, as a factor of the goal's, from which a tree is too dense.
const DENSITY_OFF: f64 = 1.15;
/// By this part of the goal's height the crown begins too high or too low.
const BARE_OFF: f64 = 0.08;

/// Whether trees are of the goal's kind, from the best to the worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum KindVerdict {
    /// As like the goal as two trees of one species are.
    OfItsKind,
    /// Nearer to that than to another species.
    Roughly,
    /// Nearer to another species.
    NotOfItsKind,
    /// No more like the goal than another species.
    NoMoreThanAnother,
}

/// The largest mismatch between the shapes of a fit and its goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mismatch {
    /// The tree is wider than the goal.
    TooWide,
    /// It is narrower.
    TooNarrow,
    /// It is taller.
    TooTall,
    /// It is lower.
    TooLow,
    /// It has more ink in its box.
    TooDense,
    /// It has less.
    TooSparse,
    /// Its trunk is bare to a greater height.
    StartsTooHigh,
    /// Its trunk is bare to a lesser height.
    StartsTooLow,
}

/// The verdict on a fit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Verdict {
    /// Whether the trees of its parameters are of the goal's kind.
    pub kind: KindVerdict,
    /// Whether the fitted tree itself is: with a lucky seed, it is better.
    pub tree: KindVerdict,
    /// Position of the likeness of `kind`'s trees, between another species (0) and two trees of one species (1).
    pub share: f64,
    /// Of a picture in colour: how far the trees of `kind` are from it, in 0..=2, which decides; 0 is best. `None` of a
    /// silhouette.
    pub distance: Option<f64>,
    /// The largest mismatch of the fitted tree's shape, if there is one.
    pub off: Option<Mismatch>,
}

impl KindVerdict {
    /// The verdict on a likeness at `share`: see the rule above.
    #[must_use]
    pub fn from_share(share: f64) -> Self {
        if share >= OF_ITS_KIND {
            Self::OfItsKind
        } else if share >= ROUGHLY {
            Self::Roughly
        } else if share >= NOT_AT_ALL {
            Self::NotOfItsKind
        } else {
            Self::NoMoreThanAnother
        }
    }

    /// The verdict on trees at `distance` from a picture of a real tree.
    #[must_use]
    pub fn from_distance(distance: f64) -> Self {
        let kinds = [Self::OfItsKind, Self::Roughly, Self::NotOfItsKind];
        let is_near = |edge: &f64| distance <= *edge;
        DISTANCES.iter().position(is_near).map_or(Self::NoMoreThanAnother, |place| kinds[place])
    }

    /// What the verdict on a picture in colour says: of the kinds that chose [`DISTANCES`] a person would have kept
    /// seven in ten of the first, three in ten of the second and fewer of the others.
    const fn words_of_distance(self) -> &'static str {
        match self {
            Self::OfItsKind => "of its kind: most trees as near to their picture are worth keeping",
            Self::Roughly => "roughly of its kind: some trees as near to their picture are worth keeping",
            Self::NotOfItsKind => "not of its kind: few trees as far from their picture are worth keeping",
            Self::NoMoreThanAnother => "not of its kind: it is far from the picture",
        }
    }
}

impl fmt::Display for KindVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::OfItsKind => "of its kind: as like the goal as two trees of one species are",
            Self::Roughly => "roughly of its kind: more like the goal than another species is",
            Self::NotOfItsKind => "not of its kind: little more like the goal than another species",
            Self::NoMoreThanAnother => "no more like the goal than another species",
        })
    }
}

impl Mismatch {
    /// The largest mismatch between `crown` and `goal`, each relative to its tolerance, if it exceeds that.
    #[must_use]
    pub fn new(crown: &Crown, goal: &Crown) -> Option<Self> {
        let factor = |a: f64, b: f64, most: f64| {
            if a > 0.0 && b > 0.0 { math::ln(a / b) / math::ln(most) } else { 0.0 }
        };
        let density = |crown: &Crown| crown.ink / (crown.width * crown.height).max(1e-9);
        let bare = |crown: &Crown| crown.bare_height / crown.height.max(1e-9);
        let measured = [
            (factor(crown.width, goal.width, SIZE_OFF), Self::TooWide, Self::TooNarrow),
            (factor(crown.height, goal.height, SIZE_OFF), Self::TooTall, Self::TooLow),
            (factor(density(crown), density(goal), DENSITY_OFF), Self::TooDense, Self::TooSparse),
            ((bare(crown) - bare(goal)) / BARE_OFF, Self::StartsTooHigh, Self::StartsTooLow),
        ];
        let worst = measured.into_iter().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
        (worst.0.abs() >= 1.0).then_some(if worst.0 > 0.0 { worst.1 } else { worst.2 })
    }
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TooWide => "the crown is too wide",
            Self::TooNarrow => "the crown is too narrow",
            Self::TooTall => "the tree is too tall",
            Self::TooLow => "the tree is too low",
            Self::TooDense => "the crown is too dense",
            Self::TooSparse => "the crown is too sparse",
            Self::StartsTooHigh => "the crown starts too high",
            Self::StartsTooLow => "the crown starts too low",
        })
    }
}

impl Verdict {
    /// The verdict on a fit whose tree has a likeness of `tree` to the goal, and trees of other seeds a mean of
    /// `fresh`, `None` if there are none. `None` without a species to compare with.
    #[must_use]
    pub fn new(
        tree: f64,
        fresh: Option<f64>,
        references: &References,
        crown: &Crown,
        goal: &Crown,
    ) -> Option<Self> {
        let one = references.same_species?.likeness;
        let other = references.other_species.unwrap_or(references.best_ellipse).likeness;
        let share = |likeness: f64| (likeness - other) / (one - other).max(MIN_VERDICT_SPAN);
        let of_kind = share(fresh.unwrap_or(tree));
        Some(Self {
            kind: KindVerdict::from_share(of_kind),
            tree: KindVerdict::from_share(share(tree)),
            share: of_kind,
            distance: None,
            off: Mismatch::new(crown, goal),
        })
    }
}

impl Verdict {
    /// The verdict on a picture in colour, from which the trees of the kind are `kind` far and the fitted tree itself is
    /// `tree`: the cost by [`Objective::Balance`](crate::Objective::Balance) with the measures of the picture
    /// ([`MeasuredSilhouette`](crate::MeasuredSilhouette)), and the distance of the measures.
    #[must_use]
    pub fn with_distance(self, kind: f64, tree: f64) -> Self {
        let of = KindVerdict::from_distance;
        Self { kind: of(kind), tree: of(tree), distance: Some(kind), ..self }
    }

    /// The same, no better than `most`, for the kind and for the tree itself.
    #[must_use]
    pub fn at_most(self, most: KindVerdict) -> Self {
        Self { kind: self.kind.max(most), tree: self.tree.max(most), ..self }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.distance {
            Some(_) => f.write_str(self.kind.words_of_distance())?,
            None => write!(f, "{}", self.kind)?,
        }
        self.off.map_or(Ok(()), |off| write!(f, "; {off}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::guess::Reference;

    const CROWN: Crown = Crown { ink: 0.2, height: 0.9, width: 0.6, centroid_height: 0.5, bare_height: 0.2 };

    fn references(same: f64, other: f64) -> References {
        let reference = |likeness| Reference { likeness, iou: 0.5 };
        References {
            species: Some("acer".to_owned()),
            same_species: Some(reference(same)),
            other_species: Some(reference(other)),
            best_ellipse: reference(0.3),
        }
    }

    #[test]
    fn every_verdict_begins_at_its_edge() {
        let before = |edge: f64| edge.next_down();
        let cases = [
            (OF_ITS_KIND, KindVerdict::OfItsKind, KindVerdict::Roughly),
            (ROUGHLY, KindVerdict::Roughly, KindVerdict::NotOfItsKind),
            (NOT_AT_ALL, KindVerdict::NotOfItsKind, KindVerdict::NoMoreThanAnother),
        ];
        for (edge, at, below) in cases {
            assert_eq!((KindVerdict::from_share(edge), KindVerdict::from_share(before(edge))), (at, below));
        }
        assert_eq!(KindVerdict::from_share(7.0), KindVerdict::OfItsKind);
        assert_eq!(KindVerdict::from_share(-7.0), KindVerdict::NoMoreThanAnother);
    }

    #[test]
    fn fresh_seeds_decide_and_references_say_where() {
        let of = |tree, fresh, references: &References| Verdict::new(tree, fresh, references, &CROWN, &CROWN);
        let verdict = of(0.8, Some(0.55), &references(0.8, 0.3)).unwrap();
        assert_eq!(
            (verdict.kind, verdict.tree, verdict.off),
            (KindVerdict::Roughly, KindVerdict::OfItsKind, None)
        );
        assert!((verdict.share - 0.5).abs() < 1e-12);
        assert_eq!(of(0.8, None, &references(0.8, 0.3)).unwrap().kind, KindVerdict::OfItsKind);
        // The same likeness is worth less where trees of one species are more alike.
        assert_eq!(of(0.5, None, &references(0.9, 0.3)).unwrap().kind, KindVerdict::NotOfItsKind);
        // Two trees of the species are no more alike than others are.
        let odd = of(0.32, None, &references(0.2, 0.3)).unwrap();
        assert_eq!(odd.kind, KindVerdict::NotOfItsKind);
        let none = References { same_species: None, ..references(0.8, 0.3) };
        assert_eq!(of(0.8, None, &none), None);
    }

    #[test]
    fn pictures_in_colour_are_judged_by_distance() {
        let kinds = [KindVerdict::OfItsKind, KindVerdict::Roughly, KindVerdict::NotOfItsKind];
        for (edge, kind) in DISTANCES.into_iter().zip(kinds) {
            assert_eq!(KindVerdict::from_distance(edge), kind);
            assert!(KindVerdict::from_distance(edge.next_up()) > kind);
        }
        assert_eq!(KindVerdict::from_distance(f64::INFINITY), KindVerdict::NoMoreThanAnother);
        let alike = Verdict::new(0.8, Some(0.8), &references(0.8, 0.3), &CROWN, &CROWN).unwrap();
        let judged = alike.with_distance(0.5, 0.4);
        assert_eq!((judged.kind, judged.tree), (KindVerdict::Roughly, KindVerdict::OfItsKind));
        assert_eq!((judged.distance, judged.share), (Some(0.5), alike.share));
        // Another species is not what it was compared with.
        assert!(judged.to_string().starts_with("roughly of its kind: some trees as near"), "{judged}");
        assert!(alike.to_string().contains("two trees of one species"), "{alike}");
    }

    #[test]
    fn what_is_most_off_is_said_from_its_edge_on() {
        let off = |crown: Crown| Mismatch::new(&crown, &CROWN);
        assert_eq!(off(CROWN), None);
        let wide = |by: f64| Crown { width: by * CROWN.width, ink: by * CROWN.ink, ..CROWN };
        assert_eq!(off(wide(SIZE_OFF + 1e-9)), Some(Mismatch::TooWide));
        assert_eq!(off(wide(SIZE_OFF - 1e-9)), None);
        assert_eq!(off(wide(1.0 / SIZE_OFF - 1e-9)), Some(Mismatch::TooNarrow));
        let inked = |by: f64| Crown { ink: by * CROWN.ink, ..CROWN };
        assert_eq!(off(inked(DENSITY_OFF + 1e-9)), Some(Mismatch::TooDense));
        assert_eq!(off(inked(1.0 / DENSITY_OFF - 1e-9)), Some(Mismatch::TooSparse));
        assert_eq!(off(inked(DENSITY_OFF - 1e-9)), None);
        let bare = |by: f64| Crown { bare_height: CROWN.bare_height + by * CROWN.height, ..CROWN };
        assert_eq!(off(bare(BARE_OFF + 1e-9)), Some(Mismatch::StartsTooHigh));
        assert_eq!(off(bare(-BARE_OFF - 1e-9)), Some(Mismatch::StartsTooLow));
        // Twice the density weighs more than a width that is off by an eighth.
        assert_eq!(
            off(Crown { width: 1.125 * CROWN.width, ink: 0.5 * CROWN.ink, ..CROWN }),
            Some(Mismatch::TooSparse)
        );
        // Nothing drawn at all: no numbers, no nonsense.
        assert_eq!(Mismatch::new(&Crown::default(), &CROWN), Some(Mismatch::StartsTooLow));
    }
}
