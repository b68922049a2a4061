"""All types of shapes, seen by what rays find of them and by their mass."""

import unittest

from support import first, np, on_each, plumb

QUERIES = ("rotation", "collision", "friction", "queries")


def heights_along_x(world, xs):
    """Of what lies under (x, 0.1)."""
    hits = world.queries.rays([(x, 10, 0.1) for x in xs], (0, -20, 0))
    return np.where(hits["body"] != 0, hits["position"][:, 1], np.nan)


class Shapes(unittest.TestCase):
    @on_each(*QUERIES, asked=[("query", "ray")])
    def test_simple_ones(self, engine):
        corners = np.array([(x, y, z) for x in (-1, 1) for y in (-2, 2) for z in (-1, 1)])
        quads = [
            (0, 1, 3),
            (0, 3, 2),
            (4, 6, 7),
            (4, 7, 5),
            (0, 4, 5),
            (0, 5, 1),
            (2, 3, 7),
            (2, 7, 6),
            (0, 2, 6),
            (0, 6, 4),
            (1, 5, 7),
            (1, 7, 3),
        ]
        tops = {
            "sphere": (plumb.Sphere(2), np.sqrt(4 - 0.01)),
            "box": (plumb.Box((1, 2, 1)), 2),
            "capsule": (plumb.Capsule(0.5, 1), 1 + np.sqrt(0.25 - 0.01)),
            "cylinder": (plumb.Cylinder(1, 2), 2),
            "convex_hull": (plumb.ConvexHull(corners), 2),
            "triangle_mesh": (plumb.TriangleMesh(corners, quads), 2),
            "plane": (plumb.Plane(), 0),
        }
        for name, (shape, top) in tops.items():
            if not engine.capability("shape", name, "static").degree:
                continue
            with self.subTest(name), engine.world(QUERIES) as world:
                body = plumb.BodyDesc(world.create_shape(shape), "static", position=(5, 0, 0))
                world.create_body(body)
                world.step(1 / 60)
                self.assertAlmostEqual(heights_along_x(world, [5])[0], top, delta=0.01)
                self.assertEqual(np.isnan(heights_along_x(world, [0])[0]), name != "plane")

    @on_each(*QUERIES, asked=[("query", "ray"), ("cooking", "triangle_mesh")])
    def test_cooked_ones(self, engine):
        corners, triangles = [(-2, 1, -2), (-2, 1, 2), (2, 1, -2), (2, 1, 2)], [(0, 1, 2), (2, 1, 3)]
        mesh = engine.cook(plumb.TriangleMesh(corners, triangles))
        self.assertIsInstance(mesh, bytes)
        self.assertEqual(mesh, engine.cook(plumb.TriangleMesh(corners, triangles)))
        with engine.world(QUERIES) as world:
            behind = memoryview(b"file" + mesh)[4:]
            for shape, x in zip(world.create_cooked([mesh, bytearray(mesh), behind]), (0, 5, 10)):
                world.create_body(plumb.BodyDesc(shape, "static", position=(x, 0, 0)))
            world.step(1 / 60)
            np.testing.assert_allclose(heights_along_x(world, [0, 5, 10]), [1, 1, 1], atol=0.01)
            with self.assertRaisesRegex(plumb.Error, "shapes\\[0\\].data has 10 bytes, less than the header") as caught:
                world.create_cooked([mesh[:10]])
            self.assertEqual(caught.exception.code, plumb.Result.CORRUPT)
            with self.assertRaisesRegex(plumb.Error, "its checksum is another"):
                world.create_cooked([mesh, mesh[:-1] + bytes([mesh[-1] ^ 1])])
            with self.assertRaisesRegex(ValueError, "must lie one after another"):
                world.create_cooked([memoryview(mesh)[::2]])
            with self.assertRaises(TypeError):
                world.create_cooked([7])
            with self.assertRaisesRegex(plumb.Error, "cook the children"):
                engine.cook(plumb.Compound([plumb.Child(int(world.create_shape(plumb.Sphere(1))))]))
            with self.assertRaisesRegex(TypeError, "must be a Sphere, Box or another shape"):
                engine.cook(mesh)

    @on_each(*QUERIES, asked=[("query", "ray"), ("shape", "height_field", "static")])
    def test_height_fields(self, engine):
        with engine.world(QUERIES) as world:
            heights = np.repeat(np.arange(5.0)[np.newaxis], 3, axis=0)  # rising along x, by 1 every 2 m
            world.create_body(plumb.BodyDesc(world.create_shape(plumb.HeightField(heights, (2, 3))), "static"))
            world.step(1 / 60)
            np.testing.assert_allclose(
                heights_along_x(world, [-4 + 0.1, -1, 0.5, 3]), [0.05, 1.5, 2.25, 3.5], atol=0.02
            )
            self.assertTrue(np.isnan(heights_along_x(world, [4.5])[0]), "the field is 8 m long")

    @on_each("rotation", "collision", "friction", asked=[("triangle_material", "triangle_mesh")])
    def test_materials_by_triangle(self, engine):
        corners = [(x, 0, z) for x in (-20, 0, 20) for z in (-20, 20)]
        halves = [(0, 1, 3), (0, 3, 2), (2, 3, 5), (2, 5, 4)]
        ice = dict(materials=[plumb.Material(0)], triangle_materials=[0, 0, -1, -1])
        with engine.world(["rotation", "collision", "friction"]) as world:
            mesh = world.create_shape(plumb.TriangleMesh(corners, halves, **ice))
            world.create_body(plumb.BodyDesc(mesh, "static"))
            box = world.create_shape(plumb.Box((0.5, 0.25, 0.5)))
            slides, stops = (
                world.create_body(plumb.BodyDesc(box, position=(x, 0.25, 1), linear_velocity=(2, 0, 0)))
                for x in (-15, 5)
            )
            for _ in range(60):
                world.step(1 / 60)
            self.assertAlmostEqual(world.read("velocity", slides)[0], 2, delta=0.02)
            self.assertAlmostEqual(world.read("velocity", stops)[0], 0, delta=0.02)

    @on_each("rotation", "collision", "friction", asked=[("shape", "compound", "dynamic")])
    def test_compounds(self, engine):
        with engine.world(["rotation", "collision", "friction"]) as world:
            cube = world.create_shape(plumb.Box((0.5, 0.5, 0.5)))
            pair = world.create_shape(
                plumb.Compound(
                    [plumb.Child(cube, (-1, 0, 0)), plumb.Child(cube, (3, 0, 0), (0, 0, 1, 0), plumb.Material(1, 0))]
                )
            )
            mass = world.read("mass", world.create_body(plumb.BodyDesc(pair, density=2)))
            np.testing.assert_allclose(mass[:4], [4, 1, 0, 0], atol=1e-9)
            np.testing.assert_allclose(sorted(mass[4:7]), [4 / 6, 4 / 6 + 4 * 2**2, 4 / 6 + 4 * 2**2])
            with self.assertRaises(plumb.Error) as raised:
                world.destroy_shapes(cube)
            self.assertEqual(raised.exception.code, plumb.Result.IN_USE)

    def test_arrays_may_die_after_the_call(self):
        with first("rotation", "collision", "friction").world(["rotation", "collision", "friction"]) as world:
            vertices = np.random.default_rng(1).normal(size=(50, 3)).astype(np.float32)[::2]  # to be converted
            shape = world.create_shape(plumb.ConvexHull(vertices))
            vertices[:] = 0
            self.assertGreater(world.read("mass", world.create_body(plumb.BodyDesc(shape)))[0], 100)


if __name__ == "__main__":
    unittest.main()
