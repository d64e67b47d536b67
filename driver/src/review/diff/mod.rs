//! Do two programs make the same cut? If not, what differs: [`motion`] finds it, [`tell`] has one account of it, which
//! [`html`] and [`json`] lay out.

pub mod html;
pub mod json;
pub mod motion;
pub mod tell;
