//! How a tree does in a further picture, as data.

use pleach_silhouette::Bitmap;
use pleach_silhouette::score::ScoreCard;
use serde::Serialize;

/// How a tree does in a further picture.
#[derive(Clone, Debug, Serialize)]
pub struct ViewReport {
    /// The picture, as the options name it.
    pub file: String,
    /// The direction in degrees, as found.
    pub azimuth: f64,
    /// Degrees above the horizon.
    pub elevation: f64,
    /// Factor on the picture's metres per pixel, as found.
    pub scale: f64,
    /// How far the trunk's foot is to the right of where the picture says, in its widths, and below it, in its heights,
    /// as found.
    pub offset: [f64; 2],
    /// How well the tree matches it.
    #[serde(flatten)]
    pub scores: ScoreCard,
    /// Whether the azimuth was searched.
    #[serde(skip)]
    pub azimuth_found: bool,
    /// Its silhouette in the picture, of the size of the picture as it is compared.
    #[serde(skip)]
    pub silhouette: Bitmap,
}
