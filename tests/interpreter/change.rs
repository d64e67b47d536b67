//! Tool changes: what the control does at them, and the zero of Z that an operator sets by the tool that is put in.

use super::{Halt, Machine, What};

impl Machine {
    /// The tool change of a Haas: spindle and coolant off, Z to machine zero, then the change (reference guide, M06).
    pub fn change_up_there(&mut self) -> Result<(), Halt> {
        self.switch_off();
        let mut up = self.at;
        up[2] = 0.0;
        (self.by_itself.z, self.by_itself.moves) = (true, true);
        self.traverse(up);
        self.by_itself.moves = false;
        self.change_tool()
    }

    /// The tool change.
    pub fn change_tool(&mut self) -> Result<(), Halt> {
        if self.beside.is_some() {
            return self.halt("a tool change under cutter radius compensation");
        }
        let Some(tool) = self.selected else { return self.halt("a tool change and no tool selected") };
        self.tool = Some(tool);
        self.record(What::Tool(tool));
        self.zero_moved = (self.setup.put_in)(tool);
        Ok(())
    }
}
