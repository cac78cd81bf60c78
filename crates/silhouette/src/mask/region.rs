//! What a person shows of the tree: a box around it, and strokes on it and beside it.

use super::error::MaskError;
use super::photo::Photo;
use super::pixel_box::PixelBox;
use crate::bitmap::Bitmap;

/// Pixels that a person marks.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Stroke(Shape);

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Shape {
    Path { points: Vec<(u32, u32)>, radius: u32 },
    Area(Bitmap),
}

/// Least opacity of a pixel of a painted stroke.
const OPAQUE: u8 = 128;
/// What green, or red, must have more than the other two, of 255.
const PURE: u8 = 64;

impl Stroke {
    /// One pixel: column from the left and row from the top, from 0.
    #[must_use]
    pub fn point(x: u32, y: u32) -> Self {
        Self::path(vec![(x, y)], 0)
    }

    /// Straight lines from point to point, and all pixels within `radius` of them; 0 for lines of one pixel.
    #[must_use]
    pub const fn path(points: Vec<(u32, u32)>, radius: u32) -> Self {
        Self(Shape::Path { points, radius })
    }

    /// The ink of a picture of the photograph's size.
    #[must_use]
    pub const fn area(ink: Bitmap) -> Self {
        Self(Shape::Area(ink))
    }

    /// What is painted in a picture of the photograph's size: green includes, red excludes.
    ///
    /// A pixel counts if its opacity is at least 128 of 255, and if its green (or red) is at least 64 more than each of
    /// the two other channels. All others, as those of a transparent layer or of a grey copy of the photograph, say
    /// nothing. The first stroke is for [`MaskOptions::include`](super::MaskOptions::include), the second one for
    /// [`MaskOptions::exclude`](super::MaskOptions::exclude); `None` where there is no such pixel.
    #[must_use]
    pub fn painted(layer: &Photo) -> (Option<Self>, Option<Self>) {
        let painted = |channel: usize| {
            let ink = Bitmap::from_fn(layer.width(), layer.height(), |x, y| {
                let color = layer.rgb(x, y);
                let is_pure = (0..3).all(|c| {
                    c == channel || color[channel].checked_sub(color[c]).is_some_and(|more| more >= PURE)
                });
                layer.opacity(x, y) >= OPAQUE && is_pure && color[channel] >= PURE
            });
            (ink.ink() > 0).then(|| Self::area(ink))
        };
        (painted(1), painted(0))
    }

    /// Draws the stroke as ink.
    ///
    /// # Errors
    /// If it has no pixel, has a point outside of the picture, or is of another size.
    fn draw(&self, out: &mut Bitmap) -> Result<(), MaskError> {
        let (width, height) = (out.width(), out.height());
        match &self.0 {
            Shape::Area(ink) if (ink.width(), ink.height()) != (width, height) => {
                Err(MaskError::StrokeSize { stroke: (ink.width(), ink.height()), width, height })
            }
            Shape::Area(ink) if ink.ink() == 0 => Err(MaskError::EmptyStroke),
            Shape::Area(ink) => {
                out.unite(ink);
                Ok(())
            }
            Shape::Path { points, radius } => {
                if let Some(&(x, y)) = points.iter().find(|p| p.0 >= width || p.1 >= height) {
                    return Err(MaskError::StrokeOutside { x, y, width, height });
                }
                let first = *points.first().ok_or(MaskError::EmptyStroke)?;
                disk(first, *radius, out);
                points.windows(2).for_each(|ends| line(ends[0], ends[1], *radius, out));
                Ok(())
            }
        }
    }
}

fn disk((x, y): (u32, u32), radius: u32, out: &mut Bitmap) {
    let (width, height) = (out.width(), out.height());
    let squared = u64::from(radius) * u64::from(radius);
    for row in y.saturating_sub(radius)..y.saturating_add(radius).saturating_add(1).min(height) {
        let down = u64::from(row.abs_diff(y));
        // Wide enough that the root's rounding does not matter.
        let half = (squared - down * down).isqrt() as u32;
        for column in x.saturating_sub(half)..x.saturating_add(half).saturating_add(1).min(width) {
            out.set(column, row, true);
        }
    }
}

fn line(from: (u32, u32), to: (u32, u32), radius: u32, out: &mut Bitmap) {
    // Disks a quarter of the radius apart leave no notch of a pixel; a line of one pixel has them all.
    let longer = from.0.abs_diff(to.0).max(from.1.abs_diff(to.1));
    let count = u64::from(longer.div_ceil((radius / 4).max(1)).max(1));
    let between = |a: u32, b: u32, i: u64| {
        let (a, b) = (i128::from(a), i128::from(b));
        (a + ((b - a) * i128::from(i) * 2 + i128::from(count)).div_euclid(2 * i128::from(count))) as u32
    };
    for i in 0..=count {
        disk((between(from.0, to.0, i), between(from.1, to.1, i)), radius, out);
    }
}

/// What was shown, checked.
pub(super) struct Shown {
    pub(super) region: PixelBox,
    /// The pixels that were marked, of the picture's size; `None` if there are none.
    pub(super) include: Option<Bitmap>,
    pub(super) exclude: Option<Bitmap>,
}

impl Shown {
    /// What is shown of a photograph; `None` if nothing is.
    ///
    /// # Errors
    /// See [`MaskError`]: a box or a stroke that is not in the picture, or that leaves no tree.
    pub(super) fn new(
        photo: &Photo,
        region: Option<PixelBox>,
        include: &[Stroke],
        exclude: &[Stroke],
    ) -> Result<Option<Self>, MaskError> {
        if region.is_none() && include.is_empty() && exclude.is_empty() {
            return Ok(None);
        }
        let (width, height) = (photo.width(), photo.height());
        let region = region.unwrap_or(PixelBox::whole(photo));
        if region.width == 0 || region.height == 0 {
            return Err(MaskError::EmptyRegion { region });
        }
        let is_inside =
            |start: u32, side: u32, most: u32| start.checked_add(side).is_some_and(|end| end <= most);
        if !is_inside(region.x, region.width, width) || !is_inside(region.y, region.height, height) {
            return Err(MaskError::RegionOutside { region, width, height });
        }
        let drawn = |strokes: &[Stroke]| -> Result<Option<Bitmap>, MaskError> {
            let mut out = (!strokes.is_empty()).then(|| Bitmap::new(width, height));
            if let Some(out) = &mut out {
                strokes.iter().try_for_each(|stroke| stroke.draw(out))?;
            }
            Ok(out)
        };
        let (mut include, exclude) = (drawn(include)?, drawn(exclude)?);
        if let Some(include) = &mut include {
            // What is excluded, too, was painted over.
            for y in 0..height {
                for x in include.ink_in_row(y).collect::<Vec<_>>() {
                    if !region.contains(x, y) || exclude.as_ref().is_some_and(|e| e.get(x, y)) {
                        include.set(x, y, false);
                    }
                }
            }
            if include.ink() == 0 {
                return Err(MaskError::IncludesNothing);
            }
        }
        if let Some(exclude) = &exclude {
            let inside: u64 = (region.y..region.y + region.height)
                .map(|y| exclude.ink_in_row(y).filter(|&x| region.contains(x, y)).count() as u64)
                .sum();
            if inside == u64::from(region.width) * u64::from(region.height) {
                return Err(MaskError::ExcludesAll);
            }
        }
        Ok(Some(Self { region, include, exclude }))
    }
}
