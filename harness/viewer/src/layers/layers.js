// What can be switched on over a scene: its name, what it needs of a replay, how it draws or colours.
import { kindColour, oklch, penetrationMap } from '../basics/colour.js';
import { AxisLayer } from './layer_axes.js';
import { BoxLayer } from './layer_boxes.js';
import { ConstraintLayer } from './layer_constraints.js';
import { ContactLayer } from './layer_contacts.js';
import { ForceLayer } from './layer_forces.js';
import { JointLayer } from './layer_joints.js';
import { kMostPaths, PathLayer } from './layer_paths.js';
import { VelocityLayer } from './layer_velocities.js';

const kPale = oklch(0.72, 0.012, 250);
const kIslands = Array.from({ length: 61 }, (_, i) => kindColour(i, 0.72, 0.13));

function put(rgb, out, offset) {
  for (let k = 0; k < 3; ++k) out[offset + k] = rgb[k];
}

/** Layers of one `family` exclude each other: a body has one colour. */
export const kLayers = [
  {
    name: 'joints',
    label: 'Joints',
    about: 'joints and their anchors; the colour is the gap, measured by the referee',
    needs: ['joints/start', 'joints/joint'],
    Drawing: JointLayer,
    colours: () => (body, out, offset) => put(kPale, out, offset), // unless a layer below has colours
  },
  {
    name: 'penetration',
    label: 'Overlap',
    about: 'colour of a body: its deepest overlap, measured by the referee',
    needs: ['penetration'],
    family: 'colour',
    colours:
      (replay, { penetrationRange }) =>
      (body, out, offset) =>
        penetrationMap.write((replay.value('penetration', body) ?? 0) / penetrationRange, out, offset),
  },
  {
    name: 'forces',
    label: 'Forces',
    about: 'contact forces as chains from centre to contact to centre',
    needs: ['contacts/start', 'contacts/point', 'contacts/force'],
    family: 'colour',
    Drawing: ForceLayer,
    colours: () => (body, out, offset) => put(kPale, out, offset),
  },
  {
    name: 'islands',
    label: 'Islands',
    about: 'bodies that are solved together share a colour',
    needs: ['islands'],
    family: 'colour',
    colours: (replay) => (body, out, offset) => {
      const island = replay.value('islands', body) ?? -1;
      put(island < 0 ? kPale : kIslands[island % kIslands.length], out, offset);
    },
  },
  {
    name: 'sleep',
    label: 'Sleep',
    about: 'sleeping bodies are dark',
    needs: ['asleep'],
    colours: (replay) => (body, out, offset) => {
      if (!replay.value('asleep', body)) return;
      const grey = 0.12 * (out[offset] + out[offset + 1] + out[offset + 2]);
      for (let k = 0; k < 3; ++k) out[offset + k] = 0.1 * out[offset + k] + 0.45 * grey;
    },
  },
  {
    name: 'contacts',
    label: 'Contacts',
    about: 'contact points, normals and ids: a point keeps its colour while it keeps its id',
    needs: ['contacts/start', 'contacts/point'],
    Drawing: ContactLayer,
  },
  {
    name: 'axes',
    label: 'Axes',
    about: 'the axis on which the narrow phase decided, and a pane across it',
    needs: ['axes/start', 'axes/axis'],
    Drawing: AxisLayer,
  },
  {
    name: 'boxes',
    label: 'Tree boxes',
    about: 'boxes of the broad phase, coloured by depth in the tree',
    needs: ['boxes/start', 'boxes/lower', 'boxes/upper'],
    Drawing: BoxLayer,
  },
  {
    name: 'constraints',
    label: 'Graph colours',
    about: 'constraints of one colour are solved at the same time',
    needs: ['constraints/start', 'constraints/colour'],
    Drawing: ConstraintLayer,
  },
  {
    name: 'paths',
    label: 'Paths',
    about: 'the way that each body takes',
    needs: ['positions'],
    Drawing: PathLayer,
    without: ({ moving }) =>
      moving.length > kMostPaths
        ? `${moving.length} bodies move, and paths of at most ${kMostPaths} can be told apart`
        : null,
  },
  {
    name: 'velocities',
    label: 'Velocities',
    about: 'velocity of each body: as far as it goes in a tenth of a second',
    needs: [],
    Drawing: VelocityLayer,
  },
];

/** Engines that do not tell a number write what is none. */
const told = (values) => !(values instanceof Float32Array) || values.length === 0 || values.some(Number.isFinite);

/** Why the replay cannot show the layer, or null where it can. */
export function missing(kind, replay) {
  const { backend, recorded } = replay.header,
    lacking = kind.needs.find((section) => !replay.has(section));
  if (lacking)
    return recorded?.without?.[lacking.split('/')[0]] ?? `${backend} did not record ${lacking.split('/')[0]}`;
  if (kind.without?.(replay)) return kind.without(replay);
  const silent = kind.needs.find((section) => !told(replay.sections[section]));
  return silent ? `${backend} does not tell ${silent.replace('/', ' ')}` : null;
}

/** Why nobody can show the layer: each reason once, and without the names where all give the same. */
export function missingEverywhere(kind, replays) {
  const reasons = replays.map((replay) => missing(kind, replay)),
    rest = (i) => reasons[i].replace(`${replays[i].header.backend} did not`, 'no engine');
  const same = reasons.every((reason, i) => reason.startsWith(replays[i].header.backend) && rest(i) === rest(0));
  return same && replays.length > 1
    ? rest(0).replace('no engine record', 'no engine recorded')
    : [...new Set(reasons)].join('; ');
}

/** One painter of those that are on, in their order, or null. */
export function painter(kinds, replay, context) {
  const parts = kinds
    .filter((kind) => kind.colours && !missing(kind, replay))
    .map((kind) => kind.colours(replay, context));
  if (!parts.length) return null;
  return (body, out, offset) => {
    for (const part of parts) part(body, out, offset);
  };
}
