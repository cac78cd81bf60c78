//! The numbers of a fractal tree, each declared once.

use crate::choices::{Dimensions, ThicknessRule};
use crate::noise::Noise;
use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::param::table::{always, scalar};
use pleach_tree::param::{Effect, Handle, Scale};
use pleach_tree::{Kind, Param, Unit};

/// Most generations above the trunk: far more than a tree that branches can have within the limits.
pub(crate) const MAX_GENERATIONS: u16 = 60;
/// Most side branches at a node, deviation included.
pub(crate) const MAX_SIDES: f64 = 12.0;
/// Least and greatest length of a side branch over its parent's, deviation included.
pub(crate) const SCALES: (f64, f64) = (0.05, 1.2);

/// Where most numbers come from.
const SOURCE: &str = "Coffey 2025, §3 and Appendix";
const OURS: &str = "ours, after Coffey 2025, Appendix";

fn real(min: f64, max: f64, search: (f64, f64), default: f64) -> Param {
    scalar(Kind::real(min, max), default).search([search]).source(SOURCE)
}

fn count(min: i64, max: i64, search: (f64, f64), default: f64) -> Param {
    scalar(Kind::integer(min, max), default)
        .search([search])
        .unit(Unit::Count)
        .scale([Scale::Count])
        .effect([Effect::Layout])
        .source(SOURCE)
}

fn degrees(min: f64, max: f64, search: (f64, f64), default: f64) -> Param {
    real(min, max, search, default).unit(Unit::Degrees)
}

fn noise_from_number(number: f64) -> Noise {
    Noise::ALL[usize::from(number > 1.5)]
}

fn leaf_shape_from_number(number: i64) -> LeafShape {
    LeafShape::from_number(number).unwrap_or(LeafShape::Rectangle)
}

pleach_tree::parameters! {
    /// The numbers of a species; angles in radians.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Numbers, enum Id, when Numbers {
        dimensions: Dimensions [Dimensions::from_number], when Numbers::has_branches =>
            scalar(Kind::choice(1, Dimensions::NAMES), 2.0)
                .effect([Effect::Layout])
                .source(SOURCE)
                .group("trunk")
                .doc("in a plane (east to west) as in §3, or in space as in the Appendix");
        generations: u16, when always =>
            count(0, i64::from(MAX_GENERATIONS), (3.0, 9.0), 6.0)
                .group("trunk")
                .handle(0, Handle::Density).doc("branch generations above the trunk; branches grow as (side + central) to this power");
        trunk_length: f64, when always =>
            real(0.05, 100.0, (0.5, 20.0), 3.0)
                .unit(Unit::Meters)
                .scale([Scale::Log])
                .effect([Effect::Size])
                .group("trunk")
                .handle(0, Handle::Height).doc("length of the trunk up to its first node; every other length is a ratio of it");
        thickness: f64, when always =>
            real(0.002, 0.3, (0.01, 0.12), 0.04)
                .scale([Scale::Log])
                .source(OURS)
                .group("trunk")
                .handle(0, Handle::Trunk).doc("radius of the trunk over its length");
        thickness_rule: ThicknessRule [ThicknessRule::from_number], when always =>
            scalar(Kind::choice(1, ThicknessRule::NAMES), 1.0)
                .source("Coffey 2025, §2 and §3")
                .group("trunk")
                .doc("factor: radii are divided by `thickness_factor`; area: a fork keeps the cross-section (da Vinci)");
        thickness_factor: f64, when |n| !n.divides_by_area() =>
            real(1.0, 3.0, (1.1, 2.0), 1.5)
                .group("trunk")
                .doc("radius of a branch over that of its daughters, by the rule `factor`");
        // A tip tapers as if it had daughters, even where it is the trunk's.
        side_branches: f64, when |n| n.has_branches() || n.divides_by_area() =>
            count(0, 8, (1.0, 4.0), 2.0)
                .group("branches")
                .doc("side branches at each node, evenly around it; in a plane as a fan");
        side_branches_v: f64, when Numbers::has_branches =>
            real(0.0, 4.0, (0.0, 2.0), 0.0)
                .unit(Unit::Count)
                .effect([Effect::Layout])
                .neutral(0.0)
                .group("branches")
                .doc("greatest deviation of their number at a node, which is rounded");
        polar: f64 [f64::to_radians], when Numbers::has_sides =>
            degrees(0.0, 180.0, (5.0, 110.0), 35.0)
                .group("branches")
                .handle(0, Handle::Spread).doc("angle between a side branch and its parent; in a plane between the outermost ones and it");
        polar_v: f64 [f64::to_radians], when Numbers::has_sides =>
            degrees(0.0, 90.0, (0.0, 40.0), 0.0)
                .neutral(0.0)
                .group("branches")
                .doc("greatest deviation of that angle");
        azimuth: f64 [f64::to_radians], when Numbers::has_azimuths =>
            degrees(-180.0, 180.0, (0.0, 180.0), 40.0)
                .group("branches")
                .doc("turn of the first side branch about its parent, from the plane of the two branches before");
        azimuth_v: f64 [f64::to_radians], when Numbers::has_azimuths =>
            degrees(0.0, 180.0, (0.0, 90.0), 0.0)
                .neutral(0.0)
                .group("branches")
                .doc("greatest deviation of that turn");
        scale: f64, when |n| n.has_branches() || n.divides_by_area() =>
            real(SCALES.0, SCALES.1, (0.4, 0.9), 0.8)
                .group("branches")
                .doc("length of a side branch over that of its parent");
        scale_v: f64, when |n| n.has_sides() || n.has_central() =>
            real(0.0, 0.6, (0.0, 0.3), 0.0)
                .neutral(0.0)
                .group("branches")
                .doc("greatest deviation of every branch's length ratio");
        apical_ratio: f64, when |n| n.has_branches() || n.divides_by_area() =>
            real(0.0, 5.0, (0.0, 2.5), 0.0)
                .neutral(0.0)
                .breakpoints([0.0])
                .group("branches")
                .doc("apical dominance: length of a central branch over that of a side branch; 0 for none");
        apical_ratio_v: f64, when Numbers::has_central =>
            real(0.0, 2.0, (0.0, 1.0), 0.0)
                .neutral(0.0)
                .group("branches")
                .doc("greatest deviation of that ratio");
        central_polar_v: f64 [f64::to_radians], when Numbers::has_central =>
            degrees(0.0, 60.0, (0.0, 20.0), 0.0)
                .neutral(0.0)
                .source(OURS)
                .group("branches")
                .doc("greatest angle between a central branch and its parent");
        noise: Noise [noise_from_number], when Numbers::has_deviations =>
            scalar(Kind::choice(1, Noise::ALL.map(Noise::name)), 1.0)
                .source(SOURCE)
                .group("branches")
                .doc("law of the deviations: geometric_mean leans below the nominal values, uniform_mean does not");
        drop: f64, when Numbers::has_branches =>
            real(0.0, 0.9, (0.0, 0.6), 0.0)
                .effect([Effect::Layout])
                .neutral(0.0)
                .group("branches")
                .doc("chance that a branch and all that it carries is left out, as on old trees");
        drop_from: u16, when |n| n.has_branches() && n.drop > 0.0 =>
            count(1, i64::from(MAX_GENERATIONS), (1.0, 6.0), 3.0)
                .source(OURS)
                .group("branches")
                .doc("first generation of which branches are left out");
        leaf_rate: f64, when always =>
            real(0.0, 1.0, (0.0, 1.0), 0.0)
                .neutral(0.0)
                .group("leaves")
                .handle(0, Handle::Leaves).doc("share of the last twigs that are leaves, drawn as strokes");
        leaf_length: f64, when Numbers::has_leaves =>
            real(0.05, 5.0, (0.2, 2.0), 1.0)
                .scale([Scale::Log])
                .group("leaves")
                .handle(0, Handle::LeafSize).doc("length of a leaf over that of its twig, along which it lies");
        leaf_width: f64, when Numbers::has_leaves =>
            real(0.02, 2.0, (0.1, 1.0), 0.4).group("leaves").doc("width of a leaf over its length");
        leaf_shape: LeafShape [leaf_shape_from_number], when Numbers::has_leaves =>
            scalar(Kind::choice(1, LeafShape::ALL.map(LeafShape::name)), f64::from(LeafShape::Rectangle as u8))
                .source(OURS)
                .group("leaves")
                .doc("outline of a leaf; the rectangle is the stroke of the paper");
    }
}

impl Numbers {
    fn divides_by_area(&self) -> bool {
        self.thickness_rule == ThicknessRule::Area
    }

    fn has_branches(&self) -> bool {
        self.generations > 0
    }

    fn has_sides(&self) -> bool {
        // A number of side branches below one half is rounded to none.
        self.has_branches() && (self.side_branches > 0.0 || self.side_branches_v >= 0.5)
    }

    fn has_central(&self) -> bool {
        self.has_branches() && self.apical_ratio > 0.0
    }

    /// Whether any branch is turned about its parent.
    fn has_azimuths(&self) -> bool {
        let leaning = self.has_central() && self.central_polar_v > 0.0;
        self.dimensions == Dimensions::Space && (self.has_sides() || leaning)
    }

    fn has_deviations(&self) -> bool {
        let deviations = [
            self.side_branches_v,
            self.polar_v,
            self.azimuth_v,
            self.scale_v,
            self.apical_ratio_v,
            self.central_polar_v,
        ];
        self.has_branches() && deviations.into_iter().any(|deviation| deviation > 0.0)
    }

    fn has_leaves(&self) -> bool {
        self.leaf_rate > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_tree::param::table::Parameters;

    fn with(set: &[(Id, f64)]) -> Numbers {
        let mut values = Numbers::space().defaults();
        set.iter().for_each(|&(id, value)| values[id.slot(0).index()] = value);
        Numbers::read(&values)
    }

    #[test]
    fn numbers_are_read_into_their_fields() {
        let numbers = with(&[
            (Id::dimensions, 1.0),
            (Id::thickness_rule, 2.0),
            (Id::central_polar_v, 60.0),
            (Id::noise, 2.0),
            (Id::drop_from, 4.0),
            (Id::leaf_shape, 1.0),
        ]);
        assert_eq!((numbers.dimensions, numbers.thickness_rule), (Dimensions::Plane, ThicknessRule::Area));
        assert_eq!((numbers.central_polar_v, numbers.drop_from), (f64::to_radians(60.0), 4));
        assert_eq!(
            (numbers.noise, Some(numbers.leaf_shape)),
            (Noise::UniformMean, LeafShape::from_number(1))
        );
        assert_eq!((numbers.polar, numbers.leaf_width), (f64::to_radians(35.0), 0.4), "defaults");
    }

    /// The parameters that do not matter, in order.
    fn inactive(set: &[(Id, f64)]) -> Vec<Id> {
        let numbers = with(set);
        let ids = Id::ALL.iter().copied();
        ids.filter(|id| !Numbers::is_active(id.slot(0), &numbers)).collect()
    }

    #[test]
    fn what_is_not_there_has_no_parameters() {
        use Id::{
            apical_ratio, apical_ratio_v, azimuth, azimuth_v, central_polar_v, dimensions, drop, drop_from,
            generations, leaf_length, leaf_rate, leaf_shape, leaf_width, noise, polar, polar_v, scale,
            scale_v, side_branches, side_branches_v, thickness_factor, thickness_rule,
        };
        // Everything that a tree can have: central branches, deviations, dropped branches, leaves.
        let whole = [(apical_ratio, 1.0), (polar_v, 1.0), (drop, 0.1), (leaf_rate, 1.0)];
        let without = |set: &[(Id, f64)]| inactive(&[&whole[..], set].concat());
        assert_eq!(without(&[]), []);
        assert_eq!(without(&[(leaf_rate, 0.0)]), [leaf_length, leaf_width, leaf_shape]);
        assert_eq!(without(&[(drop, 0.0)]), [drop_from]);
        assert_eq!(without(&[(polar_v, 0.0)]), [noise]);
        for deviation in [side_branches_v, azimuth_v, scale_v, apical_ratio_v, central_polar_v] {
            assert_eq!(without(&[(polar_v, 0.0), (deviation, 0.1)]), [], "{deviation:?}");
        }
        assert_eq!(without(&[(thickness_rule, 2.0)]), [thickness_factor]);
        assert_eq!(without(&[(dimensions, 1.0)]), [azimuth, azimuth_v]);
        assert_eq!(without(&[(apical_ratio, 0.0)]), [apical_ratio_v, central_polar_v]);
        assert_eq!(without(&[(side_branches, 0.0)]), [polar, polar_v, azimuth, azimuth_v]);
        assert_eq!(without(&[(side_branches, 0.0), (side_branches_v, 0.5)]), []);
        let leaning = [(side_branches, 0.0), (central_polar_v, 1.0)];
        assert_eq!(without(&leaning), [polar, polar_v], "central branches that lean are turned");
        let bare = [(side_branches, 0.0), (apical_ratio, 0.0)];
        let of_pairs = [polar, polar_v, azimuth, azimuth_v, scale_v, apical_ratio_v, central_polar_v];
        assert_eq!(without(&bare), of_pairs);
        let of_branches = [
            dimensions,
            side_branches,
            side_branches_v,
            polar,
            polar_v,
            azimuth,
            azimuth_v,
            scale,
            scale_v,
            apical_ratio,
            apical_ratio_v,
            central_polar_v,
            noise,
            drop,
            drop_from,
        ];
        assert_eq!(without(&[(generations, 0.0)]), of_branches);
        // A tip tapers as if it had daughters, even where it is the trunk's.
        let tapered = [
            dimensions,
            thickness_factor,
            side_branches_v,
            polar,
            polar_v,
            azimuth,
            azimuth_v,
            scale_v,
            apical_ratio_v,
            central_polar_v,
            noise,
            drop,
            drop_from,
        ];
        assert_eq!(without(&[(generations, 0.0), (thickness_rule, 2.0)]), tapered);
    }
}
