//! Every species keeps the promises of a generator.

use pleach_fractal::FractalFamily;

pleach_tree::conformance!(FractalFamily);
