import type { IPhysicsEnginePluginV2 } from '@babylonjs/core/Physics/v2/IPhysicsEnginePlugin.js';
import type { PhysicsBody } from '@babylonjs/core/Physics/v2/physicsBody.js';
import type { TransformNode } from '@babylonjs/core/Meshes/transformNode.js';
import type { IPhysicsPointProximityQuery } from '@babylonjs/core/Physics/physicsPointProximityQuery.js';
import type { IPhysicsShapeCastQuery } from '@babylonjs/core/Physics/physicsShapeCastQuery.js';
import type { IPhysicsShapeProximityCastQuery } from '@babylonjs/core/Physics/physicsShapeProximityCastQuery.js';
import type { ProximityCastResult } from '@babylonjs/core/Physics/proximityCastResult.js';
import type { ShapeCastResult } from '@babylonjs/core/Physics/shapeCastResult.js';

export interface PlumbPluginOptions {
  /** Steps are as long as the frame was; true. false: setTimeStep's. */
  useDeltaForWorldStep?: boolean;
  /** Bodies at rest fall asleep; true. */
  sleeping?: boolean;
  /** No body passes through another, however fast it is; false. */
  ccd?: boolean;
  /** The engine's, by name. */
  settings?: Readonly<Record<string, number | string | boolean>>;
}

export interface PlumbPlugin extends IPhysicsEnginePluginV2 {}
export class PlumbPlugin {
  /** engine: what load() of @plumb/engine gave. */
  constructor(engine: { createWorld(options: any): any }, options?: PlumbPluginOptions);
  isSupported(): boolean;
  shapeCast(query: IPhysicsShapeCastQuery, input: ShapeCastResult, hit: ShapeCastResult): void;
  shapeProximity(query: IPhysicsShapeProximityCastQuery, input: ProximityCastResult, hit: ProximityCastResult): void;
  pointProximity(query: IPhysicsPointProximityQuery, result: ProximityCastResult): void;
  setPhysicsBodyTransformation(body: PhysicsBody, node: TransformNode): void;
  setActivationControl(body: PhysicsBody, mode: number): void;
}
