//! The declarations: one row for each parameter, in the order of their slots.
//!
//! Defaults are the quaking aspen's (Hewitt 2017, §3.2); search ranges span the twenty known species
//! with room on both sides. The last five rows are ours: how a tree stands. How a row is read: see
//! [`pleach_tree::parameters!`].

use super::active::Facts;
use super::declare::{heights, levels, scalar, stature, vector};
use super::read::{blossom_shape, leaf_shape, segments};
use super::{HEIGHTS, LEVELS};
use glam::DVec3;
use pleach_tree::leaf_shape::{BlossomShape, LeafShape};
use pleach_tree::param::Effect::{Layout, Plain, Size, SizeJitter};
use pleach_tree::param::Scale::{Count, FineNearZero, Linear, Log};
use pleach_tree::param::Unit;
use pleach_tree::param::table::always;
use pleach_tree::param::{Handle, Kind};

const SHAPES: [&str; 9] = [
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

pleach_tree::parameters! {
    /// Checked parameters in the units and groups that growing needs.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Model, enum Id, when Facts {
        shape: i64, when Facts::has_branches =>
            scalar(
                "crown",
                "outline of the crown, by the lengths of the first-level branches; `custom` takes the pruning envelope's",
                Kind::choice(0, SHAPES),
                7.0,
            )
                .search([(0.0, 7.0)])
                .unit(Unit::Count).handle(0, Handle::CrownShape);
        g_scale: f64, when always =>
            scalar("crown", "height that the tree is scaled to", Kind::real(0.01, 200.0), 13.0)
                .search([(4.0, 45.0)])
                .unit(Unit::Meters).scale([Log]).effect([Size]).handle(0, Handle::Height);
        g_scale_v: f64, when always =>
            scalar("crown", "largest variation of `g_scale`, drawn once a trunk", Kind::real(0.0, 100.0), 3.0)
                .search([(0.0, 8.0)])
                .unit(Unit::Meters).effect([SizeJitter]).neutral(0.0);
        level_count = "levels": usize, when always =>
            scalar(
                "crown",
                "number of levels of stems, the trunk included; leaves grow on the deepest",
                Kind::integer(1, 4),
                3.0,
            )
                .search([(2.0, 4.0)])
                .unit(Unit::Count).scale([Count]).effect([Layout]);
        ratio: f64, when always =>
            scalar("trunk", "radius of the trunk's base over its length", Kind::real(0.0001, 1.0), 0.015)
                .search([(0.004, 0.05)])
                .unit(Unit::Ratio).scale([Log]).handle(0, Handle::Trunk);
        ratio_power: f64, when Facts::has_branches =>
            scalar(
                "branches",
                "how fast radii fall from level to level: power of the length ratio",
                Kind::real(-10.0, 10.0),
                1.2,
            )
                .search([(0.8, 2.2)])
                .unit(Unit::Ratio).neutral(0.0);
        flare: f64, when always =>
            scalar(
                "trunk",
                "by how much of its radius the trunk widens at the ground, within the lowest eighth",
                Kind::real(0.0, 20.0),
                0.6,
            )
                .search([(0.0, 1.5)])
                .unit(Unit::Ratio).neutral(0.0);
        floor_splits: u32, when always =>
            scalar(
                "trunk",
                "number of trunks from the ground; 0 leaves it to `branches[0]`",
                Kind::integer(0, 1000),
                0.0,
            )
                .search([(0.0, 0.0)])
                .unit(Unit::Count).scale([Count]).effect([Layout]);
        base_splits: i64, when |f| !f.model.levels[0].is_helix() =>
            scalar(
                "trunk",
                "forks of the trunk at the height where the bare base ends",
                Kind::flagged_integer(20, "a random number up to its magnitude"),
                0.0,
            )
                .search([(-3.0, 3.0)])
                .unit(Unit::Count).scale([Count]).effect([Layout]);
        /// The parameters of one level; angles in radians.
        #[derive(Clone, Copy, Debug, Default)]
        [Level; LEVELS] levels {
            base_size: f64, when Facts::has_stems =>
                levels(
                    "branches",
                    "part of a stem, from its base, that bears no children or leaves",
                    Kind::real(0.0, 0.999),
                    [0.3, 0.02, 0.02, 0.02],
                )
                    .search([(0.01, 0.96), (0.0, 0.45), (0.0, 0.1), (0.0, 0.1)])
                    .unit(Unit::Ratio).scale([FineNearZero, Linear, Linear, Linear]).effect([Layout]).neutral(0.0).handle(0, Handle::BareTrunk);
            down_angle: f64 [f64::to_radians], when Facts::places_children =>
                levels(
                    "branches",
                    "angle between a child's direction and its parent's",
                    Kind::real(-360.0, 360.0),
                    [0.0, 60.0, 45.0, 45.0],
                )
                    .search([(0.0, 0.0), (10.0, 110.0), (-15.0, 80.0), (0.0, 60.0)])
                    .unit(Unit::Degrees).neutral(0.0).handle(1, Handle::Spread);
            down_angle_v: f64 [f64::to_radians], when Facts::places_children =>
                levels(
                    "branches",
                    "variation of `down_angle`",
                    Kind::flagged(360.0, "spread along the parent, base to tip, not drawn at random"),
                    [0.0, -50.0, 10.0, 10.0],
                )
                    .search([(0.0, 0.0), (-90.0, 30.0), (-80.0, 35.0), (-30.0, 35.0)])
                    .unit(Unit::Degrees).neutral(0.0);
            rotate: f64 [f64::to_radians], when Facts::places_children =>
                levels(
                    "branches",
                    "angle about the parent from one child (or whorl) to the next; a fan's whole spread",
                    Kind::flagged(360.0, "to the parent's two sides alternately, this far from its upper side"),
                    [0.0, 140.0, 140.0, 77.0],
                )
                    .search([(0.0, 0.0), (-130.0, 180.0), (-130.0, 260.0), (-120.0, 180.0)])
                    .unit(Unit::Degrees).effect([Layout]).neutral(0.0);
            rotate_v: f64 [f64::to_radians], when Facts::places_children =>
                levels("branches", "variation of `rotate`, for each child", Kind::real(0.0, 360.0), [0.0; 4])
                    .search([(0.0, 0.0), (0.0, 60.0), (0.0, 60.0), (0.0, 60.0)])
                    .unit(Unit::Degrees).neutral(0.0);
            branches: f64, when Facts::has_stems =>
                levels(
                    "branches",
                    "largest number of children of this level on one parent; at level 0 the number of trunks",
                    Kind::flagged_integer(10_000, "a fan at the parent's tip"),
                    [1.0, 50.0, 30.0, 10.0],
                )
                    .search([(1.0, 1.0), (5.0, 250.0), (0.0, 130.0), (0.0, 120.0)])
                    .unit(Unit::Count).scale([Count]).effect([Layout]).handle(1, Handle::Density);
            branch_dist: f64, when |f| f.places_children() && !f.is_leaf_fan() =>
                levels(
                    "branches",
                    "how children stand along the parent: 0 alternate, 1 opposite, above 1 whorls of one more than this",
                    Kind::real(0.0, 100.0),
                    [0.0; 4],
                )
                    .search([(0.0, 0.0), (0.0, 4.0), (0.0, 2.0), (0.0, 2.0)])
                    .unit(Unit::Count).effect([Layout]).neutral(0.0).breakpoints([1.0]);
            length: f64, when Facts::has_stems =>
                levels(
                    "stems",
                    "length of a stem over its parent's, at most; the trunk's over the tree's scale",
                    Kind::real(0.0, 20.0),
                    [1.0, 0.3, 0.6, 0.0],
                )
                    .search([(0.7, 1.1), (0.1, 1.0), (0.05, 2.0), (0.02, 0.5)])
                    .unit(Unit::Ratio).scale([Linear, Log, Log, Log]).neutral(0.0).handle(1, Handle::CrownWidth);
            length_v: f64, when Facts::has_stems =>
                levels("stems", "variation of `length`, drawn once a parent", Kind::real(0.0, 20.0), [0.0; 4])
                    .search([(0.0, 0.2), (0.0, 0.15), (0.0, 0.2), (0.0, 0.1)])
                    .unit(Unit::Ratio).effect([SizeJitter, Plain, Plain, Plain]).neutral(0.0);
            taper: f64, when Facts::has_stems =>
                levels(
                    "stems",
                    "up to 1 the part of the radius lost at the tip, to 2 from a cone to a rounded cylinder, to 3 a string of beads",
                    Kind::real(0.0, 3.0),
                    [1.0; 4],
                )
                    .search([(0.7, 2.4), (0.7, 2.2), (0.7, 2.0), (0.7, 2.0)])
                    .unit(Unit::Ratio).neutral(0.0).breakpoints([1.0, 2.0])
                    // Above 1, stems are pipes with round ends and strings of beads.
                    .plausible([(0.7, 1.0)]);
            seg_splits: f64, when Facts::has_curved_stems =>
                levels(
                    "splits",
                    "forks at each segment, in the mean; fractions are carried from segment to segment",
                    Kind::real(0.0, 2.0),
                    [0.0; 4],
                )
                    .search([(0.0, 1.5), (0.0, 2.0), (0.0, 0.4), (0.0, 0.0)])
                    .unit(Unit::Count).effect([Layout]).neutral(0.0);
            split_angle: f64 [f64::to_radians], when |f| f.has_curved_stems() && f.forks() =>
                levels(
                    "splits",
                    "angle of a fork from the vertical",
                    Kind::flagged(360.0, "in the stem's own plane and not towards the ground"),
                    [40.0, 0.0, 0.0, 0.0],
                )
                    .search([(0.0, 60.0), (-80.0, 60.0), (0.0, 60.0), (0.0, 0.0)])
                    .unit(Unit::Degrees).neutral(0.0);
            split_angle_v: f64 [f64::to_radians], when |f| f.has_curved_stems() && f.forks() =>
                levels(
                    "splits",
                    "variation of `split_angle`",
                    Kind::flagged(360.0, "its magnitude, and clones leave without a bend"),
                    [5.0, 0.0, 0.0, 0.0],
                )
                    .search([(0.0, 20.0), (-30.0, 20.0), (0.0, 20.0), (0.0, 0.0)])
                    .unit(Unit::Degrees).neutral(0.0);
            curve_res: u32 [segments], when Facts::has_stems =>
                levels("stems", "segments of a stem; 0 counts as 1", Kind::integer(0, 200), [5.0, 5.0, 3.0, 1.0])
                    .search([(3.0, 20.0), (3.0, 17.0), (2.0, 12.0), (1.0, 3.0)])
                    .unit(Unit::Count).scale([Count]).effect([Layout]);
            curve: f64 [f64::to_radians], when Facts::has_curved_stems =>
                levels(
                    "stems",
                    "by how much a stem bends from base to tip, downwards where positive",
                    Kind::real(-3600.0, 3600.0),
                    [0.0, -40.0, -40.0, 0.0],
                )
                    .search([(-10.0, 60.0), (-80.0, 60.0), (-80.0, 40.0), (-40.0, 40.0)])
                    .unit(Unit::Degrees).neutral(0.0);
            curve_v: f64 [f64::to_radians], when Facts::has_stems =>
                levels(
                    "stems",
                    "variation of `curve`, drawn at each segment",
                    Kind::flagged(3600.0, "a helix with this declination in degrees"),
                    [20.0, 50.0, 75.0, 0.0],
                )
                    .search([(0.0, 220.0), (0.0, 400.0), (-40.0, 500.0), (0.0, 100.0)])
                    .unit(Unit::Degrees).neutral(0.0);
            curve_back: f64 [f64::to_radians], when Facts::has_curved_stems =>
                levels(
                    "stems",
                    "bend of the tip's half; `curve` is then the base half's. Opposite signs make an S",
                    Kind::real(-3600.0, 3600.0),
                    [0.0; 4],
                )
                    .search([(-50.0, 40.0), (-110.0, 90.0), (-40.0, 40.0), (0.0, 0.0)])
                    .unit(Unit::Degrees).neutral(0.0);
            bend_v: f64 [f64::to_radians], when Facts::has_curved_stems =>
                levels(
                    "stems",
                    "largest bend sideways from base to tip, drawn at each segment",
                    Kind::real(0.0, 3600.0),
                    [0.0, 50.0, 0.0, 0.0],
                )
                    .search([(0.0, 160.0), (0.0, 180.0), (0.0, 250.0), (0.0, 50.0)])
                    .unit(Unit::Degrees).neutral(0.0);
            radius_mod: f64, when Facts::has_stems =>
                levels(
                    "stems",
                    "factor on the base radius of the stems of a level",
                    Kind::real(0.0, 100.0),
                    [1.0; 4],
                )
                    .search([(0.5, 1.5), (0.3, 1.5), (0.1, 1.5), (0.1, 1.5)])
                    .unit(Unit::Ratio).scale([Log]).neutral(0.0);
        }
        tropism: DVec3 [DVec3::from_array], when |f| f.index < 2 || f.model.level_count > 2 =>
            vector(
                "stems",
                "pull on the direction of growth, 10° a segment and unit; z acts from level 2 on",
                Kind::real(-100.0, 100.0),
                [0.0, 0.0, 0.5],
            )
                .search([(-0.3, 0.3), (-0.3, 0.3), (-3.5, 2.5)])
                .unit(Unit::Ratio).neutral(0.0).handle(2, Handle::Rise);
        leaf_blos_num: f64, when Facts::has_branches =>
            scalar(
                "leaves",
                "leaves and blossoms on a stem of the deepest level, at most",
                Kind::flagged_integer(100_000, "a fan at the stem's tip"),
                40.0,
            )
                .search([(-90.0, 400.0)])
                .unit(Unit::Count).scale([Count]).effect([Layout]).handle(0, Handle::Leaves);
        leaf_shape: LeafShape [leaf_shape], when |f| f.has_leaves() && f.model.blossom_rate < 1.0 =>
            scalar("leaves", "shape of a leaf", Kind::choice(1, LeafShape::ALL.map(LeafShape::name)), 8.0)
                .search([(1.0, LeafShape::ALL.len() as f64)])
                .unit(Unit::Count);
        leaf_scale: f64, when |f| f.has_leaves() && f.model.blossom_rate < 1.0 =>
            scalar("leaves", "length of a leaf", Kind::real(0.0, 100.0), 0.17)
                .search([(0.03, 0.9)])
                .unit(Unit::Meters).scale([Log]).effect([Size]).neutral(0.0)
                // Half a metre is a large leaf; fronds of palms and fans are longer, where a fit starts there.
                .plausible([(0.03, 0.5)]).handle(0, Handle::LeafSize);
        leaf_scale_x: f64, when |f| f.has_leaves() && f.model.blossom_rate < 1.0 =>
            scalar("leaves", "factor on the width of a leaf", Kind::real(0.0, 100.0), 1.0)
                .search([(0.05, 1.2)])
                .unit(Unit::Ratio).scale([Log]).neutral(0.0);
        leaf_bend: f64, when Facts::has_leaves =>
            scalar("leaves", "how far leaves turn to face outwards and up", Kind::real(0.0, 1.0), 0.6)
                .search([(0.0, 0.8)])
                .unit(Unit::Ratio).neutral(0.0);
        blossom_shape: BlossomShape [blossom_shape], when |f| f.has_leaves() && f.model.blossom_rate > 0.0 =>
            scalar(
                "blossoms",
                "shape of a blossom",
                Kind::choice(1, BlossomShape::ALL.map(BlossomShape::name)),
                1.0,
            )
                .search([(1.0, 3.0)])
                .unit(Unit::Count);
        blossom_scale: f64, when |f| f.has_leaves() && f.model.blossom_rate > 0.0 =>
            scalar("blossoms", "scale of a blossom", Kind::real(0.0, 100.0), 0.0)
                .search([(0.0, 0.2)])
                .unit(Unit::Meters).effect([Size]).neutral(0.0);
        blossom_rate: f64, when Facts::has_leaves =>
            scalar("blossoms", "part of all leaves that are blossoms instead", Kind::real(0.0, 1.0), 0.0)
                .search([(0.0, 1.0)])
                .unit(Unit::Ratio).neutral(0.0);
        prune_ratio: f64, when always =>
            scalar(
                "pruning",
                "how far stems that leave the envelope are shortened to fit; 0 turns pruning off",
                Kind::real(0.0, 1.0),
                0.0,
            )
                .search([(0.0, 1.0)])
                .unit(Unit::Ratio).neutral(0.0);
        prune_width: f64, when Facts::prunes_by_envelope =>
            scalar(
                "pruning",
                "largest radius of the envelope over the tree's scale",
                Kind::real(0.0, 100.0),
                0.5,
            )
                .search([(0.25, 0.8)])
                .unit(Unit::Ratio).scale([Log]).neutral(0.0);
        prune_width_peak: f64, when Facts::has_envelope =>
            scalar(
                "pruning",
                "height of the envelope's widest place, as a part of the envelope's height from below",
                Kind::real(0.0, 1.0),
                0.5,
            )
                .search([(0.1, 0.8)])
                .unit(Unit::Ratio).neutral(0.0);
        prune_power_low: f64, when Facts::has_envelope =>
            scalar(
                "pruning",
                "curvature of the envelope below its widest place: convex under 1, concave over 1",
                Kind::real(0.0, 100.0),
                0.5,
            )
                .search([(0.001, 1.5)])
                .unit(Unit::Ratio).scale([FineNearZero]).neutral(0.0);
        prune_power_high: f64, when Facts::has_envelope =>
            scalar(
                "pruning",
                "curvature of the envelope above its widest place: convex under 1, concave over 1",
                Kind::real(0.0, 100.0),
                0.5,
            )
                .search([(0.1, 1.5)])
                .unit(Unit::Ratio).scale([Log]).neutral(0.0);
        lean: f64 [f64::to_radians], when always =>
            stature(
                "lean of the trunk towards +x, with which all that it carries is displaced",
                Kind::real(-60.0, 60.0),
                0.0,
            )
                .search([(-30.0, 30.0)])
                .unit(Unit::Degrees).handle(0, Handle::Lean);
        bow: f64 [f64::to_radians], when always =>
            stature(
                "by how much more the trunk leans at its top than at its foot",
                Kind::real(-90.0, 90.0),
                0.0,
            )
                .search([(-40.0, 40.0)])
                .unit(Unit::Degrees);
        side: f64, when Facts::has_branches =>
            stature(
                "one-sidedness: by which part first-level branches are longer towards +x and shorter towards -x",
                Kind::real(-1.0, 1.0),
                0.0,
            )
                .search([(-0.8, 0.8)])
                .unit(Unit::Ratio);
        crown_depth: f64, when Facts::has_branches =>
            stature(
                "depth of the crown over its width along x, by the lengths of first-level branches: 1 is round",
                Kind::real(0.1, 1.0),
                1.0,
            )
                .search([(0.4, 1.0)])
                .unit(Unit::Ratio);
        outline: [f64; HEIGHTS], when Facts::has_branches =>
            heights(
                "factors on the lengths that `shape` gives, at five places of the trunk from the bare base to the tip, \
                 with a spline between; for `cylindrical` they are the outline itself",
                Kind::real(0.0, 4.0),
                1.0,
            )
                .search([(0.2, 2.0)])
                .unit(Unit::Ratio);
    }
}
