"""A backend of plumb.wire/1 in another language: particles under gravity, with no collision. ../WIRE.md is what it reads.

CMake: plumb_add_wire_backend(particles-py python3 /path/to/particles.py)
"""
import json
import struct
import sys
import time

MAGIC, HEADER = 0x31574C50, struct.Struct('<IIIiII')
wire = open(3, 'r+b', buffering=0)

POSE, VELOCITY, GRAVITY_SCALE = 0, 1, 12  # fields, as plumb.h numbers them
COLUMNS = {POSE: 7, VELOCITY: 6, GRAVITY_SCALE: 1}
BODY_COLUMNS = 40
UNSUPPORTED, INTERNAL = -3, -12

MANIFEST = {
    'wire': 'plumb.wire/1', 'version': '1', 'build': 'python ' + sys.version.split()[0],
    'description': 'particles under gravity, in Python', 'precision': 'f64', 'deterministic': True,
    'capabilities': [
        ['shape', 'sphere', 'static|dynamic', 'native'],
        ['read', 'pose|velocity', '*', 'native'],
        ['write', 'pose|velocity|gravity_scale', '*', 'native'],
        ['need', 'forces', '*', 'native'],
    ],
    'settings': [{'name': 'substeps', 'type': 'int', 'role': 'quality', 'unit': '1', 'default': 1, 'minimum': 1,
                  'maximum': 1000, 'doc': 'parts in which a step is done'}],
}


class World:
    def __init__(self, gravity, settings):
        self.gravity, self.settings, self.bodies = gravity, settings, {}

    def create_bodies(self, row):
        for at in range(1, len(row), BODY_COLUMNS):
            body = row[at:at + BODY_COLUMNS]
            self.bodies[body[0]] = {'moves': body[1] == 2, POSE: body[5:12], VELOCITY: body[12:18], 'mass': body[18],
                                    GRAVITY_SCALE: [body[34]]}

    def read(self, row):
        return [number for slot in row[1:] for number in self.bodies[slot][row[0]]]

    def write(self, row):
        columns = COLUMNS[row[0]]
        for at in range(1, len(row), 1 + columns):
            self.bodies[row[at]][row[0]] = row[at + 1:at + 1 + columns]

    def step(self, row):
        dt, pushes = row[0], {row[at]: row[at + 1:at + 4] for at in range(2, len(row), 7)}
        start, parts = time.perf_counter(), int(self.settings['substeps'])
        for slot, body in self.bodies.items():
            if not body['moves']:
                continue
            push = pushes.get(slot, [0, 0, 0])
            for axis in range(3):
                acceleration = self.gravity[axis] * body[GRAVITY_SCALE][0] + push[axis] / body['mass']
                for _ in range(parts):
                    body[VELOCITY][axis] += acceleration * dt / parts
                    body[POSE][axis] += body[VELOCITY][axis] * dt / parts
        return [time.perf_counter() - start, 0, 0]


def answer(call, text, row):
    """Text and numbers of the reply."""
    global world
    if call == 1:
        return json.dumps(MANIFEST), []
    if call == 2:
        world = World(row[1:4], json.loads(text))
    elif call == 3:
        world.gravity = row
    elif call == 4:
        world.settings.update(json.loads(text))
    elif call == 7:
        world.create_bodies(row)
    elif call == 8:
        for slot in row:
            del world.bodies[slot]
    elif call == 9:
        return '', world.read(row)
    elif call == 10:
        world.write(row)
    elif call == 11:
        return '', world.step(row)
    elif call not in (5, 6, 12):  # shapes are never looked at; there are no contacts
        raise NotImplementedError(f'call {call}')
    return '', []


def receive(count):
    data = b''
    while len(data) < count:
        piece = wire.read(count - len(data))
        if not piece:
            sys.exit(0)  # the host is gone
        data += piece
    return data


while True:
    magic, call, sequence, _, text_bytes, count = HEADER.unpack(receive(HEADER.size))
    body = receive((text_bytes + 7) // 8 * 8 + 8 * count)
    try:
        result, (text, row) = 0, answer(call, body[:text_bytes].decode(), list(struct.unpack(f'<{count}d', body[len(body) - 8 * count:])))
    except Exception as error:  # whatever it is, the host is told
        result, text, row = UNSUPPORTED if isinstance(error, NotImplementedError) else INTERNAL, str(error), []
    words = text.encode()
    reply = HEADER.pack(MAGIC, call, sequence, result, len(words), len(row)) + words + bytes(-len(words) % 8) + struct.pack(f'<{len(row)}d', *row)
    while reply:
        reply = reply[wire.write(reply):]
