//! Typed access to tables that the grammar has checked. A value that it has refused is treated as
//! absent.

use std::ops::Range;

use fovqa_params::Words;
use serde_spanned::Spanned;
use toml::de::{DeTable, DeValue};

use crate::grammar::number;

/// A table of the file.
#[derive(Clone, Copy)]
pub(crate) struct Node<'a>(&'a DeTable<'a>);

impl<'a> Node<'a> {
    pub(crate) fn new(table: &'a DeTable<'a>) -> Self {
        Self(table)
    }

    pub(crate) fn value(self, key: &str) -> Option<&'a Spanned<DeValue<'a>>> {
        self.0.get(key)
    }

    /// The position of a value.
    pub(crate) fn span(self, key: &str) -> Range<usize> {
        self.value(key).map(Spanned::span).unwrap_or_default()
    }

    pub(crate) fn has(self, key: &str) -> bool {
        self.0.contains_key(key)
    }

    pub(crate) fn text(self, key: &str) -> Option<&'a str> {
        text(self.value(key)?)
    }

    /// The value of a word.
    pub(crate) fn word<T: Words>(self, key: &str) -> Option<T> {
        T::find(self.text(key)?)
    }

    pub(crate) fn flag(self, key: &str) -> Option<bool> {
        flag(self.value(key)?)
    }

    pub(crate) fn number(self, key: &str) -> Option<f64> {
        number(self.value(key)?.get_ref())
    }

    pub(crate) fn numbers(self, key: &str) -> Option<Vec<f64>> {
        numbers(self.value(key)?)
    }

    pub(crate) fn array<const N: usize>(self, key: &str) -> Option<[f64; N]> {
        self.numbers(key)?.try_into().ok()
    }

    pub(crate) fn table(self, key: &str) -> Option<Node<'a>> {
        table(self.value(key)?)
    }

    /// The tables of an array, each with its position.
    pub(crate) fn tables(self, key: &str) -> Vec<(Node<'a>, Range<usize>)> {
        let items = match self.value(key).map(Spanned::get_ref) {
            Some(DeValue::Array(items)) => items.as_ref(),
            _ => &[],
        };
        items.iter().filter_map(|item| Some((table(item)?, item.span()))).collect()
    }

    /// The names in a list, each with its position.
    pub(crate) fn names(self, key: &str) -> Option<Vec<(&'a str, Range<usize>)>> {
        let DeValue::Array(items) = self.value(key)?.get_ref() else { return None };
        Some(items.iter().filter_map(|item| Some((text(item)?, item.span()))).collect())
    }

    /// Keys and values.
    pub(crate) fn entries(
        self,
    ) -> impl Iterator<Item = (&'a str, Range<usize>, &'a Spanned<DeValue<'a>>)> {
        self.0.iter().map(|(key, value)| (key.get_ref().as_ref(), key.span(), value))
    }
}

pub(crate) fn text<'a>(value: &'a Spanned<DeValue<'a>>) -> Option<&'a str> {
    match value.get_ref() {
        DeValue::String(text) => Some(text),
        _ => None,
    }
}

pub(crate) fn flag(value: &Spanned<DeValue<'_>>) -> Option<bool> {
    match value.get_ref() {
        DeValue::Boolean(flag) => Some(*flag),
        _ => None,
    }
}

pub(crate) fn numbers(value: &Spanned<DeValue<'_>>) -> Option<Vec<f64>> {
    match value.get_ref() {
        DeValue::Array(items) => items.iter().map(|item| number(item.get_ref())).collect(),
        _ => None,
    }
}

/// A list of pairs of numbers.
pub(crate) fn pairs(value: &Spanned<DeValue<'_>>) -> Option<Vec<[f64; 2]>> {
    let DeValue::Array(items) = value.get_ref() else { return None };
    items.iter().map(|item| numbers(item)?.try_into().ok()).collect()
}

pub(crate) fn table<'a>(value: &'a Spanned<DeValue<'a>>) -> Option<Node<'a>> {
    match value.get_ref() {
        DeValue::Table(table) => Some(Node::new(table)),
        _ => None,
    }
}
