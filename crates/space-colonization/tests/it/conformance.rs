//! The promises of every generator.

use pleach_space_colonization::SpaceColonizationFamily;

pleach_tree::conformance!(SpaceColonizationFamily);
