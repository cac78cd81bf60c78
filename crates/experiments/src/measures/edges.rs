//! How far two edges agree.

use pleach_silhouette::Bitmap;

/// The harmonic mean of the shares of each picture's edge that the other's passes within `tolerance` pixels (Martin,
/// Fowlkes and Malik 2004), in 0..=1; 0 where one has no edge. That of score cards has another tolerance.
pub(super) fn boundary_f(one: &Bitmap, other: &Bitmap, tolerance: f64) -> f64 {
    let (a, b) = (edge(one), edge(other));
    let (precision, recall) = (share(&a, &near(&b, tolerance)), share(&b, &near(&a, tolerance)));
    if precision + recall > 0.0 { 2.0 * precision * recall / (precision + recall) } else { 0.0 }
}

/// Inked pixels with paper to a side; beyond the picture is paper.
fn edge(picture: &Bitmap) -> Bitmap {
    Bitmap::from_fn(picture.width(), picture.height(), |x, y| {
        let inked = |x: Option<u32>, y: Option<u32>| x.zip(y).is_some_and(|(x, y)| picture.get(x, y));
        let sides = [
            inked(x.checked_sub(1), Some(y)),
            inked(x.checked_add(1), Some(y)),
            inked(Some(x), y.checked_sub(1)),
            inked(Some(x), y.checked_add(1)),
        ];
        picture.get(x, y) && sides.contains(&false)
    })
}

/// The pixels within `distance` of ink.
fn near(picture: &Bitmap, distance: f64) -> Bitmap {
    let reach = distance.floor() as i64;
    let disc: Vec<(i64, i64)> = (-reach..=reach)
        .flat_map(|y| (-reach..=reach).map(move |x| (x, y)))
        .filter(|(x, y)| (x * x + y * y) as f64 <= distance * distance)
        .collect();
    let (width, height) = (picture.width(), picture.height());
    let mut found = Bitmap::new(width, height);
    for y in 0..height {
        for x in picture.ink_in_row(y) {
            for (right, down) in &disc {
                let at = |at: u32, step: i64, side: u32| {
                    u32::try_from(i64::from(at) + step).ok().filter(|at| *at < side)
                };
                if let Some((x, y)) = at(x, *right, width).zip(at(y, *down, height)) {
                    found.set(x, y, true);
                }
            }
        }
    }
    found
}

/// The part of the ink of `picture` that is in `within`.
fn share(picture: &Bitmap, within: &Bitmap) -> f64 {
    picture.intersection(within) as f64 / picture.ink().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_agree_up_to_the_tolerance() {
        let square =
            |at: u32| Bitmap::from_fn(60, 60, |x, y| (at..at + 20).contains(&x) && (20..40).contains(&y));
        assert_eq!(boundary_f(&square(10), &square(10), 1.0), 1.0);
        assert_eq!(boundary_f(&square(10), &square(13), 3.0), 1.0);
        // Of the 76 pixels of the edge, all of one upright side are missed, and of the other all that are not near
        // the level ones.
        assert_eq!(boundary_f(&square(10), &square(13), 2.0), 42.0 / 76.0);
        assert_eq!(boundary_f(&square(10), &Bitmap::new(60, 60), 3.0), 0.0);
    }
}
