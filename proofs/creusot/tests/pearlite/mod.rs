//! Reads the contracts out of a source file and evaluates their text on numbers, as far as the kernels' contracts need it.

use pearlite_syn::Term;
use syn::{
    Attribute, BinOp, Expr, FnArg, Ident, Item, Lit, Member, Pat, Token, Visibility, parenthesized,
    parse::{Parse, ParseStream},
};

/// A value in a contract. The `@` of a machine integer is its number, so both are one here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Value {
    Number(i128),
    Truth(bool),
    Tuple(Vec<Value>),
}

/// One public function with what it demands and what it promises.
pub struct Contract {
    pub name: String,
    pub terminates: bool,
    parameters: Vec<String>,
    requires: Vec<Term>,
    ensures: Vec<Term>,
}

/// Every public function of `source`, in its order.
pub fn contracts(source: &str) -> Vec<Contract> {
    let file = syn::parse_file(source).expect("a source file");
    file.items.iter().filter_map(Contract::of).collect()
}

impl Contract {
    fn of(item: &Item) -> Option<Self> {
        let Item::Fn(function) = item else { return None };
        let Visibility::Public(_) = function.vis else { return None };
        let mut contract = Self {
            name: function.sig.ident.to_string(),
            terminates: false,
            parameters: function.sig.inputs.iter().map(parameter).collect(),
            requires: Vec::new(),
            ensures: Vec::new(),
        };
        for Clause { kind, tokens } in function.attrs.iter().filter_map(Clause::of) {
            let term = || syn::parse2(tokens.clone()).expect("a Pearlite term");
            match kind.to_string().as_str() {
                "requires" => contract.requires.push(term()),
                "ensures" => contract.ensures.push(term()),
                "check" => contract.terminates |= tokens.to_string() == "terminates",
                _ => {}
            }
        }
        Some(contract)
    }

    /// Whether the caller may call with these arguments.
    pub fn demands_hold(&self, arguments: &[i128]) -> bool {
        let scope = self.scope(arguments, None);
        self.requires.iter().all(|term| scope.truth(term))
    }

    /// How many promises there are.
    pub fn promises(&self) -> usize {
        self.ensures.len()
    }

    /// Which promises hold of this result.
    pub fn kept(&self, arguments: &[i128], result: &Value) -> Vec<bool> {
        let scope = self.scope(arguments, Some(result));
        self.ensures.iter().map(|term| scope.truth(term)).collect()
    }

    fn scope<'a>(&'a self, arguments: &[i128], result: Option<&'a Value>) -> Scope<'a> {
        assert_eq!(arguments.len(), self.parameters.len(), "{}", self.name);
        Scope { names: &self.parameters, values: arguments.to_vec(), result }
    }
}

fn parameter(argument: &FnArg) -> String {
    match argument {
        FnArg::Typed(typed) => match &*typed.pat {
            Pat::Ident(name) => name.ident.to_string(),
            other => panic!("not a plain parameter: {other:?}"),
        },
        FnArg::Receiver(_) => panic!("a kernel is no method"),
    }
}

/// `kind(tokens)`, as it stands or under `cfg_attr(creusot, ..)`.
struct Clause {
    kind: Ident,
    tokens: proc_macro2::TokenStream,
}

impl Clause {
    fn of(attribute: &Attribute) -> Option<Self> {
        let list = attribute.meta.require_list().ok()?;
        if attribute.path().is_ident("cfg_attr") {
            return attribute.parse_args_with(Self::conditional).ok();
        }
        Some(Self { kind: list.path.get_ident()?.clone(), tokens: list.tokens.clone() })
    }

    fn conditional(input: ParseStream<'_>) -> syn::Result<Self> {
        let condition: Ident = input.parse()?;
        assert_eq!(condition, "creusot", "contracts are for Creusot alone");
        input.parse::<Token![,]>()?;
        let kind = input.parse()?;
        let content;
        parenthesized!(content in input);
        Ok(Self { kind, tokens: proc_macro2::TokenStream::parse(&content)? })
    }
}

/// The names that a contract may speak of.
struct Scope<'a> {
    names: &'a [String],
    values: Vec<i128>,
    result: Option<&'a Value>,
}

impl Scope<'_> {
    fn truth(&self, term: &Term) -> bool {
        match self.value(term) {
            Value::Truth(truth) => truth,
            other => panic!("not a statement: {other:?}"),
        }
    }

    fn number(&self, term: &Term) -> i128 {
        match self.value(term) {
            Value::Number(number) => number,
            other => panic!("not a number: {other:?}"),
        }
    }

    fn value(&self, term: &Term) -> Value {
        match term {
            Term::Impl(implication) => Value::Truth(!self.truth(&implication.hyp) || self.truth(&implication.cons)),
            Term::Binary(binary) => self.binary(&binary.left, binary.op, &binary.right),
            Term::View(view) => self.value(&view.term),
            Term::Paren(paren) => self.value(&paren.expr),
            Term::Lit(literal) => match &literal.lit {
                Lit::Int(number) => Value::Number(number.base10_parse().expect("a number")),
                other => panic!("not a number: {other:?}"),
            },
            Term::Field(field) => match (self.value(&field.base), &field.member) {
                (Value::Tuple(fields), Member::Unnamed(place)) => fields[usize::try_from(place.index).unwrap()].clone(),
                (base, _) => panic!("no such field of {base:?}"),
            },
            Term::Path(path) => self.named(&Expr::Path(path.inner.clone())),
            other => panic!("this evaluator does not know {other:?}"),
        }
    }

    fn named(&self, path: &Expr) -> Value {
        let Expr::Path(path) = path else { panic!("not a path") };
        let words: Vec<String> = path.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
            ["u8", "MAX"] => Value::Number(u8::MAX.into()),
            ["u16", "MAX"] => Value::Number(u16::MAX.into()),
            ["u32", "MAX"] => Value::Number(u32::MAX.into()),
            ["result"] => self.result.expect("a demand speaks of no result").clone(),
            [name] => match self.names.iter().position(|known| known == name) {
                Some(place) => Value::Number(self.values[place]),
                None => panic!("nothing is called {name}"),
            },
            _ => panic!("nothing is called {words:?}"),
        }
    }

    fn binary(&self, left: &Term, op: BinOp, right: &Term) -> Value {
        let numbers = || (self.number(left), self.number(right));
        let compared = |holds: fn(&i128, &i128) -> bool| {
            let (left, right) = numbers();
            Value::Truth(holds(&left, &right))
        };
        // The tests build with overflow checks: a number that leaves 128 bits is seen.
        let computed = |compute: fn(i128, i128) -> i128| {
            let (left, right) = numbers();
            Value::Number(compute(left, right))
        };
        match op {
            BinOp::And(_) => Value::Truth(self.truth(left) && self.truth(right)),
            BinOp::Or(_) => Value::Truth(self.truth(left) || self.truth(right)),
            BinOp::Eq(_) => Value::Truth(self.value(left) == self.value(right)),
            BinOp::Lt(_) => compared(i128::lt),
            BinOp::Le(_) => compared(i128::le),
            BinOp::Gt(_) => compared(i128::gt),
            BinOp::Ge(_) => compared(i128::ge),
            BinOp::Add(_) => computed(|left, right| left + right),
            BinOp::Sub(_) => computed(|left, right| left - right),
            BinOp::Mul(_) => computed(|left, right| left * right),
            other => panic!("this evaluator does not know {other:?}"),
        }
    }
}
