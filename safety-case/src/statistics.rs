//! Exact confidence intervals of 95 %, two-sided: the distributions are `statrs`'s.

use statrs::distribution::{Beta, ContinuousCDF, Gamma};

use crate::number::float;

/// Half of what lies outside.
const OUTSIDE: f64 = 0.025;

/// Clopper and Pearson: the share that `count` of `of` stands for.
#[must_use]
pub fn share(count: u64, of: u64) -> [f64; 2] {
    let (some, rest) = (float(count), float(of.saturating_sub(count)));
    let quantile = |one: f64, two: f64, at: f64| Beta::new(one, two).ok().map(|beta| beta.inverse_cdf(at));
    let least = if count == 0 { Some(0.0) } else { quantile(some, rest + 1.0, OUTSIDE) };
    let most = if count >= of { Some(1.0) } else { quantile(some + 1.0, rest, 1.0 - OUTSIDE) };
    [least.unwrap_or(0.0), most.unwrap_or(1.0)]
}

/// Poisson: the rate for each `unit` that `count` in `all` of these units stands for.
#[must_use]
pub fn rate(count: u64, all: f64, unit: f64) -> [f64; 2] {
    let quantile = |shape: f64, at: f64| Gamma::new(shape, 1.0).ok().map(|gamma| gamma.inverse_cdf(at));
    let least = if count == 0 { Some(0.0) } else { quantile(float(count), OUTSIDE) };
    let most = quantile(float(count) + 1.0, 1.0 - OUTSIDE);
    [least.unwrap_or(0.0), most.unwrap_or(f64::INFINITY)].map(|expected| expected / all * unit)
}

#[cfg(test)]
mod tests {
    use super::{rate, share};

    fn close(found: [f64; 2], wanted: [f64; 2]) {
        for (found, wanted) in found.into_iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-4 * wanted.max(1.0), "{found} {wanted}");
        }
    }

    #[test]
    fn the_intervals_are_those_of_the_tables() {
        // None of n: 1 - 0.025^(1/n); Poisson: -ln 0.025 = 3.6889.
        close(share(0, 100), [0.0, 1.0 - 0.025_f64.powf(0.01)]);
        close(share(100, 100), [0.025_f64.powf(0.01), 1.0]);
        close(share(5, 10), [0.187_086, 0.812_914]);
        close(rate(0, 1.0, 1.0), [0.0, 3.688_879]);
        close(rate(10, 1.0, 1.0), [4.795_389, 18.390_356]);
        close(rate(10, 500.0, 1000.0), [2.0 * 4.795_389, 2.0 * 18.390_356]);
    }
}
