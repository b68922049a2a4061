"""The comments of a header, which compilers drop: what stands above a declaration, and what stands behind it."""
import dataclasses
import re

COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)


@dataclasses.dataclass
class Comment:
    first: int  # lines, from 1
    last: int
    alone: bool  # no code before it on its line
    text: str


def plain(comment):
    """Without the stars; one line a paragraph."""
    lines = [re.sub(r"^\s*\*? ?", "", line).rstrip() for line in comment[2:-2].strip().split("\n")]
    return "\n".join(re.sub(r"\s+", " ", part.strip()) for part in re.split(r"\n\n+", "\n".join(lines)))


class Comments:
    def __init__(self, text):
        self.comments = []
        for found in COMMENT.finditer(text):
            first = text.count("\n", 0, found.start()) + 1
            before = text[text.rfind("\n", 0, found.start()) + 1 : found.start()]
            self.comments.append(
                Comment(first, first + found.group().count("\n"), not before.strip(), plain(found.group()))
            )
        self.code = COMMENT.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text).split("\n")

    def of_file(self):
        """The first paragraph of the comment that begins the file."""
        return self.comments[0].text.split("\n")[0] if self.comments and self.comments[0].first == 1 else ""

    def above(self, line):
        return " ".join(comment.text for comment in self.comments if comment.alone and comment.last == line - 1)

    def behind(self, line, end=""):
        """On the declaration's last line: the first one from `line` on in whose code `end` stands."""
        while end not in self.code[line - 1]:
            line += 1
        return " ".join(comment.text for comment in self.comments if not comment.alone and comment.first == line)

    def around(self, line, end=""):
        return " ".join(filter(None, [self.above(line), self.behind(line, end)]))
