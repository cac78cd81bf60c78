//! Grown trees: their parts as arrays, their pictures and meshes.

use crate::arrays::{self, column, of_ink, triples};
use crate::error::{PleachError, of_export, of_growth};
use crate::seed::Seed;
use crate::species::Species;
use crate::view::{self, Direction};
use crate::{json, pool};
use numpy::ndarray::Array3;
use numpy::{IntoPyArray as _, PyArray1, PyArray2, PyArray3};
use pleach::{
    Bounds, Export, ExportedFile, MeshFormat, Palette, Parts, Preview, PreviewSettings, StemKind, TreeStats,
};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};
use std::path::PathBuf;

/// A grown tree: stems of knots, and leaves, in metres, z up, the ground at 0.
///
/// Arrays show its memory and keep it alive; they are read-only. It can be pickled: it is grown again.
#[pyclass(frozen, module = "pleach._native")]
pub(crate) struct Tree {
    pub(crate) species: Species,
    pub(crate) seed: u64,
    pub(crate) leaves: bool,
    pub(crate) inner: pleach::Tree,
}

/// Largest side of a picture that is drawn.
const MAX_SIDE: u32 = 8192;

fn check_side(size: u32) -> PyResult<()> {
    if (1..=MAX_SIDE).contains(&size) {
        return Ok(());
    }
    Err(PleachError::new_err(format!("the size is {size} pixels, expected from 1 to {MAX_SIDE}")))
}

#[pymethods]
impl Tree {
    /// The species that it is of.
    #[getter]
    fn species(&self) -> Species {
        self.species.clone()
    }

    /// Its seed.
    #[getter]
    const fn seed(&self) -> u64 {
        self.seed
    }

    /// Whether leaves were grown.
    #[getter]
    fn has_leaves(&self) -> bool {
        self.leaves
    }

    /// All knots of all stems, float64 of shape (knots, 3), metres, z up; a view of the tree, read-only. Those of stem `i` are
    /// `knots[first_knots[i] : first_knots[i] + knot_counts[i]]`; between two of them runs a cubic Bézier piece.
    #[getter]
    fn knots<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        triples(slf.as_any(), &slf.get().inner.knots, |knot| knot.point.as_ref())
    }

    /// Handles of the pieces that arrive at the knots: points, as `knots`.
    #[getter]
    fn handles_in<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        triples(slf.as_any(), &slf.get().inner.knots, |knot| knot.handle_in.as_ref())
    }

    /// Handles of the pieces that leave the knots: points, as `knots`.
    #[getter]
    fn handles_out<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f64>> {
        triples(slf.as_any(), &slf.get().inner.knots, |knot| knot.handle_out.as_ref())
    }

    /// Radius at each knot, float64 of shape (knots,), metres; a view, read-only.
    #[getter]
    fn radii<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<f64>> {
        column(slf.as_any(), &slf.get().inner.knots, |knot| &knot.radius)
    }

    /// The first knot of each stem, uint32 of shape (stems,); a view, read-only.
    #[getter]
    fn first_knots<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        column(slf.as_any(), &slf.get().inner.stems, |stem| &stem.first_knot)
    }

    /// The number of knots of each stem, uint32 of shape (stems,); a view, read-only.
    #[getter]
    fn knot_counts<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        column(slf.as_any(), &slf.get().inner.stems, |stem| &stem.knot_count)
    }

    /// The level of each stem, 0 for trunks, uint16 of shape (stems,); a view, read-only.
    #[getter]
    fn levels<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u16>> {
        column(slf.as_any(), &slf.get().inner.stems, |stem| &stem.level)
    }

    /// Metres along its parent at which each stem starts, float64 of shape (stems,); a view, read-only.
    #[getter]
    fn offsets<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<f64>> {
        column(slf.as_any(), &slf.get().inner.stems, |stem| &stem.offset)
    }

    /// The stem that each grows from, −1 for none, int64 of shape (stems,); parents come before their children.
    #[getter]
    fn parents<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let parent = |stem: &pleach::Stem| stem.parent.map_or(-1, i64::from);
        arrays::numbers(py, self.inner.stems.iter().map(parent).collect())
    }

    /// What each stem is: `trunk`, `branch`, `fork` or `root`.
    #[getter]
    fn kinds(&self) -> Vec<&'static str> {
        let kind = |stem: &pleach::Stem| match stem.kind {
            StemKind::Trunk => "trunk",
            StemKind::Branch => "branch",
            StemKind::Fork => "fork",
            StemKind::Root => "root",
        };
        self.inner.stems.iter().map(kind).collect()
    }

    /// Where each leaf is attached, float32 of shape (leaves, 3), metres; a view, read-only.
    #[getter]
    fn leaf_positions<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f32>> {
        triples(slf.as_any(), &slf.get().inner.leaves, |leaf| leaf.position.as_ref())
    }

    /// From the base of each blade to its tip, float32 of shape (leaves, 3), metres; a view, read-only.
    #[getter]
    fn leaf_along<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f32>> {
        triples(slf.as_any(), &slf.get().inner.leaves, |leaf| leaf.along.as_ref())
    }

    /// Across each blade, as long as one unit of its width, float32 of shape (leaves, 3); a view, read-only.
    #[getter]
    fn leaf_across<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f32>> {
        triples(slf.as_any(), &slf.get().inner.leaves, |leaf| leaf.across.as_ref())
    }

    /// The stem that carries each leaf, uint32 of shape (leaves,); a view, read-only.
    #[getter]
    fn leaf_stems<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        column(slf.as_any(), &slf.get().inner.leaves, |leaf| &leaf.stem)
    }

    /// Smallest and largest x, y, z, float64 of shape (2, 3), metres; NaN without any part.
    #[getter]
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let bounds = Bounds::new(&self.inner, Parts::LEAFY);
        let [min, max] = bounds.map_or([[f64::NAN; 3]; 2], |b| [b.min.to_array(), b.max.to_array()]);
        Ok(PyArray2::from_vec2(py, &[min.to_vec(), max.to_vec()])?)
    }

    /// Measurements as a dict: stems, points, lengths and radii by level, leaves, height, crown, leaf area.
    #[getter]
    fn stats<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::to_python(py, &serde_json::to_value(TreeStats::new(&self.inner)).map_err(of_growth)?)
    }

    /// The silhouette, bool of shape (size, size), True where the tree is; `view` is an azimuth in degrees, or
    /// azimuth and elevation, by default the front. The tree stands in the middle of the bottom edge.
    ///
    /// >>> import pleach
    /// >>> ink = pleach.species("acer").grow().silhouette(128, view=90)
    /// >>> ink.shape, ink.dtype.name, bool(ink.any())
    /// ((128, 128), 'bool', True)
    #[pyo3(signature = (size = 512, *, view = None))]
    fn silhouette<'py>(
        &self,
        py: Python<'py>,
        size: u32,
        view: Option<Direction>,
    ) -> PyResult<Bound<'py, PyArray2<bool>>> {
        check_side(size)?;
        let view = view::view(view)?;
        of_ink(py, &py.detach(|| pleach::silhouette(&self.inner, view, size)))
    }

    /// A shaded picture, uint8 of shape (size, size, 4): red, green, blue, opacity.
    #[pyo3(signature = (size = 512, *, view = None, threads = None))]
    fn render<'py>(
        &self,
        py: Python<'py>,
        size: u32,
        view: Option<Direction>,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let rgba = self.painted(py, size, view, threads)?.rgba;
        let side = size as usize;
        let pixels = Array3::from_shape_vec((side, side, 4), rgba).map_err(of_growth)?;
        Ok(pixels.into_pyarray(py))
    }

    /// Writes the tree to a mesh file, and returns the files that were written: the mesh, and the materials and
    /// pictures that it names. The suffix of `path` says the format: glb, obj, ply, stl or usda.
    ///
    /// Options are those of `pleach grow`: `lod` (levels of detail, 1 to 6), or `triangles` (a list of budgets, the largest
    /// first; twigs become cards where leaves have no room), `billboard` (a last level of this many cards, 1 to 8), `level`
    /// (only this one, from 0), `lod_extension` (levels by `MSFT_lod` instead of nodes), `tolerance` (how far bark may stray, in millimetres), `leaves` (outline, simple, cards, instances, none),
    /// `textures` (pictures of the bark, 512, 1024 or 2048 pixels a side: colour, normals, roughness and occlusion),
    /// `season` (spring, summer, autumn, winter), `weld` (one surface on a grid with cells of this many millimetres) and
    /// `fillet`, `roots`, `wind`, `sway`. A format that cannot hold an option refuses it with `PleachError`.
    ///
    /// >>> import pleach, tempfile, pathlib
    /// >>> folder = pathlib.Path(tempfile.mkdtemp())
    /// >>> files = pleach.species("acer").grow().export(folder / "acer.obj", leaves="cards", season="autumn")
    /// >>> [file.name for file in files]
    /// ['acer.obj', 'acer-leaves.png', 'acer.mtl']
    #[pyo3(signature = (path, /, **options))]
    fn export(
        &self,
        py: Python<'_>,
        path: PathBuf,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Vec<PathBuf>> {
        let suffix = path.extension().unwrap_or_default().to_string_lossy();
        let format = MeshFormat::from_suffix(&suffix).ok_or_else(|| {
            let known = MeshFormat::ALL.map(MeshFormat::suffix).join(", .");
            PleachError::new_err(format!("cannot write `.{suffix}` files, known are .{known}"))
        })?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let file = self.mesh(py, format, &stem, options)?;
        std::fs::write(&path, &file.bytes)?;
        let mut written = vec![path.clone()];
        for beside in file.beside {
            let path = path.with_file_name(&beside.name);
            std::fs::write(&path, &beside.bytes)?;
            written.push(path);
        }
        Ok(written)
    }

    /// The mesh as the bytes of a GLB file: metres, y up, the foot at the origin. Options are those of `export`.
    #[pyo3(signature = (**options))]
    fn to_glb<'py>(
        &self,
        py: Python<'py>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let file = self.mesh(py, MeshFormat::Glb, &self.species.inner.name, options)?;
        Ok(PyBytes::new(py, &file.bytes))
    }

    fn __repr__(&self) -> String {
        let (stems, leaves) = (self.inner.stems.len(), self.inner.leaves.len());
        format!("<pleach.Tree {} of {}: {stems} stems, {leaves} leaves>", self.seed, self.species.inner.name)
    }

    /// In a notebook a tree shows itself.
    pub(crate) fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        /// Pixels a side.
        const SHOWN: u32 = 320;
        let mut png = Vec::new();
        self.painted(py, SHOWN, None, None)?.write_png(&mut png)?;
        Ok(PyBytes::new(py, &png))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let again = py.get_type::<Self>().getattr("_again")?;
        let arguments = (self.species.clone(), self.seed, self.leaves).into_pyobject(py)?;
        PyTuple::new(py, [again, arguments.into_any()])
    }

    /// For pickles: the tree of a species.
    #[staticmethod]
    fn _again(py: Python<'_>, species: &Species, seed: u64, leaves: bool) -> PyResult<Self> {
        species.grow(py, Some(Seed(seed)), Some(leaves))
    }
}

impl Tree {
    fn mesh(
        &self,
        py: Python<'_>,
        format: MeshFormat,
        stem: &str,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<ExportedFile> {
        let export = Export::from_json(&json::from_dict(options)?).map_err(of_export)?;
        let made =
            pool::on(py, None, || export.to_file(format, &self.species.inner, self.seed, &self.inner, stem))?;
        made.map_err(of_export)
    }

    fn painted(
        &self,
        py: Python<'_>,
        size: u32,
        view: Option<Direction>,
        threads: Option<usize>,
    ) -> PyResult<pleach::Picture> {
        check_side(size)?;
        let usual = PreviewSettings { width: size, height: size, ..PreviewSettings::default() };
        let settings = match view {
            Some(direction) => {
                let view = direction.view()?;
                PreviewSettings { azimuth: view.azimuth, elevation: view.elevation, ..usual }
            }
            None => usual,
        };
        pool::on(py, threads, || {
            let palette = Palette::new(&self.species.inner.appearance, None);
            let tree = palette.dressed(&self.inner);
            Preview::new(&tree, &palette, size).picture(&settings)
        })
    }
}
