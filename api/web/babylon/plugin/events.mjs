// After a step: collisions and triggers, told to the plugin's observables and to those of the bodies.
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { Observable } from '@babylonjs/core/Misc/observable.js';

/** The bits of an event mask. */
const STARTED = 1, CONTINUED = 2, FINISHED = 4;
const kCollisions = STARTED | CONTINUED | FINISHED;

export const events = {
  setEventMask(body, eventMask, instanceIndex) {
    this._each(body, instanceIndex, (data) => (data.eventMask = eventMask));
  },
  getEventMask(body, instanceIndex) {
    return this._one(body, instanceIndex).eventMask;
  },
  setCollisionCallbackEnabled(body, enabled, instanceIndex) {
    this._mask(body, instanceIndex, kCollisions, enabled);
  },
  setCollisionEndedCallbackEnabled(body, enabled, instanceIndex) {
    this._mask(body, instanceIndex, FINISHED, enabled);
  },
  _mask(body, instanceIndex, bits, enabled) {
    this._each(body, instanceIndex,
      (data) => (data.eventMask = enabled ? data.eventMask | bits : data.eventMask & ~bits));
  },
  getCollisionObservable(body) {
    return observableOf(this._observables.begun, body);
  },
  getCollisionEndedObservable(body) {
    return observableOf(this._observables.ended, body);
  },

  _tellEvents() {
    const told = this.world.events();
    for (const event of told)
      if (event.type.startsWith('sensor'))
        this._tellTrigger(event, event.type === 'sensorEnter' ? 'TRIGGER_ENTERED' : 'TRIGGER_EXITED');
    for (const { type, a, b } of told) {
      if (type === 'contactBegin') this._touching.set(`${a} ${b}`, { a: this._owners.get(a), b: this._owners.get(b),
        type: 'COLLISION_STARTED' });
      else if (type === 'contactEnd') this._tellEnd(`${a} ${b}`);
    }
    this._tellCollisions();
  },
  _tellTrigger({ a, b }, type) {
    const sensor = this._owners.get(a), other = this._owners.get(b);
    if (sensor && other) this.onTriggerCollisionObservable.notifyObservers(pairOf(sensor, other, type));
  },
  _tellEnd(key) {
    const pair = this._touching.get(key);
    this._touching.delete(key);
    if (!pair?.a || !pair.b || !((pair.a.eventMask | pair.b.eventMask) & FINISHED)) return;
    this._notify(this.onCollisionEndedObservable, this._observables.ended, pair, {}, 'COLLISION_FINISHED');
  },
  /** Reads the contacts only where a body asks for them. */
  _tellCollisions() {
    const wanted = [...this._touching].filter(([, { a, b, type }]) =>
      ((a?.eventMask ?? 0) | (b?.eventMask ?? 0)) & (type === 'COLLISION_STARTED' ? STARTED : CONTINUED));
    const points = wanted.length > 0 ? this._pointsOf() : new Map();
    for (const [key, pair] of wanted) {
      const point = points.get(key);
      if (point || pair.type === 'COLLISION_STARTED')
        this._notify(this.onCollisionObservable, this._observables.begun, pair, point ?? kNoPoint, pair.type);
    }
    for (const pair of this._touching.values()) pair.type = 'COLLISION_CONTINUED';
  },
  /** Of each pair the deepest contact, with the impulse of all. */
  _pointsOf() {
    const points = new Map();
    for (const { a, b, position, normal, depth, normalImpulse } of this.world.contacts()) {
      const flipped = !this._touching.has(`${a} ${b}`), key = flipped ? `${b} ${a}` : `${a} ${b}`;
      const before = points.get(key), impulse = (before?.impulse ?? 0) + normalImpulse;
      if (before && before.distance <= -depth) before.impulse = impulse;
      else points.set(key, { point: new Vector3(...position), distance: -depth, impulse,
        normal: new Vector3(...normal).scaleInPlace(flipped ? -1 : 1) });
    }
    return points;
  },
  /** Each body hears of itself as the collider. */
  _notify(everyone, ofBodies, { a, b }, point, type) {
    everyone.notifyObservers({ ...pairOf(a, b, type), ...point });
    ofBodies.get(a.body)?.notifyObservers({ ...pairOf(a, b, type), ...point });
    const turned = point.normal ? { ...point, normal: point.normal.negate() } : point;
    ofBodies.get(b.body)?.notifyObservers({ ...pairOf(b, a, type), ...turned });
  },
};

const kNoPoint = { point: null, distance: 0, impulse: 0, normal: null };
const pairOf = (a, b, type) => ({ collider: a.body, collidedAgainst: b.body, colliderIndex: a.index,
  collidedAgainstIndex: b.index, type });

function observableOf(map, body) {
  if (!map.has(body)) map.set(body, new Observable());
  return map.get(body);
}
