//! Small plots as SVG: dots and lines on linear or logarithmic axes.

use std::fmt::Write as _;

/// How values become places along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scale {
    /// Evenly.
    Linear,
    /// By the logarithm.
    Log,
    /// A place for each series, named after it.
    Index,
}

/// Colours that most colour-blind eyes tell apart (Okabe and Ito 2008), then again with other dots.
const COLORS: [&str; 8] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000", "#8a8a00"];

struct Series {
    name: String,
    points: Vec<(f64, f64)>,
    line: bool,
    dashed: bool,
}

/// A plot under construction.
pub(super) struct Plot {
    x_label: String,
    y_label: String,
    x: Scale,
    y: Scale,
    series: Vec<Series>,
}

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 170.0;
const TOP: f64 = 16.0;
const BOTTOM: f64 = 50.0;

impl Plot {
    pub(super) fn new(x_label: &str, y_label: &str, x: Scale, y: Scale) -> Self {
        Self { x_label: x_label.to_owned(), y_label: y_label.to_owned(), x, y, series: Vec::new() }
    }

    pub(super) fn dots(&mut self, name: &str, points: &[(f64, f64)]) {
        self.series.push(Series {
            name: name.to_owned(),
            points: points.to_vec(),
            line: false,
            dashed: false,
        });
    }

    pub(super) fn line(&mut self, name: &str, points: &[(f64, f64)], dashed: bool) {
        self.series.push(Series { name: name.to_owned(), points: points.to_vec(), line: true, dashed });
    }

    /// The plot as an SVG document.
    pub(super) fn svg(&self) -> String {
        let x = Axis::new(
            self.x,
            self.series.iter().flat_map(|s| s.points.iter().map(|p| p.0)),
            LEFT,
            WIDTH - RIGHT,
        );
        let y = Axis::new(
            self.y,
            self.series.iter().flat_map(|s| s.points.iter().map(|p| p.1)),
            HEIGHT - BOTTOM,
            TOP,
        );
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" font-family=\"sans-serif\" font-size=\"12\">\n\
             <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n"
        );
        // Writing to a string cannot fail.
        let mut put = |text: String| {
            let _ = writeln!(svg, "{text}");
        };
        let (right, bottom) = (WIDTH - RIGHT, HEIGHT - BOTTOM);
        if self.x != Scale::Index {
            for tick in x.ticks() {
                let at = x.place(tick);
                put(format!("<path d=\"M{at:.1} {TOP}V{bottom}\" stroke=\"#ddd\"/>"));
                put(format!(
                    "<text x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                    bottom + 18.0,
                    label(tick)
                ));
            }
        }
        for tick in y.ticks() {
            let at = y.place(tick);
            put(format!("<path d=\"M{LEFT} {at:.1}H{right}\" stroke=\"#ddd\"/>"));
            put(format!(
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                LEFT - 6.0,
                at + 4.0,
                label(tick)
            ));
        }
        put(format!("<path d=\"M{LEFT} {TOP}V{bottom}H{right}\" fill=\"none\" stroke=\"black\"/>"));
        put(format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            (LEFT + right) / 2.0,
            HEIGHT - 12.0,
            self.x_label
        ));
        let middle = f64::midpoint(TOP, bottom);
        put(format!(
            "<text x=\"16\" y=\"{middle:.1}\" text-anchor=\"middle\" transform=\"rotate(-90 16 {middle:.1})\">{}</text>",
            self.y_label
        ));
        for (i, series) in self.series.iter().enumerate() {
            let color = COLORS[i % COLORS.len()];
            let hollow = i / COLORS.len() % 2 == 1;
            let fill = if hollow { "white" } else { color };
            let key = TOP + 8.0 + 17.0 * i as f64;
            if series.line {
                let path: Vec<String> = series
                    .points
                    .iter()
                    .map(|p| format!("{:.1} {:.1}", x.place(p.0), y.place(p.1)))
                    .collect();
                let dash = if series.dashed { " stroke-dasharray=\"5 4\"" } else { "" };
                put(format!(
                    "<path d=\"M{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.6\"{dash}/>",
                    path.join("L")
                ));
                put(format!(
                    "<path d=\"M{:.1} {key:.1}h18\" stroke=\"{color}\" stroke-width=\"1.6\"{dash}/>",
                    right + 12.0
                ));
            } else {
                for p in &series.points {
                    put(format!(
                        "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"2\" fill=\"{fill}\" stroke=\"{color}\" stroke-width=\"0.8\"/>",
                        x.place(p.0),
                        y.place(p.1)
                    ));
                }
                put(format!(
                    "<circle cx=\"{:.1}\" cy=\"{key:.1}\" r=\"4\" fill=\"{fill}\" stroke=\"{color}\"/>",
                    right + 21.0
                ));
            }
            put(format!("<text x=\"{:.1}\" y=\"{:.1}\">{}</text>", right + 36.0, key + 4.0, series.name));
        }
        svg.push_str("</svg>\n");
        svg
    }
}

/// An axis from `from` to `to` in the picture.
struct Axis {
    scale: Scale,
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    fn new(scale: Scale, values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let values: Vec<f64> =
            values.filter(|v| v.is_finite() && (scale != Scale::Log || *v > 0.0)).collect();
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = if low < high { (low, high) } else { (0.5, 1.5) };
        let (low, high) = match scale {
            Scale::Log => (low / 1.1, high * 1.1),
            Scale::Linear => (low - 0.04 * (high - low), high + 0.04 * (high - low)),
            Scale::Index => (low - 0.5, high + 0.5),
        };
        Self { scale, low, high, from, to }
    }

    fn place(&self, value: f64) -> f64 {
        let share = match self.scale {
            Scale::Log => (value.max(f64::MIN_POSITIVE) / self.low).ln() / (self.high / self.low).ln(),
            Scale::Linear | Scale::Index => (value - self.low) / (self.high - self.low),
        };
        self.from + (self.to - self.from) * share.clamp(0.0, 1.0)
    }

    fn ticks(&self) -> Vec<f64> {
        if self.scale == Scale::Log {
            let decades = |d: i32| 10.0_f64.powi(d);
            let range = (self.low.log10().floor() as i32)..=(self.high.log10().ceil() as i32);
            return range.map(decades).filter(|t| (self.low..=self.high).contains(t)).collect();
        }
        let rough = (self.high - self.low) / 6.0;
        let power = 10.0_f64.powf(rough.log10().floor());
        let step =
            [1.0, 2.0, 5.0, 10.0].into_iter().map(|f| f * power).find(|s| *s >= rough).unwrap_or(power);
        let first = (self.low / step).ceil() as i64;
        let last = (self.high / step).floor() as i64;
        (first..=last).map(|i| i as f64 * step).collect()
    }
}

fn label(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded.abs() >= 1e4 { format!("{rounded:e}") } else { rounded.to_string() }
}
