//! `twoforms reproduce`: published results, ours beside theirs.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use twoforms_estimator::nearest::nearest;
use twoforms_report::reproduction::svg;
use twoforms_report::{ReproductionDocument, file};
use twoforms_reproduction::{self as reproduction, Hears, Reproduction, Settings, Text, Verdict, catalogue};

use super::compare::Found;
use super::experiment;
use crate::args::{Format, ReproduceArgs};
use crate::{output, run};

/// Works out what is named, or all.
fn run_all(args: &ReproduceArgs) -> Result<Found> {
    run::set_threads(&args.run)?;
    let texts = texts(args)?;
    let places = Places::new(args, &texts)?;
    let settings = Settings { quick: args.quick };
    let mut done = Vec::new();
    for (name, text) in &texts {
        let progress = |title: &str| run::note(&args.run, &format!("{name}: {title}"));
        let note = |line: &str| run::note(&args.run, line);
        let detail = |line: &str| run::detail(&args.run, line);
        match reproduction::run(name, text, settings, Hears { progress: &progress, note: &note, detail: &detail }) {
            Ok(one) => done.push(one),
            Err(error) if done.is_empty() => return Err(error.into()),
            Err(error) => {
                places.write(args, &texts[..done.len()], &done)?;
                return Err(error.into());
            }
        }
    }
    places.write(args, &texts, &done)?;
    if args.out.is_none() && args.print.format == Format::Table {
        run::note(&args.run, "note: --out DIR writes the figures, too, with the numbers as JSON and CSV");
    }
    let differs = |of: &Reproduction| of.rows().any(|row| row.verdict == Verdict::Differs);
    Ok(if args.check && done.iter().any(differs) { Found::Fault } else { Found::Nothing })
}

/// Lists, or works out what is named.
pub fn list_or_run(args: &ReproduceArgs) -> Result<Found> {
    if args.what.is_empty() && !args.all {
        output::print(&list())?;
        return Ok(Found::Nothing);
    }
    run_all(args)
}

/// Every reproduction with its title.
fn list() -> String {
    let line = |(name, text): (&str, &str)| {
        let text = Text { name: name.to_owned(), folder: None, text: text.to_owned() };
        let title = text.parse().ok().and_then(|file| file.title).unwrap_or_default();
        format!("  {name:24} {title}\n")
    };
    let lines: String = catalogue::reproductions().map(line).collect();
    format!("{lines}\ntwoforms reproduce NAME runs one, --all runs all, FILE.toml your own\n")
}

/// What is to be run, by name.
fn texts(args: &ReproduceArgs) -> Result<Vec<(String, Text)>> {
    let known: Vec<(&str, &str)> = catalogue::reproductions().collect();
    let ours = |(name, text): &(&str, &str)| {
        let text = Text { name: format!("{name}.toml"), folder: None, text: (*text).to_owned() };
        Ok(((*name).to_owned(), experiment::with_settings(&text, &args.set, &args.run)?))
    };
    if args.all {
        return known.iter().map(ours).collect();
    }
    let one = |what: &String| {
        let path = Path::new(what);
        if path.extension().is_some_and(|extension| extension == "toml") {
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            return Ok((name, experiment::with_settings(&experiment::text(path)?, &args.set, &args.run)?));
        }
        if let Some(found) = known.iter().find(|(name, _)| name == what) {
            return ours(found);
        }
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        let near = nearest(what, &names).unwrap_or_default();
        bail!("there is no reproduction \"{what}\"; did you mean \"{near}\"? (a file's name ends in .toml)")
    };
    args.what.iter().map(one).collect()
}

/// Where results go, tried before anything is computed.
struct Places {
    folder: Option<PathBuf>,
}

impl Places {
    fn new(args: &ReproduceArgs, texts: &[(String, Text)]) -> Result<Self> {
        if let Some(path) = &args.print.output {
            file::check(path)?;
        }
        if let Some(folder) = &args.out {
            file::make_folder(folder)?;
            for (k, (name, text)) in texts.iter().enumerate() {
                if texts[..k].iter().any(|(other, _)| other == name) {
                    bail!("two of the files are called {name}: write each into a folder of its own");
                }
                experiment::spare(text, &folder.join(format!("{name}.toml")))?;
            }
            for name in ["reproduce.json".to_owned(), "reproduce.csv".to_owned()]
                .into_iter()
                .chain(texts.iter().map(|(name, _)| format!("{name}.toml")))
            {
                file::check(&folder.join(name))?;
            }
        }
        Ok(Self { folder: args.out.clone() })
    }

    fn write(&self, args: &ReproduceArgs, texts: &[(String, Text)], done: &[Reproduction]) -> Result<()> {
        let document = ReproductionDocument::new(done)?;
        if let Some(folder) = &self.folder {
            file::save(&folder.join("reproduce.json"), |out| document.write_json(out))?;
            file::save(&folder.join("reproduce.csv"), |out| document.write_csv(out))?;
            for (name, text) in texts {
                output::save_text(&folder.join(format!("{name}.toml")), text)?;
            }
            done.iter().try_for_each(|done| save_figures(done, folder))?;
        }
        output::write_to(args.print.output.as_deref(), |out| match args.print.format {
            Format::Json => document.write_json(out),
            Format::Csv => document.write_csv(out),
            Format::Table => Ok(out.write_all(document.text().as_bytes())?),
        })?;
        Ok(())
    }
}

fn save_figures(done: &Reproduction, folder: &Path) -> Result<()> {
    let plots = done.sections.iter().flat_map(|section| &section.plots);
    for (k, plot) in plots.enumerate() {
        if let Some(svg) = svg(plot) {
            let path = folder.join(format!("{}-{}.svg", done.name, k + 1));
            file::save(&path, |out| Ok(out.write_all(svg.as_bytes())?))?;
        }
    }
    Ok(())
}
