//! Keys of species files beside the parameters, each declared once.
//!
//! From a [`Key`] follow reading a file, suggestions where a name is misspelt, and what
//! `pleach params` lists.

/// Largest `tree_seed`: what a double, and so any JSON reader, holds exactly.
pub(super) const MAX_SEED: u64 = 1 << 53;

/// A key of species files that is not a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key {
    /// Its name; in a table without the table's.
    pub name: &'static str,
    /// What may stand behind it.
    pub form: Form,
    /// What holds where a file is silent, in words or as it would be written.
    pub default: &'static str,
    /// One line of documentation.
    pub doc: &'static str,
}

/// What may stand behind a key.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    /// A string.
    Text,
    /// A whole number from 0 to 2⁵³.
    Seed,
    /// A string `#rrggbb`: a colour as on screens.
    Color,
    /// `true` or `false`.
    Switch,
    /// A string that is one of these.
    Choice(&'static [&'static str]),
    /// A number of metres from 0 to `max`.
    Length {
        /// Largest allowed value.
        max: f64,
    },
    /// Three numbers: x, y and z in metres.
    Point,
    /// A table with these keys.
    Table(&'static [Key]),
    /// An array of stems, each with its draws.
    Stems,
    /// An array of pictures of a hull.
    Pictures,
    /// An array of pairs of numbers over the height.
    Course,
    /// An array of tables. The `shape` of each is one of these and says which keys it has.
    Shapes(&'static [Shape]),
}

/// One kind of table in an array of tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// What its key `shape` says.
    pub name: &'static str,
    /// Its other keys, all of which have to be there.
    pub keys: &'static [Key],
}

impl Form {
    /// A word or two for tables.
    #[must_use]
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Text => "string",
            Self::Seed => "seed",
            Self::Color => "colour",
            Self::Switch => "boolean",
            Self::Choice(_) => "choice",
            Self::Length { .. } => "real",
            Self::Point => "point",
            Self::Table(_) => "table",
            Self::Stems => "array of stems",
            Self::Pictures => "array of pictures",
            Self::Course => "array of points",
            Self::Shapes(_) => "array of tables",
        }
    }

    /// The smallest and the largest number, where it is a number.
    #[must_use]
    pub fn range(&self) -> Option<(f64, f64)> {
        match *self {
            Self::Seed => Some((0.0, MAX_SEED as f64)),
            Self::Length { max } => Some((0.0, max)),
            _ => None,
        }
    }

    /// How it is written, in a few words.
    #[must_use]
    pub fn example(&self) -> String {
        match self {
            Self::Text => "\"…\"".to_owned(),
            Self::Seed => "0 to 2^53".to_owned(),
            Self::Color => "\"#rrggbb\"".to_owned(),
            Self::Switch => "true, false".to_owned(),
            Self::Choice(names) => names.join(", "),
            Self::Length { max } => format!("0 to {max} m"),
            Self::Point => "[x, y, z] in m".to_owned(),
            Self::Stems => "[[\"0/12\", 7, 12.5, -3.1, 1.04], …]".to_owned(),
            Self::Pictures => "[[0.0, 0.02, -0.4, [\"0289…\", …]], …]".to_owned(),
            Self::Course => "[[0.0, 0.0], [0.01, 0.1], …]".to_owned(),
            Self::Table(keys) => keys.iter().map(|key| key.name).collect::<Vec<_>>().join(", "),
            Self::Shapes(shapes) => shapes.iter().map(|shape| shape.name).collect::<Vec<_>>().join(", "),
        }
    }
}
