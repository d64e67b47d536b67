//! A table of text, for people and as Markdown.

use std::fmt::Write;

/// A table; the first columns are text, the others figures.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Headings.
    pub head: Vec<&'static str>,
    /// Rows, each with a cell for every heading.
    pub rows: Vec<Vec<String>>,
    /// Columns that are flush left; the others are flush right.
    pub left: usize,
}

impl Grid {
    /// For people: two blanks before every line and between columns.
    pub fn plain(&self, out: &mut String) {
        let wide: Vec<usize> = (0..self.head.len())
            .map(|i| {
                let cells = self.rows.iter().map(|row| row[i].chars().count());
                cells.chain([self.head[i].chars().count()]).max().unwrap_or(0)
            })
            .collect();
        let head: Vec<String> = self.head.iter().map(|h| (*h).to_owned()).collect();
        for row in std::iter::once(&head).chain(&self.rows) {
            let mut line = String::new();
            for (i, cell) in row.iter().enumerate() {
                let wide = wide[i];
                // Writing to a string cannot fail.
                let _ = if i < self.left {
                    write!(line, "  {cell:<wide$}")
                } else {
                    write!(line, "  {cell:>wide$}")
                };
            }
            out.push_str(line.trim_end());
            out.push('\n');
        }
    }

    /// As a table of Markdown.
    pub fn markdown(&self, out: &mut String) {
        let line = |cells: &mut dyn Iterator<Item = String>, out: &mut String| {
            out.push('|');
            for cell in cells {
                out.push(' ');
                out.push_str(&cell);
                out.push_str(" |");
            }
            out.push('\n');
        };
        line(&mut self.head.iter().map(|h| escaped(h)), out);
        let rule = |i: usize| if i < self.left { "---" } else { "---:" }.to_owned();
        line(&mut (0..self.head.len()).map(rule), out);
        for row in &self.rows {
            line(&mut row.iter().map(|cell| escaped(cell)), out);
        }
    }
}

/// Text without signs that mean something to Markdown in a table.
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' | '\r' | '\t' => out.push(' '),
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '|' | '\\' | '`' | '*' | '_' | '[' | ']' => {
                out.push('\\');
                out.push(c);
            }
            c => out.push(c),
        }
    }
    out
}
