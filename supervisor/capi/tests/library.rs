//! The static library from C: programs that a C compiler makes, and what is linked into them.

#[path = "common/library.rs"]
mod library;

use std::error::Error;
use std::process::Command;

use library::{STRICT, built, c_compiler, compiler, not_run, output, package, program, run};
use supervisor::Sealed;

type Outcome = Result<(), Box<dyn Error>>;

/// SELF-1a, SELF-4d, SELF-6a: the boundary called from C, as C99 and as C++17.
#[test]
fn c_programs_find_the_calls_as_the_header_says() -> Outcome {
    let Some(cc) = c_compiler("the tests in C") else { return Ok(()) };
    std::fs::create_dir_all(built())?;
    let sealed = built().join("default.bin");
    std::fs::write(&sealed, Sealed::from_default()?.to_bytes())?;
    let source = package().join("tests/c/boundary.c");
    let c99 = program(&cc, "boundary-c99", &["-std=c99"], std::slice::from_ref(&source))?;
    let said = output(&c99, &[sealed.as_os_str()])?;
    println!("{said}");
    assert!(said.contains(" passed, 0 failed"), "{said}");
    let Some(cxx) = compiler("CXX", &["c++", "g++", "clang++"]) else {
        not_run("the tests as C++", "no C++ compiler is here");
        return Ok(());
    };
    let object = built().join("boundary-cxx.o");
    let mut command = Command::new(&cxx);
    command.args(["-std=c++17", "-x", "c++", "-c"]).args(STRICT).arg("-I").arg(package().join("include"));
    run(command.arg(&source).arg("-o").arg(&object))?;
    let cxx17 = program(&cxx, "boundary-cxx17", &["-std=c++17"], &[object])?;
    let said = output(&cxx17, &[sealed.as_os_str()])?;
    assert!(said.contains(" passed, 0 failed"), "{said}");
    Ok(())
}

/// SELF-2a: the first vetted frame of the guide comes out as the guide shows it.
#[test]
fn the_first_frame_is_that_of_the_guide() -> Outcome {
    let Some(cc) = c_compiler("the first frame of the guide") else { return Ok(()) };
    std::fs::create_dir_all(built())?;
    let sealed = built().join("default-first.bin");
    std::fs::write(&sealed, Sealed::from_default()?.to_bytes())?;
    let example = package().join("example");
    let include = format!("-I{}", example.join("common").display());
    let sources = [example.join("host/first.c"), example.join("common/link.c")];
    let said = output(&program(&cc, "first", &["-std=c99", &include], &sources)?, &[sealed.as_os_str()])?;
    let guide = std::fs::read_to_string(package().join("README.md"))?;
    assert!(guide.contains(&format!("<!-- first: what it prints -->\n```\n{said}```\n")), "it prints\n{said}");
    Ok(())
}

/// SELF-1a, SELF-1c: no call reads what was never written, or touches memory that nobody gave it, as Valgrind sees it.
#[test]
fn no_call_touches_what_is_not_the_callers() -> Outcome {
    let Some(cc) = c_compiler("the search for stray accesses") else { return Ok(()) };
    if Command::new("valgrind").arg("--version").output().is_err() {
        not_run("the search for stray accesses", "valgrind is not here");
        return Ok(());
    }
    std::fs::create_dir_all(built())?;
    let sealed = built().join("default-valgrind.bin");
    std::fs::write(&sealed, Sealed::from_default()?.to_bytes())?;
    let program = program(&cc, "boundary-valgrind", &["-std=c99"], &[package().join("tests/c/boundary.c")])?;
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--quiet", "--error-exitcode=9", "--track-origins=yes"]).arg(program).arg(&sealed);
    let said = run(&mut valgrind)?;
    assert!(said.contains(" passed, 0 failed"), "{said}");
    Ok(())
}

/// SELF-1b: no panic is linked into a program that makes every call; nor an allocator.
#[test]
fn no_panic_is_linked() -> Outcome {
    let Some(cc) = c_compiler("the search for a panic") else { return Ok(()) };
    let program = program(&cc, "boundary-symbols", &["-std=c99"], &[package().join("tests/c/boundary.c")])?;
    let Ok(symbols) = run(Command::new("nm").arg("-C").arg(&program)) else {
        not_run("the search for a panic", "nm is not here");
        return Ok(());
    };
    assert!(symbols.contains("supervisor_step") && symbols.contains("supervisor_diagnosis_dm1"), "it links them all");
    let forbidden = ["panic", "unwrap_failed", "expect_failed", "slice_index", "__rust_alloc", "core::fmt"];
    let found: Vec<&str> = symbols.lines().filter(|line| forbidden.iter().any(|word| line.contains(word))).collect();
    assert!(found.is_empty(), "{found:#?}");
    Ok(())
}

/// SELF-1c: the library has no variable of its own: neither initialised data nor zeroed memory.
#[test]
fn no_variable_is_linked() -> Outcome {
    let Some(cc) = c_compiler("the search for variables") else { return Ok(()) };
    let program = program(&cc, "boundary-data", &["-std=c99"], &[package().join("tests/c/boundary.c")])?;
    let Ok(symbols) = run(Command::new("nm").arg("-C").arg(&program)) else {
        not_run("the search for variables", "nm is not here");
        return Ok(());
    };
    let variable = |line: &&str| {
        let mut words = line.split_whitespace().skip(1);
        let (kind, name) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
        matches!(kind, "d" | "D" | "b" | "B") && (name.contains("supervisor") || name.contains("core::"))
    };
    let found: Vec<&str> = symbols.lines().filter(variable).collect();
    assert!(found.is_empty(), "{found:#?}");
    Ok(())
}
