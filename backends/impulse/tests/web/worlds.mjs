// What the tests of the ES module share: the engine, and a world with a ground.
import { pathToFileURL } from 'node:url';

const folder = pathToFileURL(`${process.env.PLUMB_WEB}/`);
export const { load, PlumbError } = await import(new URL('plumb.mjs', folder));
export const engine = await load({ threads: Number(process.env.PLUMB_WEB_THREADS ?? 1) });

export const kStep = 1 / 60;
export function steps(world, count) {
  for (let i = 0; i < count; ++i) world.step(kStep);
}

export function grounded(needs = [], options = {}) {
  const world = engine.createWorld({ needs: ['rotation', 'collision', 'friction', ...needs], ...options });
  const shape = world.createShape({ type: 'box', halfExtents: [50, 0.5, 50] });
  const ground = world.createBody({ shape, motion: 'static', position: [0, -0.5, 0] });
  const cube = world.createShape({ type: 'box', halfExtents: [0.5, 0.5, 0.5] });
  return { world, ground, cube };
}
export const positionOf = (world, body) => [...world.read('pose', [body])].slice(0, 3);
export const velocityOf = (world, body) => [...world.read('velocity', [body])];
