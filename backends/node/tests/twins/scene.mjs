// What a twin is given: a scene on its standard input, as twins_test.cpp writes it, and the folder of npm's packages.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

/**
 * { dt, steps, gravity, friction, items: [{ still, sphere, half, position, orientation, mass, inertia, velocity, spin }],
 *   joints: [{ hinge, a, b, inA, inB }] }: hinges turn about z, the others are balls; a is -1 where it is the world.
 */
export const scene = JSON.parse(readFileSync(0, 'utf8'));
export const fileOf = (name, path) => join(process.env.PLUMB_NODE_MODULES, name, path);
export const load = (name, path) => import(pathToFileURL(fileOf(name, path)).href);

/** rows: position, orientation x y z w, velocity, spin of each item that moves. */
export function tell(rows) { process.stdout.write(JSON.stringify(rows)); }
