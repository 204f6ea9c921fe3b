//! Diagnosis.
#![no_std]
