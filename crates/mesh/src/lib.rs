//! Trees as triangles.
