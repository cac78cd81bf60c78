//! What draws are for. The numbers are addresses and never change.

use pleach_tree::random::Purpose;

// Of the whole tree.
/// Key of the crown's volume.
pub(crate) const VOLUME: Purpose = 0;
/// Key of the attraction points.
pub(crate) const POINTS: Purpose = 1;
/// Key of a trunk, and of what stands on it.
pub(crate) const TRUNK: Purpose = 2;
/// Key of the twigs of a trunk.
pub(crate) const TWIGS: Purpose = 4;

// Of the volume.
/// Phases of the ripples of its surface.
pub(crate) const RIPPLE: Purpose = 10;

// Of the points.
/// Offsets of the sequence of points.
pub(crate) const OFFSET: Purpose = 20;
/// Deviation of a point from the sequence.
pub(crate) const JITTER: Purpose = 21;
/// Whether shade leaves out a point.
pub(crate) const SHADED: Purpose = 22;
/// Place of a point in its clump.
pub(crate) const CLUMP: Purpose = 23;
/// Place of a clump.
pub(crate) const CLUMP_PLACE: Purpose = 24;
/// Whether a hull has a point.
pub(crate) const HELD: Purpose = 25;

// Of a trunk.
/// Phases of its crookedness.
pub(crate) const CROOK: Purpose = 30;
/// Key of a limb.
pub(crate) const LIMB: Purpose = 31;
/// Turn, angle, height and length of a limb.
pub(crate) const LIMB_DRAW: Purpose = 32;
/// Direction in which a trunk stands among several.
pub(crate) const STAND: Purpose = 33;

// Of a stem.
/// Key of a stem on it.
pub(crate) const STEM: Purpose = 40;
/// Turn of a twig.
pub(crate) const TURN: Purpose = 41;
/// Angle of a twig to its parent.
pub(crate) const ANGLE: Purpose = 42;
/// Length of a twig.
pub(crate) const LENGTH: Purpose = 43;
/// Bend of a twig.
pub(crate) const BEND: Purpose = 44;
/// Turn, angle and size of a leaf.
pub(crate) const LEAF: Purpose = 45;
/// Whether a node bears one twig more.
pub(crate) const COUNT: Purpose = 46;
