"""Fields as arrays: what is written is read, in the caller's own memory and type."""

import unittest

from support import first, np, on_each, particle, plumb


class Rows(unittest.TestCase):
    def make(self, engine, count=5, needs=("forces",)):
        world = engine.world(needs, gravity=(0, 0, 0))
        rows = plumb.body_rows(count, particle())
        rows["position"][:, 0] = np.arange(count)
        return world, world.create_bodies(rows)

    @on_each("forces")
    def test_all_and_some_and_one(self, engine):
        world, bodies = self.make(engine)
        np.testing.assert_array_equal(world.bodies, bodies)
        every = world.read("pose")
        self.assertEqual((every.shape, every.dtype), ((5, 7), np.float64))
        np.testing.assert_array_equal(every[:, 0], range(5))
        np.testing.assert_array_equal(world.read("pose", bodies[[3, 1]])[:, 0], [3, 1])
        np.testing.assert_array_equal(world.read(plumb.Field.POSE, list(bodies[:2]))[:, 0], [0, 1])
        self.assertEqual(world.read("pose", bodies[4]).shape, (7,))
        self.assertEqual(world.read("pose", int(bodies[4]))[0], 4)
        self.assertEqual(world.read("pose", []).shape, (0, 7))
        world.close()

    @on_each("forces")
    def test_out_is_filled_where_it_lies(self, engine):
        world, bodies = self.make(engine)
        wide = np.full((5, 16), -1, np.float32)
        out = wide[:, 2:9]  # rows that lie 16 numbers apart
        self.assertIs(world.read("pose", out=out), out)
        np.testing.assert_array_equal(wide[:, 2], range(5))
        self.assertTrue((wide[:, :2] == -1).all() and (wide[:, 9:] == -1).all())
        some = np.empty((2, 7))
        world.read("pose", bodies[3:], out=some)
        np.testing.assert_array_equal(some[:, 0], [3, 4])
        first = world.read("pose", out=np.empty((3, 7)))  # the first three
        np.testing.assert_array_equal(first[:, 0], [0, 1, 2])
        world.close()

    @on_each("forces")
    def test_writes(self, engine):
        world, bodies = self.make(engine)
        world.write("velocity", np.arange(30.0).reshape(5, 6) * [1, 1, 1, 0, 0, 0])
        np.testing.assert_array_equal(world.read("velocity")[:, 0], np.arange(5) * 6)
        world.write("velocity", [1, 2, 3, 0, 0, 0])  # a row for all
        np.testing.assert_allclose(world.read("velocity")[:, :3], [[1, 2, 3]] * 5)
        world.write("velocity", np.zeros((1, 6), np.float32), bodies[1:3])
        np.testing.assert_allclose(world.read("velocity")[:, 0], [1, 0, 0, 1, 1])
        world.write("impulse", (0, 0, 2), bodies[0])
        self.assertAlmostEqual(world.read("velocity", bodies[0])[2], 5)  # 2 N s on 1 kg
        columns = np.zeros((6, 5))
        columns[1] = 7
        world.write("velocity", columns.T)  # whose numbers do not lie side by side
        np.testing.assert_allclose(world.read("velocity")[:, 1], 7)
        world.close()

    def test_what_cannot_be_rows_is_refused_in_words(self):
        engine = first("forces")
        world, bodies = self.make(engine)
        wrong = [
            (lambda: world.read("speed"), ValueError, 'field "speed" is unknown'),
            (lambda: world.read("pos"), ValueError, 'did you mean "pose"'),
            (lambda: world.read(99), ValueError, "field 99 is unknown"),
            (
                lambda: world.read("pose", out=np.empty((5, 6))),
                ValueError,
                r"out must be of shape \(n, 7\), not \(5, 6\)",
            ),
            (lambda: world.read("pose", out=np.empty((5, 7), int)), TypeError, "out must be a NumPy array of float64"),
            (lambda: world.read("pose", out=[[0] * 7] * 5), TypeError, "out must be a NumPy array"),
            (lambda: world.read("pose", bodies, out=np.empty((4, 7))), ValueError, r"shape \(5, 7\)"),
            (lambda: world.read("pose", out=np.empty((7, 5)).T), ValueError, "side by side"),
            (lambda: world.read("pose", out=np.empty((10, 7))[::-2]), ValueError, "one after another"),
            (lambda: world.read("pose", bodies.astype(float)), TypeError, "bodies must be a row of uint64 handles"),
            (lambda: world.read("pose", 1.5), TypeError, "bodies must be a handle or handles, not 1.5"),
            (lambda: world.read("pose", -1), ValueError, r"bodies must be 0 to 2\*\*64 - 1, not -1"),
            (lambda: world.read("pose", ["a"]), TypeError, "whole number that the world gave, not 'a'"),
            (lambda: world.write("velocity", np.zeros((4, 6)), bodies), ValueError, r"values must be 5 x 6 numbers"),
            (lambda: world.write("velocity", np.zeros(5), bodies), ValueError, r"values must be 5 x 6 numbers"),
            (lambda: world.write("velocity", "fast"), TypeError, "values must be real numbers, not 'fast'"),
            (lambda: world.write("velocity", np.zeros((5, 6), complex)), TypeError, "real numbers"),
            (lambda: world.set_gravity((0, 1)), ValueError, r"gravity must be 3 numbers"),
            (lambda: world.step("1/60"), TypeError, "dt must be a number, not '1/60'"),
        ]
        for call, kind, text in wrong:
            with self.subTest(text), self.assertRaisesRegex(kind, text):
                call()
        read_only = np.empty((5, 7))
        read_only.flags.writeable = False
        with self.assertRaisesRegex(ValueError, "out is read only"):
            world.read("pose", out=read_only)

    def test_what_the_backend_refuses_has_its_sentence_and_code(self):
        world, bodies = self.make(first("forces"))
        world.destroy_bodies(bodies[0])
        for call, code in [
            (lambda: world.read("pose", bodies[0]), plumb.Result.STALE_HANDLE),
            (lambda: world.write("velocity", [np.nan] * 6), plumb.Result.INVALID_ARGUMENT),
            (lambda: world.read("force"), plumb.Result.UNSUPPORTED),
            (lambda: world.step(-1), plumb.Result.INVALID_ARGUMENT),
            (lambda: world.read("pose", out=np.empty((9, 7))), plumb.Result.INVALID_ARGUMENT),
        ]:
            with self.subTest(code=code), self.assertRaises(plumb.Error) as raised:
                call()
            self.assertEqual(raised.exception.code, code)
            self.assertEqual(raised.exception.name, code.name)
            self.assertGreater(len(str(raised.exception)), 10)


if __name__ == "__main__":
    unittest.main()
