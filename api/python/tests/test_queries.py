"""Queries and collision without a step, against geometry."""

import unittest

from support import first, floor, np, on_each, plumb

NEEDS = ("rotation", "collision", "friction", "queries", "filters")


class Queries(unittest.TestCase):
    def scene(self, engine):
        """Spheres of radius 1 at x = 5, 10, 15, of categories 1, 2, 4."""
        world = engine.world(NEEDS)
        ball = world.create_shape(plumb.Sphere(1))
        bodies = world.create_bodies(
            [
                plumb.BodyDesc(ball, "static", position=(5 * i, 0, 0), filter=plumb.Filter(2 ** (i - 1)))
                for i in (1, 2, 3)
            ]
        )
        world.step(1 / 60)
        return world, ball, bodies

    @on_each(*NEEDS, asked=[("query", "ray")])
    def test_rays(self, engine):
        world, _, bodies = self.scene(engine)
        hits = world.queries.rays((0, 0, 0), [(20, 0, 0), (0, 20, 0), (8, 0, 0)])
        np.testing.assert_array_equal(hits["body"], [bodies[0], 0, bodies[0]])
        np.testing.assert_array_equal(hits["query"], [0, 1, 2])
        np.testing.assert_allclose(hits["fraction"][[0, 2]], [4 / 20, 4 / 8], rtol=1e-4)
        np.testing.assert_allclose(hits["normal"][0], (-1, 0, 0), atol=1e-4)
        every = world.queries.rays([(0, 0, 0), (0, 0, 0)], (20, 0, 0), mode="all")
        np.testing.assert_array_equal(every["body"], [*bodies, *bodies])
        np.testing.assert_array_equal(every["query"], [0, 0, 0, 1, 1, 1])
        far = world.queries.rays((0, 0, 0), (20, 0, 0), filter=plumb.Filter(mask=4))
        np.testing.assert_array_equal(far["body"], bodies[2:])

    @on_each(*NEEDS, asked=[("query", "cast", "sphere")])
    def test_casts(self, engine):
        world, ball, bodies = self.scene(engine)
        hits = world.queries.casts(ball, (0, 0, 0), [(20, 0, 0), (-20, 0, 0)])
        np.testing.assert_array_equal(hits["body"], [bodies[0], 0])
        self.assertAlmostEqual(hits["fraction"][0], 3 / 20, delta=2e-3)

    @on_each(*NEEDS, asked=[("query", "turning_cast", "capsule")])
    def test_turning_casts(self, engine):
        world, _, bodies = self.scene(engine)
        rod = world.create_shape(plumb.Capsule(0.25, 3))  # along y, its middle 2.5 m from the first ball
        turns = [(0, 0, -np.pi), (0, 0, -0.5), (0, np.pi, 0)]
        hits = world.queries.turning_casts(rod, (2.5, 0, 0), (0, 0, 0), turns)
        np.testing.assert_array_equal(hits["body"], [bodies[0], 0, 0])
        met = np.pi / 2 - np.arcsin(1.25 / 2.5)  # before it lies along the way to the ball
        self.assertAlmostEqual(hits["fraction"][0] * np.pi, met, delta=2e-3)
        with self.assertRaisesRegex(plumb.Error, "rotation is 7 rad long; it must be at most 2 pi"):
            world.queries.turning_casts(rod, (2.5, 0, 0), (0, 0, 0), (0, 7, 0))

    @on_each(*NEEDS, asked=[("query", "overlap", "sphere")])
    def test_overlaps(self, engine):
        world, ball, bodies = self.scene(engine)
        hits = world.queries.overlaps(ball, [(7.5, 3, 0), (11.5, 0, 0), (13.9, 0, 0)])
        np.testing.assert_array_equal(hits["query"], [1, 2])
        np.testing.assert_array_equal(hits["body"], bodies[1:])

    @on_each(*NEEDS, asked=[("query", "penetration", "sphere")])
    def test_penetrations(self, engine):
        world, ball, bodies = self.scene(engine)
        rows = world.queries.penetrations(ball, [(7.5, 3, 0), (11.5, 0, 0), (12.5, 0, 0), (15, 1, 0)])
        np.testing.assert_array_equal(rows["query"], [1, 3])
        np.testing.assert_array_equal(rows["body"], bodies[1:])
        np.testing.assert_allclose(rows["depth"], [0.5, 1], atol=1e-4)
        np.testing.assert_allclose(rows["normal"], [(1, 0, 0), (0, 1, 0)], atol=1e-4)
        self.assertEqual(len(world.queries.penetrations(ball, (10, 0.5, 0), filter=plumb.Filter(mask=4))), 0)
        plane = world.create_shape(plumb.Plane())
        with self.assertRaisesRegex(plumb.Error, "is a plane; it must be convex"):
            world.queries.penetrations(plane, (0, 0, 0))

    @on_each(*NEEDS, asked=[("closest", "sphere")])
    def test_closest(self, engine):
        world, ball, bodies = self.scene(engine)
        rows = world.queries.closest(ball, [(0, 0, 0), (5, 4, 0), (0, 90, 0), (10, 1, 0)], [9, 9, 9, 0.25])
        np.testing.assert_array_equal(rows["body"], [bodies[0], bodies[0], 0, bodies[1]])
        np.testing.assert_array_equal(rows["probe"], [0, 1, 2, 3])
        np.testing.assert_allclose(rows["distance"], [3, 2, np.nan, 0], atol=1e-4)
        np.testing.assert_allclose(rows["on_probe"][:2], [(1, 0, 0), (5, 3, 0)], atol=1e-3)
        np.testing.assert_allclose(rows["on_body"][:2], [(4, 0, 0), (5, 1, 0)], atol=1e-3)
        np.testing.assert_allclose(rows["normal"][:2], [(1, 0, 0), (0, -1, 0)], atol=1e-3)
        self.assertTrue(np.isnan(rows["normal"][2:]).all())
        every = world.queries.closest(ball, (0, 0, 0), 10, mode="all")
        np.testing.assert_array_equal(every["body"], bodies[:2])
        np.testing.assert_allclose(every["distance"], [3, 8], atol=1e-4)
        far = world.queries.closest(ball, (0, 0, 0), 100, filter=plumb.Filter(mask=4))
        np.testing.assert_array_equal(far["body"], bodies[2:])
        for most in (0, -1, np.nan, np.inf):
            with self.assertRaisesRegex(plumb.Error, r"probes\[0\].most_distance"):
                world.queries.closest(ball, (0, 0, 0), most)
        plane = world.create_shape(plumb.Plane())
        with self.assertRaisesRegex(plumb.Error, "is a plane; it must be convex"):
            world.queries.closest(plane, (0, 0, 0), 1)

    @on_each("collision", "friction", "rotation")
    def test_collision_without_a_step(self, engine):
        if "plumb.collide/1" not in engine.extensions:
            return
        with engine.world(["collision", "friction", "rotation"]) as world:
            ball, box = world.create_shapes([plumb.Sphere(1), plumb.Box((1, 1, 1))])
            results, points = world.collide.pairs(ball, [ball, box], (0, 0, 0), [(1.9, 0, 0), (0, 1.75, 0)])
            np.testing.assert_allclose(results["distance"], [-0.1, -0.25], atol=1e-3)
            first = points[results["first_point"]]
            np.testing.assert_allclose(first["normal"], [(1, 0, 0), (0, 1, 0)], atol=1e-3)
            np.testing.assert_allclose(first["depth"], [0.1, 0.25], atol=1e-3)

    @on_each("collision", "friction", "rotation")
    def test_what_the_engine_saw(self, engine):
        if "plumb.debug/1" not in engine.extensions:
            return
        with engine.world(["collision", "friction", "rotation"]) as world:
            pair = {
                floor(world),
                world.create_body(plumb.BodyDesc(world.create_shape(plumb.Sphere(1)), position=(0, 0.99, 0))),
            }
            world.step(1 / 60)
            shown = 0
            for look in (
                world.debug.pairs,
                world.debug.axes,
                world.debug.constraints,
                world.debug.bodies,
                world.debug.boxes,
            ):
                try:
                    rows = look()
                except plumb.Error as error:
                    self.assertEqual(error.code, plumb.Result.UNSUPPORTED)
                    continue
                shown += 1
                names = [name for name in ("body", "body_a", "body_b") if name in rows.dtype.names]
                self.assertLessEqual(set(np.concatenate([rows[name] for name in names])) - {0}, pair)
            self.assertTrue(shown)

    def test_what_is_refused(self):
        engine = first(*NEEDS, asked=[("query", "ray")])
        world, ball, _ = self.scene(engine)
        for call, text in [
            (lambda: world.queries.rays((0, 0), (1, 0, 0)), "origin must be 3 numbers"),
            (
                lambda: world.queries.rays(np.zeros((3, 3)), np.ones((2, 3))),
                "translation has 2 rows, where origin has 3",
            ),
            (lambda: world.queries.rays((0, 0, 0), (1, 0, 0), mode="nearest"), 'mode "nearest" is unknown'),
        ]:
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                call()
        with self.assertRaises(plumb.Error):
            world.queries.rays((0, 0, 0), (0, 0, 0))
        with engine.world(["collision"]) as other, self.assertRaises(plumb.Error) as raised:
            other.queries.rays((0, 0, 0), (1, 0, 0))
        self.assertEqual(raised.exception.code, plumb.Result.NOT_DECLARED)


if __name__ == "__main__":
    unittest.main()
