//! As much of Markdown as the checks need: code spans, links, headings.

/// Something on a line of a document.
pub(crate) struct Found {
    pub(crate) line: usize,
    pub(crate) text: String,
}

/// A document, taken apart.
#[derive(Default)]
pub(crate) struct Markdown {
    /// What stands between backticks, outside of listings.
    pub(crate) spans: Vec<Found>,
    /// Where links and pictures lead.
    pub(crate) links: Vec<Found>,
    /// The anchors of the headings, as GitHub makes them.
    pub(crate) anchors: Vec<String>,
    /// The lines of listings.
    pub(crate) listings: Vec<Found>,
}

impl Markdown {
    pub(crate) fn parse(text: &str) -> Self {
        let mut document = Self::default();
        let mut in_listing = false;
        for (index, line) in text.lines().enumerate() {
            let line_number = index + 1;
            if line.trim_start().starts_with("```") {
                in_listing = !in_listing;
            } else if in_listing {
                document.listings.push(Found { line: line_number, text: line.to_owned() });
            } else {
                let (spans, rest) = code_spans(line);
                let found = |text| Found { line: line_number, text };
                document.spans.extend(spans.into_iter().map(found));
                document.links.extend(links(&rest).into_iter().map(found));
                if line.starts_with('#') {
                    document.add_heading(line.trim_start_matches('#').trim());
                }
            }
        }
        document
    }

    fn add_heading(&mut self, heading: &str) {
        let anchor: String = heading
            .to_lowercase()
            .chars()
            .filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'))
            .map(|c| if c == ' ' { '-' } else { c })
            .collect();
        let again = self.anchors.iter().filter(|other| **other == anchor).count();
        self.anchors.push(if again == 0 { anchor } else { format!("{anchor}-{again}") });
    }
}

/// The code spans of a line, and the line without them.
fn code_spans(line: &str) -> (Vec<String>, String) {
    let (mut spans, mut rest) = (Vec::new(), String::new());
    let mut left = line;
    while let Some(start) = left.find('`') {
        let ticks = left[start..].chars().take_while(|c| *c == '`').count();
        let body = start + ticks;
        let Some(length) = left[body..].find(&"`".repeat(ticks)) else { break };
        rest.push_str(&left[..start]);
        rest.push('.');
        spans.push(left[body..body + length].trim().to_owned());
        left = &left[body + length + ticks..];
    }
    rest.push_str(left);
    (spans, rest)
}

/// Where the links of a line lead: `[text](here)`.
fn links(line: &str) -> Vec<String> {
    line.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0.to_owned())).collect()
}

#[test]
fn spans_links_and_anchors_of_a_document() {
    let document =
        Markdown::parse("# A `b`, c\n\nSee `x` and [y](z.md#c).\n```text\n`no` span\n```\n## A b c\n");
    let texts = |found: &[Found]| found.iter().map(|found| found.text.clone()).collect::<Vec<_>>();
    assert_eq!(texts(&document.spans), ["b", "x"]);
    assert_eq!(texts(&document.links), ["z.md#c"]);
    assert_eq!(texts(&document.listings), ["`no` span"]);
    assert_eq!(document.anchors, ["a-b-c", "a-b-c-1"]);
    assert_eq!(document.links[0].line, 3);
}
