//! Where a crown is cut off by the picture's edge.

/// The picture's sides that a tree's crown touches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Touches {
    /// The left edge.
    pub left: bool,
    /// The top edge.
    pub top: bool,
    /// The right edge.
    pub right: bool,
}

impl Touches {
    /// The names of the sides that are touched.
    #[must_use]
    pub fn sides(&self) -> Vec<&'static str> {
        let sides = [(self.left, "left"), (self.top, "top"), (self.right, "right")];
        sides.into_iter().filter_map(|(touches, name)| touches.then_some(name)).collect()
    }
}
