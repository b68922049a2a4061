"""plumb.rs: a module of declarations, for rustc 1.59 and later without any crate."""
import re

from generator import model
from generator.expressions import written
from generator.text import DO_NOT_EDIT, comment, listed
from generator.words import rust_name

PRIMITIVES = {"double": "f64", "float": "f32", "char": "c_char", "size_t": "usize", "void": "c_void"}
PRIMITIVES |= {name: f"{'i' if signed else 'u'}{bits}" for name, (bits, signed) in model.INTEGERS.items()}

HEAD = f"""//! Plumb, a stable interface to rigid-body physics engines, for Rust: `plumb/plumb.h`, by the same names.
//!
//! {DO_NOT_EDIT}
//! Take the file as it is, as a module: `mod plumb;`. Every struct's `Default` is all zero, with `struct_size` set,
//! where it has one. Functions of tables are `Option`s; look at a table's `struct_size` before you take later ones.
#![allow(dead_code, non_snake_case, non_camel_case_types)]

use std::ffi::CStr;
use std::marker::{{PhantomData, PhantomPinned}};
use std::os::raw::{{c_char, c_void}};

// Zero is a value of every member: numbers, null pointers, no function.
macro_rules! zero {{
    ($($name:ident),*) => {{$(
        impl Default for $name {{
            fn default() -> Self {{
                unsafe {{ std::mem::zeroed() }}
            }}
        }}
    )*}};
}}
macro_rules! sized {{
    ($($name:ident),*) => {{$(
        impl Default for $name {{
            fn default() -> Self {{
                let zero: Self = unsafe {{ std::mem::zeroed() }};
                Self {{ struct_size: std::mem::size_of::<Self>() as u32, ..zero }}
            }}
        }}
    )*}};
}}
"""


def doc(text, indent=""):
    # What Markdown would take for links and emphasis.
    return comment(re.sub(r"[][*]|<(?=\w)", r"\\\g<0>", text), "/// ", indent)


def type_of(kind):
    if isinstance(kind, model.Named):
        return PRIMITIVES.get(kind.name, kind.name)
    if isinstance(kind, model.Pointer):
        return f"*{'const' if kind.const else 'mut'} {type_of(kind.target)}"
    if isinstance(kind, model.Array):
        return f"[{type_of(kind.element)}; {kind.count}]"
    parameters = ", ".join(parameters_of(kind))
    return f"Option<unsafe extern \"C\" fn({parameters}){result_of(kind)}>"


def parameters_of(function):
    return [f"{rust_name(name)}: {type_of(kind)}" for name, kind in function.parameters]


def result_of(function):
    return "" if function.result == model.Named("void") else f" -> {type_of(function.result)}"


def typed(before, kind, after, indent=""):
    """A line that ends in a type; a function's arguments may take several."""
    if isinstance(kind, model.Function):
        before = f'{before}Option<unsafe extern "C" fn('
        return listed(before, parameters_of(kind), f"){result_of(kind)}>{after}", indent)
    return [f"{indent}{before}{type_of(kind)}{after}"]


def constant(item):
    value = f"1 << {item.value.bit_length() - 1}" if item.bit else str(item.value)
    return [*doc(item.doc), f"pub const {item.name}: {PRIMITIVES.get(item.type, item.type)} = {value};"]


def struct(item):
    lines = [*doc(item.doc), "#[repr(C)]", "#[derive(Clone, Copy, Debug)]", f"pub struct {item.name} {{"]
    for member in item.members:
        lines += [*doc(member.doc, "    "), *typed(f"pub {rust_name(member.name)}: ", member.type, ",", "    ")]
    return [*lines, "}"]


def opaque(item):
    return [*doc(item.doc), "#[repr(C)]", f"pub struct {item.name} {{", "    nothing: [u8; 0],",
            "    owned_by_the_backend: PhantomData<(*mut u8, PhantomPinned)>,", "}"]


def macro(item):
    place = item.name
    body = written(item.expression, place, lambda text: text.rstrip("uUlL"),
                   lambda kind, text: f"({text} as {PRIMITIVES.get(kind, kind)})")
    parameters = ", ".join(f"{rust_name(name)}: {PRIMITIVES.get(kind, kind)}" for name, kind in item.parameters)
    result = PRIMITIVES.get(item.result, item.result)
    return [*doc(item.doc), f"pub const fn {item.name}({parameters}) -> {result} {{",
            f"    {body[1:-1] if body.startswith('(') else body}", "}"]


def text(item):
    # No CStr literal and no checked conversion is a constant before rustc 1.77.
    return [*doc(item.doc), f"pub const {item.name}: &CStr = "
            f"unsafe {{ CStr::from_bytes_with_nul_unchecked(b\"{item.value}\\0\") }};"]


def export(item):
    # Its type: a block of imports is written otherwise in the edition of 2024, and hosts look the symbol up.
    kind = f"){result_of(item.type)};"
    return [*doc(item.doc), *listed(f'pub type {item.name} = unsafe extern "C" fn(', parameters_of(item.type), kind)]


def declaration(item):
    if isinstance(item, model.Constants):
        lines = [line for part in item.constants for line in constant(part)]
        return [*comment(item.doc, "// "), *lines]
    if isinstance(item, model.Alias):
        return [*doc(item.doc), *typed(f"pub type {item.name} = ", item.type, ";")]
    writers = {model.Constant: constant, model.Struct: struct, model.Opaque: opaque, model.Macro: macro,
               model.Text: text, model.Export: export}
    return writers[type(item)](item)


def defaults(headers):
    structs = model.all_of(headers, model.Struct)
    sized = [item.name for item in structs if item.members[0].name == "struct_size"]
    zero = [item.name for item in structs if item.name not in sized]
    return ["", *listed("zero!(", zero, ");"), *listed("sized!(", sized, ");")]


def write(headers):
    lines = HEAD.split("\n")[:-1]
    for header in headers:
        lines += ["", f"// --- {header.name}", *comment(header.doc, "// ")]
        previous = None
        for item in header.declarations:
            # Single constants stand together.
            if not (isinstance(item, model.Constant) and isinstance(previous, model.Constant)):
                lines.append("")
            lines += declaration(item)
            previous = item
    return "\n".join([*lines, *defaults(headers)]) + "\n"
