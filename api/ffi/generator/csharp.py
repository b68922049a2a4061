"""Plumb.cs: structs without references, whose memory is the backend's own, and delegates; C# 7 with /unsafe."""
from xml.sax.saxutils import escape

from generator import model
from generator.expressions import written
from generator.text import DO_NOT_EDIT, comment, listed
from generator.words import csharp_name

PRIMITIVES = {"double": "double", "float": "float", "char": "byte", "size_t": "UIntPtr", "void": "void",
              "uint8_t": "byte", "int8_t": "sbyte", "uint16_t": "ushort", "int16_t": "short", "uint32_t": "uint",
              "int32_t": "int", "uint64_t": "ulong", "int64_t": "long"}
SUFFIXES = {"uint": "u", "int": "", "ulong": "ul", "long": "l"}

HEAD = f"""// Plumb, a stable interface to rigid-body physics engines, for C#: plumb/plumb.h, by the same names.
//
// {DO_NOT_EDIT}
// Take the file as it is, and compile with /unsafe (C# 7: Mono, .NET, Unity). Functions of tables are IntPtr, of which
// Calls.Function<PlumbBackendTable.Step>(table->step) makes a delegate; keep it. Look at a table's struct_size before
// you take what came later. Delegates that you lend (PlumbHost.log) must live for as long as they may be called.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Plumb.Ffi
{{
public static class Calls
{{
    public static T Function<T>(IntPtr pointer) where T : class
    {{
        return pointer == IntPtr.Zero ? null : (T)(object)Marshal.GetDelegateForFunctionPointer(pointer, typeof(T));
    }}

    public static unsafe string Text(byte* text)
    {{
        int length = 0;
        while (text != null && text[length] != 0) ++length;
        return text == null ? null : Encoding.UTF8.GetString(text, length);
    }}

    // To give to C: fixed (byte* name = Calls.Bytes(PLUMB_EXT_JOINTS)) ...
    public static byte[] Bytes(string text)
    {{
        return Encoding.UTF8.GetBytes(text + "\\0");
    }}
}}
"""


def doc(text, indent=""):
    return comment(f"<summary>{escape(text)}</summary>" if text else "", "/// ", indent)


class Writer:
    def __init__(self, headers):
        self.headers = headers
        self.aliases = {item.name: item.type for item in model.all_of(headers, model.Alias)}
        self.struct_name = ""  # the one that is being written
        self.rows = {}  # arrays of structs: name -> (element, count)

    def type_of(self, kind):
        if isinstance(kind, model.Named) and kind.name in self.aliases:  # C# has no alias that other files see
            return self.type_of(self.aliases[kind.name])
        if isinstance(kind, model.Named):
            return PRIMITIVES.get(kind.name, kind.name)
        if isinstance(kind, model.Pointer):
            return f"{self.type_of(kind.target)}*"
        return "IntPtr"  # a function

    def member(self, member):
        name, kind = csharp_name(member.name), member.type
        if not isinstance(kind, model.Array):
            return f"public {self.type_of(kind)} {name};"
        element = self.type_of(kind.element)
        if element in PRIMITIVES.values() and element != "UIntPtr":
            return f"public fixed {element} {name}[{kind.count}];"
        if not isinstance(kind.element, model.Named):
            raise model.Unknown(self.struct_name, f"{member.name}: an array of pointers, functions or arrays")
        row = f"{element}_{kind.count}"
        self.rows[row] = (element, kind.count)
        return f"public {row} {name};"

    def delegate(self, name, function, text, indent=""):
        parameters = [f"{self.type_of(kind)} {csharp_name(parameter)}" for parameter, kind in function.parameters]
        return [*doc(text, indent), f"{indent}[UnmanagedFunctionPointer(CallingConvention.Cdecl)]",
                *listed(f"public unsafe delegate {self.type_of(function.result)} {name}(", parameters, ");", indent)]

    def struct(self, item):
        self.struct_name = item.name
        lines = [*doc(item.doc), "[StructLayout(LayoutKind.Sequential)]", f"public unsafe struct {item.name}", "{"]
        for member in item.members:
            lines += [*doc(member.doc, "    "), f"    {self.member(member)}"]
        for member in item.members:
            if isinstance(member.type, model.Function):
                lines += ["", *self.delegate(camel(member.name), member.type, "", "    ")]
        return [*lines, "}"]

    def row(self, name, element, count):
        """An array of structs within a struct, which C# has of primitives alone."""
        return [f"""
[StructLayout(LayoutKind.Sequential)]
public unsafe struct {name}
{{
    private {element} {', '.join(f"at{number}" for number in range(count))};

    public {element} this[int index]
    {{
        get {{ Check(index); fixed ({element}* rows = &at0) return rows[index]; }}
        set {{ Check(index); fixed ({element}* rows = &at0) rows[index] = value; }}
    }}

    private static void Check(int index)
    {{
        if (index < 0 || index >= {count}) throw new IndexOutOfRangeException();
    }}
}}"""]

    def constant(self, item):
        kind = self.type_of(model.Named(item.type))
        value = f"1{SUFFIXES[kind]} << {item.value.bit_length() - 1}" if item.bit else f"{item.value}{SUFFIXES[kind]}"
        return [*doc(item.doc, "    "), f"    public const {kind} {item.name} = {value};"]

    def macro(self, item):
        body = written(item.expression, item.name, str, lambda kind, text: f"({self.type_of(model.Named(kind))}){text}")
        types = [(csharp_name(name), self.type_of(model.Named(kind))) for name, kind in item.parameters]
        parameters = ", ".join(f"{kind} {name}" for name, kind in types)
        result = self.type_of(model.Named(item.result))
        body = body[1:-1] if body.startswith("((") else body
        return [*doc(item.doc, "    "), f"    public static {result} {item.name}({parameters})", "    {",
                f"        return {body};", "    }"]

    def type_declaration(self, item):
        """What is declared as a type; nothing for the rest, which is in Constants."""
        if isinstance(item, model.Struct):
            return ["", *self.struct(item)]
        if isinstance(item, model.Opaque):
            return ["", *doc(item.doc), f"public struct {item.name}", "{", "}"]
        if isinstance(item, model.Alias) and isinstance(item.type, model.Function):
            return ["", *self.delegate(item.name, item.type, item.doc)]
        if isinstance(item, model.Export):
            return ["", *self.delegate(item.name, item.type, item.doc)]
        return []

    def value_declaration(self, item):
        """A type that is an integer has no name here, so what it says stands above its constants."""
        if isinstance(item, model.Alias) and not isinstance(item.type, model.Function):
            return ["", *comment(f"{item.name}, {self.type_of(item.type)}. {item.doc}".strip(), "// ", "    ")]
        if isinstance(item, model.Constants):
            lines = [line for part in item.constants for line in self.constant(part)]
            return [*(["", *comment(item.doc, "// ", "    ")] if item.doc else []), *lines]
        if isinstance(item, model.Constant):
            return self.constant(item)
        if isinstance(item, model.Text):
            return [*doc(item.doc, "    "), f"    public const string {item.name} = \"{item.value}\";"]
        if isinstance(item, model.Macro):
            return self.macro(item)
        return []

    def section(self, header, write, indent):
        lines = [line for item in header.declarations for line in write(item)]
        return ["", f"{indent}// --- {header.name}", *comment(header.doc, "// ", indent), *lines] if lines else []

    def write(self):
        lines = HEAD.split("\n")[:-1]
        for header in self.headers:
            lines += self.section(header, self.type_declaration, "")
        for name, (element, count) in self.rows.items():
            lines += self.row(name, element, count)
        lines += ["", "public static class Constants", "{"]
        values = [line for header in self.headers for line in self.section(header, self.value_declaration, "    ")]
        lines += values[1:]
        return "\n".join([*lines, "}", "}"]) + "\n"


def camel(name):
    return "".join(word.capitalize() for word in name.split("_"))


def write(headers):
    return Writer(headers).write()
