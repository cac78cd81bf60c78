//! A reading in plain words.

use crate::colors::Colors;
use crate::reading::Reading;
use pleach_plant::Color;
use std::fmt;

/// Names, values and confidences of what was read.
type Line = (&'static str, String, f64);

impl Reading {
    /// The measures as lines of name, value in plain words, and confidence.
    ///
    /// ```
    /// use pleach_reading::Reading;
    /// use pleach_silhouette::Bitmap;
    ///
    /// let pole = Bitmap::from_fn(100, 200, |x, y| (50..58).contains(&(x + y / 10)));
    /// let table = Reading::from_silhouette(&pole).table();
    /// let value = |name| &table.iter().find(|line| line.0 == name).expect("it is there").1;
    /// assert_eq!(value("feet"), "one trunk, 0.04 of the height wide");
    /// assert_eq!(value("lean"), "6° to the right");
    /// ```
    #[must_use]
    pub fn table(&self) -> Vec<(&'static str, String, f64)> {
        let mut lines: Vec<Line> = vec![("feet", self.feet_in_words(), self.feet_confidence)];
        let mut add = |name, value: Option<String>, confidence| {
            lines.extend(value.map(|value| (name, value, confidence)));
        };
        add("lean", self.lean_deg.map(lean), self.lean_deg_confidence);
        add("bare trunk", self.bare_height.map(bare), self.bare_height_confidence);
        let fork =
            self.first_fork.map_or_else(|| "none seen".to_owned(), |height| self.fork_in_words(height));
        add("first fork", Some(fork), self.first_fork_confidence);
        let widest =
            |(at, width): (f64, f64)| format!("{width:.2} of the height wide at {at:.2} of the height");
        add("crown", self.crown_widest.zip(self.crown_width).map(widest), self.crown_widest_confidence);
        add("asymmetry", self.asymmetry.map(asymmetry), self.asymmetry_confidence);
        add(
            "gaps",
            self.gap_share.map(|gap| format!("{:.0} % of the crown", 100.0 * gap)),
            self.gap_share_confidence,
        );
        add("clumps", self.gap_share.map(|_| self.clumps.to_string()), self.clumps_confidence);
        let fine = |width: f64| format!("{width:.4} of the height thin");
        add("twigs", self.twig_fineness.map(fine), self.twig_fineness_confidence);
        add(
            "leaf size",
            self.leaf_size_px.map(|size| format!("{size:.1} pixels")),
            self.leaf_size_px_confidence,
        );
        add("strokes", self.stroke_deg.map(strokes), self.stroke_deg_confidence);
        let leaves = if self.leaves { "in leaf" } else { "bare of leaves" };
        add("leaves", Some(leaves.to_owned()), self.leaves_confidence);
        lines
    }

    fn feet_in_words(&self) -> String {
        let width = self.feet.iter().map(|foot| foot.width).fold(0.0, f64::max);
        match self.feet.len() {
            0 => "no trunk".to_owned(),
            1 => format!("one trunk, {width:.2} of the height wide"),
            count => format!("{count} trunks, at most {width:.2} of the height wide"),
        }
    }

    fn fork_in_words(&self, height: f64) -> String {
        let arms: Vec<String> = self.fork_arms_deg.iter().map(|&angle| lean(angle)).collect();
        format!("at {height:.2} of the height, arms {}", arms.join(" and "))
    }
}

fn lean(degrees: f64) -> String {
    let side = if degrees < 0.0 { "left" } else { "right" };
    if degrees.abs() < 0.5 { "upright".to_owned() } else { format!("{:.0}° to the {side}", degrees.abs()) }
}

fn asymmetry(share: f64) -> String {
    let side = if share < 0.0 { "left" } else { "right" };
    if share.abs() < 0.05 {
        "even".to_owned()
    } else {
        format!("{:.0} % more to the {side}", 100.0 * share.abs())
    }
}

fn bare(height: f64) -> String {
    if height < 0.005 {
        "branches or foliage down to the ground".to_owned()
    } else {
        format!("up to {height:.2} of the height")
    }
}

fn strokes(degrees: f64) -> String {
    if degrees.abs() < 0.5 {
        return "level on average".to_owned();
    }
    let how = if degrees < 0.0 { "hanging" } else { "rising" };
    format!("{how} by {:.0}° on average", degrees.abs())
}

impl Colors {
    /// What was read as lines of name, value in plain words, and confidence.
    ///
    /// ```
    /// use pleach_reading::Colors;
    /// use pleach_silhouette::Bitmap;
    /// use pleach_silhouette::mask::Photo;
    ///
    /// let photo = Photo::from_fn(90, 90, |_, y| if y < 60 { [92, 131, 54, 255] } else { [107, 76, 48, 255] });
    /// let tree = Bitmap::from_fn(90, 90, |x, y| y < 60 || (40..50).contains(&x));
    /// let table = Colors::read(&photo, &tree)?.table();
    /// assert_eq!((table[0].0, table[0].1.as_str()), ("leaf color", "#5c8336"));
    /// # Ok::<(), pleach_reading::ReadingError>(())
    /// ```
    #[must_use]
    pub fn table(&self) -> Vec<(&'static str, String, f64)> {
        let color = |name, color: Option<Color>, confidence| Some((name, color?.to_string(), confidence));
        let lines = [
            color("leaf color", self.leaf, self.leaf_confidence),
            color("bark", self.bark, self.bark_confidence),
            color("blossom", self.blossom, self.blossom_confidence),
            self.season.map(|season| ("season", season.name().to_owned(), self.season_confidence)),
            // Drawings and photographs are far apart.
            self.is_drawn().then(|| ("picture", "a drawing in flat colors".to_owned(), 1.0)),
        ];
        lines.into_iter().flatten().collect()
    }
}

impl fmt::Display for Reading {
    /// One line per measure: name, value, confidence.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, value, confidence) in self.table() {
            writeln!(f, "{name:<10}  {value:<52}  {confidence:.2}")?;
        }
        Ok(())
    }
}
