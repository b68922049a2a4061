// A tower, a pyramid and a door; the engine is chosen by ?engine=plumb or havok.
import { ArcRotateCamera } from '@babylonjs/core/Cameras/arcRotateCamera.js';
import { Engine } from '@babylonjs/core/Engines/engine.js';
import { HemisphericLight } from '@babylonjs/core/Lights/hemisphericLight.js';
import { StandardMaterial } from '@babylonjs/core/Materials/standardMaterial.js';
import { Color3 } from '@babylonjs/core/Maths/math.color.js';
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { CreateBox } from '@babylonjs/core/Meshes/Builders/boxBuilder.js';
import { CreateSphere } from '@babylonjs/core/Meshes/Builders/sphereBuilder.js';
import { PhysicsAggregate } from '@babylonjs/core/Physics/v2/physicsAggregate.js';
import { HingeConstraint } from '@babylonjs/core/Physics/v2/physicsConstraint.js';
import { PhysicsShapeType } from '@babylonjs/core/Physics/v2/IPhysicsEnginePlugin.js';
import '@babylonjs/core/Physics/joinedPhysicsEngineComponent.js';
import '@babylonjs/core/Physics/v2/physicsEngineComponent.js';
import '@babylonjs/core/Culling/ray.js';
import { Scene } from '@babylonjs/core/scene.js';

const name = new URLSearchParams(location.search).get('engine') ?? 'plumb';
const canvas = document.getElementById('picture');
const engine = new Engine(canvas, true);
const scene = new Scene(engine);
scene.enablePhysics(new Vector3(0, -9.81, 0), await pluginOf(name));
new HemisphericLight('light', new Vector3(0.4, 1, -0.3), scene);
const camera = new ArcRotateCamera('camera', -1.2, 1.25, 34, new Vector3(0, 7, 0), scene);
camera.attachControl(canvas, true);

async function pluginOf(chosen) {
  if (chosen === 'havok') {
    const [{ HavokPlugin }, { default: HavokPhysics }] = await Promise.all(
      [import('@babylonjs/core/Physics/v2/Plugins/havokPlugin.js'), import('@babylonjs/havok')]);
    return new HavokPlugin(false, await HavokPhysics());
  }
  const [{ PlumbPlugin }, { load }] = await Promise.all([import('../plumb_plugin.mjs'), import('@plumb/engine')]);
  return new PlumbPlugin(await load(), { useDeltaForWorldStep: false });
}

function coloured(mesh, hue) {
  mesh.material = new StandardMaterial('', scene);
  mesh.material.diffuseColor = Color3.FromHSV(hue, 0.5, 0.95);
  return mesh;
}
function box([width, height, depth], [x, y, z], mass, hue) {
  const mesh = coloured(CreateBox('', { width, height, depth }, scene), hue);
  mesh.position.set(x, y, z);
  return new PhysicsAggregate(mesh, PhysicsShapeType.BOX, { mass, friction: 0.5 }, scene).body;
}

box([60, 1, 60], [0, -0.5, 0], 0, 120);
for (let i = 0; i < 20; ++i) box([1, 1, 1], [-6, 0.5 + i, 0], 1, 18 * i);
for (let row = 0; row < 10; ++row)
  for (let i = 0; i < 10 - row; ++i) box([1, 1, 1], [4 + 1.05 * (i - (9 - row) / 2), 0.5 + row, 4], 1, 30 + 15 * row);
const post = box([0.3, 4, 0.3], [0, 2, -4], 0, 0), door = box([3, 3.6, 0.2], [1.8, 2, -4], 5, 210);
const up = new Vector3(0, 1, 0);
post.addConstraint(door, new HingeConstraint(new Vector3(0.2, 0, 0), new Vector3(-1.6, 0, 0), up, up, scene));
door.setAngularVelocity(new Vector3(0, 1, 0));

canvas.addEventListener('pointerdown', ({ offsetX, offsetY }) => {
  const { origin, direction } = scene.createPickingRay(offsetX, offsetY, null, camera);
  const ball = coloured(CreateSphere('', { diameter: 1.2 }, scene), 0);
  ball.position.copyFrom(origin.add(direction.scale(3)));
  new PhysicsAggregate(ball, PhysicsShapeType.SPHERE, { mass: 5 }, scene).body.setLinearVelocity(direction.scale(40));
});

document.getElementById('engine').textContent = name;
const times = [];
let before = 0;
scene.onBeforePhysicsObservable.add(() => (before = performance.now()));
scene.onAfterPhysicsObservable.add(() => {
  times.push(performance.now() - before);
  if (times.length % 30 === 0)
    document.getElementById('time').textContent = (times.slice(-30).reduce((a, b) => a + b) / 30).toFixed(2);
});
engine.runRenderLoop(() => scene.render());
addEventListener('resize', () => engine.resize());
