"""What the tests share: every engine that this process can open, and worlds with a floor."""

import functools
import unittest

import numpy as np

import plumb


@functools.lru_cache(maxsize=None)
def engines():
    """All backends of this machine; of those that clash the first."""
    opened = []
    for name, _ in plumb.backends():
        try:
            opened.append(plumb.open(name))
        except plumb.Error:  # it clashes with one that is open, or this machine cannot run it
            pass
    return opened


def able(*needs, asked=()):
    """Engines that have all needs, and what is asked natively or emulated."""
    return [
        engine
        for engine in engines()
        if all(engine.capability("need", need).degree for need in needs)
        and all(engine.capability(*ask).degree >= plumb.Degree.EMULATED for ask in asked)
    ]


def first(*needs, asked=()):
    """The first such engine; the test is skipped where there is none."""
    for engine in able(*needs, asked=asked):
        return engine
    raise unittest.SkipTest(f"no engine has {', '.join(needs)}")


def on_each(*needs, asked=()):
    """The test runs for each such engine, and gets it; it is skipped where there is none."""

    def decorate(test):
        @functools.wraps(test)
        def run(self):
            first(*needs, asked=asked)
            for engine in able(*needs, asked=asked):
                with self.subTest(engine=engine.info.name):
                    test(self, engine)

        return run

    return decorate


SLIPPERY = plumb.Material(friction=0)


def particle(position=(0, 0, 0), **more):
    """A body without a shape, of 1 kg."""
    return plumb.BodyDesc(position=position, mass=1, flags="no_rotation", material=SLIPPERY, **more)


def floor(world):
    """A box whose top is at height 0."""
    shape = world.create_shape(plumb.Box((50, 0.5, 50)))
    return world.create_body(plumb.BodyDesc(shape, "static", position=(0, -0.5, 0)))


def steps(world, count, dt=1 / 60):
    for _ in range(count):
        report = world.step(dt)
    return report


__all__ = ["able", "engines", "first", "floor", "np", "on_each", "particle", "plumb", "steps", "SLIPPERY"]
