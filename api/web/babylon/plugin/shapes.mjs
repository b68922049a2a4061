// Shapes: what a page gave, and the engine's shape made of it once a body needs it. A shape that changes is made anew,
// and its bodies get the new one.
import { leafOf, isAtHome, placed, TYPE } from './leaves.mjs';
import { quatRowOf, rowOf } from './values.mjs';
import { trianglesOf } from './geometry.mjs';

const kGeometricMean = 0, kMaximum = 2, kAll = -1;

export const shapes = {
  initShape(shape, type, options) {
    shape._pluginData = { shape, type, leaf: type === TYPE.container ? null : leafOf(type, options), children: [],
      material: null, density: 1000, membership: kAll, collide: kAll, trigger: false, users: new Set(),
      parents: new Set(), handle: 0n, parts: [] };
    this._shapes.add(shape._pluginData);
  },
  getShapeType(shape) {
    return shape._pluginData.type;
  },
  disposeShape(shape) {
    const data = shape._pluginData;
    if (!data) return;
    for (const user of data.users) {
      user.shape = null;
      if (user.handle !== 0n) this._applyShape(user);
    }
    this._release(data);
    this._shapes.delete(data);
    shape._pluginData = undefined;
  },

  setShapeFilterMembershipMask(shape, mask) {
    this._resurface(shape._pluginData, { membership: mask });
  },
  getShapeFilterMembershipMask(shape) {
    return shape._pluginData.membership;
  },
  setShapeFilterCollideMask(shape, mask) {
    this._resurface(shape._pluginData, { collide: mask });
  },
  getShapeFilterCollideMask(shape) {
    return shape._pluginData.collide;
  },
  /** The engine has one friction, of a pair the geometric mean, and of restitutions the larger. */
  setMaterial(shape, material) {
    if ((material.frictionCombine ?? kGeometricMean) !== kGeometricMean)
      this._warn('frictions combine by their geometric mean, whatever frictionCombine says');
    if ((material.restitutionCombine ?? kMaximum) !== kMaximum)
      this._warn('the larger restitution counts, whatever restitutionCombine says');
    this._resurface(shape._pluginData, { material });
    for (const parent of shape._pluginData.parents) this._changed(parent);
  },
  getMaterial(shape) {
    return shape._pluginData.material ?? { friction: 0.5, staticFriction: 0.5, restitution: 0,
      frictionCombine: kGeometricMean, restitutionCombine: kMaximum };
  },
  _resurface(data, given) {
    Object.assign(data, given);
    for (const user of this._usersOf(data)) this._applySurface(user);
  },
  setDensity(shape, density) {
    shape._pluginData.density = density;
    this._changed(shape._pluginData);
  },
  getDensity(shape) {
    return shape._pluginData.density;
  },
  setTrigger(shape, isTrigger) {
    shape._pluginData.trigger = isTrigger;
    for (const user of this._usersOf(shape._pluginData)) this._applyShape(user);
  },

  addChild(shape, child, translation, rotation, scale) {
    const data = shape._pluginData;
    data.children.push({ data: child._pluginData, frame: { position: translation ? rowOf(translation) : [0, 0, 0],
      orientation: rotation ? quatRowOf(rotation) : [0, 0, 0, 1], scale: scale ? rowOf(scale) : [1, 1, 1] } });
    child._pluginData.parents.add(data);
    this._changed(data);
  },
  removeChild(shape, index) {
    const data = shape._pluginData, [gone] = data.children.splice(index, 1);
    if (gone && !data.children.some((child) => child.data === gone.data)) gone.data.parents.delete(data);
    this._changed(data);
  },
  getNumChildren(shape) {
    return shape._pluginData.children.length;
  },

  /** All leaves, where the body has them. */
  _leavesOf(data) {
    if (data.leaf) return [{ ...data.leaf, material: data.material }];
    return data.children.flatMap((child) => this._leavesOf(child.data).map((leaf) => placed(leaf, child.frame)));
  },
  _usersOf(data) {
    return [...data.users, ...[...data.parents].flatMap((parent) => this._usersOf(parent))];
  },
  /** A container's is its first child's, where it has none itself. */
  _materialOf(data) {
    const own = data.material ?? data.children.map((child) => child.data.material).find((one) => one) ?? {};
    return { friction: own.friction ?? 0.5, restitution: own.restitution ?? 0 };
  },
  /** The engine filters bodies: a container without masks has those of its children together. */
  _masksOf(data) {
    const { membership, collide, children } = data;
    if (children.length === 0 || membership !== kAll || collide !== kAll) return { membership, collide };
    const all = children.map((child) => this._masksOf(child.data));
    return { membership: all.reduce((bits, one) => bits | one.membership, 0),
      collide: all.reduce((bits, one) => bits | one.collide, 0) };
  },
  /** A body is a sensor, or it is not: a container is one when all of its children are. */
  _isTrigger(data) {
    if (data.trigger) return true;
    const told = data.children.map((child) => this._isTrigger(child.data));
    if (told.includes(true) && told.includes(false))
      this._warn('a container is a trigger when all of its children are; one with both kinds collides as a whole');
    return told.length > 0 && told.every((one) => one);
  },
  _solid(data) {
    const leaves = this._leavesOf(data);
    return leaves.length > 0 && leaves.every(({ desc }) => desc.type !== 'mesh' && desc.type !== 'heightField');
  },

  /** The engine's shape; 0n: an empty container. */
  _handleOf(data) {
    if (data.handle !== 0n) return data.handle;
    const leaves = this._leavesOf(data);
    if (leaves.length === 0) return 0n;
    if (leaves.length === 1 && isAtHome(leaves[0].frame)) data.handle = this.world.createShape(leaves[0].desc);
    else if (this._solid(data)) {
      data.parts = this.world.createShapes(leaves.map((leaf) => leaf.desc));
      const children = leaves.map(({ frame, material }, i) =>
        ({ shape: data.parts[i], ...frame, ...(material ? { material: materialOf(material) } : {}) }));
      data.handle = this.world.createShape({ type: 'compound', children });
    } else data.handle = this.world.createShape({ type: 'mesh', ...trianglesOf(leaves) });
    return data.handle;
  },
  _changed(data) {
    const old = { handle: data.handle, parts: data.parts };
    Object.assign(data, { handle: 0n, parts: [], massRow: undefined });
    for (const user of data.users) this._applyShape(user);
    this._release(old);
    for (const parent of data.parents) this._changed(parent);
  },
  _release({ handle, parts }) {
    if (handle !== 0n) this.world.destroyShape(handle);
    if (parts.length > 0) this.world.destroyShape(...parts);
  },
};

const materialOf = ({ friction = 0.5, restitution = 0 }) => ({ friction, restitution });
