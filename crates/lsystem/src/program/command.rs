//! What symbols mean to the turtle.

use crate::syntax::Dialect;

/// An axis that the turtle turns about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// `+` and `-`.
    Turn,
    /// `&` and `^`.
    Pitch,
    /// `/` and `\`.
    Roll,
}

/// A command of the turtle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Command {
    /// Nothing.
    None,
    /// Goes forward and draws; spreads leaves over the piece.
    Forward,
    /// Goes forward without drawing.
    Move,
    /// Turns; the sign is +1 for left, down and right roll.
    Rotate(Axis, f64),
    /// Turns round by 180° about down.
    About,
    /// Rolls until the right axis is level.
    Level,
    /// Looks straight up.
    Upright,
    /// Sets the width, or thins it.
    Width,
    /// Puts a leaf.
    Leaf,
    /// Sets the radius at the branch's end to 0.
    End,
    /// Drops the rest of the branch.
    Cut,
    /// `[`.
    Open,
    /// `]`.
    Close,
    /// `{`.
    OpenPolygon,
    /// `}`.
    ClosePolygon,
    /// `.`: a corner of the polygon.
    Vertex,
}

impl Command {
    /// The meaning of a symbol in a dialect.
    #[must_use]
    pub fn new(dialect: Dialect, symbol: &str) -> Self {
        use Axis::{Pitch, Roll, Turn};
        match (symbol, dialect) {
            ("F", _) | ("G", Dialect::Abop) => Self::Forward,
            ("+", _) => Self::Rotate(Turn, 1.0),
            ("-", _) => Self::Rotate(Turn, -1.0),
            ("&", _) => Self::Rotate(Pitch, 1.0),
            ("^", _) => Self::Rotate(Pitch, -1.0),
            ("/", _) => Self::Rotate(Roll, 1.0),
            ("\\", _) => Self::Rotate(Roll, -1.0),
            ("!", _) => Self::Width,
            ("[", _) => Self::Open,
            ("]", _) => Self::Close,
            ("f", Dialect::Abop) => Self::Move,
            ("|", Dialect::Abop) => Self::About,
            ("$", Dialect::Abop) => Self::Level,
            ("%", Dialect::Abop) => Self::Cut,
            ("{", Dialect::Abop) => Self::OpenPolygon,
            ("}", Dialect::Abop) => Self::ClosePolygon,
            (".", Dialect::Abop) => Self::Vertex,
            ("$", Dialect::Hewitt) => Self::Upright,
            ("%" | "A", Dialect::Hewitt) => Self::End,
            ("L", Dialect::Hewitt) => Self::Leaf,
            _ => Self::None,
        }
    }
}
