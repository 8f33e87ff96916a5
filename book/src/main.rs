//! `book`: mdBook's preprocessor (a book on standard input), and `book check FOLDER`, which looks for broken links in a built one.

use std::io::{self, Read};
use std::path::Path;
use std::process::ExitCode;

use twoforms_book::{html, preprocessor};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words[..] {
        [] => prepare(),
        ["supports", renderer] => return ExitCode::from(u8::from(renderer != "html")),
        ["check", folder] => check(Path::new(folder)),
        _ => Err("usage: book | book supports RENDERER | book check FOLDER".into()),
    };
    done.map_or_else(
        |error| {
            eprintln!("book: {error}");
            ExitCode::FAILURE
        },
        |()| ExitCode::SUCCESS,
    )
}

fn prepare() -> Result<(), String> {
    let input = io::read_to_string(io::stdin().lock().by_ref()).map_err(|error| error.to_string())?;
    println!("{}", preprocessor::prepared(&input).map_err(|error| error.to_string())?);
    Ok(())
}

fn check(folder: &Path) -> Result<(), String> {
    let broken = html::broken(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    if broken.is_empty() { Ok(()) } else { Err(format!("links that lead nowhere:\n{}", broken.join("\n"))) }
}
