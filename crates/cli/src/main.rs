//! pleach.
fn main() {}
