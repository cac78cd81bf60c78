//! What a person shows of the tree in a photograph.

use super::error::PrepareError;
use super::source::FitSource;
use crate::option_error::OptionError;
use pleach_silhouette::mask::{MaskOptions, Photo, PixelBox, Stroke};
use serde::{Deserialize, Serialize};

/// What a person shows of the tree in a photograph: a box around it, and points or strokes on it and beside it. Pixels
/// are counted from 0 at the top left of the photograph as it is shown.
///
/// In JSON, `{"box": [40, 20, 600, 760], "include": [[300, 500]], "exclude": [[80, 700]], "strokes": "marks.png"}`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MaskHints {
    /// All of the tree is inside: first column, first row, columns, rows.
    #[serde(rename = "box")]
    pub region: Option<[u32; 4]>,
    /// Pixels of the tree: column, row.
    pub include: Vec<[u32; 2]>,
    /// Pixels that are not of the tree: column, row.
    pub exclude: Vec<[u32; 2]>,
    /// A picture of the photograph's size, by its name in [`FitSource::pictures`] or a file: what is painted green in it
    /// is tree, what is red is not. See [`Stroke::painted`].
    pub strokes: Option<String>,
}

/// Around a point that is shown, this part of the picture's longer side is meant, too: a click has no area.
const POINT: u32 = 200;

impl MaskHints {
    /// Whether nothing is shown.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// What can be told without the photograph.
    pub(super) fn check(&self) -> Result<(), OptionError> {
        match self.region {
            Some([_, _, width, height]) if width == 0 || height == 0 => {
                let problem = format!("has a box of {width} × {height} pixels, expected one around the tree");
                Err(OptionError::new("hints", problem))
            }
            _ => Ok(()),
        }
    }

    /// `options` with what is shown of `photo`.
    ///
    /// # Errors
    /// The picture of strokes cannot be read. Whether strokes lie in the photograph is found when a mask is made.
    pub fn over(
        &self,
        options: MaskOptions,
        photo: &Photo,
        source: &FitSource,
    ) -> Result<MaskOptions, PrepareError> {
        let radius = photo.width().max(photo.height()) / POINT;
        let points = |points: &[[u32; 2]]| -> Vec<Stroke> {
            points.iter().map(|&[x, y]| Stroke::path(vec![(x, y)], radius)).collect()
        };
        let (mut include, mut exclude) = (points(&self.include), points(&self.exclude));
        if let Some(name) = &self.strokes {
            let (tree, other) = Stroke::painted(&source.picture(name).photo()?);
            include.extend(tree);
            exclude.extend(other);
        }
        let region = self.region.map(|[x, y, width, height]| PixelBox { x, y, width, height });
        Ok(MaskOptions { region, include, exclude, ..options })
    }
}
