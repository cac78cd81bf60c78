//! The purposes of random draws. A purpose is never reused: a tree is a function of its seed and these.

use pleach_tree::random::Purpose;

/// Where a dart lands.
pub(crate) const DART: Purpose = 0;
/// The weight of an edge.
pub(crate) const WEIGHT: Purpose = 1;
/// Which nodes become endpoints.
pub(crate) const ENDPOINT: Purpose = 2;
/// The graph around an endpoint.
pub(crate) const SUBGRAPH: Purpose = 3;
/// How many more generations a branch has.
pub(crate) const LIFE: Purpose = 4;
/// Where a subgraph points that has no direction of its own.
pub(crate) const DIRECTION: Purpose = 5;
/// The shares of light.
pub(crate) const LIGHT: Purpose = 6;
/// The coarse points that refine the first volume.
pub(crate) const CLUSTER: Purpose = 7;
/// How a leaf is placed.
pub(crate) const LEAF: Purpose = 8;
/// The roots below ground.
pub(crate) const ROOTS: Purpose = 9;
/// Where the nodes along the trunk lie.
pub(crate) const AXIS: Purpose = 10;
