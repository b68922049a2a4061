"""Lent rows: no copy, right lifetimes, NumPy and DLPack."""

import ctypes
import functools
import gc
import resource
import unittest

from support import engines, first, np, on_each, particle, plumb


MANY = 5000


@functools.lru_cache(maxsize=None)
def lends(engine):
    with engine.world([]) as world:
        world.create_body(particle())
        try:
            world.state.borrow("pose")
        except plumb.Error as error:
            assert error.code == plumb.Result.UNSUPPORTED, error
            return False
        return True


def lenders(count=3):
    """Engines that lend their rows as they lie in memory on the host, each with a world of some particles."""
    for engine in filter(lends, engines()):
        world = engine.world([])
        rows = plumb.body_rows(count, particle())
        rows["position"][:, 0] = np.arange(count)
        yield world, world.create_bodies(rows)


def address(array):
    return array.__array_interface__["data"][0]


class LentRows(unittest.TestCase):
    def each(self):
        worlds = list(lenders())
        if not worlds:
            self.skipTest("no engine lends its rows without a copy")
        for world, bodies in worlds:
            with self.subTest(engine=world.backend.info.name):
                yield world, bodies

    def test_a_view_is_the_engines_own_memory(self):
        for world, bodies in self.each():
            rows = world.state.borrow("pose")
            self.assertFalse(rows.is_copy)
            view = rows.numpy()
            self.assertEqual(address(view), rows.address)
            self.assertEqual(address(rows.numpy()), address(view), "every view is of the same memory")
            self.assertEqual(address(np.asarray(rows)), address(view))
            self.assertEqual(address(np.from_dlpack(rows)), address(view))
            self.assertEqual(address(world.state.borrow("pose").numpy()), address(view), "until the world changes")
            self.assertFalse(view.flags.owndata)
            self.assertEqual(view.flags.writeable, not rows.read_only)
            self.assertEqual((view.shape[1], view.dtype), (7, rows.dtype))
            where, _ = world.state.rows()
            order = [list(where).index(body) for body in bodies]
            np.testing.assert_array_equal(view[order], world.read("pose"))

    def test_rows_of_after_the_step(self):
        for world, bodies in self.each():
            world.step(0.1)
            for field in ("pose", "velocity"):
                where, _ = world.state.rows()
                order = [list(where).index(body) for body in bodies]
                np.testing.assert_allclose(world.state.borrow(field).numpy()[order], world.read(field), rtol=1e-6)

    def test_a_view_outlives_its_world(self):
        """Of many rows, whose memory goes back to the system when it is freed: who looked there then would crash."""
        for look in (plumb.LentRows.numpy, np.from_dlpack, np.asarray):
            for world, _ in lenders(MANY):
                with self.subTest(engine=world.backend.info.name, look=look.__name__):
                    view = look(world.state.borrow("pose"))
                    before = view.copy()
                    world.close()
                    del world
                    gc.collect()
                    np.testing.assert_array_equal(view, before)

    def test_rows_are_given_back(self):
        def look():
            for world, _ in lenders(MANY):
                rows = world.state.borrow("pose")
                kept = [rows.numpy(), np.from_dlpack(rows), rows.__dlpack__(), rows.__dlpack__(max_version=(1, 0))]
                world.close()
                del kept

        look()
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(60):
            look()
        more = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
        self.assertLess(more, 10, "MB; the rows of one round are a quarter of one")

    def test_the_map_of_rows_changes_with_the_bodies(self):
        for world, bodies in self.each():
            before = world.state.rows()
            self.assertEqual(set(before.bodies[before.bodies != 0]), set(bodies))
            world.destroy_bodies(bodies[1])
            after = world.state.rows()
            self.assertNotEqual(after.generation, before.generation)
            self.assertEqual(set(after.bodies[after.bodies != 0]), {bodies[0], bodies[2]})

    def test_conversions(self):
        for world, _ in self.each():
            rows = world.state.borrow("pose")
            self.assertEqual(np.asarray(rows, np.float16).dtype, np.float16)
            self.assertNotEqual(address(np.array(rows)), rows.address)
            with self.assertRaisesRegex(BufferError, "are not moved to"):
                rows.__dlpack__(dl_device=(2, 0))
            with self.assertRaisesRegex(BufferError, "not copied"):
                rows.__dlpack__(copy=True)

    def test_capsules_by_version(self):
        name = ctypes.pythonapi.PyCapsule_GetName
        name.restype, name.argtypes = ctypes.c_char_p, [ctypes.py_object]
        pointer = ctypes.pythonapi.PyCapsule_GetPointer
        pointer.restype, pointer.argtypes = ctypes.c_void_p, [ctypes.py_object, ctypes.c_char_p]
        for world, _ in self.each():
            rows = world.state.borrow("velocity")
            self.assertEqual(rows.__dlpack_device__(), (1, 0))
            self.assertEqual(name(rows.__dlpack__()), b"dltensor")
            self.assertEqual(name(rows.__dlpack__(max_version=(0, 8))), b"dltensor")
            capsule = rows.__dlpack__(max_version=(1, 0), dl_device=(1, 0))
            self.assertEqual(name(capsule), b"dltensor_versioned")
            tensor = pointer(capsule, b"dltensor_versioned")
            major, minor = (ctypes.c_uint32 * 2).from_address(tensor)
            flags, data = (
                ctypes.c_uint64.from_address(tensor + 24).value,
                ctypes.c_void_p.from_address(tensor + 32).value,
            )
            self.assertEqual((major, flags & 1, data), (1, rows.read_only, rows.address))

    @on_each()
    def test_a_copy_where_one_is_asked_for(self, engine):
        with engine.world([]) as world:
            world.create_body(particle((4, 5, 6)))
            rows = world.state.borrow("pose", copy=True)
            self.assertEqual(list(rows.numpy()[rows.numpy().any(axis=1)][0, :3]), [4, 5, 6])
            self.assertIn("cpu", repr(rows))

    def test_what_is_refused(self):
        with first().world([]) as world:
            with self.assertRaisesRegex(ValueError, 'device "gpu" is unknown; use "cpu" or "cuda"'):
                world.state.borrow("pose", device="gpu")
            with self.assertRaises(plumb.Error):
                world.state.borrow("mass", copy=True)


if __name__ == "__main__":
    unittest.main()
