//! JSON as text that a person can read: arrays of plain values stay on one line.

use serde_json::Value;

/// The value over several lines, indented by two blanks, ending in a newline.
pub fn pretty(value: &Value) -> String {
    let mut text = String::new();
    write(value, "\n", &mut text);
    text.push('\n');
    text
}

/// Appends the value; `line` is the line break with the indentation that it stands in.
fn write(value: &Value, line: &str, text: &mut String) {
    match value {
        Value::Array(items) if items.iter().all(is_plain) => inline(items, text),
        Value::Array(items) => {
            let items = items.iter().map(|item| (String::new(), item));
            block(items, ['[', ']'], line, text);
        }
        Value::Object(fields) => {
            let fields = fields.iter().map(|(key, value)| (format!("{}: ", quoted(key)), value));
            block(fields, ['{', '}'], line, text);
        }
        plain => text.push_str(&plain.to_string()),
    }
}

fn is_plain(value: &Value) -> bool {
    !value.is_array() && !value.is_object()
}

fn quoted(key: &str) -> String {
    Value::from(key).to_string()
}

fn inline(items: &[Value], text: &mut String) {
    let items: Vec<String> = items.iter().map(Value::to_string).collect();
    text.push('[');
    text.push_str(&items.join(", "));
    text.push(']');
}

fn block<'a>(
    items: impl Iterator<Item = (String, &'a Value)>,
    [open, close]: [char; 2],
    line: &str,
    text: &mut String,
) {
    let inner = format!("{line}  ");
    text.push(open);
    for (i, (key, value)) in items.enumerate() {
        text.push_str(if i == 0 { "" } else { "," });
        text.push_str(&inner);
        text.push_str(&key);
        write(value, &inner, text);
    }
    text.push_str(line);
    text.push(close);
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn plain_arrays_stay_on_one_line() {
        let value = json!({"a": [1.5, 2], "b": {"c": [[1], [2]], "d": "x\"y"}});
        let text = "{\n  \"a\": [1.5, 2],\n  \"b\": {\n    \"c\": [\n      [1],\n      [2]\n    ],\n    \"d\": \"x\\\"y\"\n  }\n}\n";
        assert_eq!(pretty(&value), text);
        assert_eq!(text.parse::<Value>().ok(), Some(value));
    }
}
