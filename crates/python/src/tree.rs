//! Grown trees: their parts as arrays, their pictures and meshes.

use crate::arrays::{self, column, triples};
use crate::error::{PleachError, of_export, of_growth};
use crate::pictures::{self, Painting};
use crate::seed::Seed;
use crate::species::Species;
use crate::view::Direction;
use crate::{foliage, json, mesh, pool, skeleton, wind};
use numpy::{PyArray1, PyArray2, PyArray3};
use pleach::{
    Bounds, Export, ExportedFile, MeshFormat, Parts, Skeleton, SkeletonFormat, StemKind, TreeStats,
};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};
use std::ffi::CString;
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

    /// Where each stem stands on its parent, float64 of shape (stems,): the place on the parent's spline that is nearest to the
    /// stem's first knot. 2.25 is a quarter of the way, in the parameter of the curve, from the parent's third knot to its
    /// fourth. NaN for stems without a parent.
    #[getter]
    fn places<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::numbers(py, foliage::places(&self.inner))
    }

    /// Number of the outline of each leaf in `leaf_outlines`, uint16 of shape (leaves,); a view, read-only.
    #[getter]
    fn leaf_shapes<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u16>> {
        column(slf.as_any(), &slf.get().inner.leaves, |leaf| &leaf.shape)
    }

    /// The outlines of leaves: the name of each, and its corners counter-clockwise, float32 of shape (corners, 2). A corner
    /// (u, v) of leaf `i` is at `leaf_positions[i] + u * leaf_across[i] + v * leaf_along[i]`.
    #[getter]
    fn leaf_outlines(&self, py: Python<'_>) -> PyResult<Vec<foliage::Outline>> {
        foliage::outlines(py, &self.inner)
    }

    /// Where each blossom is attached, float32 of shape (blossoms, 3), metres; a view, read-only.
    #[getter]
    fn blossom_positions<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f32>> {
        triples(slf.as_any(), &slf.get().inner.blossoms, |blossom| blossom.position.as_ref())
    }

    /// The axis of each blossom, from its stalk, float32 of shape (blossoms, 3), metres; a view, read-only.
    #[getter]
    fn blossom_along<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f32>> {
        triples(slf.as_any(), &slf.get().inner.blossoms, |blossom| blossom.along.as_ref())
    }

    /// Across each blossom, as long as one unit of its width, float32 of shape (blossoms, 3); a view, read-only.
    #[getter]
    fn blossom_across<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f32>> {
        triples(slf.as_any(), &slf.get().inner.blossoms, |blossom| blossom.across.as_ref())
    }

    /// The stem that carries each blossom, uint32 of shape (blossoms,); a view, read-only.
    #[getter]
    fn blossom_stems<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        column(slf.as_any(), &slf.get().inner.blossoms, |blossom| &blossom.stem)
    }

    /// Number of the form of each blossom in `blossom_faces`, uint16 of shape (blossoms,); a view, read-only.
    #[getter]
    fn blossom_shapes<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u16>> {
        column(slf.as_any(), &slf.get().inner.blossoms, |blossom| &blossom.shape)
    }

    /// The forms of blossoms: the name of each, its corners, float32 of shape (corners, 3), and its faces, lists of corner
    /// numbers, counter-clockwise from inside the cup. A corner (u, v, w) of blossom `i` is at `position + u * across + v *
    /// along + w * normal`, where the normal is the unit vector of `cross(across, along)`, as long as `along`.
    #[getter]
    fn blossom_faces(&self, py: Python<'_>) -> PyResult<Vec<foliage::Blossom>> {
        foliage::blossoms(py, &self.inner)
    }

    /// Vertices of closed surfaces of foliage, which stylised trees have instead of leaves, float32 of shape (vertices, 3),
    /// metres; a view, read-only.
    #[getter]
    fn blob_vertices<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray2<f32>> {
        triples(slf.as_any(), &slf.get().inner.blob_vertices, |vertex| vertex.as_ref())
    }

    /// Triangles of these surfaces, uint32 of shape (triangles, 3): rows of `blob_vertices`, counter-clockwise from outside.
    #[getter]
    fn blob_triangles(&self, py: Python<'_>) -> PyResult<Py<PyArray2<u32>>> {
        foliage::blob_triangles(py, &self.inner)
    }

    /// The stem that carries each of these surfaces, uint32 of shape (surfaces,); a view, read-only.
    #[getter]
    fn blob_stems<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        column(slf.as_any(), &slf.get().inner.blobs, |blob| &blob.stem)
    }

    /// The first row of `blob_vertices` of each of these surfaces, uint32 of shape (surfaces,); a view, read-only.
    #[getter]
    fn blob_first_vertices<'py>(slf: &Bound<'py, Self>) -> Bound<'py, PyArray1<u32>> {
        column(slf.as_any(), &slf.get().inner.blobs, |blob| &blob.first_vertex)
    }

    /// Smallest and largest x, y, z, float64 of shape (2, 3), metres; NaN without any part.
    #[getter]
    fn bounds<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let bounds = Bounds::new(&self.inner, Parts::LEAFY);
        let [min, max] = bounds.map_or([[f64::NAN; 3]; 2], |b| [b.min.to_array(), b.max.to_array()]);
        Ok(PyArray2::from_vec2(py, &[min.to_vec(), max.to_vec()])?)
    }

    /// The axes of its stems above the ground as nodes with parents.
    ///
    /// >>> import pleach
    /// >>> skeleton = pleach.species("acer").grow().skeleton()
    /// >>> skeleton.positions.shape == (len(skeleton), 3), int(skeleton.parents[0])
    /// (True, -1)
    fn skeleton(&self, py: Python<'_>) -> skeleton::Skeleton {
        skeleton::Skeleton { inner: py.detach(|| Skeleton::new(&self.inner)) }
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
        pictures::silhouette(py, &self.inner, size, view)
    }

    /// What of the silhouette is stems, bool of shape (size, size): the same frame, without leaves, blossoms and blobs.
    ///
    /// >>> import pleach
    /// >>> tree = pleach.species("acer").grow()
    /// >>> wood, all = tree.wood(128), tree.silhouette(128)
    /// >>> bool((wood & ~all).any()), bool(wood.sum() < all.sum())
    /// (False, True)
    #[pyo3(signature = (size = 512, *, view = None))]
    fn wood<'py>(
        &self,
        py: Python<'py>,
        size: u32,
        view: Option<Direction>,
    ) -> PyResult<Bound<'py, PyArray2<bool>>> {
        pictures::wood(py, &self.inner, size, view)
    }

    /// How far what the silhouette shows is from the viewer, float32 of shape (size, size): metres along the direction of view
    /// from the plane through the trunk's foot, negative in front of it. NaN where there is no tree.
    ///
    /// >>> import numpy, pleach
    /// >>> tree = pleach.species("acer").grow()
    /// >>> bool((numpy.isfinite(tree.depth(128)) == tree.silhouette(128)).all())
    /// True
    #[pyo3(signature = (size = 512, *, view = None))]
    fn depth<'py>(
        &self,
        py: Python<'py>,
        size: u32,
        view: Option<Direction>,
    ) -> PyResult<Bound<'py, PyArray2<f32>>> {
        pictures::depth(py, &self.inner, size, view)
    }

    /// A shaded picture, uint8 of shape (size, size, 4): red, green, blue, opacity.
    ///
    /// `season` is spring, summer, autumn or winter, by default the species file's own; `background` is studio, transparent,
    /// or a colour such as `#dde6ee`; `ground` is shadow, grass or none; `roots` are drawn where the species has some.
    ///
    /// >>> import pleach
    /// >>> tree = pleach.species("acer").grow()
    /// >>> picture = tree.render(96, season="autumn", background="transparent", ground="none")
    /// >>> int(picture[0, 0, 3])
    /// 0
    #[pyo3(signature = (size = 512, *, view = None, season = None, roots = false, background = None, ground = None, threads = None))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn render<'py>(
        &self,
        py: Python<'py>,
        size: u32,
        view: Option<Direction>,
        season: Option<&str>,
        roots: bool,
        background: Option<&str>,
        ground: Option<&str>,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let painting = Painting { view, season, roots, background, ground, threads };
        pictures::array(
            py,
            pictures::painted(py, &self.species.inner.appearance, &self.inner, size, painting)?,
        )
    }

    /// Writes the tree to a file, and returns the files that were written: the mesh, and the materials and
    /// pictures that it names. The suffix of `path` says the format: glb, obj, ply, stl or usda for meshes; swc for the
    /// axes of the stems with radii, csv for the same as a table of cylinders, with the columns of TreeQSM, and mtg for the
    /// same as a multiscale tree graph of OpenAlea. These three take no options.
    ///
    /// Without options a GLB file is for engines: 50,000 triangles at most, with pictures of the bark; other formats hold
    /// every leaf and twig. A tree that does not fit is written whole, with a warning.
    ///
    /// Options are those of `pleach grow`: `finest` (every leaf and twig), `lod` (levels of detail of fixed coarseness, 1
    /// to 6), or `triangles` (a list of budgets, the largest first; twigs become cards where leaves have no room), `billboard` (a last level of this many cards, 1 to 8), `level`
    /// (only this one, from 0), `lod_extension` (levels by `MSFT_lod` instead of nodes), `tolerance` (how far bark may stray, in millimetres), `leaves` (outline, simple, cards, instances, none),
    /// `textures` (pictures of bark and leaves, 512, 1024 or 2048 pixels a side, or 0 for none: colour and normals, of bark also
    /// roughness and occlusion),
    /// `compress` ("quantize": vertices of 16 and 8 bits), `season` (spring, summer, autumn, winter), `weld` (one surface on a grid with cells of this many millimetres) and
    /// `fillet`, `roots`, `wind`, `growth`, `pivot_painter` (textures beside a GLB file for Unreal's material functions), `sway`, `collision` (convex pieces that things bump into). A format that cannot hold an option refuses it with `PleachError`.
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
        if let Some(format) = SkeletonFormat::from_suffix(&suffix) {
            if options.is_some_and(|options| !options.is_empty()) {
                return Err(PleachError::new_err(format!("a .{suffix} file takes no options")));
            }
            let mut bytes = Vec::new();
            py.detach(|| Skeleton::new(&self.inner).write(format, &mut bytes))?;
            std::fs::write(&path, &bytes)?;
            return Ok(vec![path]);
        }
        let format = MeshFormat::from_suffix(&suffix).ok_or_else(|| {
            let known = [
                &MeshFormat::ALL.map(MeshFormat::suffix)[..],
                &SkeletonFormat::ALL.map(SkeletonFormat::suffix),
            ];
            let known = known.concat().join(", .");
            PleachError::new_err(format!("cannot write `.{suffix}` files, known are .{known}"))
        })?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let file = self.file(py, format, &stem, options)?;
        std::fs::write(&path, &file.bytes)?;
        let mut written = vec![path.clone()];
        for beside in file.beside {
            let path = path.with_file_name(&beside.name);
            std::fs::write(&path, &beside.bytes)?;
            written.push(path);
        }
        Ok(written)
    }

    /// The mesh as the bytes of a GLB file: metres, y up, the foot at the origin. Options are those of `export`, but for
    /// `pivot_painter`, which has files beside it.
    #[pyo3(signature = (**options))]
    fn to_glb<'py>(
        &self,
        py: Python<'py>,
        options: Option<&Bound<'py, PyDict>>,
    ) -> PyResult<Bound<'py, PyBytes>> {
        let file = self.file(py, MeshFormat::Glb, &self.species.inner.name, options)?;
        if !file.beside.is_empty() {
            return Err(PleachError::new_err("`pivot_painter` has textures beside the file: use `export`"));
        }
        Ok(PyBytes::new(py, &file.bytes))
    }

    /// The mesh as arrays, by level of detail and material, with the PNG files that materials show. Options are those of
    /// `export`, but for `lod_extension`, `compress`, `pivot_painter`, `sway`, `collision` and leaves as `"instances"`, which are for files. What they
    /// leave open is not filled in: without `triangles` there are every leaf and twig, without `textures` no pictures.
    ///
    /// >>> import pleach
    /// >>> mesh = pleach.species("acer").grow().mesh(triangles=[8000], textures=512)
    /// >>> sorted(mesh.levels[0]), sorted(mesh.pictures["bark"])
    /// (['bark', 'twigs'], ['color', 'normal', 'roughness'])
    /// >>> sum(len(part.triangles) for part in mesh.levels[0].values()) <= 8000
    /// True
    #[pyo3(signature = (**options))]
    fn mesh(&self, py: Python<'_>, options: Option<&Bound<'_, PyDict>>) -> PyResult<mesh::Mesh> {
        mesh::of_tree(py, &self.species.inner, &self.inner, options)
    }

    /// How wind moves the parts of the tree, a row for each of its stems, leaves, blossoms or blobs. All knots of a stem have
    /// the numbers of the stem, and all vertices of a blob those of the blob.
    ///
    /// >>> import pleach
    /// >>> tree = pleach.species("acer").grow()
    /// >>> wind = tree.wind("leaves")
    /// >>> len(wind) == len(tree.leaf_positions), wind.pivots.shape == wind.bends.shape == (len(wind), 3)
    /// (True, True)
    #[pyo3(signature = (parts = "stems"))]
    fn wind(&self, py: Python<'_>, parts: &str) -> PyResult<wind::Wind> {
        wind::of_parts(py, &self.inner, parts)
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
        pictures::painted(py, &self.species.inner.appearance, &self.inner, SHOWN, Painting::default())?
            .write_png(&mut png)?;
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
    fn file(
        &self,
        py: Python<'_>,
        format: MeshFormat,
        stem: &str,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<ExportedFile> {
        let export = Export::from_json(&json::from_dict(options)?).map_err(of_export)?;
        let made =
            pool::on(py, None, || export.to_file(format, &self.species.inner, self.seed, &self.inner, stem))?;
        let file = made.map_err(of_export)?;
        warn(py, file.note.as_deref())?;
        Ok(file)
    }
}

/// Warns of what is to be told of a file that was written.
pub(crate) fn warn(py: Python<'_>, note: Option<&str>) -> PyResult<()> {
    let Some(note) = note.and_then(|note| CString::new(note).ok()) else { return Ok(()) };
    PyErr::warn(py, &py.get_type::<PyUserWarning>(), &note, 1)
}
