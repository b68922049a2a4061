"""Many worlds stepped together: they end as each does alone; their rows are one array; each goes back by itself."""

import gc
import subprocess
import sys
import threading
import time
import unittest
import weakref

from support import able, engines, first, floor, np, on_each, particle, plumb, steps

NEEDS = ("rotation", "collision", "friction", "snapshot")


def leaning(engine, i, cubes=3):
    """Cubes that fall on ground and on each other, the more to the side the higher i is."""
    world = engine.world(NEEDS)
    floor(world)
    cube = world.create_shape(plumb.Box((0.2, 0.2, 0.2)))
    for k in range(cubes):
        world.create_body(plumb.BodyDesc(cube, position=(0.03 * i * k, 0.25 + 0.45 * k, 0)))
    return world


def together(engine, count=4, threads=2):
    return plumb.Worlds([leaning(engine, i) for i in range(count)], threads)


def floating(engine, count=3, bodies=4):
    """Particles that stand at x = 10 of their world + their place, with other handles in each world."""

    def make(i):
        world = engine.world([], gravity=(0, 0, 0))
        for _ in range(i):
            world.destroy_bodies(world.create_body(particle()))
        for k in range(bodies):
            world.create_body(particle((10 * i + k, 0, 0)))
        return world

    return plumb.Worlds(map(make, range(count)), threads=2)


def hashes(worlds):
    return [world.snapshot.hash() for world in worlds]


def read_alone(worlds, field="pose"):
    return np.stack([world.read(field) for world in worlds])


class Joints(unittest.TestCase):
    @on_each("rotation", "collision", "friction", "joints")
    def test_motors_of_all_are_one_array(self, engine):
        def wheel():
            world = engine.world(["rotation", "collision", "friction", "joints"], gravity=(0, 0, 0))
            body = world.create_body(plumb.BodyDesc(world.create_shape(plumb.Sphere(0.5)), mass=1))
            joint = plumb.JointDesc("hinge", body, motors={3: plumb.Motor(0, 100)})
            return world, world.joints.create(joint)

        made = [wheel() for _ in range(3)]
        joint = made[0][1]
        worlds = plumb.Worlds([world for world, _ in made], threads=2)
        motors = np.zeros((3, 1, 12))
        motors[:, 0, 6] = (1, 2, 3)
        motors[:, 0, 7] = 100
        worlds.write_joints("motor", motors, [joint], mask=[True, False, True])
        for _ in range(30):
            worlds.step(1 / 60)
        turned = worlds.read_joints("coordinates", joint)
        self.assertEqual(turned.shape, (3, 6))
        np.testing.assert_allclose(turned[:, 3], (0.5, 0, 1.5), atol=0.08)
        alone = np.stack([world.joints.read("coordinates", joint) for world in worlds])
        np.testing.assert_array_equal(turned, alone)
        with self.assertRaisesRegex(plumb.Error, "world 0: "):
            worlds.read_joints("coordinates", [12345])
        with self.assertRaisesRegex(ValueError, "values must be 3 x 1 x 12"):
            worlds.write_joints("motor", np.zeros((2, 1, 12)), [joint])


class Steps(unittest.TestCase):
    @on_each(*NEEDS)
    def test_each_ends_as_alone(self, engine):
        if engine.info.determinism == plumb.Determinism.NONE:
            return
        alone = [leaning(engine, i) for i in range(5)]
        for world in alone:
            steps(world, 40)
        self.assertEqual(len(set(hashes(alone))), 5, "the worlds differ")
        for threads in (0, 1, 3, 100):
            with together(engine, 5, threads) as worlds:
                self.assertEqual(worlds.reports, [])
                for _ in range(40):
                    worlds.step(1 / 60)
                self.assertEqual(hashes(worlds), hashes(alone))
                self.assertEqual([report.step for report in worlds.reports], [40] * 5)
                self.assertEqual([report.bodies for report in worlds.reports], [4] * 5)
                self.assertGreater(worlds.reports[0].contacts, 0)

    @on_each(*NEEDS)
    def test_each_is_a_world_as_before(self, engine):
        made = [leaning(engine, i) for i in range(3)]
        worlds = plumb.Worlds(world for world in made)
        self.assertEqual((len(worlds), list(worlds)), (3, made))
        self.assertIs(worlds[1], made[1])
        self.assertIs(worlds[-1], made[2])
        np.testing.assert_array_equal(worlds.bodies, [world.bodies for world in made])
        self.assertIn("3 with 4 bodies each", repr(worlds))
        worlds.step(1 / 60)
        worlds[1].step(1 / 60)
        worlds[1].begin_step(1 / 60)
        self.assertEqual(worlds[1].wait().step, 3)
        worlds.step(1 / 60)
        self.assertEqual([report.step for report in worlds.reports], [2, 4, 2])

    def test_others_run_meanwhile(self):
        """Nobody is made to let go of Python's lock here, so another thread counts within a step only if the step
        does."""
        engine = first(*NEEDS)
        worlds = plumb.Worlds([leaning(engine, i, cubes=300) for i in range(4)])
        counted, stop = [0], threading.Event()

        def count():
            while not stop.is_set():
                counted[0] += 1
                time.sleep(0)

        switch = sys.getswitchinterval()
        sys.setswitchinterval(60)
        other = threading.Thread(target=count)
        try:
            other.start()
            for _ in range(20):
                before = counted[0]
                worlds.step(1 / 60)
                if counted[0] > before:
                    break
            during = counted[0] - before
        finally:
            stop.set()
            sys.setswitchinterval(switch)
        other.join()
        self.assertGreater(during, 0)

    @on_each(*NEEDS)
    def test_none_is_stepped_where_one_may_not_be_called(self, engine):
        worlds = together(engine)
        worlds[2].begin_step(1 / 60)
        for call in (lambda: worlds.step(1 / 60), lambda: worlds.read("pose"), worlds.mark):
            with self.assertRaisesRegex(plumb.Error, "world 2: .*: a step is under way; call wait") as raised:
                call()
            self.assertEqual(raised.exception.code, plumb.Result.WRONG_PHASE)
        self.assertEqual(worlds[2].wait().step, 1)
        self.assertEqual([worlds[i].step(1 / 60).step for i in (0, 1, 3)], [1, 1, 1])
        worlds[3].close()
        with self.assertRaisesRegex(ValueError, "world 3: step: the world is closed"):
            worlds.step(1 / 60)
        self.assertEqual(worlds[0].step(1 / 60).step, 2)

    @on_each(*NEEDS)
    def test_a_failed_step_ends(self, engine):
        worlds = together(engine)
        worlds.step(1 / 60)
        with self.assertRaisesRegex(plumb.Error, "^world 0: ") as raised:
            worlds.step(-1)
        self.assertEqual(raised.exception.code, plumb.Result.INVALID_ARGUMENT)
        self.assertEqual([report.step for report in worlds.reports], [0] * 4)
        worlds.step(1 / 60)
        self.assertEqual([report.step for report in worlds.reports], [2] * 4)

    def test_a_second_caller_is_refused(self):
        engine = first(*NEEDS)
        worlds = plumb.Worlds([leaning(engine, i, cubes=100) for i in range(3)])
        refused, wrong, stop = [0], [], threading.Event()

        def intrude():
            while not stop.is_set():
                try:
                    worlds[1].read("pose")
                    worlds.reports
                except plumb.Error as error:
                    if error.code == plumb.Result.WRONG_THREAD:
                        refused[0] += 1
                    else:
                        wrong.append(error)

        other = threading.Thread(target=intrude)
        other.start()
        done = 0
        while done < 5 or (not refused[0] and done < 500):
            try:
                worlds.step(1 / 60)
                done += 1
            except plumb.Error as error:
                self.assertRegex(str(error), "^world 1: step: another thread")
        stop.set()
        other.join()
        self.assertEqual(wrong, [])
        self.assertGreater(refused[0], 0)
        self.assertEqual([report.step for report in worlds.reports], [done] * 3)


class Life(unittest.TestCase):
    def test_who_keeps_whom(self):
        worlds = floating(first())
        kept, gone, together = worlds[0], weakref.ref(worlds[1]), weakref.ref(worlds)
        gc.disable()
        try:
            self.assertEqual(worlds.read("pose").shape, (3, 4, 7))
            del worlds
            self.assertIsNone(together(), "a circle of references waits for the collector")
            self.assertIsNone(gone())
        finally:
            gc.enable()
        self.assertEqual(kept.step(0.1).step, 1)

    def test_with_closes_all(self):
        with floating(first()) as worlds:
            self.assertFalse(worlds[0].closed)
        self.assertEqual([world.closed for world in worlds], [True] * 3)
        worlds.close()


    def test_a_program_may_end_at_any_time(self):
        """With threads that wait, rows that are lent, and a thread that steps on."""
        program = """
import threading, time
from test_worlds import first, floating
idle, busy = floating(first()), floating(first())
idle.step(0.01)
try:
    lent = idle.borrow("pose", copy=True).numpy()
except RuntimeError:  # the engine has no plumb.worlds/1
    pass
threading.Thread(target=lambda: [busy.step(0.01) for _ in range(10**9)], daemon=True).start()
time.sleep(0.05)
"""
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))


class Rows(unittest.TestCase):
    @on_each()
    def test_reads(self, engine):
        worlds = floating(engine)
        for world in range(3):
            worlds[world].write("velocity", [world, 0, 0, 0, 0, 0])
        worlds.step(0.5)
        self.assertNotEqual(worlds.bodies[1].tolist(), worlds.bodies[2].tolist())
        np.testing.assert_array_equal(worlds.bodies, [world.bodies for world in worlds])
        for field, columns in (("pose", 7), (plumb.Field.VELOCITY, 6), ("mass", None)):
            every = worlds.read(field)
            np.testing.assert_array_equal(every, read_alone(worlds, field))
            self.assertEqual((every.shape[:2], every.dtype), ((3, 4), np.float64))
            self.assertIn(columns, (every.shape[2], None))
            np.testing.assert_array_equal(worlds.read(field, [3, 1]), every[:, [3, 1]])
            np.testing.assert_array_equal(worlds.read(field, np.array([2])), every[:, [2]])
            np.testing.assert_array_equal(worlds.read(field, 2), every[:, 2])
            np.testing.assert_array_equal(worlds.read(field, np.int64(0)), every[:, 0])
        self.assertEqual(worlds.read("pose", []).shape, (3, 0, 7))
        self.assertEqual(floating(engine, bodies=0).read("pose").shape, (3, 0, 7))

    @on_each()
    def test_out_is_filled_where_it_lies(self, engine):
        worlds = floating(engine)
        wide = np.full((3, 6, 16), -1, np.float32)
        out = wide[:, 1:5, 2:9]  # rows 16 numbers apart, worlds 96
        self.assertIs(worlds.read("pose", out=out), out)
        np.testing.assert_array_equal(out, read_alone(worlds))
        out[:] = -1
        self.assertTrue((wide == -1).all(), "nothing else was written")
        some = np.empty((3, 2, 7))
        worlds.read("pose", [3, 0], out=some)
        np.testing.assert_array_equal(some, read_alone(worlds)[:, [3, 0]])

    @on_each()
    def test_writes(self, engine):
        worlds = floating(engine)
        given = np.arange(3 * 4 * 6.0).reshape(3, 4, 6) * [1, 1, 1, 0, 0, 0]
        worlds.write("velocity", given)
        np.testing.assert_array_equal(read_alone(worlds, "velocity"), given)
        worlds.write("velocity", given[:, [1, 3]] + [1, 0, 0, 0, 0, 0], [0, 2])
        expected = given.copy()
        expected[:, [0, 2]] = given[:, [1, 3]] + [1, 0, 0, 0, 0, 0]
        np.testing.assert_array_equal(worlds.read("velocity"), expected)
        worlds.write("velocity", given[0])  # for every world
        np.testing.assert_array_equal(worlds.read("velocity"), [given[0]] * 3)
        worlds.write("velocity", np.float32([1, 2, 3, 0, 0, 0]), [3])  # for all
        np.testing.assert_array_equal(worlds.read("velocity", 3), [[1, 2, 3, 0, 0, 0]] * 3)
        worlds.write("velocity", given[:, 2], 1)  # as it is read
        np.testing.assert_array_equal(worlds.read("velocity", 1), given[:, 2])
        worlds.write("velocity", np.empty((3, 0, 6)), [])
        flipped = np.zeros((6, 4, 3))
        flipped[1] = 7
        worlds.write("velocity", flipped.T)  # whose numbers do not lie side by side
        np.testing.assert_array_equal(worlds.read("velocity")[..., 1], np.full((3, 4), 7))

    @on_each()
    def test_the_mask_of_what_is_written(self, engine):
        worlds = floating(engine)
        given = np.ones((3, 4, 6)) * [1, 2, 3, 0, 0, 0]
        given[1] = np.nan  # which a world refuses
        worlds.write("velocity", given, mask=np.array([True, False, True]))
        given[1] = 0
        np.testing.assert_array_equal(worlds.read("velocity"), given)
        worlds.write("velocity", np.zeros(6), 0, mask=[False, False, True])
        given[2, 0] = 0
        np.testing.assert_array_equal(worlds.read("velocity"), given)
        with self.assertRaisesRegex(plumb.Error, "^world 1: ") as raised:
            worlds.write("velocity", np.where(np.arange(3)[:, None, None] == 1, np.nan, given))
        self.assertEqual(raised.exception.code, plumb.Result.INVALID_ARGUMENT)

    @on_each()
    def test_bodies_are_those_that_came_together(self, engine):
        worlds = floating(engine)
        worlds[1].create_body(particle())
        self.assertEqual(worlds.read("pose").shape, (3, 4, 7))
        worlds[2].destroy_bodies(worlds.bodies[2, 3])
        with self.assertRaisesRegex(plumb.Error, "^world 2: ") as raised:
            worlds.read("pose")
        self.assertEqual(raised.exception.code, plumb.Result.STALE_HANDLE)
        self.assertEqual(worlds.read("pose", [0, 1]).shape, (3, 2, 7))


class Resets(unittest.TestCase):
    @on_each(*NEEDS)
    def test_each_goes_back_by_itself(self, engine):
        def run(count):
            for _ in range(count):
                worlds.step(1 / 60)
            return hashes(worlds)

        worlds = together(engine)
        with self.assertRaisesRegex(plumb.Error, r"nothing to go back to; call mark\(\) before") as raised:
            worlds.reset()
        self.assertEqual(raised.exception.code, plumb.Result.WRONG_PHASE)
        worlds.mark()
        start, once = hashes(worlds), run(30)
        self.assertTrue(all(a != b for a, b in zip(start, once)))
        worlds.reset(np.array([False, True, False, True]))
        self.assertEqual(hashes(worlds), [once[0], start[1], once[2], start[3]])
        worlds.reset([False] * 4)
        self.assertEqual(hashes(worlds), [once[0], start[1], once[2], start[3]])
        worlds.reset()
        self.assertEqual(hashes(worlds), start)
        if engine.capability("snapshot").degree == plumb.Degree.NATIVE:
            self.assertEqual(run(30), once)
        worlds.mark()
        now = hashes(worlds)
        run(5)
        worlds.reset()
        self.assertEqual(hashes(worlds), now, "to the last mark")

    def test_without_snapshots(self):
        with self.assertRaises(plumb.Error) as raised:
            floating(first()).mark()
        self.assertIn(raised.exception.code, (plumb.Result.NOT_DECLARED, plumb.Result.UNSUPPORTED))


class Lent(unittest.TestCase):
    def lenders(self):
        found = [engine for engine in able(*NEEDS) if "plumb.worlds/1" in engine.extensions]
        if not found:
            self.skipTest("no engine has plumb.worlds/1")
        for engine in found:
            with self.subTest(engine=engine.info.name):
                yield engine

    def test_rows_of_all_worlds(self):
        for engine in self.lenders():
            worlds = together(engine)
            for field in ("pose", "velocity"):
                for _ in range(20):
                    worlds.step(1 / 60)
                lent = worlds.borrow(field, copy=True)
                view = lent.numpy()
                self.assertEqual(lent.shape, view.shape)
                self.assertEqual((view.ndim, view.shape[0], view.shape[2]), (3, 4, 7 if field == "pose" else 6))
                self.assertEqual((view.dtype, view.flags.writeable), (lent.dtype, not lent.read_only))
                self.assertIn(" x ".join(map(str, view.shape)), repr(lent))
                rows = [list(world.state.rows().bodies) for world in worlds]
                for i, bodies in enumerate(worlds.bodies):
                    order = [rows[i].index(body) for body in bodies]
                    np.testing.assert_allclose(view[i][order], worlds[i].read(field), rtol=1e-6)
                np.testing.assert_array_equal(np.asarray(lent), view)
                np.testing.assert_array_equal(np.from_dlpack(lent), view)

    def test_they_are_the_engines_own_memory(self):
        for engine in self.lenders():
            worlds = together(engine)
            try:
                lent = worlds.borrow("pose")
            except plumb.Error as error:  # the engine's memory is a GPU's
                self.assertEqual(error.code, plumb.Result.UNSUPPORTED)
                continue
            view = lent.numpy()
            self.assertFalse(lent.is_copy)
            self.assertTrue(lent.read_only)
            self.assertEqual(view.__array_interface__["data"][0], lent.address)
            self.assertFalse(view.flags.owndata)
            before = view.copy()
            worlds.close()
            del worlds, lent
            gc.collect()
            np.testing.assert_array_equal(view, before, "also when the worlds are gone")

    def test_who_has_come_to_others(self):
        for engine in self.lenders():
            worlds = together(engine)
            others = plumb.Worlds([worlds[2], leaning(engine, 7)])
            self.assertEqual(others.borrow("pose", copy=True).shape[0], 2)
            with self.assertRaisesRegex(plumb.Error, "world 2 has come together with other worlds since"):
                worlds.borrow("pose", copy=True)
            worlds.step(1 / 60)
            others.step(1 / 60)
            self.assertEqual([report.step for report in worlds.reports + others.reports], [1, 1, 1, 1, 2, 1])

    def test_what_cannot_be_lent(self):
        for engine in engines():
            worlds = floating(engine)
            if "plumb.worlds/1" not in engine.extensions:
                with self.assertRaisesRegex(plumb.Error, r"has no plumb.worlds/1: read\(\) the rows") as raised:
                    worlds.borrow("pose", copy=True)
                self.assertEqual(raised.exception.code, plumb.Result.UNSUPPORTED)
                continue
            with self.assertRaisesRegex(ValueError, 'device "gpu" is unknown; use "cpu" or "cuda"'):
                worlds.borrow("pose", device="gpu")
            with self.assertRaises(plumb.Error):
                worlds.borrow("mass", copy=True)
            worlds[1].create_body(particle())
            with self.assertRaisesRegex(plumb.Error, "rows of bodies"):
                worlds.borrow("pose", copy=True)


class Refused(unittest.TestCase):
    def test_what_cannot_come_together(self):
        engine = first()
        one, other = engine.world([]), engine.world([])
        full = engine.world([])
        full.create_body(particle())
        closed = engine.world([])
        closed.close()
        wrong = [
            (lambda: plumb.Worlds([]), ValueError, "there are none; give at least one"),
            (lambda: plumb.Worlds(4), TypeError, "worlds must be Worlds that a backend made.*, not 4"),
            (lambda: plumb.Worlds([one, 7]), TypeError, r"worlds\[1\] must be a World, not 7"),
            (lambda: plumb.Worlds([one, other, one]), ValueError, r"worlds\[2\] is worlds\[0\] again"),
            (lambda: plumb.Worlds([one, full]), ValueError, r"worlds\[1\] has 1 bodies and worlds\[0\] has 0: make"),
            (lambda: plumb.Worlds([one, closed]), ValueError, "world 1: bodies: the world is closed"),
            (lambda: plumb.Worlds([one, other], threads=-1), ValueError, "threads must be 0 to"),
            (lambda: plumb.Worlds([one, other], "two"), TypeError, "threads must be a whole number, not 'two'"),
        ]
        for call, kind, text in wrong:
            with self.subTest(text), self.assertRaisesRegex(kind, text):
                call()
        if len(engines()) > 1:
            with self.assertRaisesRegex(ValueError, r"worlds\[1\] is of \S+ and worlds\[0\] of \S+: step"):
                plumb.Worlds([engines()[0].world([]), engines()[1].world([])])
        one.begin_step(0.1)
        with self.assertRaisesRegex(plumb.Error, "world 0: .*a step is under way"):
            plumb.Worlds([one, other])

    def test_what_cannot_be_rows_is_refused_in_words(self):
        worlds = floating(first())
        read_only = np.empty((3, 4, 7))
        read_only.flags.writeable = False
        wrong = [
            (lambda: worlds.read("speed"), ValueError, 'field "speed" is unknown'),
            (lambda: worlds.read("pose", 4), ValueError, "there is no body 4: each world has 4, counted from 0"),
            (lambda: worlds.read("pose", [0, -1]), ValueError, "there is no body -1"),
            (lambda: worlds.read("pose", worlds.bodies[0]), ValueError, "places, not handles"),
            (lambda: worlds.read("pose", 1.5), TypeError, "bodies must be whole numbers.*not 1.5"),
            (lambda: worlds.read("pose", [True] * 4), TypeError, "bodies must be whole numbers"),
            (lambda: worlds.read("pose", worlds.bodies), TypeError, "bodies must be whole numbers"),
            (lambda: worlds.read("pose", out=np.empty((3, 4, 6))), ValueError, r"out must be of shape \(3, 4, 7\)"),
            (lambda: worlds.read("pose", 0, out=np.empty((3, 7))), ValueError, r"out must be of shape \(3, 1, 7\)"),
            (lambda: worlds.read("pose", out=np.empty((3, 4, 7), int)), TypeError, "out must be a NumPy array of"),
            (lambda: worlds.read("pose", out=[0]), TypeError, "out must be a NumPy array"),
            (lambda: worlds.read("pose", out=read_only), ValueError, "out is read only"),
            (lambda: worlds.read("pose", out=np.empty((7, 4, 3)).T), ValueError, "side by side"),
            (lambda: worlds.write("velocity", np.zeros((3, 4, 5))), ValueError, "must be 3 x 4 x 6 or 4 x 6 or 6 "),
            (lambda: worlds.write("velocity", np.zeros((3, 1, 6))), ValueError, r"not an array of shape \(3, 1, 6\)"),
            (lambda: worlds.write("velocity", 0), ValueError, r"not an array of shape \(\)"),
            (lambda: worlds.write("velocity", np.zeros((2, 6)), 1), ValueError, r"must be 3 x 6 or 6 .*\(2, 6\)"),
            (lambda: worlds.write("velocity", "fast"), TypeError, "values must be real numbers, not 'fast'"),
            (lambda: worlds.write("velocity", np.zeros(6), mask=[True]), ValueError, "a bool for each of 3 worlds"),
            (lambda: worlds.write("velocity", np.zeros(6), mask=[0, 1, 2]), ValueError, "not an array of int64"),
            (lambda: worlds.reset([0, 2]), ValueError, "mask must be a bool for each of 3 worlds"),
            (lambda: worlds.step("1/60"), TypeError, "dt must be a number, not '1/60'"),
            (lambda: worlds[3], IndexError, "there is no world 3: there are 3, counted from 0"),
        ]
        for call, kind, text in wrong:
            with self.subTest(text), self.assertRaisesRegex(kind, text):
                call()


if __name__ == "__main__":
    unittest.main()
