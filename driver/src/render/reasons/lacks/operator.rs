//! The words of reasons: messages, alarms and text for devices.

use std::borrow::Cow;

use ncc_ir::lack::OperatorLack as L;

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Message => "a message",
        L::OperatorMessage => "a message to the operator",
        L::MessageValues => "a message with values in it",
        L::MessageCharacters => "a message with these characters",
        L::MessageQuotation => "a message with a quotation mark",
        L::MessageLength => "a message of more than 200 characters",
        L::MessageValueZeros => "a value in a message without the zeros at its end",
        L::MessageValueNoVariable => "a message with a value that is no variable",
        L::StopMessage => "a stop with a message",
        L::Alarm => "an alarm",
        L::AlarmNumber => "an alarm of this number",
        L::AlarmWithNumber => "an alarm with a number",
        L::AlarmCharacters => "an alarm with these characters",
        L::AlarmQuotation => "an alarm with a quotation mark",
        L::CommentBesideText => "a comment beside a text for the operator",
        L::TextLength { most } => {
            return format!("a text for the operator of more than {most} characters").into();
        }
        L::TextCharacters => "a text for the operator with these characters",
        L::DeviceText => "text for a device",
        L::DeviceNotOpened => "text for a device that the program does not open",
        L::DeviceCharacters => "text for a device with these characters",
        L::DeviceDigits => "a value for a device with these digits",
        L::DeviceValueNoVariable => "a value for a device that is no variable",
    })
}
