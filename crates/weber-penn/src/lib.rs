//! Weber and Penn's parametric trees as extended by Hewitt.
