// What a page in TypeScript may write, and what it may not.
import { load, type World } from '../../../../../api/web/plumb.mjs';

const engine = await load({ threads: 'auto' });
export const others = [await load(), await load('engine.wasm', { threads: 2 }), await load(null, { threads: 'auto' })];
const world: World = engine.createWorld({ needs: ['joints', 'queries'], settings: { solver: 'si' } });
const ball = world.createShape({ type: 'sphere', radius: 1 });
const shape = world.createShape({ type: 'compound', children: [{ shape: ball, position: [0, 1, 0] }] });
const b = world.createBody({ shape, flags: ['ccd'], filter: { mask: 2 } });
const joint = world.createJoint({ type: 'generic', b, axes: { x: 'locked' }, motors: { angularX: { maxForce: 3 } } });
world.modifyJoint(joint, { enabled: false });
world.createCooked([engine.cook({ type: 'sphere', radius: 1 })]);
export const all: number = world.castRays([{ origin: [0, 0, 0], translation: [0, 1, 0] }], { all: true })[0]!.length;

export const why: string = engine.info.threads < 2 ? engine.info.remark : '';

// @ts-expect-error a box has no radius
world.createShape({ type: 'box', radius: 3 });
// @ts-expect-error bytes are no descriptor
world.createCooked([{ type: 'sphere', radius: 1 }]);
// @ts-expect-error a handle is no number
world.destroyBody(3);
// @ts-expect-error only motors are written
world.writeJoints('coordinates', joint, []);
// @ts-expect-error of words only auto
await load(null, { threads: 'many' });
engine.dispose();
