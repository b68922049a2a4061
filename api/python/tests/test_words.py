"""The enumerations are those of the headers, to the last member."""

import pathlib
import re
import unittest
from enum import IntEnum, IntFlag

from support import plumb

INCLUDE = pathlib.Path(__file__).resolve().parents[2] / "include" / "plumb"
MEMBER = re.compile(r"PLUMB_(\w+) = (-?\w+(?: << \d+)?)")
COUNT = re.compile(r"#define PLUMB_(\w+_COUNT) (\d+)")
NEED = re.compile(r"#define PLUMB_(NEED_\w+) \(\(PlumbNeeds\)1 << (\d+)\)")

# What each enumeration's members begin with in C.
PREFIXES = {
    plumb.Need: "NEED_",
    plumb.ShapeType: "",
    plumb.Motion: "",
    plumb.BodyFlag: "BODY_",
    plumb.Lock: "LOCK_",
    plumb.MassMode: "MASS_",
    plumb.Field: "FIELD_",
    plumb.JointType: "JOINT_",
    plumb.AxisMode: "AXIS_",
    plumb.JointField: "JOINT_",
    plumb.SpringMode: "SPRING_",
    plumb.JointFeature: "JOINT_",
    plumb.QueryKind: "QUERY_",
    plumb.HitMode: "HIT_",
    plumb.EventType: "EVENT_",
    plumb.Phase: "PHASE_",
    plumb.Remark: "REMARK_",
    plumb.CapabilityKind: "CAP_",
    plumb.Degree: "",
    plumb.Determinism: "DETERMINISM_",
    plumb.SettingType: "SETTING_",
    plumb.SettingRole: "ROLE_",
    plumb.BodyMember: "MODIFY_",
    plumb.JointMember: "MODIFY_",
    plumb.ContactChange: "MANIFOLD_",
    plumb.Result: "",
}


def number(text):
    """Of "-4" or "1u << 3"."""
    value, _, shift = text.replace("u", "").partition(" << ")
    return int(value) << int(shift or 0)


def defined():
    """All of the headers' numbers: {"JOINT_BALL": 0}."""
    text = "".join(header.read_text() for header in INCLUDE.glob("*.h"))
    numbers = {name: number(value) for name, value in MEMBER.findall(text) + COUNT.findall(text)}
    return numbers | {name: 1 << int(bit) for name, bit in NEED.findall(text)}


def value_of(kind, name, numbers):
    if kind is plumb.Result and "E_" + name in numbers:
        return numbers["E_" + name]
    return numbers[PREFIXES[kind] + name]


@unittest.skipUnless(INCLUDE.is_dir(), "the headers are not beside the tests")
class Words(unittest.TestCase):
    def test_every_member_has_its_number(self):
        numbers = defined()
        for kind in PREFIXES:
            for name, member in kind.__members__.items():
                with self.subTest(kind=kind.__name__, name=name):
                    self.assertEqual(member, value_of(kind, name, numbers))

    def test_none_is_missing(self):
        numbers = defined()
        counts = {
            plumb.ShapeType: "SHAPE_TYPE_COUNT",
            plumb.Motion: "MOTION_COUNT",
            plumb.Field: "FIELD_COUNT",
            plumb.JointType: "JOINT_TYPE_COUNT",
            plumb.JointField: "JOINT_FIELD_COUNT",
            plumb.JointFeature: "JOINT_FEATURE_COUNT",
            plumb.QueryKind: "QUERY_KIND_COUNT",
            plumb.EventType: "EVENT_COUNT",
            plumb.CapabilityKind: "CAP_COUNT",
        }
        for kind, count in counts.items():
            self.assertEqual(len(kind), numbers[count], kind.__name__)
        for kind in (
            plumb.Need,
            plumb.BodyFlag,
            plumb.Lock,
            plumb.MassMode,
            plumb.AxisMode,
            plumb.SpringMode,
            plumb.Phase,
            plumb.Remark,
            plumb.Determinism,
            plumb.SettingRole,
        ):
            of_c = {name for name in numbers if name.startswith(PREFIXES[kind])} - {PREFIXES[kind] + "COUNT"}
            self.assertEqual({PREFIXES[kind] + name for name in kind.__members__}, of_c, kind.__name__)
        self.assertEqual(
            (len(plumb.BodyMember), len(plumb.JointMember), len(plumb.ContactChange)),
            (numbers["MODIFY_BODY_COUNT"], numbers["MODIFY_JOINT_COUNT"], numbers["MANIFOLD_CHANGE_COUNT"]),
        )
        self.assertEqual(sum(name.startswith("E_") for name in numbers), sum(code < 0 for code in plumb.Result))

    def test_all_enumerations_are_asked_for_here(self):
        public = {
            thing
            for thing in vars(plumb).values()
            if isinstance(thing, type) and issubclass(thing, (IntEnum, IntFlag))
        }
        self.assertEqual(public, set(PREFIXES))


if __name__ == "__main__":
    unittest.main()
