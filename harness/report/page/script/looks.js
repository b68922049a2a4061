// How series look: the hue is the engine's; a method has a shape, a line its dashes. No two series of a figure look alike.

const turn = (context, points, angle, radius) => {
  points.forEach(([x, y], i) => {
    const px = radius * (x * Math.cos(angle) - y * Math.sin(angle)),
      py = radius * (x * Math.sin(angle) + y * Math.cos(angle));
    if (i) context.lineTo(px, py);
    else context.moveTo(px, py);
  });
  context.closePath();
};
const regular = (corners, scale, angle = 0, inner = 0) => {
  const points = [];
  for (let i = 0; i < corners; ++i) {
    const at = (share) => [Math.sin((2 * Math.PI * (i + share)) / corners), -Math.cos((2 * Math.PI * (i + share)) / corners)];
    points.push(at(0));
    if (inner) points.push(at(0.5).map((c) => c * inner));
  }
  return { draw: (context, size) => turn(context, points, angle, scale * Math.sqrt(size / Math.PI)) };
};
const outline = (points, scale = 1) => ({
  draw: (context, size) => turn(context, points, 0, scale * Math.sqrt(size / Math.PI)),
});
const circle = {
  draw(context, size) {
    const r = Math.sqrt(size / Math.PI);
    context.moveTo(r, 0);
    context.arc(0, 0, r, 0, 2 * Math.PI);
  },
};
const cross = (arm) => [
  [-arm, -1], [arm, -1], [arm, -arm], [1, -arm], [1, arm], [arm, arm],
  [arm, 1], [-arm, 1], [-arm, arm], [-1, arm], [-1, -arm], [-arm, -arm],
];

/** Shapes that one tells apart filled or hollow, at nine pixels; the first four are those of an engine's members. */
export const kShapes = [
  circle,
  regular(4, 1.2, Math.PI / 4),
  regular(3, 1.35),
  regular(4, 1.3),
  regular(3, 1.35, Math.PI),
  outline(cross(0.34), 1.2),
  regular(5, 1.5, 0, 0.42),
  regular(6, 1.15),
  outline([[-1, -1], [1, 1], [1, -1], [-1, 1]], 1.1),
  outline([[-1, -1], [1, -1], [-1, 1], [1, 1]], 1.1),
  outline([[-0.4, -1], [0.4, -1], [0.4, 1], [-0.4, 1]], 1.3),
  outline([[-1, -0.4], [1, -0.4], [1, 0.4], [-1, 0.4]], 1.3),
  regular(3, 1.35, Math.PI / 2),
  regular(3, 1.35, -Math.PI / 2),
  regular(4, 1.5, 0, 0.36),
  outline([[-1, 1], [-1, 0], [0, -1.1], [1, 0], [1, 1]]),
  outline([[-1, -1], [-0.3, -1], [-0.3, 0.3], [1, 0.3], [1, 1], [-1, 1]]),
  outline([[-1, -1], [1, -1], [1, -0.3], [0.35, -0.3], [0.35, 1], [-0.35, 1], [-0.35, -0.3], [-1, -0.3]]),
  outline([[-1, 1], [-0.5, -1], [0.5, -1], [1, 1]]),
  outline([[-1, -1], [1, -1], [0.5, 1], [-0.5, 1]]),
  outline([[-1, -0.9], [0.2, -0.9], [1, 0], [0.2, 0.9], [-1, 0.9], [-0.3, 0]]),
  outline([[1, -0.9], [-0.2, -0.9], [-1, 0], [-0.2, 0.9], [1, 0.9], [0.3, 0]]),
];
export const kDashes = ['', '6 3', '2 3', '9 3 2 3', '13 4', '4 2 1 2 1 2'];

/** Engines as the page's switches have them: name, hue, shade and colour, by number. */
export function enginesOfPage() {
  return [...document.querySelectorAll('input[data-backend]')].map((box) => ({
    name: box.value,
    hue: Number(box.dataset.hue),
    shade: Number(box.dataset.shade),
    colour: `var(--hue${box.dataset.colour})`,
  }));
}

/** The look of each series: {colour, shape, dash}, shape and dash by number. */
export function looksOf(series, engines) {
  const lines = [...new Set(series.map(({ line }) => line ?? ''))],
    shapes = new Map(), // of a method, by hue and name
    taken = new Map(), // shapes by hue
    looks = new Set();
  const shapeOf = ({ engine, method = '', rank }) => {
    const { hue, shade, name } = engines[engine],
      key = `${name} ${method}`;
    if (!shapes.has(key)) {
      const used = taken.get(hue) ?? taken.set(hue, new Set()).get(hue);
      let shape = rank ?? shade;
      for (let tries = 0; used.has(shape % kShapes.length) && tries < kShapes.length; ++tries) ++shape;
      used.add(shape % kShapes.length);
      shapes.set(key, shape % kShapes.length);
    }
    return shapes.get(key);
  };
  // An engine's own marker goes to its default settings.
  for (const one of series) if (one.engine !== undefined && !one.method && !one.stepped) shapeOf(one);
  return series.map((one) => {
    if (one.engine === undefined) return { colour: 'var(--frame)', shape: 0, dash: 0 };
    const { hue, colour } = engines[one.engine],
      shape = one.stepped ? 'none' : shapeOf(one);
    let dash = lines.indexOf(one.line ?? '') % kDashes.length;
    if (one.stepped || !(one.quiet || one.large))
      for (let tries = 0; looks.has(`${hue} ${shape} ${dash}`) && tries < kDashes.length; ++tries)
        dash = (dash + 1) % kDashes.length;
    looks.add(`${hue} ${shape} ${dash}`);
    return { colour, shape, dash };
  });
}
