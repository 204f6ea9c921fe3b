//! Text put into a source, and nothing taken out of it: without the insertions the source is what it was, line by line.

/// What is put where.
#[derive(Debug, Default)]
pub(super) struct Insertions {
    list: Vec<Insertion>,
}

#[derive(Debug)]
struct Insertion {
    at: usize,
    opens: bool,
    text: String,
}

impl Insertions {
    /// In front of what begins here.
    pub(super) fn open(&mut self, at: usize, text: impl Into<String>) {
        self.list.push(Insertion { at, opens: true, text: text.into() });
    }

    /// Behind what ends here.
    pub(super) fn close(&mut self, at: usize, text: impl Into<String>) {
        self.list.push(Insertion { at, opens: false, text: text.into() });
    }

    /// Around it. What encloses must be wrapped before what it encloses.
    pub(super) fn wrap(&mut self, range: &std::ops::Range<usize>, before: impl Into<String>, after: impl Into<String>) {
        self.open(range.start, before);
        self.close(range.end, after);
    }

    /// The source with all of them; `None` if a place is not in it.
    pub(super) fn put_into(self, source: &str) -> Option<String> {
        let mut list: Vec<(usize, Insertion)> = self.list.into_iter().enumerate().collect();
        // At one place what ends there goes first, the innermost before what is around it; what begins there the other way.
        list.sort_by_key(|(order, insertion)| {
            let order = if insertion.opens { *order } else { usize::MAX.saturating_sub(*order) };
            (insertion.at, insertion.opens, order)
        });
        let (mut text, mut done) = (String::with_capacity(source.len().saturating_mul(2)), 0);
        for (_, insertion) in list {
            text.push_str(source.get(done..insertion.at)?);
            text.push_str(&insertion.text);
            done = insertion.at;
        }
        text.push_str(source.get(done..)?);
        Some(text)
    }
}

#[cfg(test)]
mod tests {
    use super::Insertions;

    #[test]
    fn what_encloses_stays_outside() {
        let mut insertions = Insertions::default();
        insertions.wrap(&(0..5), "(", ")");
        insertions.wrap(&(0..1), "[", "]");
        insertions.wrap(&(4..5), "{", "}");
        insertions.open(4, "!");
        assert_eq!(insertions.put_into("a - b").as_deref(), Some("([a] - {!b})"));
    }

    #[test]
    fn a_place_outside_is_refused() {
        let mut insertions = Insertions::default();
        insertions.open(4, "x");
        assert_eq!(insertions.put_into("abc"), None);
    }
}
