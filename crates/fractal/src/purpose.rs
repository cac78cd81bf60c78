//! What draws are for. The numbers are addresses and never change.

use pleach_tree::random::Purpose;

/// Key of a daughter: index 0 is the central one, whether or not it is grown, so that a central branch
/// more or less leaves the others as they are.
pub(crate) const DAUGHTER: Purpose = 0;
/// Number of side branches at the end of a branch.
pub(crate) const COUNT: Purpose = 1;
/// Angle of a branch to its parent.
pub(crate) const POLAR: Purpose = 2;
/// Turn of a branch about its parent.
pub(crate) const AZIMUTH: Purpose = 3;
/// Length of a branch over its parent's.
pub(crate) const SCALE: Purpose = 4;
/// Length of a central branch over that of a side branch.
pub(crate) const APICAL: Purpose = 5;
/// How far a central branch leans.
pub(crate) const LEAN: Purpose = 6;
/// Where to a central branch leans.
pub(crate) const LEAN_AZIMUTH: Purpose = 7;
/// Whether a branch is left out.
pub(crate) const DROP: Purpose = 8;
/// Whether a twig ends in a leaf.
pub(crate) const LEAF: Purpose = 9;
