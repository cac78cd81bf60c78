use super::*;
use proptest::prelude::*;

fn first_numbers(bytes: &[u8]) -> Result<Vec<f64>, String> {
    let read = || {
        let table = Table::new("t.csv", bytes)?;
        let column = table.expect_column(&["height"])?;
        table.rows().map(|row| row?.expect_number(column)).collect::<Result<Vec<_>, TableError>>()
    };
    read().map_err(|error| error.to_string())
}

#[test]
fn the_dialects_of_spreadsheets_give_the_same_numbers() {
    for text in [
        "name,height\noak,12.5\nelm,8\n",
        "Name;Height\noak;12,5\nelm;8\n",
        "\u{feff}NAME;HEIGHT;;\r\noak;12,5;;\r\nelm;8;;\r\n;;;\r\n",
        "sep=;\nname;height\noak;12.5\nelm;8\n",
        "sep=\t\r\nname,\theight\noak,\t12.5\nelm,\t8\n",
        "name\theight (m)\tremark\noak\t12,5\t\nelm\t8\tsick; old, too\n",
        "\n\"name\",\"Height [m]\"\n\"oak\",\"12,5\"\n\"elm\",\"8\"\n",
        "name,height,remark\noak,12.5,\"a, b\nand c\"\n\nelm,8,\n",
    ] {
        assert_eq!(first_numbers(text.as_bytes()), Ok(vec![12.5, 8.0]), "{text}");
    }
}

#[test]
fn words_of_western_europe_are_read() {
    let latin = b"art;h\xf6he;preis\nB\xe4umchen;1,5;\x80 3\n";
    let table = Table::new("t.csv", latin).unwrap();
    assert_eq!(table.headings(), ["art", "höhe", "preis"]);
    let row = table.rows().next().unwrap().unwrap();
    assert_eq!([0, 1, 2].map(|column| row.text(column)), ["Bäumchen", "1,5", "€ 3"]);
    assert_eq!(row.number(table.expect_column(&["Höhe"]).unwrap()), Ok(Some(1.5)));
}

#[test]
fn what_can_be_read_in_two_ways_is_refused_with_its_line() {
    for (text, message) in [
        ("name,kind;height\n", "t.csv:1: commas and semicolons stand between the headings"),
        ("height,Height\n1,2\n", "t.csv:1: the headings `height` and `Height` mean the same column"),
        ("height\n\"1,234\"\n", "t.csv:2: `height` is `1,234`, which may be thousands or a decimal comma"),
        (
            "a;height\n;1,5\n;2.5\n",
            "t.csv:3: `height` is `2.5`, with a point, while line 2 has a decimal comma",
        ),
        ("a;height\n;1.234,5\n", "t.csv:2: `height` is `1.234,5`, expected a number without marks"),
        (
            "a;height\n;1.234.500\n",
            "t.csv:2: `height` is `1.234.500`, expected a number with one decimal mark",
        ),
        ("a,height\n\n,2,5\n", "t.csv:3: the row has 3 cells, expected 2"),
        ("a,height\n1\n", "t.csv:2: the row has 1 cell, expected 2"),
    ] {
        let told = first_numbers(text.as_bytes()).unwrap_err();
        assert!(told.starts_with(message), "{text}: {told}");
    }
    assert_eq!(first_numbers(b"a,height\n,\"0,125\"\n"), Ok(vec![0.125]), "no thousands begin with 0");
    assert_eq!(first_numbers(b"a;height\n;1,234\n"), Ok(vec![1.234]), "here a comma separates no cells");
}

#[test]
fn what_is_no_table_says_so() {
    for (bytes, message) in [
        (&b""[..], "t.csv:1: the table is empty"),
        (b";;;\n", "t.csv:1: the table is empty"),
        (b"\xff\xfeh\0e\0", "t.csv:1: this is text in UTF-16"),
        (b"PK\x03\x04...", "t.csv:1: this is a file of a spreadsheet program"),
        (b"height\n\0\n", "t.csv:1: this is a binary file"),
        (b"width\n1\n", "t.csv:1: no column is called `height`; the headings are width"),
        (b"height (cm)\n1\n", "t.csv:1: no column is called `height`"),
        (b"height\nNaN\n", "t.csv:2: `height` is `NaN`, expected a number"),
        (b"height\n1e999\n", "t.csv:2: `height` is `1e999`, expected a number"),
        (b"height\ntall\n", "t.csv:2: `height` is `tall`, expected a number"),
    ] {
        let told = first_numbers(bytes).unwrap_err();
        assert!(told.starts_with(message), "{message}: {told}");
    }
    let wide = ",".repeat(MAX_COLUMNS) + "height\n";
    assert!(first_numbers(wide.as_bytes()).unwrap_err().contains("more than 1000 columns"));
    // Not read into memory, whether or not some of it is in quotes; in quotes alone it is one cell.
    let wide = format!("height\n1\n{0}\"{0}\n\"{0}\n", ",".repeat(12_000));
    assert_eq!(first_numbers(wide.as_bytes()), Err("t.csv:4: there are more than 1000 columns".to_owned()));
    let stray = format!("height\na\",{}\n", ",".repeat(20_000));
    assert_eq!(first_numbers(stray.as_bytes()), Err("t.csv:2: there are more than 1000 columns".to_owned()));
    let quoted = format!("height,remark\n1,\"{}\"\n", ",".repeat(50_000));
    assert_eq!(first_numbers(quoted.as_bytes()), Ok(vec![1.0]));
}

#[test]
fn cells_of_nothing_are_empty_or_na() {
    let table = Table::new("t.csv", b"id,height\n1,NA\n2,\n3,4\n").unwrap();
    let height = table.expect_column(&["height"]).unwrap();
    let read = table.rows().map(|row| row.unwrap().number(height).unwrap());
    assert_eq!(read.collect::<Vec<_>>(), [None, None, Some(4.0)]);
}

#[test]
fn one_heading_may_stand_for_three_columns() {
    let mut table = Table::new("t.txt", b"id\tStart point\tend\n1\t2\t3\t4\t5\n").unwrap();
    table.split("start_point", &["x", "y", "z"]);
    let row = table.rows().next().unwrap().unwrap();
    assert_eq!(row.number(table.expect_column(&["z"]).unwrap()), Ok(Some(4.0)));
    assert_eq!(row.number(table.expect_column(&["end"]).unwrap()), Ok(Some(5.0)));
}

proptest! {
    #[test]
    fn no_bytes_do_harm(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let _ = first_numbers(&bytes);
        let text: Vec<u8> = bytes.iter().map(|byte| b"height;,\t\"\n0123.-e"[usize::from(*byte) % 18]).collect();
        let _ = first_numbers(&text);
    }
}
