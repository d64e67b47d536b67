//! Variables of a Sinumerik: R parameters, which all programs share, and what each program defines for itself, by the
//! chapter on variables of the Job Planning manual (6FC5398-2BP40).
//!
//! A definition without a value sets 0. Not here: characters, axes and frames as variables, those of definition
//! files, and R parameters that nothing has set.

use std::collections::BTreeMap;

use super::super::Place as Machine;
use super::text::Reader;

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Real,
    Int,
    Bool,
}

/// What something is worth.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Worth {
    /// TRUE is 1.
    Number(f64, Kind),
    Text(String),
}

impl Worth {
    pub(super) fn number(&self) -> Result<f64, String> {
        match self {
            Worth::Number(number, _) => Ok(*number),
            Worth::Text(_) => Err("a text in place of a number".into()),
        }
    }

    /// Whether a condition holds.
    pub(super) fn holds(&self) -> Result<bool, String> {
        Ok(self.number()? != 0.0)
    }
}

/// A place of a variable.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Place {
    /// An R parameter.
    R(u32),
    /// By its name and how many elements stand before it.
    Of(String, usize),
}

/// What a call gives.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Given {
    /// A value, with its place if it is a variable alone.
    One(Worth, Option<Place>),
    /// An array.
    Array { name: String, kind: Kind, sizes: Vec<usize>, values: Vec<Worth> },
}

/// A variable that a program has defined.
#[derive(Clone, Debug)]
struct Variable {
    /// None is a text.
    kind: Option<Kind>,
    /// Of an array.
    sizes: Vec<usize>,
    values: Vec<Worth>,
}

/// What the control itself knows at a block.
#[derive(Clone, Debug, Default)]
pub(super) struct Known {
    /// Where the program stands, in its own coordinates.
    pub(super) end: Machine,
    /// The same of the machine.
    pub(super) machine: Machine,
    pub(super) tool: Option<u32>,
    pub(super) inch: bool,
    /// Zeros of the work offsets, from the first one, where the block may ask for them.
    pub(super) zeros: Vec<Machine>,
}

/// All variables.
#[derive(Clone, Debug)]
pub(super) struct Variables {
    pub(super) r: BTreeMap<u32, f64>,
    /// Of each program that is open, the innermost last.
    own: Vec<BTreeMap<String, Variable>>,
    pub(super) known: Known,
}

/// A fraction of one half and more goes up.
pub(super) fn whole(number: f64) -> Result<f64, String> {
    if number < 0.0 && number.fract() == -0.5 {
        return Err(format!("{number} as a whole number: which way halves below zero go is open"));
    }
    Ok((number.abs() + 0.5).floor().copysign(number))
}

/// A value as a variable of this type keeps it; none is a text.
fn kept(kind: Option<Kind>, value: &Worth) -> Result<Worth, String> {
    Ok(match (kind, value) {
        (None, Worth::Text(_)) => value.clone(),
        (None, Worth::Number(..)) => return Err("a number for a text".into()),
        (Some(Kind::Real), _) => Worth::Number(value.number()?, Kind::Real),
        (Some(Kind::Int), _) => Worth::Number(whole(value.number()?)?, Kind::Int),
        (Some(Kind::Bool), _) => Worth::Number(f64::from(u8::from(value.holds()?)), Kind::Bool),
    })
}

impl Default for Variables {
    fn default() -> Variables {
        Variables { r: BTreeMap::new(), own: vec![BTreeMap::new()], known: Known::default() }
    }
}

impl Variables {
    /// Those that a program finds.
    pub(super) fn found(r: &BTreeMap<u32, f64>) -> Variables {
        Variables { r: r.clone(), ..Variables::default() }
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.innermost().contains_key(name)
    }

    fn innermost(&self) -> &BTreeMap<String, Variable> {
        &self.own[self.own.len() - 1]
    }

    /// A program begins.
    pub(super) fn enter(&mut self) {
        self.own.push(BTreeMap::new());
    }

    /// And is over; what it had of its caller's is there again.
    pub(super) fn leave(&mut self, references: &[(Place, Place)]) -> Result<(), String> {
        let values: Result<Vec<Worth>, String> = references.iter().map(|(own, _)| self.get(own)).collect();
        let values = values?;
        self.own.pop();
        for ((_, place), value) in references.iter().zip(values) {
            self.set(place, &[Some(value)])?;
        }
        Ok(())
    }

    pub(super) fn get(&self, place: &Place) -> Result<Worth, String> {
        match place {
            Place::R(number) => match self.r.get(number) {
                Some(value) => Ok(Worth::Number(*value, Kind::Real)),
                // What ran before may have left something in it.
                None => Err(format!("R{number} is read before it is set")),
            },
            Place::Of(name, at) => {
                let value = self.innermost().get(name).and_then(|v| v.values.get(*at));
                value.cloned().ok_or_else(|| format!("no variable {name}, or not so many"))
            }
        }
    }

    /// Sets places one after the other from one on; those of none stay as they are.
    pub(super) fn set(&mut self, from: &Place, values: &[Option<Worth>]) -> Result<(), String> {
        for (after, value) in values.iter().enumerate() {
            let Some(value) = value else { continue };
            match from {
                Place::R(number) => drop(self.r.insert(number + after as u32, value.number()?)),
                Place::Of(name, at) => {
                    let own = self.own.last_mut().and_then(|own| own.get_mut(name));
                    let Some(variable) = own else { return Err(format!("no variable {name}")) };
                    let value = kept(variable.kind, value)?;
                    match variable.values.get_mut(at + after) {
                        Some(place) => *place = value,
                        None => return Err(format!("more values than {name} has places")),
                    }
                }
            }
        }
        Ok(())
    }

    fn define(&mut self, name: String, kind: Option<Kind>, sizes: Vec<usize>) -> Result<(), String> {
        let nothing = kind.map_or(Worth::Text(String::new()), |kind| Worth::Number(0.0, kind));
        let values = vec![nothing; sizes.iter().product()];
        let own = self.own.last_mut().ok_or("no program")?;
        match own.insert(name.clone(), Variable { kind, sizes, values }) {
            None => Ok(()),
            Some(_) => Err(format!("{name} is defined twice")),
        }
    }

    /// Where an element of an array stands, or the variable itself.
    pub(super) fn element(&self, name: &str, at: &[f64]) -> Result<Place, String> {
        let Some(variable) = self.innermost().get(name) else { return Err(format!("no variable {name}")) };
        if at.len() != variable.sizes.len() {
            return Err(format!("{name} with another number of indices"));
        }
        let mut before = 0;
        for (index, size) in at.iter().zip(&variable.sizes) {
            let index = whole(*index)?;
            if index < 0.0 || index >= *size as f64 {
                return Err(format!("{name} has no element {index}"));
            }
            before = before * size + index as usize;
        }
        Ok(Place::Of(name.to_owned(), before))
    }

    /// An array as a whole.
    pub(super) fn array(&self, name: &str) -> Option<Given> {
        let Variable { kind, sizes, values } = self.innermost().get(name)?.clone();
        Some(Given::Array { name: name.to_owned(), kind: kind?, sizes, values })
    }

    /// How many places an array has from one on; nothing of what is no array.
    fn places_from(&self, place: &Place) -> Option<usize> {
        let Place::Of(name, at) = place else { return None };
        let variable = self.innermost().get(name).filter(|v| !v.sizes.is_empty())?;
        Some(variable.values.len() - at)
    }
}

/// A type's name; STRING has its length behind it.
fn kind(reader: &mut Reader) -> Result<Option<Kind>, String> {
    reader.blanks();
    Ok(match reader.name().as_deref() {
        Some("REAL") => Some(Kind::Real),
        Some("INT") => Some(Kind::Int),
        Some("BOOL") => Some(Kind::Bool),
        Some("STRING") => {
            reader.indices()?;
            None
        }
        other => return Err(format!("variables of the type {other:?}")),
    })
}

/// `DEF INT AA=5, BB[3]=SET(1,2,3)`, without the first word.
pub(super) fn definitions(text: &[char], variables: &mut Variables) -> Result<(), String> {
    let before = variables.clone();
    let mut reader = Reader::new(text, &before);
    let kind = kind(&mut reader)?;
    let mut at = reader.at;
    loop {
        // What is defined first can stand in what comes next.
        let before = variables.clone();
        let mut reader = Reader { text, at, variables: &before };
        reader.blanks();
        let Some(name) = reader.name() else { return Err("a definition without a name".into()) };
        let sizes = reader.indices()?;
        let sizes: Vec<usize> = sizes.into_iter().map(|size| size as usize).collect();
        let (array, places) = (!sizes.is_empty(), sizes.iter().product());
        variables.define(name.clone(), kind, sizes)?;
        if reader.take('=') {
            let values = reader.values(array.then_some(places))?;
            variables.set(&Place::Of(name, 0), &values)?;
        }
        if reader.over() {
            return Ok(());
        }
        if !reader.take(',') {
            return Err("a definition and something else".into());
        }
        at = reader.at;
    }
}

/// What a subprogram takes: `NAME(REAL AA, INT BB=2, VAR REAL CC) SBLOF`. Its variables are those of the program that
/// begins; the values of those with VAR are the caller's own (Job planning, 1.19), by their places among the arguments.
pub(super) fn parameters(
    text: &[char],
    given: &[Option<Given>],
    variables: &mut Variables,
) -> Result<Vec<(Place, Place)>, String> {
    let none = Variables::default();
    let mut reader = Reader::new(text, &none);
    reader.blanks();
    if reader.name().is_none() {
        // `PROC L20(…)`
        reader.at += 1;
        reader.digits();
    }
    let mut taken = 0;
    let mut references = Vec::new();
    if reader.take('(') && !reader.take(')') {
        loop {
            reader.blanks();
            let start = reader.at;
            let by_reference = reader.name().as_deref() == Some("VAR");
            if !by_reference {
                reader.at = start;
            }
            let kind = kind(&mut reader)?.ok_or("a text as a parameter")?;
            reader.blanks();
            let name = reader.name().ok_or("a parameter without a name")?;
            reader.blanks();
            let sizes: Vec<usize> = reader.indices()?.into_iter().map(|size| size as usize).collect();
            let argument = given.get(taken).cloned().flatten();
            if !sizes.is_empty() {
                // The caller's own, element by element.
                let Some(Given::Array { name: from, kind: same, sizes: given, values }) = argument else {
                    return Err("an array, and none is given".into());
                };
                if !by_reference || same != kind || given != sizes {
                    return Err("an array by value, or of another type or size".into());
                }
                variables.define(name.clone(), Some(kind), sizes)?;
                let own = |at| (Place::Of(name.clone(), at), Place::Of(from.clone(), at));
                references.extend((0..values.len()).map(own));
                let values: Vec<Option<Worth>> = values.into_iter().map(Some).collect();
                variables.set(&Place::Of(name, 0), &values)?;
                taken += 1;
                if reader.take(')') {
                    break;
                }
                if !reader.take(',') {
                    return Err("parameters without an end".into());
                }
                continue;
            }
            let otherwise = if reader.take('=') { Some(reader.expression()?) } else { None };
            variables.define(name.clone(), Some(kind), Vec::new())?;
            if by_reference {
                match argument.clone() {
                    Some(Given::One(Worth::Number(_, same), Some(place))) if same == kind => {
                        references.push((Place::Of(name.clone(), 0), place));
                    }
                    _ => return Err("VAR, and no variable of that type is given".into()),
                }
            }
            let value = match argument {
                Some(Given::One(value, _)) => Some(value),
                Some(Given::Array { .. }) => return Err("an array for one variable".into()),
                None => otherwise,
            };
            variables.set(&Place::Of(name, 0), &[value])?;
            taken += 1;
            if reader.take(')') {
                break;
            }
            if !reader.take(',') {
                return Err("parameters without an end".into());
            }
        }
    }
    while !reader.over() {
        match reader.name().as_deref() {
            Some("SAVE" | "SBLOF" | "SBLON" | "DISPLOF" | "DISPLON" | "ACTBLOCNO") => {}
            other => return Err(format!("{other:?} behind the parameters")),
        }
    }
    if given.len() > taken { Err("more arguments than parameters".into()) } else { Ok(references) }
}

impl Reader<'_> {
    /// `[1,2]`, or nothing.
    pub(super) fn indices(&mut self) -> Result<Vec<f64>, String> {
        let mut at = Vec::new();
        if self.take('[') {
            loop {
                at.push(self.amount()?);
                if self.take(']') {
                    break;
                }
                if !self.take(',') {
                    return Err("indices without an end".into());
                }
            }
        }
        Ok(at)
    }

    /// The name of an array that is an argument as a whole; nothing is read where there is none.
    pub(super) fn array_alone(&mut self) -> Option<String> {
        let start = self.at;
        let name = self.name().filter(|name| {
            self.variables.innermost().get(name).is_some_and(|variable| !variable.sizes.is_empty())
        });
        self.blanks();
        let alone = matches!(self.peek(0), ',' | ')');
        if name.is_none() || !alone {
            self.at = start;
        }
        name.filter(|_| alone)
    }

    /// The place of a variable that stands from there to here alone, between commas.
    pub(super) fn only_place(&self, start: usize) -> Option<Place> {
        let mut reader = Reader { text: self.text, at: start, variables: self.variables };
        let r = reader.peek(0).eq_ignore_ascii_case(&'R') && !reader.peek(1).is_ascii_alphabetic();
        if !r && !reader.names_variable() {
            return None;
        }
        let place = reader.place().ok()?;
        reader.blanks();
        (reader.at >= self.at).then_some(place)
    }

    /// A variable: `R5`, `R[R1+2]`, `NAME`, `NAME[1,2]`.
    pub(super) fn place(&mut self) -> Result<Place, String> {
        self.blanks();
        if let Some(name) = self.name() {
            let at = self.indices()?;
            return self.variables.element(&name, &at);
        }
        self.at += 1;
        let number = match self.digits() {
            none if none.is_empty() => match self.indices()?[..] {
                [number] => whole(number)?,
                _ => return Err("R with other indices than one".into()),
            },
            digits => digits.parse().map_err(|_| format!("R{digits}"))?,
        };
        if !(0.0..=9999.0).contains(&number) {
            return Err(format!("R{number}"));
        }
        Ok(Place::R(number as u32))
    }

    /// `R1=…`
    pub(super) fn assignment(&mut self) -> Result<super::text::Item, String> {
        let place = self.place()?;
        let places = self.variables.places_from(&place);
        if !self.take('=') || self.peek(0) == '=' {
            return Err("a variable alone".into());
        }
        Ok(super::text::Item::Set(place, self.values(places)?))
    }

    /// What stands behind `=`: one value, or those of `SET(…)`, `REP(…)` and of a list in parentheses, for
    /// so many places of an array.
    fn values(&mut self, places: Option<usize>) -> Result<Vec<Option<Worth>>, String> {
        self.blanks();
        let start = self.at;
        let name = self.name();
        let repeat = name.as_deref() == Some("REP");
        let listed = name.is_none() && self.peek(0) == '(' || repeat || name.as_deref() == Some("SET");
        let Some(places) = places.filter(|_| listed) else {
            self.at = start;
            return Ok(vec![Some(self.expression()?)]);
        };
        if !self.take('(') {
            return Err("SET or REP without values".into());
        }
        let mut values = Vec::new();
        loop {
            self.blanks();
            let empty = matches!(self.peek(0), ',' | ')');
            values.push(if empty { None } else { Some(self.expression()?) });
            if self.take(')') {
                break;
            }
            if !self.take(',') {
                return Err("values without an end".into());
            }
        }
        if !repeat {
            return Ok(values);
        }
        Ok(match &values[..] {
            [value] => vec![value.clone(); places],
            [value, Some(times)] => vec![value.clone(); whole(times.number()?)?.max(0.0) as usize],
            _ => return Err("REP of other values than one".into()),
        })
    }
}
