//! What an expression is by its form, and where it stands.

use std::ops::Range;

use syn::spanned::Spanned;
use syn::{Attribute, BinOp, Block, Expr, UnOp};

pub(super) fn range(of: &impl Spanned) -> Range<usize> {
    of.span().byte_range()
}

/// Behind the brace that opens it.
pub(super) fn inside(block: &Block) -> usize {
    block.brace_token.span.open().byte_range().end
}

/// Not compiled here: proofs, contracts, fuzzers, tests.
pub(super) fn is_elsewhere(attribute: &Attribute) -> bool {
    let words = |list: &syn::MetaList| list.tokens.to_string();
    attribute.path().is_ident("cfg")
        && attribute
            .meta
            .require_list()
            .is_ok_and(|list| ["kani", "creusot", "fuzzing", "test"].iter().any(|word| words(list).contains(word)))
}

/// Boolean by its form.
pub(super) fn is_boolean(expression: &Expr) -> bool {
    let joins_or_compares = |of: &BinOp| {
        matches!(of, BinOp::And(_) | BinOp::Or(_) | BinOp::Eq(_) | BinOp::Ne(_))
            || matches!(of, BinOp::Lt(_) | BinOp::Le(_) | BinOp::Gt(_) | BinOp::Ge(_))
    };
    if let Expr::Paren(inner) = expression {
        is_boolean(&inner.expr)
    } else if let Expr::Unary(not) = expression {
        matches!(not.op, UnOp::Not(_))
    } else if let Expr::Binary(both) = expression {
        joins_or_compares(&both.op)
    } else {
        matches!(expression, Expr::Macro(called) if called.mac.path.is_ident("matches"))
    }
}

/// Has branches of its own, or returns by itself.
pub(super) fn is_structured(expression: &Expr) -> bool {
    matches!(expression, Expr::If(_) | Expr::Match(_) | Expr::Block(_) | Expr::Return(_) | Expr::Macro(_))
        && !is_boolean(expression)
}

/// Binds by a pattern.
pub(super) fn has_let(condition: &Expr) -> bool {
    matches!(condition, Expr::Let(_))
        || matches!(condition, Expr::Binary(both)
            if matches!(both.op, BinOp::And(_)) && (has_let(&both.left) || has_let(&both.right)))
}
