//! What every family promises.

use pleach_least_cost_path::LeastCostPathFamily;

pleach_tree::conformance!(LeastCostPathFamily);
