//! The numbers of a species, each declared once: declaration and field are one line of the table.

use pleach_tree::leaf_shape::LeafShape;
use pleach_tree::param::{Effect, Kind, Param, Scale, Unit};
use pleach_tree::{ParamSpace, Slot};
use std::sync::{Arc, LazyLock};

type Eight = [f64; 8];

/// Declares the parameters and the struct that they are read into, field by field in this order.
macro_rules! table {
    ($($field:ident: $type:tt = $declaration:expr;)*) => {
        /// The values of one species by their names.
        #[derive(Clone, Debug)]
        pub(crate) struct Numbers {
            $(pub(crate) $field: $type,)*
        }

        impl Numbers {
            /// The numbers in `values`, which were checked against [`space`].
            pub(crate) fn read(values: &[f64]) -> Self {
                let mut rest = values.iter().copied();
                let mut next = || rest.next().unwrap_or_default();
                Self { $($field: table!(@read $type, next),)* }
            }
        }

        fn declarations() -> Vec<Param> {
            vec![$({
                let param: Param = $declaration;
                debug_assert_eq!(param.name, stringify!($field));
                param
            },)*]
        }
    };
    (@read f64, $next:ident) => { $next() };
    (@read Eight, $next:ident) => { std::array::from_fn(|_| $next()) };
}

const PAPER: &str = "Xu and Mould 2012";

fn real(name: &'static str, range: (f64, f64), search: (f64, f64), default: f64) -> Param {
    Param::scalar(name, Kind::real(range.0, range.1), default).search([search])
}

fn size(name: &'static str, range: (f64, f64), search: (f64, f64), default: f64) -> Param {
    let scale = if search.0 > 0.0 { Scale::Log } else { Scale::Linear };
    real(name, range, search, default).unit(Unit::Meters).scale([scale]).effect([Effect::Size])
}

fn count(name: &'static str, range: (i64, i64), search: (f64, f64), default: f64) -> Param {
    Param::scalar(name, Kind::integer(range.0, range.1), default)
        .search([search])
        .unit(Unit::Count)
        .scale([Scale::Count])
        .effect([Effect::Layout])
}

fn degrees(name: &'static str, range: (f64, f64), search: (f64, f64), default: f64) -> Param {
    real(name, range, search, default).unit(Unit::Degrees)
}

fn choice<const N: usize>(name: &'static str, names: [&'static str; N]) -> Param {
    Param::scalar(name, Kind::choice(0, names), 0.0).effect([Effect::Layout])
}

fn by_level(name: &'static str, kind: Kind, search: (f64, f64), default: Eight) -> Param {
    Param::list(name, "level", kind, default).search([search]).group("levels").source(PAPER)
}

table! {
    trunk_height: f64 = size("trunk_height", (0.0, 60.0), (0.2, 15.0), 2.5).breakpoints([0.0]).group("volume").source(PAPER)
        .doc("height of the cylinder that the trunk grows in; 0: none, the tree begins in the crown's volume");
    trunk_width: f64 = size("trunk_width", (0.01, 5.0), (0.05, 0.6), 0.25).group("volume").source(PAPER)
        .doc("radius of the trunk's cylinder: how far the trunk may wander");
    trunk_lean: f64 = degrees("trunk_lean", (0.0, 80.0), (0.0, 45.0), 0.0).neutral(0.0).group("volume").source(PAPER)
        .doc("angle between the cylinder's axis and the vertical");
    trunk_lean_azimuth: f64 = degrees("trunk_lean_azimuth", (-180.0, 180.0), (-180.0, 180.0), 0.0).group("volume")
        .doc("where the trunk leans to, from +x towards +y");
    crown_shape: f64 = choice("crown_shape", ["sphere_portion", "cone", "ellipsoid", "revolution"]).group("volume").source(PAPER)
        .doc("the volume above the trunk");
    crown_radius: f64 = size("crown_radius", (0.05, 60.0), (0.5, 12.0), 4.0).group("volume").source(PAPER)
        .doc("radius of the sphere, of the cone's base, of the ellipsoid across; the unit of drawn curves and volumes");
    crown_height: f64 = size("crown_height", (0.05, 100.0), (0.5, 20.0), 5.0).group("volume").source(PAPER)
        .doc("height of the cone, the ellipsoid or the drawn curve");
    crown_angle: f64 = degrees("crown_angle", (5.0, 180.0), (20.0, 180.0), 90.0).group("volume").source(PAPER)
        .doc("half-angle of the portion of a sphere: 90 is the upper half, 180 all of it");
    crown_profile: Eight = Param::list("crown_profile", "height", Kind::real(0.0, 2.0), [0.2, 0.6, 0.9, 1.0, 0.95, 0.75, 0.45, 0.1])
        .search([(0.0, 1.0)]).group("volume").source(PAPER)
        .doc("radius over crown_radius at eight heights, from the crown's foot to its top");
    outline_scale: Eight = Param::list("outline_scale", "height", Kind::real(0.1, 3.0), [1.0; 8])
        .search([(0.6, 1.3)]).neutral(1.0).group("volume")
        .doc("factors on the radii of a drawn outline at eight heights, from the crown's foot to its top");
    shell: f64 = real("shell", (0.02, 1.0), (0.05, 1.0), 1.0).neutral(1.0).group("volume").source(PAPER)
        .doc("endpoints lie at most this far below the crown's surface, over its radius; 1: anywhere");
    clusters: f64 = count("clusters", (0, 20), (0.0, 10.0), 0.0).neutral(0.0).group("volume").source(PAPER)
        .doc("spheres, each with a cone to the trunk, that the crown's volume is replaced with; 0: it stays");
    cluster_size: f64 = real("cluster_size", (0.2, 1.5), (0.4, 1.0), 0.6).group("volume")
        .doc("radius of these spheres over the mean distance between them");
    nodes: f64 = count("nodes", (10, 1_000_000), (300.0, 1500.0), 800.0).group("graph").source(PAPER)
        .doc("nodes of the first graph");
    subgraph_nodes: f64 = count("subgraph_nodes", (5, 20_000), (20.0, 110.0), 50.0).group("graph").source(PAPER)
        .doc("nodes of each further graph");
    spacing: f64 = real("spacing", (0.0, 0.85), (0.5, 0.75), 0.7).group("graph").source(PAPER)
        .doc("least distance between nodes over their mean spacing");
    levels: f64 = count("levels", (1, 8), (2.0, 5.0), 3.0).group("levels").source(PAPER)
        .doc("levels of graphs; the first counts");
    branching: Eight = by_level("branching", Kind::integer(1, 400), (1.0, 30.0), [12.0, 4.0, 4.0, 6.0, 4.0, 4.0, 4.0, 4.0])
        .unit(Unit::Count).scale([Scale::Count]).effect([Effect::Layout])
        .doc("endpoints in each graph of the level");
    angle: Eight = by_level("angle", Kind::real(5.0, 180.0), (20.0, 120.0), [90.0, 54.0, 54.0, 54.0, 54.0, 54.0, 54.0, 54.0])
        .unit(Unit::Degrees).doc("half-angle of the graphs of the level; the first level's is crown_angle");
    turn: Eight = by_level("turn", Kind::real(-90.0, 90.0), (-30.0, 30.0), [0.0; 8]).neutral(0.0)
        .unit(Unit::Degrees).doc("by how much a graph points higher (or, negative, lower) than the branch that it continues");
    orientation: Eight = by_level("orientation", Kind::choice(0, ["outward", "down", "up", "random"]), (0.0, 3.0), [0.0; 8])
        .effect([Effect::Layout]).doc("where a graph points before it is turned");
    subgraph_shape: Eight = by_level("subgraph_shape", Kind::choice(0, ["sphere_portion", "cone", "ellipsoid"]), (0.0, 2.0), [0.0; 8])
        .effect([Effect::Layout]).doc("shape of the graphs of the level");
    last_from_all: f64 = choice("last_from_all", ["no", "yes"]).group("levels").source(PAPER)
        .doc("whether the last level grows around the endpoints of all levels before it");
    reach: f64 = real("reach", (0.02, 2.0), (0.1, 0.8), 0.35).scale([Scale::Log]).group("levels").source(PAPER)
        .doc("radius of the graphs of the second level over crown_radius");
    shrink: f64 = real("shrink", (0.2, 1.3), (0.4, 1.0), 0.7).group("levels").source(PAPER)
        .doc("radius of the graphs of a level over that of the level before");
    lifespan: f64 = count("lifespan", (0, 12), (1.0, 8.0), 7.0).group("levels").source(PAPER)
        .doc("generations that the first endpoints live to see");
    lifespan_end: f64 = real("lifespan_end", (0.0, 0.95), (0.0, 0.6), 0.0).neutral(0.0).effect([Effect::Layout]).group("levels").source(PAPER)
        .doc("chance that a branch ends at each level after the second");
    lifespan_drop: f64 = choice("lifespan_drop", ["one", "random"]).group("levels").source(PAPER)
        .doc("whether a lifespan shrinks by one or to any smaller number");
    weight_randomness: f64 = real("weight_randomness", (0.0, 1.0), (0.3, 1.0), 0.75).group("graph")
        .doc("how much of an edge's weight is chance: how crooked the paths are");
    axis_cost: f64 = real("axis_cost", (0.05, 1.0), (0.15, 1.0), 1.0).neutral(1.0).group("graph")
        .doc("weight of edges along the volume's axis over that of others; 0.3 gives the tree a leader");
    graph: f64 = choice("graph", ["yao", "threshold"]).group("graph").source(PAPER)
        .doc("how nodes are linked: to the nearest in each sector, or to all within reach");
    sectors: f64 = choice("sectors", ["octants", "cube_faces"]).group("graph")
        .doc("the sectors around a node");
    link: f64 = real("link", (1.2, 6.0), (1.5, 3.0), 2.1).group("graph")
        .doc("longest edge over the mean spacing of nodes");
    light_azimuth: f64 = degrees("light_azimuth", (-180.0, 180.0), (-180.0, 180.0), 0.0).group("light").source(PAPER)
        .doc("where the light comes from, from +x towards +y");
    light_elevation: f64 = degrees("light_elevation", (-90.0, 90.0), (0.0, 90.0), 60.0).group("light").source(PAPER)
        .doc("how high the light stands");
    light_branching: f64 = real("light_branching", (0.0, 1.0), (0.0, 1.0), 0.0).neutral(0.0).effect([Effect::Layout]).group("light").source(PAPER)
        .doc("how much more and less than `branching` light deals out to the branches of a level, over it");
    light_lifespan: f64 = count("light_lifespan", (0, 6), (0.0, 3.0), 0.0).neutral(0.0).group("light").source(PAPER)
        .doc("generations that light takes from the branches turned away from it, at most");
    taper: Eight = by_level("taper", Kind::real(0.05, 1.5), (0.2, 0.8), [0.6, 0.5, 0.4, 0.3, 0.3, 0.3, 0.3, 0.3])
        .doc("power of the length behind that a stem's radius follows, for paths from endpoints of the level");
    thickness: f64 = size("thickness", (0.0005, 0.5), (0.005, 0.08), 0.02).group("stems")
        .doc("radius at taper_length from an endpoint");
    taper_length: f64 = size("taper_length", (0.01, 10.0), (0.1, 2.0), 1.0).group("stems")
        .doc("the length at which all tapers agree");
    smoothing: f64 = real("smoothing", (0.0, 1.0), (0.0, 1.0), 1.0).group("stems")
        .doc("0: straight edges from node to node; 1: smooth curves");
    root_depth: f64 = size("root_depth", (0.0, 20.0), (0.0, 4.0), 0.0).breakpoints([0.0]).neutral(0.0).group("roots").source(PAPER)
        .doc("depth of the volume below ground that roots grow in; 0: none");
    root_spread: f64 = real("root_spread", (0.1, 8.0), (0.5, 4.0), 1.0).scale([Scale::Log]).group("roots")
        .doc("radius of that volume over its depth");
    root_laterals: f64 = count("root_laterals", (0, 60), (0.0, 20.0), 8.0).group("roots").source(PAPER)
        .doc("endpoints around the taproot");
    root_branching: f64 = count("root_branching", (0, 30), (0.0, 8.0), 4.0).group("roots").source(PAPER)
        .doc("endpoints of the graph at the end of each lateral root");
    leaf_number: f64 = count("leaf_number", (0, 60), (0.0, 20.0), 0.0).neutral(0.0).group("leaves")
        .doc("leaves on each twig that ends");
    leaf_shape: f64 = Param::scalar("leaf_shape", Kind::choice(1, LeafShape::ALL.map(LeafShape::name)), 8.0).effect([Effect::Layout]).group("leaves")
        .doc("outline of the leaves");
    leaf_length: f64 = size("leaf_length", (0.005, 3.0), (0.02, 0.4), 0.12).group("leaves")
        .doc("length of a leaf");
    leaf_width: f64 = real("leaf_width", (0.05, 3.0), (0.3, 1.5), 1.0).group("leaves")
        .doc("width of a leaf over that of its outline");
    leaf_zone: f64 = real("leaf_zone", (0.0, 1.0), (0.2, 1.0), 0.8).group("leaves")
        .doc("part of the twig, from its tip, that carries leaves");
    leaf_angle: f64 = degrees("leaf_angle", (0.0, 180.0), (20.0, 90.0), 55.0).group("leaves")
        .doc("angle between a leaf and its twig");
}

/// The parameters of the family.
pub(crate) fn space() -> &'static Arc<ParamSpace> {
    static SPACE: LazyLock<Arc<ParamSpace>> = LazyLock::new(|| {
        Arc::new(ParamSpace::new(declarations()).expect("the declarations agree with themselves"))
    });
    &SPACE
}

/// What a species has beside its numbers, as far as it decides which of them matter.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Given {
    /// The first volume is given by its parts.
    pub(crate) volumes: bool,
    /// The crown's outline is drawn.
    pub(crate) outline: bool,
}

impl Numbers {
    /// Whether the value in `slot` can matter.
    pub(crate) fn is_active(&self, given: Given, slot: Slot) -> bool {
        let info = space().info(slot);
        let (level, levels) = (info.index + 1, self.levels as usize);
        let inner = (2..=levels).contains(&level);
        let trunk = self.trunk_height > 0.0 && !given.volumes;
        let crown = |shape: f64| !given.volumes && self.crown_shape == shape;
        let light = levels > 1 && (self.light_branching > 0.0 || self.light_lifespan > 0.0);
        let mortal = levels > 2;
        match space().params()[info.param].name.as_ref() {
            "trunk_width" | "trunk_lean" => trunk,
            "trunk_height" => !given.volumes,
            "trunk_lean_azimuth" => trunk && self.trunk_lean > 0.0,
            "crown_shape" => !given.volumes,
            "crown_height" => !given.volumes && self.crown_shape != 0.0,
            "crown_angle" => crown(0.0),
            "crown_profile" => crown(3.0) && !given.outline,
            "outline_scale" => crown(3.0) && given.outline,
            "clusters" => !given.volumes,
            "cluster_size" => self.clusters > 0.0 && !given.volumes,
            "subgraph_nodes" => levels > 1 || self.root_depth > 0.0,
            "branching" | "taper" => level <= levels,
            "angle" => inner && self.subgraph_shape[level - 1] == 0.0,
            "turn" | "orientation" | "subgraph_shape" => inner,
            "reach" => levels > 1,
            "shrink" => levels > 2,
            "last_from_all" => levels > 2,
            "lifespan" => levels > 1,
            "lifespan_end" | "lifespan_drop" => mortal,
            "sectors" => self.graph == 0.0,
            "light_azimuth" | "light_elevation" => light,
            "light_branching" | "light_lifespan" => levels > 1,
            "root_spread" | "root_laterals" => self.root_depth > 0.0,
            "root_branching" => self.root_depth > 0.0 && self.root_laterals > 0.0,
            "leaf_shape" | "leaf_length" | "leaf_width" | "leaf_zone" | "leaf_angle" => {
                self.leaf_number > 0.0
            }
            _ => true,
        }
    }
}
