//! The service over sockets: what the sources list, and what nobody should be able to do.
#![allow(clippy::print_stdout, reason = "a test that is skipped says so")]
mod access;
mod attacks;
mod backup;
mod book;
mod client;
mod dialects;
mod hooks;
mod jobs;
mod limits;
mod machines;
mod names;
mod observe;
mod outputs;
mod parts;
mod programs;
mod search;
mod studio;
mod study;
mod tables;
mod translations;
