//! Every species keeps the promises of a generator.

use pleach_stylised::StylisedFamily;

pleach_tree::conformance!(StylisedFamily);
