//! The pictures of a fit, as callers have them.

use pleach_reading::Colors;
use pleach_silhouette::goal::{Encoded, GoalError};
use pleach_silhouette::mask::Photo;
use pleach_silhouette::{Bitmap, Goal, GoalOptions};
use pleach_tree::Species;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Opacity from which a pixel of a cut-out is tree, as in [`pleach_silhouette::mask::Mask::from_photo`].
const OPAQUE: u8 = 128;

/// A picture that a goal is read from.
#[derive(Clone, Debug)]
pub enum PictureSource {
    /// A file, which is read when it is needed: PNG, JPEG, WebP or TIFF.
    File(PathBuf),
    /// The bytes of such a file.
    Encoded(Encoded),
    /// Ink at hand: what is tree is said pixel by pixel.
    Ink(Bitmap),
}

impl PictureSource {
    /// The goal of the picture.
    pub(super) fn goal(&self, options: &GoalOptions) -> Result<Goal, GoalError> {
        match self {
            Self::File(path) => Goal::load(path, options),
            Self::Encoded(encoded) => Goal::from_encoded(encoded, options),
            Self::Ink(ink) => Goal::from_ink(ink.clone(), options),
        }
    }

    /// The picture in colour; ink is black on white.
    pub(crate) fn photo(&self) -> Result<Photo, GoalError> {
        match self {
            Self::File(path) => Photo::load(path),
            Self::Encoded(encoded) => Photo::from_encoded(encoded),
            Self::Ink(ink) => Ok(Photo::from_fn(ink.width(), ink.height(), |x, y| {
                let light = if ink.get(x, y) { 0 } else { 255 };
                [light, light, light, 255]
            })),
        }
    }

    /// The colours of a picture whose alpha channel says what is tree; `None` of others.
    pub(super) fn colors_of_cut_out(&self) -> Option<Colors> {
        if matches!(self, Self::Ink(_)) {
            return None;
        }
        let photo = self.photo().ok()?;
        let (width, pixels) = (photo.width() as usize, photo.pixels());
        let is_tree = |x: u32, y: u32| pixels[y as usize * width + x as usize][3] >= OPAQUE;
        let tree = Bitmap::from_fn(photo.width(), photo.height(), is_tree);
        // Without transparent pixels nothing is cut out.
        if tree.ink() == tree.area() { None } else { Colors::read(&photo, &tree).ok() }
    }

    /// What errors call it.
    pub(super) fn name(&self) -> &Path {
        self.path().unwrap_or_else(|| "the goal".as_ref())
    }

    /// The path that it was given with, if any.
    fn path(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Encoded(encoded) => Some(encoded.name()),
            Self::Ink(_) => None,
        }
    }
}

impl From<Encoded> for PictureSource {
    fn from(encoded: Encoded) -> Self {
        Self::Encoded(encoded)
    }
}

impl From<Bitmap> for PictureSource {
    fn from(ink: Bitmap) -> Self {
        Self::Ink(ink)
    }
}

impl From<&Path> for PictureSource {
    fn from(path: &Path) -> Self {
        Self::File(path.to_owned())
    }
}

impl From<&str> for PictureSource {
    fn from(path: &str) -> Self {
        Self::File(path.into())
    }
}

/// What a fit reads beside its options: the goal's picture, and what options name that is not in files.
#[derive(Clone, Debug)]
pub struct FitSource {
    /// The goal's picture.
    pub goal: PictureSource,
    /// Pictures that [`super::FitOptions`] name; other names are opened as files.
    pub pictures: BTreeMap<String, PictureSource>,
    /// The species that [`super::FitOptions::from`] names, where it is at hand; otherwise the name is looked up, or
    /// opened as a file.
    pub start: Option<Species>,
    /// What the species that is found is called, unless [`super::FitOptions::name`] says otherwise; by default as the
    /// goal's file without its ending.
    pub name: Option<String>,
    /// Colours of the goal's tree where they are at hand and its picture does not show them, as ink does not.
    pub colors: Option<Colors>,
}

impl<P: Into<PictureSource>> From<P> for FitSource {
    fn from(goal: P) -> Self {
        Self { goal: goal.into(), pictures: BTreeMap::new(), start: None, name: None, colors: None }
    }
}

impl FitSource {
    /// The colours of the goal's tree, where they are at hand or its picture is a cut-out.
    pub(super) fn colors(&self) -> Option<Colors> {
        self.colors.clone().or_else(|| self.goal.colors_of_cut_out())
    }

    /// The picture that an option names.
    pub(super) fn picture(&self, name: &str) -> Cow<'_, PictureSource> {
        match self.pictures.get(name) {
            Some(picture) => Cow::Borrowed(picture),
            None => Cow::Owned(name.into()),
        }
    }

    /// What a species that is fitted to the goal is called.
    pub(super) fn species_name(&self) -> String {
        if let Some(name) = &self.name {
            return name.clone();
        }
        let stem = self.goal.path().and_then(Path::file_stem).unwrap_or_else(|| "goal".as_ref());
        stem.to_string_lossy().into_owned()
    }
}
