//! Pictures of programs and parts. The engine of a page has none of them: the page draws its own.

use serde::Deserialize;

use super::time::Summary;

/// Charts of a program over time.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chart {
    /// The program, and how it is timed; it takes no `findings`.
    pub of: Summary,
    /// Charts from top to bottom: `speed`, `tool`, `feed`, `position`; of none, all.
    #[serde(default)]
    pub charts: Vec<ChartName>,
}

/// Charts by their names on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ChartName {
    /// Speed of the spindle.
    Speed,
    /// Tool in the spindle.
    Tool,
    /// Feed of the moves.
    Feed,
    /// Positions of the axes.
    Position,
}

/// A picture of the part that was cut last.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Picture {
    /// The format of the picture.
    pub form: Form,
    /// The view of a PNG; an SVG has both.
    #[serde(default)]
    pub view: View,
    /// The heading of an SVG.
    #[serde(default)]
    pub title: String,
}

/// The format of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Form {
    /// Pixels.
    Png,
    /// The part from above and from a corner, with its tools and alarms.
    Svg,
}

/// A view of the part, by its name on the command line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum View {
    /// From above.
    Plan,
    /// From the front, the right and above.
    #[default]
    #[serde(rename = "isometric")]
    Corner,
}
