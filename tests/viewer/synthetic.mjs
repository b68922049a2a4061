// Replay bundles made from formulas, for the viewer's tests: known numbers, every layer, every shape.
import { deflateSync } from 'node:zlib';

const kTypes = {
  f32: Float32Array,
  u16: Uint16Array,
  i16: Int16Array,
  u32: Uint32Array,
  i32: Int32Array,
  u8: Uint8Array,
};

/** Bytes of a bundle: sections is {name: [type, values, shape]}. */
export function encode(header, sections) {
  const entries = {},
    parts = [];
  let offset = 0;
  for (const [name, [type, values, shape = [values.length]]] of Object.entries(sections)) {
    const bytes = new Uint8Array(kTypes[type].from(values).buffer),
      padded = new Uint8Array(Math.ceil(bytes.length / 8) * 8);
    padded.set(bytes);
    entries[name] = { offset, type, shape };
    parts.push(padded);
    offset += padded.length;
  }
  let text = new TextEncoder().encode(JSON.stringify({ ...header, sections: entries }));
  const length = Math.ceil((text.length + 12) / 8) * 8 - 12,
    bytes = new Uint8Array(12 + length + offset).fill(32);
  const view = new DataView(bytes.buffer);
  bytes.set([...'PLRP'].map((c) => c.charCodeAt(0)));
  view.setUint32(4, 1, true);
  view.setUint32(8, length, true);
  bytes.set(text, 12);
  let at = 12 + length;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes;
}

export const base64 = (bytes) => Buffer.from(deflateSync(bytes)).toString('base64');

export function quaternion([x, y, z], angle) {
  const n = Math.hypot(x, y, z),
    s = Math.sin(angle / 2) / n;
  return [x * s, y * s, z * s, Math.cos(angle / 2)];
}

export const script = (scene, backend, bytes) =>
  `<script type="application/octet-stream" class="plumb-replay" data-scene="${scene}" data-backend="${backend}">${base64(bytes)}</script>`;

/** A replay from pose(frame, body index) => [x y z qx qy qz qw]; the ground does not move. */
export function replay({
  scene,
  title = '',
  backend,
  shapes,
  bodies,
  frames,
  rate = 60,
  pose,
  quantised = true,
  status = 'pass',
  reason = '',
  extra = {},
  header = {},
}) {
  const moving = bodies.flatMap((body, i) => (body.motion === 'dynamic' ? [i] : []));
  const poses = Array.from({ length: frames }, (_, f) => moving.map((i) => pose(f, i)));
  const lower = [0, 1, 2].map((k) => poses.reduce((m, row) => row.reduce((n, p) => Math.min(n, p[k]), m), Infinity)),
    upper = [0, 1, 2].map((k) => poses.reduce((m, row) => row.reduce((n, p) => Math.max(n, p[k]), m), -Infinity));
  const place = (p, k) => (upper[k] > lower[k] ? Math.round(((p[k] - lower[k]) / (upper[k] - lower[k])) * 65535) : 0);
  moving.forEach((i, m) => {
    bodies[i] = { ...bodies[i], start: poses[0][m] };
  });
  const all = poses.flat(),
    shape = (n) => [frames, moving.length, n];
  return encode(
    {
      kind: 'scene',
      scene,
      title,
      params: {},
      backend,
      label: backend,
      cell: `${scene}-${backend}`,
      status,
      reason,
      dt: 1 / rate,
      seconds: frames / rate,
      shapes,
      bodies,
      moving,
      frames,
      series: { energy: { unit: 'J' } },
      lower,
      upper,
      ...header,
    },
    {
      times: ['f32', poses.map((_, f) => f / rate)],
      positions: quantised
        ? ['u16', all.flatMap((p) => [0, 1, 2].map((k) => place(p, k))), shape(3)]
        : ['f32', all.flatMap((p) => p.slice(0, 3)), shape(3)],
      orientations: ['i16', all.flatMap((p) => p.slice(3).map((v) => Math.round(v * 32767))), shape(4)],
      ...extra,
    },
  );
}

/** start offsets and concatenated rows of lists of rows. */
export function ragged(lists) {
  const start = [0];
  for (const list of lists) start.push(start[start.length - 1] + list.length);
  return { start, rows: lists.flat() };
}

const kGround = { name: 'ground', shape: 0, motion: 'static', start: [0, 0, 0, 0, 0, 0, 1] };

/** A swaying tower with every layer; `lean` tells engines apart. */
export function tower(
  backend,
  { height = 10, frames = 90, lean = 1, layers = true, status = 'pass', reason = '' } = {},
) {
  const bodies = [
    kGround,
    ...Array.from({ length: height }, (_, i) => ({ name: `box ${i + 1}`, shape: 1, motion: 'dynamic' })),
  ];
  const sway = (f, i) => lean * 0.004 * i * i * Math.sin(f / 14) * (f / frames);
  const pose = (f, i) => [
    sway(f, i),
    0.5 + (i - 1) + 0.4 * Math.max(0, 1 - f / 12) * (i / height),
    0,
    ...quaternion([0, 0, 1], -0.02 * lean * i * Math.sin(f / 14) * (f / frames)),
  ];
  const each = (make) => Array.from({ length: frames }, (_, f) => make(f)),
    boxes = bodies.slice(1).map((_, i) => i + 1);
  const contacts = ragged(
    each((f) =>
      boxes.flatMap((i) =>
        [-0.5, 0.5].flatMap((dx) =>
          [-0.5, 0.5].map((dz) => ({
            a: i - 1,
            b: i,
            point: [sway(f, i) + dx, i - 1, dz],
            force: (9.81 * 1000 * (height - i + 1) * (1 + dx * Math.sin(f / 14))) / 4,
            id: i * 4 + (dx > 0) * 2 + (dz > 0),
          })),
        ),
      ),
    ),
  );
  const node = (f, from, to, depth) => {
    const p = boxes.slice(from, to).map((i) => pose(f, i)),
      pad = 0.53;
    const box = {
      lower: [Math.min(...p.map((q) => q[0])) - pad, p[0][1] - pad, -pad],
      upper: [Math.max(...p.map((q) => q[0])) + pad, p[p.length - 1][1] + pad, pad],
      depth,
      body: to - from === 1 ? boxes[from] : -1,
    };
    return to - from === 1
      ? [box]
      : [box, ...node(f, from, (from + to) >> 1, depth + 1), ...node(f, (from + to) >> 1, to, depth + 1)];
  };
  const tree = ragged(each((f) => node(f, 0, boxes.length, 0)));
  const axes = ragged(
    each((f) => boxes.map((i) => ({ a: i - 1, b: i, axis: [0, 1, 0], separation: f < 12 ? 0.01 : -0.001 }))),
  );
  const graph = ragged(each(() => boxes.map((i) => ({ a: i - 1, b: i, colour: i === height ? -1 : i % 3 }))));
  const column = (list, name) => list.rows.map((row) => row[name]),
    flat = (list, name) => list.rows.flatMap((row) => row[name]);
  const energy = each((f) => 500 * height * (1 + 0.02 * lean * Math.exp(-f / 30) * Math.cos(f / 5)));
  const extra = {
    'series/energy': ['f32', energy],
    'series/energy_drift': ['f32', energy.map((e) => e / energy[0] - 1)],
    'series/max_penetration': ['f32', each((f) => 0.004 * lean * (1 - Math.exp(-f / 20)))],
    'series/contacts': ['f32', each(() => 4 * height)],
  };
  if (layers)
    Object.assign(extra, {
      penetration: [
        'f32',
        each((f) => boxes.map((i) => (0.004 * lean * (height - i + 1) * (1 - Math.exp(-f / 20))) / height)).flat(),
        [frames, height],
      ],
      asleep: ['u8', each((f) => boxes.map((i) => Number(f > 70 && i < height / 2))).flat(), [frames, height]],
      islands: ['i32', each((f) => boxes.map((i) => (f < 12 ? i : i <= height / 2 ? 0 : 1))).flat(), [frames, height]],
      'contacts/start': ['u32', contacts.start],
      'contacts/body_a': ['u32', column(contacts, 'a')],
      'contacts/body_b': ['u32', column(contacts, 'b')],
      'contacts/point': ['f32', flat(contacts, 'point')],
      'contacts/normal': ['f32', contacts.rows.flatMap(() => [0, 1, 0])],
      'contacts/depth': ['f32', contacts.rows.map(() => 0.001)],
      'contacts/force': ['f32', column(contacts, 'force')],
      'contacts/id': ['u32', column(contacts, 'id')],
      'boxes/start': ['u32', tree.start],
      'boxes/lower': ['f32', flat(tree, 'lower')],
      'boxes/upper': ['f32', flat(tree, 'upper')],
      'boxes/depth': ['i32', column(tree, 'depth')],
      'boxes/body': ['i32', column(tree, 'body')],
      'boxes/tree': ['u32', tree.rows.map(() => 0)],
      'axes/start': ['u32', axes.start],
      'axes/body_a': ['u32', column(axes, 'a')],
      'axes/body_b': ['u32', column(axes, 'b')],
      'axes/axis': ['f32', flat(axes, 'axis')],
      'axes/separation': ['f32', column(axes, 'separation')],
      'constraints/start': ['u32', graph.start],
      'constraints/body_a': ['u32', column(graph, 'a')],
      'constraints/body_b': ['u32', column(graph, 'b')],
      'constraints/colour': ['i32', column(graph, 'colour')],
    });
  return replay({
    scene: `tower H=${height}`,
    title: 'a tower of boxes',
    backend,
    status,
    reason,
    frames,
    bodies,
    pose,
    extra,
    shapes: [
      { type: 'plane', normal: [0, 1, 0], offset: 0 },
      { type: 'box', half_extents: [0.5, 0.5, 0.5] },
    ],
  });
}

export const kTetrahedron = {
  type: 'hull',
  vertices: [
    [0.6, -0.35, -0.35],
    [-0.6, -0.35, -0.35],
    [0, -0.35, 0.7],
    [0, 0.7, 0],
  ],
  faces: [
    [0, 2, 1],
    [0, 1, 3],
    [1, 2, 3],
    [2, 0, 3],
  ],
};

/** A ring of triangles with the given number of corners each way. */
export function ringMesh(radius = 0.5, tube = 0.2, n = 24, m = 12) {
  const vertices = [],
    triangles = [];
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < m; ++j) {
      const a = (2 * Math.PI * i) / n,
        b = (2 * Math.PI * j) / m,
        r = radius + tube * Math.cos(b);
      vertices.push([r * Math.cos(a), tube * Math.sin(b), r * Math.sin(a)]);
      const p = i * m + j,
        q = ((i + 1) % n) * m + j,
        s = i * m + ((j + 1) % m),
        t = ((i + 1) % n) * m + ((j + 1) % m);
      triangles.push([p, s, q], [q, s, t]);
    }
  }
  return { type: 'mesh', vertices, triangles };
}

/** Every shape of the contract, turning over hilly ground. */
export function zoo(backend, { frames = 120, turn = 1 } = {}) {
  const n = 25,
    hills = Array.from(
      { length: n * n },
      (_, i) => 0.35 * Math.sin((i % n) / 2.3) * Math.cos(Math.floor(i / n) / 2.7) - 0.6,
    );
  const shapes = [
    { type: 'height_field', rows: n, columns: n, spacing: [0.5, 0.5], heights: hills },
    { type: 'box', half_extents: [0.5, 0.35, 0.45] },
    { type: 'sphere', radius: 0.5 },
    { type: 'capsule', radius: 0.28, half_height: 0.4 },
    { type: 'cylinder', radius: 0.42, half_height: 0.4 },
    kTetrahedron,
    ringMesh(),
    {
      type: 'compound',
      children: [
        { shape: 1, position: [0, 0, 0], orientation: [0, 0, 0, 1] },
        { shape: 2, position: [0, 0.7, 0], orientation: [0, 0, 0, 1] },
      ],
    },
  ];
  const bodies = [
    kGround,
    ...shapes.slice(1).map((shape, i) => ({ name: shape.type, shape: i + 1, motion: 'dynamic' })),
    { name: 'a body without a shape', shape: null, motion: 'dynamic' },
  ];
  const pose = (f, i) => {
    const a = (2 * Math.PI * (i - 1)) / (bodies.length - 1) + 0.004 * f * turn;
    return [
      2.6 * Math.cos(a),
      0.75 + 0.35 * Math.abs(Math.sin(f / 16 + i)),
      2.6 * Math.sin(a),
      ...quaternion([0.3, 1, 0.2 * i], 0.03 * f * turn + i),
    ];
  };
  return replay({
    scene: 'shapes',
    title: 'every kind of shape',
    backend,
    shapes,
    bodies,
    frames,
    pose,
    quantised: false,
  });
}

/** A pile of so many boxes that the renderer has work to do. */
export function crowd(backend, { count = 5000, frames = 30 } = {}) {
  const side = Math.ceil(Math.cbrt(count)),
    bodies = [kGround, ...Array.from({ length: count }, (_, i) => ({ name: `box ${i}`, shape: 1, motion: 'dynamic' }))];
  const pose = (f, i) => {
    const k = i - 1,
      x = (k % side) - side / 2,
      z = (Math.floor(k / side) % side) - side / 2,
      y = Math.floor(k / side / side);
    return [
      x * 0.6 + 0.05 * Math.sin(f / 5 + y),
      0.25 + y * 0.55,
      z * 0.6,
      ...quaternion([1, 1, 0], 0.02 * f * ((k % 5) - 2)),
    ];
  };
  return replay({
    scene: `crowd ${count}`,
    title: 'many boxes',
    backend,
    bodies,
    frames,
    pose,
    shapes: [
      { type: 'plane', normal: [0, 1, 0], offset: 0 },
      { type: 'box', half_extents: [0.25, 0.25, 0.25] },
    ],
  });
}

/** A tour of one shape around another as the pair viewer plays it; `bias` is added to the engine's distance, m. */
export function pair(a, b, backend, { bias = 0, frames = 60 } = {}) {
  const kinds = {
    sphere: { type: 'sphere', radius: 0.45 },
    box: { type: 'box', half_extents: [0.5, 0.35, 0.4] },
    capsule: { type: 'capsule', radius: 0.25, half_height: 0.35 },
  };
  const bodies = [
    { name: a, shape: 0, motion: 'static', start: [0, 0, 0, 0, 0, 0, 1] },
    { name: b, shape: 1, motion: 'dynamic' },
  ];
  const height = (f) => 0.85 + 0.25 * Math.cos(f / 8),
    pose = (f) => [0, height(f), 0, ...quaternion([0, 1, 0], f / 20)];
  const each = (make) => Array.from({ length: frames }, (_, f) => make(f)),
    gap = (f) => height(f) - 0.8;
  const contacts = ragged(
      each((f) =>
        gap(f) < 0
          ? [
              [-0.2, 0.4, -0.2],
              [0.2, 0.4, 0.2],
            ]
          : [],
      ),
    ),
    axes = ragged(each((f) => [gap(f)]));
  return replay({
    scene: `pair ${a}-${b}`,
    title: `${a} and ${b}`,
    backend,
    frames,
    rate: 30,
    status: 'ok',
    bodies,
    pose,
    shapes: [kinds[a], kinds[b]],
    quantised: false,
    header: { kind: 'pairs', series: { distance: { unit: 'm' }, true_distance: { unit: 'm' } } },
    extra: {
      'series/distance': ['f32', each((f) => gap(f) + bias)],
      'series/true_distance': ['f32', each(gap)],
      'contacts/start': ['u32', contacts.start],
      'contacts/body_a': ['u32', contacts.rows.map(() => 0)],
      'contacts/body_b': ['u32', contacts.rows.map(() => 1)],
      'contacts/point': ['f32', contacts.rows.flat()],
      'contacts/normal': ['f32', contacts.rows.flatMap(() => [0, 1, 0])],
      'contacts/depth': ['f32', contacts.rows.map(() => 0.01)],
      'contacts/id': ['u32', contacts.rows.map((_, i) => i % 2)],
      'axes/start': ['u32', axes.start],
      'axes/body_a': ['u32', axes.rows.map(() => 0)],
      'axes/body_b': ['u32', axes.rows.map(() => 1)],
      'axes/axis': ['f32', axes.rows.flatMap(() => [0, 1, 0])],
      'axes/separation': ['f32', axes.rows],
    },
  });
}

/** Scripts of all pairs of three kinds in the given backends. */
export function pairScripts(backends) {
  const pairs = [
    ['sphere', 'sphere'],
    ['box', 'sphere'],
    ['capsule', 'sphere'],
    ['box', 'box'],
    ['capsule', 'box'],
    ['capsule', 'capsule'],
  ];
  return pairs.flatMap(([a, b]) =>
    backends.map((backend, i) => script(`pair ${a}-${b}`, backend, pair(a, b, backend, { bias: 0.01 * i }))),
  );
}

/** A ball that rolls to and fro between four high walls. */
export function room(backend) {
  const wall = (name, shape, x, z) => ({ name, shape, motion: 'static', start: [x, 2, z, 0, 0, 0, 1] });
  const bodies = [
    kGround,
    wall('east', 1, 1.2, 0),
    wall('west', 1, -1.2, 0),
    wall('south', 2, 0, 1.2),
    wall('north', 2, 0, -1.2),
  ];
  bodies.push({ name: 'ball', shape: 3, motion: 'dynamic' });
  const shapes = [
    { type: 'plane', normal: [0, 1, 0], offset: 0 },
    { type: 'box', half_extents: [0.1, 2, 1.3] },
    { type: 'box', half_extents: [1.3, 2, 0.1] },
    { type: 'sphere', radius: 0.3 },
  ];
  const pose = (f) => [0.6 * Math.sin(f / 8), 0.3, 0, 0, 0, 0, 1];
  return replay({ scene: 'room', backend, shapes, bodies, frames: 60, pose });
}

/** Nine balls of a millimetre, metres apart over the ground. */
export function specks(backend) {
  const bodies = [
    kGround,
    ...Array.from({ length: 9 }, (_, i) => ({ name: `speck ${i}`, shape: 1, motion: 'dynamic' })),
  ];
  return replay({
    scene: 'specks',
    backend,
    bodies,
    frames: 2,
    pose: (_, i) => [4 * ((i - 1) % 3) - 4, 0.5, 4 * Math.floor((i - 1) / 3) - 4, 0, 0, 0, 1],
    shapes: [
      { type: 'plane', normal: [0, 1, 0], offset: 0 },
      { type: 'sphere', radius: 0.001 },
    ],
  });
}

/** A joint as recordings have it, between points of two bodies; body_a null: the world. */
const joint = (name, type, body_a, at_a, body_b, at_b, more = {}) => ({
  name,
  type,
  body_a,
  body_b,
  frame_a: [...at_a, 0, 0, 0, 1],
  frame_b: [...at_b, 0, 0, 0, 1],
  ...more,
});

/**
 * Joints of every kind over empty space: a rod swings about the world's origin, its lower end `gap` metres off the next
 * rod's; a sled on a rail, a bob on a spring, a wheel on a fork. The joint between the rods is gone from `broken` on.
 */
export function linkage(backend, { frames = 90, gap = 0.1, broken = 60, header = {} } = {}) {
  const bodies = ['upper', 'lower', 'sled', 'bob', 'wheel'].map((name, i) => ({
    name,
    shape: [0, 0, 1, 2, 2][i],
    motion: 'dynamic',
  }));
  const angle = (f) => 0.6 * Math.cos(f / 15),
    turn = (f) => quaternion([0, 0, 1], angle(f));
  const pose = (f, i) => {
    const a = angle(f),
      down = [Math.sin(a), -Math.cos(a)];
    if (i === 0) return [0.5 * down[0], 0.5 * down[1], 0, ...turn(f)];
    if (i === 1) return [(1.5 + gap) * down[0], (1.5 + gap) * down[1], 0, ...turn(f)];
    if (i === 2) return [2 + 0.4 * Math.sin(f / 10), -1, 0, 0, 0, 0, 1];
    if (i === 3) return [-2, -1 - 0.3 * Math.sin(f / 9), 0, 0, 0, 0, 1];
    return [-1, 0.4, 0, ...quaternion([1, 0, 0], f / 8)];
  };
  const joints = [
    joint('top', 'ball', null, [0, 0, 0], 0, [0, 0.5, 0]),
    joint('middle', 'hinge', 0, [0, -0.5, 0], 1, [0, 0.5, 0]),
    joint('rail', 'slider', null, [2, -1, 0], 2, [0, 0, 0]),
    joint('spring', 'distance', null, [-2, 0, 0], 3, [0, 0, 0], { rest_length: 1, spring: true }),
    joint('fork', 'universal', null, [-1, 0.4, 0], 4, [0, 0, 0]),
  ];
  const rows = ragged(Array.from({ length: frames }, (_, f) => [0, 1, 2, 3, 4].filter((j) => j !== 1 || f < broken)));
  return replay({
    scene: 'linkage',
    title: 'joints of every kind',
    backend,
    shapes: [
      { type: 'box', half_extents: [0.06, 0.5, 0.06] },
      { type: 'box', half_extents: [0.2, 0.1, 0.15] },
      { type: 'sphere', radius: 0.15 },
    ],
    bodies,
    frames,
    pose,
    header: { joints, ...header },
    extra: {
      'joints/start': ['u32', rows.start],
      'joints/joint': ['u32', rows.rows],
      'joints/gap': ['f32', rows.rows.map((j) => (j === 1 ? gap : j === 3 ? NaN : 0))],
      'joints/angle': ['f32', rows.rows.map(() => 0)],
    },
  });
}
