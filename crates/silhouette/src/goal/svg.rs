//! Drawings in SVG, painted as they are loaded.
//!
//! The crate `usvg` reads them: styles, `use`, units and shapes become paths with a fill and a stroke, which `tiny-skia`
//! paints. What has no clear edge to find a tree by is refused or left out: filters, masks and patterns are errors, text
//! and pictures within a drawing are not painted, and a gradient is the colour in its middle. Nothing outside of the file is
//! looked at.

use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder as _};
use tiny_skia::{FillRule, Mask, Paint, Path, Pixmap, Point, Transform};
use usvg::{Group, ImageHrefResolver, Node, Options, Tree};

/// The longer side of the picture, in pixels: four times that of goals by default.
const SIDE: f32 = 1024.0;
/// Pixels that the boxes of all paths may have together: some seconds of painting.
const MAX_PAINTED: f64 = 1e10;
/// Rows that the segments of one path may cross together, and those of all paths: all segments that cross a row are sorted.
const MAX_CROSSED: [f64; 2] = [2e6, 1e8];
/// Bytes of a drawing: reading takes a hundred times as much memory.
const MAX_DRAWING: usize = 1 << 22;
/// Memory for reading nested groups, of which there may be a thousand.
const STACK: usize = 1 << 28;

/// The drawing as a PNG file, transparent where nothing is painted.
///
/// # Errors
/// What is wrong with it, or why it is not painted.
pub(super) fn painted(bytes: &[u8]) -> Result<Vec<u8>, String> {
    if bytes.len() > MAX_DRAWING {
        return Err(format!("it has {} bytes, and at most {MAX_DRAWING} are read", bytes.len()));
    }
    std::thread::scope(|scope| {
        let painter = std::thread::Builder::new().stack_size(STACK);
        let painter = painter.spawn_scoped(scope, || paint(bytes)).map_err(|error| error.to_string())?;
        painter.join().unwrap_or_else(|_| Err("it cannot be painted".to_owned()))
    })
}

fn paint(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let options = Options {
        image_href_resolver: ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..Options::default()
    };
    let tree = Tree::from_data(bytes, &options).map_err(|error| error.to_string())?;
    let size = tree.size();
    let scale = SIDE / size.width().max(size.height());
    let side = |length: f32| (length * scale).round().max(1.0) as u32;
    let (width, height) = (side(size.width()), side(size.height()));
    let pixmap = Pixmap::new(width, height).ok_or("it has no size")?;
    let mut painter =
        Painter { pixmap, scale: Transform::from_scale(scale, scale), painted: 0.0, crossed: 0.0 };
    painter.group(tree.root(), 1.0, None)?;

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
    fn group(&mut self, group: &Group, opacity: f32, clip: Option<&Mask>) -> Result<(), String> {
        if !group.filters().is_empty() {
            return Err("it has a filter, such as a blur or a shadow, which is not read".to_owned());
        }
        if group.mask().is_some() {
            return Err("it has a mask, which is not read".to_owned());
        }
        let opacity = opacity * group.opacity().get();
        let own = group.clip_path().map(|path| self.clip(path, group.abs_transform(), clip)).transpose()?;
        let clip = own.as_ref().or(clip);
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, opacity, clip)?,
                Node::Path(path) if path.is_visible() => self.path(path, opacity, clip)?,
                Node::Path(_) | Node::Image(_) | Node::Text(_) => {}
            }
        }
        Ok(())
    }

    fn path(&mut self, path: &usvg::Path, opacity: f32, clip: Option<&Mask>) -> Result<(), String> {
        self.count(path)?;
        let transform = path.abs_transform().post_concat(self.scale);
        if let Some(fill) = path.fill() {
            let paint = paint_of(fill.paint(), opacity * fill.opacity().get())?;
            self.pixmap.fill_path(path.data(), &paint, rule_of(fill.rule()), transform, clip);
        }
        if let Some(stroke) = path.stroke() {
            let paint = paint_of(stroke.paint(), opacity * stroke.opacity().get())?;
            self.pixmap.stroke_path(path.data(), &paint, &stroke.to_tiny_skia(), transform, clip);
        }
        Ok(())
    }

    /// What a clip path leaves of `within`, or of the picture.
    fn clip(&mut self, clip: &usvg::ClipPath, on: Transform, within: Option<&Mask>) -> Result<Mask, String> {
        let (width, height) = (self.pixmap.width(), self.pixmap.height());
        // The union of its shapes.
        let mut shapes = Pixmap::new(width, height).ok_or("it has no size")?;
        let transform = on.pre_concat(clip.transform()).post_concat(self.scale);
        self.shapes(clip.root(), &mut shapes, transform)?;
        let mut mask = Mask::from_pixmap(shapes.as_ref(), tiny_skia::MaskType::Alpha);
        let other = clip.clip_path().map(|clip| self.clip(clip, on, None)).transpose()?;
        for other in other.as_ref().into_iter().chain(within) {
            for (one, other) in mask.data_mut().iter_mut().zip(other.data()) {
                *one = (*one).min(*other);
            }
        }
        Ok(mask)
    }

    fn shapes(&mut self, group: &Group, onto: &mut Pixmap, transform: Transform) -> Result<(), String> {
        let transform = transform.pre_concat(group.transform());
        for node in group.children() {
            match node {
                Node::Group(group) => self.shapes(group, onto, transform)?,
                Node::Path(path) => {
                    self.count(path)?;
                    let rule = path.fill().map_or(FillRule::Winding, |fill| rule_of(fill.rule()));
                    fill_black(onto, path.data(), rule, transform);
                }
                Node::Image(_) | Node::Text(_) => {}
            }
        }
        Ok(())
    }

    /// Counts what it takes to paint a path.
    fn count(&mut self, path: &usvg::Path) -> Result<(), String> {
        let of = path.abs_stroke_bounding_box();
        let part = |length: f32, side: u32| f64::from((length * self.scale.sx).clamp(1.0, side as f32));
        let high = part(of.height(), self.pixmap.height());
        self.painted += part(of.width(), self.pixmap.width()) * high;
        let crossed = self.rows_crossed(path);
        self.crossed += crossed;
        let [of_one, of_all] = MAX_CROSSED;
        if self.painted > MAX_PAINTED || self.crossed > of_all {
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
        let mut points = path.data().points().to_vec();
        path.abs_transform().post_concat(self.scale).map_points(&mut points);
        // A point beyond the picture stands for the edge.
        let row = |point: &Point| f64::from(point.y.clamp(0.0, self.pixmap.height() as f32));
        let rows: f64 = points.windows(2).map(|two| (row(&two[0]) - row(&two[1])).abs()).sum();
        // Both sides of a stroke, and its joins.
        if path.stroke().is_some() { 3.0 * rows } else { rows }
    }
}

fn fill_black(onto: &mut Pixmap, path: &Path, rule: FillRule, transform: Transform) {
    onto.fill_path(path, &Paint { anti_alias: true, ..Paint::default() }, rule, transform, None);
}

const fn rule_of(rule: usvg::FillRule) -> FillRule {
    match rule {
        usvg::FillRule::NonZero => FillRule::Winding,
        usvg::FillRule::EvenOdd => FillRule::EvenOdd,
    }
}

fn paint_of(paint: &usvg::Paint, opacity: f32) -> Result<Paint<'static>, String> {
    // A tree is found by its shape: the colour in the middle stands for all of a gradient.
    let middle = |stops: &[usvg::Stop]| {
        let stop = stops.get(stops.len() / 2);
        stop.map_or((usvg::Color::black(), 0.0), |stop| (stop.color(), stop.opacity().get()))
    };
    let (color, own) = match paint {
        usvg::Paint::Color(color) => (*color, 1.0),
        usvg::Paint::LinearGradient(gradient) => middle(gradient.stops()),
        usvg::Paint::RadialGradient(gradient) => middle(gradient.stops()),
        usvg::Paint::Pattern(_) => return Err("it has a pattern, which is not read".to_owned()),
    };
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    let alpha = (opacity * own * 255.0).round().clamp(0.0, 255.0) as u8;
    paint.set_color_rgba8(color.red, color.green, color.blue, alpha);
    Ok(paint)
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
    fn shapes_strokes_styles_and_clips_are_painted() {
        let picture = pixels(
            "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' width='4cm' height='2cm' viewBox='0 0 40 20'>
            <style>.leaf { fill: rgb(0, 128, 0) }</style>
            <defs><clipPath id='left'><rect width='5' height='20'/></clipPath><g id='one'><circle class='leaf' r='2'/></g></defs>
            <use xlink:href='#one' x='20' y='10'/>
            <path d='M 0 0 L 10 0' stroke='red' stroke-width='4' fill='none'/>
            <rect x='0' y='10' width='10' height='10' clip-path='url(#left)' opacity='0.5'/></svg>",
        );
        assert_eq!(picture.dimensions(), (1024, 512));
        let at = |x: f32, y: f32| picture.get_pixel((x * 25.6) as u32, (y * 25.6) as u32).0;
        assert_eq!((at(20.0, 10.0), at(23.0, 10.0)), ([0, 128, 0, 255], [0; 4]));
        assert_eq!((at(5.0, 1.0), at(5.0, 3.0)), ([255, 0, 0, 255], [0; 4]));
        assert_eq!((at(2.0, 15.0)[3], at(7.0, 15.0)[3]), (128, 0));
    }

    #[test]
    fn what_is_not_read_says_so() {
        assert!(refused("<filter id='f'><feGaussianBlur stdDeviation='2'/></filter><rect width='9' height='9' filter='url(#f)'/>").contains("filter"));
        assert!(refused("<mask id='m'><rect width='5' height='5' fill='white'/></mask><rect width='9' height='9' mask='url(#m)'/>").contains("mask"));
        assert!(refused("<pattern id='p' width='1' height='1'><rect width='.1' height='.1'/></pattern><rect width='9' height='9' fill='url(#p)'/>").contains("pattern"));
        assert!(refused("<rect").contains("data"), "{}", refused("<rect"));
        assert!(painted(b"<?xml version='1.0'?><html/>").is_err());
        assert!(painted(b"\xff\xfe<svg/>").is_err());
    }

    #[test]
    fn hostile_drawings_end_soon() {
        // Ten levels of ten: too many elements.
        let laughs: String = (0..10)
            .map(|i| format!("<g id='a{}'>{}</g>", i + 1, format!("<use href='#a{i}'/>").repeat(10)))
            .collect();
        let defs = format!("<defs><rect id='a0' width='9' height='9'/>{laughs}</defs><use href='#a10'/>");
        assert!(!refused(&defs).is_empty());
        assert!(painted(&vec![b' '; MAX_DRAWING + 1]).unwrap_err().contains("at most"));
        let twelve_thousand = "<rect width='10' height='10'/>".repeat(12_000);
        assert!(refused(&twelve_thousand).contains("too often"));
        let nested =
            format!("{}<rect width='9' height='9'/>{}", "<g opacity='.99'>".repeat(900), "</g>".repeat(900));
        let svg = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'>{nested}</svg>");
        assert!(painted(svg.as_bytes()).is_ok());
        let looped = "<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>";
        let svg = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'>{looped}<rect width='9' height='9'/></svg>"
        );
        let _ = painted(svg.as_bytes()).unwrap_err();
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
