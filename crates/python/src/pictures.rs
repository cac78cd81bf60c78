//! Pictures of a tree: its shape, its wood, its depth, and as it looks.

use crate::arrays::of_ink;
use crate::error::{PleachError, of_growth};
use crate::pool;
use crate::view::{self, Direction};
use numpy::ndarray::{Array2, Array3};
use numpy::{IntoPyArray as _, PyArray2, PyArray3};
use pleach::{
    Appearance, Bitmap, Frame, Palette, Parts, Picture, Preview, PreviewSettings, Rasterizer, Season, Tree,
    View,
};
use pyo3::prelude::*;

/// Largest side of a picture that is drawn.
const MAX_SIDE: u32 = 8192;

fn check_side(size: u32) -> PyResult<()> {
    if (1..=MAX_SIDE).contains(&size) {
        return Ok(());
    }
    Err(PleachError::new_err(format!("the size is {size} pixels, expected from 1 to {MAX_SIDE}")))
}

/// The view that is meant, once the size is checked.
fn checked(size: u32, direction: Option<Direction>) -> PyResult<View> {
    check_side(size)?;
    view::view(direction)
}

/// The silhouette.
pub(crate) fn silhouette<'py>(
    py: Python<'py>,
    tree: &Tree,
    size: u32,
    view: Option<Direction>,
) -> PyResult<Bound<'py, PyArray2<bool>>> {
    let view = checked(size, view)?;
    of_ink(py, &py.detach(|| pleach::silhouette(tree, view, size)))
}

/// The stems of the silhouette, in the same frame.
pub(crate) fn wood<'py>(
    py: Python<'py>,
    tree: &Tree,
    size: u32,
    view: Option<Direction>,
) -> PyResult<Bound<'py, PyArray2<bool>>> {
    let view = checked(size, view)?;
    let stems = py.detach(|| {
        let frame = Frame::automatic(tree, &view, Parts::LEAFY, size, size);
        let [mut stems, mut all] = [Bitmap::default(), Bitmap::default()];
        Rasterizer::new().draw_with_stems(tree, &view, &frame, Parts::LEAFY, [&mut stems, &mut all]);
        stems
    });
    of_ink(py, &stems)
}

/// How far what the silhouette shows is from the viewer.
pub(crate) fn depth<'py>(
    py: Python<'py>,
    tree: &Tree,
    size: u32,
    view: Option<Direction>,
) -> PyResult<Bound<'py, PyArray2<f32>>> {
    let view = checked(size, view)?;
    let depth = py.detach(|| {
        let frame = Frame::automatic(tree, &view, Parts::LEAFY, size, size);
        let (mut rasterizer, mut picture, mut depth) = (Rasterizer::new(), Bitmap::default(), Vec::new());
        rasterizer.draw(tree, &view, &frame, Parts::LEAFY, &mut picture);
        rasterizer.depth(tree, &view, &frame, Parts::LEAFY, &picture, &mut depth);
        depth
    });
    let side = size as usize;
    Ok(Array2::from_shape_vec((side, side), depth).map_err(of_growth)?.into_pyarray(py))
}

/// How a picture is painted, as Python says it.
#[derive(Clone, Copy, Default)]
pub(crate) struct Painting<'a> {
    pub(crate) view: Option<Direction>,
    pub(crate) season: Option<&'a str>,
    pub(crate) roots: bool,
    pub(crate) background: Option<&'a str>,
    pub(crate) ground: Option<&'a str>,
    pub(crate) threads: Option<usize>,
}

/// A shaded picture.
pub(crate) fn painted(
    py: Python<'_>,
    looks: &Appearance,
    tree: &Tree,
    size: u32,
    painting: Painting<'_>,
) -> PyResult<Picture> {
    check_side(size)?;
    let mut settings = PreviewSettings { width: size, height: size, ..PreviewSettings::default() };
    if let Some(direction) = painting.view {
        let view = direction.view()?;
        (settings.azimuth, settings.elevation) = (view.azimuth, view.elevation);
    }
    if let Some(text) = painting.background {
        settings.background = text.parse().map_err(PleachError::new_err::<String>)?;
    }
    if let Some(text) = painting.ground {
        settings.ground = text.parse().map_err(PleachError::new_err::<String>)?;
    }
    let season = painting.season.map(read_season).transpose()?;
    let parts = if painting.roots { Parts::ALL } else { Parts::LEAFY };
    pool::on(py, painting.threads, || {
        let palette = Palette::new(looks, season);
        let tree = palette.dressed(tree);
        Preview::with_parts(&tree, &palette, size, parts).picture(&settings)
    })
}

/// The array of a picture.
pub(crate) fn array(py: Python<'_>, picture: Picture) -> PyResult<Bound<'_, PyArray3<u8>>> {
    let shape = (picture.height as usize, picture.width as usize, 4);
    Ok(Array3::from_shape_vec(shape, picture.rgba).map_err(of_growth)?.into_pyarray(py))
}

/// A season by its name.
pub(crate) fn read_season(name: &str) -> PyResult<Season> {
    Season::from_name(name).ok_or_else(|| {
        let known = Season::NAMES.join(", ");
        PleachError::new_err(format!("there is no season `{name}`, expected one of {known}"))
    })
}
