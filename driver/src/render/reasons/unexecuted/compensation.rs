//! The words of reasons: cutter compensation.

use ncc_ir::unexecuted::CompensationUnexecuted as R;

pub(super) fn text(reason: &R) -> &'static str {
    match reason {
        R::BeginsAgain => "a program that begins again under cutter radius compensation",
        R::OnTwice => "cutter radius compensation switched on twice",
        R::TiltedPlane => "cutter radius compensation in a plane that is tilted",
        R::OtherSide => "cutter radius compensation of another side or radius without G40",
        R::NoEntry => "compensation by a radius of no entry",
        R::ArcLeadIn => "an arc as the first move of cutter radius compensation",
        R::ArcLeadOut => "an arc as the move that leaves cutter radius compensation",
        R::Cycle => "a cycle under cutter radius compensation",
        R::Plane => "another plane under cutter radius compensation",
        R::ArcOtherPlane => "an arc in another plane than that of cutter radius compensation",
        R::Units => "other units under cutter radius compensation",
        R::WorkOffset => "another work offset under cutter radius compensation",
        R::Frame => "another frame under cutter radius compensation",
        R::TipControl => "tool centre point control under cutter radius compensation",
        R::AxisTurned => "the tool's axis turned under cutter radius compensation",
        R::MachinePoint => "a point of the machine under cutter radius compensation",
        R::Probing => "probing under cutter radius compensation",
        R::Detour => "a rapid move by a detour under cutter radius compensation",
        R::Thread => "a thread under cutter radius compensation",
        R::ToolChange => "a tool change under cutter radius compensation",
        R::Length => "another length under cutter radius compensation",
        R::Edge => "another edge under cutter radius compensation",
        R::Radius => "another radius under cutter radius compensation",
        R::PositionStored => "storing where the axes stand under cutter radius compensation",
        R::Tool => "another tool under cutter radius compensation",
        R::ToolMeasured => "a tool measured under cutter radius compensation",
        R::Tilt => "a tilted plane under cutter radius compensation",
    }
}
