//! What is in a picture of a tree, as data.

use pleach_reading::{Colors, Reading};
use pleach_silhouette::goal::GoalWarning;
use pleach_silhouette::mask::Mask;
use serde::Serialize;

/// What is in a picture of a tree, as data: the program's `reading.json`.
#[derive(Clone, Debug, Serialize)]
pub struct GoalReading {
    /// The measures.
    #[serde(flatten)]
    pub measures: Reading,
    /// The colours of the tree, and the season; `None` of a picture without colours.
    pub colors: Option<Colors>,
    /// How likely the mask of a photograph is a good one, in 0..=1; `None` if the picture needed none.
    pub mask_confidence: Option<f64>,
    /// What about the picture, or its mask, is not as a fit expects.
    pub warnings: Vec<GoalWarning>,
}

impl GoalReading {
    /// Of a picture with these measures. Whether there are leaves is taken from the colours where they say it more
    /// surely than the silhouette.
    pub(super) fn new(
        mut measures: Reading,
        colors: Option<Colors>,
        mask: Option<&Mask>,
        warnings: Vec<GoalWarning>,
    ) -> Self {
        // Brown leaves have the colour of wood, and a fine winter crown the silhouette of a leafy one.
        let disagreement = match colors.as_ref().and_then(|colors| colors.leaves) {
            Some(leaves) if leaves != measures.leaves => measures.leaves_confidence,
            _ => 0.0,
        };
        if let Some(colors) = &colors
            && let Some(leaves) = colors.leaves
            && colors.leaves_confidence > measures.leaves_confidence
        {
            (measures.leaves, measures.leaves_confidence) = (leaves, colors.leaves_confidence);
        }
        if let Some(colors) = &colors {
            let (foliage, wood) = (colors.foliage.ink() as f64, colors.wood.ink() as f64);
            if foliage + wood > 0.0 {
                measures.foliage_share = Some(foliage / (foliage + wood));
                measures.foliage_share_confidence = colors.layers_confidence * (1.0 - disagreement);
            }
        }
        let colors = colors.map(|colors| match colors.leaves {
            Some(false) if measures.leaves => colors.in_brown_leaf(measures.leaves_confidence),
            _ => colors,
        });
        Self { measures, colors, mask_confidence: mask.map(|mask| mask.confidence), warnings }
    }

    /// `measures` of the same tree in a smaller picture, with what is known of its foliage.
    pub(super) fn add_foliage(&self, measures: Reading) -> Reading {
        let Reading { foliage_share, foliage_share_confidence, .. } = self.measures;
        let Reading { leaves, leaves_confidence, .. } = self.measures;
        Reading { foliage_share, foliage_share_confidence, leaves, leaves_confidence, ..measures }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_silhouette::Bitmap;
    use pleach_tree::Season;

    #[test]
    fn foliage_is_doubtful_where_colors_and_silhouette_disagree_about_leaves() {
        let colors = Colors {
            leaves: Some(false),
            leaves_confidence: 0.625,
            layers_confidence: 0.5,
            wood: Bitmap::from_fn(4, 4, |_, _| true),
            foliage: Bitmap::new(4, 4),
            ..Colors::default()
        };
        let confidence = |leaves| {
            let measures = Reading { leaves, leaves_confidence: 0.5, ..Reading::default() };
            let reading = GoalReading::new(measures, Some(colors.clone()), None, Vec::new());
            reading.measures.foliage_share_confidence
        };
        assert_eq!((confidence(false), confidence(true)), (0.5, 0.25));
        // Where the silhouette is surer, brown leaves are leaves: no winter crown is drawn.
        let bark = pleach_tree::Color([0x4e, 0x42, 0x38]);
        let brown = Colors { bark: Some(bark), season: Some(Season::Winter), ..colors };
        let measures = Reading { leaves: true, leaves_confidence: 0.7, ..Reading::default() };
        let reading = GoalReading::new(measures, Some(brown), None, Vec::new());
        let found = reading.colors.unwrap();
        assert_eq!((found.season, found.leaf, found.leaves), (Some(Season::Autumn), Some(bark), Some(true)));
        assert!(reading.measures.leaves);
    }
}
