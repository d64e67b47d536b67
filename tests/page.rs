//! Pages: Markdown with blocks of program text, each in its dialect.

/// A page.
#[derive(Clone, Debug, Default)]
pub struct Page {
    /// Its first heading.
    pub title: String,
    /// Lines of the form `name: value` before the first block.
    pub facts: Vec<(String, String)>,
    /// Its blocks.
    pub blocks: Vec<Block>,
}

/// A block between fences.
#[derive(Clone, Debug)]
pub struct Block {
    /// First word after the opening fence.
    pub language: String,
    /// The other words after it.
    pub notes: Vec<String>,
    /// The text.
    pub text: String,
}

impl Page {
    /// The value of a fact.
    pub fn fact(&self, name: &str) -> Option<&str> {
        self.facts.iter().find(|(n, _)| n == name).map(|(_, v)| v.as_str())
    }

    /// The block in a language.
    pub fn block(&self, language: &str) -> Option<&Block> {
        self.blocks.iter().find(|b| b.language == language)
    }
}

/// Reads a page.
pub fn read(text: &str) -> Page {
    let mut page = Page::default();
    let mut open: Option<Block> = None;
    for line in text.lines() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(after)) => {
                let mut words = after.split_whitespace().map(str::to_owned);
                let language = words.next().unwrap_or_default();
                open = Some(Block { language, notes: words.collect(), text: String::new() });
            }
            (Some(_), Some(_)) => page.blocks.extend(open.take()),
            (Some(block), None) => {
                block.text.push_str(line);
                block.text.push('\n');
            }
            (None, None) => {
                if let (Some(title), true) = (line.strip_prefix("# "), page.title.is_empty()) {
                    page.title = title.to_owned();
                }
                if let Some((name, value)) = line.split_once(": ").filter(|(n, _)| !n.contains(' ')) {
                    page.facts.push((name.to_owned(), value.to_owned()));
                }
            }
        }
    }
    page
}
