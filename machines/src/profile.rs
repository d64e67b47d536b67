//! A profile that has been read and checked.

use std::ops::Range;

use ncc_dialects::Dialect;
use ncc_exec::world::Tables;
use ncc_ir::canon::{AXES, Axis};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_time::{AxisFacts, Machine, ToolChangeOn};

use crate::check::check;
use crate::fact::Fact;
use crate::schema::{ChangeOn, MCodeRow, Schema};
use crate::table::Row;
use crate::takes::Takes;
use crate::wrong::{ProfileError, Wrong};

/// A profile without faults, and the dictionary of its dialect.
#[derive(Clone, Debug)]
pub struct Profile {
    /// What the file says.
    pub schema: Schema,
    /// The dictionary of its dialect, as it is without the profile.
    pub dialect: &'static Dialect,
    /// Whether its file names no control. Then `dialect` is not that of a program, and the profile serves for times only.
    pub any_control: bool,
}

impl Profile {
    /// Reads a profile. `dialect` finds a dictionary by its name.
    ///
    /// # Errors
    /// Everything that is wrong with it, in the order of the file; only the first fault of its form.
    pub fn parse(
        text: &str,
        dialect: &dyn Fn(&str) -> Option<&'static Dialect>,
    ) -> Result<Profile, Vec<ProfileError>> {
        let schema: Schema = toml::from_str(text).map_err(|error| vec![form(&error, text)])?;
        toml::from_str::<Named>(text).map_err(|error| vec![form(&error, text)])?;
        Profile::of(schema, dialect)
    }

    /// A profile that was read, checked.
    ///
    /// # Errors
    /// Everything that is wrong with it, in the order of the file.
    pub(crate) fn of(
        schema: Schema,
        dialect: &dyn Fn(&str) -> Option<&'static Dialect>,
    ) -> Result<Profile, Vec<ProfileError>> {
        let Some(dialect) = dialect(schema.dialect.get_ref()) else {
            let name = schema.dialect.get_ref().clone();
            return Err(vec![ProfileError::new(Wrong::UnknownDialect { name }, schema.dialect.span())]);
        };
        let mut wrong = check(&schema, dialect);
        if !wrong.is_empty() {
            wrong.sort_by_key(|error| error.span.start);
            return Err(wrong);
        }
        Ok(Profile { schema, dialect, any_control: false })
    }

    /// Its name on the command line.
    pub fn id(&self) -> &str {
        self.schema.id.get_ref()
    }

    /// A profile that states nothing but its dialect.
    pub fn empty(dialect: &'static Dialect) -> Profile {
        let text = |text: &str| toml::Spanned::new(0..0, text.to_owned());
        let schema = Schema {
            id: text(&dialect.id),
            title: String::new(),
            dialect: text(&dialect.id),
            typical: false,
            notes: String::new(),
            sources: Default::default(),
            options: Default::default(),
            confirmed: Default::default(),
            power_on: Default::default(),
            rates: Default::default(),
            times: Default::default(),
            spindle: Default::default(),
            axis: Vec::new(),
            tool: Vec::new(),
            edge: Vec::new(),
            work_offset: Vec::new(),
            program: Vec::new(),
            m_code: Vec::new(),
            value: Vec::new(),
            emit: Default::default(),
        };
        Profile { schema, dialect, any_control: false }
    }

    /// Adds an M code and its function, unless the profile or its dialect has the code.
    pub fn add_code(&mut self, code: &str, function: &str) {
        let rows = self.schema.m_code.iter().map(toml::Spanned::get_ref);
        if rows.clone().any(|row| row.code.value.as_deref() == Some(code) && row.function.value.is_some()) {
            return;
        }
        let text = |text: &str| Fact { value: Some(text.to_owned()), ..Fact::default() };
        let row = MCodeRow { code: text(code), function: text(function), ..MCodeRow::default() };
        self.schema.m_code.push(toml::Spanned::new(0..0, row));
    }

    /// What variables hold when a program starts, by their names.
    pub fn values(&self) -> impl Iterator<Item = (&str, f64)> {
        self.schema.value.iter().filter_map(|row| {
            let row = row.get_ref();
            Some((row.name.value.as_deref()?, row.holds.get()?))
        })
    }

    /// Edges of tools other than the first: tool, edge, and entry of the length table.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32, u32)> {
        self.schema.edge.iter().filter_map(|row| {
            let row = row.get_ref();
            Some((row.tool.get()?, row.edge.get()?, row.length_entry.get()?))
        })
    }

    /// What models of the timeline know of the machine.
    pub fn machine(&self) -> Machine {
        let s = &self.schema;
        let mut axes = [AxisFacts::default(); AXES];
        for row in &s.axis {
            let row = row.get_ref();
            let letter = row.letter.value.as_deref().and_then(|l| l.bytes().next());
            let Some(axis) = letter.and_then(Axis::from_letter) else { continue };
            axes[axis as usize] = AxisFacts {
                travel: row.travel.get(),
                rapid_rate: row.rapid.get(),
                max_feed: row.max_feed.get(),
                acceleration: row.acceleration.get(),
                jerk: row.jerk.get(),
            };
        }
        Machine {
            axes,
            rapid_rate: s.rates.rapid.get(),
            max_feed: s.rates.max_feed.get(),
            tool_change: s.times.tool_change.get(),
            tool_change_on: match s.times.tool_change_on.get() {
                Some(ChangeOn::Select) => ToolChangeOn::Select,
                Some(ChangeOn::Change) | None => ToolChangeOn::Change,
            },
            spindle_start: s.times.spindle_start.get(),
            spindle_stop: s.times.spindle_stop.get(),
            spindle_acceleration: s.spindle.acceleration.get(),
            spindle_max: s.spindle.max_speed.get(),
            path_tolerance: s.rates.path_tolerance.get(),
            exact_stop: s.rates.exact_stop.get(),
            look_ahead: s.rates.look_ahead.get(),
            m_function: s.times.m_function.get(),
            functions: s
                .m_code
                .iter()
                .filter_map(|row| {
                    let row = row.get_ref();
                    Some((row.function.value.clone()?, row.seconds.get()?))
                })
                .collect(),
            block: s.times.block.get(),
        }
    }

    /// Its tables of work offsets and of tools' lengths, as far as it states them.
    pub fn tables(&self) -> Tables {
        // A millionth of a millimetre is finer than any control's table.
        let nanos = |mm: f64| (mm * 1e6).round() as Nanos * (ONE / 1_000_000);
        let mut tables = Tables::default();
        for row in self.schema.work_offset.iter().map(toml::Spanned::get_ref) {
            let Some(number) = row.number.get().and_then(|n| u16::try_from(n).ok()) else { continue };
            let axes = [&row.x, &row.y, &row.z, &row.a, &row.b, &row.c];
            tables.work_offsets.insert(number, axes.map(|axis| axis.get().map(nanos)));
        }
        for row in self.schema.tool.iter().map(toml::Spanned::get_ref) {
            let Some(number) = row.number.get() else { continue };
            let entry = row.length_entry.get().unwrap_or(number);
            if let Some(length) = row.length.get() {
                tables.lengths.insert(entry, nanos(length));
            }
            if let Some(diameter) = row.diameter.get() {
                tables.radii.insert(row.radius_entry.get().unwrap_or(entry), nanos(diameter / 2.0));
            }
            if entry != number {
                tables.edge_entries.insert(number, entry);
            }
        }
        tables
    }

    /// Every table with fixed keys, in the order of the schema; of those that may stand several
    /// times, each.
    pub fn rows(&self) -> Vec<Row> {
        self.schema.rows()
    }
}

/// What a profile in a file of its own must have besides its dialect.
#[derive(serde::Deserialize)]
struct Named {
    #[serde(rename = "id")]
    _id: serde::de::IgnoredAny,
    #[serde(rename = "title")]
    _title: serde::de::IgnoredAny,
}

/// A text that has not the form of its file.
pub(crate) fn form(error: &toml::de::Error, text: &str) -> ProfileError {
    let span = error.span().unwrap_or(0..0);
    let span = inside(span, text);
    let wrong = match Takes::of_message(error.message()) {
        Some(takes) => Wrong::Kind { found: text[span.clone()].to_owned(), takes },
        None => Wrong::Form { message: error.message().to_owned() },
    };
    ProfileError::new(wrong, span)
}

/// A place that is one: not behind the end, and between characters.
pub(crate) fn inside(span: Range<usize>, text: &str) -> Range<usize> {
    let within =
        |at: usize| (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0);
    let (start, end) = (within(span.start), within(span.end));
    start..end.max(start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shipped::shipped;
    use ncc_dialects::builtin;

    fn read(text: &str) -> Result<Profile, Vec<ProfileError>> {
        Profile::parse(text, &builtin)
    }

    #[test]
    fn the_case_study_machine_has_its_attributes() {
        let machine = crate::find("romi-discovery-4022").expect("shipped").machine();
        assert_eq!(machine.rapid_rate, Some(15000.0));
        assert_eq!(machine.tool_change, Some(7.0));
        assert_eq!((machine.spindle_start, machine.spindle_stop), (Some(2.0), Some(2.0)));
        assert_eq!(machine.axes[0].acceleration, None);
    }

    #[test]
    fn typical_machines_have_what_models_with_acceleration_need_and_mark_it() {
        let typical: Vec<&Profile> = shipped().iter().filter(|p| p.schema.typical).collect();
        assert_eq!(typical.len(), 8);
        for profile in typical {
            let machine = profile.machine();
            for axis in &machine.axes[..3] {
                assert!(axis.rapid_rate.is_some() && axis.acceleration.is_some() && axis.jerk.is_some());
            }
            for row in profile.rows() {
                for fact in row.facts.iter().filter(|f| f.value.is_some()) {
                    let choice = matches!(fact.key, "letter" | "tool_change_on");
                    assert!(choice || !fact.source.is_empty(), "{}: {}", profile.id(), fact.key);
                }
            }
        }
    }

    #[test]
    fn a_fact_has_two_forms_and_may_be_empty() {
        let head = "id = \"a\"\ntitle = \"t\"\ndialect = \"fanuc\"\n";
        let profile = read(&format!(
            "{head}[times]\ntool_change = 5\nspindle_start = {{ value = 2.5, source = \"s\", assumed = true }}\nspindle_stop = \"\"\nblock = {{ value = \"\", source = \"asked for\" }}\n"
        ))
        .expect("a profile");
        let times = &profile.schema.times;
        assert_eq!((times.tool_change.get(), times.spindle_start.get()), (Some(5.0), Some(2.5)));
        assert!(times.spindle_start.assumed && times.spindle_start.source == "s");
        assert_eq!((times.spindle_stop.get(), times.block.get(), times.m_function.get()), (None, None, None));
    }

    #[test]
    fn facts_at_power_on_always_hold_in_the_derived_dictionary() {
        let text = "id = \"a\"\ntitle = \"t\"\ndialect = \"fanuc\"\n[options]\npeck_clearance = 0.5\n[power_on]\nunits = \"inch\"\nplane = \"\"\n";
        let settings = read(text).expect("a profile").settings();
        let units = settings.dialect.power_on.units.as_ref().expect("stated");
        assert!(units.always && units.value == ncc_dialects::UnitsName::Inch);
        assert!(settings.dialect.power_on.plane.as_ref().is_none_or(|plane| !plane.always));
        assert_eq!((settings.get("peck_clearance"), settings.is_chosen("break_lift")), ("0.5", false));
    }

    #[test]
    fn a_length_is_in_its_entry() {
        let head = "id = \"a\"\ntitle = \"t\"\ndialect = \"fanuc\"\n";
        let rows =
            "[[tool]]\nnumber = 3\nlength_entry = 23\nlength = 80.5\n[[tool]]\nnumber = 4\nlength = 90\n";
        let tables = read(&format!("{head}{rows}")).expect("a profile").tables();
        let mm = |n: Nanos| n * ONE / 10;
        assert_eq!(tables.lengths.into_iter().collect::<Vec<_>>(), [(4, mm(900)), (23, mm(805))]);
        assert_eq!(tables.edge_entries.into_iter().collect::<Vec<_>>(), [(3, 23)]);
    }

    #[test]
    fn no_text_makes_the_reader_panic() {
        for text in ["", "id = 5", "[", "id = \"é\"\ntitle = \"", "\u{feff}", "[[axis]]\n[axis]\n"] {
            assert!(read(text).is_err(), "{text:?}");
        }
    }
}
