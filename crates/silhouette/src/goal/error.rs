//! What can be wrong with a goal image.

use super::formats::known;
use super::limits::{MAX_SIDE, MIN_SIDE};
use std::io;
use std::path::PathBuf;

/// Why a picture cannot serve as a goal. Every variant says which file and what was found.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GoalError {
    /// The file cannot be opened or read.
    #[error("cannot read {path}: {cause}", path = path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the operating system reports.
        #[source]
        cause: io::Error,
    },
    /// The file begins like none of the formats that are read.
    #[error("{path} is not a picture that can be read here: {known} are", path = path.display(), known = known())]
    NotAnImage {
        /// The file.
        path: PathBuf,
    },
    /// The file is a picture of a format that is not read, but that other programs convert.
    #[error(
        "{path} is a {format} picture, and {known} are read: convert it; {converter}",
        path = path.display(), known = known()
    )]
    OtherFormat {
        /// The file.
        path: PathBuf,
        /// What the format is called.
        format: &'static str,
        /// What converts it to PNG, and by which command.
        converter: &'static str,
    },
    /// The file is a drawing in SVG that is not painted.
    #[error("{path} is a drawing that cannot be read here: {detail}; save it as PNG", path = path.display())]
    Drawing {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        detail: String,
    },
    /// The file is a picture of a kind that its decoder does not know.
    #[error("{path} is a kind of picture that cannot be read here: {detail}; save it as an ordinary PNG", path = path.display())]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What the decoder reports.
        detail: String,
    },
    /// The file begins like a picture, and then breaks off or makes no sense.
    #[error("{path} is damaged or incomplete: {detail}", path = path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What the decoder reports.
        detail: String,
    },
    /// Wider or higher than is read.
    #[error(
        "{path} has {width} × {height} pixels, and at most {MAX_SIDE} to a side are read: make it smaller",
        path = path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// The file, or the picture once decoded, takes more memory than it may.
    #[error(
        "{path} needs {bytes} bytes, and at most {limit} are read: make it smaller, or use 8 bits a channel",
        path = path.display()
    )]
    TooManyBytes {
        /// The file.
        path: PathBuf,
        /// Bytes of the file or of the decoded picture.
        bytes: u64,
        /// The most that is read.
        limit: u64,
    },
    /// The file carries more beside its pixels than is read.
    #[error(
        "{path} carries more than {limit} bytes beside its pixels, as a colour profile or as text: save it \
         without them",
        path = path.display()
    )]
    TooMuchBeside {
        /// The file.
        path: PathBuf,
        /// The most that is read.
        limit: u64,
    },
    /// Too few pixels to say anything about a tree.
    #[error("{name} has {width} × {height} pixels: at least {MIN_SIDE} × {MIN_SIDE} are needed")]
    TooSmall {
        /// The file, or what the picture is.
        name: String,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// The mask does not lie on the picture.
    #[error(
        "the mask {mask} has {} × {} pixels, and the picture has {} × {}: it may be larger or smaller, but \
         must have the same shape",
        mask_size.0, mask_size.1, image_size.0, image_size.1, mask = mask.display()
    )]
    MaskSize {
        /// The mask's file.
        mask: PathBuf,
        /// Width and height of the mask in pixels.
        mask_size: (u32, u32),
        /// Width and height of the picture in pixels.
        image_size: (u32, u32),
    },
    /// Nothing in the picture is tree.
    #[error("{name} shows no tree: not one pixel is ink")]
    NoInk {
        /// The file, or what the picture is.
        name: String,
    },
    /// Everything in the picture is tree.
    #[error("{name} shows no tree: every pixel is ink")]
    AllInk {
        /// The file, or what the picture is.
        name: String,
    },
    /// The picture has several tones, all about as bright as each other.
    #[error(
        "{name} shows no tree: its values go from {darkest} to {lightest} of 255, which is too little to tell \
         a tree from its background; use a picture of two tones, or with more contrast"
    )]
    LowContrast {
        /// The file, or what the picture is.
        name: String,
        /// The least brightness, 0 to 255.
        darkest: u8,
        /// The greatest brightness, 0 to 255.
        lightest: u8,
    },
    /// A place set by hand lies outside the picture.
    #[error("{what} {value} is not in the picture, which reaches from 0 to {limit}")]
    OutsidePicture {
        /// Which place: the ground row or the axis column.
        what: &'static str,
        /// The value in pixels.
        value: f64,
        /// The picture's height or width in pixels.
        limit: f64,
    },
    /// The ground row set by hand leaves nothing of the tree above it.
    #[error("the ground row {ground_row} lies above all ink, whose top is at row {top_row}")]
    GroundAboveTree {
        /// The ground in pixels from the top edge.
        ground_row: f64,
        /// The top edge of the ink in pixels from the top edge.
        top_row: f64,
    },
}
