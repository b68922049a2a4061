// What the reader may change of a run: the scene's step, gravity and materials, and the settings that the engine lists.
import { element } from '../basics/dom.js';

const kRoles = { quality: 'Quality', behaviour: 'Behaviour', speed: 'Speed' };
const kLongest = 0.1; // s

/** As people write a step: 1/60. */
const stepText = (dt) => {
  const rate = 1 / dt;
  return Math.abs(rate - Math.round(rate)) < 1e-9 * rate && rate > 1.5 ? `1/${Math.round(rate)}` : `${dt}`;
};

export function stepOf(text) {
  const [, above, below = '1'] = /^\s*([\d.eE+-]+)\s*(?:\/\s*([\d.eE+-]+))?\s*$/.exec(text) ?? [],
    dt = Number(above) / Number(below);
  if (!(dt > 0 && dt <= kLongest)) throw new Error(`a step is above 0 and at most ${kLongest} s, as in 1/120`);
  return dt;
}

function numberOf(text, low, high, whole = false) {
  const number = Number(text);
  if (text.trim() === '' || !(number >= low && number <= high) || (whole && !Number.isInteger(number)))
    throw new Error(`"${text}" is no ${whole ? 'whole ' : ''}number from ${low} to ${high}`);
  return number;
}

export class Panel {
  constructor(viewer) {
    this.viewer = viewer;
    this.element = element('div', { class: 'pv-settings', role: 'group', 'aria-label': 'settings' });
  }

  /** Of a run that was just made. */
  show(run) {
    this.run = run;
    this.fields = [];
    const { form } = run,
      [first] = form.bodies.filter(({ motion }) => motion === 'dynamic');
    const settings = Object.entries(kRoles).map(([role, title]) =>
      this.group(
        title,
        run.engine.settings.filter((setting) => setting.role === role).map((setting) => this.setting(setting)),
        role !== 'quality',
      ),
    );
    this.element.replaceChildren(
      this.group('Scene', [
        this.text('step', 's', 'time of one step: 1/60 or 0.01', {
          get: () => stepText(run.dt),
          set: (text) => run.setDt(stepOf(text)),
        }),
        this.number('gravity', 'm/s\u00b2', 'along y', -100, 100, {
          get: () => run.gravity[1],
          set: (y) => run.setGravity([run.gravity[0], y, run.gravity[2]]),
        }),
        ...['friction', 'restitution']
          .filter((need) => form.needs.includes(need))
          .map((name) =>
            this.number(name, '', 'of all materials; empty: as the scene has them', 0, name === 'friction' ? 10 : 1, {
              get: () => run.material[name] ?? '',
              set: (value) => run.setMaterial(name, value),
              empty: () => run.setMaterial(name, null),
              hint: first ? `${first[name]}` : '',
            }),
          ),
      ]),
      ...settings,
      element('button', { type: 'button', class: 'pv-chip', onclick: () => this.viewer.anew() }, 'All as at first'),
    );
    this.refresh();
  }

  group(title, rows, folded = false) {
    return element('details', { class: 'pv-settings-group', open: !folded }, element('summary', {}, title), ...rows);
  }

  /** Writes what is in force into all fields. */
  refresh() {
    for (const { input, get, first } of this.fields) {
      const value = get();
      if (input.type === 'checkbox') input.checked = value;
      else input.value = value;
      input.closest('label').classList.toggle('pv-changed', value !== first);
    }
  }

  field(name, unit, doc, input, { get, set }) {
    const apply = () => {
      try {
        set(input.type === 'checkbox' ? input.checked : input.value);
        this.viewer.controls.say('');
      } catch (error) {
        this.viewer.controls.say(`${name}: ${error.message}`);
      }
      this.viewer.changed();
    };
    input.addEventListener('change', apply);
    this.fields.push({ input, get, first: get() });
    return element(
      'label',
      { class: 'pv-setting', title: doc, 'data-setting': name },
      element('span', {}, name.replaceAll('_', ' '), unit && unit !== '1' ? element('small', {}, ` ${unit}`) : null),
      input,
    );
  }

  text(name, unit, doc, use) {
    return this.field(name, unit, doc, element('input', { type: 'text', size: 8 }), use);
  }

  number(name, unit, doc, low, high, { get, set, empty, hint, whole = false }) {
    const input = element('input', { type: 'number', min: low, max: high, step: whole ? 1 : 'any', placeholder: hint });
    return this.field(name, unit, `${doc}; ${low} to ${high}`, input, {
      get: () => `${get()}`,
      set: (text) => (text === '' && empty ? empty() : set(numberOf(text, low, high, whole))),
    });
  }

  setting({ name, unit, doc, type, choices, minimum, maximum, creationOnly }) {
    const { run } = this,
      words = creationOnly ? `${doc}; begins anew` : doc,
      use = { get: () => run.getSetting(name), set: (value) => run.setSetting(name, value) };
    if (type === 'bool') return this.field(name, unit, words, element('input', { type: 'checkbox' }), use);
    if (type === 'choice') {
      const select = element('select', {}, ...choices.map((choice) => element('option', { value: choice }, choice)));
      return this.field(name, unit, words, select, use);
    }
    return this.number(name, unit, words, minimum, maximum, { ...use, whole: type === 'int' });
  }
}
