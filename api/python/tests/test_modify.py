"""Bodies and joints that become others while they live, on engines that can."""

import unittest

from support import SLIPPERY, first, floor, np, on_each, particle, plumb, steps


def able_to(kind, *words):
    return [("modify", kind, word) for word in words]


class Modify(unittest.TestCase):
    @on_each(asked=able_to("bodies", "motion"))
    def test_motion(self, engine):
        with engine.world([]) as world:
            falls, stays = world.create_bodies([particle((0, 10, 0)), particle((5, 10, 0))])
            world.modify.bodies([plumb.BodyChange(stays, motion="static")])
            steps(world, 30)
            self.assertEqual(world.read("pose", stays)[1], 10)
            self.assertLess(world.read("pose", falls)[1], 9)
            world.modify.bodies(
                [plumb.BodyChange(falls, motion=plumb.Motion.STATIC), plumb.BodyChange(stays, motion="dynamic")]
            )
            there = world.read("pose", falls)[1]
            steps(world, 30)
            self.assertEqual(world.read("pose", falls)[1], there)
            self.assertLess(world.read("pose", stays)[1], 9)

    @on_each("rotation", "collision", "friction", asked=able_to("shapes", "height_field"))
    def test_ground(self, engine):
        with engine.world(["rotation", "collision", "friction"]) as world:
            heights = np.zeros((9, 9))
            ground = world.create_shape(plumb.HeightField(heights, (1, 1)))
            world.create_body(plumb.BodyDesc(ground, "static"))
            ball = world.create_body(plumb.BodyDesc(world.create_shape(plumb.Sphere(0.5)), position=(0, 0.5, 0)))
            steps(world, 10)
            heights[3:6, 3:6] = -1
            world.modify.shapes(ground, [plumb.HeightField(heights, (1, 1))])
            steps(world, 120)
            self.assertAlmostEqual(world.read("pose", ball)[1], -0.5, delta=0.05)
            with self.assertRaisesRegex(plumb.Error, "type is sphere"):
                world.modify.shapes([ground], [plumb.Sphere(1)])
            with self.assertRaisesRegex(plumb.Error, "1 shapes become 2 others"):
                world.modify.shapes([ground], [plumb.HeightField(heights, (1, 1))] * 2)

    @on_each("rotation", "collision", "friction", asked=able_to("bodies", "shape", "mass"))
    def test_shape_and_mass(self, engine):
        with engine.world(["rotation", "collision", "friction"]) as world:
            floor(world)
            small, large = world.create_shapes([plumb.Sphere(0.25), plumb.Sphere(0.5)])
            body = world.create_body(plumb.BodyDesc(small, position=(0, 0.25, 0), mass=1))
            world.modify.bodies([plumb.BodyChange(body, shape=large)])
            self.assertAlmostEqual(world.read("mass", body)[0], 1)
            world.modify.bodies([plumb.BodyChange(body, mass=3)])
            self.assertAlmostEqual(world.read("mass", body)[0], 3)
            np.testing.assert_allclose(world.read("mass", body)[4:7], 0.4 * 3 * 0.5**2)
            world.modify.bodies([plumb.BodyChange(body, density=10)])
            self.assertAlmostEqual(world.read("mass", body)[0], 10 * 4 / 3 * np.pi * 0.5**3)
            world.modify.bodies([plumb.BodyChange(body, mass=2, inertia=(1, 2, 3), centre_of_mass=(0.1, 0, 0))])
            np.testing.assert_allclose(world.read("mass", body)[:7], [2, 0.1, 0, 0, 1, 2, 3])
            steps(world, 60)
            self.assertGreater(world.read("pose", body)[1], 0.4)

    @on_each("axis_locks", asked=able_to("bodies", "locks"))
    def test_locks(self, engine):
        with engine.world(["axis_locks"]) as world:
            body = world.create_body(particle(linear_velocity=(1, 0, 0)))
            world.modify.bodies([plumb.BodyChange(body, locks=["linear_y", "linear_x"])])
            steps(world, 30)
            np.testing.assert_array_equal(world.read("pose", body)[:3], [0, 0, 0])
            world.modify.bodies([plumb.BodyChange(body, locks=[])])
            steps(world, 30)
            self.assertLess(world.read("pose", body)[1], -0.5)

    @on_each(
        "rotation", "collision", "friction", "joints", asked=able_to("joints", "limits", "motors", "frames", "enabled")
    )
    def test_joints(self, engine):
        with engine.world(["rotation", "collision", "friction", "joints"], gravity=(0, 0, 0)) as world:
            box = world.create_shape(plumb.Box((0.5, 0.1, 0.1)))
            body = world.create_body(plumb.BodyDesc(box, mass=1, material=SLIPPERY))
            joint = world.joints.create(plumb.JointDesc("slider", body))
            world.modify.joints(
                [plumb.JointChange(joint, motors={0: plumb.Motor(1, 100)}, limits={0: plumb.Limit(-1, 0.5)})]
            )
            steps(world, 120)
            self.assertAlmostEqual(world.joints.read("coordinates", joint)[0], 0.5, delta=0.02)
            world.modify.joints([plumb.JointChange(joint, motors={}, limits={}, position_a=(0, 2, 0))])
            steps(world, 120)
            self.assertAlmostEqual(world.read("pose", body)[1], 2, delta=0.02)
            world.modify.joints([plumb.JointChange(joint, enabled=False)])
            world.write("velocity", (0, 0, 1, 0, 0, 0), body)
            steps(world, 60)
            self.assertGreater(world.read("pose", body)[2], 0.9)

    def test_what_is_refused(self):
        engine = first(asked=able_to("bodies", "motion"))
        with engine.world([]) as world:
            body = world.create_body(particle())
            for change, text in [
                (plumb.BodyChange(body, motion="statik"), r'changes\[0\].motion "statik" is unknown'),
                (plumb.BodyChange(body, inertia=(1, 2)), r"changes\[0\].inertia must be 3 numbers"),
                (plumb.BodyChange(body, locks="x"), "locks"),
            ]:
                with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                    world.modify.bodies([change])
            with self.assertRaises(plumb.Error) as raised:
                world.modify.bodies([plumb.BodyChange(body, motion="static")] * 2)
            self.assertEqual(raised.exception.code, plumb.Result.INVALID_ARGUMENT)
        answers = engine.capabilities()
        self.assertIn(("modify", "joints", "enabled"), answers)
        self.assertIn(("modify", "bodies", "locks"), answers)


if __name__ == "__main__":
    unittest.main()
