//! Reasons of refusals as data: an enum whose variants a reader of messages can find by name.
//!
//! ```text
//! reasons! { pub enum ArcsLack { Radius, Turns { most: u32 } } }
//! ArcsLack::Turns { most: 3 }    name "Turns", values [("most", "3")]
//! ```
//!
//! The driver alone has the words: an entry for each name, with its values in it. A test there compares its entries
//! with `VARIANTS`, so that no reason is without words.

use crate::canon::{AdviceKind, Axis, PathMode};
use crate::expr::system::System;
use crate::expr::{Binary, Function};

/// The values of a reason, by the names of its fields, as a message shows them.
pub type Values = Vec<(&'static str, String)>;

/// The variants of an enum of reasons: the name of each, with the names of its fields.
pub type Variants = &'static [(&'static str, &'static [&'static str])];

/// A reason of a refusal.
pub trait Reason {
    /// The name of its variant: `Radius`, or with the wing before it, `Arcs-Radius`.
    fn name(&self) -> String;

    /// Adds the values of its fields.
    fn values(&self, values: &mut Values);
}

/// A field of a reason.
pub(crate) trait Field {
    /// Adds its value under the name of the field.
    fn put(&self, name: &'static str, values: &mut Values);
}

/// A field that is a reason itself: the name of its variant, and the fields of that.
impl<R: Reason> Field for R {
    fn put(&self, name: &'static str, values: &mut Values) {
        values.push((name, self.name()));
        self.values(values);
    }
}

macro_rules! fields {
    ($($type:ty: |$field:ident| $text:expr;)*) => {
        $(
            impl Field for $type {
                fn put(&self, name: &'static str, values: &mut Values) {
                    let $field = self;
                    values.push((name, $text));
                }
            }
        )*
    };
}

fields! {
    u8: |number| number.to_string();
    u16: |number| number.to_string();
    u32: |number| number.to_string();
    usize: |number| number.to_string();
    i64: |number| number.to_string();
    char: |letter| letter.to_string();
    &'static str: |text| (*text).to_owned();
    Box<str>: |text| text.to_string();
    System: |asked| asked.to_string();
    Axis: |axis| char::from(axis.letter()).to_string();
    PathMode: |mode| mode.name().to_owned();
    AdviceKind: |kind| kind.name().to_owned();
    // As in the text form.
    Function: |function| format!("{function:?}").to_lowercase();
    Binary: |operator| format!("{operator:?}").to_lowercase();
}

/// Enums of reasons: the enum as it is written, `VARIANTS`, and `Reason`.
macro_rules! reasons {
    ($(
        $(#[$meta:meta])*
        pub enum $name:ident {
            $( $(#[$doc:meta])* $variant:ident
                $({ $( $(#[$field_doc:meta])* $field:ident: $type:ty, )* })?, )*
        }
    )*) => {
        $(
            $(#[$meta])*
            pub enum $name {
                $( $(#[$doc])* $variant $({ $( $(#[$field_doc])* $field: $type, )* })?, )*
            }

            impl $name {
                /// The name of each variant, with the names of its fields.
                pub const VARIANTS: $crate::reason::Variants = &[
                    $( (stringify!($variant), &[ $( $( stringify!($field), )* )? ]), )*
                ];
            }

            impl $crate::reason::Reason for $name {
                fn name(&self) -> String {
                    match self {
                        $( Self::$variant $({ $( $field: _, )* })? => stringify!($variant).to_owned(), )*
                    }
                }

                #[allow(unused_variables, reason = "an enum without a field has no value")]
                fn values(&self, values: &mut $crate::reason::Values) {
                    match self {
                        $( Self::$variant $({ $( $field, )* })? => {
                            $( $( $crate::reason::Field::put($field, stringify!($field), values); )* )?
                        } )*
                    }
                }
            }
        )*
    };
}

/// An enum of wings of reasons, with a conversion from each: the name of a reason has its wing's before it.
macro_rules! wings {
    (
        $(#[$meta:meta])*
        pub enum $all:ident {
            $( $(#[$doc:meta])* $name:ident($reason:ident), )*
        }
    ) => {
        $(#[$meta])*
        pub enum $all {
            $( $(#[$doc])* $name($reason), )*
        }

        impl $all {
            /// The name of each wing, with its variants.
            pub const WINGS: &'static [(&'static str, $crate::reason::Variants)] = &[
                $( (stringify!($name), $reason::VARIANTS), )*
            ];
        }

        impl $crate::reason::Reason for $all {
            fn name(&self) -> String {
                match self {
                    $( $all::$name(reason) => format!("{}-{}", stringify!($name), $crate::reason::Reason::name(reason)), )*
                }
            }

            fn values(&self, values: &mut $crate::reason::Values) {
                match self {
                    $( $all::$name(reason) => $crate::reason::Reason::values(reason, values), )*
                }
            }
        }

        $(
            impl From<$reason> for $all {
                fn from(reason: $reason) -> $all {
                    $all::$name(reason)
                }
            }
        )*
    };
}

pub(crate) use {reasons, wings};
