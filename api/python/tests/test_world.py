"""Settings, snapshots, excluded pairs, events, and what a backend says of itself."""

import os
import unittest

from support import first, floor, np, on_each, particle, plumb, steps


class Backends(unittest.TestCase):
    @on_each()
    def test_says_what_it_is(self, engine):
        self.assertEqual(plumb.open(engine.file).info, engine.info)
        self.assertIn(engine.info.precision, ("f32", "f64"))
        self.assertIn(
            (engine.info.name, engine.file), [(name, os.path.realpath(file)) for name, file in plumb.backends()]
        )
        self.assertIn("plumb.settings/1", engine.extensions)
        answers = engine.capabilities()
        self.assertEqual(answers["shape", "sphere", "dynamic"].degree, plumb.Degree.NATIVE)
        self.assertIn(("need", "friction"), answers)
        self.assertIn(("query", "ray"), answers)
        for question, answer in answers.items():
            if answer.degree == plumb.Degree.APPROXIMATE:
                self.assertTrue(answer.note, f"{question}: an approximation has a note")

    def test_what_there_is_not_is_said(self):
        with self.assertRaisesRegex(plumb.Error, 'no backend is called "nonesuch"'):
            plumb.open("nonesuch")
        with self.assertRaisesRegex(plumb.Error, "cannot be found; check the path"):
            plumb.open("./nonesuch.so")
        engine = first()
        with self.assertRaisesRegex(ValueError, 'need "friktion" is unknown; did you mean "friction"'):
            engine.world(["friktion"])
        with self.assertRaisesRegex(TypeError, "the capability joint is asked with JointType"):
            engine.capability("joint")
        with self.assertRaisesRegex(ValueError, "threads must be 0 to"):
            engine.world([], threads=-1)
        with engine.world("collision") as world, self.assertRaises(plumb.Error) as raised:
            world.contacts()
        self.assertEqual(raised.exception.code, plumb.Result.NOT_DECLARED)


class Worlds(unittest.TestCase):
    @on_each()
    def test_settings(self, engine):
        whole = [
            info
            for info in engine.settings.values()
            if info.type == plumb.SettingType.INT and info.default > info.minimum and not info.creation_only
        ]
        if not whole:
            return
        name, less = whole[0].name, whole[0].default - 1
        with engine.world([], settings={name: less}) as world:
            self.assertEqual(world.settings[name], less)
            world.settings[name] = less + 1
            self.assertEqual(world.settings[name], whole[0].default)
            self.assertEqual(len(dict(world.settings)), len(engine.settings))
            with self.assertRaisesRegex(TypeError, f"the setting {name} must be of type int, not 1.5"):
                world.settings[name] = 1.5
            with self.assertRaisesRegex(KeyError, "has no setting"):
                world.settings["nonesuch"] = 1
            with self.assertRaises(plumb.Error):
                world.settings[name] = whole[0].minimum - 1
        for info in engine.settings.values():
            if info.type == plumb.SettingType.CHOICE:
                self.assertIn(info.default, info.choices)

    @on_each("snapshot")
    def test_snapshots(self, engine):
        with engine.world(["snapshot"]) as world:
            body = world.create_body(particle((0, 9, 0)))
            steps(world, 10)
            saved, there, known = world.snapshot.save(), world.read("pose", body), world.snapshot.hash()
            self.assertIsInstance(saved, bytes)
            steps(world, 10)
            self.assertNotEqual(world.snapshot.hash(), known)
            world.snapshot.restore(saved)
            np.testing.assert_array_equal(world.read("pose", body), there)
            self.assertEqual(world.snapshot.hash(), known)
            for torn in (saved[:-3], b"", b"nothing of the kind"):
                with self.assertRaises(plumb.Error) as raised:
                    world.snapshot.restore(torn)
                self.assertEqual(raised.exception.code, plumb.Result.CORRUPT)
            with self.assertRaisesRegex(TypeError, "bytes that save gave, not str"):
                world.snapshot.restore("state")

    @on_each("snapshot")
    def test_snapshots_of_the_whole_world(self, engine):
        with engine.world(["snapshot"]) as world:
            stays, goes = (world.create_body(particle((x, 9, 0), user_data=x)) for x in (1, 2))
            steps(world, 10)
            saved, known = world.snapshot.save_world(), world.snapshot.hash()
            world.destroy_bodies(goes)
            world.create_body(particle((5, 5, 5)))
            steps(world, 10)
            with self.assertRaises(plumb.Error):
                world.snapshot.restore(world.snapshot.save()[:-1])
            world.snapshot.restore(saved)
            self.assertEqual(world.bodies.tolist(), [stays, goes])
            self.assertEqual(world.user_data(goes), 2)
            self.assertEqual(world.snapshot.hash(), known)

    @on_each("rotation", "collision", "friction")
    def test_excluded_pairs(self, engine):
        if "plumb.exceptions/1" not in engine.extensions:
            return
        with engine.world(["rotation", "collision", "friction"]) as world:
            ground = floor(world)
            ball = world.create_shape(plumb.Sphere(0.5))
            stays, falls = world.create_bodies([plumb.BodyDesc(ball, position=(x, 0.5, 0)) for x in (0, 3)])
            world.exceptions.exclude([(falls, ground)])
            self.assertEqual(set(world.exceptions.list()[0]), {falls, ground})
            steps(world, 60)
            self.assertLess(world.read("pose", falls)[1], -2)
            self.assertGreater(world.read("pose", stays)[1], 0.4)
            world.exceptions.allow(world.exceptions.list())
            self.assertEqual(world.exceptions.list().shape, (0, 2))
            with self.assertRaisesRegex(ValueError, r"pairs\[0\] must be two bodies"):
                world.exceptions.exclude([falls])

    @on_each("rotation", "collision", "friction", "events", "sensors")
    def test_events(self, engine):
        with engine.world(["rotation", "collision", "friction", "events", "sensors"]) as world:
            ball = world.create_shape(plumb.Sphere(0.5))
            ground = floor(world)
            sensor = world.create_body(plumb.BodyDesc(ball, "static", position=(0, 3, 0), flags="sensor"))
            body = world.create_body(plumb.BodyDesc(ball, position=(0, 5, 0)))
            seen = []
            for _ in range(90):
                world.step(1 / 60)
                seen += [
                    (plumb.EventType(event["type"]).name, {event["body_a"], event["body_b"]})
                    for event in world.events()
                ]
            self.assertIn(("SENSOR_ENTER", {sensor, body}), seen)
            self.assertIn(("SENSOR_LEAVE", {sensor, body}), seen)
            self.assertIn(("CONTACT_BEGIN", {ground, body}), seen)

    @on_each("rotation", "collision", "friction")
    def test_reports(self, engine):
        with engine.world(["rotation", "collision", "friction"]) as world:
            floor(world)
            ball = world.create_shape(plumb.Sphere(0.5))
            world.create_bodies([plumb.BodyDesc(ball, position=(2 * i, 0.499, 0)) for i in range(3)])
            report = steps(world, 3)
            self.assertEqual(
                (report.step, report.bodies, report.awake, report.joints, report.nonfinite), (3, 4, 3, 0, 0)
            )
            self.assertGreaterEqual(report.contacts, 3)
            self.assertEqual(report.remarks & ~sum(plumb.Remark), 0)
            self.assertTrue(all(seconds >= 0 for seconds in report.phase_seconds.values()))
            self.assertIn("3 awake", repr(report))


if __name__ == "__main__":
    unittest.main()
