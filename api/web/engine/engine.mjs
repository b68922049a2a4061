// A loaded .wasm: what it is, what it can, its settings, and its worlds.
import { shapeOf } from './descriptors.mjs';
import { INVALID, PlumbError } from './error.mjs';
import { LAYOUT } from './layouts.mjs';
import { Memory } from './memory.mjs';
import { CAPABILITY, DEGREE, JOINT, numberOf, SHAPE } from './words.mjs';
import { World } from './world.mjs';

const kTypes = ['bool', 'int', 'float', 'choice'], kRoles = ['quality', 'speed', 'behaviour'];
const kBool = 0, kChoice = 3, kCreationOnly = 1, kVersionDiffers = -8;

export class Engine {
  #threads;
  #ended = '';

  /** threads: null where the caller's is the only one; remark: why there are not more. */
  constructor(wasm, threads = null, remark = '') {
    this.wasm = wasm;
    this.#threads = threads;
    this.memory = new Memory(wasm);
    for (const [i, [name, { size }]] of Object.entries(LAYOUT).entries())
      if (wasm.plumb_struct_size(i) !== size)
        throw new PlumbError(kVersionDiffers, `the .wasm is of another version than this module: ${name} has ` +
          `${wasm.plumb_struct_size(i)} bytes there and ${size} here; take both from the same build`);
    const [name, version, build] = [0, 1, 2].map((which) => this.memory.text(wasm.plumb_info(which)));
    this.info = Object.freeze({ name, version, build, threads: threads?.count ?? 1, remark: threads?.remark || remark });
    this.settings = Object.freeze(this.#listSettings());
  }
  createWorld(options = {}) {
    this.checkAlive();
    return new World(this, options);
  }
  /** Its worlds are no more, and its threads end. */
  dispose() {
    this.#threads?.close();
    this.#ended ||= 'this engine was disposed of; load another one';
  }
  /** It cannot go on; text: why. */
  end(text) {
    this.#threads?.terminate();
    this.#ended ||= text;
  }
  get isAlive() {
    return this.#ended === '';
  }
  checkAlive() {
    if (!this.isAlive) throw new PlumbError(INVALID, this.#ended);
  }
  /** The bytes of a shape that was worked out ahead. */
  cook(options) {
    this.checkAlive();
    return this.memory.scope(() => {
      const desc = this.memory.putStructs(LAYOUT.shape, [shapeOf(this.memory, options)]);
      const bytes = this.memory.take(4), size = this.memory.take(4);
      this.check(this.wasm.plumb_cook(desc, bytes, size));
      return this.memory.array(Uint8Array, this.memory.word(bytes), this.memory.word(size));
    });
  }
  /** How truly it has a thing: capability('shape', 'mesh'), capability('joint', 'generic'). */
  capability(kind, of = 0, with_ = 0) {
    const words = { shape: SHAPE, pair: SHAPE, closest: SHAPE, triangleMaterial: SHAPE, cooking: SHAPE,
      joint: JOINT, jointFeature: JOINT }[kind];
    const number = (word) => typeof word === 'number' ? word : numberOf(words ?? {}, word, kind);
    return DEGREE[this.wasm.plumb_capability(numberOf(CAPABILITY, kind, 'capability'), number(of), number(with_))];
  }
  check(result) {
    if (result < 0) throw new PlumbError(result, this.memory.text(this.wasm.plumb_error()));
    return result;
  }

  /** A setting as it lies in memory, while the caller's scope lasts. */
  settingOf(name, value = 0) {
    const info = this.settings.find((one) => one.name === name);
    if (info === undefined)
      throw new PlumbError(INVALID,
        `there is no setting "${name}"; there are ${this.settings.map((one) => one.name).join(', ')}`);
    const word = typeof value === 'string';
    return { name: this.memory.putText(name), value: { type: kTypes.indexOf(info.type), number: word ? 0 : Number(value),
      choice: word ? this.memory.putText(value) : 0 } };
  }
  valueOf({ type, number, choice }) {
    return type === kChoice ? this.memory.text(choice) : type === kBool ? number !== 0 : number;
  }
  #listSettings() {
    const list = [];
    for (let at; (at = this.wasm.plumb_setting(list.length)) !== 0;) {
      const [row] = this.memory.structs(LAYOUT.settingInfo, at, 1);
      const choices = Array.from({ length: row.choiceCount }, (_, i) =>
        this.memory.text(this.memory.word(row.choices + 4 * i)));
      list.push(Object.freeze({ name: this.memory.text(row.name), unit: this.memory.text(row.unit),
        doc: this.memory.text(row.doc), type: kTypes[row.type], role: kRoles[row.role],
        creationOnly: (row.flags & kCreationOnly) !== 0, choices, minimum: row.minimum, maximum: row.maximum,
        default: this.valueOf(row.default) }));
    }
    return list;
  }
}
