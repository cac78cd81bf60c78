//! The native part of the Python package `pleach`: the facade, in Python's types.
//!
//! What takes long releases the interpreter's lock and runs on threads of its own ([`pool`]), so that a process
//! that forks later finds none of them. What users call is in `python/pleach/`.

mod arrays;
mod blend;
mod dataset;
mod error;
mod event;
mod fit;
mod foliage;
mod frame;
mod goal;
mod json;
mod mesh;
mod numbers;
mod params;
mod pictures;
mod pool;
mod prior;
mod problem;
mod reading;
mod score;
mod seed;
mod skeleton;
mod species;
mod tree;
mod view;
mod wind;

use pyo3::prelude::*;

#[pymodule(name = "_native")]
mod native {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::blend::{NativeMap, map_species, mix};
    #[pymodule_export]
    use crate::dataset::write_dataset;
    #[pymodule_export]
    use crate::error::{FitError, GoalError, GrowError, PleachError, SpeciesError};
    #[pymodule_export]
    use crate::fit::fit;
    #[pymodule_export]
    use crate::mesh::{Mesh, MeshPart};
    #[pymodule_export]
    use crate::numbers::numbers_of;
    #[pymodule_export]
    use crate::prior::{prior_sample, prior_slots};
    #[pymodule_export]
    use crate::problem::NativeProblem;
    #[pymodule_export]
    use crate::reading::read;
    #[pymodule_export]
    use crate::score::{mask, score};
    #[pymodule_export]
    use crate::skeleton::Skeleton;
    #[pymodule_export]
    use crate::species::{Species, generators, species_named, species_names};
    #[pymodule_export]
    use crate::tree::Tree;
    #[pymodule_export]
    use crate::wind::Wind;

    /// The version, and: registers a species as a mapping.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        let mapping = module.py().import("collections.abc")?.getattr("Mapping")?;
        mapping.call_method1("register", (module.py().get_type::<Species>(),))?;
        Ok(())
    }
}
