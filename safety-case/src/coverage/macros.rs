//! The macros whose arguments are conditions or expressions; every other one is left out, and said.

use syn::parse::{ParseStream, Parser};
use syn::visit::Visit;
use syn::{Expr, Token};

use super::instrument::Walk;

/// Macros whose arguments are plain expressions.
const PLAIN: [&str; 1] = ["channel"];

impl Walk<'_> {
    /// The expression of `matches!`.
    pub(super) fn matched(&mut self, mac: &syn::Macro) {
        let parts = |input: ParseStream| {
            let (value, _): (Expr, Token![,]) = (input.parse()?, input.parse()?);
            Ok((
                value,
                syn::Pat::parse_multi_with_leading_vert(input)?,
                input.is_empty() || input.peek(Token![,]),
                input.parse::<proc_macro2::TokenStream>()?,
            ))
        };
        match parts.parse2(mac.tokens.clone()) {
            Ok((value, _, whole, _)) => {
                self.visit_expr(&value);
                if !whole {
                    self.left_out(mac, "the guard of matches!".to_owned());
                }
            }
            Err(error) => self.left_out(mac, format!("matches!: {error}")),
        }
    }

    /// `condition => reason, ..`: each condition is a decision that branches.
    fn permit(&mut self, mac: &syn::Macro) {
        let pairs = |input: ParseStream| {
            let mut pairs: Vec<(Expr, Expr)> = Vec::new();
            while !input.is_empty() {
                let condition = input.parse()?;
                input.parse::<Token![=>]>()?;
                pairs.push((condition, input.parse()?));
                input.parse::<Option<Token![,]>>()?;
            }
            Ok(pairs)
        };
        match pairs.parse2(mac.tokens.clone()) {
            Ok(pairs) => {
                for (condition, reason) in &pairs {
                    self.decision(condition, true);
                    self.visit_expr(reason);
                }
            }
            Err(error) => self.left_out(mac, format!("permit!: {error}")),
        }
    }

    pub(super) fn called(&mut self, mac: &syn::Macro) {
        let name = mac.path.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default();
        if name == "permit" {
            self.permit(mac);
        } else if PLAIN.contains(&name.as_str()) {
            let list = syn::punctuated::Punctuated::<Expr, Token![,]>::parse_terminated;
            match list.parse2(mac.tokens.clone()) {
                Ok(list) => list.iter().for_each(|argument| self.visit_expr(argument)),
                Err(error) => self.left_out(mac, format!("{name}!: {error}")),
            }
        } else {
            self.left_out(mac, format!("{name}!"));
        }
    }
}
