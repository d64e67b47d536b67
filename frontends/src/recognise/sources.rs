//! Titles of the manuals that the signs are taken from, as a dictionary names them under `[sources]`.

pub(super) const FANUC_T: &str = "FANUC operator's manual for lathes, B-64604EN-1, G code lists A, B, C";
pub(super) const HAAS_T: &str = "Haas lathe operator's manual 96-8910, G codes";
pub(super) const SIEMENS_T: &str = "SINUMERIK 828D/840D sl turning, programming manual, cycles";
pub(super) const LINUXCNC_T: &str = "LinuxCNC user manual, lathe; G codes G7, G8, G76";
pub(super) const HEIDENHAIN: &str =
    "HEIDENHAIN TNC 640, user's manual for conversational and DIN/ISO programming";
pub(super) const OKUMA: &str = "OKUMA OSP-P200/P300, programming manuals; user tasks";
pub(super) const MAZATROL: &str = "MAZAK, Mazatrol programming manuals";
pub(super) const EDM: &str = "Mitsubishi, Sodick, FANUC and Charmilles wire EDM programming manuals";
pub(super) const MARLIN: &str = "Marlin firmware, G code index; comments of slicers";
pub(super) const WRITTEN: &str = "how milling programs are written";
