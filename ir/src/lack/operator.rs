//! Messages, alarms and text for devices, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Messages, alarms and text for devices that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum OperatorLack {
        /// A message.
        Message,
        /// A message to the operator.
        OperatorMessage,
        /// A message with values in it.
        MessageValues,
        /// A message with these characters.
        MessageCharacters,
        /// A message with a quotation mark.
        MessageQuotation,
        /// A message of more than 200 characters.
        MessageLength,
        /// A value in a message without the zeros at its end.
        MessageValueZeros,
        /// A message with a value that is no variable.
        MessageValueNoVariable,
        /// A stop with a message.
        StopMessage,
        /// An alarm.
        Alarm,
        /// An alarm of this number.
        AlarmNumber,
        /// An alarm with a number.
        AlarmWithNumber,
        /// An alarm with these characters.
        AlarmCharacters,
        /// An alarm with a quotation mark.
        AlarmQuotation,
        /// A comment beside a text for the operator.
        CommentBesideText,
        /// A text for the operator of more than {most} characters.
        TextLength {
            /// The most that the target takes.
            most: usize,
        },
        /// A text for the operator with these characters.
        TextCharacters,
        /// Text for a device.
        DeviceText,
        /// Text for a device that the program does not open.
        DeviceNotOpened,
        /// Text for a device with these characters.
        DeviceCharacters,
        /// A value for a device with these digits.
        DeviceDigits,
        /// A value for a device that is no variable.
        DeviceValueNoVariable,
    }
}
