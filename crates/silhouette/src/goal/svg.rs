//! Drawings in SVG, painted as they are loaded.
//!
//! The crate `usvg` reads them: styles, `use`, units and shapes become paths with a fill and a stroke, which `tiny-skia`
//! paints. [`super::svg_bounds`] refuses before that what has no clear edge to find a tree by, or what may take any time.
//! Text and pictures within a drawing are not painted, a gradient is the colour in its middle, and a dashed line is whole.
//! Nothing outside of the file is looked at.

use super::svg_bounds;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder as _};
use tiny_skia::{FillRule, Paint, Pixmap, Point, Stroke, Transform};
use usvg::roxmltree::{Document, ParsingOptions};
use usvg::{Group, ImageHrefResolver, Node, Options, Tree};

/// The longer side of the picture, in pixels: four times that of goals by default.
const SIDE: f32 = 1024.0;
/// Pixels that the boxes of all paths may have together: some seconds of painting.
const MAX_PAINTED: f64 = 1e10;
/// Rows that the segments of one path may cross together, and those of all paths: all segments that cross a row are
/// sorted.
const MAX_CROSSED: [f64; 2] = [2e6, 1e8];
/// Memory for reading nested groups.
const STACK: usize = 1 << 28;

/// The drawing as a PNG file, transparent where nothing is painted.
///
/// # Errors
/// What is wrong with it, or why it is not painted.
pub(super) fn painted(bytes: &[u8]) -> Result<Vec<u8>, String> {
    std::thread::scope(|scope| {
        let painter = std::thread::Builder::new().stack_size(STACK);
        let painter = painter.spawn_scoped(scope, || paint(bytes)).map_err(|error| error.to_string())?;
        painter.join().unwrap_or_else(|_| Err("it cannot be painted".to_owned()))
    })
}

fn paint(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let text = svg_bounds::text(bytes)?;
    // Illustrator declares entities for names.
    let document =
        Document::parse_with_options(text, ParsingOptions { allow_dtd: true, ..Default::default() });
    let document = document.map_err(|error| error.to_string())?;
    svg_bounds::check(&document)?;
    let options = Options {
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    };
    let tree = Tree::from_xmltree(&document, &options).map_err(|error| error.to_string())?;
    let size = tree.size();
    let scale = SIDE / size.width().max(size.height());
    let side = |length: f32| (length * scale).round().max(1.0) as u32;
    let (width, height) = (side(size.width()), side(size.height()));
    let pixmap = Pixmap::new(width, height).ok_or("it has no size")?;
    let mut painter =
        Painter { pixmap, scale: Transform::from_scale(scale, scale), painted: 0.0, crossed: 0.0 };
    painter.count_group(tree.root())?;
    painter.group(tree.root(), 1.0);

    let straight: Vec<u8> = painter
        .pixmap
        .pixels()
        .iter()
        .flat_map(|pixel| {
            let color = pixel.demultiply();
            [color.red(), color.green(), color.blue(), color.alpha()]
        })
        .collect();
    let mut png = Vec::new();
    PngEncoder::new(&mut png)
        .write_image(&straight, width, height, ExtendedColorType::Rgba8)
        .map_err(|error| error.to_string())?;
    Ok(png)
}

struct Painter {
    pixmap: Pixmap,
    scale: Transform,
    /// Pixels of the boxes of all paths so far.
    painted: f64,
    /// Rows that their segments cross.
    crossed: f64,
}

impl Painter {
    fn group(&mut self, group: &Group, opacity: f32) {
        let opacity = opacity * group.opacity().get();
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, opacity),
                Node::Path(path) if path.is_visible() => self.path(path, opacity),
                Node::Path(_) | Node::Image(_) | Node::Text(_) => {}
            }
        }
    }

    fn path(&mut self, path: &usvg::Path, opacity: f32) {
        let transform = self.transform(path);
        if let Some(fill) = path.fill() {
            let paint = paint_of(fill.paint(), opacity * fill.opacity().get());
            self.pixmap.fill_path(path.data(), &paint, rule_of(fill.rule()), transform, None);
        }
        if let Some(stroke) = path.stroke() {
            let paint = paint_of(stroke.paint(), opacity * stroke.opacity().get());
            let stroke = Stroke { dash: None, ..stroke.to_tiny_skia() };
            self.pixmap.stroke_path(path.data(), &paint, &stroke, transform, None);
        }
    }

    fn transform(&self, path: &usvg::Path) -> Transform {
        path.abs_transform().post_concat(self.scale)
    }

    /// Counts what it takes to paint a group, before anything is painted.
    fn count_group(&mut self, group: &Group) -> Result<(), String> {
        group.children().iter().try_for_each(|node| match node {
            Node::Group(group) => self.count_group(group),
            Node::Path(path) if path.is_visible() => self.count(path),
            Node::Path(_) | Node::Image(_) | Node::Text(_) => Ok(()),
        })
    }

    fn count(&mut self, path: &usvg::Path) -> Result<(), String> {
        let of = path.abs_stroke_bounding_box();
        let part = |length: f32, side: u32| f64::from((length * self.scale.sx).clamp(1.0, side as f32));
        self.painted += part(of.width(), self.pixmap.width()) * part(of.height(), self.pixmap.height());
        let crossed = self.rows_crossed(path);
        self.crossed += crossed;
        let [of_one, of_all] = MAX_CROSSED;
        // What is not a number is too much as well.
        if !(self.painted <= MAX_PAINTED && self.crossed <= of_all) {
            return Err("its shapes lie on each other too often to be painted in a few seconds".to_owned());
        }
        if crossed > of_one {
            return Err(
                "it has a path that goes up and down too often to be painted in a few seconds".to_owned()
            );
        }
        Ok(())
    }

    /// Rows that the segments of a path cross, by their control points.
    fn rows_crossed(&self, path: &usvg::Path) -> f64 {
        let transform = self.transform(path);
        let mut points = path.data().points().to_vec();
        transform.map_points(&mut points);
        // A point beyond the picture stands for the edge.
        let high = self.pixmap.height() as f32;
        let row = |point: &Point| f64::from(point.y.clamp(0.0, high));
        let rows: f64 = points.windows(2).map(|two| (row(&two[0]) - row(&two[1])).abs()).sum();
        let Some(stroke) = path.stroke() else { return rows };
        // Both sides of a stroke, and joins and caps as high as it is wide at each point.
        let wide = stroke.width().get() * transform.get_scale().1.max(transform.get_scale().0);
        3.0 * rows + points.len() as f64 * f64::from((2.0 * wide).min(high))
    }
}

const fn rule_of(rule: usvg::FillRule) -> FillRule {
    match rule {
        usvg::FillRule::NonZero => FillRule::Winding,
        usvg::FillRule::EvenOdd => FillRule::EvenOdd,
    }
}

fn paint_of(paint: &usvg::Paint, opacity: f32) -> Paint<'static> {
    // A tree is found by its shape: the colour in the middle stands for all of a gradient.
    let middle = |stops: &[usvg::Stop]| {
        let stop = stops.get(stops.len() / 2);
        stop.map_or((usvg::Color::black(), 0.0), |stop| (stop.color(), stop.opacity().get()))
    };
    let (color, own) = match paint {
        usvg::Paint::Color(color) => (*color, 1.0),
        usvg::Paint::LinearGradient(gradient) => middle(gradient.stops()),
        usvg::Paint::RadialGradient(gradient) => middle(gradient.stops()),
        // There are none: they are refused.
        usvg::Paint::Pattern(_) => (usvg::Color::black(), 0.0),
    };
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    let alpha = (opacity * own * 255.0).round().clamp(0.0, 255.0) as u8;
    paint.set_color_rgba8(color.red, color.green, color.blue, alpha);
    paint
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(svg: &str) -> image::RgbaImage {
        image::load_from_memory(&painted(svg.as_bytes()).unwrap()).unwrap().to_rgba8()
    }

    fn refused(inner: &str) -> String {
        let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'>{inner}</svg>");
        painted(svg.as_bytes()).unwrap_err()
    }

    #[test]
    fn shapes_strokes_and_styles_are_painted() {
        let picture = pixels(
            "<!DOCTYPE svg [<!ENTITY ns 'http://www.w3.org/2000/svg'>]><svg xmlns='&ns;' xmlns:xlink='http://www.w3.org/1999/xlink' width='4cm' height='2cm' viewBox='0 0 40 20'>
            <style>.leaf { fill: rgb(0, 128, 0) }</style>
            <defs><g id='one'><circle class='leaf' r='2'/></g>
            <linearGradient id='all'><stop stop-color='red'/><stop offset='1' stop-color='blue'/></linearGradient></defs>
            <use xlink:href='#one' x='20' y='10'/>
            <path d='M 0 0 L 10 0' stroke='red' stroke-width='4' stroke-dasharray='1' fill='none'/>
            <rect x='0' y='10' width='10' height='10' opacity='0.5'/><rect x='30' width='9' height='9' fill='url(#all)'/></svg>",
        );
        assert_eq!(picture.dimensions(), (1024, 512));
        let at = |x: f32, y: f32| picture.get_pixel((x * 25.6) as u32, (y * 25.6) as u32).0;
        assert_eq!((at(20.0, 10.0), at(23.0, 10.0)), ([0, 128, 0, 255], [0; 4]));
        let dashes = [4.5, 5.5].map(|x| at(x, 1.0));
        assert_eq!((dashes, at(5.0, 3.0)), ([[255, 0, 0, 255]; 2], [0; 4]));
        assert_eq!((at(7.0, 15.0)[3], at(33.0, 5.0)[3]), (128, 255));
    }

    #[test]
    fn what_is_not_read_says_so() {
        for (name, inner) in [
            ("filter", "<filter id='a'><feGaussianBlur stdDeviation='2'/></filter>"),
            ("mask", "<mask id='a'><rect width='5' height='5'/></mask>"),
            ("pattern", "<pattern id='a' width='1' height='1'><rect width='.1' height='.1'/></pattern>"),
            ("clipPath", "<clipPath id='a'><rect width='.1' height='.1'/></clipPath>"),
            ("marker", "<marker id='a'><rect width='.1' height='.1'/></marker>"),
        ] {
            let said = refused(&format!("{inner}<rect width='9' height='9'/>"));
            assert!(said.contains(name), "{name}: {said}");
        }
        assert!(!refused("<rect").is_empty());
        assert!(painted(b"<?xml version='1.0'?><html/>").is_err());
        assert!(painted(b"\xff\xfe<svg/>").unwrap_err().contains("UTF-8"));
    }

    #[test]
    fn hostile_drawings_end_soon() {
        let whole = |inner: &str| {
            format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'>{inner}</svg>")
        };
        // Ten levels of ten.
        let laughs: String = (0..10)
            .map(|i| format!("<g id='a{}'>{}</g>", i + 1, format!("<use href='#a{i}'/>").repeat(10)))
            .collect();
        let defs = format!("<defs><rect id='a0' width='9' height='9'/>{laughs}</defs><use href='#a10'/>");
        assert!(refused(&defs).contains("shapes"));
        for ring in [
            "<g id='a'><use href='#a'/></g>",
            "<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>",
            "<g id='a'><use href='#b'/></g><g id='b'><use href='#c'/></g><g id='c'><use href='#a'/></g>",
        ] {
            assert!(refused(ring).contains("nested"), "{ring}");
        }
        let entity = format!("<!DOCTYPE svg [<!ENTITY a '{}'>]>", "x".repeat(4000));
        let many = entity + &whole(&"<g id='&a;'/>".repeat(9000));
        assert!(painted(many.as_bytes()).unwrap_err().contains("entities"));
        let gradients = ["ab", "bc", "ca"].map(|ids| {
            let (id, of) = ids.split_at(1);
            format!("<linearGradient id='{id}' href='#{of}'/>")
        });
        let _ =
            painted(whole(&(gradients.concat() + "<rect width='9' height='9' fill='url(#a)'/>")).as_bytes());
        assert!(refused(&"<rect width='10' height='10'/>".repeat(12_000)).contains("too often"));
        let zigzag = format!("<path d='M 0 0{}'/>", " L 9 9 L 0 1".repeat(4000));
        assert!(refused(&zigzag).contains("up and down"));
        let wide = format!(
            "<path fill='none' stroke='red' stroke-width='9' d='M 0 0{}'/>",
            " h .1 h -.1".repeat(4000)
        );
        assert!(refused(&wide).contains("up and down"));
        let dashes =
            "<path d='M0 5H10' stroke='red' stroke-width='10' stroke-dasharray='.00001'/>".repeat(50);
        assert!(painted(whole(&dashes).as_bytes()).is_ok(), "lines are whole");
        let nested = |depth: usize| {
            format!(
                "{}<rect width='9' height='9'/>{}",
                "<g opacity='.99'>".repeat(depth),
                "</g>".repeat(depth)
            )
        };
        assert!(painted(whole(&nested(400)).as_bytes()).is_ok());
        assert!(refused(&nested(100_000)).contains("nested"));
        let _ =
            painted(whole("<g transform='scale(1e30)'><rect width='1e30' height='1e30'/></g>").as_bytes());
    }

    #[test]
    fn nothing_outside_of_the_file_is_read() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("photo.png");
        image::RgbaImage::from_pixel(8, 8, image::Rgba([1, 2, 3, 255])).save(&file).unwrap();
        let svg = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'><image href='{}' width='10' height='10'/></svg>",
            file.display()
        );
        assert!(pixels(&svg).pixels().all(|pixel| pixel.0[3] == 0));
    }
}
