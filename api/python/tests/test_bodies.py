"""Descriptors: every member arrives at the engine, one by one and in batches."""

import unittest

from support import SLIPPERY, first, np, on_each, particle, plumb, steps


class Bodies(unittest.TestCase):
    @on_each("rotation", "collision", "friction", "rolling_friction")
    def test_rolling_friction_arrives(self, engine):
        with engine.world(["rotation", "collision", "friction", "rolling_friction"]) as world:
            ball = world.create_shape(plumb.Sphere(0.5))
            body = world.create_body(plumb.BodyDesc(ball, rolling_friction=0.25, spinning_friction=0.125))
            np.testing.assert_allclose(world.read("rolling_friction", body), [0.25, 0.125])
            world.write("rolling_friction", [0.5, 0], body)
            np.testing.assert_allclose(world.read("rolling_friction", body), [0.5, 0])

    @on_each("rotation", "collision", "friction", "restitution", "damping", "filters")
    def test_members_arrive(self, engine):
        with engine.world(["rotation", "collision", "friction", "restitution", "damping", "filters"]) as world:
            half = np.sqrt(0.5)
            body = world.create_body(
                plumb.BodyDesc(
                    shape=world.create_shape(plumb.Sphere(0.5)),
                    position=(1, 2, 3),
                    orientation=(0, half, 0, half),
                    linear_velocity=(4, 5, 6),
                    angular_velocity=(7, 8, 9),
                    mass=2,
                    centre_of_mass=(0.1, 0, 0),
                    inertia=(3, 4, 5),
                    inertia_orientation=(half, 0, 0, half),
                    material=plumb.Material(0.25, 0.75),
                    gravity_scale=0.5,
                    linear_damping=0.125,
                    angular_damping=0.375,
                    filter=plumb.Filter(6, 12, -3),
                    user_data=2**64 - 1,
                )
            )
            for field, row in [
                ("pose", [1, 2, 3, 0, half, 0, half]),
                ("velocity", [4, 5, 6, 7, 8, 9]),
                ("mass", [2, 0.1, 0, 0, 3, 4, 5, half, 0, 0, half]),
                ("material", [0.25, 0.75]),
                ("gravity_scale", [0.5]),
                ("damping", [0.125, 0.375]),
                ("filter", [6, 12, -3]),
            ]:
                if engine.capability("field_read", field).degree:
                    np.testing.assert_allclose(world.read(field, body), row, rtol=1e-5, atol=1e-6, err_msg=field)
            self.assertEqual(world.user_data(body), 2**64 - 1)

    @on_each("rotation", "collision", "friction")
    def test_where_the_mass_comes_from(self, engine):
        with engine.world(["rotation", "collision", "friction"]) as world:
            cube = world.create_shape(plumb.Box((0.5, 0.5, 0.5)))
            masses = world.read(
                "mass",
                world.create_bodies(
                    [
                        plumb.BodyDesc(cube, density=3),
                        plumb.BodyDesc(cube, mass=12),
                        plumb.BodyDesc(cube, mass=12, inertia=(1, 1, 1)),
                        plumb.BodyDesc(cube, mass=12, mass_mode="from_density"),
                    ]
                ),
            )
            np.testing.assert_allclose(masses[:, 0], [3, 12, 12, 1000])
            np.testing.assert_allclose(masses[:, 4], [3 / 6, 12 / 6, 1, 1000 / 6])

    @on_each("axis_locks", "kinematic", "ccd", "collision", "friction")
    def test_flags_locks_and_motions(self, engine):
        with engine.world(["axis_locks", "kinematic", "ccd", "collision", "friction"]) as world:
            falls, held, lift = world.create_bodies(
                [
                    particle(),
                    particle(locks=["linear_y", plumb.Lock.LINEAR_X]),
                    plumb.BodyDesc(motion="kinematic", linear_velocity=(0, 1, 0), material=SLIPPERY),
                ]
            )
            steps(world, 60)
            self.assertLess(world.read("pose", falls)[1], -4)
            self.assertEqual(world.read("pose", held)[1], 0)
            self.assertAlmostEqual(world.read("pose", lift)[1], 1, places=4)

    @on_each()
    def test_a_batch_of_columns_is_the_same_as_one_by_one(self, engine):
        with engine.world([]) as world:
            rows = plumb.body_rows(100, particle(linear_velocity=(0, 0, 1)))
            rows["position"][:, 1] = np.arange(100)
            world.create_bodies(rows)
            world.create_bodies([particle((0, i, 0), linear_velocity=(0, 0, 1)) for i in range(100)])
            steps(world, 10)
            np.testing.assert_array_equal(world.read("pose")[:100], world.read("pose")[100:])

    def test_what_is_no_descriptor_is_refused_in_words(self):
        with first("collision").world(["collision", "friction"]) as world:
            wrong = [
                (lambda: world.create_body(particle((1, 2))), ValueError, r"bodies\[0\].position must be 3 numbers"),
                (lambda: world.create_bodies([particle(), 7]), TypeError, r"bodies\[1\] must be a BodyDesc, not 7"),
                (lambda: world.create_bodies(np.zeros(3)), TypeError, "plumb.body_rows"),
                (lambda: world.create_body(plumb.BodyDesc(motion="dynamik")), ValueError, 'did you mean "dynamic"'),
                (
                    lambda: world.create_body(plumb.BodyDesc(motion=9)),
                    ValueError,
                    "motion 9 is unknown; known are static",
                ),
                (
                    lambda: world.create_body(plumb.BodyDesc(flags="cdd")),
                    ValueError,
                    'flags "cdd" is unknown; did you mean "ccd"',
                ),
                (
                    lambda: world.create_body(plumb.BodyDesc(locks=1 << 9)),
                    ValueError,
                    "locks 0x200 has bits beyond 0x3f",
                ),
                (lambda: world.create_body(plumb.BodyDesc(shape="cube")), TypeError, "shape must be a handle"),
                (lambda: world.create_body(plumb.BodyDesc(mass="heavy")), ValueError, r"mass must be one number"),
                (lambda: world.create_body(plumb.BodyDesc(user_data=-1)), ValueError, "user_data must be 0 to"),
                (lambda: world.create_shape(7), TypeError, r"shapes\[0\] must be a Sphere, Box"),
                (lambda: world.create_shape(plumb.Box(1)), ValueError, "Box.half_extents must be 3 numbers"),
                (
                    lambda: world.create_shape(plumb.Sphere("1 m")),
                    TypeError,
                    "Sphere.radius must be a number, not '1 m'",
                ),
                (
                    lambda: world.create_shape(plumb.ConvexHull(np.zeros((4, 2)))),
                    ValueError,
                    r"n x 3 numbers, not .* \(4, 2\)",
                ),
                (
                    lambda: world.create_shape(plumb.TriangleMesh(np.zeros((3, 3)), [[0, 1, 2.5]])),
                    ValueError,
                    "whole numbers",
                ),
                (
                    lambda: world.create_shape(plumb.TriangleMesh(np.zeros((3, 3)), [[0, 1, -2]])),
                    ValueError,
                    "index -2",
                ),
                (lambda: world.create_shape(plumb.HeightField([1, 2], (1, 1))), ValueError, "heights must be n x n"),
                (
                    lambda: world.create_shape(
                        plumb.HeightField([[0, 0], [0, 0]], (1, 1), materials=[plumb.Material()], triangle_materials=[0])
                    ),
                    ValueError,
                    "must be 2 whole numbers, one a triangle",
                ),
                (
                    lambda: world.create_shape(
                        plumb.TriangleMesh(
                            np.zeros((3, 3)), [[0, 1, 2]], materials=[plumb.Material()], triangle_materials=[1]
                        )
                    ),
                    ValueError,
                    "triangle_materials has 1",
                ),
                (
                    lambda: world.create_shape(
                        plumb.TriangleMesh(np.zeros((3, 3)), [[0, 1, 2]], triangle_materials=[0])
                    ),
                    ValueError,
                    "but no materials",
                ),
                (
                    lambda: world.create_shape(plumb.Compound([plumb.Child(1, (0, 0))])),
                    ValueError,
                    r"Compound.children\[0\].position must be 3 numbers",
                ),
            ]
            for call, kind, text in wrong:
                with self.subTest(text), self.assertRaisesRegex(kind, text):
                    call()
            self.assertEqual(len(world.bodies), 0)
            with self.assertRaises(plumb.Error) as raised:
                world.create_shape(plumb.Sphere(-1))
            self.assertEqual(raised.exception.code, plumb.Result.INVALID_ARGUMENT)


if __name__ == "__main__":
    unittest.main()
