//! A short rendering of syntax trees: expressions in full parentheses, names and texts as written.

use crate::common::words::{Digits, Value as Number, Word};
use crate::siemens::text::tree::*;
use ncc_ir::source::Span;

/// Renders one block; spans count from `base`.
pub(super) struct Show<'t> {
    pub(super) line: &'t [u8],
    pub(super) base: u32,
}

impl Show<'_> {
    pub(super) fn block(&self, block: &Block) -> String {
        let mut parts = Vec::new();
        if let Some((level, _)) = block.skip {
            parts.push(format!("/{level}"));
        }
        if let Some(number) = block.number {
            parts.push(self.number(number));
        }
        if let Some(label) = block.label {
            parts.push(format!("{}:", self.text(label)));
        }
        parts.push(self.statement(&block.statement));
        if let Some(comment) = block.comment {
            parts.push(format!(";{}", self.text(comment)));
        }
        parts.retain(|part| !part.is_empty());
        parts.join(" | ")
    }

    fn text(&self, span: Span) -> String {
        let at = |place: u32| (place - self.base) as usize;
        String::from_utf8_lossy(&self.line[at(span.start)..at(span.end)]).into_owned()
    }

    fn number(&self, number: BlockNumber) -> String {
        format!("{}{}", if number.main { ":" } else { "N" }, number.value)
    }

    fn statement(&self, statement: &Statement) -> String {
        let section = |from, to| format!(" BLOCK {} TO {}", self.target(from), self.target(to));
        let count =
            |count: &Option<Expr>| count.as_ref().map_or(String::new(), |c| format!(" P={}", self.expr(c)));
        match statement {
            Statement::Words { items, jumps } => {
                let items = items.iter().map(|item| self.item(item));
                items.chain(jumps.iter().map(|j| self.jump(j))).collect::<Vec<_>>().join(" | ")
            }
            Statement::If(e) => format!("IF {}", self.expr(e)),
            Statement::Else => "ELSE".into(),
            Statement::EndIf => "ENDIF".into(),
            Statement::Loop => "LOOP".into(),
            Statement::EndLoop => "ENDLOOP".into(),
            Statement::For { counter, from, to } => {
                format!("FOR {} = {} TO {}", self.place(counter), self.expr(from), self.expr(to))
            }
            Statement::EndFor => "ENDFOR".into(),
            Statement::While(e) => format!("WHILE {}", self.expr(e)),
            Statement::EndWhile => "ENDWHILE".into(),
            Statement::Repeat => "REPEAT".into(),
            Statement::Until(e) => format!("UNTIL {}", self.expr(e)),
            Statement::RepeatSection { first, last, count: n } => {
                let last = last.map_or(String::new(), |l| format!(" to {}", self.text(l)));
                format!("REPEAT from {}{last}{}", self.text(*first), count(n))
            }
            Statement::RepeatBlock { label, count: n } => {
                format!("REPEATB {}{}", self.text(*label), count(n))
            }
            Statement::Case { value, branches, default } => {
                let branches: Vec<_> =
                    branches.iter().map(|(c, j)| format!("{}: {}", self.expr(c), self.jump(j))).collect();
                let default = default.as_ref().map_or(String::new(), |j| format!(", else: {}", self.jump(j)));
                format!("CASE {} {}{default}", self.expr(value), branches.join(", "))
            }
            Statement::Call { file, section: part } => {
                let file = file.as_ref().map_or(String::new(), |f| format!(" {}", self.expr(f)));
                format!("CALL{file}{}", part.as_ref().map_or(String::new(), |(from, to)| section(from, to)))
            }
            Statement::CallByPath { path, arguments } => {
                format!("PCALL {}({})", self.text(*path), self.list(arguments))
            }
            Statement::CallExternal(e) => format!("EXTCALL {}", self.expr(e)),
            Statement::CallIso(e) => format!("ISOCALL {}", self.expr(e)),
            Statement::CallModal(None) => "MCALL".into(),
            Statement::CallModal(Some(called)) => format!("MCALL {}", self.called(called)),
            Statement::Define { name, text } => {
                format!("DEFINE {} AS <{}>", self.text(*name), self.text(*text))
            }
            Statement::Declare(d) => {
                let scope: String = d.scope.iter().map(|s| format!(" {}", self.text(*s))).collect();
                let attributes: String =
                    d.attributes.iter().map(|(a, n)| format!(" {}={}", self.text(*a), digits(*n))).collect();
                let names: Vec<_> = d.names.iter().map(|d| self.declared(d)).collect();
                format!("DEF{scope} {}{attributes} {}", self.kind(&d.kind), names.join(", "))
            }
            Statement::Extern { name, parameters } => {
                format!("EXTERN {}({})", self.text(*name), self.parameters(parameters))
            }
            Statement::Procedure { name, parameters, attributes } => {
                let attributes: String = attributes.iter().map(|a| format!(" {}", self.text(*a))).collect();
                format!("PROC {}({}){attributes}", self.text(*name), self.parameters(parameters))
            }
            Statement::Synchronous(span) => format!("synchronous <{}>", self.text(*span)),
            Statement::Redefine(span) => format!("redefine <{}>", self.text(*span)),
        }
    }

    fn item(&self, item: &Item) -> String {
        match item {
            Item::Word(word) if word.letter == b'L' => self.text(word.span),
            Item::Word(Word { letter, value: Number::Number(n), .. }) => {
                format!("{}{}", char::from(*letter), digits(*n))
            }
            Item::Word(Word { letter, value: Number::None | Number::Computed(_), .. }) => {
                char::from(*letter).to_string()
            }
            Item::Set { place, value, .. } => format!("{} = {}", self.place(place), self.value(value)),
            Item::Name(called) => self.called(called),
        }
    }

    fn called(&self, called: &Called) -> String {
        let arguments = called.arguments.as_ref().map(|a| format!("({})", self.list(a)));
        self.text(called.name) + &arguments.unwrap_or_default()
    }

    fn value(&self, value: &Value) -> String {
        match value {
            Value::Expr(e) => self.expr(e),
            Value::Qualified(q, e) => format!("{q:?} {}", self.expr(e)),
            Value::List(all) => format!("list({})", self.list(all)),
        }
    }

    fn list(&self, all: &[Option<Expr>]) -> String {
        let all: Vec<_> = all.iter().map(|e| e.as_ref().map_or("_".into(), |e| self.expr(e))).collect();
        all.join(", ")
    }

    fn place(&self, place: &Place) -> String {
        let name = match place.address {
            Address::Letter(letter) => char::from(letter).to_string(),
            Address::Name(name) | Address::System(name) => self.text(name),
        };
        let extension = place.extension.map_or(String::new(), |n| n.to_string());
        let index = match place.index.is_empty() {
            true => String::new(),
            false => format!("[{}]", self.list(&place.index)),
        };
        name + &extension + &index
    }

    fn declared(&self, declared: &Declared) -> String {
        let initial = declared.initial.as_ref().map(|v| format!(" = {}", self.value(v)));
        self.place(&declared.place) + &initial.unwrap_or_default()
    }

    fn kind(&self, kind: &Type) -> String {
        let size = match kind.size.is_empty() {
            true => String::new(),
            false => format!("[{}]", self.list(&kind.size)),
        };
        format!("{:?}{size}", kind.name)
    }

    fn parameters(&self, parameters: &[Parameter]) -> String {
        let one = |p: &Parameter| {
            let var = if p.by_reference { "VAR " } else { "" };
            let name = p.name.as_ref().map_or(String::new(), |n| format!(" {}", self.declared(n)));
            format!("{var}{}{name}", self.kind(&p.kind))
        };
        parameters.iter().map(one).collect::<Vec<_>>().join(", ")
    }

    fn jump(&self, jump: &Jump) -> String {
        let condition = jump.condition.as_ref().map_or(String::new(), |c| format!("IF {} ", self.expr(c)));
        let target = jump.target.as_ref().map_or(String::new(), |t| format!(" {}", self.target(t)));
        format!("{condition}{:?}{target}", jump.direction)
    }

    fn target(&self, target: &Target) -> String {
        match target {
            Target::Number(number) => self.number(*number),
            Target::Named(e) => self.expr(e),
        }
    }

    pub(super) fn expr(&self, e: &Expr) -> String {
        match e {
            Expr::Number(n, _) => digits(*n),
            Expr::Bits(bits, _) => format!("bits {bits}"),
            Expr::Character(span) | Expr::Text(span) => self.text(*span),
            Expr::Place(place) => self.place(place),
            Expr::Call { name, arguments, .. } => format!("{}({})", self.text(*name), self.list(arguments)),
            Expr::Unary(operator, e, _) => format!("({operator:?} {})", self.expr(e)),
            Expr::Binary(operator, operands) => {
                format!("({} {operator:?} {})", self.expr(&operands.0), self.expr(&operands.1))
            }
            Expr::Group(e, _) => format!("group {}", self.expr(e)),
        }
    }
}

/// A number with its point.
fn digits(n: Digits) -> String {
    let scale = usize::from(n.scale);
    let text = format!("{:0width$}", n.mantissa.unsigned_abs(), width = scale + 1);
    let (whole, part) = text.split_at(text.len() - scale);
    let sign = if n.mantissa < 0 { "-" } else { "" };
    format!("{sign}{whole}{}{part}", if n.point { "." } else { "" })
}
