//! Every species keeps the promises of a generator.

use pleach_weber_penn::WeberPennFamily;

pleach_tree::conformance!(WeberPennFamily);
