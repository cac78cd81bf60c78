//! The declarations: the sliders of Table 3.1 of the report, and what had to be added to them.
//!
//! The report prints a single range (0.1 to 10 for the first width); the others are inferred. Zero is
//! allowed wherever it has a meaning.

use pleach_tree::param::table::{always, scalar};
use pleach_tree::param::{Effect, Handle, Kind, Param, Scale, Unit};

/// Several trunks part only above this height.
pub(crate) const MIN_PARTING_HEIGHT: f64 = 0.65;

/// The kind of foliage.
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

impl FoliageKind {
    const fn from_number(number: u32) -> Self {
        match number {
            0 => Self::Blob,
            1 => Self::Cone,
            _ => Self::Palm,
        }
    }
}

const SOURCE: &str = "Lorite 2021, Table 3.1";

/// A length or a width: a factor of the report's own size.
fn factor(default: f64, search: (f64, f64)) -> Param {
    scalar(Kind::real(0.0, 10.0), default).search([search]).scale([Scale::Log]).source(SOURCE)
}

/// A share from 0 to 1.
fn share(default: f64) -> Param {
    scalar(Kind::real(0.0, 1.0), default).source(SOURCE)
}

/// A slider from 0 to 100.
fn quantity() -> Param {
    scalar(Kind::real(0.0, 100.0), 0.0)
        .effect([Effect::Layout])
        .neutral(0.0)
        .source(SOURCE)
        .breakpoints([0.0])
}

/// The ten steps in which roots are added.
fn root_steps() -> Vec<f64> {
    (0..10).map(|i| f64::from(10 * i)).collect()
}

pleach_tree::parameters! {
    /// Checked numbers by their names. Lengths and widths are in units of the sliders.
    ///
    /// The report's sliders come first, in its order; then what they leave to chance or to its future
    /// work.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Numbers, enum Id, when Numbers {
        scale: f64, when always => scalar(Kind::real(0.01, 100.0), 3.0)
            .search([(0.5, 20.0)])
            .unit(Unit::Meters)
            .scale([Scale::Log])
            .effect([Effect::Size])
            .group("trunk")
            .handle(0, Handle::Height).doc("metres for one unit of every length and width below");
        trunk_width_base: f64, when always => factor(1.0, (0.3, 3.0))
            .group("trunk")
            .doc("width at the foot of the trunk");
        trunk_width_end: f64, when always => factor(0.3, (0.1, 1.5))
            .group("trunk")
            .doc("width at the top end of every trunk over that of its body");
        trunk_width: f64, when always => factor(1.0, (0.3, 3.0))
            .group("trunk")
            .handle(0, Handle::Trunk).doc("width of the trunk between foot and end");
        trunk_height: f64, when always => factor(1.0, (0.4, 4.0))
            .group("trunk")
            .handle(0, Handle::BareTrunk).doc("height of the trunk");
        trunk_randomness: f64, when always => share(0.0)
            .group("trunk")
            .doc("random offsets of the trunk's vertices; with `trunks = 0`, how many trunks there may be");
        leaves_quantity: f64, when always => quantity()
            .group("leaves")
            .handle(0, Handle::Leaves).doc("chance of foliage at a branch's end, in per cent");
        leaves_size: f64, when Numbers::has_leaves => factor(1.0, (0.3, 3.0))
            .group("leaves")
            .handle(0, Handle::LeafSize).doc("size of a blob's first sphere");
        leaves_randomness: f64, when Numbers::has_leaves => share(0.0)
            .effect([Effect::Layout])
            .group("leaves")
            .doc("number of spheres that a blob is joined from, 1 to 5, and how far it is moved");
        tropism: f64, when |n| n.has_branches() || n.has_leaves() && n.foliage == FoliageKind::Palm =>
            scalar(Kind::real(-1.0, 1.0), 0.0)
                .neutral(0.0)
                .source(SOURCE)
                .group("branches")
                .handle(0, Handle::Rise).doc("branches and their foliage rise (positive) or hang (negative)");
        branch_quantity: f64, when always => quantity()
            .group("branches")
            .handle(0, Handle::Density).doc("branches on each trunk, in per cent of twelve");
        branch_length: f64, when Numbers::has_branches => factor(1.0, (0.3, 3.0))
            .group("branches")
            .handle(0, Handle::CrownWidth).doc("length of branches");
        branch_randomness: f64, when Numbers::has_branches => share(0.0)
            .group("branches")
            .doc("random offsets of a branch's two inner vertices and its end");
        branch_width: f64, when Numbers::has_branches => factor(0.5, (0.1, 1.5))
            .group("branches")
            .doc("width of branches");
        root_quantity: f64, when always => quantity()
            .breakpoints(root_steps())
            .group("roots")
            .doc("how many roots, up to sixteen, in ten steps");
        root_length: f64, when Numbers::has_roots => factor(1.0, (0.3, 3.0))
            .group("roots")
            .doc("length of roots");
        root_width: f64, when Numbers::has_roots => factor(1.0, (0.3, 3.0))
            .group("roots")
            .doc("width of roots");
        root_randomness: f64, when Numbers::has_roots => share(0.0)
            .breakpoints([0.5])
            .group("roots")
            .doc("random offsets of root vertices; from 0.5 on one more inner vertex, and ends that sink");
        trunks: u32, when |n| n.trunk_height > MIN_PARTING_HEIGHT => scalar(Kind::integer(0, 4), 0.0)
            .unit(Unit::Count)
            .scale([Scale::Count])
            .effect([Effect::Layout])
            .group("trunk")
            .doc("number of trunks; 0 draws it from `trunk_randomness`");
        dead_branches: f64, when Numbers::has_branches => scalar(Kind::real(0.0, 1.0), 0.15)
            .search([(0.0, 0.5)])
            .effect([Effect::Layout])
            .group("branches")
            .doc("share of branches that are bare stubs");
        foliage: FoliageKind [FoliageKind::from_number], when Numbers::has_leaves =>
            scalar(Kind::choice(0, FOLIAGE_KINDS), 0.0)
                .unit(Unit::Count)
                .effect([Effect::Layout])
                .group("leaves")
                .doc("blobs at branch ends, cones of tiers around the trunks, or fronds on top of them");
        subdivision: u32, when Numbers::has_leaves => scalar(Kind::integer(0, 3), 1.0)
            .search([(1.0, 1.0)])
            .unit(Unit::Count)
            .scale([Scale::Count])
            .group("leaves")
            .doc("level of detail of foliage: a blob has about 30, 120, 500 or 2000 vertices");
    }
}

impl Numbers {
    fn has_branches(&self) -> bool {
        self.branch_quantity > 0.0
    }

    fn has_leaves(&self) -> bool {
        self.leaves_quantity > 0.0
    }

    fn has_roots(&self) -> bool {
        self.root_quantity > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_tree::param::table::Parameters;

    #[test]
    fn the_seventeen_sliders_are_those_of_the_report_with_its_defaults() {
        let table = Numbers::space().params().iter().filter(|param| param.source == SOURCE);
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

    fn with(set: &[(Id, f64)]) -> Vec<f64> {
        let mut values = Numbers::space().defaults();
        set.iter().for_each(|&(id, value)| values[id.slot(0).index()] = value);
        values
    }

    #[test]
    fn numbers_are_read_into_their_fields() {
        let set =
            [(Id::tropism, -0.25), (Id::root_randomness, 0.75), (Id::foliage, 2.0), (Id::subdivision, 3.0)];
        let numbers = Numbers::read(&with(&set));
        assert_eq!((numbers.tropism, numbers.root_randomness, numbers.subdivision), (-0.25, 0.75, 3));
        assert_eq!((numbers.scale, numbers.branch_width), (3.0, 0.5));
        assert_eq!(numbers.foliage, FoliageKind::Palm);
    }

    /// The parameters that do not matter, in order.
    fn inactive(set: &[(Id, f64)]) -> Vec<Id> {
        let numbers = Numbers::read(&with(set));
        let ids = Id::ALL.iter().copied();
        ids.filter(|id| !Numbers::is_active(id.slot(0), &numbers)).collect()
    }

    #[test]
    fn what_is_not_there_has_no_parameters() {
        use Id::{
            branch_length, branch_quantity, branch_randomness, branch_width, dead_branches, foliage,
            leaves_quantity, leaves_randomness, leaves_size, root_length, root_quantity, root_randomness,
            root_width, subdivision, tropism, trunk_height, trunks,
        };
        let all = [(leaves_quantity, 1.0), (branch_quantity, 1.0), (root_quantity, 1.0)];
        let [leaves, branches, roots] = all;
        assert_eq!(inactive(&all), []);
        assert_eq!(
            inactive(&[branches, roots]),
            [leaves_size, leaves_randomness, foliage, subdivision],
            "no leaves"
        );
        let of_branches = [tropism, branch_length, branch_randomness, branch_width, dead_branches];
        assert_eq!(inactive(&[leaves, roots]), of_branches, "no branches");
        assert_eq!(inactive(&[leaves, roots, (foliage, 2.0)]), of_branches[1..], "fronds hang all the same");
        assert_eq!(inactive(&[leaves, branches]), [root_length, root_width, root_randomness], "no roots");
        let low = [leaves, branches, roots, (trunk_height, MIN_PARTING_HEIGHT)];
        assert_eq!(inactive(&low), [trunks], "too low to part");
    }
}
