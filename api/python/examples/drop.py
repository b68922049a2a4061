import plumb

engine = plumb.open("impulse")  # a name on the search path, or a file
with engine.world(needs=["rotation", "collision", "friction"]) as world:
    ground, cube = world.create_shapes([plumb.Box((50, 0.5, 50)), plumb.Box((0.5, 0.5, 0.5))])  # m
    _, body = world.create_bodies(
        [plumb.BodyDesc(ground, "static", position=(0, -0.5, 0)), plumb.BodyDesc(cube, position=(0, 3, 0))]
    )
    for _ in range(120):
        report = world.step(1 / 60)  # plumb.Error with the backend's sentence where a call fails
    print(f"the cube rests at {world.read('pose', body)[1]:.3f} m")
