//! A picture as a list of shapes, which becomes pixels or SVG.

use super::font::Font;
use pleach_silhouette::Bitmap;
use std::fmt::Write as _;
use tiny_skia::{FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, StrokeDash, Transform};

/// Red, green, blue and opacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Color {
    /// Red, green, blue.
    pub rgb: [u8; 3],
    /// 0 for nothing, 1 for opaque.
    pub opacity: f32,
}

impl Color {
    /// Opaque.
    #[must_use]
    pub const fn opaque(rgb: [u8; 3]) -> Self {
        Self { rgb, opacity: 1.0 }
    }

    fn paint(self) -> Paint<'static> {
        let [r, g, b] = self.rgb;
        let mut paint = Paint::default();
        paint.set_color_rgba8(r, g, b, (self.opacity * 255.0).round() as u8);
        paint.anti_alias = true;
        paint
    }

    fn svg(self) -> String {
        let [r, g, b] = self.rgb;
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

/// Where a text stands relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The point is at its left end.
    Start,
    /// The point is in its middle.
    Middle,
    /// The point is at its right end.
    End,
}

/// A shape. Pixels, x to the right and y down.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A filled polygon.
    Polygon {
        /// Its corners.
        corners: Vec<(f64, f64)>,
        /// Its colour.
        fill: Color,
    },
    /// A line through points.
    Line {
        /// The points.
        points: Vec<(f64, f64)>,
        /// Its colour.
        color: Color,
        /// Its width.
        width: f64,
        /// Lengths of dash and gap, for a dashed line.
        dash: Option<(f64, f64)>,
    },
    /// A filled circle.
    Dot {
        /// Its middle.
        at: (f64, f64),
        /// Its radius.
        radius: f64,
        /// Its colour.
        fill: Color,
    },
    /// A line of text on a halo of white.
    Text {
        /// The text.
        text: String,
        /// The point of its baseline that `anchor` names.
        at: (f64, f64),
        /// Pixels to the em.
        size: f64,
        /// Where the point is in the text.
        anchor: Anchor,
        /// Its colour.
        color: Color,
    },
    /// A silhouette in black at its own size, transparent where there is no ink.
    Silhouette {
        /// The silhouette.
        bitmap: Bitmap,
        /// Its upper left corner.
        at: (f64, f64),
    },
}

/// A white page with shapes, drawn in order.
pub struct Scene {
    width: u32,
    height: u32,
    shapes: Vec<Shape>,
    font: Font,
}

impl std::fmt::Debug for Scene {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { width, height, shapes, .. } = self;
        f.debug_struct("Scene").field("width", width).field("height", height).field("shapes", shapes).finish()
    }
}

impl Scene {
    /// An empty page of this many pixels.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, shapes: Vec::new(), font: Font::new() }
    }

    /// Adds a shape on top.
    pub fn add(&mut self, shape: Shape) {
        self.shapes.push(shape);
    }

    /// The shapes from bottom to top.
    #[must_use]
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// Width in pixels of a line of text.
    #[must_use]
    pub fn text_width(&self, text: &str, size: f64) -> f64 {
        self.font.width(text, size)
    }

    /// The picture as a PNG file; `None` for a page without pixels or too large for memory.
    #[must_use]
    pub fn to_png(&self) -> Option<Vec<u8>> {
        let mut page = Pixmap::new(self.width, self.height)?;
        page.fill(tiny_skia::Color::WHITE);
        for shape in &self.shapes {
            self.draw(shape, &mut page);
        }
        page.encode_png().ok()
    }

    fn draw(&self, shape: &Shape, page: &mut Pixmap) {
        let still = Transform::identity();
        match shape {
            Shape::Polygon { corners, fill } => {
                if let Some(path) = path(corners, true) {
                    page.fill_path(&path, &fill.paint(), FillRule::Winding, still, None);
                }
            }
            Shape::Line { points, color, width, dash } => {
                let dash = dash.and_then(|(on, off)| StrokeDash::new(vec![on as f32, off as f32], 0.0));
                let width = *width as f32;
                let stroke = Stroke {
                    width,
                    dash,
                    line_cap: LineCap::Round,
                    line_join: LineJoin::Round,
                    ..Stroke::default()
                };
                if let Some(path) = path(points, false) {
                    page.stroke_path(&path, &color.paint(), &stroke, still, None);
                }
            }
            Shape::Dot { at, radius, fill } => {
                if let Some(path) = PathBuilder::from_circle(at.0 as f32, at.1 as f32, *radius as f32) {
                    page.fill_path(&path, &fill.paint(), FillRule::Winding, still, None);
                }
            }
            Shape::Text { text, at, size, anchor, color } => {
                let left = at.0 - self.shift(text, *size, *anchor);
                if let Some(path) = self.font.outline(text, *size, left, at.1) {
                    let halo = Stroke { width: HALO, line_join: LineJoin::Round, ..Stroke::default() };
                    let white = Color { rgb: [255; 3], opacity: HALO_OPACITY };
                    page.stroke_path(&path, &white.paint(), &halo, still, None);
                    page.fill_path(&path, &color.paint(), FillRule::Winding, still, None);
                }
            }
            Shape::Silhouette { bitmap, at } => {
                let (x0, y0) = (at.0.round() as i64, at.1.round() as i64);
                let (width, height) = (i64::from(self.width), i64::from(self.height));
                let black = tiny_skia::PremultipliedColorU8::from_rgba(20, 20, 20, 255);
                for y in 0..bitmap.height() {
                    for x in bitmap.ink_in_row(y) {
                        let (px, py) = (x0 + i64::from(x), y0 + i64::from(y));
                        let inside = (0..width).contains(&px) && (0..height).contains(&py);
                        if let Some(black) = black.filter(|_| inside) {
                            page.pixels_mut()[(py * width + px) as usize] = black;
                        }
                    }
                }
            }
        }
    }

    fn shift(&self, text: &str, size: f64, anchor: Anchor) -> f64 {
        match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => self.text_width(text, size) / 2.0,
            Anchor::End => self.text_width(text, size),
        }
    }

    /// The picture as SVG text; silhouettes are embedded, letters are text that can be selected.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let (width, height) = (self.width, self.height);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
        );
        for shape in &self.shapes {
            // Writing to a string cannot fail.
            let _ = writeln!(svg, "{}", element(shape));
        }
        svg.push_str("</svg>\n");
        svg
    }
}

/// Width of the white around letters, in pixels.
const HALO: f32 = 3.0;
const HALO_OPACITY: f32 = 0.85;

fn path(points: &[(f64, f64)], close: bool) -> Option<tiny_skia::Path> {
    let mut builder = PathBuilder::new();
    for (i, (x, y)) in points.iter().enumerate() {
        if i == 0 { builder.move_to(*x as f32, *y as f32) } else { builder.line_to(*x as f32, *y as f32) }
    }
    if close {
        builder.close();
    }
    builder.finish()
}

fn element(shape: &Shape) -> String {
    let list = |points: &[(f64, f64)]| {
        points.iter().map(|(x, y)| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
    };
    match shape {
        Shape::Polygon { corners, fill } => {
            let (points, color, opacity) = (list(corners), fill.svg(), fill.opacity);
            format!("<polygon points=\"{points}\" fill=\"{color}\" fill-opacity=\"{opacity}\"/>")
        }
        Shape::Line { points, color, width, dash } => {
            let dash = dash.map_or_else(String::new, |(on, off)| format!(" stroke-dasharray=\"{on} {off}\""));
            let (points, stroke, opacity) = (list(points), color.svg(), color.opacity);
            format!(
                "<polyline points=\"{points}\" fill=\"none\" stroke=\"{stroke}\" stroke-opacity=\"{opacity}\" \
                 stroke-width=\"{width}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"{dash}/>"
            )
        }
        Shape::Dot { at, radius, fill } => {
            format!("<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{radius}\" fill=\"{}\"/>", at.0, at.1, fill.svg())
        }
        Shape::Text { text, at, size, anchor, color } => {
            let anchor = match anchor {
                Anchor::Start => "start",
                Anchor::Middle => "middle",
                Anchor::End => "end",
            };
            format!(
                "<text x=\"{:.2}\" y=\"{:.2}\" font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{}\" \
                 stroke=\"#ffffff\" stroke-opacity=\"{HALO_OPACITY}\" stroke-width=\"{HALO}\" \
                 stroke-linejoin=\"round\" paint-order=\"stroke\">{}</text>",
                at.0,
                at.1,
                color.svg(),
                escaped(text)
            )
        }
        Shape::Silhouette { bitmap, at } => silhouette(bitmap, at.0.round(), at.1.round()),
    }
}

/// A silhouette as one path of runs of ink, each one pixel high.
fn silhouette(bitmap: &Bitmap, x: f64, y: f64) -> String {
    let mut runs = String::new();
    for row in 0..bitmap.height() {
        let mut ink = bitmap.ink_in_row(row).peekable();
        while let Some(start) = ink.next() {
            let mut end = start + 1;
            while ink.next_if_eq(&end).is_some() {
                end += 1;
            }
            let _ = write!(runs, "M{start} {row}h{}v1H{start}z", end - start);
        }
    }
    format!("<path transform=\"translate({x} {y})\" fill=\"#141414\" d=\"{runs}\"/>")
}

/// Text as it may stand in XML: markup escaped, and what XML 1.0 (§2.2) has no place for, such as most
/// control characters, replaced by U+FFFD.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' | '\r' => escaped.push(' '),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => escaped.push(char::REPLACEMENT_CHARACTER),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let mut scene = Scene::new(60, 40);
        scene.add(Shape::Polygon {
            corners: vec![(0.0, 0.0), (30.0, 0.0), (30.0, 40.0), (0.0, 40.0)],
            fill: Color::opaque([255, 0, 0]),
        });
        scene.add(Shape::Silhouette { bitmap: Bitmap::from_ascii("##.\n..#"), at: (40.0, 10.0) });
        let (text, color) = ("a < b".to_owned(), Color::opaque([0; 3]));
        scene.add(Shape::Text { text, at: (58.0, 38.0), size: 10.0, anchor: Anchor::End, color });
        scene
    }

    #[test]
    fn shapes_become_pixels() {
        let png = scene().to_png().unwrap();
        let page = Pixmap::decode_png(&png).unwrap();
        let at = |x: u32, y: u32| page.pixel(x, y).map(|p| [p.red(), p.green(), p.blue()]).unwrap();
        assert_eq!(at(10, 20), [255, 0, 0]);
        assert_eq!(at(35, 5), [255, 255, 255]);
        assert_eq!((at(40, 10), at(42, 10), at(42, 11)), ([20; 3], [255; 3], [20; 3]));
    }

    #[test]
    fn whatever_a_text_holds_the_svg_is_well_formed() {
        let mut scene = scene();
        let mut add = |text: String| {
            let color = Color::opaque([0; 3]);
            scene.add(Shape::Text { text, at: (5.0, 5.0), size: 10.0, anchor: Anchor::Start, color });
        };
        (0..0x300).chain(0xd7f0..0xe010).chain(0xfff0..0x1_0010).filter_map(char::from_u32).for_each(|c| {
            add(format!("a{c}b"));
        });
        add("]]> <!-- &#1; \u{1b}[31m".to_owned());
        let svg = scene.to_svg();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let texts = || document.descendants().filter(|node| node.has_tag_name("text")).map(|n| n.text());
        assert!(texts().any(|text| text == Some("a\u{fffd}b")));
        assert!(texts().any(|text| text == Some("]]> <!-- &#1; \u{fffd}[31m")));
        assert!(texts().all(|text| text.is_some_and(|text| !text.contains('\u{1}'))));
    }

    #[test]
    fn shapes_become_svg() {
        let svg = scene().to_svg();
        assert!(svg.contains(">a &lt; b</text>"), "{svg}");
        assert!(svg.contains("d=\"M0 0h2v1H0zM2 1h1v1H2z\""), "{svg}");
        assert!(svg.trim_end().ends_with("</svg>"));
    }
}
