//! `supervise` from outside: the binary, its files, its exit codes.

mod built;
mod commands;
mod common;
mod evidence;
mod prove;
mod replay;
mod robust;
mod simulate;
mod trace;
