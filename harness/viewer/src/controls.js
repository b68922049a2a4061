// What the reader handles: scene, engines, layers and curves above the views; play, time, speed and camera below.
import { kSpeeds } from './clock.js';
import { kSeries, seriesName } from './curves.js';
import { element, icon } from './basics/dom.js';
import { kKeys } from './keys.js';
import { pairOf } from './pairs.js';
import { kLayers, missing, missingEverywhere } from './layers/layers.js';
import { legends } from './layers/legends.js';

export const kPlay = 'M4 2.5v11l9-5.5z';
const kPause = 'M4 2.5h3v11H4zM9 2.5h3v11H9z',
  kBack = 'M4 3v10h1.6V3zM13 3v10L6.5 8z';
export const kOn = 'M10.4 3v10H12V3zM3 3v10l6.5-5z';
const kLoop = 'M4 5h6V3l3.5 3L10 9V7H5v2H3.5V5.5zM12 11H6v2l-3.5-3L6 7v2h5V7h1.5v3.5z';
export const kCamera =
  'M2 2h4v1.5H3.5V6H2zM10 2h4v4h-1.5V3.5H10zM2 10h1.5v2.5H6V14H2zM12.5 10H14v4h-4v-1.5h2.5zM8 6a2 2 0 110 4 2 2 0 010-4z';
export const kFull = 'M2 2h5v1.6H4.7L7 5.9 5.9 7 3.6 4.7V7H2zM9 14v-1.6h2.3L9 10.1 10.1 9l2.3 2.3V9H14v5z';
const kFirstSeries = ['energy', 'energy_drift', 'distance', 'true_distance'];
const kTicks = 2000; // of the time line

export function button(path, label, action, attributes = {}) {
  return element(
    'button',
    { type: 'button', class: 'pv-button', title: label, 'aria-label': label, onclick: action, ...attributes },
    icon(path),
  );
}

export function speeds(viewer) {
  const select = element(
    'select',
    { 'aria-label': 'speed', title: 'speed', onchange: () => viewer.setSpeed(Number(select.value)) },
    ...kSpeeds.map((speed) => element('option', { value: speed, selected: speed === 1 }, `${speed}\u00d7`)),
  );
  return select;
}

export function keyHelp(keys) {
  return element(
    'details',
    { class: 'pv-keys' },
    element('summary', { title: 'keys', 'aria-label': 'keys' }, '?'),
    element('dl', {}, ...keys.flatMap(([key, does]) => [element('dt', {}, key), element('dd', {}, does)])),
  );
}

export class Controls {
  constructor(viewer) {
    this.viewer = viewer;
    this.playing = false;
    this.chosen = new Set(viewer.compact ? [] : this.firstSeries);
    const { names } = viewer.library,
      scenes = names.filter((name) => !pairOf(name));
    this.scene = element(
      'select',
      { 'aria-label': 'scene', onchange: () => viewer.select(this.scene.value) },
      ...scenes.map((name) => element('option', { value: name }, name)),
      viewer.pairs.first ? element('option', { value: viewer.pairs.first }, 'pairs of shapes') : null,
    );
    this.title = element('span', { class: 'pv-title' });
    this.engines = element('span', { class: 'pv-group', role: 'group', 'aria-label': 'engines' });
    this.layers = element('span', { class: 'pv-group', role: 'group', 'aria-label': 'layers' });
    this.curves = element('span', { class: 'pv-group', role: 'group', 'aria-label': 'curves' });
    this.scale = element('input', { type: 'checkbox', checked: true, onchange: () => viewer.buildCurves() });
    this.depth = element('select', {
      'aria-label': 'depth of the tree boxes',
      hidden: true,
      onchange: () => viewer.setBoxDepth(this.depthValue()),
    });
    this.namesButton = element(
      'button',
      {
        type: 'button',
        class: 'pv-chip',
        'aria-pressed': 'false',
        title: 'names of the bodies nearest to you (n)',
        onclick: () => viewer.showNames(!viewer.names),
      },
      'Names',
    );
    viewer.follow.element.append(this.namesButton);
    this.message = element('p', { class: 'pv-message', role: 'status', hidden: true });
    this.top = element(
      'div',
      { class: 'pv-top' },
      element(
        'div',
        { class: 'pv-row' },
        this.scene.options.length > 1 ? element('label', { class: 'pv-scene' }, this.scene) : null,
        this.title,
        this.engines,
      ),
      element('div', { class: 'pv-row' }, element('span', { class: 'pv-word' }, 'Layers'), this.layers, this.depth),
      element(
        'div',
        { class: 'pv-row pv-body-row' },
        element('span', { class: 'pv-word' }, 'Bodies'),
        viewer.follow.element,
      ),
      element(
        'div',
        { class: 'pv-row pv-curve-row' },
        element('span', { class: 'pv-word' }, 'Curves'),
        this.curves,
        element('label', { class: 'pv-check' }, this.scale, 'same scale'),
      ),
      this.message,
    );
    this.legend = element('div', { class: 'pv-legends' });
    this.transport = this.makeTransport();
  }

  /** Shown at first, where recorded. */
  get firstSeries() {
    return kFirstSeries;
  }

  makeTransport() {
    const { viewer } = this,
      { clock } = viewer;
    this.playButton = button(kPlay, 'play', () => viewer.toggle(), { class: 'pv-button pv-play' });
    this.loopButton = button(kLoop, 'loop', () => this.setLoop(!clock.loop), { 'aria-pressed': 'true' });
    this.slider = element('input', {
      type: 'range',
      class: 'pv-time',
      min: 0,
      max: kTicks,
      step: 1,
      value: 0,
      'aria-label': 'time',
      oninput: () => {
        viewer.pause();
        viewer.seek(clock.begin + (Number(this.slider.value) / kTicks) * (clock.end - clock.begin));
      },
    });
    this.readout = element('output', { class: 'pv-now' });
    this.speed = speeds(viewer);
    this.run = element(
      'button',
      {
        type: 'button',
        class: 'pv-chip pv-run',
        hidden: true,
        title: 'in this page, by impulse: change its settings, pull at bodies',
        onclick: () => viewer.runHere(),
      },
      'Run it here',
    );
    return element(
      'div',
      { class: 'pv-transport', role: 'group', 'aria-label': 'playback' },
      this.playButton,
      button(kBack, 'a frame back', () => viewer.stepFrames(-1), { class: 'pv-button pv-step' }),
      button(kOn, 'a frame on', () => viewer.stepFrames(1), { class: 'pv-button pv-step' }),
      this.slider,
      this.readout,
      this.speed,
      this.loopButton,
      button(kCamera, 'reset the camera', () => viewer.resetCamera()),
      button(kFull, 'fill the window', () => viewer.present()),
      keyHelp(kKeys),
      this.run,
    );
  }

  /** Fits the controls to the scene that is shown. */
  show({ views, sceneName }) {
    const { viewer } = this,
      { header } = views[0].replay;
    this.scene.value = pairOf(sceneName) ? viewer.pairs.first : sceneName;
    if (this.run) this.run.hidden = !viewer.runner?.can(sceneName);
    this.title.textContent = (header.title ?? '').replaceAll('_', ' ');
    this.engines.replaceChildren(
      ...(views.length < 2
        ? []
        : views.map((view) => {
            const { backend } = view.replay.header;
            const box = element('input', {
              type: 'checkbox',
              checked: !viewer.hidden.has(backend),
              onchange: () => viewer.toggleBackend(backend, box.checked),
            });
            return element(
              'label',
              { class: 'pv-check', style: view.element.getAttribute('style') },
              box,
              element('i', { class: 'pv-engine' }),
              view.name,
            );
          })),
    );
    this.layers.replaceChildren(...kLayers.map((kind) => this.layerButton(kind, views)));
    const names = [
      ...new Set(
        views.flatMap(({ replay }) =>
          Object.keys(replay.sections)
            .filter((name) => name.startsWith('series/'))
            .map((name) => name.slice(7)),
        ),
      ),
    ];
    const place = (name) => Object.keys(kSeries).indexOf(name) + 1 || Infinity;
    names.sort((a, b) => place(a) - place(b) || (a < b ? -1 : 1));
    this.names = names;
    this.curves.replaceChildren(
      ...names.map((name) => {
        const chip = element(
          'button',
          {
            type: 'button',
            class: 'pv-chip',
            'aria-pressed': `${this.chosen.has(name)}`,
            onclick: () => {
              if (this.chosen.has(name)) this.chosen.delete(name);
              else this.chosen.add(name);
              chip.setAttribute('aria-pressed', `${this.chosen.has(name)}`);
              viewer.buildCurves();
            },
          },
          seriesName(name),
        );
        return chip;
      }),
    );
    this.curves.parentElement.hidden = !names.length;
    const deepest = viewer.context.deepestBox;
    this.depth.replaceChildren(
      element('option', { value: 'all' }, 'all depths'),
      element('option', { value: 'leaves' }, 'leaves'),
      ...Array.from({ length: deepest + 1 }, (_, i) => element('option', { value: i }, `depth ${i}`)),
    );
    this.say('');
  }

  /** Greyed out where no engine recorded what it needs; then a press says why. */
  layerButton(kind, views) {
    const whys = views.map((view) => missing(kind, view.replay)),
      none = whys.every(Boolean);
    return element(
      'button',
      {
        type: 'button',
        class: 'pv-chip',
        'data-layer': kind.name,
        'aria-pressed': 'false',
        'aria-disabled': none ? 'true' : undefined,
        title: none
          ? missingEverywhere(
              kind,
              views.map((view) => view.replay),
            )
          : kind.about,
        onclick: () => this.viewer.setLayer(kind.name, !this.viewer.on.has(kind.name)),
      },
      kind.label,
    );
  }

  showLayers(active, context) {
    const names = active.map((kind) => kind.name);
    for (const chip of this.layers.children) chip.setAttribute('aria-pressed', `${names.includes(chip.dataset.layer)}`);
    this.depth.hidden = !names.includes('boxes');
    this.legend.replaceChildren(...legends(names, context));
    this.say('');
  }

  depthValue() {
    return /^\d+$/.test(this.depth.value) ? Number(this.depth.value) : this.depth.value;
  }
  series() {
    return this.names.filter((name) => this.chosen.has(name));
  }
  sharedScale() {
    return this.scale.checked;
  }

  setLoop(on) {
    this.viewer.clock.loop = on;
    this.loopButton.setAttribute('aria-pressed', `${on}`);
  }

  showNames(on) {
    this.namesButton.setAttribute('aria-pressed', `${on}`);
  }

  showSpeed(speed) {
    this.speed.value = speed;
  }

  showPlaying(playing) {
    this.playing = playing;
    const label = playing ? 'pause' : 'play';
    this.playButton.title = label;
    this.playButton.setAttribute('aria-label', label);
    this.playButton.querySelector('path').setAttribute('d', playing ? kPause : kPlay);
  }

  showTime(time, { begin, end }) {
    const part = end > begin ? (time - begin) / (end - begin) : 0;
    this.slider.value = Math.round(part * kTicks);
    this.slider.style.setProperty('--part', `${(part * 100).toFixed(2)}%`);
    const text = `${time.toFixed(2)} / ${end.toFixed(2)} s`;
    if (this.readout.textContent !== text) {
      this.readout.textContent = text;
      this.slider.setAttribute('aria-valuetext', `${time.toFixed(2)} seconds of ${end.toFixed(2)}`);
    }
  }

  say(text) {
    this.message.textContent = text;
    this.message.hidden = !text;
  }
}
