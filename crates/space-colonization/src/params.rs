//! The numbers of a tree, each declared once.

use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::param::table::{always, list, scalar};
use pleach_tree::param::{Effect, Handle, Scale};
use pleach_tree::{Kind, Param, Unit};

/// Heights at which the crown's profile is given, evenly from its base to its top.
pub(crate) const STATIONS: usize = 6;
/// Largest number of attraction points.
pub(crate) const MAX_POINTS: i64 = 6000;
/// Largest number of leaflets of a leaf.
const MAX_LEAFLETS: i64 = 25;
/// The apical control with which every bud that has space gets the same.
pub(crate) const EVEN: f64 = 0.5;
/// Largest number of clumps.
pub(crate) const MAX_CLUMPS: i64 = 200;

const COLONIES: &str = "Runions, Lane and Prusinkiewicz 2007, §3";
const FATES: &str = "ours, after Pałubicki and others 2009, §4";
const CONTROL: &str = "Borchert and Honda 1984, after Pałubicki and others 2009, §4.2";
const TWIGS: &str = "Weber and Penn 1995, §4.3";
const LEAVES: &str = "Weber and Penn 1995, §4.9";
const OURS: &str = "ours";

fn real(allowed: (f64, f64), search: (f64, f64), default: f64) -> Param {
    scalar(Kind::real(allowed.0, allowed.1), default).search([search]).source(OURS)
}

fn degrees(allowed: (f64, f64), search: (f64, f64), default: f64) -> Param {
    real(allowed, search, default).unit(Unit::Degrees)
}

fn metres(allowed: (f64, f64), search: (f64, f64), default: f64) -> Param {
    real(allowed, search, default).unit(Unit::Meters).scale([Scale::Log]).effect([Effect::Size])
}

fn count(allowed: (i64, i64), search: (f64, f64), default: f64) -> Param {
    scalar(Kind::integer(allowed.0, allowed.1), default)
        .search([search])
        .unit(Unit::Count)
        .scale([Scale::Count])
        .effect([Effect::Layout])
        .source(OURS)
}

fn leaf_shape_from_number(number: i64) -> LeafShape {
    LeafShape::from_number(number).unwrap_or_default()
}

pleach_tree::parameters! {
    /// The numbers of a species; angles in radians, lengths but those of leaves over the tree's height.
    #[derive(Clone, Copy, Debug)]
    pub(crate) struct Numbers, enum Id, when Numbers {
        height: f64, when always =>
            metres((0.05, 150.0), (3.0, 40.0), 15.0).group("crown")
                .handle(0, Handle::Height).doc("height of the crown's top above the ground");
        crown_width: f64, when always =>
            real((0.02, 5.0), (0.2, 1.8), 0.8).scale([Scale::Log]).group("crown")
                .handle(0, Handle::CrownWidth).doc("greatest width of the crown over the height");
        bare_height: f64, when always =>
            real((0.0, 0.95), (0.02, 0.65), 0.25).group("crown")
                .handle(0, Handle::BareTrunk).doc("height of the crown's base over the height");
        profile: [f64; STATIONS], when always =>
            list("station", Kind::real(0.0, 1.0), [0.45, 0.85, 1.0, 0.95, 0.75, 0.35]).search([(0.05, 1.0)])
                .group("crown").source("ours, after Runions and others 2007, §3 (envelopes)")
                .doc("half-width of the crown over its greatest, at six heights from its base to its top");
        crown_depth: f64, when always =>
            real((0.1, 1.0), (0.4, 1.0), 1.0).neutral(1.0).group("crown")
                .doc("depth of the crown over its width: 1 is round");
        crown_azimuth: f64 [f64::to_radians], when |n| n.crown_depth < 1.0 =>
            degrees((-90.0, 90.0), (-90.0, 90.0), 0.0).group("crown")
                .doc("where the widest section of the crown lies, from +x towards +y");
        side: f64, when always =>
            real((0.0, 1.0), (0.0, 0.6), 0.0).neutral(0.0).group("crown")
                .doc("one-sidedness: how far the crown stands off the trunk, in half-widths");
        side_azimuth: f64 [f64::to_radians], when |n| n.side > 0.0 =>
            degrees((-180.0, 180.0), (-180.0, 180.0), 0.0).group("crown")
                .doc("to which side, from +x towards +y");
        irregularity: f64, when always =>
            real((0.0, 0.8), (0.0, 0.4), 0.15).neutral(0.0).group("crown")
                .source("ours, after Li and others 2021 (radial bounding volumes)")
                .doc("by which part the crown's half-width deviates, by height and azimuth");

        points: u32, when always =>
            count((20, MAX_POINTS), (150.0, 2500.0), 1200.0).group("points").source(COLONIES)
                .handle(0, Handle::Density).doc("attraction points in the crown: the scaffold gets finer with them");
        shade: f64, when always =>
            real((0.0, 1.0), (0.0, 0.9), 0.3).neutral(0.0).effect([Effect::Layout]).group("points")
                .doc("part of the points that shade leaves out, deep below the crown's surface");
        clumping: f64, when always =>
            real((0.0, 1.0), (0.0, 1.0), 0.0).neutral(0.0).group("points")
                .doc("0: points are spread evenly; 1: all of them in clumps");
        clumps: u32, when Numbers::is_clumped =>
            count((1, MAX_CLUMPS), (4.0, 40.0), 16.0).group("points")
                .doc("number of clumps");
        clump_size: f64, when Numbers::is_clumped =>
            real((0.01, 1.0), (0.1, 0.6), 0.3).group("points")
                .doc("radius of a clump over half the crown's width");
        clump_flatness: f64, when Numbers::is_clumped =>
            real((0.0, 1.0), (0.0, 1.0), 0.3).group("points")
                .doc("0: clumps are as high as they are wide; 1: they are level plates");

        trunks: u32, when always =>
            count((1, 6), (1.0, 5.0), 1.0).group("trunk")
                .doc("trunks from the ground");
        trunk_spread: f64 [f64::to_radians], when |n| n.trunks > 1 =>
            degrees((0.0, 60.0), (2.0, 35.0), 12.0).group("trunk")
                .doc("by how much each of several trunks leans away from the others");
        lean: f64 [f64::to_radians], when always =>
            degrees((0.0, 60.0), (0.0, 30.0), 0.0).neutral(0.0).group("trunk")
                .handle(0, Handle::Lean).doc("lean of the trunk, with which the crown is displaced");
        lean_azimuth: f64 [f64::to_radians], when Numbers::has_lean =>
            degrees((-180.0, 180.0), (-180.0, 180.0), 0.0).group("trunk")
                .doc("where it leans to, from +x towards +y");
        bow: f64 [f64::to_radians], when always =>
            degrees((-90.0, 90.0), (-40.0, 40.0), 0.0).neutral(0.0).group("trunk")
                .doc("by how much more the trunk leans at its top than at its foot");
        crook: f64 [f64::to_radians], when always =>
            degrees((0.0, 45.0), (0.0, 25.0), 4.0).neutral(0.0).group("trunk")
                .doc("greatest angle by which trunks and limbs wander from their course");

        limbs: u32, when always =>
            count((1, 9), (1.0, 7.0), 3.0).group("limbs")
                .doc("main stems above the first fork; 1 is a single leader");
        first_fork: f64, when Numbers::has_limbs =>
            real((0.01, 0.9), (0.05, 0.5), 0.25).group("limbs")
                .doc("height of the first fork over the height");
        fork_spread: f64, when Numbers::has_limbs =>
            real((0.0, 0.6), (0.0, 0.3), 0.08).group("limbs")
                .doc("height from the first limb to the last over the height");
        fork_angle: f64 [f64::to_radians], when Numbers::has_limbs =>
            degrees((0.0, 100.0), (10.0, 75.0), 40.0).group("limbs")
                .handle(0, Handle::Spread).doc("angle between a limb and the trunk");
        fork_rise: f64, when Numbers::has_limbs =>
            real((-1.0, 1.0), (-0.5, 0.8), 0.2).neutral(0.0).group("limbs")
                .doc("part of that angle that a limb turns upwards by its end; negative: it arches over");
        leader: f64, when always =>
            real((0.0, 1.0), (0.1, 1.0), 0.5).group("limbs")
                .doc("part of the crown that leader or limbs reach through: 1 for firs, less where crowns dissolve");

        influence: f64, when always =>
            real((1.0, 10.0), (2.0, 6.0), 3.2).group("growth").source(COLONIES)
                .doc("distance at which a point attracts a bud, in mean spacings of points");
        kill: f64, when always =>
            real((0.3, 4.0), (0.7, 2.0), 1.1).group("growth").source(COLONIES)
                .doc("distance at which a point is reached and taken away, in mean spacings");
        step: f64, when always =>
            real((0.15, 1.5), (0.3, 0.8), 0.45).effect([Effect::Layout]).group("growth").source(COLONIES)
                .doc("length of a shoot in one step, in mean spacings");
        inertia: f64, when always =>
            real((0.0, 4.0), (0.0, 1.5), 0.4).neutral(0.0).group("growth").source(FATES)
                .doc("how much shoots go straight on instead of to the points");
        tropism: f64, when always =>
            real((-1.0, 1.0), (-0.4, 0.6), 0.0).neutral(0.0).group("growth").source(FATES)
                .handle(0, Handle::Rise).doc("pull on shoots, upwards or (negative) downwards");
        outward: f64, when always =>
            real((0.0, 2.0), (0.0, 1.0), 0.5).neutral(0.0).group("growth").source(FATES)
                .doc("pull on shoots out of the crown's middle");
        dominance: f64, when always =>
            real((0.0, 1.0), (0.0, 0.9), 0.4).effect([Effect::Layout]).group("growth").source(FATES)
                .doc("how much slower than its parent a side shoot grows");
        apical_control: f64, when always =>
            real((0.0, 1.0), (0.3, 0.9), EVEN).neutral(EVEN).effect([Effect::Layout]).group("growth").opt_in()
                .source(CONTROL)
                .doc("0.5: buds with space get the same resource; more: leaders get more than sides; less: sides do");
        bud_spacing: u32, when always =>
            count((0, 12), (0.0, 6.0), 2.0).neutral(0.0).group("growth").source(FATES)
                .doc("steps along a stem from one side shoot to the next, at least");
        straightness: f64, when always =>
            real((0.0, 1.0), (0.3, 0.9), 0.5).neutral(0.0).group("growth")
                .source("ours, after Runions and others 2007, §3 (relocation of nodes)")
                .doc("0: branches as they grew; 1: straight from foot to tip");

        thickness: f64, when always =>
            real((0.001, 0.25), (0.006, 0.06), 0.02).scale([Scale::Log]).group("wood")
                .handle(0, Handle::Trunk).doc("radius of the thickest trunk at its foot over the height, without flare");
        pipe: f64, when always =>
            real((1.0, 5.0), (1.4, 3.0), 1.9).group("wood").source("Runions and others 2007, §3; Murray 1927")
                .doc("exponent of the pipe model: small makes twigs fine, large makes them thick");
        flare: f64, when always =>
            real((0.0, 4.0), (0.0, 1.2), 0.4).neutral(0.0).group("wood").source("Weber and Penn 1995, §4.4")
                .doc("by how much of its radius a trunk widens at the ground");

        twigs: f64, when always =>
            real((0.0, 10.0), (0.2, 4.0), 1.5).effect([Effect::Layout]).neutral(0.0).group("twigs").source(TWIGS)
                .doc("twigs for each step of the outer branches, in the mean");
        twig_zone: f64, when Numbers::has_twigs =>
            real((0.0, 1.0), (0.02, 0.4), 0.15).effect([Effect::Layout]).group("twigs")
                .doc("how far from the ends of branches twigs stand, over the height");
        twig_length: f64, when Numbers::has_twigs =>
            real((0.002, 0.8), (0.02, 0.2), 0.06).scale([Scale::Log]).group("twigs").source(TWIGS)
                .doc("length of a twig over the height");
        twig_length_v: f64, when Numbers::has_twigs =>
            real((0.0, 0.9), (0.0, 0.5), 0.25).neutral(0.0).group("twigs").source(TWIGS)
                .doc("greatest deviation of that length, as a part of it");
        twig_angle: f64 [f64::to_radians], when Numbers::has_twigs =>
            degrees((0.0, 150.0), (20.0, 90.0), 50.0).group("twigs").source(TWIGS)
                .doc("angle between a twig and its branch");
        twig_angle_v: f64 [f64::to_radians], when Numbers::has_twigs =>
            degrees((0.0, 90.0), (0.0, 30.0), 15.0).neutral(0.0).group("twigs").source(TWIGS)
                .doc("greatest deviation of that angle");
        twig_bend: f64 [f64::to_radians], when Numbers::has_twigs =>
            degrees((0.0, 120.0), (0.0, 60.0), 20.0).neutral(0.0).group("twigs").source(TWIGS)
                .doc("greatest angle by which a twig bends from its foot to its tip");
        twig_lift: f64 [f64::to_radians], when Numbers::has_twigs =>
            degrees((-180.0, 180.0), (-120.0, 90.0), 15.0).neutral(0.0).group("twigs")
                .source("Weber and Penn 1995, §4.8")
                .doc("angle by which a level twig turns upwards, or (negative) hangs, by its tip");
        side_twigs: u32, when Numbers::has_twigs =>
            count((0, 20), (0.0, 8.0), 2.0).neutral(0.0).group("twigs").source(TWIGS)
                .doc("smaller twigs on each twig, alternately on two sides");

        leaf_number: f64, when Numbers::has_twigs =>
            real((0.0, 80.0), (0.0, 16.0), 7.0).unit(Unit::Count).effect([Effect::Layout]).neutral(0.0)
                .group("leaves").source(LEAVES)
                .handle(0, Handle::Leaves).doc("leaves on each twig; side twigs have fewer, by their length");
        leaf_shape: LeafShape [leaf_shape_from_number], when Numbers::has_leaves =>
            scalar(Kind::choice(1, LeafShape::ALL.map(LeafShape::name)), 8.0).effect([Effect::Layout])
                .group("leaves").source(LEAVES)
                .doc("outline of the leaves");
        leaf_length: f64, when Numbers::has_leaves =>
            metres((0.001, 5.0), (0.03, 0.6), 0.22).group("leaves").source(LEAVES)
                .handle(0, Handle::LeafSize).doc("length of a leaf");
        leaf_width: f64, when Numbers::has_leaves =>
            real((0.02, 4.0), (0.2, 1.6), 1.0).scale([Scale::Log]).group("leaves").source(LEAVES)
                .doc("width of a leaf over that of its outline");
        leaflets: u32, when Numbers::has_leaves =>
            count((1, MAX_LEAFLETS), (1.0, 11.0), 1.0).neutral(1.0).group("leaves").opt_in()
                .doc("leaflets of a leaf, in pairs along its middle; 1: leaves are simple");
        leaf_angle: f64 [f64::to_radians], when Numbers::has_leaves =>
            degrees((0.0, 180.0), (20.0, 90.0), 50.0).group("leaves").source(LEAVES)
                .doc("angle between a leaf and its twig");
        leaf_level: f64, when Numbers::has_leaves =>
            real((0.0, 1.0), (0.0, 1.0), 0.4).neutral(0.0).group("leaves").source(LEAVES)
                .doc("how far leaves are turned to the light: 0 by their twigs, 1 level");
    }
}

impl Numbers {
    fn is_clumped(&self) -> bool {
        self.clumping > 0.0
    }

    fn has_lean(&self) -> bool {
        self.lean > 0.0 || self.bow != 0.0
    }

    pub(crate) fn has_limbs(&self) -> bool {
        self.limbs > 1
    }

    fn has_twigs(&self) -> bool {
        self.twigs > 0.0
    }

    pub(crate) fn has_leaves(&self) -> bool {
        self.has_twigs() && self.leaf_number > 0.0
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
        let n =
            with(&[(Id::lean, 30.0), (Id::profile, 0.125), (Id::leaf_shape, 2.0), (Id::leaf_level, 0.75)]);
        assert_eq!((n.lean, n.profile[0], n.profile[5]), (f64::to_radians(30.0), 0.125, 0.35));
        assert_eq!((n.leaf_shape, n.leaf_level), (LeafShape::Linear, 0.75));
        assert!(Numbers::space().slots().count() < 64, "searches are slow in more numbers");
    }

    #[test]
    fn what_is_not_there_has_no_parameters() {
        let inactive = |set: &[(Id, f64)]| -> Vec<Id> {
            let numbers = with(set);
            Id::ALL.iter().copied().filter(|id| !Numbers::is_active(id.slot(0), &numbers)).collect()
        };
        use Id::{
            clump_flatness, clump_size, clumping, clumps, crown_azimuth, crown_depth, first_fork, fork_angle,
            fork_rise, fork_spread, leaf_angle, leaf_length, leaf_level, leaf_number, leaf_shape, leaf_width,
            leaflets, lean, lean_azimuth, limbs, side, side_azimuth, trunk_spread, trunks,
        };
        let whole = [(crown_depth, 0.5), (side, 0.5), (clumping, 0.5), (trunks, 2.0), (lean, 5.0)];
        let without = |set: &[(Id, f64)]| inactive(&[&whole[..], set].concat());
        assert_eq!(without(&[]), []);
        assert_eq!(without(&[(crown_depth, 1.0), (side, 0.0)]), [crown_azimuth, side_azimuth]);
        assert_eq!(without(&[(clumping, 0.0)]), [clumps, clump_size, clump_flatness]);
        assert_eq!(without(&[(trunks, 1.0), (lean, 0.0)]), [trunk_spread, lean_azimuth]);
        assert_eq!(without(&[(limbs, 1.0)]), [first_fork, fork_spread, fork_angle, fork_rise]);
        let of_leaves = [leaf_shape, leaf_length, leaf_width, leaflets, leaf_angle, leaf_level];
        assert_eq!(without(&[(leaf_number, 0.0)]), of_leaves);
        let bare = without(&[(Id::twigs, 0.0)]);
        assert!(bare.contains(&leaf_number) && bare.contains(&Id::twig_lift) && bare.len() == 15, "{bare:?}");
    }
}
