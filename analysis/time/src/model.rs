//! The models of how long things take, by their names.

use std::str::FromStr;

/// A model of how long things take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// The case study's: rates and fixed times, no acceleration.
    #[default]
    Ideal,
    /// Rates and accelerations of each axis, speed in corners by the path tolerance, look-ahead over
    /// the whole path.
    Trapezoidal,
    /// The same, with acceleration built up by each axis' jerk.
    JerkLimited,
}

impl Model {
    /// All models.
    pub const ALL: [Model; 3] = [Model::Ideal, Model::Trapezoidal, Model::JerkLimited];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Model::Ideal => "ideal",
            Model::Trapezoidal => "trapezoidal",
            Model::JerkLimited => "jerk-limited",
        }
    }
}

/// No model has this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownModel(pub String);

impl std::fmt::Display for UnknownModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names = Model::ALL.map(Model::name).join(", ");
        write!(f, "{:?}: {names}", self.0)
    }
}

impl std::error::Error for UnknownModel {}

impl FromStr for Model {
    type Err = UnknownModel;

    fn from_str(name: &str) -> Result<Model, UnknownModel> {
        let found = Model::ALL.into_iter().find(|model| model.name() == name);
        found.ok_or_else(|| UnknownModel(name.to_owned()))
    }
}
