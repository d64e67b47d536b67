//! Tools and their lengths.

/// What a target can say of tools, and how it changes them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToolCaps {
    /// Tools by name.
    pub names: bool,
    /// Whether the number of the tool in the spindle can be set.
    pub number: bool,
    /// Values of the table of tools, in the order of [`crate::program::ToolValue::ALL`].
    pub data: [bool; 6],
    /// Whether a value can be added to one of that table.
    pub data_added: bool,
    /// Whether such a value leaves what is active of the tool as it is, until the entry is activated again.
    pub data_kept: bool,
    /// Whether tools are measured where the axes stand: in the active coordinates; in those of a work offset.
    pub measured: [bool; 2],
    /// Whose lengths they are.
    pub lengths_of: LengthsOf,
    /// Where lengths are entries of a table, that of the tool in the spindle can be activated without its number.
    pub own_length: bool,
    /// Whether a tool's length can be stated, and whether one can be added to the active one.
    pub stated_lengths: [bool; 2],
    /// A length offset must stand in a block with a Z word.
    pub offset_with_z: bool,
    /// A length offset counts as soon as it is read: the tool stands at another Z.
    pub length_at_once: bool,
    /// A program begins with words for no length.
    pub starts_without_length: bool,
    /// Form of tool centre point control.
    pub tip: TipForm,
    /// A tool change leaves the spindle stopped.
    pub change_stops_spindle: bool,
    /// A tool is changed by hand, and the operator sets the zero of Z by it: no length of a tool is known.
    pub change_by_hand: bool,
}

/// Whose lengths a target has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LengthsOf {
    /// Either.
    #[default]
    Either,
    /// Those of edges of the tool in the spindle.
    Edges,
    /// Those of entries of a table.
    Entries,
}

/// How a target says that points are those of the tool tip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TipForm {
    /// Not at all.
    #[default]
    None,
    /// By the word that takes the length up; the word that ends the length ends it.
    WithLength,
    /// By words of its own; the length stays what it is.
    Apart,
    /// As the text form does.
    Any,
}
