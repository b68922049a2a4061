// The viewer: views side by side on one canvas, one clock and one camera for all of them.
import { PCFShadowMap, WebGLRenderer, Vector2 } from 'three';
import { Cameras } from './cameras.js';
import { Clock } from './clock.js';
import { Controls } from './controls.js';
import { element } from './dom.js';
import { framing } from './framing.js';
import { listenToKeys } from './keys.js';
import { kLayers, missing, painter } from './layers.js';
import { PairPanel } from './pairs.js';
import { colourRanges, seriesRanges } from './ranges.js';
import { readTheme, watchTheme } from './theme.js';
import { View } from './view.js';

const kShadowBodies = 3000; // in all views together: beyond, the shadows cost more than they show
const kMostPixels = 2; // of the canvas to one of the page

export class Viewer {
  constructor(place, library) {
    this.place = place;
    this.library = library;
    this.views = [];
    this.on = new Set();
    this.hidden = new Set(); // backends that are switched off
    this.clock = new Clock();
    this.cameras = new Cameras(() => this.touch());
    this.context = { penetrationRange: 1, forceRange: 1, deepestBox: 0, boxDepth: 'all' };
    this.failure = null;
    this.stage = element('div', { class: 'pv-stage' });
    this.canvas = element('canvas', { class: 'pv-canvas', 'aria-hidden': 'true' });
    place.classList.add('pv');
    const gl = this.canvas.getContext('webgl2', { antialias: true, alpha: true, powerPreference: 'high-performance' });
    if (!library.names.length) this.fail('There are no replays in this page: run with --record and make the report again.');
    else if (!gl) this.fail('The replays need WebGL 2, which this browser does not offer or has switched off. Everything else on this page works without it.');
    this.ready = this.failure ? Promise.resolve() : this.begin(gl);
  }

  /** Says in words what is wrong, in the viewer's place. */
  fail(text) {
    this.failure = text;
    this.place.replaceChildren(element('p', { class: 'pv-failure', role: 'alert' }, text));
  }

  async begin(gl) {
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context: gl, antialias: true, alpha: true });
    this.renderer.setScissorTest(true);
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.pairs = new PairPanel(this);
    this.controls = new Controls(this);
    this.stage.append(this.canvas);
    this.place.replaceChildren(this.controls.top, this.pairs.element, this.controls.legend, this.stage, this.controls.transport);
    listenToKeys(this);
    watchTheme(() => this.repaint());
    new ResizeObserver(() => this.layout()).observe(this.stage);
    const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
    new IntersectionObserver(([entry]) => {
      this.visible = entry.isIntersecting;
      if (this.visible && this.fresh && !calm) this.play(); // the first sight of it moves, unless the reader wants calm
      this.schedule();
    }, { threshold: 0.25 }).observe(this.stage);
    this.place.addEventListener('pointerdown', () => this.cameras.allowZoom(true));
    document.addEventListener('pointerdown', (event) => { if (!this.place.contains(event.target)) this.cameras.allowZoom(false); });
    this.fresh = !calm;
    await this.select(this.library.names[0]);
  }

  /** Shows a scene in all engines that have a replay of it. */
  async select(name) {
    const opened = await this.library.open(name).catch((error) => { this.controls.say(error.message); return null; });
    if (!opened) return;
    this.sceneName = name;
    this.cameras.detach();
    for (const view of this.views) { view.element.remove(); view.dispose(); }
    const replays = opened.map(({ replay }) => replay);
    this.kind = replays[0].header.kind ?? 'scene';
    Object.assign(this.context, colourRanges(replays), { boxDepth: 'all' });
    this.framing = framing(replays);
    this.views = opened.map(({ backend, replay }) =>
      new View(replay, this.framing, this.library.hue(backend), { pick: (view, event) => this.pick(view, event) }));
    this.clock.setRange(Math.min(...replays.map((r) => r.begin)), Math.max(...replays.map((r) => r.end)));
    for (const view of this.views) {
      this.stage.append(view.element);
      this.cameras.attach(view.port);
    }
    this.pairs.show(name);
    this.enterPairs(this.kind === 'pairs');
    for (const kind of kLayers) if (this.on.has(kind.name) && !this.available(kind)) this.on.delete(kind.name);
    this.controls.show(this);
    this.applyLayers();
    this.buildCurves();
    this.applyHidden();
    this.repaint();
    this.layout();
    this.resetCamera();
    this.renderOnce();
  }

  /** Among pairs, contacts and axes are what one came for; leaving them, the scenes are as they were. */
  enterPairs(inside) {
    if (inside === Boolean(this.before)) return;
    const on = inside ? new Set(['contacts', 'axes']) : this.before;
    this.before = inside ? this.on : null;
    this.on = on;
  }

  available(kind) { return this.views.some((view) => !missing(kind, view.replay)); }

  setLayer(name, on) {
    const kind = kLayers.find((layer) => layer.name === name);
    if (!kind) throw new Error(`there is no layer "${name}"; there are: ${kLayers.map((layer) => layer.name).join(', ')}`);
    if (on && !this.available(kind)) {
      this.controls.say(`${kind.label}: ${[...new Set(this.views.map((view) => missing(kind, view.replay)))].join('; ')}`);
      return false;
    }
    if (on) {
      for (const other of kLayers) if (other.family && other.family === kind.family) this.on.delete(other.name);
      this.on.add(name);
    } else this.on.delete(name);
    this.applyLayers();
    return true;
  }

  applyLayers() {
    const active = kLayers.filter((kind) => this.on.has(kind.name));
    for (const view of this.views) {
      for (const kind of kLayers) view.scene.setLayer(kind, this.on.has(kind.name) && !missing(kind, view.replay));
      view.explain(active);
      view.colours = painter(active, view.replay, this.context);
    }
    this.controls.showLayers(active, this.context);
    this.touch();
  }

  setBoxDepth(depth) {
    this.context.boxDepth = depth;
    for (const view of this.views) view.scene.shownFrame = -1;
    this.touch();
  }

  buildCurves() {
    const replays = this.views.map((view) => view.replay), names = this.controls.series();
    const ranges = this.controls.sharedScale() ? seriesRanges(replays, names) : null;
    for (const view of this.views) view.curves.build(names, { begin: this.clock.begin, end: this.clock.end }, ranges);
    this.layout();
  }

  toggleBackend(backend, on) {
    if (on) this.hidden.delete(backend); else this.hidden.add(backend);
    this.applyHidden();
    this.layout();
  }

  applyHidden() {
    for (const view of this.views) view.element.hidden = this.hidden.has(view.replay.header.backend);
    this.stage.dataset.views = this.shown().length;
  }

  shown() { return this.views.filter((view) => !view.element.hidden); }

  // ---- time ----
  play() { this.fresh = false; this.clock.play(); this.controls.showPlaying(this.clock.playing); this.touch(); }
  pause() { this.fresh = false; this.clock.pause(); this.controls.showPlaying(false); this.touch(); }
  toggle() { if (this.clock.playing) this.pause(); else this.play(); }
  seek(time) { this.fresh = false; this.clock.seek(time); this.touch(); }
  longest() { return this.views.reduce((best, view) => (view.replay.frames > best.frames ? view.replay : best), this.views[0].replay); }
  frame() { return this.longest().frameAt(this.clock.shown); }

  /** To the frame so many further on. */
  stepFrames(count) {
    const replay = this.longest(), frame = Math.min(Math.max(replay.frameAt(this.clock.shown) + count, 0), replay.frames - 1);
    this.pause();
    this.seek(replay.times[frame]);
  }

  setSpeed(speed) { this.clock.speed = speed; this.controls.showSpeed(speed); }

  // ---- picture ----
  resetCamera() {
    const view = this.shown()[0];
    this.cameras.frame(this.framing, view && view.box ? view.box.width / view.box.height : 1.3);
  }

  /** Fills the window with the views, for a closer look and for stills. */
  present(on = !this.place.classList.contains('pv-full'), bare = false) {
    this.place.classList.toggle('pv-full', on);
    this.place.classList.toggle('pv-bare', on && bare);
    document.documentElement.classList.toggle('pv-covered', on);
    this.cameras.allowZoom(on);
    this.layout();
    if (!this.cameras.moved) this.resetCamera();
  }

  pick(view, event) {
    const rect = view.port.getBoundingClientRect();
    const point = new Vector2(((event.clientX - rect.left) / rect.width) * 2 - 1, 1 - ((event.clientY - rect.top) / rect.height) * 2);
    const body = view.scene.pick(point, this.cameras.camera);
    this.selectBody(body === null ? null : view.replay, body);
  }

  /** The same body in every view: by its name, else by its number. */
  selectBody(replay, body) {
    for (const view of this.views) {
      const { bodies } = view.replay, name = body === null ? null : replay.bodies[body].name;
      const same = body === null ? null : bodies[body]?.name === name ? body : bodies.findIndex((other) => other.name === name);
      view.select(same === -1 ? null : same);
    }
    this.touch();
  }

  repaint() {
    const theme = readTheme(this.place);
    for (const view of this.views) view.scene.paint(theme);
    this.touch();
  }

  /** Where the views lie on the canvas; read once, not every frame. */
  layout() {
    if (!this.views.length) return;
    const stage = this.stage.getBoundingClientRect(), width = Math.max(stage.width, 1), height = Math.max(stage.height, 1);
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, kMostPixels));
    this.renderer.setSize(width, height);
    this.height = height;
    for (const view of this.views) {
      const port = view.port.getBoundingClientRect();
      view.box = { x: port.left - stage.left, y: stage.bottom - port.bottom, width: port.width, height: port.height };
    }
    const first = this.shown()[0];
    if (first && first.box.height > 0) {
      const aspect = first.box.width / first.box.height;
      if (!this.cameras.moved && Math.abs(aspect - this.cameras.camera.aspect) > 1e-3) this.cameras.frame(this.framing, aspect);
      this.cameras.camera.aspect = aspect;
      this.cameras.camera.updateProjectionMatrix();
    }
    const bodies = this.shown().reduce((sum, view) => sum + view.replay.bodies.length, 0);
    for (const view of this.views) view.scene.sun.castShadow = bodies <= kShadowBodies;
    this.touch();
  }

  touch() {
    this.dirty = true;
    this.schedule();
  }

  schedule() {
    if (this.pending || !this.renderer || !(this.dirty || (this.clock.playing && this.visible))) return;
    this.pending = true;
    requestAnimationFrame((now) => {
      this.pending = false;
      const seconds = Math.min(Math.max((now - (this.last ?? now)) / 1000, 0), 0.1);
      this.last = this.clock.playing ? now : undefined;
      if (this.visible && this.clock.tick(seconds)) this.dirty = true;
      if (this.clock.playing === false && this.controls.playing) this.controls.showPlaying(false);
      if (this.dirty) this.draw();
      this.schedule();
    });
  }

  draw() {
    this.dirty = false;
    const time = this.clock.shown, { renderer, context, cameras: { camera } } = this;
    for (const view of this.views) {
      if (view.element.hidden || !view.box || view.box.width < 1) continue;
      view.scene.update(time, view.colours, context);
      view.curves.update(time);
      view.describe();
      view.placeLabels(camera, this.on.has('contacts'));
      const { x, y, width, height } = view.box;
      renderer.setViewport(x, y, width, height);
      renderer.setScissor(x, y, width, height);
      renderer.render(view.scene.scene, camera);
    }
    this.controls.showTime(time, this.clock);
  }

  /** Draws now and waits for the graphics to be done; milliseconds that it took. */
  renderOnce() {
    const begin = performance.now(), gl = this.renderer.getContext();
    this.draw();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    return performance.now() - begin;
  }

  /** For tests and for stills from the command line. */
  api() {
    const viewer = this;
    return {
      ready: this.ready,
      get failure() { return viewer.failure; },
      play: () => this.play(), pause: () => this.pause(), seek: (seconds) => this.seek(seconds),
      select: (scene) => this.select(scene), setLayer: (name, on) => this.setLayer(name, on),
      frame: () => this.frame(), renderOnce: () => this.renderOnce(),
      present: (on, bare) => this.present(on, bare), selectPair: (a, b) => this.pairs.select(a, b),
      scenes: () => this.library.names,
      describe: () => ({
        scene: this.sceneName, kind: this.kind, time: this.clock.shown, begin: this.clock.begin, end: this.clock.end, playing: this.clock.playing,
        backends: this.views.map((view) => view.replay.header.backend), bodies: this.views.map((view) => view.replay.bodies.length),
        layers: kLayers.map((kind) => ({ name: kind.name, on: this.on.has(kind.name), available: this.available(kind) })),
      }),
    };
  }
}
