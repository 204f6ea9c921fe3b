//! The templates of all pages: each stands in the same head, and works offline.

use minijinja::value::Serde;
use minijinja::{AutoEscape, Environment};
use serde_json::Value;

const BASE: &str = include_str!("../templates/base.html");
const STYLE: &str = include_str!("../templates/style.css");

/// Fills a template that extends `base`.
///
/// # Errors
/// The template does not render.
pub fn render(template: &str, mut context: Value) -> Result<String, minijinja::Error> {
    if let Some(context) = context.as_object_mut() {
        context.insert("style".to_owned(), STYLE.into());
        context.insert("version".to_owned(), env!("CARGO_PKG_VERSION").into());
    }
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.add_template("base", BASE)?;
    environment.add_template("page", template)?;
    environment.get_template("page")?.render(Serde(context))
}

/// Fills a template that stands alone, such as a picture.
///
/// # Errors
/// The template does not render.
pub fn fill(template: &str, context: Value) -> Result<String, minijinja::Error> {
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.add_template("alone", template)?;
    environment.get_template("alone")?.render(Serde(context))
}
