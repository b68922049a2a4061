"""Names that are words of a language, as it takes them."""
RUST = set(
    "as break const continue dyn else enum extern false fn for if impl in let loop match mod move mut pub ref "
    "return static struct trait true type unsafe use where while async await abstract become box do final macro "
    "override priv try typeof unsized virtual yield".split()
)
# Of these even a raw name is none.
RUST_ALONE = {"crate", "self", "super", "Self"}
CSHARP = set(
    "abstract as base bool break byte case catch char checked class const continue decimal default delegate do "
    "double else enum event explicit extern false finally fixed float for foreach goto if implicit in int "
    "interface internal is lock long namespace new null object operator out override params private protected "
    "public readonly ref return sbyte sealed short sizeof stackalloc static string struct switch this throw true "
    "try typeof uint ulong unchecked unsafe ushort using virtual void volatile while".split()
)


def rust_name(name):
    return f"r#{name}" if name in RUST else f"{name}_" if name in RUST_ALONE else name


def csharp_name(name):
    return f"@{name}" if name in CSHARP else name
