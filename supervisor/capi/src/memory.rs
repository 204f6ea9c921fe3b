//! The only code that follows pointers: arguments, and what is kept in the caller's memory.
//!
//! A pointer is looked at once, when it becomes an [`Input`], an [`Output`] or a [`Place`]; from then on safe code has
//! it. What no program can look at is the caller's part, and stands under *Safety* at every call: that the pointer
//! leads to memory of its own program, and that nothing else touches this memory during the call.
#![expect(unsafe_code, reason = "C hands over pointers: here they are followed, and nowhere else")]

use core::mem::MaybeUninit;
use core::ptr::NonNull;
use core::sync::atomic::{AtomicU32, Ordering};

use crate::SupervisorCode;

/// Values of which every bit pattern is legal, without padding, pointer or destructor.
///
/// # Safety
/// That is a promise of whoever implements it: values of such a type are read from bytes of another program.
pub(crate) unsafe trait Plain: Copy {}

/// Promises it for types that consist of integers and nothing else.
macro_rules! plain {
    ($($name:ty),* $(,)?) => {$(
        // SAFETY: an integer, or `repr(C)` and nothing but integers, with every gap named: see `types`.
        unsafe impl Plain for $name {}
    )*};
}

plain!(u8, u32, usize, crate::SupervisorFrame, crate::SupervisorReceipt, crate::SupervisorVerdict);
plain!(crate::SupervisorOutputs, crate::SupervisorDecision, crate::SupervisorBodyFeedback);
plain!(crate::SupervisorEvent, crate::SupervisorTrouble);

/// Where an argument lies: from the first byte to the one after the last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    start: usize,
    end: usize,
}

impl Span {
    /// That of an argument that was left out: it shares nothing.
    pub(crate) const NOTHING: Self = Self { start: 0, end: 0 };

    fn of<T>(pointer: NonNull<T>, count: usize) -> Result<Self, SupervisorCode> {
        let bytes = size_of::<T>().checked_mul(count).filter(|bytes| isize::try_from(*bytes).is_ok());
        let start = pointer.addr().get();
        let end = bytes.and_then(|bytes| start.checked_add(bytes)).ok_or(SupervisorCode::Size)?;
        Ok(Self { start, end })
    }
}

/// Whether no two arguments share memory.
pub(crate) fn disjoint(spans: &[Span]) -> Result<(), SupervisorCode> {
    for (at, one) in spans.iter().enumerate() {
        if spans.iter().skip(at.saturating_add(1)).any(|other| one.start < other.end && other.start < one.end) {
            return Err(SupervisorCode::Overlap);
        }
    }
    Ok(())
}

/// Looks at a pointer: not null, aligned, inside the address space.
fn checked<T>(pointer: *mut T, count: usize) -> Result<(NonNull<T>, Span), SupervisorCode> {
    let pointer = NonNull::new(pointer).ok_or(SupervisorCode::Null)?;
    if !pointer.is_aligned() {
        return Err(SupervisorCode::Misaligned);
    }
    Ok((pointer, Span::of(pointer, count)?))
}

/// Values that the caller gives.
#[derive(Debug)]
pub(crate) struct Input<T> {
    pointer: NonNull<T>,
    count: usize,
    span: Span,
}

impl<T: Plain> Input<T> {
    /// # Safety
    /// Unless it is refused, `pointer` leads to `count` values that nobody writes while this lives.
    pub(crate) unsafe fn new(pointer: *const T, count: usize) -> Result<Self, SupervisorCode> {
        let (pointer, span) = checked(pointer.cast_mut(), count)?;
        Ok(Self { pointer, count, span })
    }
    /// The same, where null means that there is none.
    ///
    /// # Safety
    /// As for [`new`](Self::new).
    pub(crate) unsafe fn optional(pointer: *const T) -> Result<Option<Self>, SupervisorCode> {
        // SAFETY: the caller's promise is the same.
        if pointer.is_null() { Ok(None) } else { unsafe { Self::new(pointer, 1) }.map(Some) }
    }
    pub(crate) fn span(&self) -> Span {
        self.span
    }
    /// The first value; there is one unless the count is 0.
    pub(crate) fn first(&self) -> Option<T> {
        self.values().first().copied()
    }
    pub(crate) fn values(&self) -> &[T] {
        // SAFETY: not null, aligned, inside the address space: `checked`. That `count` values are there and stay as
        // they are is promised in `new`; every bit pattern is a value: `Plain`.
        unsafe { NonNull::slice_from_raw_parts(self.pointer, self.count).as_ref() }
    }
}

/// Room for values that the caller gets.
#[derive(Debug)]
pub(crate) struct Output<T> {
    pointer: NonNull<T>,
    count: usize,
    span: Span,
}

impl<T: Plain> Output<T> {
    /// # Safety
    /// Unless it is refused, `pointer` leads to room for `count` values that nobody else touches while this lives.
    pub(crate) unsafe fn new(pointer: *mut T, count: usize) -> Result<Self, SupervisorCode> {
        let (pointer, span) = checked(pointer, count)?;
        Ok(Self { pointer, count, span })
    }
    /// The same for one value, where null means that it is not wanted.
    ///
    /// # Safety
    /// As for [`new`](Self::new).
    pub(crate) unsafe fn optional(pointer: *mut T) -> Result<Option<Self>, SupervisorCode> {
        // SAFETY: the caller's promise is the same.
        if pointer.is_null() { Ok(None) } else { unsafe { Self::new(pointer, 1) }.map(Some) }
    }
    pub(crate) fn span(&self) -> Span {
        self.span
    }
    /// For how many values there is room.
    pub(crate) fn count(&self) -> usize {
        self.count
    }
    /// Writes the value at this place, if there is room for it.
    pub(crate) fn put(&self, at: usize, value: T) {
        if at < self.count {
            // SAFETY: not null, aligned, and inside of what `new` was promised; `Plain` has no destructor to miss.
            unsafe { self.pointer.add(at).write(value) }
        }
    }
}

/// What stands before a kept value. Written as atomics: an interrupt may look at it while a call runs.
#[repr(C)]
#[derive(Debug)]
struct Header {
    magic: AtomicU32,
    complement: AtomicU32,
    gate: AtomicU32,
}

/// No call runs.
const READY: u32 = 0x5245_4459;
/// A call runs.
const RUNNING: u32 = 0x5255_4E21;

/// A kept value behind its header.
#[repr(C)]
#[derive(Debug)]
pub(crate) struct Cell<T> {
    header: Header,
    value: T,
}

/// What is kept in the caller's memory between calls.
pub(crate) trait Kept: Sized {
    /// The type that the header declares for this memory.
    type Memory;
    /// Tells a state from a diagnosis, and both from memory that was never initialised.
    const MAGIC: u32;
    /// The declared memory has room for it, on this target.
    const FITS: () = assert!(
        size_of::<Cell<Self>>() <= size_of::<Self::Memory>() && align_of::<Cell<Self>>() <= align_of::<Self::Memory>(),
        "the memory declared for C is too small on this target"
    );
}

/// Memory of the caller in which a value is, or will be, kept.
#[derive(Debug)]
pub(crate) struct Place<T> {
    cell: NonNull<Cell<T>>,
    span: Span,
}

impl<T: Kept> Place<T> {
    /// # Safety
    /// Unless it is refused, `memory` leads to a whole `T::Memory` that was written at least once (zeros will do) and
    /// that nobody else touches while this lives, but by calls of this library: they are refused as busy.
    pub(crate) unsafe fn new(memory: *mut T::Memory) -> Result<Self, SupervisorCode> {
        let () = T::FITS;
        let (memory, span) = checked(memory, 1)?;
        Ok(Self { cell: memory.cast(), span })
    }
    pub(crate) fn span(&self) -> Span {
        self.span
    }

    fn header(&self) -> &Header {
        // SAFETY: not null, aligned, all there: `checked`, `T::FITS` and the promise of `new`. Any bits are a header,
        // and it is written through atomics alone.
        unsafe { &(*self.cell.as_ptr()).header }
    }

    /// From now on nothing is kept here.
    pub(crate) fn clear(&self) {
        self.header().magic.store(0, Ordering::Relaxed);
        self.header().complement.store(0, Ordering::Relaxed);
    }

    /// Keeps from now on what `build` writes. It is built where it is kept: it has no room on the stack of a small target.
    pub(crate) fn keep(&self, build: impl FnOnce(&mut MaybeUninit<T>) -> &mut T) {
        self.clear();
        // SAFETY: there is room for it: `T::FITS` and the promise of `new`; anything is a value that is not there yet.
        // What was there before is not dropped: no kept value holds a resource.
        let slot = unsafe { &mut *(&raw mut (*self.cell.as_ptr()).value).cast::<MaybeUninit<T>>() };
        // It gives back what it has written: a value in this slot, and in no other place.
        let here = core::ptr::from_mut(slot).addr();
        if core::ptr::from_mut(build(slot)).addr() != here {
            return;
        }
        self.header().gate.store(READY, Ordering::Relaxed);
        self.header().complement.store(!T::MAGIC, Ordering::Relaxed);
        self.header().magic.store(T::MAGIC, Ordering::Release);
    }

    /// Does something with the kept value. A call in another context, or one that was broken off, keeps it shut.
    pub(crate) fn enter<R>(&self, work: impl FnOnce(&mut T) -> R) -> Result<R, SupervisorCode> {
        let Header { magic, complement, gate } = self.header();
        if magic.load(Ordering::Acquire) != T::MAGIC || complement.load(Ordering::Relaxed) != !T::MAGIC {
            return Err(SupervisorCode::Uninitialised);
        }
        gate.compare_exchange(READY, RUNNING, Ordering::Acquire, Ordering::Relaxed)
            .map_err(|_| SupervisorCode::Busy)?;
        // SAFETY: the header says that `keep` has written a value here, and nothing but this library writes behind it
        // (the promise of `new`; in the vehicle the memory protection, AOU-04). The gate lets no second call in.
        let result = work(unsafe { &mut (*self.cell.as_ptr()).value });
        gate.store(READY, Ordering::Release);
        Ok(result)
    }
}
