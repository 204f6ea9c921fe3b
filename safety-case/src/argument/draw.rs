//! The argument as pictures: from left to right, one sheet for each module, more where one would be too high for a page.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use super::{Argument, Element, Module};
use crate::template::fill;

const PICTURE: &str = include_str!("../../templates/argument.svg");

/// Pixels: of a box, of a column, of a line, around a text, between boxes.
const WIDE: usize = 254;
const COLUMN: usize = 294;
const LINE: usize = 15;
const PAD: usize = 8;
const GAP: usize = 14;
const DOUBT: usize = 6;
/// Characters in a line of a box.
const CHARACTERS: usize = 34;
/// The same of a context, which is narrower: it stands below its node, and a line goes past it.
const FEWER: usize = 29;
/// A sheet that is higher is divided.
const HIGHEST: usize = 960;

/// One picture.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// The module.
    pub module: String,
    /// The node that it begins with.
    pub root: String,
    /// The picture.
    pub svg: String,
}

/// The class of a node: how its evidence stands.
pub type Tones = BTreeMap<String, &'static str>;

/// Every sheet, in the order of the modules.
///
/// # Errors
/// The template does not render.
pub fn sheets(argument: &Argument, tones: &Tones) -> Result<Vec<Sheet>, minijinja::Error> {
    let mut sheets = Vec::new();
    for module in &argument.modules {
        let mut todo: Vec<String> = roots(argument, module);
        todo.reverse();
        while let Some(root) = todo.pop() {
            let mut cut = BTreeSet::new();
            let mut drawing = drawn(argument, module, tones, &root, &cut);
            if drawing.height > HIGHEST {
                // The first node with more than one branch keeps its branches, each goes on on a sheet of its own.
                let mut at = root.clone();
                while let [only] = branches(argument, module, &at).as_slice() {
                    at.clone_from(only);
                }
                let has_more = |id: &String| !branches(argument, module, id).is_empty();
                let parts: Vec<String> = branches(argument, module, &at).into_iter().filter(has_more).collect();
                cut.extend(parts.iter().cloned());
                drawing = drawn(argument, module, tones, &root, &cut);
                todo.extend(parts.into_iter().rev());
            }
            let svg = drawing.svg(&format!("{}: {root}", module.name))?;
            sheets.push(Sheet { module: module.name.clone(), root, svg });
        }
    }
    Ok(sheets)
}

/// What nothing of the module supports; and what is elsewhere and doubted here.
fn roots(argument: &Argument, module: &Module) -> Vec<String> {
    let mut below = BTreeSet::new();
    let mut roots = Vec::new();
    for node in module.nodes.values() {
        below.extend(node.supported_by.iter().chain(&node.in_context_of).cloned());
    }
    for (id, node) in &module.nodes {
        match &node.challenges {
            Some(doubted) if !module.nodes.contains_key(doubted) => {
                if argument.find(doubted).is_some() && !roots.contains(doubted) {
                    roots.push(doubted.clone());
                }
            }
            Some(_) => {}
            None if below.contains(id) => {}
            None => roots.push(id.clone()),
        }
    }
    roots
}

/// What hangs below a node in this module: its support, then what doubts it.
fn branches(argument: &Argument, module: &Module, id: &str) -> Vec<String> {
    // Of what stands in another module only the doubts are drawn.
    let support = module.nodes.get(id).map(|node| node.supported_by.clone()).unwrap_or_default();
    let support = support.into_iter().filter(|named| argument.find(named).is_some());
    let doubts = module.nodes.iter().filter(|(_, node)| node.challenges.as_deref() == Some(id));
    support.chain(doubts.map(|(doubt, _)| doubt.clone())).collect()
}

fn drawn<'a>(
    argument: &'a Argument,
    module: &'a Module,
    tones: &'a Tones,
    root: &str,
    cut: &'a BTreeSet<String>,
) -> Drawing<'a> {
    let mut drawing = Drawing {
        argument,
        module,
        tones,
        cut,
        seen: BTreeSet::new(),
        boxes: Vec::new(),
        edges: Vec::new(),
        width: 0,
        height: 0,
    };
    let high = drawing.place(root, GAP, GAP);
    drawing.height = high + 2 * GAP;
    drawing
}

struct Drawing<'a> {
    argument: &'a Argument,
    module: &'a Module,
    tones: &'a Tones,
    /// Nodes whose branches stand on another sheet.
    cut: &'a BTreeSet<String>,
    seen: BTreeSet<String>,
    boxes: Vec<Value>,
    edges: Vec<Value>,
    width: usize,
    height: usize,
}

impl Drawing<'_> {
    /// Places a node and all below it; how high that is.
    fn place(&mut self, id: &str, x: usize, y: usize) -> usize {
        let (argument, module) = (self.argument, self.module);
        let again = !self.seen.insert(id.to_owned());
        let away = !module.nodes.contains_key(id);
        let mut high = self.node(id, (x, y), again, (WIDE, CHARACTERS));
        if again {
            return high;
        }
        let middle = y + high / 2;
        let contexts = module.nodes.get(id).map(|node| node.in_context_of.clone()).unwrap_or_default();
        for context in contexts.iter().filter(|_| !away) {
            let top = y + high + GAP / 2;
            let more = self.node(context, (x + 2 * GAP, top), false, (WIDE - 2 * GAP, FEWER));
            let path = format!("M{} {} V{} H{}", x + GAP, y + high, top + more / 2, x + 2 * GAP);
            // The line of a second context begins where the first one ended: from the same node, in the same column.
            self.edges.push(json!({"path": path, "class": "context"}));
            high = high + GAP / 2 + more;
        }
        if self.cut.contains(id) {
            return high;
        }
        let mut below = 0;
        for branch in branches(argument, module, id) {
            let top = y + below;
            let (left, turn) = (x + COLUMN, x + WIDE + (COLUMN - WIDE) / 2);
            let doubts = argument.find(&branch).is_some_and(|(_, node)| node.challenges.as_deref() == Some(id));
            let before = self.boxes.len();
            let taken = self.place(&branch, left, top);
            let first = self.boxes.get(before).and_then(|shape| shape.get("height")).and_then(Value::as_u64);
            let half = usize::try_from(first.unwrap_or(0)).unwrap_or(0) / 2;
            let path = if doubts {
                // Beside the line of support, not on it.
                let (turn, middle) = (turn + DOUBT, middle + DOUBT);
                format!("M{left} {} H{turn} V{middle} H{}", top + half, x + WIDE)
            } else {
                format!("M{} {middle} H{turn} V{} H{left}", x + WIDE, top + half)
            };
            self.edges.push(json!({"path": path, "class": if doubts { "doubt" } else { "support" }}));
            below = below + taken + GAP;
        }
        high.max(below.saturating_sub(GAP))
    }

    /// One box; how high it is.
    fn node(&mut self, id: &str, (x, y): (usize, usize), again: bool, (wide, most): (usize, usize)) -> usize {
        let Some((module, node)) = self.argument.find(id) else { return 0 };
        let element = Element::of(id);
        let away = module.name != self.module.name;
        let mut lines = wrapped(&node.text, most);
        if again || away {
            // Said in full at its own place.
            if lines.len() > 2 {
                lines.truncate(2);
                lines.iter_mut().skip(1).for_each(|line| line.push_str(" …"));
            }
        }
        let beside = match (again, away, self.cut.contains(id)) {
            (true, ..) => "see above".to_owned(),
            (_, true, _) => format!("in {}", module.name),
            (.., true) => "goes on below".to_owned(),
            _ if node.undeveloped => "undeveloped".to_owned(),
            _ if node.defeated => "answered".to_owned(),
            _ => String::new(),
        };
        let high = 2 * PAD + LINE * (lines.len() + 1);
        let rows: Vec<Value> =
            (1..).zip(&lines).map(|(row, text)| json!({"y": y + PAD + 11 + LINE * row, "text": text})).collect();
        let shape = match element {
            Some(Element::Strategy) => "strategy",
            Some(Element::Solution | Element::CounterSolution) => "solution",
            Some(Element::Context) => "context",
            Some(Element::Assumption | Element::Justification) => "oval",
            Some(Element::Goal | Element::CounterGoal) | None => "goal",
        };
        let doubt = matches!(element, Some(Element::CounterGoal | Element::CounterSolution));
        let tone = self.tones.get(id).copied().unwrap_or(if node.undeveloped { "open" } else { "" });
        self.boxes.push(json!({
            "id": id, "x": x, "y": y, "width": wide, "height": high, "right": x + wide, "bottom": y + high,
            "shape": shape, "tone": tone, "doubt": doubt, "defeated": node.defeated, "undeveloped": node.undeveloped,
            "away": again || away, "note": beside, "rows": rows, "left": x + PAD + 4, "first": y + PAD + 11,
            "end": x + wide - PAD - 4, "letter": match element {
                Some(Element::Assumption) => "A", Some(Element::Justification) => "J", _ => "",
            },
            "about": node.text,
        }));
        self.width = self.width.max(x + WIDE + GAP);
        high
    }

    fn svg(&self, title: &str) -> Result<String, minijinja::Error> {
        fill(
            PICTURE,
            json!({"title": title, "width": self.width, "height": self.height, "boxes": self.boxes, "edges": self.edges}),
        )
    }
}

/// The text in lines of at most so many characters; a longer word has its own line.
fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= most => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::wrapped;

    #[test]
    fn text_is_wrapped_between_words() {
        assert_eq!(wrapped("a bc  def ghijklmn o", 6), ["a bc", "def", "ghijklmn", "o"]);
        assert_eq!(wrapped("", 6), Vec::<String>::new());
    }
}
