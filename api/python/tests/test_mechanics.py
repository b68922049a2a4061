"""Closed forms, on every engine."""

import unittest

from support import floor, np, on_each, particle, plumb, steps


class Mechanics(unittest.TestCase):
    @on_each()
    def test_free_fall(self, engine):
        with engine.world([], gravity=(0, -10, 0)) as world:
            body = world.create_body(particle((0, 100, 0), linear_velocity=(3, 0, 0)))
            steps(world, 100, 0.01)
            x, y = world.read("pose", body)[:2]
            self.assertAlmostEqual(x, 3, places=3)
            self.assertAlmostEqual(y, 100 - 10 / 2, delta=0.06)  # semi-implicit Euler: g t dt / 2 = 0.05
            np.testing.assert_allclose(world.read("velocity", body), [3, -10, 0, 0, 0, 0], atol=1e-4)

    @on_each("rotation", "collision", "friction", "joints", asked=[("joint", "ball")])
    def test_pendulum(self, engine):
        """A ball of radius r whose centre is l below a joint: 2 pi sqrt((l^2 + 2/5 r^2) / (l g)) (1 + theta^2 / 16)."""
        with engine.world(["rotation", "collision", "friction", "joints"]) as world:
            ball = world.create_shape(plumb.Sphere(0.4))
            bob = world.create_body(plumb.BodyDesc(ball, position=(0.1, -1, 0)))
            world.joints.create(plumb.JointDesc("ball", body_b=bob, position_b=(-0.1, 1, 0)))
            length, angle = np.hypot(1, 0.1), np.arctan(0.1)
            row, x = np.empty((1, 7)), []
            for _ in range(960):
                world.step(1 / 240)
                world.read("pose", [bob], out=row)
                x.append(row[0, 0])
            x = np.array(x)
            crossings = np.flatnonzero(np.diff(np.sign(x)))
            at = crossings + x[crossings] / (x[crossings] - x[crossings + 1])
            period = 2 * np.mean(np.diff(at)) / 240
            truth = 2 * np.pi * np.sqrt((length**2 + 0.4 * 0.4**2) / (length * 9.81)) * (1 + angle**2 / 16)
            self.assertAlmostEqual(period / truth, 1, delta=0.005)

    @on_each("rotation", "collision", "friction", "contacts", "contact_impulses")
    def test_a_cube_rests_and_its_contacts_bear_it(self, engine):
        with engine.world(["rotation", "collision", "friction", "contacts", "contact_impulses"]) as world:
            ground = floor(world)
            cube = world.create_body(
                plumb.BodyDesc(world.create_shape(plumb.Box((0.5, 0.5, 0.5))), position=(0, 0.5, 0))
            )
            steps(world, 60)
            self.assertAlmostEqual(world.read("pose", cube)[1], 0.5, delta=0.02)
            contacts = world.contacts()
            self.assertTrue(len(contacts))
            self.assertEqual(
                set(map(frozenset, zip(contacts["body_a"], contacts["body_b"]))), {frozenset({ground, cube})}
            )
            up = np.where(contacts["body_b"] == cube, 1, -1) * contacts["normal"][:, 1]
            np.testing.assert_allclose(up, 1, atol=1e-3)
            self.assertAlmostEqual(contacts["normal_impulse"].sum() * 60 / (1000 * 9.81), 1, delta=0.02)


if __name__ == "__main__":
    unittest.main()
