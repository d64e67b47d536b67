//! Search: programs by what they say and do.
//!
//! ```text
//! GET /api/v1/search?text=slot+rough           words of the text, of names and tags; `pock*` for a beginning
//! GET /api/v1/search?code=G81&code=M98&tool=T3 codes and tools, all of them
//! GET /api/v1/search?time_max=600&fits=X300,Y200,Z100
//! GET /api/v1/programs/ID/facts                the facts of one program
//! ```
//!
//! Facts and words are there shortly after a change; `waiting` is the number of programs that wait for theirs. Folders hold
//! at once.

use std::sync::Arc;

use axum::extract::{Path, RawQuery, State};
use axum::response::Response;
use serde::Serialize;
use serde_json::Value;
use utoipa::ToSchema;

use super::document::{Program, document, folder};
use crate::Shared;
use crate::access::Caller;
use crate::facts::{code, line, words};
use crate::http::query::Query;
use crate::http::{self, Problem};
use crate::store::{Found, Hit, OfProgram, Range, Shown, Sought, State as Approval, calls};

/// Conditions of a search at most.
const CONDITIONS: usize = 20;

/// Names of the address, for a request that has another one.
const TAKES: &str = "text, tag, under, folder, dialect, machine, tool, code, calls, time_min, time_max, x_min, x_max, y_min, \
                     y_max, z_min, z_max, fits, refused, state, stale, after, limit";

/// A number of the address in thousandths: mm as µm, seconds as ms.
fn thousandths(query: &mut Query, name: &str) -> Result<Option<i64>, Problem> {
    let number: Option<f64> = query.number(name)?;
    number.map(|number| in_thousandths(number, name)).transpose()
}

fn in_thousandths(number: f64, name: &str) -> Result<i64, Problem> {
    let fits = number.abs() < 1e12;
    let none = || Problem::request(format!("`{name}` takes no `{number}`"));
    fits.then_some((number * 1e3).round() as i64).ok_or_else(none)
}

/// A code with its letter, `g081` as `G81`; a name in capitals.
fn code_term(text: &str) -> String {
    let mut rest = text.chars();
    let number = rest.next().and_then(|letter| code(letter, rest.as_str()));
    format!("c {}", number.unwrap_or_else(|| text.to_uppercase()))
}

/// A tool: `T3` or `3`.
fn tool_term(text: &str) -> Result<String, Problem> {
    let number = text.strip_prefix(['T', 't']).unwrap_or(text).parse::<u32>();
    let form = |_| Problem::request(format!("`tool` takes no `{text}`")).help("?tool=T3");
    number.map(|number| format!("t {number}")).map_err(form)
}

/// Terms and beginnings of the words of a text, and the first of them to be shown.
fn text_terms(text: &str, sought: &mut Sought) -> Result<(), Problem> {
    for part in text.split_whitespace() {
        let (part, is_beginning) = match part.strip_suffix('*') {
            Some(part) => (part, true),
            None => (part, false),
        };
        let mut own = Vec::new();
        words(part, |word| own.push(format!("w {word}")));
        let last = if is_beginning { own.pop() } else { None };
        if sought.shown.is_none() {
            let whole = own.first().cloned().map(Shown::Term);
            sought.shown = whole.or_else(|| last.clone().map(Shown::Beginning));
        }
        sought.terms.extend(own);
        sought.beginnings.extend(last);
    }
    match sought.shown {
        Some(_) => Ok(()),
        None => Err(Problem::request("`text` has no word").help("a word has letters and digits: ?text=slot")),
    }
}

/// Greatest lengths of a travel: `X300,Y200,Z100`.
fn travel(text: &str) -> Result<Vec<Range>, Problem> {
    let form = || Problem::request(format!("`fits` takes no `{text}`")).help("?fits=X300,Y200,Z100");
    let axis = |part: &str| {
        let column = match part.chars().next()? {
            'X' | 'x' => "x_span",
            'Y' | 'y' => "y_span",
            'Z' | 'z' => "z_span",
            _ => return None,
        };
        let length: f64 = part[1..].parse().ok()?;
        let most = in_thousandths(length, "fits").ok().filter(|most| *most >= 0)?;
        Some(Range { column, least: None, most: Some(most) })
    };
    let all: Option<Vec<Range>> = text.split(',').map(|part| axis(part.trim())).collect();
    all.ok_or_else(form)
}

/// Reads the conditions of an address.
fn sought(query: Option<&str>) -> Result<Sought, Problem> {
    let mut query = Query::of(query);
    let mut sought = Sought {
        under: query.one("under")?,
        folder: query.all("folder").into_iter().next(),
        state: query.among("state", &Approval::ALL)?,
        stale: query.among("stale", &[("true", true), ("false", false)])?,
        after: query.one("after")?,
        most: query.limit()?,
        ..Sought::default()
    };
    for place in [&sought.under, &sought.folder].into_iter().flatten() {
        folder(place)?;
    }
    if let Some(text) = query.one("text")? {
        text_terms(&text, &mut sought)?;
    }
    let mut terms: Vec<String> = query.all("tag").iter().map(|tag| format!("g {tag}")).collect();
    terms.extend(query.one("dialect")?.map(|dialect| format!("d {dialect}")));
    terms.extend(query.one("machine")?.map(|machine| format!("m {machine}")));
    terms.extend(query.all("code").iter().map(|text| code_term(text)));
    terms.extend(query.all("calls").iter().map(|name| calls(name)));
    for tool in query.all("tool") {
        terms.push(tool_term(&tool)?);
    }
    let refused = query.among("refused", &[("true", "r refused"), ("false", "r executed")])?;
    terms.extend(refused.map(str::to_owned));
    sought.terms.extend(terms);
    let time = ["time_min", "time_max"].map(|name| thousandths(&mut query, name));
    let [least, most] = time;
    sought.ranges.push(Range { column: "ms", least: least?, most: most? });
    for axis in ["x", "y", "z"] {
        let columns = match axis {
            "x" => ["x_min", "x_max"],
            "y" => ["y_min", "y_max"],
            _ => ["z_min", "z_max"],
        };
        // The least one is not less, and the greatest one is not greater.
        let least = thousandths(&mut query, columns[0])?;
        let most = thousandths(&mut query, columns[1])?;
        sought.ranges.push(Range { column: columns[0], least, most: None });
        sought.ranges.push(Range { column: columns[1], least: None, most });
    }
    if let Some(text) = query.one("fits")? {
        sought.ranges.extend(travel(&text)?);
    }
    sought.ranges.retain(|range| range.least.is_some() || range.most.is_some());
    query.end(TAKES)?;
    if sought.terms.len() + sought.beginnings.len() + sought.ranges.len() > CONDITIONS {
        return Err(Problem::request(format!("a search has {CONDITIONS} conditions at most")));
    }
    Ok(sought)
}

/// The document of stored facts; none before the first computation.
fn told(facts: &str) -> Option<Value> {
    serde_json::from_str(facts).ok()
}

/// A place in the text.
#[derive(Debug, Serialize, ToSchema)]
struct FoundPlace {
    /// Line, from 1.
    line: i64,
    /// Number of the block, such as `N40`, where it has one.
    block: Option<String>,
    /// Beginning of the line.
    text: String,
}

/// A translation of a program.
#[derive(Debug, Serialize, ToSchema)]
struct FoundTranslation {
    id: String,
    /// Machine and dialect.
    target: String,
    state: String,
    /// Whether one of its inputs has changed.
    stale: bool,
}

/// A program that was found.
#[derive(Debug, Serialize, ToSchema)]
struct FoundProgram {
    #[serde(flatten)]
    program: Program,
    /// Its facts as one line for people.
    line: Option<String>,
    /// Its facts: tools, codes, times, extents.
    #[schema(value_type = Option<Object>)]
    facts: Option<Value>,
    /// Whether the facts are of the program as it is.
    up_to_date: bool,
    /// The first line with the first word of `text`.
    hit: Option<FoundPlace>,
    /// The newest first.
    translations: Vec<FoundTranslation>,
}

/// A page of programs.
#[derive(Debug, Serialize, ToSchema)]
struct FoundPrograms {
    programs: Vec<FoundProgram>,
    /// Value of `after` for the next page.
    next: Option<String>,
    /// Number of programs that wait for their facts.
    waiting: i64,
}

/// Facts of a program.
#[derive(Debug, Serialize, ToSchema)]
struct FactsDocument {
    /// The same as one line for people.
    line: Option<String>,
    /// Tools, codes, times, extents; nothing before they are computed for the first time.
    #[schema(value_type = Option<Object>)]
    facts: Option<Value>,
    /// Whether they are of the program as it is.
    up_to_date: bool,
}

fn found(of: &Found) -> FoundProgram {
    let facts = told(&of.document);
    let place = |hit: &Hit| {
        let text = hit.text.split(|byte| matches!(byte, b'\n' | b'\r')).next().unwrap_or_default();
        let text = String::from_utf8_lossy(text);
        FoundPlace { line: hit.line, block: block_number(&text), text: text.trim().to_owned() }
    };
    let translation = |own: &OfProgram| FoundTranslation {
        id: own.id.clone(),
        target: own.target.clone(),
        state: own.state.clone(),
        stale: own.is_stale,
    };
    FoundProgram {
        program: document(&of.of),
        line: facts.as_ref().map(line),
        facts,
        up_to_date: of.is_up_to_date,
        hit: of.hit.as_ref().map(place),
        translations: of.translations.iter().map(translation).collect(),
    }
}

/// The number of a block, `N40`, if it begins with one.
fn block_number(line: &str) -> Option<String> {
    let text = line.trim_start().trim_start_matches('/').trim_start();
    let number = text.strip_prefix(['N', 'n'])?;
    let digits: String = number.chars().take_while(char::is_ascii_digit).collect();
    (!digits.is_empty()).then(|| format!("N{digits}"))
}

/// Finds programs by what they say and do; all conditions hold for each.
#[utoipa::path(get, path = "/api/v1/search", tag = "programs",
    params(
        ("text" = Option<String>, Query, description = "Words of the text, the name, the folder, the tags; `pock*` is a beginning"),
        ("tag" = Option<Vec<String>>, Query, description = "Tags, all of them"),
        ("under" = Option<String>, Query, description = "A folder with those below it"),
        ("folder" = Option<String>, Query, description = "A folder alone"),
        ("dialect" = Option<String>, Query, description = "The dialect, stated or recognised"),
        ("machine" = Option<String>, Query, description = "The machine"),
        ("tool" = Option<Vec<String>>, Query, description = "Tools, all of them: `T3`"),
        ("code" = Option<Vec<String>>, Query, description = "Codes and cycles, all of them: `G81`"),
        ("calls" = Option<Vec<String>>, Query, description = "Names of programs of its folder that it calls"),
        ("time_min" = Option<f64>, Query, description = "Its time, s, is not shorter"),
        ("time_max" = Option<f64>, Query, description = "Its time, s, is not longer"),
        ("x_min" = Option<f64>, Query, description = "Its feed moves, mm, are not below"),
        ("x_max" = Option<f64>, Query, description = "Its feed moves, mm, are not above"),
        ("y_min" = Option<f64>, Query, description = "As `x_min`"),
        ("y_max" = Option<f64>, Query, description = "As `x_max`"),
        ("z_min" = Option<f64>, Query, description = "As `x_min`"),
        ("z_max" = Option<f64>, Query, description = "As `x_max`"),
        ("fits" = Option<String>, Query, description = "Its feed moves need no longer travel, mm: `X300,Y200,Z100`"),
        ("refused" = Option<bool>, Query, description = "Whether it cannot be executed"),
        ("state" = Option<Approval>, Query, description = "The state of one of its translations"),
        ("stale" = Option<bool>, Query, description = "Whether one of its translations is stale"),
        ("after" = Option<String>, Query, description = "The last one of the page before: its `next`"),
        ("limit" = Option<u64>, Query, maximum = 4294967295u64, description = "Entries at most, up to 1000; 100 without it"),
    ),
    responses((status = 200, body = FoundPrograms)))]
pub(super) async fn search(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    let sought = sought(query.as_deref())?;
    let most = sought.most as usize;
    let (page, waiting) = shared.store(&caller, move |store| Ok(store.search(&sought)?)).await?;
    let next = page.last().filter(|_| page.len() == most).map(|last| last.of.program.clone());
    Ok(http::json(&FoundPrograms { programs: page.iter().map(found).collect(), next, waiting }))
}

/// Gives the facts of a program.
#[utoipa::path(get, path = "/api/v1/programs/{id}/facts", tag = "programs",
    params(("id" = String, Path)),
    responses((status = 200, body = FactsDocument)))]
pub(super) async fn facts(
    State(shared): State<Arc<Shared>>,
    caller: Caller,
    Path(id): Path<String>,
    RawQuery(query): RawQuery,
) -> Result<Response, Problem> {
    Query::of(query.as_deref()).end("")?;
    let (facts, is_up_to_date) = shared.store(&caller, move |store| Ok(store.facts(&id)?)).await?;
    let facts = facts.and_then(|facts| told(&facts));
    Ok(http::json(&FactsDocument { line: facts.as_ref().map(line), facts, up_to_date: is_up_to_date }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_is_a_search() {
        let read = |query: &str| sought(Some(query)).expect("a search");
        let all = read(
            "text=Slot+pock*&code=g081&code=cycle81&tool=T03&tag=x&fits=X300,z0.5&x_max=-1.5&time_min=60",
        );
        assert_eq!(all.terms, ["w slot", "g x", "c G81", "c CYCLE81", "t 3"]);
        assert_eq!(all.beginnings, ["w pock"]);
        assert_eq!(all.shown, Some(Shown::Term("w slot".into())));
        let range = |column, least, most| Range { column, least, most };
        assert_eq!(
            all.ranges,
            [
                range("ms", Some(60_000), None),
                range("x_max", None, Some(-1500)),
                range("x_span", None, Some(300_000)),
                range("z_span", None, Some(500))
            ]
        );
        assert_eq!(read("text=6.8*").shown, Some(Shown::Beginning("w 6.8".into())));
        for wrong in [
            "text=*",
            "tool=drill",
            "fits=300",
            "fits=X-1",
            "fits=A1",
            "fits=Xnan",
            "x_max=nan",
            "x_max=1e99",
            "state=new",
            "colour=red",
            "under=a/../b",
            "refused=maybe",
            &"code=G1&".repeat(21),
        ] {
            assert!(sought(Some(wrong)).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_line_may_have_a_number() {
        assert_eq!(block_number("/ n40 G1"), Some("N40".into()));
        assert_eq!([block_number("G1 N5"), block_number("(N4)"), block_number("NAME")], [None, None, None]);
    }
}
