// What a page in TypeScript writes.
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import type { IPhysicsEnginePluginV2 } from '@babylonjs/core/Physics/v2/IPhysicsEnginePlugin.js';
import { load } from '../../plumb.mjs';
import { PlumbPlugin } from '../plumb_plugin.mjs';

const plugin = new PlumbPlugin(await load(), { sleeping: false, settings: { solver: 'si' } });
const asInterface: IPhysicsEnginePluginV2 = plugin;
asInterface.setGravity(Vector3.Zero());

// @ts-expect-error there is no such option
new PlumbPlugin(await load(), { speed: 3 });
