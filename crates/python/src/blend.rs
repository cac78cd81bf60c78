//! Species between species.

use crate::error::{PleachError, of_growth, of_species};
use crate::pool;
use crate::species::Species;
use numpy::PyArray2;
use pleach::{BlendMap, MapSettings, Point};
use pleach_blend::picture::{self, Extras};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

/// The blend of `species` by `shares`.
#[pyfunction]
pub(crate) fn mix(species: Vec<Species>, shares: Vec<f64>, name: &str) -> PyResult<Species> {
    let species = species.iter().map(|one| (*one.inner).clone()).collect();
    Ok(pleach::mix(species, &shares, name).map_err(of_species)?.into())
}

/// The fifteen species of Hewitt's dissertation.
#[pyfunction]
pub(crate) fn map_species() -> PyResult<Vec<Species>> {
    let named = |name: &&str| Ok(pleach::species(name).map_err(of_species)?.into());
    pleach::HEWITT_2017.iter().map(named).collect()
}

/// Species as dots on a plane, and a species for every point of it.
#[pyclass(frozen, module = "pleach._native")]
pub(crate) struct NativeMap {
    map: BlendMap,
}

#[pymethods]
impl NativeMap {
    #[new]
    fn new(species: Vec<Species>) -> PyResult<Self> {
        let species = species.iter().map(|one| (*one.inner).clone()).collect();
        Ok(Self { map: BlendMap::new(species, MapSettings::default()).map_err(of_species)? })
    }

    fn points<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows: Vec<Vec<f64>> = self.map.dots().iter().map(|dot| vec![dot.x, dot.y]).collect();
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    fn explained(&self) -> Vec<f64> {
        self.map.pca().explained()
    }

    /// The species at a point, shares of the landmarks, and how far outside their hull it is.
    fn at(&self, x: f64, y: f64, name: &str) -> PyResult<(Species, Vec<f64>, f64)> {
        let blend = self.map.at(Point { x, y }).map_err(of_species)?;
        let shares = blend.weights.values().to_vec();
        Ok((self.map.species_at(&blend, name).into(), shares, blend.outside))
    }

    fn locate(&self, species: &Species) -> (f64, f64) {
        let Point { x, y } = self.map.locate(&species.inner);
        (x, y)
    }

    /// The picture of the map as a PNG file, with silhouettes of the trees of `seed`.
    fn picture<'py>(&self, py: Python<'py>, seed: u64) -> PyResult<Bound<'py, PyBytes>> {
        let thumbnails = pool::on(py, None, || picture::thumbnails(&self.map, seed))?.map_err(of_growth)?;
        let extras = Extras { thumbnails, ..Extras::default() };
        let scene = picture::scene(&self.map, &extras).map_err(of_species)?;
        let too_large = || PleachError::new_err("the picture of the map is too large for memory");
        Ok(PyBytes::new(py, &scene.to_png().ok_or_else(too_large)?))
    }

    /// The least and the greatest coordinates that the picture shows.
    fn extent<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        Ok(PyArray2::from_vec2(py, &picture::extent(&self.map).map(|point| vec![point.x, point.y]))?)
    }

    /// The pixel of the picture at which a point is.
    fn pixel_at(&self, x: f64, y: f64) -> (f64, f64) {
        picture::pixel_at(&self.map, Point { x, y })
    }

    /// The point that is at a pixel of the picture.
    fn point_at(&self, column: f64, row: f64) -> (f64, f64) {
        let Point { x, y } = picture::point_at(&self.map, (column, row));
        (x, y)
    }
}
