//! Evaluates every contract, as it stands in the source, on all combinations of edge values: it holds of the function's
//! result, each of its promises can fail, and together they admit no other result.

mod pearlite;

use pearlite::{Contract, Value, contracts};
use supervisor_creusot::{consequences::*, kernel::*};

/// A result as a value, and results beside it that would be wrong.
trait Outcome: Copy {
    fn value(self) -> Value;
    fn others(self) -> Vec<Value>;
}

impl Outcome for bool {
    fn value(self) -> Value {
        Value::Truth(self)
    }
    fn others(self) -> Vec<Value> {
        vec![Value::Truth(!self)]
    }
}

macro_rules! numbers {
    ($($type:ty)+) => {$(
        impl Outcome for $type {
            fn value(self) -> Value {
                Value::Number(self.into())
            }
            fn others(self) -> Vec<Value> {
                let near = [self.checked_sub(1), self.checked_add(1), Some(0), Some(<$type>::MAX)];
                near.into_iter().flatten().filter(|other| *other != self).map(Outcome::value).collect()
            }
        }
    )+};
}
numbers!(u8 u16 u32 u64);

impl<A: Outcome, B: Outcome> Outcome for (A, B) {
    fn value(self) -> Value {
        Value::Tuple(vec![self.0.value(), self.1.value()])
    }
    /// Either changes alone, or both at once.
    fn others(self) -> Vec<Value> {
        let (first, second) = (self.0.value(), self.1.value());
        let (firsts, seconds) = (self.0.others(), self.1.others());
        let pair = |first: &Value, second: &Value| Value::Tuple(vec![first.clone(), second.clone()]);
        let mut others: Vec<Value> = firsts.iter().map(|other| pair(other, &second)).collect();
        others.extend(seconds.iter().map(|other| pair(&first, other)));
        others.extend(firsts.iter().flat_map(|first| seconds.iter().map(move |second| pair(first, second))));
        others
    }
}

impl Outcome for (u32, u32, u16, u16) {
    fn value(self) -> Value {
        Value::Tuple(vec![self.0.value(), self.1.value(), self.2.value(), self.3.value()])
    }
    fn others(self) -> Vec<Value> {
        vec![(self.0 ^ 1, self.1, self.2, self.3).value(), (self.0, self.1, self.2, self.3 ^ 1).value()]
    }
}

/// A function as the tests call it: with numbers that fit its parameters.
struct Function {
    name: &'static str,
    greatest: Vec<i128>,
    call: fn(&[i128]) -> (Value, Vec<Value>),
    /// For which arguments the contract leaves no other result.
    fixed: fn(&[i128]) -> bool,
}

macro_rules! functions {
    ($($name:ident($($type:ty),+) $(fixed for $fixed:expr)?;)+) => {
        vec![$(Function {
            name: stringify!($name),
            greatest: vec![$(<$type>::MAX.into()),+],
            call: |numbers| {
                let mut numbers = numbers.iter().copied();
                let result = $name($(<$type>::try_from(numbers.next().unwrap()).unwrap()),+);
                (result.value(), result.others())
            },
            fixed: functions!(@fixed $($fixed)?),
        }),+]
    };
    (@fixed) => { |_| true };
    (@fixed $fixed:expr) => { $fixed };
}

fn kernels() -> Vec<Function> {
    functions! {
        nearer_than(u16, u16, u32);
        farther_than(u16, u16, u32);
        needed(u16, u16);
        crossed(u32, u32, u32, u32);
        between_up(u16, u16, u16, u16) fixed for |numbers| numbers[2] <= numbers[3];
        between_down(u8, u8, u8, u8) fixed for |numbers| numbers[2] <= numbers[3];
        portion(u16, u32, u16);
        fallen(u16, u32);
        share_up(u16, u8, u8);
        share_down(u16, u8);
        together(u16, u16, u8);
        fits(u16, u16);
        split(u16, u16);
        within_percent(u16, u8, u16);
        counted(u32, u32);
    }
}

/// What they promise is a relation, not a result.
fn lemmas() -> Vec<Function> {
    functions! {
        between_up_rises(u16, u16, u16, u16, u16) fixed for |_| false;
        between_down_rises(u8, u8, u8, u8, u8) fixed for |_| false;
        overlap_exceeds(u32, u32, u8);
        retarder_stays_below(u16, u16, u16) fixed for |_| false;
        cycles_lose_nothing(u16, u32, u32, u16) fixed for |_| false;
    }
}

/// How often each promise refused a wrong result.
struct Refusals(Vec<u32>);

impl Function {
    fn check(&self, contract: &Contract, arguments: &[i128], refusals: &mut Refusals) -> Result<(), String> {
        if !contract.demands_hold(arguments) {
            return Ok(());
        }
        let (result, others) = (self.call)(arguments);
        let kept = contract.kept(arguments, &result);
        if kept.contains(&false) {
            return Err(format!("{}{arguments:?} gives {result:?}, promises kept: {kept:?}", self.name));
        }
        for other in others {
            let kept = contract.kept(arguments, &other);
            if (self.fixed)(arguments) && !kept.contains(&false) {
                return Err(format!("{}{arguments:?} gives {result:?}, but may give {other:?}", self.name));
            }
            kept.iter().zip(&mut refusals.0).for_each(|(kept, count)| *count += u32::from(!kept));
        }
        Ok(())
    }

    /// Numbers at which something changes, up to what a parameter takes; fewer where there are many parameters.
    fn edges(&self, greatest: i128) -> Vec<i128> {
        let many: &[i128] = match self.greatest.len() {
            ..=2 => &[0, 1, 2, 3, 4, 24, 25, 26, 99, 100, 101, 254, 255, 256, 512, 999, 1000, 1001, 1280, 4_294_967],
            3 => &[0, 1, 2, 25, 99, 100, 101, 255, 999, 1000, 4_294_967],
            4 => &[0, 1, 2, 24, 25, 1000],
            _ => &[0, 1, 7, 100],
        };
        let ends = [greatest / 2, greatest - 1, greatest];
        many.iter().copied().filter(|edge| *edge < greatest / 2).chain(ends).collect()
    }

    fn all_edges(&self) -> Vec<Vec<i128>> {
        self.greatest.iter().fold(vec![Vec::new()], |prefixes, greatest| {
            let edges = self.edges(*greatest);
            let longer =
                |prefix: &Vec<i128>| edges.iter().map(|edge| [&prefix[..], &[*edge]].concat()).collect::<Vec<_>>();
            prefixes.iter().flat_map(longer).collect()
        })
    }
}

fn try_all(source: &str, functions: &[Function]) {
    let contracts = contracts(source);
    let named = |contract: &Contract| functions.iter().find(|function| function.name == contract.name);
    for contract in &contracts {
        let function = named(contract).unwrap_or_else(|| panic!("{} is not tried", contract.name));
        assert!(contract.terminates, "{} does not promise to return", contract.name);
        assert!(contract.promises() > 0, "{} promises nothing", contract.name);
        let mut refusals = Refusals(vec![0; contract.promises()]);
        for arguments in function.all_edges() {
            function.check(contract, &arguments, &mut refusals).unwrap();
        }
        assert!(!refusals.0.contains(&0), "{}: a promise that refuses nothing: {:?}", contract.name, refusals.0);
    }
    assert_eq!(contracts.len(), functions.len(), "every function that is tried has a contract");
}

#[test]
fn the_contracts_of_the_kernels_hold_and_fix_the_result() {
    try_all(include_str!("../../../supervisor/terms/src/kernel.rs"), &kernels());
}

#[test]
fn the_consequences_hold() {
    try_all(include_str!("../src/consequences.rs"), &lemmas());
}
