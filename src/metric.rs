//! m
#![forbid(unsafe_code)]
