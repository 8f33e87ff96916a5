//! Fields of a file set from outside: `key=value`.

use toml_edit::{ArrayOfTables, DocumentMut, Item, Table, Value};

use crate::reading::{Error, Text, hint};

/// Keys that belong to the file and not to an experiment.
const OF_FILE: [&str; 5] = ["title", "source", "derivation", "seed", "detects"];

impl Text {
    /// The same text with fields set: `replicates=100`, `experiment.2.row.1.samples=4`. A key of experiments is set in all of
    /// them, unless its path counts one out, from 1. What is no TOML value is a string. All else stays where it is, comments too.
    ///
    /// # Errors
    /// Where the text is wrong, a path leads nowhere, or a key cannot have its value.
    pub fn with(&self, settings: &[String]) -> Result<Self, Error> {
        self.parse()?;
        settings.iter().try_fold(self.clone(), |text, setting| text.with_one(setting))
    }

    fn with_one(&self, setting: &str) -> Result<Self, Error> {
        let wrong = |message: String| Error { place: format!("-D {setting}"), message };
        let (key, value) = setting.split_once('=').ok_or_else(|| wrong("the form is key=value".into()))?;
        let mut document: DocumentMut = self.text.parse().map_err(|error| wrong(format!("{error}")))?;
        set(document.as_table_mut(), key.trim(), &parsed(value.trim())).map_err(wrong)?;
        let text = Self { text: document.to_string(), ..self.clone() };
        text.parse().map_err(|error| wrong(error.message))?;
        Ok(text)
    }
}

fn parsed(value: &str) -> Value {
    value.parse().unwrap_or_else(|_| Value::from(value))
}

fn set(file: &mut Table, key: &str, value: &Value) -> Result<(), String> {
    if OF_FILE.contains(&key) || key.starts_with("experiment.") {
        return set_below(file, key, value);
    }
    let experiments = file.get_mut("experiment").and_then(Item::as_array_of_tables_mut);
    let experiments = experiments.ok_or("the file has no [[experiment]]")?;
    experiments.iter_mut().try_for_each(|experiment| set_below(experiment, key, value))
}

/// Sets what a path leads to: `row.2.samples` counts tables from 1.
fn set_below(table: &mut Table, path: &str, value: &Value) -> Result<(), String> {
    let Some((head, rest)) = path.split_once('.') else { return set_here(table, path, value) };
    let known: Vec<String> = table.iter().map(|(key, _)| key.to_owned()).collect();
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    match table.get_mut(head) {
        Some(Item::ArrayOfTables(tables)) => {
            let (counted, path) = counted(head, rest, tables)?;
            set_below(counted, path, value)
        }
        Some(item) if item.is_table_like() => {
            item[rest] = Item::Value(value.clone());
            Ok(())
        }
        Some(_) => Err(format!("\"{head}\" holds no table: set all of it, as {head}=…")),
        None => Err(format!("there is no table \"{head}\"{}", hint(head, &known))),
    }
}

/// The table that a path counts out, and the path within it.
fn counted<'t, 'p>(
    name: &str,
    path: &'p str,
    tables: &'t mut ArrayOfTables,
) -> Result<(&'t mut Table, &'p str), String> {
    let (number, path) = path.split_once('.').ok_or_else(|| format!("one is counted out as {name}.1.key"))?;
    let place = number.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
    let count = tables.len();
    let table = place.and_then(|place| tables.get_mut(place));
    table.map(|table| (table, path)).ok_or_else(|| format!("\"{number}\" counts out no {name}: there are 1 to {count}"))
}

/// Sets a key; one that is new goes before the table's own tables.
fn set_here(table: &mut Table, key: &str, value: &Value) -> Result<(), String> {
    match table.get_mut(key) {
        Some(Item::Value(old)) => {
            let decor = old.decor().clone();
            *old = value.clone();
            *old.decor_mut() = decor;
        }
        Some(_) => return Err(format!("\"{key}\" holds tables: set a key within one")),
        None => drop(table.insert(key, Item::Value(value.clone()))),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::reading::Text;

    fn text(text: &str) -> Text {
        Text { name: "f.toml".into(), folder: None, text: text.into() }
    }

    #[test]
    fn fields_are_set_in_all_experiments_or_in_one() {
        let two = text("[[experiment]]\nvalues = [1]\n[[experiment]]\nvalues = [2]\nreplicates = 3\n");
        let settings = ["replicates=70", "experiment.2.values=[5, 6]", "seed=9", "title=a b"].map(str::to_owned);
        let file = two.with(&settings).expect("settings").parse().expect("a file");
        let [one, other] = [0, 1].map(|k| file.experiment[k].get_ref().clone());
        assert_eq!((file.seed, file.title.as_deref()), (9, Some("a b")));
        assert_eq!(one.replicates, Some(70));
        assert_eq!((one.values, other.values), (Some(vec![1.0]), Some(vec![5.0, 6.0])));
    }

    #[test]
    fn what_is_not_set_stays_as_it_was_written() {
        let one = text("# mine\n[[experiment]]\nvalues = [1, 2] # faces\n[[experiment.row]]\nquantity = \"mean\"\n");
        let settings = ["seed=3", "values=[4]", "replicates=9", "experiment.1.row.1.note=n"].map(str::to_owned);
        let set = one.with(&settings).expect("settings");
        let expected = "seed = 3\n# mine\n[[experiment]]\nvalues = [4] # faces\nreplicates = 9\n\
                        [[experiment.row]]\nquantity = \"mean\"\nnote = \"n\"\n";
        assert_eq!(set.text.replace("\n\n", "\n"), expected);
    }

    #[test]
    fn paths_that_lead_nowhere_are_told() {
        let one = text("[[experiment]]\nvalues = [1]\n");
        let said = |setting: &str| one.with(&[setting.to_owned()]).expect_err(setting).to_string();
        assert_eq!(said("replicates"), "-D replicates: the form is key=value");
        assert_eq!(
            said("experiment.3.values=[1]"),
            "-D experiment.3.values=[1]: \"3\" counts out no experiment: there are 1 to 1"
        );
        assert_eq!(said("replicats=7"), "-D replicats=7: unknown key \"replicats\"; did you mean \"replicates\"?");
        assert!(
            said("samples=[0]").starts_with("-D samples=[0]: needs whole numbers from 1"),
            "{}",
            said("samples=[0]")
        );
        assert!(said("experiment=3").contains("holds tables") || said("experiment=3").contains("unknown"));
    }
}
