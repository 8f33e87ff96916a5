//! What glTF allows and the parser does not: scenes without nodes, animations of other things than nodes, and integers
//! written as 1.0. Tried on files that the parser refuses.

use gltf::json::Root;
use serde::Deserialize;
use serde_json::{Map, Number, Value, json};

/// The largest magnitude below which every whole binary64 number is its own integer: 2⁵³.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// Parses `json` after rewriting what glTF allows; `None` where that does not help.
pub(crate) fn parse(json: &[u8]) -> Option<Root> {
    let mut value: Value = serde_json::from_slice(json).ok()?;
    let document = value.as_object_mut()?;
    document.remove("animations");
    document.get_mut("scenes").and_then(Value::as_array_mut).into_iter().flatten().for_each(give_nodes);
    whole_numbers(&mut value);
    Root::deserialize(value).ok()
}

fn give_nodes(scene: &mut Value) {
    if let Some(scene) = scene.as_object_mut() {
        scene.entry("nodes").or_insert(json!([]));
    }
}

/// Writes whole numbers as integers; zeros with a sign keep it.
fn whole_numbers(value: &mut Value) {
    match value {
        Value::Number(number) => *number = whole(number),
        Value::Array(values) => values.iter_mut().for_each(whole_numbers),
        Value::Object(map) => Map::values_mut(map).for_each(whole_numbers),
        _ => {}
    }
}

fn whole(number: &Number) -> Number {
    match number.as_f64() {
        Some(whole) if whole.fract() == 0.0 && whole > 0.0 && whole < EXACT => Number::from(whole as u64),
        Some(zero) if zero.to_bits() == 0 => Number::from(0_u64),
        _ => number.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn allowed_forms_are_read() {
        let json = br#"{"asset":{"version":"2.0"},"scene":0.0,"scenes":[{}],"animations":[{"channels":
            [{"sampler":0,"target":{"path":"pointer"}}],"samplers":[]}],
            "nodes":[{"mesh":1.0,"translation":[-0.0,-2.0,0.5],"extras":{"receiver":true}}]}"#;
        let root = parse(json).expect("it follows glTF");
        assert_eq!(root.scene.map(|scene| scene.value()), Some(0));
        assert_eq!(root.nodes[0].mesh.map(|mesh| mesh.value()), Some(1));
        assert_eq!(root.nodes[0].translation, Some([-0.0, -2.0, 0.5]));
        assert_eq!(root.nodes[0].extras.as_ref().map(|extras| extras.get()), Some(r#"{"receiver":true}"#));
    }

    #[test]
    fn other_forms_are_not() {
        assert!(parse(br#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0.5}]}"#).is_none());
        assert!(parse(b"[]").is_none());
    }
}
