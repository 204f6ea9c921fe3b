//! One run of a kind at a time: two would change the same copies, and write the same record.

use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

use crate::error::{ToolError, file};

/// Held by this run until it is dropped, or the program ends in whatever way.
#[must_use]
#[derive(Debug)]
pub(super) struct Held {
    /// The lock is the open file's: nothing is left behind that a later run would have to clear away.
    _file: File,
}

impl Held {
    /// Holds `what` for this run.
    ///
    /// # Errors
    /// Another run holds it, or the file for it cannot be made.
    pub(super) fn at_once(root: &Path, what: &str) -> Result<Self, ToolError> {
        let (held, path) = open(root, what)?;
        match held.try_lock() {
            Ok(()) => Ok(Self { _file: held }),
            Err(TryLockError::WouldBlock) => Err(ToolError::Arguments(format!(
                "another run of `supervise {what}` is at work here: wait until it has ended, or end it"
            ))),
            Err(TryLockError::Error(error)) => Err(file(&path, error)),
        }
    }

    /// Holds `what` as soon as no other run does: for what takes no time.
    ///
    /// # Errors
    /// The file for it cannot be made or locked.
    pub(super) fn in_turn(root: &Path, what: &str) -> Result<Self, ToolError> {
        let (held, path) = open(root, what)?;
        held.lock().map_err(|error| file(&path, error))?;
        Ok(Self { _file: held })
    }
}

/// Under the root, wherever cargo builds: the record that two runs would write stands there, too.
fn open(root: &Path, what: &str) -> Result<(File, PathBuf), ToolError> {
    let folder = root.join("target/held");
    fs::create_dir_all(&folder).map_err(|error| file(&folder, error))?;
    let path = folder.join(what.replace(' ', "-"));
    Ok((File::create(&path).map_err(|error| file(&path, error))?, path))
}

#[cfg(test)]
mod tests {
    use super::{Held, fs};

    #[test]
    fn a_second_run_is_refused_until_the_first_has_ended() {
        let Ok(folder) = tempfile::tempdir() else { unreachable!("there is a temporary folder") };
        let first = Held::at_once(folder.path(), "mistakes");
        assert!(first.is_ok());
        let second = Held::at_once(folder.path(), "mistakes").map(drop).map_err(|error| error.to_string());
        assert_eq!(
            second,
            Err("another run of `supervise mistakes` is at work here: wait until it has ended, or end it".to_owned())
        );
        assert!(Held::at_once(folder.path(), "fuzz wire_bytes").is_ok(), "another kind of run is none of its business");
        drop(first);
        assert!(Held::at_once(folder.path(), "mistakes").is_ok());
    }

    #[test]
    fn where_no_file_can_be_made_it_says_where() {
        let Ok(folder) = tempfile::tempdir() else { unreachable!("there is a temporary folder") };
        assert!(fs::write(folder.path().join("target"), "").is_ok());
        for held in [Held::at_once(folder.path(), "mutants"), Held::in_turn(folder.path(), "mutants")] {
            let text = held.map(drop).map_err(|error| error.to_string());
            assert!(text.is_err_and(|text| text.contains("target")));
        }
    }
}
