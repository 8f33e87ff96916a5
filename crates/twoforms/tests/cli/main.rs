//! The command line from outside: exit codes, messages, what is printed and what is written.

mod book;
mod check;
mod compare;
mod csv;
mod exact;
mod files;
mod help;
mod inspect;
mod json;
mod page;
mod receivers;
mod refusals;
mod render;
mod reproduce;
mod strategies;
mod streams;
mod support;
mod usage;
