//! Why a photograph has no mask.

/// Why no tree was found in a photograph.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MaskError {
    /// Nothing stands out from the background.
    #[error(
        "no tree found: {why}; is the background even, and the tree all in the picture? Another \
         --background or a --seed-point on the tree may help, or a mask made by hand"
    )]
    NoTree {
        /// What was seen instead.
        why: &'static str,
    },
    /// The seed point lies outside the picture.
    #[error("the seed point {x},{y} lies outside the picture of {width} × {height} pixels")]
    SeedOutside {
        /// Column from the left, from 0.
        x: u32,
        /// Row from the top, from 0.
        y: u32,
        /// Width of the picture in pixels.
        width: u32,
        /// Height of the picture in pixels.
        height: u32,
    },
    /// The seed point is not on anything that stands out.
    #[error("the seed point {x},{y} lies on the background: choose one on trunk or crown")]
    SeedOnBackground {
        /// Column from the left, from 0.
        x: u32,
        /// Row from the top, from 0.
        y: u32,
    },
}
