//! The facade of pleach.
