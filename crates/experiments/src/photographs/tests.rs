//! A whole fit of a grown tree whose picture has colours.

use super::row::{Row, Which};
use crate::{Part, Slice, check, record, run, table::Table};
use pleach_mesh::Palette;
use pleach_render::preview::{Background, Ground};
use pleach_render::{Preview, PreviewSettings};
use pleach_tree::Species;
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

fn spec(folder: &Path, budget: &str) {
    let picture = "[[pictures]]\nfile = \"apple.png\"\nset = \"judged\"\n";
    std::fs::write(folder.join("experiment.toml"), format!("kind = \"photographs\"\n{budget}\n{picture}"))
        .unwrap();
}

fn said(folder: &Path, part: &Part) -> Result<String, String> {
    run(folder, part).map_err(|error| format!("{error:#}"))
}

#[test]
#[ignore = "nightly: a first guess takes half a minute in a build for tests"]
fn a_picture_in_colour_is_fitted_and_measured() {
    let folder = tempfile::tempdir().unwrap();
    let here = |name: &str| folder.path().join(name);
    spec(folder.path(), "seconds = 1.5");
    draw(&here("apple.png"));
    assert!(said(folder.path(), &Part::default()).unwrap().contains("kinds of judged: 1 "));
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
}

/// Rows of a whole run are those of one to go on with.
#[test]
fn scores_are_taken_in_without_a_fit() {
    let folder = tempfile::tempdir().unwrap();
    let here = |name: &str| folder.path().join(name);
    spec(folder.path(), "seconds = 1.5");
    let resumed = Part { resume: true, ..Part::default() };
    assert!(said(folder.path(), &resumed).unwrap_err().contains("no such file"));
    draw(&here("apple.png"));
    std::fs::create_dir(here("fits")).unwrap();
    let species = Species { tree_seed: Some(3), ..pleach_generators::species("apple").unwrap() };
    std::fs::write(here("fits/apple.toml"), species.to_toml(&[])).unwrap();
    let row = Row { picture: "apple".to_owned(), set: "judged".to_owned(), ..Row::default() };
    let columns = record::columns(&row).unwrap();
    let rows = Which::ALL.map(|which| record::to_row(&Row { which, ..row.clone() }).unwrap());
    let table = Table { columns, rows: rows.to_vec() };
    table.write(&here("results.csv.partial")).unwrap();
    let text = std::fs::read_to_string(here("results.csv.partial")).unwrap();

    std::fs::write(here("eye.csv"), "picture,kind,tree\napple,3,9\n").unwrap();
    let error = said(folder.path(), &resumed).unwrap_err();
    assert!(error.contains("apple has the score 9, expected a number from 0 to 5"), "{error}");
    std::fs::write(here("eye.csv"), "picture,kind,tree\napple,3,4\n").unwrap();
    assert!(said(folder.path(), &resumed).unwrap().contains("person"));
    assert_eq!(std::fs::read_to_string(here("results.csv")).unwrap(), text);
    let sheet = image::open(here("sheet-judged.png")).unwrap().to_rgb8();
    assert_eq!((sheet.width(), sheet.height()), (3 * 168 + 8, 160 + 14 + 8 + 8));

    let budgets = [("seconds = 5", "by the clock"), ("seconds = 5\nevaluations = 2", "expected one of them")];
    for (budget, error) in budgets {
        spec(folder.path(), budget);
        assert!(format!("{:#}", check(folder.path(), Slice::default()).unwrap_err()).contains(error));
    }
}
