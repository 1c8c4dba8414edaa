//! Documents that commands write into, between marks.

use std::fs;

/// Puts a text between the marks of a name.
pub(crate) fn insert(document: &str, name: &str, text: &str) {
    let old = fs::read_to_string(document).expect("a document");
    let (begin, end) = (
        format!("<!-- {name} -->\n"),
        format!("<!-- end of {name} -->"),
    );
    let from = old.find(&begin).expect("the mark") + begin.len();
    let to = old.find(&end).expect("the mark of the end");
    let text = format!("{}\n{text}\n{}", &old[..from], &old[to..]);
    fs::write(document, text).expect("a place for it");
}
