//! Drawn trees as if they had been cut out of photographs: speckled, blurred, partly closed, without their foot.

use super::trees::draw;
use pleach_silhouette::Bitmap;

/// Draws of one picture, one after another.
pub(super) struct Dice {
    seed: u64,
    next: u64,
}

impl Dice {
    pub(super) const fn new(seed: u64) -> Self {
        Self { seed, next: 1000 }
    }

    /// A number in `from..to`.
    pub(super) fn between(&mut self, from: f64, to: f64) -> f64 {
        self.next += 1;
        from + (to - from) * draw(self.seed, self.next)
    }

    pub(super) fn is(&mut self, chance: f64) -> bool {
        self.between(0.0, 1.0) < chance
    }
}

/// Columns, rows, and whether there is ink; everything beside the picture is paper.
struct Mask {
    width: usize,
    height: usize,
    ink: Vec<bool>,
}

impl Mask {
    fn get(&self, x: isize, y: isize) -> bool {
        x >= 0
            && y >= 0
            && (x as usize) < self.width
            && (y as usize) < self.height
            && self.ink[y as usize * self.width + x as usize]
    }

    /// Every pixel again, from its place.
    fn map(&mut self, mut new: impl FnMut(&Self, isize, isize) -> bool) {
        let mut ink = Vec::with_capacity(self.ink.len());
        for y in 0..self.height {
            for x in 0..self.width {
                ink.push(new(self, x as isize, y as isize));
            }
        }
        self.ink = ink;
    }

    /// Ink where there is ink (or, to erode, where there is nothing else) within `radius`.
    fn grow(&mut self, radius: isize, ink: Grow) {
        let any = ink == Grow::Dilate;
        for (dx, dy) in [(1, 0), (0, 1)] {
            self.map(|mask, x, y| (-radius..=radius).any(|i| mask.get(x + i * dx, y + i * dy) == any) == any);
        }
    }

    /// Ink where the mean over a square, in 0..=1, and noise are above a half.
    fn blur(&mut self, radius: isize, threshold: f64, noise: f64, dice: &mut Dice) {
        let all = ((2 * radius + 1) * (2 * radius + 1)) as f64;
        self.map(|mask, x, y| {
            let square = (-radius..=radius).flat_map(|dy| (-radius..=radius).map(move |dx| (dx, dy)));
            let count = square.filter(|&(dx, dy)| mask.get(x + dx, y + dy)).count();
            count as f64 / all + dice.between(-noise, noise) > threshold
        });
    }

    /// Ink instead of holes of at most `most` pixels.
    fn fill(&mut self, most: usize) {
        let mut seen = self.ink.clone();
        let mut hole = Vec::new();
        for start in 0..seen.len() {
            if seen[start] {
                continue;
            }
            seen[start] = true;
            hole.clear();
            hole.push(start);
            let (mut i, mut is_open) = (0, false);
            while i < hole.len() {
                let (x, y) = (hole[i] % self.width, hole[i] / self.width);
                i += 1;
                if x == 0 || y == 0 || x + 1 == self.width || y + 1 == self.height {
                    is_open = true;
                    continue;
                }
                for next in
                    [hole[i - 1] - 1, hole[i - 1] + 1, hole[i - 1] - self.width, hole[i - 1] + self.width]
                {
                    if !seen[next] {
                        seen[next] = true;
                        hole.push(next);
                    }
                }
            }
            if !is_open && hole.len() <= most {
                hole.iter().for_each(|&place| self.ink[place] = true);
            }
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Grow {
    Dilate,
    Erode,
}

/// `picture` as a ragged mask, and the part of its height that was cut off at the foot; `None` if little is left.
pub(super) fn ragged(picture: &Bitmap, dice: &mut Dice) -> Option<(Bitmap, f64)> {
    let (_, top, _, bottom) = picture.ink_box()?;
    let cut = if dice.is(0.3) { dice.between(0.01, 0.15) } else { 0.0 };
    let height = picture.height() - (cut * f64::from(bottom + 1 - top)) as u32;
    let ink = (0..height).flat_map(|y| (0..picture.width()).map(move |x| picture.get(x, y))).collect();
    let mut mask = Mask { width: picture.width() as usize, height: height as usize, ink };
    let before = mask.ink.iter().filter(|&&ink| ink).count();
    let radius = |dice: &mut Dice| if picture.height() > 300 && dice.is(0.4) { 2 } else { 1 };
    if dice.is(0.7) {
        // Pixels beside an edge are wrong far more often than others.
        let (near, far) = (dice.between(0.0, 0.25), dice.between(0.0, 0.01));
        mask.map(|mask, x, y| {
            let own = mask.get(x, y);
            let is_edge =
                [(1, 0), (-1, 0), (0, 1), (0, -1)].iter().any(|d| mask.get(x + d.0, y + d.1) != own);
            own != (is_edge && dice.is(near) || own && dice.is(far))
        });
    }
    match dice.between(0.0, 6.0) as u32 {
        0 => mask.grow(radius(dice), Grow::Dilate),
        1 => mask.grow(1, Grow::Erode),
        2 => {
            let radius = radius(dice);
            mask.grow(radius, Grow::Dilate);
            mask.grow(radius, Grow::Erode);
        }
        3 => {
            mask.grow(1, Grow::Erode);
            mask.grow(1, Grow::Dilate);
        }
        4 => {
            let (radius, threshold) = (radius(dice), dice.between(0.3, 0.6));
            mask.blur(radius, threshold, dice.between(0.0, 0.2), &mut Dice::new(dice.seed.wrapping_add(1)));
        }
        _ => {}
    }
    if dice.is(0.5) {
        mask.fill(dice.between(2.0, 60.0) as usize);
    }
    let after = mask.ink.iter().filter(|&&ink| ink).count();
    let result = Bitmap::from_fn(picture.width(), height, |x, y| mask.get(x as isize, y as isize));
    (4 * after > before).then_some((result, cut))
}
