//! The map as a picture: dots with names and thumbnails, regions of nearest species, the hull, where
//! values switch, and iso-lines of traits.

mod contour;
mod font;
mod place;
mod scene;
mod switches;

use pleach_tree::math;
pub use scene::{Anchor, Color, Scene, Shape};

use crate::draw::{DrawError, Drawing, silhouettes};
use crate::error::BlendError;
use crate::map::BlendMap;
use crate::measures::Measure;
use crate::plane::Point;
use contour::Grid;
use pleach_silhouette::{Bitmap, Detail};
use switches::switch_lines_on;
pub use switches::{Switch, switch_lines};

/// Optional layers beside dots, names, regions and hull.
#[derive(Clone, Debug, Default)]
pub struct Extras {
    /// A silhouette for each landmark, in their order; `None` for a map without thumbnails.
    pub thumbnails: Vec<Bitmap>,
    /// Iso-lines of these traits.
    pub traits: Vec<TraitField>,
    /// Points to mark, with their labels: a blend, a fitted tree.
    pub marks: Vec<(Point, String)>,
}

/// A trait sampled on a grid of [`trait_points`].
#[derive(Clone, Debug)]
pub struct TraitField {
    /// The trait.
    pub of: Measure,
    /// Its value at each point of the grid; `None` outside the hull.
    pub values: Vec<Option<f64>>,
}

/// Size of the picture in pixels.
const WIDTH: u32 = 1500;
const HEIGHT: u32 = 1060;
/// Height and width of a silhouette on the map, in pixels.
const THUMBNAIL: u32 = 92;
/// Room for what is written around the map.
const MARGIN: f64 = 60.0;
const HEAD: f64 = 76.0;

/// Samples of the plane across, for the lines where values switch.
const SWITCH_COLUMNS: usize = 240;
/// Samples of the plane across, for iso-lines of traits.
const TRAIT_COLUMNS: usize = 21;
/// Pieces, on a smooth curve, that each interval between two samples of a trait is cut into for its iso-lines.
const REFINED: usize = 6;

const INK: Color = Color::opaque([40, 40, 40]);
const GRAY: Color = Color::opaque([110, 110, 110]);
const ACCENT: Color = Color::opaque([178, 34, 34]);
/// Line colours of traits: blue, vermilion, green, purple and orange of Okabe and Ito 2008.
const MEASURE_COLORS: [[u8; 3]; 5] =
    [[0, 114, 178], [213, 94, 0], [0, 158, 115], [160, 80, 140], [200, 130, 0]];

/// The plane's rectangle and the pixels that show it.
#[derive(Clone, Copy, Debug)]
struct Sheet {
    low: Point,
    high: Point,
    scale: f64,
    origin: (f64, f64),
}

impl Sheet {
    fn new(map: &BlendMap) -> Self {
        let (mut low, mut high) = (map.dots()[0], map.dots()[0]);
        for dot in map.dots() {
            low = Point { x: low.x.min(dot.x), y: low.y.min(dot.y) };
            high = Point { x: high.x.max(dot.x), y: high.y.max(dot.y) };
        }
        let (w, h) = (f64::from(WIDTH) - 2.0 * MARGIN, f64::from(HEIGHT) - HEAD - MARGIN);
        // Free room around the dots, and never a flat sheet.
        let pad = 0.17 * (high.x - low.x).max(high.y - low.y).max(1e-9);
        let (low, high) = (low - Point { x: pad, y: pad }, high + Point { x: pad, y: pad });
        let scale = (w / (high.x - low.x)).min(h / (high.y - low.y));
        let middle = (low + high) * 0.5;
        let half = Point { x: w / scale / 2.0, y: h / scale / 2.0 };
        Self { low: middle - half, high: middle + half, scale, origin: (MARGIN, HEAD) }
    }

    fn at(&self, p: Point) -> (f64, f64) {
        (self.origin.0 + (p.x - self.low.x) * self.scale, self.origin.1 + (self.high.y - p.y) * self.scale)
    }

    fn place(&self, (x, y): (f64, f64)) -> Point {
        Point {
            x: self.low.x + (x - self.origin.0) / self.scale,
            y: self.high.y - (y - self.origin.1) / self.scale,
        }
    }

    /// Points of a grid of this many columns, row by row from the top, and the number of rows.
    fn grid(&self, columns: usize) -> (Vec<Point>, usize) {
        let step = (self.high.x - self.low.x) / (columns - 1) as f64;
        let rows = ((self.high.y - self.low.y) / step).floor() as usize + 1;
        let point =
            |i: usize, j: usize| Point { x: self.low.x + i as f64 * step, y: self.high.y - j as f64 * step };
        ((0..rows).flat_map(|j| (0..columns).map(move |i| point(i, j))).collect(), rows)
    }
}

/// Points at which traits are sampled for [`TraitField`], row by row; those outside the hull are
/// `None`.
#[must_use]
pub fn trait_points(map: &BlendMap) -> Vec<Option<Point>> {
    let (points, _) = Sheet::new(map).grid(TRAIT_COLUMNS);
    points.into_iter().map(|p| Some(p).filter(|p| map.hull().nearest(*p).distance <= reach(map))).collect()
}

/// Traits are sampled a little beyond the hull, so that their lines reach it.
fn reach(map: &BlendMap) -> f64 {
    let sheet = Sheet::new(map);
    0.8 * (sheet.high.x - sheet.low.x) / (TRAIT_COLUMNS - 1) as f64
}

/// Points of a grid of `columns` by `rows` across the plane, from the upper left: the rectangle of the
/// dots.
#[must_use]
pub fn grid_points(map: &BlendMap, columns: usize, rows: usize) -> Vec<Point> {
    let (mut low, mut high) = (map.dots()[0], map.dots()[0]);
    for dot in map.dots() {
        low = Point { x: low.x.min(dot.x), y: low.y.min(dot.y) };
        high = Point { x: high.x.max(dot.x), y: high.y.max(dot.y) };
    }
    let part = |i: usize, n: usize| if n > 1 { i as f64 / (n - 1) as f64 } else { 0.5 };
    let place = |i: usize, j: usize| Point {
        x: low.towards(high, part(i, columns)).x,
        y: high.towards(low, part(j, rows)).y,
    };
    (0..rows).flat_map(|j| (0..columns).map(move |i| place(i, j))).collect()
}

/// The whole picture.
///
/// # Errors
/// None for a map and its own points.
pub fn scene(map: &BlendMap, extras: &Extras) -> Result<Scene, BlendError> {
    let sheet = Sheet::new(map);
    let mut scene = Scene::new(WIDTH, HEIGHT);
    regions(map, &sheet, &mut scene);
    switches(map, &sheet, &mut scene)?;
    hull(map, &sheet, &mut scene);
    for (number, field) in extras.traits.iter().enumerate() {
        isolines(map, &sheet, field, MEASURE_COLORS[number % MEASURE_COLORS.len()], &mut scene);
    }
    species(map, &sheet, &extras.thumbnails, &mut scene);
    for (point, label) in &extras.marks {
        let at = sheet.at(*point);
        scene.add(Shape::Dot { at, radius: 6.0, fill: ACCENT });
        scene.add(text(label, (at.0 + 10.0, at.1 + 5.0), 14.0, Anchor::Start, ACCENT));
    }
    frame(map, &sheet, extras, &mut scene);
    Ok(scene)
}

fn text(text: &str, at: (f64, f64), size: f64, anchor: Anchor, color: Color) -> Shape {
    Shape::Text { text: text.to_owned(), at, size, anchor, color }
}

/// Light colours that differ between neighbouring numbers: hues by the golden angle.
fn pastel(number: usize) -> Color {
    let hue = (number as f64 * 137.508) % 360.0;
    let channel = |shift: f64| {
        let distance = ((hue + shift) % 360.0 - 180.0).abs() / 60.0;
        let full = (distance - 1.0).clamp(0.0, 1.0);
        (214.0 + 34.0 * full).round() as u8
    };
    Color::opaque([channel(0.0), channel(240.0), channel(120.0)])
}

fn regions(map: &BlendMap, sheet: &Sheet, scene: &mut Scene) {
    for landmark in 0..map.dots().len() {
        let cell = map.region(landmark, sheet.low, sheet.high);
        if cell.len() > 2 {
            let corners = cell.iter().map(|p| sheet.at(*p)).collect();
            scene.add(Shape::Polygon { corners, fill: pastel(landmark) });
        }
    }
    // Outside the hull trees are extrapolated: paler.
    if !map.hull().is_flat() {
        let page = [
            sheet.low,
            Point { x: sheet.high.x, y: sheet.low.y },
            sheet.high,
            Point { x: sheet.low.x, y: sheet.high.y },
        ];
        let ring = map.hull().corners();
        let pale = Color { rgb: [255; 3], opacity: 0.62 };
        // The page less the hull, cut into one piece for each edge: the strip between it and the page.
        for i in 0..ring.len() {
            let (a, b) = (ring[i], ring[(i + 1) % ring.len()]);
            let out = |p: Point, towards: Point| p + (p - towards) * 1e3;
            let middle = ring.iter().fold(Point::default(), |m, p| m + *p) * (1.0 / ring.len() as f64);
            let corners = [a, b, out(b, middle), out(a, middle)];
            let clipped = clip(&corners, &page);
            if clipped.len() > 2 {
                scene.add(Shape::Polygon {
                    corners: clipped.iter().map(|p| sheet.at(*p)).collect(),
                    fill: pale,
                });
            }
        }
    }
}

/// The part of a convex polygon inside another one, both anticlockwise or the first clockwise.
fn clip(polygon: &[Point], window: &[Point]) -> Vec<Point> {
    let mut kept = polygon.to_vec();
    for i in 0..window.len() {
        let (a, b) = (window[i], window[(i + 1) % window.len()]);
        let side = |p: Point| (b - a).cross(p - a);
        let old = std::mem::take(&mut kept);
        for (k, &to) in old.iter().enumerate() {
            let from = old[(k + old.len() - 1) % old.len()];
            let (before, after) = (side(from), side(to));
            if (before < 0.0) != (after < 0.0) {
                kept.push(from.towards(to, before / (before - after)));
            }
            if after >= 0.0 {
                kept.push(to);
            }
        }
    }
    kept
}

/// Lines where choices and signs switch, or the number of levels does: darker where more of them do.
fn switches(map: &BlendMap, sheet: &Sheet, scene: &mut Scene) -> Result<(), BlendError> {
    for Switch { ends, count } in switch_lines_on(map, sheet, SWITCH_COLUMNS)? {
        let color = Color { rgb: [90, 90, 110], opacity: (0.2 + 0.12 * count).min(0.75) as f32 };
        let points = ends.map(|end| sheet.at(end)).to_vec();
        scene.add(Shape::Line { points, color, width: 1.3, dash: None });
    }
    Ok(())
}

/// Where the picture of the map shows a point of the plane, in pixels from its upper left corner.
#[must_use]
pub fn pixel_at(map: &BlendMap, point: Point) -> (f64, f64) {
    Sheet::new(map).at(point)
}

/// The point of the plane that the picture of the map shows there, in pixels from its upper left corner.
#[must_use]
pub fn point_at(map: &BlendMap, pixel: (f64, f64)) -> Point {
    Sheet::new(map).place(pixel)
}

/// The silhouettes of a map's species, for [`Extras::thumbnails`].
///
/// # Errors
/// The first species that does not grow from `seed`.
pub fn thumbnails(map: &BlendMap, seed: u64) -> Result<Vec<Bitmap>, DrawError> {
    silhouettes(map.landmarks().species(), seed, Drawing { pixels: THUMBNAIL, detail: Detail::Full })
}

/// The corners of the rectangle that the picture of the map shows: the least and the greatest coordinates.
#[must_use]
pub fn extent(map: &BlendMap) -> [Point; 2] {
    let Sheet { low, high, .. } = Sheet::new(map);
    [low, high]
}

fn hull(map: &BlendMap, sheet: &Sheet, scene: &mut Scene) {
    let mut points: Vec<(f64, f64)> = map.hull().corners().iter().map(|p| sheet.at(*p)).collect();
    if !map.hull().is_flat() {
        points.push(points[0]);
    }
    scene.add(Shape::Line { points, color: GRAY, width: 1.6, dash: Some((7.0, 6.0)) });
}

fn isolines(map: &BlendMap, sheet: &Sheet, field: &TraitField, rgb: [u8; 3], scene: &mut Scene) {
    let color = Color::opaque(rgb);
    let known = field.values.iter().flatten();
    let (low, high) = known.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(*v), h.max(*v)));
    let grid = contour::refined(&Grid { columns: TRAIT_COLUMNS, cells: field.values.clone() }, REFINED);
    let step_x = (sheet.high.x - sheet.low.x) / (grid.columns - 1) as f64;
    let back = |p: (f64, f64)| Point { x: sheet.low.x + p.0 * step_x, y: sheet.high.y - p.1 * step_x };
    let step = round_step((high - low) / 6.0);
    let mut level = (low / step).ceil() * step;
    while low < high && level < high {
        let mut pieces = contour::isoline(&grid, level);
        pieces.retain(|[a, b]| map.hull().nearest(back(*a).towards(back(*b), 0.5)).distance == 0.0);
        let mut labelled: Option<(f64, f64)> = None;
        for line in contour::joined(&pieces) {
            let points: Vec<(f64, f64)> = line.into_iter().map(|p| sheet.at(back(p))).collect();
            labelled = labelled.or(points.first().copied());
            scene.add(Shape::Line { points, color, width: 2.0, dash: None });
        }
        if let Some(at) = labelled {
            let number = format!("{}", (level * 1e6).round() / 1e6);
            scene.add(text(&number, (at.0, at.1 + 4.0), 13.0, Anchor::Middle, color));
        }
        level += step;
    }
}

/// A round number near `step`: 1, 2 or 5 times a power of ten.
fn round_step(step: f64) -> f64 {
    let power = math::pow(10.0, math::log10(step.max(1e-9)).floor());
    let part = step / power;
    power
        * if part < 1.5 {
            1.0
        } else if part < 3.5 {
            2.0
        } else if part < 7.5 {
            5.0
        } else {
            10.0
        }
}

fn species(map: &BlendMap, sheet: &Sheet, thumbnails: &[Bitmap], scene: &mut Scene) {
    const LETTERS: f64 = 15.0;
    let names: Vec<String> = map.landmarks().species().iter().map(|s| s.name.replace('_', " ")).collect();
    let side = thumbnails.iter().map(|t| f64::from(t.height())).fold(0.0, f64::max);
    let sizes: Vec<(f64, f64)> = names
        .iter()
        .map(|name| (scene.text_width(name, LETTERS).max(side) + 6.0, side + LETTERS + 7.0))
        .collect();
    let dots: Vec<(f64, f64)> = map.dots().iter().map(|d| sheet.at(*d)).collect();
    let window = [MARGIN, HEAD, f64::from(WIDTH) - MARGIN, f64::from(HEIGHT) - MARGIN];
    let boxes = place::boxes(&dots, &sizes, window);
    for ((dot, corner), size) in dots.iter().zip(&boxes).zip(&sizes) {
        let near = place::nearest(*dot, *corner, *size);
        if math::hypot(near.0 - dot.0, near.1 - dot.1) > 6.0 {
            // To the middle of the box, where the silhouette covers it.
            let end = if side > 0.0 { (corner.0 + size.0 / 2.0, corner.1 + 0.6 * side) } else { near };
            scene.add(Shape::Line { points: vec![*dot, end], color: GRAY, width: 1.0, dash: None });
        }
    }
    for (i, (corner, size)) in boxes.iter().zip(&sizes).enumerate() {
        if let Some(thumbnail) = thumbnails.get(i) {
            let at = (corner.0 + (size.0 - f64::from(thumbnail.width())) / 2.0, corner.1);
            scene.add(Shape::Silhouette { bitmap: thumbnail.clone(), at });
        }
        let at = (corner.0 + size.0 / 2.0, corner.1 + size.1 - 5.0);
        scene.add(text(&names[i], at, LETTERS, Anchor::Middle, INK));
    }
    for dot in dots {
        scene.add(Shape::Dot { at: dot, radius: 5.0, fill: Color::opaque([255; 3]) });
        scene.add(Shape::Dot { at: dot, radius: 3.8, fill: INK });
    }
}

/// The caption: which axes, and their share of the variance, since two axes rarely hold all differences.
fn title(map: &BlendMap) -> String {
    let count = map.dots().len();
    if map.is_by_components() {
        let shown: f64 = map.pca().explained().iter().take(2).sum();
        format!("{count} species, on two axes that show {:.0} % of how they differ", 100.0 * shown)
    } else {
        format!("{count} species, laid out by how alike they look")
    }
}

/// Title, axes and legend.
fn frame(map: &BlendMap, sheet: &Sheet, extras: &Extras, scene: &mut Scene) {
    let (left, right, bottom) = (MARGIN, f64::from(WIDTH) - MARGIN, f64::from(HEIGHT) - MARGIN);
    let outline = vec![(left, HEAD), (right, HEAD), (right, bottom), (left, bottom), (left, HEAD)];
    scene.add(Shape::Line { points: outline, color: GRAY, width: 1.0, dash: None });
    scene.add(text(&title(map), (left, 32.0), 22.0, Anchor::Start, INK));
    let legend = "colours: nearest species   dashed: hull, pale beyond it   grey lines: choices, signs or levels switch";
    scene.add(text(legend, (left, 58.0), 14.0, Anchor::Start, GRAY));
    let mut x = right;
    for (number, field) in extras.traits.iter().enumerate().rev() {
        let name = field.of.name().replace('_', " ");
        scene.add(text(
            &name,
            (x, 32.0),
            15.0,
            Anchor::End,
            Color::opaque(MEASURE_COLORS[number % MEASURE_COLORS.len()]),
        ));
        x -= scene.text_width(&name, 15.0) + 18.0;
    }
    let axis = |axis: usize| {
        if !map.is_by_components() {
            return "by looks: distances are how unlike the silhouettes are".to_owned();
        }
        let share = 100.0 * map.pca().explained().get(axis).copied().unwrap_or(0.0);
        let coding = map.landmarks().coding();
        let heavy: Vec<String> = map
            .top_loadings(axis)
            .iter()
            .take(4)
            .map(|l| {
                format!(
                    "{} {}",
                    if l.loading > 0.0 { "+" } else { "\u{2212}" },
                    coding.features()[l.feature].name
                )
            })
            .collect();
        format!("axis {} ({share:.0} %):  {}", axis + 1, heavy.join("   "))
    };
    scene.add(text(&axis(0), ((left + right) / 2.0, bottom + 26.0), 14.0, Anchor::Middle, INK));
    if map.is_by_components() {
        let second = format!("{}  (upwards)", axis(1));
        scene.add(text(&second, ((left + right) / 2.0, bottom + 47.0), 14.0, Anchor::Middle, INK));
    }
    // Ticks at whole numbers along two edges.
    let ticks = |low: f64, high: f64| (low.ceil() as i64..=high.floor() as i64).map(|t| t as f64);
    if sheet.high.x - sheet.low.x < 40.0 {
        for t in ticks(sheet.low.x, sheet.high.x) {
            let (x, _) = sheet.at(Point { x: t, y: 0.0 });
            scene.add(Shape::Line {
                points: vec![(x, bottom), (x, bottom - 6.0)],
                color: GRAY,
                width: 1.0,
                dash: None,
            });
            scene.add(text(&format!("{t}"), (x + 4.0, bottom - 4.0), 11.0, Anchor::Start, GRAY));
        }
        for t in ticks(sheet.low.y, sheet.high.y) {
            let (_, y) = sheet.at(Point { x: 0.0, y: t });
            scene.add(Shape::Line {
                points: vec![(left, y), (left + 6.0, y)],
                color: GRAY,
                width: 1.0,
                dash: None,
            });
            scene.add(text(&format!("{t}"), (left + 9.0, y + 4.0), 11.0, Anchor::Start, GRAY));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::Settings;
    use crate::testing::fifteen;

    #[test]
    fn a_map_shows_every_species_by_name() {
        let map = BlendMap::new(fifteen(), Settings::default()).unwrap();
        let fields = trait_points(&map).iter().map(|p| p.map(|p| p.x + p.y)).collect();
        let extras = Extras {
            traits: vec![TraitField { of: Measure::Ink, values: fields }],
            marks: vec![(Point { x: 0.0, y: 0.0 }, "here".to_owned())],
            ..Extras::default()
        };
        let scene = scene(&map, &extras).unwrap();
        let svg = scene.to_svg();
        for species in map.landmarks().species() {
            assert!(svg.contains(&format!(">{}</text>", species.name.replace('_', " "))), "{}", species.name);
        }
        assert!(svg.contains(">here</text>") && svg.contains(">ink</text>"));
        let shown = 100.0 * map.pca().explained().iter().take(2).sum::<f64>();
        assert!(svg.contains(&format!("two axes that show {shown:.0} % of how they differ")));
        assert!(scene.to_png().is_some());
    }

    #[test]
    fn pixels_of_the_picture_are_points_of_the_map() {
        let map = BlendMap::new(fifteen(), Settings::default()).unwrap();
        let [low, high] = extent(&map);
        let (left, bottom) = pixel_at(&map, low);
        let (right, top) = pixel_at(&map, high);
        assert!((left, top) == (MARGIN, HEAD) && (right - f64::from(WIDTH) + MARGIN).abs() < 1e-9);
        assert!((bottom - f64::from(HEIGHT) + MARGIN).abs() < 1e-9);
        let dots: Vec<_> = scene(&map, &Extras::default()).unwrap().shapes().to_vec();
        for dot in map.dots() {
            let pixel = pixel_at(&map, *dot);
            assert!(point_at(&map, pixel).distance(*dot) < 1e-9);
            assert!(dots.iter().any(|shape| matches!(shape, Shape::Dot { at, .. } if *at == pixel)));
        }
    }

    #[test]
    fn steps_of_iso_lines_are_round() {
        assert_eq!([0.013, 0.3, 4.0, 80.0].map(round_step), [0.01, 0.2, 5.0, 100.0]);
    }

    #[test]
    fn the_grid_spans_the_dots_from_the_upper_left() {
        let map = BlendMap::new(fifteen(), Settings::default()).unwrap();
        let points = grid_points(&map, 3, 2);
        assert_eq!(points.len(), 6);
        assert!(points[0].x < points[1].x && points[0].y > points[3].y);
        let most = map.dots().iter().map(|d| d.x).fold(f64::NEG_INFINITY, f64::max);
        assert_eq!(points[2].x, most);
    }
}
