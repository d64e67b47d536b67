//! The words of reasons: cutter compensation.

use std::borrow::Cow;

use ncc_ir::lack::{CompensationLack as L, ExpandedContour};

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Compensation => "cutter radius compensation",
        L::ComputedEntry => "compensation by a computed entry",
        L::ToolUnknown => "compensation by the radius of a tool that is not known",
        L::EdgeWithoutEntry => "compensation by the radius of an edge that is no entry",
        L::StatedDiameter => "compensation by a diameter that the program states",
        L::EntryWithLength { entry, length } => {
            return format!("the radius of entry {entry} with the length of entry {length}").into();
        }
        L::EntryWithUnknownLength { entry } => {
            return format!("the radius of entry {entry} with a length that is not known").into();
        }
        L::Radius => "compensation by this radius",
        L::WithoutMotion => "a compensated contour with a block that goes nowhere",
        L::TwoWithoutMotion => "a compensated contour with two still blocks in a row",
        L::OnAgain => "cutter radius compensation switched on again without G40",
        L::StopBeside => "a stop in a compensated contour, with M05 or M03 beside it",
        L::EndOfText => "the end of the text under cutter radius compensation",
        L::RotaryAxis => "a rotary axis along a contour whose compensation is computed",
        L::FeedByTime => "feeds by time along a contour whose compensation is computed",
        L::ArcFeedUnknown => {
            "an arc under cutter radius compensation that is worked out, where what F counts on it is not known"
        }
        L::Expanded { what } => {
            return format!("{} under cutter radius compensation that is worked out", expanded(*what)).into();
        }
        L::Listed { function } => return format!("{function} under cutter radius compensation").into(),
        L::FeedModeListed => "SET_FEED_MODE under cutter radius compensation",
    })
}

fn expanded(what: ExpandedContour) -> Cow<'static, str> {
    Cow::Borrowed(match what {
        ExpandedContour::SkippedBlock => "a block that may be skipped",
        ExpandedContour::OtherStart => "another start",
        ExpandedContour::Frame => "a frame",
        ExpandedContour::Motion => "this motion",
        ExpandedContour::FeedByTime => "a feed by time or a point of the machine",
        ExpandedContour::NoRadius => "a contour without a radius before the one before it is left",
        ExpandedContour::ArcLeadIn => "an arc onto the contour",
        ExpandedContour::ArcFeedUnknown => "an arc with an F along the contour that is not known here",
        ExpandedContour::ArcFeedDigits => "an arc with an F at the tool centre that has too few digits",
        ExpandedContour::ArcLeadOut => "an arc that leaves the contour",
        ExpandedContour::SkippedLeadOut => "the way off a contour, in a block that may be skipped,",
        ExpandedContour::OtherPlane => "an arc in another plane",
        ExpandedContour::RotaryAxis => "a rotary axis",
        ExpandedContour::Function { function } => function,
        ExpandedContour::BeforeLeadOut { function } => {
            return format!("{function} before the contour is left,").into();
        }
    })
}
