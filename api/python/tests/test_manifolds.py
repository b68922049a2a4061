"""Contacts that a host changes before they are solved, on engines that let it."""

import unittest

from support import floor, np, on_each, plumb

NEEDS = ["rotation", "collision", "friction", "contact_modification"]


def box_on_floor(world, **others):
    floor(world)
    shape = world.create_shape(plumb.Box((0.5, 0.5, 0.5)))
    return world.create_body(plumb.BodyDesc(shape, position=(0, 0.5, 0), flags="modify_contacts", **others))


class Manifolds(unittest.TestCase):
    @on_each(*NEEDS, asked=[("manifold", "disabled")])
    def test_disabled(self, engine):
        with engine.world(NEEDS) as world:
            body = box_on_floor(world)
            seen = []

            def through(manifolds, changes):
                seen.append(len(manifolds))
                self.assertTrue(np.all((manifolds["body_a"] == body) | (manifolds["body_b"] == body)))
                np.testing.assert_allclose(np.abs(manifolds["normal"][:, 1]), 1, atol=1e-3)
                changes["what"] = plumb.ContactChange.DISABLED

            for _ in range(12):
                world.step(1 / 60, through)
            self.assertGreater(len(seen), 0)
            self.assertLess(world.read("pose", body)[1], 0.4)

    @on_each(*NEEDS, asked=[("manifold", "friction")])
    def test_friction(self, engine):
        with engine.world(NEEDS) as world:
            body = box_on_floor(world)
            world.step(1 / 60)
            world.write("velocity", (2, 0, 0, 0, 0, 0), body)

            def ice(_, changes):
                changes["what"] |= plumb.ContactChange.FRICTION
                changes["friction"] = 0

            for _ in range(30):
                world.step(1 / 60, ice)
            self.assertAlmostEqual(world.read("velocity", body)[0], 2, places=1)
            for _ in range(60):
                world.step(1 / 60, lambda manifolds, changes: None)
            self.assertLess(world.read("velocity", body)[0], 0.1)

    @on_each(*NEEDS)
    def test_what_is_wrong(self, engine):
        with engine.world(NEEDS) as world:
            body = box_on_floor(world)

            def unknown(_, changes):
                changes["what"] = 1 << 30

            with self.assertRaises(plumb.Error):
                world.step(1 / 60, unknown)

            def broken(*_):
                raise KeyError("of the host's own")

            with self.assertRaises(KeyError):
                world.step(1 / 60, broken)
            world.step(1 / 60)  # the steps that failed are over
            self.assertAlmostEqual(world.read("pose", body)[1], 0.5, places=1)


if __name__ == "__main__":
    unittest.main()
