//! Why a photograph has no mask.

use super::pixel_box::PixelBox;

/// Why no tree was found in a photograph.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MaskError {
    /// Nothing stands out from the background.
    #[error(
        "no tree found: {why}; is the background even, and the tree all in the picture? A box around the tree or \
         a stroke on it may help, or a mask made by hand"
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
    /// The box has no pixel.
    #[error("the box of {} × {} pixels has no area: drag one around the tree", region.width, region.height)]
    EmptyRegion {
        /// The box.
        region: PixelBox,
    },
    /// Part of the box lies outside the picture.
    #[error(
        "the box of {} × {} pixels at {},{} reaches beyond the picture of {width} × {height} pixels",
        region.width, region.height, region.x, region.y
    )]
    RegionOutside {
        /// The box.
        region: PixelBox,
        /// Width of the picture in pixels.
        width: u32,
        /// Height of the picture in pixels.
        height: u32,
    },
    /// A point of a stroke lies outside the picture.
    #[error("the stroke's point {x},{y} lies outside the picture of {width} × {height} pixels")]
    StrokeOutside {
        /// Column from the left, from 0.
        x: u32,
        /// Row from the top, from 0.
        y: u32,
        /// Width of the picture in pixels.
        width: u32,
        /// Height of the picture in pixels.
        height: u32,
    },
    /// A picture of strokes has another size than the photograph.
    #[error(
        "the picture of strokes has {} × {} pixels, the photograph {width} × {height}: they must be of one size",
        stroke.0, stroke.1
    )]
    StrokeSize {
        /// Width and height of the picture of strokes in pixels.
        stroke: (u32, u32),
        /// Width of the photograph in pixels.
        width: u32,
        /// Height of the photograph in pixels.
        height: u32,
    },
    /// A stroke has no pixel.
    #[error("a stroke has no point: give it one, or leave it out")]
    EmptyStroke,
    /// All that the strokes include lies outside the box, or is excluded.
    #[error("the strokes include nothing: all that they mark is excluded, or lies outside the box")]
    IncludesNothing,
    /// All of the box, or of the picture, is excluded.
    #[error("the strokes exclude all of the box: leave some of it for the tree")]
    ExcludesAll,
}
