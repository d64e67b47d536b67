//! The syntax tree of a block: what its text says, before any meaning.
//!
//! Names stay places in the source ([`Span`]), so that a tree allocates for nesting alone; upper
//! and lower case are one except in texts. Whether a name is a G function, a subprogram or a
//! variable is not known here, and neither is what an address means.
//!
//! Not here: macros (`DEFINE`) are not replaced, and synchronised actions stay one piece of text.

use ncc_ir::source::Span;

use crate::common::words::{Digits, Word};

/// A block: one line.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Block {
    /// Its skip level as written: 0 for a bare slash and for `/0`.
    pub(crate) skip: Option<(u8, Span)>,
    /// `N120` or `:120`.
    pub(crate) number: Option<BlockNumber>,
    /// The label's name, without its colon.
    pub(crate) label: Option<Span>,
    /// What it says.
    pub(crate) statement: Statement,
    /// The comment after `;`, without blanks at its end.
    pub(crate) comment: Option<Span>,
    /// From its first sign to the last one before the comment.
    pub(crate) span: Span,
}

/// The number of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct BlockNumber {
    pub(crate) value: u32,
    /// Written with a colon: a main block.
    pub(crate) main: bool,
    pub(crate) span: Span,
}

/// What a block says.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Statement {
    /// Words, assignments, G functions by name and calls, in the order of the text, and jumps
    /// after them. Both may be empty.
    Words {
        items: Vec<Item>,
        jumps: Vec<Jump>,
    },
    /// `IF` with its branches in blocks of their own.
    If(Expr),
    Else,
    EndIf,
    Loop,
    EndLoop,
    /// `FOR i = from TO to`, counted by one.
    For {
        counter: Place,
        from: Expr,
        to: Expr,
    },
    EndFor,
    While(Expr),
    EndWhile,
    /// `REPEAT` that ends with `UNTIL`.
    Repeat,
    Until(Expr),
    /// `REPEAT first [last] [P=count]`.
    RepeatSection {
        first: Span,
        last: Option<Span>,
        count: Option<Expr>,
    },
    /// `REPEATB label [P=count]`.
    RepeatBlock {
        label: Span,
        count: Option<Expr>,
    },
    /// `CASE value OF constant GOTOF target … [DEFAULT GOTOF target]`.
    Case {
        value: Expr,
        branches: Vec<(Expr, Jump)>,
        default: Option<Jump>,
    },
    /// `CALL file`, by a text; `CALL [file] BLOCK from TO to`.
    Call {
        file: Option<Expr>,
        section: Option<(Target, Target)>,
    },
    /// `PCALL path(arguments)`; the path with its program's name.
    CallByPath {
        path: Span,
        arguments: Vec<Option<Expr>>,
    },
    /// `EXTCALL file`.
    CallExternal(Expr),
    /// `ISOCALL file`.
    CallIso(Expr),
    /// `MCALL` with what is to be called after each move, or alone.
    CallModal(Option<Called>),
    /// `DEFINE name AS text`.
    Define {
        name: Span,
        text: Span,
    },
    /// `DEF type name = value, …`.
    Declare(Declaration),
    /// `EXTERN name(types)`.
    Extern {
        name: Span,
        parameters: Vec<Parameter>,
    },
    /// `PROC name(parameters) attributes`.
    Procedure {
        name: Span,
        parameters: Vec<Parameter>,
        attributes: Vec<Span>,
    },
    /// A synchronised action, whole: `ID=1 WHEN … DO …`.
    Synchronous(Span),
    /// `REDEF …`, whole.
    Redefine(Span),
}

impl Default for Statement {
    fn default() -> Statement {
        Statement::Words { items: Vec::new(), jumps: Vec::new() }
    }
}

/// A part of a block of words.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Item {
    /// A letter with a constant: `X-4.5`, `L010` (the zeros are in its span).
    Word(Word),
    /// An address or a variable with `=`: `X=R1`, `CR=5`, `S2=500`, `R1=2`, `FA[X]=100`. A letter
    /// with a constant means the same with and without `=`.
    Set { place: Place, value: Value, span: Span },
    /// A G function by name, or a subprogram's call: `SUPA`, `CYCLE81(10,0,2,,15)`.
    Name(Called),
}

/// A name with or without arguments in parentheses. An empty one is `None`; trailing ones may be
/// left out.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Called {
    /// The name; for a subprogram by number the whole word, `L010`.
    pub(crate) name: Span,
    /// `None` where no parentheses were written.
    pub(crate) arguments: Option<Vec<Option<Expr>>>,
    pub(crate) span: Span,
}

/// What stands after `=`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Expr(Expr),
    /// `AC(5)`.
    Qualified(Qualifier, Expr),
    /// Values in parentheses, as of a polynomial or an array: `(1,,3)`.
    List(Vec<Option<Expr>>),
}

/// How a position is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Qualifier {
    /// `AC`: absolute.
    Absolute,
    /// `IC`: incremental.
    Incremental,
    /// `DC`: absolute, the shorter way round.
    Direct,
    /// `ACP`: absolute, turning positively.
    Positive,
    /// `ACN`: absolute, turning negatively.
    Negative,
    /// `CAC`, `CIC`, `CDC`, `CACP`, `CACN`: by the number of a coded position.
    Coded,
    /// `QU`: an auxiliary function that is not waited for.
    Quick,
}

/// Something that has a value and can be given one, or the name of an axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) address: Address,
    /// The number of `R5`, `X1`, `S2`.
    pub(crate) extension: Option<u32>,
    /// Contents of the brackets.
    pub(crate) index: Vec<Option<Expr>>,
    pub(crate) span: Span,
}

/// The letter or the name of a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Address {
    /// A capital.
    Letter(u8),
    Name(Span),
    /// A variable of the control itself, with its `$`.
    System(Span),
}

/// A jump: its direction, target and condition.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Jump {
    pub(crate) condition: Option<Expr>,
    pub(crate) direction: Direction,
    /// `None` for [`Direction::ToStart`] alone.
    pub(crate) target: Option<Target>,
    pub(crate) span: Span,
}

/// Where a jump looks for its target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Direction {
    /// `GOTO`: forward, then backward.
    Both,
    /// `GOTOC`: as `GOTO`, and without a target it goes on instead of stopping.
    BothQuietly,
    /// `GOTOF`.
    Forward,
    /// `GOTOB`.
    Backward,
    /// `GOTOS`: the start of the program.
    ToStart,
}

/// A block to go to.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Target {
    /// `N120`, `:120`.
    Number(BlockNumber),
    /// A label, or an expression that gives its text.
    Named(Expr),
}

/// Definition of variables.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Declaration {
    /// Words before the type, as in definition files: `NCK`, `CHAN`.
    pub(crate) scope: Vec<Span>,
    pub(crate) kind: Type,
    /// Attributes with their values: `PHU 14`, `LLI 0`.
    pub(crate) attributes: Vec<(Span, Digits)>,
    pub(crate) names: Vec<Declared>,
}

/// A variable that is defined, with its dimensions in the place's index.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Declared {
    pub(crate) place: Place,
    pub(crate) initial: Option<Value>,
}

/// A type.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Type {
    pub(crate) name: TypeName,
    /// Contents of the brackets after it: the length of a `STRING`, dimensions in `EXTERN`.
    pub(crate) size: Vec<Option<Expr>>,
}

/// The name of a type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // The names are the meaning.
pub(crate) enum TypeName {
    Real,
    Int,
    Bool,
    Char,
    String,
    Axis,
    Frame,
}

/// A parameter of a subprogram.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Parameter {
    /// `VAR`: the caller's variable itself.
    pub(crate) by_reference: bool,
    pub(crate) kind: Type,
    /// `None` in `EXTERN`.
    pub(crate) name: Option<Declared>,
}

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Expr {
    /// A decimal, its sign in the mantissa.
    Number(Digits, Span),
    /// `'H1F'`, `'B101'`.
    Bits(i64, Span),
    /// `'A'`, with its quotes.
    Character(Span),
    /// `"text"`, with its quotes.
    Text(Span),
    /// A variable, an axis, a label, a constant by name.
    Place(Place),
    /// A function.
    Call {
        name: Span,
        arguments: Vec<Option<Expr>>,
        span: Span,
    },
    Unary(Unary, Box<Expr>, Span),
    Binary(Binary, Box<(Expr, Expr)>),
    /// In parentheses.
    Group(Box<Expr>, Span),
}

/// Operators with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unary {
    Negate,
    /// `NOT`
    Not,
    /// `B_NOT`
    BitNot,
    /// `<<` before one value alone: its text.
    Show,
}

/// Operators with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // The names are the meaning.
pub(crate) enum Binary {
    Multiply,
    Divide,
    /// `DIV`: without the part after the point.
    IntegerDivide,
    Modulo,
    Add,
    Subtract,
    BitAnd,
    BitXor,
    BitOr,
    And,
    Xor,
    Or,
    /// `<<`: texts joined.
    Join,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    /// `:`: frames chained.
    Chain,
}

impl Binary {
    fn compares(self) -> bool {
        use Binary::{Equal, Greater, GreaterOrEqual, Less, LessOrEqual, NotEqual};
        matches!(self, Equal | NotEqual | Less | LessOrEqual | Greater | GreaterOrEqual)
    }

    fn is_logical(self) -> bool {
        matches!(self, Binary::And | Binary::Or | Binary::Xor)
    }
}

impl Expr {
    /// Its place in the source.
    pub(crate) fn span(&self) -> Span {
        match self {
            Expr::Number(_, span)
            | Expr::Bits(_, span)
            | Expr::Character(span)
            | Expr::Text(span)
            | Expr::Call { span, .. }
            | Expr::Unary(_, _, span)
            | Expr::Group(_, span) => *span,
            Expr::Place(place) => place.span,
            Expr::Binary(_, operands) => operands.0.span().to(operands.1.span()),
        }
    }

    /// The first comparison whose operand is a logical operation without parentheses. Comparisons
    /// bind weakest of all, so that `A==1 AND B==1` is `(A==(1 AND B))==1`, which hardly anybody
    /// who writes it means.
    pub(crate) fn doubtful_comparison(&self) -> Option<Span> {
        match self {
            Expr::Number(..) | Expr::Bits(..) | Expr::Character(_) | Expr::Text(_) => None,
            Expr::Place(place) => place.index.iter().flatten().find_map(Expr::doubtful_comparison),
            Expr::Call { arguments, .. } => arguments.iter().flatten().find_map(Expr::doubtful_comparison),
            Expr::Unary(_, operand, _) | Expr::Group(operand, _) => operand.doubtful_comparison(),
            Expr::Binary(operator, operands) => {
                let (a, b) = &**operands;
                let logical = |e: &Expr| match e {
                    Expr::Binary(inner, _) => inner.is_logical(),
                    Expr::Unary(inner, _, _) => *inner == Unary::Not,
                    _ => false,
                };
                let compares = |e: &Expr| matches!(e, Expr::Binary(inner, _) if inner.compares());
                let within = a.doubtful_comparison().or_else(|| b.doubtful_comparison());
                let chained = within.is_some() && (compares(a) || compares(b));
                match operator.compares() && (logical(a) || logical(b) || chained) {
                    true => Some(self.span()),
                    false => within,
                }
            }
        }
    }
}
