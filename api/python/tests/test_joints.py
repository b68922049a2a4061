"""Joints: limits, motors, springs, breaking, on engines that have them."""

import unittest

from support import first, np, on_each, plumb, steps

NEEDS = ("rotation", "collision", "friction", "joints")


def having(kind, *features):
    return [("joint", kind)] + [("joint_feature", kind, feature) for feature in features]


class Joints(unittest.TestCase):
    def bar(self, world, **more):
        """A bar along x whose left end is at the origin."""
        shape = world.create_shape(plumb.Box((0.5, 0.05, 0.05)))
        return world.create_body(plumb.BodyDesc(shape, position=(0.5, 0, 0), mass=1, **more))

    @on_each(*NEEDS, asked=having("hinge", "has_limits"))
    def test_a_hinge_stops_at_its_limit(self, engine):
        """About z: the hinge's axis is x of its frames, which are turned by 90 degrees about y."""
        turned = (0, -np.sqrt(0.5), 0, np.sqrt(0.5))
        with engine.world(NEEDS) as world:
            bar = self.bar(world)
            joint = world.joints.create(
                plumb.JointDesc(
                    "hinge",
                    bar,
                    orientation_a=turned,
                    position_b=(-0.5, 0, 0),
                    orientation_b=turned,
                    limits={3: plumb.Limit(-0.3, 0.3)},
                )
            )
            steps(world, 180)
            angle = world.joints.read("coordinates", joint)
            self.assertEqual(angle.shape, (6,))
            self.assertAlmostEqual(abs(angle[3]), 0.3, delta=0.03)
            np.testing.assert_allclose(angle[:3], 0, atol=0.01)

    @on_each(*NEEDS, asked=having("slider", "has_motors"))
    def test_motors_are_read_and_written(self, engine):
        with engine.world(NEEDS, gravity=(0, 0, 0)) as world:
            bar = self.bar(world)
            joint = world.joints.create(
                plumb.JointDesc("slider", bar, position_a=(0.5, 0, 0), motors={0: plumb.Motor(2, 1000)})
            )
            steps(world, 30)
            self.assertAlmostEqual(world.read("velocity", bar)[0], 2, delta=0.02)
            motors = world.joints.read("motor", [joint])
            self.assertEqual((motors[0, 0], motors[0, 6] if motors[0, 6] else motors[0, 1]), (2, 1000))
            world.joints.write("motor", motors * np.where(motors == 2, -1, 1), joint)
            steps(world, 30)
            self.assertAlmostEqual(world.read("velocity", bar)[0], -2, delta=0.02)

    @on_each(*NEEDS, asked=having("slider", "has_springs"))
    def test_a_spring_swings_at_its_frequency(self, engine):
        with engine.world(NEEDS, gravity=(0, 0, 0)) as world:
            bar = self.bar(world, linear_velocity=(1, 0, 0))
            world.joints.create(
                plumb.JointDesc("slider", bar, position_a=(0.5, 0, 0), springs={0: plumb.Spring(1, damping_ratio=0)})
            )
            x = []
            for _ in range(240):
                world.step(1 / 240)
                x.append(world.read("pose", bar)[0] - 0.5)
            self.assertAlmostEqual(np.argmax(x) / 240, 0.25, delta=0.03)  # a quarter of the period
            self.assertAlmostEqual(np.argmin(x) / 240, 0.75, delta=0.03)

    @on_each(*NEEDS, asked=having("slider", "has_stiffness"))
    def test_a_spring_by_stiffness_swings_with_its_mass(self, engine):
        with engine.world(NEEDS, gravity=(0, 0, 0)) as world:
            bar = self.bar(world, linear_velocity=(1, 0, 0))
            stiffness = world.read("mass", bar)[0] * (2 * np.pi) ** 2  # 1 Hz
            world.joints.create(
                plumb.JointDesc("slider", bar, position_a=(0.5, 0, 0), springs={0: plumb.StiffSpring(stiffness)})
            )
            x = []
            for _ in range(240):
                world.step(1 / 240)
                x.append(world.read("pose", bar)[0] - 0.5)
            self.assertAlmostEqual(np.argmax(x) / 240, 0.25, delta=0.03)
            self.assertAlmostEqual(np.argmin(x) / 240, 0.75, delta=0.03)

    @on_each(*NEEDS, asked=having("slider", "has_targets"))
    def test_where_a_spring_rests_is_read_and_written(self, engine):
        with engine.world(NEEDS, gravity=(0, 0, 0)) as world:
            bar = self.bar(world)
            joint = world.joints.create(
                plumb.JointDesc("slider", bar, position_a=(0.5, 0, 0), springs={0: plumb.Spring(2, rest=0.1)})
            )
            rest = world.joints.read("spring_rest", joint)
            np.testing.assert_allclose(rest, (0.1, 0, 0, 0, 0, 0))
            rest[0] = -0.4
            world.joints.write("spring_rest", rest, joint)
            steps(world, 180)
            self.assertAlmostEqual(world.read("pose", bar)[0], 0.5 - 0.4, delta=0.01)

    @on_each(*NEEDS, "events", asked=having("fixed", "breaks"))
    def test_a_joint_breaks_and_says_so(self, engine):
        with engine.world([*NEEDS, "events"]) as world:
            bar = self.bar(world)
            joint = world.joints.create(plumb.JointDesc("fixed", bar, position_a=(0.5, 0, 0), break_force=5))
            broken = [
                event["joint"]
                for _ in range(10)
                if world.step(1 / 60)
                for event in world.events()
                if event["type"] == plumb.EventType.JOINT_BROKEN
            ]
            self.assertEqual(broken, [joint])
            with self.assertRaises(plumb.Error) as raised:
                world.joints.destroy(joint)
            self.assertEqual(raised.exception.code, plumb.Result.STALE_HANDLE)

    @on_each(*NEEDS, asked=having("generic"))
    def test_a_generic_joint_has_modes(self, engine):
        with engine.world(NEEDS) as world:
            bar = self.bar(world)
            world.joints.create(
                plumb.JointDesc(
                    "generic",
                    bar,
                    position_a=(0.5, 0, 0),
                    axis_modes={0: "locked", 2: plumb.AxisMode.LOCKED, 3: "locked", 4: "locked", 5: "locked"},
                )
            )
            steps(world, 30)
            x, y, z = world.read("pose", bar)[:3]
            self.assertLess(y, -1)
            np.testing.assert_allclose([x, z], [0.5, 0], atol=1e-3)

    def test_what_is_refused(self):
        engine = first(*NEEDS, asked=having("ball"))
        with engine.world(NEEDS) as world:
            bar = self.bar(world)
            for desc, text in [
                (plumb.JointDesc("bal", bar), 'did you mean "ball"'),
                (plumb.JointDesc("hinge", bar, limits={6: plumb.Limit(0, 1)}), "limits names the axis 6"),
                (plumb.JointDesc("ball", bar, position_a=(1,) * 4), r"joints\[0\].position_a must be 3 numbers"),
            ]:
                with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                    world.joints.create(desc)
            joint = world.joints.create(plumb.JointDesc("ball", bar))
            with self.assertRaises(plumb.Error) as raised:
                world.destroy_bodies(bar)
            self.assertEqual(raised.exception.code, plumb.Result.IN_USE)
            world.joints.destroy([joint])
            world.destroy_bodies(bar)


if __name__ == "__main__":
    unittest.main()
