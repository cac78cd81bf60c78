//! The purposes of random numbers: the middle part of their addresses.
//!
//! Numbers are never reused or renumbered: that would change every tree.

use pleach_tree::random::Purpose;

// Of the whole tree.
pub(crate) const TRUNK: Purpose = 0;
pub(crate) const DART: Purpose = 1;
pub(crate) const DART_SPACING: Purpose = 2;
pub(crate) const DART_DISTANCE: Purpose = 3;
pub(crate) const DART_AZIMUTH: Purpose = 4;
// Of a trunk.
pub(crate) const SCALE: Purpose = 10;
pub(crate) const ROLL: Purpose = 11;
pub(crate) const LENGTH: Purpose = 12;
pub(crate) const BRANCH_COUNT: Purpose = 13;
// Of any stem, once.
pub(crate) const CHILD_LENGTH: Purpose = 20;
pub(crate) const SPLIT_PHASE: Purpose = 21;
pub(crate) const START_ROTATION: Purpose = 22;
pub(crate) const HELIX_PITCH: Purpose = 23;
pub(crate) const HELIX_RADIUS: Purpose = 24;
pub(crate) const HELIX_SPIN: Purpose = 25;
pub(crate) const BASE_SPLITS: Purpose = 26;
// Of a stem's segment.
pub(crate) const BEND: Purpose = 30;
pub(crate) const CURVE: Purpose = 31;
pub(crate) const SPLIT: Purpose = 32;
pub(crate) const SPLIT_ANGLE: Purpose = 33;
pub(crate) const SPLIT_SPREAD: Purpose = 34;
pub(crate) const FORK: Purpose = 35;
pub(crate) const FORK_SPREAD: Purpose = 36;
// Of a stem's child or leaf.
pub(crate) const CHILD: Purpose = 40;
pub(crate) const ROTATE: Purpose = 41;
pub(crate) const DOWN_ANGLE: Purpose = 42;
pub(crate) const BLOSSOM: Purpose = 43;
