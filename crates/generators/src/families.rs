//! The families of generators.

use pleach_tree::Family;

/// Every family of generators, the default one first.
#[must_use]
pub fn families() -> &'static [&'static dyn Family] {
    &[
        &pleach_weber_penn::WeberPennFamily,
        &pleach_lsystem::LSystemFamily,
        &pleach_fractal::FractalFamily,
        &pleach_least_cost_path::LeastCostPathFamily,
        &pleach_stylised::StylisedFamily,
        &pleach_space_colonization::SpaceColonizationFamily,
    ]
}

/// The family of this name.
///
/// # Errors
/// [`UnknownFamily`] if no family has this name.
pub fn family(name: &str) -> Result<&'static dyn Family, UnknownFamily> {
    let known = families().iter().copied().find(|family| family.name() == name);
    known.ok_or_else(|| UnknownFamily { name: name.to_owned() })
}

/// A word that names no family of generators.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown generator `{}`, known are {}", pleach_tree::param::shown(.name), family_names().join(", "))]
pub struct UnknownFamily {
    /// The word.
    pub name: String,
}

/// The names of all families, the default one first.
#[must_use]
pub fn family_names() -> Vec<&'static str> {
    families().iter().map(|family| family.name()).collect()
}

/// The family of species files that name none, and of fits without `--generator`.
#[must_use]
pub fn default_family() -> &'static dyn Family {
    families()[0]
}
