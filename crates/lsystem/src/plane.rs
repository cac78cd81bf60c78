//! The drawing of a string in the plane, as SVG.

use crate::program::Command;
use crate::syntax::Dialect;
use crate::system::Derived;
use crate::turtle::{GrowFault, Pen, Steps, is_beyond};
use glam::{DVec2, DVec3};
use std::fmt::Write as _;

/// The longer side of the drawing, in its own units.
const SIDE: f64 = 1000.0;
/// Space around the drawing as a part of its longer side.
const MARGIN: f64 = 0.03;
/// The thinnest line as a part of the longer side.
const HAIRLINE: f64 = 0.001;
/// Most corners of all lines together.
const MAX_CORNERS: usize = 5_000_000;

/// Lines of one width, or a filled polygon.
struct Shape {
    points: Vec<DVec2>,
    /// `None` for polygons.
    width: Option<f64>,
}

impl Derived<'_> {
    /// The turtle's drawing seen from the front, x to the right and z up: lines where it draws,
    /// polygons filled. Straight lines, as the book draws them.
    ///
    /// # Errors
    /// [`GrowFault::NothingDrawn`], [`GrowFault::NotFinite`], and [`GrowFault::Knots`] for more than five
    /// million corners.
    pub fn to_svg(&self) -> Result<String, GrowFault> {
        let shapes = self.shapes()?;
        let points = || shapes.iter().flat_map(|shape| &shape.points);
        let (low, high) =
            points().fold((DVec2::MAX, DVec2::MIN), |(low, high), &p| (low.min(p), high.max(p)));
        let extent = (high - low).max_element();
        // Also where there are no points, whose extent is negative.
        if extent <= 0.0 {
            return Err(GrowFault::NothingDrawn);
        }
        let (factor, margin) = (SIDE / extent, SIDE * MARGIN);
        if shapes.iter().any(|shape| !(shape.width.unwrap_or(0.0) * factor).is_finite()) {
            return Err(GrowFault::NotFinite);
        }
        let size = (high - low) * factor + 2.0 * margin;
        let place = |p: &DVec2| {
            // Adding 0 leaves no minus sign on a 0.
            let x = ((p.x - low.x) * factor + margin).max(0.0) + 0.0;
            let y = ((high.y - p.y) * factor + margin).max(0.0) + 0.0;
            (x, y)
        };
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.1} {:.1}\" fill=\"none\" \
             stroke=\"#2b2b2b\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
            size.x, size.y
        );
        for shape in &shapes {
            svg.push_str("<path d=\"");
            for (i, point) in shape.points.iter().enumerate() {
                let (x, y) = place(point);
                // Writing to a string cannot fail.
                let _ = write!(svg, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
            }
            let _ = match shape.width {
                Some(width) => {
                    writeln!(svg, "\" stroke-width=\"{:.1}\"/>", (width * factor).max(SIDE * HAIRLINE))
                }
                None => writeln!(svg, "Z\" fill=\"#6f973c\" stroke=\"none\"/>"),
            };
        }
        svg.push_str("</svg>\n");
        Ok(svg)
    }

    fn shapes(&self) -> Result<Vec<Shape>, GrowFault> {
        let steps = Steps::new(self.header());
        let mut pen = Pen::new(self.header());
        let (mut stack, mut polygons, mut shapes): (Vec<Pen>, Vec<Vec<DVec3>>, Vec<Shape>) =
            (Vec::new(), Vec::new(), Vec::new());
        let mut corners = 0;
        let dialect = self.system.program.dialect;
        for (kind, values) in self.modules.iter(&self.system.program.kinds) {
            match kind.command {
                Command::Open => {
                    stack.push(pen);
                    pen.width *= steps.branch_thinning;
                }
                Command::Close => pen = stack.pop().unwrap_or(pen),
                Command::Forward | Command::Move => {
                    let draws = kind.command == Command::Forward;
                    if draws && dialect == Dialect::Hewitt {
                        pen.bend(dialect, &steps);
                    }
                    let from = pen.turtle.position;
                    let length = pen.length(values, &steps);
                    pen.turtle.walk(length);
                    if draws {
                        let width = 2.0 * pen.radius(&steps);
                        corners += line(&mut shapes, flat(from), flat(pen.turtle.position), width);
                    }
                    if let Some(polygon) = polygons.last_mut() {
                        polygon.push(pen.turtle.position);
                    }
                    if draws && dialect == Dialect::Abop {
                        pen.bend(dialect, &steps);
                    }
                }
                Command::OpenPolygon => polygons.push(vec![pen.turtle.position]),
                Command::Vertex => polygons.last_mut().into_iter().for_each(|p| p.push(pen.turtle.position)),
                Command::ClosePolygon => {
                    let points: Vec<DVec2> =
                        polygons.pop().unwrap_or_default().into_iter().map(flat).collect();
                    corners += points.len();
                    shapes.push(Shape { points, width: None });
                }
                command => pen.obey(command, values, &steps),
            }
            if is_beyond(pen.turtle.position) {
                return Err(GrowFault::NotFinite);
            }
            if corners > MAX_CORNERS {
                return Err(GrowFault::Knots);
            }
        }
        if shapes.is_empty() { Err(GrowFault::NothingDrawn) } else { Ok(shapes) }
    }
}

const fn flat(point: DVec3) -> DVec2 {
    DVec2::new(point.x, point.z)
}

/// Draws a line, on from the last one where that ends there; returns the corners that were added.
fn line(shapes: &mut Vec<Shape>, from: DVec2, to: DVec2, width: f64) -> usize {
    match shapes.last_mut() {
        Some(Shape { points, width: Some(last) }) if *last == width && points.last() == Some(&from) => {
            points.push(to);
            1
        }
        _ => {
            shapes.push(Shape { points: vec![from, to], width: Some(width) });
            2
        }
    }
}
