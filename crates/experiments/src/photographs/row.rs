//! The rows of a picture.

use crate::measures::Measures;
use crate::record::Fixed;
use serde::{Deserialize, Serialize};

/// Which tree of a fit a row is about.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Which {
    /// The kind's own tree.
    #[default]
    Kind,
    /// The mean over trees of the kind of other seeds.
    Fresh,
    /// This very tree.
    Tree,
}

impl Which {
    pub(super) const ALL: [Self; 3] = [Self::Kind, Self::Fresh, Self::Tree];

    /// The word of the rows.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Kind => "kind",
            Self::Fresh => "fresh",
            Self::Tree => "tree",
        }
    }
}

/// A tree of the fit of a picture, or the mean over several: see [`Measures`]. What is not known is empty.
#[derive(Clone, Debug, Default, Deserialize, Serialize)]
pub(super) struct Row {
    pub(super) picture: String,
    pub(super) set: String,
    pub(super) which: Which,
    /// The family of the kind.
    pub(super) family: String,
    /// The species that the search started from.
    pub(super) species: String,
    /// The program's verdict on the kind, and on the kind's own tree.
    pub(super) kind_verdict: String,
    pub(super) tree_verdict: String,
    /// Where the likeness of fresh seeds is, from that of another species (0) to that of two trees of one (1).
    pub(super) share: Option<Fixed<3>>,
    /// Trees that the search has grown.
    pub(super) trees: u64,
    pub(super) iou: Fixed<4>,
    pub(super) crown_iou: Fixed<4>,
    pub(super) left_off: Fixed<4>,
    pub(super) right_off: Fixed<4>,
    pub(super) boundary_f: Fixed<4>,
    pub(super) crown_f: Fixed<4>,
    pub(super) likeness: Fixed<4>,
    pub(super) width: Fixed<3>,
    pub(super) trunk: Option<Fixed<3>>,
    pub(super) lean_off: Option<Fixed<1>>,
    pub(super) same_feet: Fixed<3>,
    pub(super) fork_off: Option<Fixed<3>>,
    /// Intersection over union of the goal and the best single ellipse.
    pub(super) best_ellipse_iou: Fixed<4>,
    pub(super) wall_s: Fixed<1>,
}

impl Row {
    /// The same fit's row of another tree.
    pub(super) fn with(&self, which: Which, of: &Measures) -> Self {
        Self {
            which,
            iou: Fixed(of.iou),
            crown_iou: Fixed(of.crown_iou),
            left_off: Fixed(of.left),
            right_off: Fixed(of.right),
            boundary_f: Fixed(of.boundary_f),
            crown_f: Fixed(of.crown_f),
            likeness: Fixed(of.likeness),
            width: Fixed(of.width),
            trunk: of.trunk.map(Fixed),
            lean_off: of.lean.map(Fixed),
            same_feet: Fixed(of.feet),
            fork_off: of.fork.map(Fixed),
            ..self.clone()
        }
    }
}
