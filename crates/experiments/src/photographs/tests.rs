//! A whole fit of a grown tree whose picture has colours.

use super::row::{Row, Which};
use crate::{Part, Slice, check, run, table::Table};
use pleach_mesh::Palette;
use pleach_render::preview::{Background, Ground};
use pleach_render::{Preview, PreviewSettings};
use std::path::Path;

/// A cut-out in the size that known species are drawn in beforehand.
fn draw(path: &Path) {
    let species = pleach_generators::species("apple").unwrap();
    let tree = species.grow(3).unwrap();
    let settings = PreviewSettings {
        width: 256,
        height: 256,
        elevation: 0.0,
        background: Background::Transparent,
        ground: Ground::None,
        ..PreviewSettings::default()
    };
    let picture = Preview::new(&tree, &Palette::new(&species.appearance, None), 256).picture(&settings);
    picture.write_png(&mut std::fs::File::create(path).unwrap()).unwrap();
}

#[test]
fn a_picture_in_colour_is_fitted_measured_and_scored() {
    let folder = tempfile::tempdir().unwrap();
    let here = |name: &str| folder.path().join(name);
    let spec = |budget: &str| {
        let text = format!(
            "kind = \"photographs\"\n{budget}\n[[pictures]]\nfile = \"apple.png\"\nset = \"judged\"\n"
        );
        std::fs::write(here("experiment.toml"), text).unwrap();
    };
    let said = |part: &Part| run(folder.path(), part).map_err(|error| format!("{error:#}"));
    spec("seconds = 1.5");
    assert!(said(&Part::default()).unwrap_err().contains("no such file"));
    draw(&here("apple.png"));
    assert!(said(&Part::default()).unwrap().contains("kinds of judged: 1 "));

    let text = std::fs::read_to_string(here("results.csv")).unwrap();
    let columns: Vec<String> = text.lines().next().unwrap().split(',').map(str::to_owned).collect();
    let rows: Vec<Row> = Table::parse(&text, &columns).unwrap().records().unwrap();
    assert_eq!(rows.iter().map(|row| row.which).collect::<Vec<_>>(), Which::ALL);
    for row in &rows {
        assert_eq!((row.picture.as_str(), row.set.as_str()), ("apple", "judged"));
        assert!(row.iou.0 > 0.3 && row.crown_iou.0 > row.iou.0 && row.likeness.0 > 0.3, "{row:?}");
        assert!((0.6..1.6).contains(&row.width.0) && row.left_off.0 < 0.2 && row.best_ellipse_iou.0 > 0.3);
    }
    assert!(rows[2].iou.0 >= rows[0].iou.0);
    assert!(pleach_generators::read_file(&here("fits/apple.toml")).unwrap().tree_seed.is_some());
    let sheet = image::open(here("sheet-judged.png")).unwrap().to_rgb8();
    assert_eq!((sheet.width(), sheet.height()), (3 * 168 + 8, 160 + 14 + 8 + 8));

    // Scores are taken in without a fit: rows of a whole run are those of one to go on with.
    std::fs::rename(here("results.csv"), here("results.csv.partial")).unwrap();
    std::fs::write(here("eye.csv"), "picture,kind,tree\napple,3,9\n").unwrap();
    let resumed = Part { resume: true, ..Part::default() };
    assert!(said(&resumed).unwrap_err().contains("apple has the score 9, expected a number from 0 to 5"));
    std::fs::write(here("eye.csv"), "picture,kind,tree\napple,3,4\n").unwrap();
    assert!(said(&resumed).unwrap().contains("person"));
    assert_eq!(std::fs::read_to_string(here("results.csv")).unwrap(), text);

    let slice = Slice::default();
    for (budget, error) in
        [("seconds = 5", "by the clock"), ("seconds = 5\nevaluations = 2", "expected one of them")]
    {
        spec(budget);
        assert!(format!("{:#}", check(folder.path(), slice).unwrap_err()).contains(error));
    }
}
