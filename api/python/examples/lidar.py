"""A scanner that turns in a yard of boxes and draws what its rays find, seen from above.

python3 lidar.py [--engine impulse] [--rays 720] [--quick]
"""

import argparse

import numpy as np

import plumb

RANGE = 20.0  # m


def yard(world):
    """Boxes and cylinders at random, a wall around them, all of them static."""
    numbers = np.random.default_rng(3)
    box, post, wall = world.create_shapes([plumb.Box((1, 1, 0.6)), plumb.Cylinder(0.7, 1), plumb.Box((0.2, 1, 15))])
    things = plumb.body_rows(20, plumb.BodyDesc(motion="static"))
    things["shape"] = numbers.choice([box, post], 20)
    around, away = numbers.uniform(0, 2 * np.pi, 20), numbers.uniform(4, 12, 20)
    things["position"] = np.stack([away * np.cos(around), np.zeros(20), away * np.sin(around)], axis=1)
    turn = numbers.uniform(0, np.pi, 20)
    things["orientation"][:, 1], things["orientation"][:, 3] = np.sin(turn / 2), np.cos(turn / 2)
    world.create_bodies(things)
    half = np.sqrt(0.5)
    world.create_bodies(
        [
            plumb.BodyDesc(wall, "static", position=at, orientation=turned)
            for at, turned in [
                ((15, 0, 0), (0, 0, 0, 1)),
                ((-15, 0, 0), (0, 0, 0, 1)),
                ((0, 0, 15), (0, half, 0, half)),
                ((0, 0, -15), (0, half, 0, half)),
            ]
        ]
    )


def scan(world, rays):
    """Distances of what lies in each direction; infinite where there is nothing."""
    angle = np.linspace(0, 2 * np.pi, rays, endpoint=False)
    directions = np.stack([np.cos(angle), np.zeros(rays), np.sin(angle)], axis=1)
    hits = world.queries.rays((0, 0.5, 0), RANGE * directions)
    return hits["position"][hits["body"] != 0], np.where(hits["body"] != 0, RANGE * hits["fraction"], np.inf)


def picture(points, width=64, height=32):
    """The points from above, as lines of text."""
    cells = np.full((height, width), " ")
    columns = ((points[:, 0] / 16 + 1) / 2 * width).astype(int)
    lines = ((points[:, 2] / 16 + 1) / 2 * height).astype(int)
    cells[lines, columns] = "o"
    cells[height // 2, width // 2] = "+"
    return "\n".join("".join(line).rstrip() for line in cells)


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument(
        "--engine", default="impulse", help="one of " + ", ".join(name for name, _ in plumb.backends())
    )
    options.add_argument("--rays", type=int, default=720)
    options.add_argument("--quick", action="store_true", help="fewer rays")
    asked = options.parse_args()
    with plumb.open(asked.engine).world(["rotation", "collision", "friction", "queries"]) as world:
        yard(world)
        world.step(1 / 60)  # queries see the world as the last step left it
        points, distances = scan(world, 90 if asked.quick else asked.rays)
        print(picture(points))
        print(f"{len(points)} of {len(distances)} rays hit; the nearest thing is {distances.min():.2f} m away")


if __name__ == "__main__":
    main()
