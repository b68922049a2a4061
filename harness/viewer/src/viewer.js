// The viewer: views side by side on one canvas, one clock and one camera for all of them.
import { Vector2, Vector3 } from 'three';
import { Cameras } from './cameras.js';
import { Clock } from './clock.js';
import { Controls } from './controls.js';
import { element } from './basics/dom.js';
import { Follow } from './follow.js';
import { framing } from './framing.js';
import { listenToKeys } from './keys.js';
import { kLayers, missing, missingEverywhere, painter } from './layers/layers.js';
import { Pace } from './pace.js';
import { PairPanel } from './pairs.js';
import { colourRanges, seriesRanges } from './ranges.js';
import { kPose } from './data/replay.js';
import { Stage } from './stage.js';
import { readTheme, watchTheme } from './theme.js';
import { View } from './view.js';

const kPairZoom = 0.75; // of the way of the second shape: where the two touch is what counts
const kNear = '400px'; // round the window: so near a place begins to play
const kManyJoints = 400; // beyond, they are drawn when asked for
const kFewPaths = 4; // bodies that move: of so few one sees the paths without asking
const kLongestTick = 0.1; // s: slower machines play slower rather than by leaps

export class Viewer {
  /** options: scene (the first of the page where there is none of that name), at (the second to stand at, else it
   *  plays when it is seen), compact (views and time alone), runner (live/runner.js). */
  constructor(place, library, { scene, at, compact = false, runner = null } = {}) {
    this.place = place;
    this.library = library;
    this.firstScene = library.names.includes(scene) ? scene : library.names[0];
    this.firstTime = at;
    this.compact = compact;
    this.runner = runner;
    this.views = [];
    this.on = new Set();
    this.hidden = new Set(); // backends that are switched off
    this.names = false; // of bodies, beside them
    this.clock = this.makeClock();
    this.pace = new Pace();
    this.cameras = new Cameras(() => this.touch());
    this.context = { penetrationRange: 1, forceRange: 1, gapRange: 1, deepestBox: 0, boxDepth: 'all' };
    this.failure = null;
    this.stage = new Stage();
    place.classList.add('pv');
    place.classList.toggle('pv-compact', compact);
    if (!library.names.length) this.fail(this.nothing);
    else if (!this.stage.gl)
      this.fail(
        'The replays need WebGL 2, which this browser does not offer or has switched off. ' +
          'Everything else on this page works without it.',
      );
    if (!this.failure) this.startWhenNear();
  }

  // ---- what a run that goes on has otherwise (live/live_viewer.js) ----
  get nothing() {
    return 'There are no replays in this page: run with --record and make the report again.';
  }
  makeClock() {
    return new Clock();
  }
  makeControls() {
    return new Controls(this);
  }
  framingOf(replays) {
    return framing(replays);
  }
  parts() {
    const { top, legend, transport } = this.controls;
    return [top, this.pairs.element, legend, this.stage.element, transport];
  }

  /** Resolves when the first scene is shown. */
  start() {
    this.started ??= this.failure ? Promise.resolve() : this.begin();
    return this.started;
  }

  startWhenNear() {
    const near = new IntersectionObserver(
      ([entry]) => {
        if (!entry.isIntersecting) return;
        near.disconnect();
        this.start();
      },
      { rootMargin: kNear },
    );
    near.observe(this.place);
  }

  /** Says in words what is wrong, in the viewer's place. */
  fail(text) {
    this.failure = text;
    this.place.replaceChildren(element('p', { class: 'pv-failure', role: 'alert' }, text));
  }

  async begin() {
    this.stage.start();
    this.pairs = new PairPanel(this);
    this.follow = new Follow(this);
    this.controls = this.makeControls();
    this.place.replaceChildren(...this.parts());
    listenToKeys(this);
    watchTheme(() => this.repaint());
    new ResizeObserver(() => this.layout()).observe(this.stage.element);
    const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
    new IntersectionObserver(
      ([entry]) => {
        this.visible = entry.isIntersecting;
        this.greet();
        this.schedule();
      },
      { rootMargin: '-15% 0px' },
    ).observe(this.stage.element);
    this.place.addEventListener('pointerdown', () => this.cameras.allowZoom(true));
    document.addEventListener('pointerdown', (event) => {
      if (!this.place.contains(event.target)) this.cameras.allowZoom(false);
    });
    this.fresh = !calm;
    await this.select(this.firstScene);
    if (this.firstTime !== undefined) this.seek(Number(this.firstTime));
    this.greet();
  }

  /** The first sight of a replay moves, unless the reader wants calm. */
  greet() {
    if (this.visible && this.fresh && this.views.length) this.play();
  }

  /** Shows a scene in all engines that have a replay of it. */
  async select(name) {
    this.wanted = name;
    const opened = await this.library.open(name).catch((error) => {
      this.controls.say(error.message);
      return null;
    });
    if (!opened || this.wanted !== name) return; // another one was asked for in the meantime
    this.sceneName = name;
    this.cameras.detach();
    for (const view of this.views) {
      view.element.remove();
      view.dispose();
    }
    const replays = opened.map(({ replay }) => replay);
    this.kind = replays[0].header.kind ?? 'scene';
    Object.assign(this.context, colourRanges(replays), { boxDepth: 'all' });
    this.framing = this.framingOf(replays);
    if (this.kind === 'pairs') this.framing.half.multiplyScalar(kPairZoom);
    const callbacks = {
      pick: (view, event) => this.pick(view, event),
      seek: (time) => {
        this.pause();
        this.seek(time);
      },
    };
    this.views = opened.map(
      ({ backend, replay }) => new View(replay, this.framing, this.library.hue(backend), callbacks),
    );
    this.clock.setRange(Math.min(...replays.map((r) => r.begin)), Math.max(...replays.map((r) => r.end)));
    for (const view of this.views) {
      this.stage.element.append(view.element);
      this.cameras.attach(view.port);
    }
    this.pairs.show(name);
    this.enterPairs(this.kind === 'pairs');
    if (!this.pathsChosen)
      this.setPaths(this.kind === 'scene' && Math.max(...replays.map(({ moving }) => moving.length)) <= kFewPaths);
    if (!this.jointsChosen) this.setJoints(replays.every(({ header }) => (header.joints?.length ?? 0) <= kManyJoints));
    for (const kind of kLayers) if (this.on.has(kind.name) && !this.available(kind)) this.on.delete(kind.name);
    this.follow.show(replays[0]);
    this.controls.show(this);
    this.applyLayers();
    this.buildCurves();
    this.applyHidden();
    this.repaint();
    this.layout();
    this.resetCamera();
    this.renderOnce();
  }

  setPaths(on) {
    if (on) this.on.add('paths');
    else this.on.delete('paths');
  }

  setJoints(on) {
    if (on) this.on.add('joints');
    else this.on.delete('joints');
  }

  /** Among pairs, contacts and axes are what one came for; leaving them, the scenes are as they were. */
  enterPairs(inside) {
    if (inside === Boolean(this.before)) return;
    const on = inside ? new Set(['contacts', 'axes']) : this.before;
    this.before = inside ? this.on : null;
    this.on = on;
  }

  available(kind) {
    return this.views.some((view) => !missing(kind, view.replay));
  }

  setLayer(name, on) {
    const kind = kLayers.find((layer) => layer.name === name);
    if (!kind)
      throw new Error(`there is no layer "${name}"; there are: ${kLayers.map((layer) => layer.name).join(', ')}`);
    if (on && !this.available(kind)) {
      this.controls.say(
        `${kind.label}: ${missingEverywhere(
          kind,
          this.views.map((view) => view.replay),
        )}`,
      );
      return false;
    }
    if (name === 'paths') this.pathsChosen = true;
    if (name === 'joints') this.jointsChosen = true;
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
    const replays = this.views.map((view) => view.replay),
      names = this.controls.series();
    const ranges = this.controls.sharedScale() ? seriesRanges(replays, names) : null;
    for (const view of this.views) view.curves.build(names, { begin: this.clock.begin, end: this.clock.end }, ranges);
    this.layout();
  }

  toggleBackend(backend, on) {
    if (on) this.hidden.delete(backend);
    else this.hidden.add(backend);
    this.applyHidden();
    this.layout();
  }

  applyHidden() {
    for (const view of this.views) view.element.hidden = this.hidden.has(view.replay.header.backend);
    this.stage.element.dataset.views = this.shown().length;
  }

  shown() {
    return this.views.filter((view) => !view.element.hidden);
  }

  // ---- time ----
  play() {
    this.fresh = false;
    this.clock.play();
    this.controls.showPlaying(this.clock.playing);
    this.touch();
  }
  pause() {
    this.fresh = false;
    this.clock.pause();
    this.controls.showPlaying(false);
    this.touch();
  }
  toggle() {
    if (this.clock.playing) this.pause();
    else this.play();
  }
  seek(time) {
    this.fresh = false;
    this.clock.seek(time);
    this.touch();
  }
  longest() {
    return this.views.reduce(
      (best, view) => (view.replay.frames > best.frames ? view.replay : best),
      this.views[0].replay,
    );
  }
  frame() {
    return this.longest().frameAt(this.clock.shown);
  }

  /** To the frame so many further on. */
  stepFrames(count) {
    const replay = this.longest(),
      frame = Math.min(Math.max(replay.frameAt(this.clock.shown) + count, 0), replay.frames - 1);
    this.pause();
    this.seek(replay.times[frame]);
  }

  setSpeed(speed) {
    this.clock.speed = speed;
    this.controls.showSpeed(speed);
  }

  /** The scene in the page's own engine. */
  runHere() {
    this.pause();
    return this.runner.open(this.sceneName);
  }

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
    const point = new Vector2(
      ((event.clientX - rect.left) / rect.width) * 2 - 1,
      1 - ((event.clientY - rect.top) / rect.height) * 2,
    );
    const body = view.scene.pick(point, this.cameras.shifted(this.follow.offsetOf(view)));
    this.selectBody(body === null ? null : view.replay, body);
  }

  /** The same body in every view: by its name, else by its number. */
  selectBody(replay, body) {
    for (const view of this.views) {
      const { bodies } = view.replay,
        name = body === null ? null : replay.bodies[body].name;
      const same =
        body === null ? null : bodies[body]?.name === name ? body : bodies.findIndex((other) => other.name === name);
      view.select(same === -1 ? null : same);
    }
    this.touch();
  }

  /** Lets go of what was picked, first of the camera. */
  letGo() {
    if (this.follow.on) this.follow.stop();
    else this.selectBody(null, null);
  }

  /** In 0..1 of the port, from the left and from the top. */
  onScreen(name, number) {
    const view = this.views[number],
      body = this.follow.bodyOf(view.replay, name),
      at = new Vector3()
        .fromArray(view.replay.poses, body * kPose)
        .project(this.cameras.shifted(this.follow.offsetOf(view)));
    return [(at.x + 1) / 2, (1 - at.y) / 2];
  }

  showNames(on) {
    this.names = on;
    this.controls.showNames(on);
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
    this.stage.layout(this.views, this.pace.level);
    const box = this.shown()[0]?.box;
    if (box?.height > 0) this.cameras.fit(this.framing, box.width / box.height);
    this.touch();
  }

  touch() {
    this.dirty = true;
    this.schedule();
  }

  schedule() {
    if (this.pending || !this.views.length || !(this.dirty || (this.clock.playing && this.visible))) return;
    this.pending = true;
    requestAnimationFrame((now) => {
      this.pending = false;
      const seconds = Math.max((now - (this.last ?? now)) / 1000, 0);
      if (this.last !== undefined && this.pace.late(seconds)) this.layout();
      this.last = this.clock.playing ? now : undefined;
      if (this.visible && this.clock.tick(Math.min(seconds, kLongestTick))) this.dirty = true;
      if (this.clock.playing === false && this.controls.playing) this.controls.showPlaying(false);
      if (this.dirty) this.draw();
      this.schedule();
    });
  }

  draw() {
    this.dirty = false;
    const time = this.clock.shown,
      { context, cameras } = this;
    for (const view of this.shown()) {
      view.scene.update(time, view.colours, context);
      view.curves.update(time);
      view.describe();
      const camera = cameras.shifted(this.follow.offsetOf(view));
      view.annotate(camera, cameras.distance, { ids: this.on.has('contacts'), names: this.names });
      this.stage.draw(view, camera);
    }
    this.controls.showTime(time, this.clock);
  }

  /** Draws now and waits for the graphics to be done; milliseconds that it took. */
  renderOnce() {
    const begin = performance.now();
    this.draw();
    this.stage.finish();
    return performance.now() - begin;
  }
}
