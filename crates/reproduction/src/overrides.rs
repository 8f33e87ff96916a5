//! Fields of a file set from outside: `key=value`.

use toml::{Table, Value};

use crate::reading::{Error, Text, hint};

/// Keys that belong to the file and not to an experiment.
const OF_FILE: [&str; 5] = ["title", "source", "derivation", "seed", "detects"];

impl Text {
    /// The same text with fields set: `replicates=100`, `experiment.2.samples=[1, 4]`. A key of experiments is set in all of them,
    /// unless its path counts one out, from 1. What is no TOML value is a string.
    ///
    /// # Errors
    /// Where the text is no TOML, or a path leads nowhere.
    pub fn with(&self, settings: &[String]) -> Result<Self, Error> {
        if settings.is_empty() {
            return Ok(self.clone());
        }
        let mut table: Table = self.read()?;
        for setting in settings {
            let wrong = |message: String| Error { place: format!("-D {setting}"), message };
            let (key, value) = setting.split_once('=').ok_or_else(|| wrong("the form is key=value".into()))?;
            set(&mut table, key.trim(), &parsed(value.trim())).map_err(wrong)?;
        }
        let text =
            toml::to_string(&table).map_err(|error| Error { place: self.name.clone(), message: error.to_string() })?;
        Ok(Self { name: format!("{} with -D", self.name), text, ..self.clone() })
    }
}

fn parsed(value: &str) -> Value {
    let table = toml::from_str::<Table>(&format!("value = {value}")).ok();
    table.and_then(|mut table| table.remove("value")).unwrap_or_else(|| Value::String(value.to_owned()))
}

fn set(table: &mut Table, key: &str, value: &Value) -> Result<(), String> {
    if OF_FILE.contains(&key) && !key.contains('.') {
        table.insert(key.to_owned(), value.clone());
        return Ok(());
    }
    let experiments = table.get_mut("experiment").and_then(Value::as_array_mut).ok_or("the file has no experiment")?;
    let (chosen, path) = match key.strip_prefix("experiment.") {
        None => (None, key),
        Some(rest) => {
            let (number, path) = rest.split_once('.').ok_or("an experiment is counted out as experiment.1.key")?;
            let number: usize = number.parse().map_err(|_| format!("\"{number}\" is no number of an experiment"))?;
            (Some(number), path)
        }
    };
    let count = experiments.len();
    if chosen.is_some_and(|number| !(1..=count).contains(&number)) {
        return Err(format!("the file counts its experiments from 1 to {count}"));
    }
    for (k, experiment) in experiments.iter_mut().enumerate() {
        if chosen.is_none_or(|number| number == k + 1) {
            let experiment = experiment.as_table_mut().ok_or("an experiment is no table")?;
            set_below(experiment, path, value)?;
        }
    }
    Ok(())
}

fn set_below(table: &mut Table, path: &str, value: &Value) -> Result<(), String> {
    let Some((head, rest)) = path.split_once('.') else {
        table.insert(path.to_owned(), value.clone());
        return Ok(());
    };
    let known: Vec<String> = table.keys().cloned().collect();
    let below = table.get_mut(head).and_then(Value::as_table_mut);
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    set_below(below.ok_or_else(|| format!("there is no table \"{head}\"{}", hint(head, &known)))?, rest, value)
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
        assert_eq!(one.replicates.map(toml::Spanned::into_inner), Some(70));
        assert_eq!((one.values, other.values), (Some(vec![1.0]), Some(vec![5.0, 6.0])));
    }

    #[test]
    fn paths_that_lead_nowhere_are_told() {
        let one = text("[[experiment]]\nvalues = [1]\n");
        let error = |setting: &str| one.with(&[setting.to_owned()]).and_then(|text| text.parse()).map(|_| ());
        let said = |setting: &str| error(setting).expect_err(setting).to_string();
        assert_eq!(said("replicates"), "-D replicates: the form is key=value");
        assert_eq!(
            said("experiment.3.values=[1]"),
            "-D experiment.3.values=[1]: the file counts its experiments from 1 to 1"
        );
        assert!(said("replicats=7").contains("did you mean \"replicates\"?"), "{}", said("replicats=7"));
    }
}
