//! The declarations. Defaults are the quaking aspen's (Hewitt 2017, §3.2); search ranges span the
//! twenty known species with room on both sides.

use pleach_tree::{Kind, Layout, Param, Unit};
use std::borrow::Cow;

const C: &str = "Hewitt 2017, Appendix C";

type Range = (f64, f64);

const fn real(min: f64, max: f64) -> Kind {
    Kind::Real { min, max }
}

const fn whole(min: i64, max: i64) -> Kind {
    Kind::Integer { min, max }
}

const fn flagged(max: f64, negative: &'static str) -> Kind {
    Kind::Flagged { max, negative }
}

fn scalar(
    group: &'static str,
    name: &'static str,
    kind: Kind,
    unit: Unit,
    default: f64,
    search: Range,
    doc: &'static str,
) -> Param {
    Param {
        name: Cow::Borrowed(name),
        layout: Layout::Scalar,
        kind,
        search: Cow::Owned(vec![search]),
        unit,
        default: Cow::Owned(vec![default]),
        group,
        doc: Cow::Borrowed(doc),
        source: C,
    }
}

fn levels(
    group: &'static str,
    name: &'static str,
    kind: Kind,
    unit: Unit,
    default: [f64; 4],
    search: [Range; 4],
    doc: &'static str,
) -> Param {
    Param {
        layout: Layout::PerLevel,
        search: Cow::Owned(search.to_vec()),
        default: Cow::Owned(default.to_vec()),
        ..scalar(group, name, kind, unit, 0.0, (0.0, 0.0), doc)
    }
}

const SHAPES: &[&str] = &[
    "conical",
    "spherical",
    "hemispherical",
    "cylindrical",
    "tapered_cylindrical",
    "flame",
    "inverse_conical",
    "tend_flame",
    "custom",
];

const LEAF_SHAPES: &[&str] = &[
    "ovate",
    "linear",
    "cordate",
    "maple",
    "palmate",
    "spiky_oak",
    "rounded_oak",
    "elliptic",
    "rectangle",
    "triangle",
];

const BLOSSOM_SHAPES: &[&str] = &["cherry", "orange", "magnolia"];

pub(super) fn params() -> Vec<Param> {
    let mut params = crown();
    params.extend(branching());
    params.extend(stems());
    params.extend(foliage());
    params.extend(pruning());
    params
}

fn crown() -> Vec<Param> {
    use Unit::{Count, Meters, Ratio};
    vec![
        scalar(
            "crown",
            "shape",
            Kind::Choice { first: 0, names: SHAPES },
            Count,
            7.0,
            (0.0, 7.0),
            "outline of the crown, by the lengths of the first-level branches; `custom` takes the pruning envelope's",
        ),
        scalar(
            "crown",
            "g_scale",
            real(0.01, 200.0),
            Meters,
            13.0,
            (4.0, 45.0),
            "height that the tree is scaled to",
        ),
        scalar(
            "crown",
            "g_scale_v",
            real(0.0, 100.0),
            Meters,
            3.0,
            (0.0, 8.0),
            "largest variation of `g_scale`, drawn once a trunk",
        ),
        scalar(
            "crown",
            "levels",
            whole(1, 4),
            Count,
            3.0,
            (2.0, 4.0),
            "number of levels of stems, the trunk included; leaves grow on the deepest",
        ),
        scalar(
            "trunk",
            "ratio",
            real(0.0001, 1.0),
            Ratio,
            0.015,
            (0.004, 0.05),
            "radius of the trunk's base over its length",
        ),
        scalar(
            "branches",
            "ratio_power",
            real(-10.0, 10.0),
            Ratio,
            1.2,
            (0.8, 2.2),
            "how fast radii fall from level to level: power of the length ratio",
        ),
        scalar(
            "trunk",
            "flare",
            real(0.0, 20.0),
            Ratio,
            0.6,
            (0.0, 1.5),
            "by how much of its radius the trunk widens at the ground, within the lowest eighth",
        ),
        scalar(
            "trunk",
            "floor_splits",
            whole(0, 1000),
            Count,
            0.0,
            (0.0, 0.0),
            "number of trunks from the ground; 0 leaves it to `branches[0]`",
        ),
        scalar(
            "trunk",
            "base_splits",
            Kind::FlaggedInteger { max: 20, negative: "a random number up to its magnitude" },
            Count,
            0.0,
            (-3.0, 3.0),
            "forks of the trunk at the height where the bare base ends",
        ),
    ]
}

fn branching() -> Vec<Param> {
    use Unit::{Count, Degrees, Ratio};
    let angle_v = flagged(360.0, "spread along the parent, base to tip, not drawn at random");
    let fan = Kind::FlaggedInteger { max: 10_000, negative: "a fan at the parent's tip" };
    vec![
        levels(
            "branches",
            "base_size",
            real(0.0, 0.999),
            Ratio,
            [0.3, 0.02, 0.02, 0.02],
            [(0.01, 0.96), (0.0, 0.45), (0.0, 0.1), (0.0, 0.1)],
            "part of a stem, from its base, that bears no children or leaves",
        ),
        levels(
            "branches",
            "down_angle",
            real(-360.0, 360.0),
            Degrees,
            [0.0, 60.0, 45.0, 45.0],
            [(0.0, 0.0), (10.0, 110.0), (-15.0, 80.0), (0.0, 60.0)],
            "angle between a child's direction and its parent's",
        ),
        levels(
            "branches",
            "down_angle_v",
            angle_v,
            Degrees,
            [0.0, -50.0, 10.0, 10.0],
            [(0.0, 0.0), (-90.0, 30.0), (-80.0, 35.0), (-30.0, 35.0)],
            "variation of `down_angle`",
        ),
        levels(
            "branches",
            "rotate",
            flagged(360.0, "to the parent's two sides by turns, this far from its upper side"),
            Degrees,
            [0.0, 140.0, 140.0, 77.0],
            [(0.0, 0.0), (-130.0, 180.0), (-130.0, 260.0), (-120.0, 180.0)],
            "angle about the parent from one child (or whorl) to the next; a fan's whole spread",
        ),
        levels(
            "branches",
            "rotate_v",
            real(0.0, 360.0),
            Degrees,
            [0.0; 4],
            [(0.0, 0.0), (0.0, 60.0), (0.0, 60.0), (0.0, 60.0)],
            "variation of `rotate`, for each child",
        ),
        levels(
            "branches",
            "branches",
            fan,
            Count,
            [1.0, 50.0, 30.0, 10.0],
            [(1.0, 1.0), (5.0, 250.0), (0.0, 130.0), (0.0, 120.0)],
            "largest number of children of this level on one parent; at level 0 the number of trunks",
        ),
        levels(
            "branches",
            "branch_dist",
            real(0.0, 100.0),
            Count,
            [0.0; 4],
            [(0.0, 0.0), (0.0, 4.0), (0.0, 2.0), (0.0, 2.0)],
            "how children stand along the parent: 0 alternate, 1 opposite, above 1 whorls of one more than this",
        ),
        levels(
            "stems",
            "length",
            real(0.0, 20.0),
            Ratio,
            [1.0, 0.3, 0.6, 0.0],
            [(0.7, 1.1), (0.1, 1.0), (0.05, 2.0), (0.02, 0.5)],
            "length of a stem over its parent's, at most; the trunk's over the tree's scale",
        ),
        levels(
            "stems",
            "length_v",
            real(0.0, 20.0),
            Ratio,
            [0.0; 4],
            [(0.0, 0.2), (0.0, 0.15), (0.0, 0.2), (0.0, 0.1)],
            "variation of `length`, drawn once a parent",
        ),
    ]
}

fn stems() -> Vec<Param> {
    use Unit::{Count, Degrees, Ratio};
    let zero = (0.0, 0.0);
    vec![
        levels(
            "stems",
            "taper",
            real(0.0, 3.0),
            Ratio,
            [1.0; 4],
            [(0.7, 2.4), (0.7, 2.2), (0.7, 2.0), (0.7, 2.0)],
            "up to 1 the part of the radius lost at the tip, to 2 from a cone to a rounded cylinder, to 3 a string of beads",
        ),
        levels(
            "splits",
            "seg_splits",
            real(0.0, 2.0),
            Count,
            [0.0; 4],
            [(0.0, 1.5), (0.0, 2.0), (0.0, 0.4), zero],
            "forks at each segment, in the mean; fractions are carried from segment to segment",
        ),
        levels(
            "splits",
            "split_angle",
            flagged(360.0, "in the stem's own plane and not towards the ground"),
            Degrees,
            [40.0, 0.0, 0.0, 0.0],
            [(0.0, 60.0), (-80.0, 60.0), (0.0, 60.0), zero],
            "angle of a fork from the vertical",
        ),
        levels(
            "splits",
            "split_angle_v",
            flagged(360.0, "its magnitude, and clones leave without a bend"),
            Degrees,
            [5.0, 0.0, 0.0, 0.0],
            [(0.0, 20.0), (-30.0, 20.0), (0.0, 20.0), zero],
            "variation of `split_angle`",
        ),
        levels(
            "stems",
            "curve_res",
            whole(0, 200),
            Count,
            [5.0, 5.0, 3.0, 1.0],
            [(3.0, 20.0), (3.0, 17.0), (2.0, 12.0), (1.0, 3.0)],
            "segments of a stem; 0 counts as 1",
        ),
        levels(
            "stems",
            "curve",
            real(-3600.0, 3600.0),
            Degrees,
            [0.0, -40.0, -40.0, 0.0],
            [(-10.0, 60.0), (-80.0, 60.0), (-80.0, 40.0), (-40.0, 40.0)],
            "by how much a stem bends from base to tip, downwards where positive",
        ),
        levels(
            "stems",
            "curve_v",
            flagged(3600.0, "a helix with this declination in degrees"),
            Degrees,
            [20.0, 50.0, 75.0, 0.0],
            [(0.0, 220.0), (0.0, 400.0), (-40.0, 500.0), (0.0, 100.0)],
            "variation of `curve`, drawn at each segment",
        ),
        levels(
            "stems",
            "curve_back",
            real(-3600.0, 3600.0),
            Degrees,
            [0.0; 4],
            [(-50.0, 40.0), (-110.0, 90.0), (-40.0, 40.0), zero],
            "bend of the tip's half; `curve` is then the base half's. Opposite signs make an S",
        ),
        levels(
            "stems",
            "bend_v",
            real(0.0, 3600.0),
            Degrees,
            [0.0, 50.0, 0.0, 0.0],
            [(0.0, 160.0), (0.0, 180.0), (0.0, 250.0), (0.0, 50.0)],
            "largest bend sideways from base to tip, drawn at each segment",
        ),
        levels(
            "stems",
            "radius_mod",
            real(0.0, 100.0),
            Ratio,
            [1.0; 4],
            [(0.5, 1.5), (0.3, 1.5), (0.1, 1.5), (0.1, 1.5)],
            "factor on the base radius of the stems of a level",
        ),
        Param {
            layout: Layout::Vector,
            search: Cow::Owned(vec![(-0.3, 0.3), (-0.3, 0.3), (-3.5, 2.5)]),
            default: Cow::Owned(vec![0.0, 0.0, 0.5]),
            ..scalar(
                "stems",
                "tropism",
                real(-100.0, 100.0),
                Ratio,
                0.0,
                (0.0, 0.0),
                "pull on the direction of growth, 10° a segment and unit; z acts from level 2 on",
            )
        },
    ]
}

fn foliage() -> Vec<Param> {
    use Unit::{Count, Meters, Ratio};
    let fan = Kind::FlaggedInteger { max: 100_000, negative: "a fan at the stem's tip" };
    vec![
        scalar(
            "leaves",
            "leaf_blos_num",
            fan,
            Count,
            40.0,
            (-90.0, 400.0),
            "leaves and blossoms on a stem of the deepest level, at most",
        ),
        scalar(
            "leaves",
            "leaf_shape",
            Kind::Choice { first: 1, names: LEAF_SHAPES },
            Count,
            8.0,
            (1.0, 10.0),
            "shape of a leaf",
        ),
        scalar("leaves", "leaf_scale", real(0.0, 100.0), Meters, 0.17, (0.03, 0.9), "length of a leaf"),
        scalar(
            "leaves",
            "leaf_scale_x",
            real(0.0, 100.0),
            Ratio,
            1.0,
            (0.05, 1.2),
            "factor on the width of a leaf",
        ),
        scalar(
            "leaves",
            "leaf_bend",
            real(0.0, 1.0),
            Ratio,
            0.6,
            (0.0, 0.8),
            "how far leaves turn to face outwards and up",
        ),
        scalar(
            "blossoms",
            "blossom_shape",
            Kind::Choice { first: 1, names: BLOSSOM_SHAPES },
            Count,
            1.0,
            (1.0, 3.0),
            "shape of a blossom",
        ),
        scalar("blossoms", "blossom_scale", real(0.0, 100.0), Meters, 0.0, (0.0, 0.2), "scale of a blossom"),
        scalar(
            "blossoms",
            "blossom_rate",
            real(0.0, 1.0),
            Ratio,
            0.0,
            (0.0, 1.0),
            "part of all leaves that are blossoms instead",
        ),
    ]
}

fn pruning() -> Vec<Param> {
    use Unit::Ratio;
    vec![
        scalar(
            "pruning",
            "prune_ratio",
            real(0.0, 1.0),
            Ratio,
            0.0,
            (0.0, 1.0),
            "how far stems that leave the envelope are shortened to fit; 0 turns pruning off",
        ),
        scalar(
            "pruning",
            "prune_width",
            real(0.0, 100.0),
            Ratio,
            0.5,
            (0.25, 0.8),
            "largest radius of the envelope over the tree's scale",
        ),
        scalar(
            "pruning",
            "prune_width_peak",
            real(0.0, 1.0),
            Ratio,
            0.5,
            (0.1, 0.8),
            "height of the envelope's widest place, as a part of the envelope's height from below",
        ),
        scalar(
            "pruning",
            "prune_power_low",
            real(0.0, 100.0),
            Ratio,
            0.5,
            (0.001, 1.5),
            "curvature of the envelope below its widest place: convex under 1, concave over 1",
        ),
        scalar(
            "pruning",
            "prune_power_high",
            real(0.0, 100.0),
            Ratio,
            0.5,
            (0.1, 1.5),
            "curvature of the envelope above its widest place: convex under 1, concave over 1",
        ),
    ]
}
