//! Twigs with their leaves as cards that show pictures of a few of them.

use glam::Vec3;
use pleach_plant::Leaf;

/// Most twigs of a level that are painted.
pub const MAX_MODELS: usize = 16;

/// Part of a cell that is left around what a card shows, on each side, since filters mix neighbours.
pub const MARGIN: f32 = 1.0 / 64.0;

/// Most times that a card is as large as the twig that it shows: a leaf in its picture grows with it.
pub(crate) const MAX_GROWTH: f32 = 2.0;

/// A twig that is painted, by its parts' numbers in the whole tree.
#[derive(Clone, Debug, PartialEq)]
pub struct TwigModel {
    /// The rectangle that is painted: from the middle of its lower side upwards, and from its left side to its right.
    pub card: Leaf,
    /// Stems, which the picture cuts off at its edges.
    pub stems: Vec<u32>,
    /// Leaves.
    pub leaves: Vec<u32>,
    /// Blossoms.
    pub blossoms: Vec<u32>,
}

impl TwigModel {
    /// `card`, which shows this twig, made smaller about its middle where it would be larger than [`MAX_GROWTH`]
    /// allows.
    pub(crate) fn limited(&self, card: Leaf) -> Leaf {
        let part = |own: Vec3, side: Vec3| {
            let most = MAX_GROWTH * own.length();
            if side.length() > most { most / side.length() } else { 1.0 }
        };
        let (tall, wide) = (part(self.card.along, card.along), part(self.card.across, card.across));
        Leaf {
            position: card.position + card.along * (0.5 * (1.0 - tall)),
            along: card.along * tall,
            across: card.across * wide,
            ..card
        }
    }
}

/// The cards of one level of detail.
#[derive(Clone, Debug, PartialEq)]
pub struct Twigs {
    /// The cards: rectangles from the middle of their lower side upwards. Their shape is the number of a model, and
    /// their stem is one of the level's tree.
    pub cards: Vec<Leaf>,
    /// What they show.
    pub models: Vec<TwigModel>,
    /// Number of the first model's cell in the picture.
    pub first_cell: usize,
    /// The picture that the models of all levels share.
    pub sheet: Sheet,
    /// Where normals point away from, in metres: low in the crown, so that it is lit as one round body.
    pub heart: Vec3,
}

impl Twigs {
    /// The cell of each model: left, top, right and bottom in the picture, 0 to 1.
    #[must_use]
    pub fn cells(&self) -> Vec<[f32; 4]> {
        (0..self.models.len()).map(|model| self.sheet.cell(self.first_cell + model)).collect()
    }

    /// Shows the models of `others` instead of its own: each card the one that is nearest to it in size.
    pub(crate) fn show(&mut self, others: &Self) {
        for card in &mut self.cards {
            let off = |model: &TwigModel| {
                let ratio = |own: Vec3, other: Vec3| {
                    let (own, other) = (own.length_squared().max(1e-12), other.length_squared().max(1e-12));
                    (own / other).max(other / own)
                };
                ratio(card.along, model.card.along) * ratio(card.across, model.card.across)
            };
            let offs = others.models.iter().map(off).enumerate();
            let nearest = offs.min_by(|(_, a), (_, b)| a.total_cmp(b));
            card.shape = nearest.map_or(0, |(model, _)| model as u16);
            *card = others.models.get(usize::from(card.shape)).map_or(*card, |model| model.limited(*card));
        }
        (self.models, self.first_cell) = (others.models.clone(), others.first_cell);
    }

    /// The normal of a card's corner.
    pub(crate) fn normal(&self, corner: Vec3) -> Vec3 {
        (corner - self.heart).try_normalize().unwrap_or(Vec3::Z)
    }
}

/// A picture that is divided into equal cells; both numbers are powers of two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sheet {
    /// Cells side by side.
    pub columns: u32,
    /// Rows of them.
    pub rows: u32,
}

impl Sheet {
    /// One with room for so many cells.
    #[must_use]
    pub fn with_room(cells: usize) -> Self {
        let mut sheet = Self { columns: 1, rows: 1 };
        while ((sheet.columns * sheet.rows) as usize) < cells {
            if sheet.columns > sheet.rows { sheet.rows *= 2 } else { sheet.columns *= 2 }
        }
        sheet
    }

    /// Left, top, right and bottom of a cell without its margin, 0 to 1.
    #[must_use]
    pub fn cell(self, number: usize) -> [f32; 4] {
        let (x, y) = (number as u32 % self.columns, number as u32 / self.columns);
        let low = |at: u32, of: u32| (at as f32 + MARGIN) / of as f32;
        let high = |at: u32, of: u32| ((at + 1) as f32 - MARGIN) / of as f32;
        [low(x, self.columns), low(y, self.rows), high(x, self.columns), high(y, self.rows)]
    }
}
