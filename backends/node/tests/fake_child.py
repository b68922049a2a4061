"""A child of plumb.wire/1 that misbehaves: fake_child.py HOW. It answers all calls properly but one: the step."""
import json
import os
import struct
import sys
import time

HEADER, MAGIC = struct.Struct('<IIIiII'), 0x31574C50
how = sys.argv[1]
wire = open(3, 'r+b', buffering=0)
MANIFEST = {'wire': 'plumb.wire/2' if how == 'version' else 'plumb.wire/1', 'version': '1', 'build': 'fake', 'description': 'a fake',
            'precision': 'f64', 'capabilities': [['shape', 'spere' if how == 'misspelt' else 'sphere', '*', 'native'],
                                                 ['read', 'pose', '*', 'native']], 'settings': []}
if how == 'unmet':
    MANIFEST['unmet'] = 'run ./dev deps field'
if how == 'takes':
    MANIFEST['takes'] = ['impulse']
if how == 'mute':
    sys.exit(0)


def take(count):
    data = b''
    while len(data) < count:
        piece = wire.read(count - len(data))
        if not piece:
            sys.exit(0)
        data += piece
    return data


def send(call, sequence, result=0, text='', row=()):
    words = text.encode()
    data = HEADER.pack(MAGIC, call, sequence, result, len(words), len(row)) + words + bytes(-len(words) % 8)
    wire.write(data + struct.pack(f'<{len(row)}d', *row))


written = []  # of the last write
while True:
    _, call, sequence, _, text_bytes, count = HEADER.unpack(take(HEADER.size))
    take((text_bytes + 7) // 8 * 8)
    numbers = struct.unpack(f'<{count}d', take(8 * count))
    if call == 10:
        written = list(numbers)
    if call == 1:
        send(call, sequence, text='{"wire": 1' if how == 'torn' else json.dumps(MANIFEST))
    elif call == 9 and how == 'takes':
        send(call, sequence, row=(written + [0] * 7)[:7])
    elif call == 9:
        send(call, sequence, row=[1, 2, 3, 0, 0, 0, 1])
    elif call != 11:
        send(call, sequence)
    elif how == 'raises':
        raise ValueError('the engine of the fake broke')
    elif how == 'aborts':
        os.abort()
    elif how == 'hangs':
        time.sleep(600)
    elif how == 'garbage':
        wire.write(b'{"no": "frame of this wire"}' * 4)
    elif how == 'huge':
        wire.write(HEADER.pack(MAGIC, call, sequence, 0, 0, 0xFFFFFFFF))
    elif how == 'other':
        send(call, sequence + 1, row=[0, 0, 0])
    elif how == 'half':
        wire.write(HEADER.pack(MAGIC, call, sequence, 0, 0, 3))
        sys.exit(7)
    elif how == 'short':
        send(call, sequence, row=[0])
    elif how == 'refuses':
        send(call, sequence, result=-3, text='the fake does not step')
    elif how == 'stranger':
        send(call, sequence, row=[0, 0, 0, 0, 41])
    elif how == 'talks':
        sys.stdout.write('x' * 300000)
        sys.stdout.flush()
        send(call, sequence, row=[0.25, 0, 0])
    else:
        send(call, sequence, row=[0.25, 3, 5])
