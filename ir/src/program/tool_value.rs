//! Values of the table of tools.

/// A value of the table of tools.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ToolValue {
    /// Length, without wear.
    Length,
    /// Wear of the length, which is added to it.
    LengthWear,
    /// Radius, without wear.
    Radius,
    /// Wear of the radius.
    RadiusWear,
    /// Offset along X, in the machine's directions whatever frames are turned; a mill's tool has none.
    OffsetX,
    /// Offset along Y.
    OffsetY,
}

impl ToolValue {
    /// All values.
    pub const ALL: [ToolValue; 6] = [
        ToolValue::Length,
        ToolValue::LengthWear,
        ToolValue::Radius,
        ToolValue::RadiusWear,
        ToolValue::OffsetX,
        ToolValue::OffsetY,
    ];

    /// Whether it puts the tool elsewhere when the entry is activated: a length, or an offset along an axis.
    pub fn is_offset(self) -> bool {
        match self {
            ToolValue::Length | ToolValue::LengthWear | ToolValue::OffsetX | ToolValue::OffsetY => true,
            ToolValue::Radius | ToolValue::RadiusWear => false,
        }
    }
}
