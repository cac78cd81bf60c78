//! The scores of a card as a list, for tables and for people.

use super::card::ScoreCard;
use super::likeness::Likeness;

/// One score of a [`ScoreCard`].
#[derive(Clone, Copy, Debug)]
pub struct ScoreColumn {
    /// Its name as a column of a table.
    pub name: &'static str,
    /// Where it stands in the JSON of a card, as a JSON pointer.
    pub pointer: &'static str,
    /// What people are shown in place of the name.
    pub words: &'static str,
    /// Whether it only says what another score is to be compared with, whose note has it.
    pub is_baseline: bool,
    /// The score.
    pub value: fn(&ScoreCard) -> f64,
    /// What people are shown beside the score.
    pub note: fn(&ScoreCard) -> String,
}

/// A score without a note.
const PLAIN: ScoreColumn = ScoreColumn {
    name: "",
    pointer: "",
    words: "",
    is_baseline: false,
    value: |_| f64::NAN,
    note: |_| String::new(),
};

impl ScoreCard {
    /// Every score once, in the order in which people are shown them.
    pub const COLUMNS: [ScoreColumn; 11] = [
        ScoreColumn {
            name: "likeness",
            pointer: "/likeness",
            words: "likeness",
            value: |card| card.likeness,
            note: |card| parts(&card.likeness_parts),
            ..PLAIN
        },
        ScoreColumn {
            name: "iou",
            pointer: "/iou",
            words: "IoU",
            value: |card| card.iou,
            note: |card| format!("best single ellipse {:.4}", card.best_ellipse_iou),
            ..PLAIN
        },
        ScoreColumn {
            name: "best_ellipse_iou",
            pointer: "/best_ellipse_iou",
            words: "IoU of the best single ellipse",
            is_baseline: true,
            value: |card| card.best_ellipse_iou,
            ..PLAIN
        },
        ScoreColumn {
            name: "pixel_accuracy",
            pointer: "/pixel_accuracy",
            words: "pixel accuracy",
            value: |card| card.pixel_accuracy,
            note: |card| format!("empty picture {:.4}", card.empty_accuracy),
            ..PLAIN
        },
        ScoreColumn {
            name: "empty_accuracy",
            pointer: "/empty_accuracy",
            words: "pixel accuracy of an empty picture",
            is_baseline: true,
            value: |card| card.empty_accuracy,
            ..PLAIN
        },
        ScoreColumn { name: "dice", pointer: "/dice", words: "Dice", value: |card| card.dice, ..PLAIN },
        ScoreColumn {
            name: "boundary_f",
            pointer: "/boundary_f",
            words: "boundary F",
            value: |card| card.boundary_f,
            ..PLAIN
        },
        ScoreColumn {
            name: "blurred_iou_16",
            pointer: "/blurred_iou/16",
            words: "blurred IoU",
            value: |card| card.blurred_iou.sixteenth,
            note: |_| "blurred by 1/16 of the height".to_owned(),
            ..PLAIN
        },
        ScoreColumn {
            name: "blurred_iou_32",
            pointer: "/blurred_iou/32",
            words: "blurred IoU",
            value: |card| card.blurred_iou.thirty_second,
            note: |_| "1/32".to_owned(),
            ..PLAIN
        },
        ScoreColumn {
            name: "blurred_iou_64",
            pointer: "/blurred_iou/64",
            words: "blurred IoU",
            value: |card| card.blurred_iou.sixty_fourth,
            note: |_| "1/64".to_owned(),
            ..PLAIN
        },
        ScoreColumn {
            name: "chamfer",
            pointer: "/chamfer",
            words: "Chamfer",
            value: |card| card.chamfer,
            note: |_| "mean distance of the outlines, in image heights; 0 is best".to_owned(),
            ..PLAIN
        },
    ];
}

fn parts(likeness: &Likeness) -> String {
    let parts = Likeness::PARTS.iter().zip(likeness.parts());
    parts.map(|(name, part)| format!("{name} {part:.2}")).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bitmap::Bitmap;
    use serde_json::Value;

    /// Pointers to the numbers of `value`, and the numbers.
    fn numbers(value: &Value, at: &str, found: &mut Vec<(String, f64)>) {
        match value {
            Value::Object(fields) => {
                fields.iter().for_each(|(key, value)| numbers(value, &format!("{at}/{key}"), found));
            }
            _ => found.push((at.to_owned(), value.as_f64().unwrap())),
        }
    }

    #[test]
    fn every_score_of_a_card_is_a_column() {
        let goal = Bitmap::from_fn(64, 64, |x, y| (20..40).contains(&x) && y > 10);
        let picture = Bitmap::from_fn(64, 64, |x, y| (24..50).contains(&x) && y > 20);
        let card = ScoreCard::new(&picture, &goal).unwrap();
        let mut found = Vec::new();
        numbers(&serde_json::to_value(card).unwrap(), "", &mut found);
        // What scores are made of, and what crowns are like, are no scores.
        found.retain(|(at, _)| {
            !["likeness_parts", "crown", "goal_crown"].contains(&at.split('/').nth(1).unwrap())
        });
        assert_eq!(found.len(), ScoreCard::COLUMNS.len());
        for column in ScoreCard::COLUMNS {
            let (_, value) = found.iter().find(|(at, _)| at == column.pointer).unwrap();
            assert_eq!((column.value)(&card), *value, "{}", column.name);
            assert_eq!(column.name, column.pointer[1..].replace('/', "_"));
        }
    }
}
