//! A reader of the JSON that the scenes use: no escapes but \" in texts. It spares the crate every dependency.
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Index;

#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Null,
    Bool(bool),
    Number(f64),
    Text(String),
    Array(Vec<Value>),
    Object(BTreeMap<String, Value>),
}

static NULL: Value = Value::Null;

impl Value {
    pub fn parse(text: &str) -> Value {
        Parser {
            text: text.as_bytes(),
            at: 0,
        }
        .value()
    }
    pub fn get(&self, key: &str) -> Option<&Value> {
        self.as_object()?.get(key)
    }
    pub fn is_null(&self) -> bool {
        *self == Value::Null
    }
    pub fn as_str(&self) -> Option<&str> {
        if let Value::Text(text) = self {
            Some(text)
        } else {
            None
        }
    }
    pub fn as_f64(&self) -> Option<f64> {
        if let Value::Number(number) = self {
            Some(*number)
        } else {
            None
        }
    }
    pub fn as_u64(&self) -> Option<u64> {
        self.as_f64().map(|number| number as u64)
    }
    pub fn as_i64(&self) -> Option<i64> {
        self.as_f64().map(|number| number as i64)
    }
    pub fn as_array(&self) -> Option<&Vec<Value>> {
        if let Value::Array(list) = self {
            Some(list)
        } else {
            None
        }
    }
    pub fn as_object(&self) -> Option<&BTreeMap<String, Value>> {
        if let Value::Object(map) = self {
            Some(map)
        } else {
            None
        }
    }
}
impl Index<&str> for Value {
    type Output = Value;
    fn index(&self, key: &str) -> &Value {
        self.get(key).unwrap_or(&NULL)
    }
}
impl PartialEq<&str> for Value {
    fn eq(&self, other: &&str) -> bool {
        self.as_str() == Some(other)
    }
}
impl PartialEq<bool> for Value {
    fn eq(&self, other: &bool) -> bool {
        *self == Value::Bool(*other)
    }
}
impl PartialEq<i32> for Value {
    fn eq(&self, other: &i32) -> bool {
        self.as_f64() == Some(f64::from(*other))
    }
}
impl fmt::Display for Value {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{self:?}")
    }
}

struct Parser<'a> {
    text: &'a [u8],
    at: usize,
}
impl Parser<'_> {
    fn peek(&mut self) -> u8 {
        while self.text[self.at].is_ascii_whitespace() {
            self.at += 1;
        }
        self.text[self.at]
    }
    /// Skips a separator or the closing bracket; says whether more entries follow.
    fn more(&mut self, close: u8) -> bool {
        let c = self.peek();
        if c == b',' || c == close {
            self.at += 1;
        }
        c != close
    }
    fn string(&mut self) -> String {
        self.at += 1;
        let mut out = Vec::new();
        while self.text[self.at] != b'"' {
            self.at += usize::from(self.text[self.at] == b'\\');
            out.push(self.text[self.at]);
            self.at += 1;
        }
        self.at += 1;
        String::from_utf8(out).unwrap()
    }
    fn value(&mut self) -> Value {
        match self.peek() {
            b'{' => {
                self.at += 1;
                let mut map = BTreeMap::new();
                while self.more(b'}') {
                    self.peek();
                    let key = self.string();
                    assert_eq!(self.peek(), b':');
                    self.at += 1;
                    map.insert(key, self.value());
                }
                Value::Object(map)
            }
            b'[' => {
                self.at += 1;
                let mut list = Vec::new();
                while self.more(b']') {
                    list.push(self.value());
                }
                Value::Array(list)
            }
            b'"' => Value::Text(self.string()),
            _ => {
                let begin = self.at;
                while self.at < self.text.len() && !b",]} \n\r\t".contains(&self.text[self.at]) {
                    self.at += 1;
                }
                match std::str::from_utf8(&self.text[begin..self.at]).unwrap() {
                    "null" => Value::Null,
                    "true" => Value::Bool(true),
                    "false" => Value::Bool(false),
                    number => Value::Number(
                        number
                            .parse()
                            .unwrap_or_else(|_| panic!("not JSON: {number}")),
                    ),
                }
            }
        }
    }
}
