//! Species, as mappings of their parameters.

use crate::arrays;
use crate::error::{PleachError, of_export, of_growth, of_species};
use crate::params;
use crate::seed::Seed;
use crate::tree::{self, Tree};
use crate::{json, pictures, pool};
use numpy::{PyArray1, PyReadonlyArray1};
use pleach::{Export, Foliage, Forest, Growth, Palette, ParamSpace};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyTuple};
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::Cursor;
use std::path::PathBuf;
use std::sync::Arc;

/// A kind of tree: a generator and the numbers that make it grow this kind.
///
/// A mapping from the names of its declared parameters to what they are: a number, a whole number, the name of a
/// choice, or a tuple of them. It never changes; `replace` gives a changed copy. It can be pickled, compared and
/// hashed. `pleach.species(name)` makes one.
///
/// >>> import pleach
/// >>> acer = pleach.species("acer")
/// >>> acer["shape"], acer["levels"]
/// ('tapered_cylindrical', 3)
/// >>> acer.replace(g_scale=20.0)["g_scale"]
/// 20.0
#[pyclass(frozen, mapping, module = "pleach._native", from_py_object)]
#[derive(Clone)]
pub(crate) struct Species {
    pub(crate) inner: Arc<pleach::Species>,
}

/// Names of all built-in species.
#[pyfunction]
pub(crate) fn species_names() -> Vec<&'static str> {
    pleach::species_names()
}

/// Names of all generators.
///
/// >>> import pleach
/// >>> pleach.generators()[0]
/// 'weber-penn'
#[pyfunction]
pub(crate) fn generators() -> Vec<&'static str> {
    pleach::families().iter().map(|family| family.name()).collect()
}

/// The species of this name, or in this file.
#[pyfunction]
pub(crate) fn species_named(name: &str) -> PyResult<Species> {
    Ok(pleach::species(name).map_err(of_species)?.into())
}

impl From<pleach::Species> for Species {
    fn from(species: pleach::Species) -> Self {
        Self { inner: Arc::new(species) }
    }
}

impl Species {
    fn space(&self) -> &Arc<ParamSpace> {
        self.inner.generator.space()
    }

    fn checked(&self, values: Vec<f64>) -> PyResult<Self> {
        let params = self.space().check(values).map_err(of_species)?;
        Ok(pleach::Species { params, ..(*self.inner).clone() }.into())
    }

    fn value<'py>(&self, py: Python<'py>, number: usize) -> PyResult<Bound<'py, PyAny>> {
        params::get(py, self.space(), self.inner.params.values(), number)
    }
}

#[pymethods]
impl Species {
    /// Reads the text of a species file; `name` is what errors call it.
    ///
    /// Raises `SpeciesError` with every mistake in it, by line and column.
    ///
    /// >>> import pleach
    /// >>> acer = pleach.species("acer")
    /// >>> pleach.Species.from_toml(acer.to_toml()) == acer
    /// True
    #[staticmethod]
    #[pyo3(signature = (text, name = "text"))]
    fn from_toml(text: &str, name: &str) -> PyResult<Self> {
        Ok(pleach::read_species(text.as_bytes(), name).map_err(of_species)?.into())
    }

    /// The species as the text of a species file, which `pleach.species` and the program read.
    fn to_toml(&self) -> String {
        self.inner.to_toml(&[])
    }

    /// Its short name.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// One line about it, possibly empty.
    #[getter]
    fn description(&self) -> &str {
        &self.inner.description
    }

    /// The name of its generator, such as `weber-penn`.
    #[getter]
    fn generator(&self) -> &'static str {
        self.inner.generator.family()
    }

    /// The seed of the tree that was meant, if one was; `grow` takes it by default.
    #[getter]
    fn tree_seed(&self) -> Option<u64> {
        self.inner.tree_seed
    }

    /// How many stems of the tree of `tree_seed` have draws of their own: 0 but for `Fit.individual`.
    #[getter]
    fn own_draws(&self) -> usize {
        self.inner.individual().map_or(0, pleach::Individual::len)
    }

    /// The same without draws of single stems.
    fn kind(&self) -> Self {
        self.inner.kind().into()
    }

    /// Names of all single numbers, such as `length[1]`, in the order of `numbers`.
    #[getter]
    fn slots(&self) -> Vec<String> {
        self.space().slots().map(|slot| self.space().slot_name(slot)).collect()
    }

    /// All numbers, a copy: float64 of shape (slots,). Choices are the number of their name.
    #[getter]
    fn numbers<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::copied(py, self.inner.params.values())
    }

    /// A copy with these numbers, float64 of shape (slots,).
    ///
    /// Raises `SpeciesError` for a number that is not allowed or of a wrong count.
    fn with_numbers(&self, numbers: PyReadonlyArray1<'_, f64>) -> PyResult<Self> {
        self.checked(numbers.as_array().to_vec())
    }

    /// A copy with other values, by the names of parameters or of single numbers such as `length[1]`.
    ///
    /// Raises `SpeciesError` for an unknown name, a value of a wrong kind or beyond what is allowed.
    ///
    /// >>> import pleach
    /// >>> acer = pleach.species("acer")
    /// >>> changed = acer.replace({"length[1]": 0.5}, shape="conical")
    /// >>> changed["length"][1], changed["shape"]
    /// (0.5, 'conical')
    #[pyo3(signature = (changes = None, /, **more))]
    fn replace(
        &self,
        changes: Option<&Bound<'_, PyDict>>,
        more: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let mut values = self.inner.params.values().to_vec();
        for (key, value) in changes.into_iter().chain(more).flatten() {
            params::set(self.space(), &mut values, &key.extract::<String>()?, &value)?;
        }
        self.checked(values)
    }

    /// A copy with another name, description or seed.
    #[pyo3(signature = (name = None, *, description = None, tree_seed = None))]
    fn named(
        &self,
        name: Option<&str>,
        description: Option<String>,
        tree_seed: Option<Seed>,
    ) -> PyResult<Self> {
        let mut species = (*self.inner).clone();
        if let Some(name) = name {
            pleach::species::check_name(name).map_err(of_species)?;
            name.clone_into(&mut species.name);
        }
        species.description = description.unwrap_or(species.description);
        species.tree_seed = tree_seed.map(|Seed(seed)| seed).or(species.tree_seed);
        Ok(species.into())
    }

    /// What is declared about a parameter, or about a single number such as `length[1]`: a dict with the keys of
    /// `pleach params --json`, such as `doc`, `source` (paper and section), `unit`, `kind`, `min` and `max` (what is
    /// allowed), `default`, `group`, `choices`, and for each number in `slots` what searches try (`search`).
    ///
    /// Without a name, a dict of what is declared about each parameter, in the order of `keys`.
    ///
    /// >>> import pleach
    /// >>> pleach.species("acer").declared("ratio")["kind"]
    /// 'real'
    /// >>> list(pleach.species("acer").declared()) == pleach.species("acer").keys()
    /// True
    #[pyo3(signature = (name = None))]
    fn declared<'py>(&self, py: Python<'py>, name: Option<&str>) -> PyResult<Bound<'py, PyAny>> {
        let Some(name) = name else { return params::all_declared(py, self.space()) };
        let (number, one) = params::find_slot(self.space(), name)?;
        params::declared(py, self.space(), number, one)
    }

    /// The colours of `season`, `spring`, `summer`, `autumn` or `winter`; by default the species file's own season, or
    /// summer with all its blossom. A dict: `bark`, `leaf` and `blossom` are sRGB, three numbers from 0 to 255; `pattern`
    /// says how bark is marked, `leaves` and `blossoms` whether the tree wears them.
    ///
    /// >>> import pleach
    /// >>> pleach.species("silver_birch").palette("winter")["leaves"]
    /// False
    /// >>> pleach.species("silver_birch").palette()["bark"]
    /// (217, 214, 204)
    #[pyo3(signature = (season = None))]
    fn palette<'py>(&self, py: Python<'py>, season: Option<&str>) -> PyResult<Bound<'py, PyDict>> {
        let palette = Palette::new(&self.inner.appearance, season.map(pictures::read_season).transpose()?);
        let dict = PyDict::new(py);
        for (name, color) in [("bark", palette.bark), ("leaf", palette.leaf), ("blossom", palette.blossom)] {
            dict.set_item(name, <(u8, u8, u8)>::from(color.0))?;
        }
        dict.set_item("pattern", palette.pattern.name())?;
        dict.set_item("leaves", palette.leaves)?;
        dict.set_item("blossoms", palette.blossoms)?;
        Ok(dict)
    }

    /// Grows a tree: that of `seed`, by default of `tree_seed` or 1; with leaves unless the species file says `bare`
    /// or `leaves` something else. The same seed gives the same tree, bit for bit.
    ///
    /// Raises `GrowError` for trees that are too large.
    ///
    /// >>> import pleach
    /// >>> tree = pleach.species("silver_birch").grow(7)
    /// >>> tree.knots.shape[1], len(tree.leaf_positions) > 1000
    /// (3, True)
    #[pyo3(signature = (seed = None, *, leaves = None))]
    pub(crate) fn grow(&self, py: Python<'_>, seed: Option<Seed>, leaves: Option<bool>) -> PyResult<Tree> {
        let seed = seed.map(|Seed(seed)| seed).or(self.inner.tree_seed).unwrap_or(1);
        let leaves = leaves.unwrap_or(self.inner.foliage == Foliage::All);
        let foliage = if leaves { Foliage::All } else { Foliage::None };
        let grown = py.detach(|| self.inner.grow_with(&Growth { foliage, ..Growth::seed(seed) }));
        Ok(Tree { species: self.clone(), seed, leaves, inner: grown.map_err(of_growth)? })
    }

    /// Writes a forest of trees of this species to a GLB file, `width` × `depth` metres with a tree every `spacing`
    /// metres, and returns how many trees stand there. They share `variants` meshes, the trees of `seed` and of those
    /// after it; `seed` is by default that of `grow`. Trees that look alike are instances of one node, or, if `separate`,
    /// nodes of their own. Options are those of `Tree.export`.
    ///
    /// >>> import pleach, tempfile, pathlib
    /// >>> file = pathlib.Path(tempfile.mkdtemp()) / "wood.glb"
    /// >>> pleach.species("palm").export_forest(file, 40, 30, spacing=10, variants=2, leaves="simple") > 5
    /// True
    #[pyo3(signature = (path, width, depth, *, spacing = 6.0, variants = 4, seed = None, separate = false, **options))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords")]
    fn export_forest(
        &self,
        py: Python<'_>,
        path: PathBuf,
        width: f64,
        depth: f64,
        spacing: f64,
        variants: u32,
        seed: Option<Seed>,
        separate: bool,
        options: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<usize> {
        let seed = seed.map(|Seed(seed)| seed).or(self.inner.tree_seed).unwrap_or(1);
        let export = Export::from_json(&json::from_dict(options)?).map_err(of_export)?;
        let forest = Forest { width, depth, spacing, variants, separate };
        let grow = |seed| self.inner.grow_with(&Growth { foliage: self.inner.foliage, ..Growth::seed(seed) });
        let mut glb = Cursor::new(Vec::new());
        let planted = pool::on(py, None, || export.write_forest(&forest, &self.inner, seed, grow, &mut glb))?;
        let written = planted.map_err(of_export)?;
        tree::warn(py, written.note.as_deref())?;
        std::fs::write(path, glb.into_inner())?;
        Ok(written.trees)
    }

    /// The names of all parameters.
    fn keys(&self) -> Vec<String> {
        self.space().params().iter().map(|param| param.name.to_string()).collect()
    }

    /// What they are, in the order of `keys`.
    fn values<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyAny>>> {
        (0..self.__len__()).map(|number| self.value(py, number)).collect()
    }

    /// Names and what they are.
    fn items<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyAny>)>> {
        Ok(self.keys().into_iter().zip(self.values(py)?).collect())
    }

    /// What a parameter is; `default` where there is none of this name.
    #[pyo3(signature = (name, default = None, /))]
    fn get<'py>(
        &self,
        py: Python<'py>,
        name: &str,
        default: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Option<Bound<'py, PyAny>>> {
        match self.space().find(name) {
            Some((number, _)) => self.value(py, number).map(Some),
            None => Ok(default),
        }
    }

    fn __len__(&self) -> usize {
        self.space().params().len()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(PyTuple::new(py, self.keys())?.try_iter()?.into_any())
    }

    fn __contains__(&self, name: &Bound<'_, PyAny>) -> bool {
        name.extract::<String>().is_ok_and(|name| self.space().find(&name).is_some())
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let Some((number, _)) = self.space().find(name) else {
            return Err(PyKeyError::new_err(name.to_owned()));
        };
        self.value(py, number)
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.to_toml() == other.get().to_toml())
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.to_toml().hash(&mut hasher);
        hasher.finish()
    }

    fn __repr__(&self) -> String {
        let (name, generator) = (&self.inner.name, self.generator());
        match (self.inner.tree_seed, self.own_draws()) {
            (None, _) => format!("<pleach.Species {name} of {generator}>"),
            (Some(seed), 0) => format!("<pleach.Species {name} of {generator}, tree {seed}>"),
            (Some(seed), stems) => {
                format!(
                    "<pleach.Species {name} of {generator}, tree {seed}, {stems} stems with draws of their own>"
                )
            }
        }
    }

    /// In a notebook a species shows its tree.
    fn _repr_png_<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        self.grow(py, None, None)?._repr_png_(py)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let generator = self.inner.generator.family();
        if pleach::families().iter().all(|family| family.name() != generator) {
            let what = format!(
                "a tree of the generator `{generator}` cannot be pickled or copied: read its file again"
            );
            return Err(PleachError::new_err(what));
        }
        let from_toml = py.get_type::<Self>().getattr("from_toml")?;
        PyTuple::new(py, [from_toml, PyTuple::new(py, [self.to_toml()])?.into_any()])
    }
}
