//! Grown trees, their pictures and files.

use crate::error::thrown;
use crate::mesh::{self, MeshBuffers, season_named};
use js_sys::{Array, Uint8Array};
use pleach::{
    Bounds, Detail, Export, Frame, Leaf, MeshFormat, Palette, Parts, Preview, PreviewSettings, Rasterizer,
    TreeStats, View,
};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::sync::Arc;
use wasm_bindgen::prelude::wasm_bindgen;
use wasm_bindgen::{JsError, JsValue};

/// The tree of a species and a seed.
#[wasm_bindgen]
pub struct Tree {
    pub(crate) species: Arc<pleach::Species>,
    pub(crate) seed: u64,
    pub(crate) inner: pleach::Tree,
}

/// Leaves of a coarse picture.
const COARSE_LEAVES: usize = 6_000;
/// Largest side of a picture, in pixels.
const MAX_SIDE: u32 = 4096;

fn check_side(size: u32) -> Result<(), JsError> {
    if (1..=MAX_SIDE).contains(&size) {
        return Ok(());
    }
    Err(thrown(format!("the size is {size} pixels, expected from 1 to {MAX_SIDE}")))
}

/// One byte per pixel, 1 where there is ink.
pub(crate) fn ink(picture: &pleach::Bitmap) -> Vec<u8> {
    let rows = 0..picture.height();
    rows.flat_map(|y| (0..picture.width()).map(move |x| u8::from(picture.get(x, y)))).collect()
}

impl Tree {
    /// The tree as it is in a season.
    pub(crate) fn dressed(&self, season: &str) -> Result<(Palette, Cow<'_, pleach::Tree>), JsError> {
        let palette = Palette::new(&self.species.appearance, season_named(season)?);
        Ok((palette, palette.dressed(&self.inner)))
    }

    /// The square that shows all of it.
    fn frame(&self, size: u32, view: &View) -> Frame {
        Frame::automatic(&self.inner, view, Parts::LEAFY, size, size)
    }

    fn drawn(&self, view: &View, frame: &Frame, detail: Detail) -> Vec<u8> {
        let mut picture = pleach::Bitmap::default();
        Rasterizer::with_detail(detail).draw(&self.inner, view, frame, Parts::LEAFY, &mut picture);
        ink(&picture)
    }
}

#[wasm_bindgen]
impl Tree {
    /// What can be counted and measured: JSON.
    pub fn stats(&self) -> Result<String, JsError> {
        let mut stats = serde_json::to_value(TreeStats::new(&self.inner)).map_err(thrown)?;
        let bounds = Bounds::new(&self.inner, Parts::LEAFY);
        let [min, max] = bounds.map_or([[0.0; 3]; 2], |b| [b.min.to_array(), b.max.to_array()]);
        if let Value::Object(stats) = &mut stats {
            stats.insert("bounds".to_owned(), json!([min, max]));
            stats.insert("height".to_owned(), json!(max[2]));
            stats.insert("width".to_owned(), json!((max[0] - min[0]).max(max[1] - min[1])));
            stats.insert("stems".to_owned(), json!(self.inner.stems.len()));
            stats.insert("leaves".to_owned(), json!(self.inner.leaves.len() + self.inner.blobs.len()));
            stats.insert("knots".to_owned(), json!(self.inner.knots.len()));
        }
        Ok(stats.to_string())
    }

    /// A hash of all its bits, in hexadecimal digits: two trees with the same are the same.
    #[must_use]
    pub fn digest(&self) -> String {
        format!("{:016x}", self.inner.digest())
    }

    /// The binary picture from a direction in degrees: one byte per pixel, row by row, 1 for tree.
    pub fn silhouette(&self, size: u32, azimuth: f64, elevation: f64) -> Result<Vec<u8>, JsError> {
        check_side(size)?;
        let view = View::degrees(azimuth, elevation);
        Ok(self.drawn(&view, &self.frame(size, &view), Detail::Full))
    }

    /// The picture from the front, sampled coarsely and with few leaves, as much larger: for what follows the
    /// pointer.
    pub fn coarse_silhouette(&mut self, size: u32) -> Result<Vec<u8>, JsError> {
        check_side(size)?;
        let step = self.inner.leaves.len().div_ceil(COARSE_LEAVES).max(1);
        let larger = (step as f32).sqrt();
        let few = self.inner.leaves.iter().step_by(step);
        let few = few.map(|leaf| Leaf { along: leaf.along * larger, across: leaf.across * larger, ..*leaf });
        let few: Vec<Leaf> = few.collect();
        let all = std::mem::replace(&mut self.inner.leaves, few);
        let frame = self.frame(size, &View::FRONT);
        let picture = self.drawn(&View::FRONT, &frame, Detail::Draft);
        self.inner.leaves = all;
        Ok(picture)
    }

    /// Triangles, in a season (empty for the species' own), with leaves drawn as `outline`, `simple`, `cards`, `pictured`
    /// (one card each, for the pictures of GLB files) or `none`, at a level of detail of which 0 is the finest; at a
    /// coarser one where that has more than `most` vertices.
    pub fn mesh(&self, season: &str, leaves: &str, level: u32, most: u32) -> Result<MeshBuffers, JsError> {
        let (palette, tree) = self.dressed(season)?;
        mesh::buffers(&tree, &palette, leaves, level, most)
    }

    /// Two trees with the same text have the same pictures of bark, leaves and blossoms in their GLB files.
    #[must_use]
    pub fn looks(&self) -> String {
        format!("{:?} {:?} {:?}", self.species.appearance, self.inner.leaf_shapes, self.inner.blossom_shapes)
    }

    /// A mesh file, and the files that it names: pairs of a name and bytes, the mesh file first; and behind that list
    /// what the user is to be told, empty for nothing. `format` is a suffix
    /// such as `glb`, `stem` the name without it, and `options` those of `pleach::Export` as JSON.
    pub fn export(&self, format: &str, stem: &str, options: &str) -> Result<Array, JsError> {
        let known = || {
            let known = MeshFormat::ALL.map(MeshFormat::suffix).join(", ");
            thrown(format!("the format is `{format}`, expected {known}"))
        };
        let format = MeshFormat::from_suffix(format).ok_or_else(known)?;
        let export = Export::from_json(options).map_err(thrown)?;
        let file = export.to_file(format, &self.species, self.seed, &self.inner, stem).map_err(thrown)?;
        let pair = |name: &str, bytes: &[u8]| Array::of2(&JsValue::from_str(name), &Uint8Array::from(bytes));
        let name = format!("{stem}.{}", format.suffix());
        let beside = file.beside.iter().map(|beside| pair(&beside.name, &beside.bytes));
        let files: Array = std::iter::once(pair(&name, &file.bytes)).chain(beside).collect();
        Ok(Array::of2(&files, &JsValue::from_str(file.note.as_deref().unwrap_or_default())))
    }

    /// The shaded picture from a direction in degrees: four bytes per pixel, row by row.
    pub fn picture(&self, size: u32, season: &str, azimuth: f64, elevation: f64) -> Result<Vec<u8>, JsError> {
        check_side(size)?;
        let (palette, tree) = self.dressed(season)?;
        let View { azimuth, elevation, .. } = View::degrees(azimuth, elevation);
        let settings =
            PreviewSettings { width: size, height: size, azimuth, elevation, ..PreviewSettings::default() };
        Ok(Preview::new(&tree, &palette, size).picture(&settings).rgba)
    }
}
