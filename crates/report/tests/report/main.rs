//! What people, scripts and viewers get to see, from documents and images made by hand.

mod document;
mod files;
mod images;
mod summary;
mod support;
mod table;
