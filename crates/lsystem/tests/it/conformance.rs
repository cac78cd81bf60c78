//! Every species keeps the promises of a generator.

use pleach_lsystem::LSystemFamily;

pleach_tree::conformance!(LSystemFamily);
