"""A tower of cubes that is struck, as rows that are looked at after each step without a copy.

python3 tower.py [--engine impulse] [--cubes 10] [--quick]
"""

import argparse

import numpy as np

import plumb


def build(world, cubes):
    """The cubes, the ground beneath them, and a ball on its way."""
    ground, cube, ball = world.create_shapes([plumb.Box((50, 0.5, 50)), plumb.Box((0.5, 0.5, 0.5)), plumb.Sphere(0.4)])
    world.create_body(plumb.BodyDesc(ground, "static", position=(0, -0.5, 0)))
    rows = plumb.body_rows(cubes, plumb.BodyDesc(cube))
    rows["position"][:, 1] = 0.5 + np.arange(cubes)
    tower = world.create_bodies(rows)
    world.create_body(plumb.BodyDesc(ball, position=(-15, cubes - 0.5, 0), linear_velocity=(15, 3, 0), density=4000))
    return tower


def heights_of(world, bodies):
    """A function that looks at the bodies' heights: the engine's own memory where it lends that, else a copy."""
    world.state.borrow("pose", copy=True)
    where, _ = world.state.rows()
    at = np.array([np.flatnonzero(where == body)[0] for body in bodies])
    return lambda: world.state.borrow("pose", copy=True).numpy()[at, 1]


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument(
        "--engine", default="impulse", help="one of " + ", ".join(name for name, _ in plumb.backends())
    )
    options.add_argument("--cubes", type=int, default=10)
    options.add_argument("--quick", action="store_true", help="half a second instead of four")
    asked = options.parse_args()
    with plumb.open(asked.engine).world(["rotation", "collision", "friction"]) as world:
        heights = heights_of(world, build(world, asked.cubes))
        for step in range(30 if asked.quick else 240):
            if step % 15 == 0:
                now = heights()
                print(
                    f"{step / 60:5.2f} s  highest {now.max():6.2f} m  mean {now.mean():5.2f} m  "
                    + "#" * int(4 * now.mean())
                )
            world.step(1 / 60)


if __name__ == "__main__":
    main()
