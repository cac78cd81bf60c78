//! The numbers of a fractal tree, each declared once.

use crate::choices::{Dimensions, ThicknessRule};
use crate::noise::Noise;
use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::param::{Effect, Scale};
use pleach_tree::{Kind, Param, ParamSpace, Unit};
use std::sync::{Arc, LazyLock};

/// Names the parameters and numbers them in order of declaration.
macro_rules! ids {
    ($($name:ident)*) => {
        /// Which parameter; its number is its slot, since each has one number.
        #[expect(non_camel_case_types, reason = "the names are those of species files")]
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Id { $($name),* }

        impl Id {
            pub(crate) const ALL: &[Self] = &[$(Self::$name),*];

            pub(crate) const fn name(self) -> &'static str {
                match self { $(Self::$name => stringify!($name)),* }
            }
        }
    };
}

ids! {
    dimensions generations
    trunk_length thickness thickness_rule thickness_factor
    side_branches side_branches_v polar polar_v azimuth azimuth_v
    scale scale_v apical_ratio apical_ratio_v central_polar_v noise
    drop drop_from
    leaf_rate leaf_length leaf_width leaf_shape
}

impl Id {
    /// The number of this parameter in a list of values.
    pub(crate) fn get(self, values: &[f64]) -> f64 {
        values[self as usize]
    }
}

/// Most generations above the trunk: far more than a tree that branches can have within the limits.
pub(crate) const MAX_GENERATIONS: u16 = 60;
/// Most side branches at a node, deviation included.
pub(crate) const MAX_SIDES: f64 = 12.0;
/// Least and greatest length of a side branch over its parent's, deviation included.
pub(crate) const SCALES: (f64, f64) = (0.05, 1.2);

/// Where most numbers come from.
const SOURCE: &str = "Coffey 2025, §3 and Appendix";
const OURS: &str = "ours, after Coffey 2025, Appendix";

static SPACE: LazyLock<Arc<ParamSpace>> = LazyLock::new(|| {
    let params = Id::ALL.iter().map(|&id| declaration(id)).collect();
    Arc::new(ParamSpace::new(params).expect("the declarations agree with themselves"))
});

/// All parameters.
pub(crate) fn space() -> &'static Arc<ParamSpace> {
    &SPACE
}

fn declaration(id: Id) -> Param {
    let real = |min, max, search, default| {
        Param::scalar(id.name(), Kind::real(min, max), default).search([search]).source(SOURCE)
    };
    let count = |min, max, search, default| {
        Param::scalar(id.name(), Kind::integer(min, max), default)
            .search([search])
            .unit(Unit::Count)
            .scale([Scale::Count])
            .effect([Effect::Layout])
            .source(SOURCE)
    };
    let degrees = |param: Param| param.unit(Unit::Degrees);
    match id {
        Id::dimensions => {
            Param::scalar(id.name(), Kind::choice(1, Dimensions::NAMES), 2.0)
                .effect([Effect::Layout])
                .source(SOURCE)
                .group("trunk")
                .doc("in a plane (east to west) as in §3, or in space as in the Appendix")
        }
        Id::generations => count(0, i64::from(MAX_GENERATIONS), (3.0, 9.0), 6.0)
            .group("trunk")
            .doc("branch generations above the trunk; branches grow as (side + central) to this power"),
        Id::trunk_length => real(0.05, 100.0, (0.5, 20.0), 3.0)
            .unit(Unit::Meters)
            .scale([Scale::Log])
            .effect([Effect::Size])
            .group("trunk")
            .doc("length of the trunk up to its first node; every other length is a ratio of it"),
        Id::thickness => real(0.002, 0.3, (0.01, 0.12), 0.04)
            .scale([Scale::Log])
            .source(OURS)
            .group("trunk")
            .doc("radius of the trunk over its length"),
        Id::thickness_rule => Param::scalar(id.name(), Kind::choice(1, ThicknessRule::NAMES), 1.0)
            .source("Coffey 2025, §2 and §3")
            .group("trunk")
            .doc("factor: radii are divided by `thickness_factor`; area: a fork keeps the cross-section (da Vinci)"),
        Id::thickness_factor => real(1.0, 3.0, (1.1, 2.0), 1.5)
            .group("trunk")
            .doc("radius of a branch over that of its daughters, by the rule `factor`"),
        Id::side_branches => count(0, 8, (1.0, 4.0), 2.0)
            .group("branches")
            .doc("side branches at each node, evenly around it; in a plane as a fan"),
        Id::side_branches_v => real(0.0, 4.0, (0.0, 2.0), 0.0)
            .unit(Unit::Count)
            .effect([Effect::Layout])
            .neutral(0.0)
            .group("branches")
            .doc("greatest deviation of their number at a node, which is rounded"),
        Id::polar => degrees(real(0.0, 180.0, (5.0, 110.0), 35.0))
            .group("branches")
            .doc("angle between a side branch and its parent; in a plane between the outermost ones and it"),
        Id::polar_v => degrees(real(0.0, 90.0, (0.0, 40.0), 0.0))
            .neutral(0.0)
            .group("branches")
            .doc("greatest deviation of that angle"),
        Id::azimuth => degrees(real(-180.0, 180.0, (0.0, 180.0), 40.0))
            .group("branches")
            .doc("turn of the first side branch about its parent, from the plane of the two branches before"),
        Id::azimuth_v => degrees(real(0.0, 180.0, (0.0, 90.0), 0.0))
            .neutral(0.0)
            .group("branches")
            .doc("greatest deviation of that turn"),
        Id::scale => real(SCALES.0, SCALES.1, (0.4, 0.9), 0.8)
            .group("branches")
            .doc("length of a side branch over that of its parent"),
        Id::scale_v => real(0.0, 0.6, (0.0, 0.3), 0.0)
            .neutral(0.0)
            .group("branches")
            .doc("greatest deviation of every branch's length ratio"),
        Id::apical_ratio => real(0.0, 5.0, (0.0, 2.5), 0.0)
            .neutral(0.0)
            .breakpoints([0.0])
            .group("branches")
            .doc("apical dominance: length of a central branch over that of a side branch; 0 for none"),
        Id::apical_ratio_v => real(0.0, 2.0, (0.0, 1.0), 0.0)
            .neutral(0.0)
            .group("branches")
            .doc("greatest deviation of that ratio"),
        Id::central_polar_v => degrees(real(0.0, 60.0, (0.0, 20.0), 0.0))
            .neutral(0.0)
            .source(OURS)
            .group("branches")
            .doc("greatest angle between a central branch and its parent"),
        Id::noise => Param::scalar(id.name(), Kind::choice(1, Noise::ALL.map(Noise::name)), 1.0)
            .source(SOURCE)
            .group("branches")
            .doc("law of the deviations: geometric_mean leans below the nominal values, uniform_mean does not"),
        Id::drop => real(0.0, 0.9, (0.0, 0.6), 0.0)
            .effect([Effect::Layout])
            .neutral(0.0)
            .group("branches")
            .doc("chance that a branch and all that it carries is left out, as on old trees"),
        Id::drop_from => count(1, i64::from(MAX_GENERATIONS), (1.0, 6.0), 3.0)
            .source(OURS)
            .group("branches")
            .doc("first generation of which branches are left out"),
        Id::leaf_rate => real(0.0, 1.0, (0.0, 1.0), 0.0)
            .neutral(0.0)
            .group("leaves")
            .doc("share of the last twigs that are leaves, drawn as strokes"),
        Id::leaf_length => real(0.05, 5.0, (0.2, 2.0), 1.0)
            .scale([Scale::Log])
            .group("leaves")
            .doc("length of a leaf over that of its twig, along which it lies"),
        Id::leaf_width => {
            real(0.02, 2.0, (0.1, 1.0), 0.4).group("leaves").doc("width of a leaf over its length")
        }
        Id::leaf_shape => {
            let shapes = Kind::choice(1, LeafShape::ALL.map(LeafShape::name));
            Param::scalar(id.name(), shapes, LeafShape::Rectangle as i64 as f64)
                .source(OURS)
                .group("leaves")
                .doc("outline of a leaf; the rectangle is the stroke of the paper")
        }
    }
}

/// Whether the number of `id` can change a tree with these `values`.
pub(crate) fn is_active(values: &[f64], id: Id) -> bool {
    let is_above_0 = |id: Id| id.get(values) > 0.0;
    let branches = is_above_0(Id::generations);
    // A number of side branches below one half is rounded to none.
    let sides = branches && (is_above_0(Id::side_branches) || Id::side_branches_v.get(values) >= 0.5);
    let central = branches && is_above_0(Id::apical_ratio);
    let in_space = Dimensions::from_number(Id::dimensions.get(values)) == Dimensions::Space;
    let by_area = ThicknessRule::from_number(Id::thickness_rule.get(values)) == ThicknessRule::Area;
    let leaning = central && is_above_0(Id::central_polar_v);
    match id {
        Id::generations | Id::trunk_length | Id::thickness | Id::thickness_rule | Id::leaf_rate => true,
        Id::thickness_factor => !by_area,
        // A tip tapers as if it had daughters, even where it is the trunk's.
        Id::side_branches | Id::scale | Id::apical_ratio => branches || by_area,
        Id::dimensions | Id::side_branches_v | Id::drop => branches,
        Id::polar | Id::polar_v => sides,
        Id::azimuth | Id::azimuth_v => in_space && (sides || leaning),
        Id::scale_v => sides || central,
        Id::apical_ratio_v | Id::central_polar_v => central,
        Id::noise => {
            let sometimes =
                [Id::polar_v, Id::azimuth_v, Id::scale_v, Id::apical_ratio_v, Id::central_polar_v];
            branches && (is_above_0(Id::side_branches_v) || sometimes.into_iter().any(is_above_0))
        }
        Id::drop_from => branches && is_above_0(Id::drop),
        Id::leaf_length | Id::leaf_width | Id::leaf_shape => is_above_0(Id::leaf_rate),
    }
}
