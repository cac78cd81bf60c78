//! The cost of a comparison of silhouettes.

use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The cost of a silhouette, as one number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Objective {
    /// Share of pixels that differ: the dissertation's fitness (Hewitt 2017, §3.3.2). An empty
    /// picture does well on it.
    Accuracy,
    /// 1 − intersection over union of the ink.
    Iou,
    /// 1 − a weighted mean of the intersections over unions of the ink at the goal's pixels and in
    /// cells of 2 to 32 pixels: a crown in the right place counts before its twigs are.
    Blend,
    /// 1 − likeness: crown, outline, strokes and gaps, not twigs in their places; see
    /// [`pleach_silhouette::score::likeness`].
    Likeness,
    /// The mean of [`Objective::Blend`] and [`Objective::Likeness`]: ink in its place, on what looks
    /// like a tree of the kind. What fits best: chosen by experiment on goals of other seeds.
    #[default]
    Balance,
    /// 1 − the mean of the overlaps of [`Objective::Iou`] and [`Objective::Blend`], of trees whose likeness is at
    /// least 0.765; where it is less, more: ink on ink, as far as that goes with what looks like a tree of the kind.
    /// The blend guides a search from far away: the default of searches over rules.
    Overlap,
}

/// An unknown name of an objective.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown objective `{given}`, known are {}", Objective::ALL.map(Objective::name).join(", "))]
pub struct UnknownObjective {
    /// What was given.
    pub given: String,
}

impl Objective {
    /// All objectives.
    pub const ALL: [Self; 6] =
        [Self::Balance, Self::Overlap, Self::Blend, Self::Likeness, Self::Iou, Self::Accuracy];

    /// The name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Accuracy => "accuracy",
            Self::Iou => "iou",
            Self::Blend => "blend",
            Self::Likeness => "likeness",
            Self::Balance => "balance",
            Self::Overlap => "overlap",
        }
    }
}

impl Objective {
    /// Whether it depends on likeness.
    pub(crate) const fn uses_likeness(self) -> bool {
        matches!(self, Self::Likeness | Self::Balance | Self::Overlap)
    }
}

impl fmt::Display for Objective {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Objective {
    type Err = UnknownObjective;

    fn from_str(given: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|objective| objective.name() == given)
            .ok_or_else(|| UnknownObjective { given: given.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_and_others_are_told_which_there_are() {
        for objective in Objective::ALL {
            assert_eq!(objective.to_string().parse(), Ok(objective));
        }
        let message = "likenes".parse::<Objective>().unwrap_err().to_string();
        assert_eq!(
            message,
            "unknown objective `likenes`, known are balance, overlap, blend, likeness, iou, accuracy"
        );
    }
}
