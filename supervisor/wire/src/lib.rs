//! Frames to inputs and commands.
#![no_std]
