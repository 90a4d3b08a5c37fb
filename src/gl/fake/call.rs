//! One recorded command, and the function of each command that records it.

use super::super::real::Ptr;
use core::fmt;

/// An argument of a command as plain data.
#[derive(Clone, Debug, PartialEq)]
pub enum Arg {
    /// Enumerants, names, sizes, truth values.
    Int(i64),
    /// Of either precision.
    Float(f64),
    /// An address whose contents the fake driver does not read.
    Ptr(usize),
    /// What the command reads at the address: uniforms, matrices, lists of names.
    Data(Vec<f64>),
    /// A string.
    Text(String),
}

impl Arg {
    /// As a number; an address is its bits.
    pub fn number(&self) -> f64 {
        match self {
            Arg::Int(v) => *v as f64,
            Arg::Float(v) => *v,
            Arg::Ptr(p) => *p as f64,
            Arg::Data(_) | Arg::Text(_) => f64::NAN,
        }
    }
}

impl fmt::Display for Arg {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Arg::Int(v) => write!(f, "{v}"),
            Arg::Float(v) => write!(f, "{v:?}"),
            Arg::Ptr(0) => f.write_str("null"),
            Arg::Ptr(_) => f.write_str("pointer"),
            Arg::Data(values) => write!(f, "{values:?}"),
            Arg::Text(text) => write!(f, "{text:?}"),
        }
    }
}

/// A command that was called.
#[derive(Clone, Debug, PartialEq)]
pub struct Call {
    /// The name of the command.
    pub name: &'static str,
    /// Its arguments in order.
    pub args: Vec<Arg>,
    /// It was called inside [`super::Fake::program`].
    pub program: bool,
}

impl Call {
    /// An argument as a number; not a number where there is none.
    pub fn number(&self, at: usize) -> f64 {
        self.args.get(at).map_or(f64::NAN, Arg::number)
    }

    /// An argument as an enumerant, a name or a size; 0 where there is none.
    pub fn int(&self, at: usize) -> i64 {
        match self.args.get(at) {
            Some(Arg::Int(v)) => *v,
            _ => 0,
        }
    }

    /// Whether the command asks the driver for something.
    pub fn asks(&self) -> bool {
        let asks = |start| self.name.starts_with(start);
        asks("glGet") && self.name != "glGetError" || asks("glIs")
    }
}

impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}(", self.name)?;
        for (at, arg) in self.args.iter().enumerate() {
            let comma = if at > 0 { ", " } else { "" };
            write!(f, "{comma}{arg}")?;
        }
        f.write_str(")")
    }
}

/// A type of an argument.
pub(in crate::gl) trait Recorded {
    fn arg(self) -> Arg;
}

/// A type of an answer.
pub(in crate::gl) trait Answer {
    fn of(answer: i64) -> Self;
}

macro_rules! whole {
    ($($t:ty)*) => { $(
        impl Recorded for $t {
            fn arg(self) -> Arg {
                Arg::Int(self as i64)
            }
        }

        impl Answer for $t {
            fn of(answer: i64) -> $t {
                answer as $t
            }
        }
    )* };
}

whole!(i8 u8 i16 u16 i32 u32 i64 u64 isize);

impl Recorded for f32 {
    fn arg(self) -> Arg {
        Arg::Float(self.into())
    }
}

impl Recorded for f64 {
    fn arg(self) -> Arg {
        Arg::Float(self)
    }
}

impl Recorded for Ptr {
    fn arg(self) -> Arg {
        Arg::Ptr(self as usize)
    }
}

impl Answer for Ptr {
    fn of(answer: i64) -> Ptr {
        answer as usize as Ptr
    }
}

/// The second macro over the list of `table.rs`: one function per command that records it.
macro_rules! record_functions {
    ($($name:ident($($a:ident: $t:ty),*) $(-> $r:ty = $zero:expr)?;)*) => {
        impl $crate::gl::fake::Recorders {
            $(
                #[allow(
                    non_snake_case,
                    clippy::too_many_arguments,
                    reason = "the API's own name and signature"
                )]
                extern "C-unwind" fn $name($($a: $t),*) $(-> $r)? {
                    let answer = $crate::gl::fake::record(
                        slot::$name,
                        &[$($crate::gl::fake::Recorded::arg($a)),*],
                    );
                    record_functions!(@answer answer $($r)?)
                }
            )*

            /// The function that records a command, by the command's slot.
            pub(super) fn address(at: usize) -> Ptr {
                match at {
                    $(slot::$name => Self::$name as *const () as Ptr,)*
                    _ => core::ptr::null_mut(),
                }
            }
        }
    };
    (@answer $answer:ident) => {{ let _: i64 = $answer; }};
    (@answer $answer:ident $r:ty) => { <$r as $crate::gl::fake::Answer>::of($answer) };
}
