//! The numbers of a species, each declared once.

use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::param::table::{always, list, scalar};
use pleach_tree::param::{Effect, Handle, Kind, Param, Scale, Unit};

type Eight = [f64; 8];

/// The volume above the trunk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CrownShape {
    /// The part of a sphere within an angle from the axis.
    SpherePortion,
    Cone,
    Ellipsoid,
    /// A curve turned about the axis: drawn, or by radii at eight heights.
    Revolution,
}

impl CrownShape {
    const NAMES: [&str; 4] = ["sphere_portion", "cone", "ellipsoid", "revolution"];

    const fn from_number(number: u32) -> Self {
        match number {
            0 => Self::SpherePortion,
            1 => Self::Cone,
            2 => Self::Ellipsoid,
            _ => Self::Revolution,
        }
    }
}

const PAPER: &str = "Xu and Mould 2012";

fn real(range: (f64, f64), search: (f64, f64), default: f64) -> Param {
    scalar(Kind::real(range.0, range.1), default).search([search])
}

fn size(range: (f64, f64), search: (f64, f64), default: f64) -> Param {
    let scale = if search.0 > 0.0 { Scale::Log } else { Scale::Linear };
    real(range, search, default).unit(Unit::Meters).scale([scale]).effect([Effect::Size])
}

fn count(range: (i64, i64), search: (f64, f64), default: f64) -> Param {
    scalar(Kind::integer(range.0, range.1), default)
        .search([search])
        .unit(Unit::Count)
        .scale([Scale::Count])
        .effect([Effect::Layout])
}

fn degrees(range: (f64, f64), search: (f64, f64), default: f64) -> Param {
    real(range, search, default).unit(Unit::Degrees)
}

fn choice<const N: usize>(names: [&'static str; N]) -> Param {
    scalar(Kind::choice(0, names), 0.0).effect([Effect::Layout])
}

fn by_level(kind: Kind, search: (f64, f64), default: Eight) -> Param {
    list("level", kind, default).search([search]).group("levels").source(PAPER)
}

pleach_tree::parameters! {
    /// The values of one species by their names.
    #[derive(Clone, Debug)]
    pub(crate) struct Numbers, enum Id, when Facts {
        trunk_height: f64, when Facts::has_plain_volume =>
            size((0.0, 60.0), (0.2, 15.0), 2.5).breakpoints([0.0]).group("volume").source(PAPER)
                .handle(0, Handle::BareTrunk).doc("height of the cylinder that the trunk grows in; 0: none, the tree begins in the crown's volume");
        trunk_width: f64, when Facts::has_trunk =>
            size((0.01, 5.0), (0.05, 0.6), 0.25).group("volume").source(PAPER)
                .doc("radius of the trunk's cylinder: how far the trunk may wander");
        trunk_lean: f64, when Facts::has_trunk =>
            degrees((0.0, 80.0), (0.0, 45.0), 0.0).neutral(0.0).group("volume").source(PAPER)
                .handle(0, Handle::Lean).doc("angle between the cylinder's axis and the vertical");
        trunk_lean_azimuth: f64, when |f| f.has_trunk() && f.n.trunk_lean > 0.0 =>
            degrees((-180.0, 180.0), (-180.0, 180.0), 0.0).group("volume")
                .doc("where the trunk leans to, from +x towards +y");
        crown_shape: CrownShape [CrownShape::from_number], when Facts::has_plain_volume =>
            choice(CrownShape::NAMES).group("volume").source(PAPER)
                .handle(0, Handle::CrownShape).doc("the volume above the trunk");
        crown_radius: f64, when always =>
            size((0.05, 60.0), (0.5, 12.0), 4.0).group("volume").source(PAPER)
                .handle(0, Handle::CrownWidth).doc("radius of the sphere, of the cone's base, of the ellipsoid across; the unit of drawn curves and volumes");
        crown_height: f64, when |f| f.has_plain_volume() && f.n.crown_shape != CrownShape::SpherePortion =>
            size((0.05, 100.0), (0.5, 20.0), 5.0).group("volume").source(PAPER)
                .handle(0, Handle::Height).doc("height of the cone, the ellipsoid or the drawn curve");
        crown_angle: f64, when |f| f.has_crown(CrownShape::SpherePortion) =>
            degrees((5.0, 180.0), (20.0, 180.0), 90.0).group("volume").source(PAPER)
                .doc("half-angle of the portion of a sphere: 90 is the upper half, 180 all of it");
        crown_profile: Eight, when |f| f.has_crown(CrownShape::Revolution) && !f.given.outline =>
            list("height", Kind::real(0.0, 2.0), [0.2, 0.6, 0.9, 1.0, 0.95, 0.75, 0.45, 0.1])
                .search([(0.0, 1.0)]).group("volume").source(PAPER)
                .doc("radius over crown_radius at eight heights, from the crown's foot to its top");
        outline_scale: Eight, when |f| f.has_crown(CrownShape::Revolution) && f.given.outline =>
            list("height", Kind::real(0.1, 3.0), [1.0; 8])
                .search([(0.6, 1.3)]).neutral(1.0).group("volume")
                .doc("factors on the radii of a drawn outline at eight heights, from the crown's foot to its top");
        shell: f64, when always =>
            real((0.02, 1.0), (0.05, 1.0), 1.0).neutral(1.0).group("volume").source(PAPER)
                .doc("endpoints lie at most this far below the crown's surface, over its radius; 1: anywhere");
        clusters: f64, when Facts::has_plain_volume =>
            count((0, 20), (0.0, 10.0), 0.0).neutral(0.0).group("volume").source(PAPER)
                .doc("spheres, each with a cone to the trunk, that the crown's volume is replaced with; 0: it stays");
        cluster_size: f64, when |f| f.has_plain_volume() && f.n.clusters > 0.0 =>
            real((0.2, 1.5), (0.4, 1.0), 0.6).group("volume")
                .doc("radius of these spheres over the mean distance between them");
        nodes: f64, when always =>
            count((10, 1_000_000), (300.0, 1500.0), 800.0).group("graph").source(PAPER)
                .handle(0, Handle::Density).doc("nodes of the first graph");
        subgraph_nodes: f64, when |f| f.has_levels(2) || f.has_roots() =>
            count((5, 20_000), (20.0, 110.0), 50.0).group("graph").source(PAPER)
                .doc("nodes of each further graph");
        spacing: f64, when always =>
            real((0.0, 0.85), (0.5, 0.75), 0.7).group("graph").source(PAPER)
                .doc("least distance between nodes over their mean spacing");
        levels: f64, when always =>
            count((1, 8), (2.0, 5.0), 3.0).group("levels").source(PAPER)
                .doc("levels of graphs; the first counts");
        branching: Eight, when Facts::is_level =>
            by_level(Kind::integer(1, 400), (1.0, 30.0), [12.0, 4.0, 4.0, 6.0, 4.0, 4.0, 4.0, 4.0])
                .unit(Unit::Count).scale([Scale::Count]).effect([Effect::Layout])
                .doc("endpoints in each graph of the level");
        angle: Eight, when |f| f.is_inner_level() && f.n.subgraph_shape[f.index] == 0.0 =>
            by_level(Kind::real(5.0, 180.0), (20.0, 120.0), [90.0, 54.0, 54.0, 54.0, 54.0, 54.0, 54.0, 54.0])
                .unit(Unit::Degrees).doc("half-angle of the graphs of the level; the first level's is crown_angle");
        turn: Eight, when Facts::is_inner_level =>
            by_level(Kind::real(-90.0, 90.0), (-30.0, 30.0), [0.0; 8]).neutral(0.0)
                .unit(Unit::Degrees).doc("by how much a graph points higher (or, negative, lower) than the branch that it continues");
        orientation: Eight, when Facts::is_inner_level =>
            by_level(Kind::choice(0, ["outward", "down", "up", "random"]), (0.0, 3.0), [0.0; 8])
                .effect([Effect::Layout]).doc("where a graph points before it is turned");
        subgraph_shape: Eight, when Facts::is_inner_level =>
            by_level(Kind::choice(0, ["sphere_portion", "cone", "ellipsoid"]), (0.0, 2.0), [0.0; 8])
                .effect([Effect::Layout]).doc("shape of the graphs of the level");
        last_from_all: f64, when |f| f.has_levels(3) =>
            choice(["no", "yes"]).group("levels").source(PAPER)
                .doc("whether the last level grows around the endpoints of all levels before it");
        reach: f64, when |f| f.has_levels(2) =>
            real((0.02, 2.0), (0.1, 0.8), 0.35).scale([Scale::Log]).group("levels").source(PAPER)
                .doc("radius of the graphs of the second level over crown_radius");
        shrink: f64, when |f| f.has_levels(3) =>
            real((0.2, 1.3), (0.4, 1.0), 0.7).group("levels").source(PAPER)
                .doc("radius of the graphs of a level over that of the level before");
        lifespan: f64, when |f| f.has_levels(2) =>
            count((0, 12), (1.0, 8.0), 7.0).group("levels").source(PAPER)
                .doc("generations that the first endpoints live to see");
        lifespan_end: f64, when |f| f.has_levels(3) =>
            real((0.0, 0.95), (0.0, 0.6), 0.0).neutral(0.0).effect([Effect::Layout]).group("levels").source(PAPER)
                .doc("chance that a branch ends at each level after the second");
        lifespan_drop: f64, when |f| f.has_levels(3) =>
            choice(["one", "random"]).group("levels").source(PAPER)
                .doc("whether a lifespan shrinks by one or to any smaller number");
        weight_randomness: f64, when always =>
            real((0.0, 1.0), (0.3, 1.0), 0.75).group("graph")
                .doc("how much of an edge's weight is chance: how crooked the paths are");
        axis_cost: f64, when always =>
            real((0.05, 1.0), (0.15, 1.0), 1.0).neutral(1.0).group("graph")
                .doc("weight of edges along the volume's axis over that of others; 0.3 gives the tree a leader");
        graph: f64, when always =>
            choice(["yao", "threshold"]).group("graph").source(PAPER)
                .doc("how nodes are linked: to the nearest in each sector, or to all within reach");
        sectors: f64, when |f| f.n.graph == 0.0 =>
            choice(["octants", "cube_faces"]).group("graph")
                .doc("the sectors around a node");
        link: f64, when always =>
            real((1.2, 6.0), (1.5, 3.0), 2.1).group("graph")
                .doc("longest edge over the mean spacing of nodes");
        light_azimuth: f64, when Facts::has_light =>
            degrees((-180.0, 180.0), (-180.0, 180.0), 0.0).group("light").source(PAPER)
                .doc("where the light comes from, from +x towards +y");
        light_elevation: f64, when Facts::has_light =>
            degrees((-90.0, 90.0), (0.0, 90.0), 60.0).group("light").source(PAPER)
                .doc("how high the light stands");
        light_branching: f64, when |f| f.has_levels(2) =>
            real((0.0, 1.0), (0.0, 1.0), 0.0).neutral(0.0).effect([Effect::Layout]).group("light").source(PAPER)
                .doc("how much more and less than `branching` light goes to the branches of a level, over it");
        light_lifespan: f64, when |f| f.has_levels(2) =>
            count((0, 6), (0.0, 3.0), 0.0).neutral(0.0).group("light").source(PAPER)
                .doc("generations that light takes from the branches turned away from it, at most");
        taper: Eight, when Facts::is_level =>
            by_level(Kind::real(0.05, 1.5), (0.2, 0.8), [0.6, 0.5, 0.4, 0.3, 0.3, 0.3, 0.3, 0.3])
                .doc("power of the length behind that a stem's radius follows, for paths from endpoints of the level");
        thickness: f64, when always =>
            size((0.0005, 0.5), (0.005, 0.08), 0.02).group("stems")
                .handle(0, Handle::Trunk).doc("radius at taper_length from an endpoint");
        taper_length: f64, when always =>
            size((0.01, 10.0), (0.1, 2.0), 1.0).group("stems")
                .doc("the length at which all tapers agree");
        smoothing: f64, when always =>
            real((0.0, 1.0), (0.0, 1.0), 1.0).group("stems")
                .doc("0: straight edges from node to node; 1: smooth curves");
        root_depth: f64, when always =>
            size((0.0, 20.0), (0.0, 4.0), 0.0).breakpoints([0.0]).neutral(0.0).group("roots").source(PAPER)
                .doc("depth of the volume below ground that roots grow in; 0: none");
        root_spread: f64, when Facts::has_roots =>
            real((0.1, 8.0), (0.5, 4.0), 1.0).scale([Scale::Log]).group("roots")
                .doc("radius of that volume over its depth");
        root_laterals: f64, when Facts::has_roots =>
            count((0, 60), (0.0, 20.0), 8.0).group("roots").source(PAPER)
                .doc("endpoints around the taproot");
        root_branching: f64, when |f| f.has_roots() && f.n.root_laterals > 0.0 =>
            count((0, 30), (0.0, 8.0), 4.0).group("roots").source(PAPER)
                .doc("endpoints of the graph at the end of each lateral root");
        leaf_number: f64, when always =>
            count((0, 60), (0.0, 20.0), 0.0).neutral(0.0).group("leaves")
                .handle(0, Handle::Leaves).doc("leaves on each twig that ends");
        leaf_shape: f64, when Facts::has_leaves =>
            scalar(Kind::choice(1, LeafShape::ALL.map(LeafShape::name)), 8.0).effect([Effect::Layout]).group("leaves")
                .doc("outline of the leaves");
        leaf_length: f64, when Facts::has_leaves =>
            size((0.005, 3.0), (0.02, 0.4), 0.12).group("leaves")
                .handle(0, Handle::LeafSize).doc("length of a leaf");
        leaf_width: f64, when Facts::has_leaves =>
            real((0.05, 3.0), (0.3, 1.5), 1.0).group("leaves")
                .doc("width of a leaf over that of its outline");
        leaf_zone: f64, when Facts::has_leaves =>
            real((0.0, 1.0), (0.2, 1.0), 0.8).group("leaves")
                .doc("part of the twig, from its tip, that carries leaves");
        leaf_angle: f64, when Facts::has_leaves =>
            degrees((0.0, 180.0), (20.0, 90.0), 55.0).group("leaves")
                .doc("angle between a leaf and its twig");
    }
}

/// What a species has beside its numbers, as far as it decides which of them matter.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Given {
    /// The first volume is given by its parts.
    pub(crate) volumes: bool,
    /// The crown's outline is drawn.
    pub(crate) outline: bool,
}

/// What decides whether a number matters: the other numbers, what else is given, and its index within
/// its parameter.
#[derive(Debug)]
pub(crate) struct Facts {
    pub(crate) n: Numbers,
    pub(crate) given: Given,
    pub(crate) index: usize,
}

impl Facts {
    /// Whether the first volume is a trunk and a crown.
    fn has_plain_volume(&self) -> bool {
        !self.given.volumes
    }

    fn has_trunk(&self) -> bool {
        self.has_plain_volume() && self.n.trunk_height > 0.0
    }

    fn has_crown(&self, shape: CrownShape) -> bool {
        self.has_plain_volume() && self.n.crown_shape == shape
    }

    /// Whether there are at least `count` levels of graphs.
    fn has_levels(&self, count: usize) -> bool {
        self.n.levels as usize >= count
    }

    /// Whether there are graphs of the level that the number is for. Index 0 is the first level.
    fn is_level(&self) -> bool {
        self.has_levels(self.index + 1)
    }

    fn is_inner_level(&self) -> bool {
        self.index > 0 && self.is_level()
    }

    fn has_light(&self) -> bool {
        self.has_levels(2) && (self.n.light_branching > 0.0 || self.n.light_lifespan > 0.0)
    }

    fn has_roots(&self) -> bool {
        self.n.root_depth > 0.0
    }

    fn has_leaves(&self) -> bool {
        self.n.leaf_number > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pleach_tree::param::table::Parameters;

    fn with(set: &[(Id, f64)]) -> Vec<f64> {
        let mut values = Numbers::space().defaults();
        for &(id, value) in set {
            for slot in Numbers::space().slots_of(id as usize) {
                values[slot.index()] = value;
            }
        }
        values
    }

    #[test]
    fn numbers_are_read_into_their_fields() {
        let mut values = with(&[(Id::trunk_height, 1.0), (Id::crown_shape, 3.0), (Id::leaf_angle, 21.0)]);
        values[Id::crown_profile.slot(7).index()] = 0.125;
        values[Id::taper.slot(0).index()] = 0.25;
        let n = Numbers::read(&values);
        assert_eq!((n.trunk_height, n.crown_shape, n.leaf_angle), (1.0, CrownShape::Revolution, 21.0));
        assert_eq!((n.crown_profile[0], n.crown_profile[7]), (0.2, 0.125));
        assert_eq!((n.taper[0], n.taper[1], n.levels), (0.25, 0.5, 3.0));
    }

    /// A tree that has everything.
    const WHOLE: [(Id, f64); 6] = [
        (Id::trunk_lean, 10.0),
        (Id::clusters, 3.0),
        (Id::levels, 8.0),
        (Id::light_branching, 0.5),
        (Id::root_depth, 1.0),
        (Id::leaf_number, 4.0),
    ];

    /// The parameters of which no number matters, in order.
    fn inactive(given: Given, set: &[(Id, f64)]) -> Vec<Id> {
        let values = with(&[&WHOLE[..], set].concat());
        let is_active = |&id: &Id| {
            let indices = 0..Numbers::ROWS[id as usize].len;
            let facts = |index| Facts { n: Numbers::read(&values), given, index };
            indices.into_iter().any(|index| Numbers::is_active(id.slot(index), &facts(index)))
        };
        Id::ALL.iter().copied().filter(|id| !is_active(id)).collect()
    }

    #[test]
    fn what_is_not_there_has_no_parameters() {
        use Id::{
            angle, cluster_size, clusters, crown_angle, crown_height, crown_profile, crown_shape, graph,
            last_from_all, leaf_angle, leaf_length, leaf_number, leaf_shape, leaf_width, leaf_zone, levels,
            lifespan, lifespan_drop, lifespan_end, light_azimuth, light_branching, light_elevation,
            light_lifespan, orientation, outline_scale, reach, root_branching, root_depth, root_laterals,
            root_spread, sectors, shrink, subgraph_nodes, subgraph_shape, trunk_height, trunk_lean,
            trunk_lean_azimuth, trunk_width, turn,
        };
        let shapes = [crown_height, crown_profile, outline_scale];
        // Beside those that no portion of a sphere has.
        let without = |set: &[(Id, f64)]| {
            let mut ids = inactive(Given::default(), set);
            ids.retain(|id| !shapes.contains(id));
            ids
        };
        assert_eq!(inactive(Given::default(), &[]), shapes);
        let shaped = |shape| inactive(Given::default(), &[(crown_shape, shape)]);
        assert_eq!(shaped(1.0), [crown_angle, crown_profile, outline_scale], "a cone");
        assert_eq!(shaped(2.0), [crown_angle, crown_profile, outline_scale], "an ellipsoid");
        assert_eq!(shaped(3.0), [crown_angle, outline_scale], "a revolution");
        let drawn = Given { outline: true, ..Given::default() };
        assert_eq!(inactive(drawn, &[(crown_shape, 3.0)]), [crown_angle, crown_profile], "a drawn outline");
        let volumes = Given { volumes: true, ..Given::default() };
        let of_volume = [
            trunk_height,
            trunk_width,
            trunk_lean,
            trunk_lean_azimuth,
            crown_shape,
            crown_height,
            crown_angle,
            crown_profile,
            outline_scale,
            clusters,
            cluster_size,
        ];
        assert_eq!(inactive(volumes, &[]), of_volume, "volumes in place of trunk and crown");

        assert_eq!(without(&[(trunk_height, 0.0)]), [trunk_width, trunk_lean, trunk_lean_azimuth]);
        assert_eq!(without(&[(trunk_lean, 0.0)]), [trunk_lean_azimuth]);
        assert_eq!(without(&[(clusters, 0.0)]), [cluster_size]);
        assert_eq!(without(&[(subgraph_shape, 1.0)]), [angle]);
        assert_eq!(without(&[(graph, 1.0)]), [sectors]);
        assert_eq!(without(&[(light_branching, 0.0)]), [light_azimuth, light_elevation]);
        assert_eq!(without(&[(light_branching, 0.0), (light_lifespan, 1.0)]), []);
        assert_eq!(without(&[(root_laterals, 0.0)]), [root_branching]);
        assert_eq!(without(&[(root_depth, 0.0)]), [root_spread, root_laterals, root_branching]);
        let of_leaves = [leaf_shape, leaf_length, leaf_width, leaf_zone, leaf_angle];
        assert_eq!(without(&[(leaf_number, 0.0)]), of_leaves);
        assert_eq!(without(&[(levels, 2.0)]), [last_from_all, shrink, lifespan_end, lifespan_drop]);
        let of_subgraphs = [
            angle,
            turn,
            orientation,
            subgraph_shape,
            last_from_all,
            reach,
            shrink,
            lifespan,
            lifespan_end,
            lifespan_drop,
            light_azimuth,
            light_elevation,
            light_branching,
            light_lifespan,
        ];
        assert_eq!(without(&[(levels, 1.0)]), of_subgraphs);
        let first_alone = without(&[(levels, 1.0), (root_depth, 0.0)]);
        assert!(first_alone.contains(&subgraph_nodes), "{first_alone:?}");
    }

    #[test]
    fn levels_that_are_not_there_have_no_numbers() {
        let values = with(&[(Id::levels, 3.0)]);
        let active = |id: Id| -> Vec<usize> {
            let facts = |index| Facts { n: Numbers::read(&values), given: Given::default(), index };
            (0..8).filter(|&index| Numbers::is_active(id.slot(index), &facts(index))).collect()
        };
        for id in [Id::branching, Id::taper] {
            assert_eq!(active(id), [0, 1, 2], "{id:?}");
        }
        for id in [Id::angle, Id::turn, Id::orientation, Id::subgraph_shape] {
            assert_eq!(active(id), [1, 2], "{id:?}: the first graph has the crown's");
        }
    }
}
