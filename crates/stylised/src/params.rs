//! The declarations: the sliders of Table 3.1 of the report, and what had to be added to them.
//!
//! The report prints a single range (0.1 to 10 for the first width); the others are inferred. Zero is
//! allowed wherever it has a meaning.

use pleach_tree::param::{Effect, Kind, Param, Scale, Slot, Unit};
use pleach_tree::{CheckedParams, ParamSpace, param::ForeignParams};
use std::sync::{Arc, LazyLock};

/// Several trunks part only above this height.
pub(crate) const MIN_PARTING_HEIGHT: f64 = 0.65;

/// What the foliage is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FoliageKind {
    /// Joined spheres at the branches' ends.
    Blob,
    /// A cone of tiers around each trunk.
    Cone,
    /// A crown of fronds on each trunk.
    Palm,
}

const FOLIAGE_KINDS: [&str; 3] = ["blob", "cone", "palm"];

/// A number of a species as the model takes it.
trait Number {
    fn from_value(value: f64) -> Self;
}

impl Number for f64 {
    fn from_value(value: f64) -> Self {
        value
    }
}

impl Number for u32 {
    fn from_value(value: f64) -> Self {
        value as Self
    }
}

impl Number for FoliageKind {
    fn from_value(value: f64) -> Self {
        match value as u32 {
            0 => Self::Blob,
            1 => Self::Cone,
            _ => Self::Palm,
        }
    }
}

/// Declares the numbers by their names, in the order of the declarations.
macro_rules! numbers {
    ($($name:ident: $type:ty,)*) => {
        /// Checked numbers by their names. Lengths and widths are in units of the sliders.
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct Numbers {
            $(pub(crate) $name: $type,)*
        }

        impl Numbers {
            /// `values`, one for each slot, by their names.
            fn from_values(values: &[f64]) -> Self {
                let mut rest = values.iter().copied();
                let mut next = || rest.next().unwrap_or_default();
                Self { $($name: Number::from_value(next()),)* }
            }
        }

        #[cfg(test)]
        const NAMES: &[&str] = &[$(stringify!($name)),*];
    };
}

numbers! {
    scale: f64,
    trunk_width_base: f64,
    trunk_width_end: f64,
    trunk_width: f64,
    trunk_height: f64,
    trunk_randomness: f64,
    leaves_quantity: f64,
    leaves_size: f64,
    leaves_randomness: f64,
    tropism: f64,
    branch_quantity: f64,
    branch_length: f64,
    branch_randomness: f64,
    branch_width: f64,
    root_quantity: f64,
    root_length: f64,
    root_width: f64,
    root_randomness: f64,
    trunks: u32,
    dead_branches: f64,
    foliage: FoliageKind,
    subdivision: u32,
}

impl Numbers {
    /// The numbers of `params`.
    pub(crate) fn new(params: &CheckedParams) -> Result<Self, ForeignParams> {
        Ok(Self::from_values(params.values_in(&SPACE)?))
    }
}

/// Whether the number in `slot` can change a tree with these `values`.
pub(crate) fn is_active(values: &[f64], slot: Slot) -> bool {
    let numbers = Numbers::from_values(values);
    let has_branches = numbers.branch_quantity > 0.0;
    let has_leaves = numbers.leaves_quantity > 0.0;
    let name = SPACE.param_of(slot).name.as_ref();
    match name {
        "tropism" => has_branches || has_leaves && numbers.foliage == FoliageKind::Palm,
        "trunks" => numbers.trunk_height > MIN_PARTING_HEIGHT,
        "dead_branches" | "branch_length" | "branch_randomness" | "branch_width" => has_branches,
        "leaves_size" | "leaves_randomness" | "foliage" | "subdivision" => has_leaves,
        "root_length" | "root_width" | "root_randomness" => numbers.root_quantity > 0.0,
        _ => true,
    }
}

const SOURCE: &str = "Lorite 2021, Table 3.1";

/// A length or a width: a factor of the report's own size.
fn factor(name: &'static str, default: f64, search: (f64, f64)) -> Param {
    Param::scalar(name, Kind::real(0.0, 10.0), default).search([search]).scale([Scale::Log]).source(SOURCE)
}

/// A share from 0 to 1.
fn share(name: &'static str, default: f64) -> Param {
    Param::scalar(name, Kind::real(0.0, 1.0), default).source(SOURCE)
}

/// A slider from 0 to 100.
fn quantity(name: &'static str) -> Param {
    Param::scalar(name, Kind::real(0.0, 100.0), 0.0)
        .effect([Effect::Layout])
        .neutral(0.0)
        .source(SOURCE)
        .breakpoints([0.0])
}

/// Every number of a stylised tree, declared once.
pub(crate) static SPACE: LazyLock<Arc<ParamSpace>> = LazyLock::new(|| {
    let mut params = trunk();
    params.extend(crown());
    params.extend(roots());
    params.extend(ours());
    Arc::new(ParamSpace::new(params).expect("the declarations agree with themselves"))
});

fn trunk() -> Vec<Param> {
    vec![
        Param::scalar("scale", Kind::real(0.01, 100.0), 3.0)
            .search([(0.5, 20.0)])
            .unit(Unit::Meters)
            .scale([Scale::Log])
            .effect([Effect::Size])
            .group("trunk")
            .doc("metres for one unit of every length and width below"),
        factor("trunk_width_base", 1.0, (0.3, 3.0)).group("trunk").doc("width at the foot of the trunk"),
        factor("trunk_width_end", 0.3, (0.1, 1.5))
            .group("trunk")
            .doc("width at the top end of every trunk over that of its body"),
        factor("trunk_width", 1.0, (0.3, 3.0)).group("trunk").doc("width of the trunk between foot and end"),
        factor("trunk_height", 1.0, (0.4, 4.0)).group("trunk").doc("height of the trunk"),
        share("trunk_randomness", 0.0)
            .group("trunk")
            .doc("random offsets of the trunk's vertices; with `trunks = 0`, how many trunks there may be"),
    ]
}

fn crown() -> Vec<Param> {
    vec![
        quantity("leaves_quantity").group("leaves").doc("chance of foliage at a branch's end, in per cent"),
        factor("leaves_size", 1.0, (0.3, 3.0)).group("leaves").doc("size of a blob's first sphere"),
        share("leaves_randomness", 0.0)
            .effect([Effect::Layout])
            .group("leaves")
            .doc("number of spheres that a blob is joined from, 1 to 5, and how far it is moved"),
        Param::scalar("tropism", Kind::real(-1.0, 1.0), 0.0)
            .neutral(0.0)
            .source(SOURCE)
            .group("branches")
            .doc("branches and their foliage rise (positive) or hang (negative)"),
        quantity("branch_quantity").group("branches").doc("branches on each trunk, in per cent of twelve"),
        factor("branch_length", 1.0, (0.3, 3.0)).group("branches").doc("length of branches"),
        share("branch_randomness", 0.0)
            .group("branches")
            .doc("random offsets of a branch's two inner vertices and its end"),
        factor("branch_width", 0.5, (0.1, 1.5)).group("branches").doc("width of branches"),
    ]
}

fn roots() -> Vec<Param> {
    let bins: Vec<f64> = (0..10).map(|i| f64::from(10 * i)).collect();
    vec![
        quantity("root_quantity")
            .breakpoints(bins)
            .group("roots")
            .doc("how many roots, up to sixteen, in ten steps"),
        factor("root_length", 1.0, (0.3, 3.0)).group("roots").doc("length of roots"),
        factor("root_width", 1.0, (0.3, 3.0)).group("roots").doc("width of roots"),
        share("root_randomness", 0.0)
            .breakpoints([0.5])
            .group("roots")
            .doc("random offsets of root vertices; from 0.5 on one more inner vertex, and ends that sink"),
    ]
}

/// What the report's sliders leave to chance or to its future work.
fn ours() -> Vec<Param> {
    vec![
        Param::scalar("trunks", Kind::integer(0, 4), 0.0)
            .unit(Unit::Count)
            .scale([Scale::Count])
            .effect([Effect::Layout])
            .group("trunk")
            .doc("number of trunks; 0 draws it from `trunk_randomness`"),
        Param::scalar("dead_branches", Kind::real(0.0, 1.0), 0.15)
            .search([(0.0, 0.5)])
            .effect([Effect::Layout])
            .group("branches")
            .doc("share of branches that are bare stubs"),
        Param::scalar("foliage", Kind::choice(0, FOLIAGE_KINDS), 0.0)
            .unit(Unit::Count)
            .effect([Effect::Layout])
            .group("leaves")
            .doc("blobs at branch ends, cones of tiers around the trunks, or fronds on top of them"),
        Param::scalar("subdivision", Kind::integer(0, 3), 1.0)
            .search([(1.0, 1.0)])
            .unit(Unit::Count)
            .scale([Scale::Count])
            .group("leaves")
            .doc("level of detail of foliage: a blob has about 30, 120, 500 or 2000 vertices"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_seventeen_sliders_are_those_of_the_report_with_its_defaults() {
        let table = SPACE.params().iter().filter(|param| param.source == SOURCE);
        let sliders: Vec<(&str, f64)> = table.map(|p| (p.name.as_ref(), p.default[0])).collect();
        assert_eq!(sliders.len(), 17);
        for (name, default) in sliders {
            let expected = match name {
                "trunk_width_end" => 0.3,
                "branch_width" => 0.5,
                _ if name.ends_with("_quantity") || name.ends_with("_randomness") || name == "tropism" => 0.0,
                _ => 1.0,
            };
            assert_eq!(default, expected, "{name} (Figure 2.4)");
        }
    }

    #[test]
    fn numbers_are_read_by_their_names() {
        let declared: Vec<&str> = SPACE.params().iter().map(|param| param.name.as_ref()).collect();
        assert_eq!(declared, NAMES);
        let mut values = SPACE.defaults();
        for (name, value) in [("tropism", -0.25), ("root_randomness", 0.75), ("subdivision", 3.0)] {
            let (slot, _) = SPACE.find(name).unwrap();
            values[slot] = value;
        }
        let numbers = Numbers::from_values(&values);
        assert_eq!((numbers.tropism, numbers.root_randomness, numbers.subdivision), (-0.25, 0.75, 3));
        assert_eq!((numbers.scale, numbers.branch_width), (3.0, 0.5));
    }
}
