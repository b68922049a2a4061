"""Lines of at most 120 columns, for every language."""
import textwrap

WIDTH = 120
DO_NOT_EDIT = "Generated from plumb.h and what it includes by api/ffi/generate.py: edit those."


def comment(text, prefix, indent=""):
    """Lines of a comment; none for no text."""
    found = []
    for paragraph in text.split("\n") if text else []:
        start = indent + prefix
        found += textwrap.wrap(paragraph, WIDTH, initial_indent=start, subsequent_indent=start, break_long_words=False,
                               break_on_hyphens=False)
    return found


def listed(before, parts, after, indent=""):
    """before + parts with commas + after, with the parts on lines of their own where one line is too short."""
    line = f"{indent}{before}{', '.join(parts)}{after}"
    if len(line) <= WIDTH:
        return [line]
    inner = indent + "    "
    # A part stays together: its blanks are none to wrap at.
    filled = textwrap.wrap(", ".join(part.replace(" ", "\0") for part in parts), WIDTH, initial_indent=inner,
                           subsequent_indent=inner, break_long_words=False, break_on_hyphens=False)
    return [indent + before, *(text.replace("\0", " ") for text in filled), indent + after]
