//! Warnings: what is unusual about a goal, so that its user may look again.

use super::border::FrameWidths;
use crate::touches::Touches;
use serde::Serialize;
use serde::ser::{SerializeStruct, Serializer};
use std::fmt;

/// Something about a picture, or about a mask made of one, that makes a bad goal. It can still be fitted.
///
/// `Display` says what was seen and what makes a better goal, in words that hold wherever a fit is made: in a program,
/// in Python, in a page. As JSON it is `{"kind": …, "message": …}`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum GoalWarning {
    /// The picture has the many colours or greys of a photograph, and was split by brightness.
    Photograph,
    /// The file holds further pictures, and the first was taken.
    SeveralPictures,
    /// A frame around the picture, as of a print or a scanner, that was left out.
    Frame(FrameWidths),
    /// The transparent part is not the background, as where a picture was turned; it was left out, and the tree
    /// was found by tone or colour.
    AlphaIgnored {
        /// Share of the picture that is transparent, in 0..=1.
        transparent: f64,
    },
    /// The tree is the transparent part, a hole in what is around it.
    TransparentTree,
    /// Tree and paper were separated by colour, not by brightness, as in a photograph.
    ByColor {
        /// See [`Mask::confidence`](crate::mask::Mask::confidence).
        confidence: f64,
    },
    /// The crown is cut off by the picture's edge.
    TouchesFrame(Touches),
    /// Several pieces of similar size, all taken for one tree.
    SeveralPieces {
        /// How many have at least a quarter of the largest one's ink, the largest counted.
        pieces: usize,
    },
    /// A wide strip at the bottom that is ground rather than tree.
    Ground {
        /// The first row of the strip, in pixels of the file from its top edge.
        row: u32,
    },
    /// Specks all over the picture. Those of one pixel, and holes like them, are taken out of the goal.
    Noise {
        /// Pixels of ink that stand alone.
        specks: u64,
    },
    /// A shape without gaps or notches, such as a square or a disc.
    Solid {
        /// Share of the shape's convex hull that is ink, in 0..=1.
        solidity: f64,
    },
    /// Most of the picture is ink, or the corners of what is ink are: the paper may have been taken for the tree.
    MostlyInk {
        /// Share of the picture that is ink, in 0..=1.
        share: f64,
    },
    /// A closed line with paper inside, as in an outline drawing.
    Outline {
        /// Share of the shape, its holes filled, that is its largest hole, in 0..=1.
        hollow: f64,
    },
    /// A bare stem at the top and the crown at the bottom.
    UpsideDown,
    /// A mask of which little is certain.
    DoubtfulMask {
        /// See [`Mask::confidence`](crate::mask::Mask::confidence).
        confidence: f64,
    },
}

impl GoalWarning {
    /// A word for scripts, in kebab case.
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Photograph => "photograph",
            Self::SeveralPictures => "several-pictures",
            Self::Frame(_) => "frame",
            Self::AlphaIgnored { .. } => "alpha-ignored",
            Self::TransparentTree => "transparent-tree",
            Self::ByColor { .. } => "by-color",
            Self::TouchesFrame(_) => "touches-frame",
            Self::SeveralPieces { .. } => "several-pieces",
            Self::Ground { .. } => "ground",
            Self::Noise { .. } => "noise",
            Self::Solid { .. } => "solid",
            Self::MostlyInk { .. } => "mostly-ink",
            Self::Outline { .. } => "outline",
            Self::UpsideDown => "upside-down",
            Self::DoubtfulMask { .. } => "doubtful-mask",
        }
    }
}

impl fmt::Display for GoalWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Photograph => f.write_str(
                "this looks like a photograph, and was split in two by brightness alone, although its colours may \
                 show the tree better",
            ),
            Self::SeveralPictures => f.write_str(
                "the file holds several pictures, as an animation or as pages; only the first was read, so \
                 save the one you mean as a file of its own",
            ),
            Self::Frame(frame) => write!(
                f,
                "there is a frame around the picture, in pixels: {}; it was left out, and a picture that is \
                 cropped to what is inside of it makes the same goal",
                frame.sides()
            ),
            Self::AlphaIgnored { transparent } => write!(
                f,
                "the transparent part of the picture ({:.1} %) is not a background, as where a picture was \
                 turned or its corners were rounded; it was left out, and what is opaque is not all tree",
                100.0 * transparent
            ),
            Self::TransparentTree => f.write_str(
                "the transparent part of the picture was taken for the tree, since the opaque part is all \
                 around it; if that is wrong, save the picture without transparency",
            ),
            Self::ByColor { confidence } => write!(
                f,
                "brightness did not separate the tree from the paper, as where light is uneven; the tree is what \
                 differs in colour from the paper around it (confidence {confidence:.2} of 1)"
            ),
            Self::TouchesFrame(touches) => write!(
                f,
                "the crown touches the frame: {}; what lies beyond is not seen, so a picture of the whole \
                 tree makes a better goal",
                touches.sides().join(", ")
            ),
            Self::SeveralPieces { pieces } => write!(
                f,
                "there are {pieces} pieces of similar size, and all count as one tree; if they are several trees, \
                 a mask of one of them makes a better goal"
            ),
            Self::Ground { row } => write!(
                f,
                "the wide strip below row {row} looks like ground, and counts as tree; a mask without it makes a \
                 better goal"
            ),
            Self::Noise { specks } => write!(
                f,
                "there were specks all over the picture, {specks} of one pixel; a fit leaves those out, and fills \
                 holes of one pixel, and a cleaner picture or a mask made by hand makes a better goal"
            ),
            Self::Solid { solidity } => write!(
                f,
                "the shape has neither gaps nor notches ({:.0} % of its convex hull is ink), and trees have \
                 both; tree and background may be mixed up",
                100.0 * solidity
            ),
            Self::MostlyInk { share } => write!(
                f,
                "{:.0} % of the picture counts as tree, up to the corners, so that the paper may have been taken \
                 for it",
                100.0 * share
            ),
            Self::Outline { hollow } => write!(
                f,
                "this looks like an outline drawing: {:.0} % of the shape is one piece of paper within a line, and \
                 a fit takes lines for branches; fill the outline with its own tone",
                100.0 * hollow
            ),
            Self::UpsideDown => f.write_str(
                "the tree seems to stand on its crown, with its trunk at the top; turn the picture by 180 \
                 degrees",
            ),
            Self::DoubtfulMask { confidence } => write!(
                f,
                "the mask is doubtful (confidence {confidence:.2} of 1); a fit follows it, so look at it first, and \
                 show where the tree is or correct it by hand"
            ),
        }
    }
}

impl Serialize for GoalWarning {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut out = serializer.serialize_struct("GoalWarning", 2)?;
        out.serialize_field("kind", self.kind())?;
        out.serialize_field("message", &self.to_string())?;
        out.end()
    }
}
