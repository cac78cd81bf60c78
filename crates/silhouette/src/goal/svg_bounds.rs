//! What a drawing in SVG may have: checked in its XML, before anything is made of it.
//!
//! A few hundred bytes of SVG can stand for any number of shapes, or for shapes within themselves. What is refused here has
//! no end that follows from the size of the file, or no edge to find a tree by.

use std::collections::HashMap;
use usvg::roxmltree::{Document, Node, NodeId};

/// Bytes of a drawing.
const MAX_BYTES: usize = 1 << 22;
/// Elements once each `use` is what it names.
const MAX_ELEMENTS: u64 = 200_000;
/// How deep they may lie in each other.
const MAX_DEPTH: usize = 500;
/// Elements times bytes of style sheets: each rule is tried on each element.
const MAX_STYLED: u64 = 1 << 30;

/// Elements that are not read. That they are there is enough: style sheets and attributes name them in many ways.
const REFUSED: [&str; 5] = ["clipPath", "filter", "marker", "mask", "pattern"];

/// Bytes that entities may become: each reference may name others, of which the parser follows 255.
const MAX_EXPANDED: usize = 1 << 28;

/// The text of a drawing.
pub(super) fn text(bytes: &[u8]) -> Result<&str, String> {
    if bytes.len() > MAX_BYTES {
        return Err(format!("it has {} bytes, and at most {MAX_BYTES} are read", bytes.len()));
    }
    let text = std::str::from_utf8(bytes).map_err(|_| "it is not in UTF-8".to_owned())?;
    // From the first declaration to the end of the last.
    let declared =
        text.find("<!ENTITY").map_or(0, |from| text.rfind("]>").unwrap_or(text.len()).saturating_sub(from));
    let references = text.matches('&').count();
    if declared.saturating_mul(references).saturating_mul(256) > MAX_EXPANDED {
        return Err("it has too many entities".to_owned());
    }
    Ok(text)
}

/// Tells what a drawing has that is not read.
pub(super) fn check(document: &Document<'_>) -> Result<(), String> {
    let elements = || document.descendants().filter(Node::is_element);
    if let Some(found) = elements().find(|node| REFUSED.contains(&node.tag_name().name())) {
        let name = found.tag_name().name();
        return Err(format!("it has the element `{name}`, which is not read"));
    }
    let styles: u64 = elements()
        .filter(|node| node.tag_name().name() == "style")
        .flat_map(|node| node.children().filter_map(|child| child.text()))
        .map(|text| text.len() as u64)
        .sum();
    let named = elements().filter_map(|node| Some((node.attribute("id")?, node))).collect();
    let mut counted = Counted { named, sizes: HashMap::new() };
    let count = counted.size(document.root_element(), 0)?;
    if count > MAX_ELEMENTS {
        return Err(format!("it has more than {MAX_ELEMENTS} shapes, each `use` counted as what it names"));
    }
    if styles.saturating_mul(count) > MAX_STYLED {
        return Err("its style sheets are too long for so many shapes".to_owned());
    }
    Ok(())
}

/// Elements of parts of a drawing, each found once.
struct Counted<'a, 'input> {
    named: HashMap<&'a str, Node<'a, 'input>>,
    sizes: HashMap<NodeId, u64>,
}

impl Counted<'_, '_> {
    /// Elements of `node`, itself included.
    fn size(&mut self, node: Node<'_, '_>, depth: usize) -> Result<u64, String> {
        if let Some(&size) = self.sizes.get(&node.id()) {
            return Ok(size);
        }
        // What lies in itself has no end.
        if depth > MAX_DEPTH {
            return Err(format!("its elements are nested more than {MAX_DEPTH} deep"));
        }
        let mut size = 1_u64;
        for child in node.children().filter(Node::is_element) {
            size = size.saturating_add(self.size(child, depth + 1)?);
        }
        let href = node.attributes().find(|attribute| attribute.name() == "href");
        let target = href.and_then(|href| href.value().trim().strip_prefix('#'));
        let target =
            target.filter(|_| node.tag_name().name() == "use").and_then(|id| self.named.get(id).copied());
        if let Some(target) = target {
            size = size.saturating_add(self.size(target, depth + 1)?);
        }
        let _ = self.sizes.insert(node.id(), size);
        Ok(size)
    }
}
