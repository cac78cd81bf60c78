//! A tree's outline as one piece.

use pleach_silhouette::Bitmap;

/// `picture` with all gaps up to `2 * radius` pixels closed, by a square, and with its holes filled: what a crown
/// covers, however dense it is.
pub(super) fn crown(picture: &Bitmap, radius: u32) -> Bitmap {
    // Ink reaches `radius` pixels beyond the picture before it is taken back; around it is paper.
    let margin = 2 * radius + 1;
    let (width, height) = (picture.width() + 2 * margin, picture.height() + 2 * margin);
    let inside = |at: u32, side: u32| at.checked_sub(margin).filter(|at| *at < side);
    let padded = Bitmap::from_fn(width, height, |x, y| {
        inside(x, picture.width()).zip(inside(y, picture.height())).is_some_and(|(x, y)| picture.get(x, y))
    });
    let around = |at: u32, side: u32| at.saturating_sub(radius)..(at + radius + 1).min(side);
    let wider = Bitmap::from_fn(width, height, |x, y| around(x, width).any(|x| padded.get(x, y)));
    let grown = Bitmap::from_fn(width, height, |x, y| around(y, height).any(|y| wider.get(x, y)));
    let narrower = Bitmap::from_fn(width, height, |x, y| around(x, width).all(|x| grown.get(x, y)));
    let closed = Bitmap::from_fn(width, height, |x, y| around(y, height).all(|y| narrower.get(x, y)));
    let outside = outside(&closed);
    Bitmap::from_fn(picture.width(), picture.height(), |x, y| !outside.get(x + margin, y + margin))
}

/// The paper that is connected with the upper left corner, which is paper.
fn outside(picture: &Bitmap) -> Bitmap {
    let mut found = Bitmap::new(picture.width(), picture.height());
    let mut open = vec![(0, 0)];
    while let Some((x, y)) = open.pop() {
        if x >= picture.width() || y >= picture.height() || picture.get(x, y) || found.get(x, y) {
            continue;
        }
        found.set(x, y, true);
        open.extend([(x + 1, y), (x, y + 1)]);
        open.extend(x.checked_sub(1).map(|x| (x, y)));
        open.extend(y.checked_sub(1).map(|y| (x, y)));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_up_to_twice_the_radius_are_closed_and_holes_are_filled() {
        // Two bars, and a ring around a hole that is too wide to be closed.
        let bars = |gap: u32| Bitmap::from_fn(30, 12, |x, _| x < 8 || (8 + gap..16 + gap).contains(&x));
        for (gap, closed) in [(4, true), (5, false)] {
            let crown = crown(&bars(gap), 2);
            assert_eq!(crown.get(9, 6), closed, "a gap of {gap}");
            assert_eq!(crown.ink(), bars(gap).ink() + if closed { 4 * 12 } else { 0 });
        }
        let ring = Bitmap::from_fn(30, 30, |x, y| {
            let within =
                |side: u32| (15 - side..15 + side).contains(&x) && (15 - side..15 + side).contains(&y);
            within(12) && !within(10)
        });
        assert_eq!(crown(&ring, 2).ink(), 24 * 24);
    }

    #[test]
    fn ink_at_the_edge_stays_as_it_is() {
        let corner = Bitmap::from_fn(20, 20, |x, y| x < 5 && y < 5);
        assert_eq!(crown(&corner, 3), corner);
        assert_eq!(crown(&Bitmap::new(9, 9), 3).ink(), 0);
    }
}
