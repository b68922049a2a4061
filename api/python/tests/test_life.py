"""Worlds and what they lend: who keeps whom alive, what is refused after the end, and threads."""

import gc
import subprocess
import sys
import threading
import time
import unittest
import weakref

from support import first, floor, np, on_each, particle, plumb, steps


class Life(unittest.TestCase):
    @on_each()
    def test_what_is_wanted_and_not_there_is_left_out(self, engine):
        every = plumb.Need(sum(plumb.Need))
        offered = engine.offered(every)
        self.assertEqual(engine.offered(offered), offered)
        with engine.world([], wanted=every) as world:
            world.step(1 / 60)
        for word, bit in plumb.Need.__members__.items():
            if bit & offered:
                engine.world([word]).close()
            else:
                with self.assertRaises(plumb.Error):
                    engine.world([word])

    def test_a_closed_world_refuses_everything(self):
        world = first().world([])
        body = world.create_body(particle())
        world.close()
        world.close()
        self.assertTrue(world.closed)
        self.assertIn("closed", repr(world))
        calls = [
            lambda: world.step(1),
            lambda: world.wait(),
            lambda: world.begin_step(1),
            lambda: world.bodies,
            lambda: world.read("pose", body),
            lambda: world.write("pose", np.zeros(7), body),
            world.contacts,
            world.events,
            lambda: world.create_body(particle()),
            lambda: world.create_shape(plumb.Plane()),
            lambda: world.destroy_bodies(body),
            lambda: world.set_gravity((0, 0, 0)),
            lambda: world.user_data(body),
            world.snapshot.hash,
            lambda: world.state.borrow("pose", copy=True),
            world.state.rows,
        ]
        for call in calls:
            with self.assertRaisesRegex(ValueError, "the world is closed"):
                call()

    def test_with_closes_also_after_an_error(self):
        with self.assertRaises(ZeroDivisionError), first().world([]) as world:
            1 / 0
        self.assertTrue(world.closed)

    def test_nobody_else_keeps_a_world(self):
        world = first().world([])
        gone = weakref.ref(world)
        gc.disable()
        try:
            del world
            self.assertIsNone(gone(), "a circle of references waits for the collector")
        finally:
            gc.enable()

    def test_parts_of_a_world_keep_it(self):
        settings = first("snapshot").world(["snapshot"]).snapshot
        gc.collect()
        self.assertIsInstance(settings.hash(), int)

    def test_closing_between_begin_and_wait(self):
        world = first().world([])
        world.create_body(particle())
        world.begin_step(0.01)
        world.close()
        with self.assertRaisesRegex(ValueError, "closed"):
            world.wait()

    @on_each()
    def test_phases(self, engine):
        with engine.world([]) as world:
            with self.assertRaises(plumb.Error) as raised:
                world.wait()
            self.assertEqual(raised.exception.code, plumb.Result.WRONG_PHASE)
            world.begin_step(0.01)
            for call in (
                world.contacts,
                lambda: world.read("pose"),
                lambda: world.begin_step(0.01),
                world.snapshot.hash,
            ):
                with self.assertRaises(plumb.Error) as raised:
                    call()
                self.assertEqual(raised.exception.code, plumb.Result.WRONG_PHASE)
            self.assertEqual(world.wait().step, 1)
            self.assertEqual(world.step(0.01).step, 2)


class Endings(unittest.TestCase):
    def test_a_program_may_end_at_any_time(self):
        """With a step under way, rows that are lent, and a thread that steps on."""
        program = """
import sys, threading, time
from support import first, particle, plumb
worlds = [first().world([]) for _ in range(2)]
for world in worlds:
    world.create_body(particle())
lent = worlds[0].state.borrow("pose", copy=True)
view, capsule = lent.numpy(), lent.__dlpack__()
worlds[0].begin_step(0.01)
threading.Thread(target=lambda: [worlds[1].step(0.01) for _ in range(10**9)], daemon=True).start()
time.sleep(0.05)
"""
        ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))


class Threads(unittest.TestCase):
    def heap(self, engine):
        world = engine.world(["rotation", "collision", "friction"])
        floor(world)
        rows = plumb.body_rows(1500, plumb.BodyDesc(world.create_shape(plumb.Box((0.5, 0.5, 0.5)))))
        rows["position"] = [(i % 10 * 1.05, 0.5 + i // 100 * 1.02, i // 10 % 10 * 1.05) for i in range(1500)]
        world.create_bodies(rows)
        return world

    def test_others_run_while_a_world_steps(self):
        """Nobody is made to let go of Python's lock here, so another thread counts within a step only if the step
        does."""
        world = self.heap(first("rotation", "collision", "friction"))
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
                world.step(1 / 60)
                if counted[0] > before:
                    break
            during = counted[0] - before
        finally:
            stop.set()
            sys.setswitchinterval(switch)
        other.join()
        self.assertGreater(during, 0)

    def test_a_second_caller_is_refused_and_nothing_breaks(self):
        world = self.heap(first("rotation", "collision", "friction"))
        refused, wrong, stop = [0], [], threading.Event()

        def intrude():
            while not stop.is_set():
                try:
                    world.read("pose")
                except plumb.Error as error:
                    if error.code == plumb.Result.WRONG_THREAD:
                        refused[0] += 1
                    else:
                        wrong.append(error)

        other = threading.Thread(target=intrude)
        other.start()
        done = 0
        while done < 5 or not refused[0]:
            try:
                world.step(1 / 60)
                done += 1
            except plumb.Error as error:
                self.assertEqual(error.code, plumb.Result.WRONG_THREAD)
        stop.set()
        other.join()
        self.assertEqual(wrong, [])

    def test_queries_run_side_by_side(self):
        engine = first("queries", "collision", "friction", asked=[("query", "ray")])
        with engine.world(["queries", "collision", "friction"]) as world:
            floor(world)
            steps(world, 1)
            origins = np.zeros((2000, 3)) + [0, 5, 0]
            failed = []

            def ask():
                try:
                    for _ in range(20):
                        hits = world.queries.rays(origins, (0, -10, 0))
                        np.testing.assert_allclose(hits["fraction"], 0.5, atol=1e-5)
                except BaseException as error:
                    failed.append(error)

            threads = [threading.Thread(target=ask) for _ in range(4)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual(failed, [])


if __name__ == "__main__":
    unittest.main()
