// The viewer of a scene that runs in the page: one view, whose time goes on as the engine steps.
import { element } from '../basics/dom.js';
import { framing } from '../framing.js';
import { Viewer } from '../viewer.js';
import { Grab } from './grab.js';
import { LiveClock } from './live_clock.js';
import { LiveControls } from './live_controls.js';
import { Panel } from './panel.js';
import { LiveRun } from './run.js';

const kCurvesEvery = 150; // ms
const kAhead = { seconds: 3, milliseconds: 150, frames: 24 }; // run to see what the camera must hold
const kGrows = 1.15; // of a colour's range, before it is shown anew
const kSmooth = 0.1; // of a step's time in the mean that is shown

export class LiveViewer extends Viewer {
  get nothing() {
    return 'There is nothing to run in this page: plumb live makes one that can.';
  }
  makeClock() {
    return new LiveClock(this);
  }
  makeControls() {
    this.panel = new Panel(this);
    this.grab = new Grab(this);
    return new LiveControls(this);
  }
  parts() {
    const { top, legend, transport } = this.controls;
    return [top, legend, element('div', { class: 'pv-live' }, this.stage.element, this.panel.element), transport];
  }

  get run() {
    return this.library.run;
  }
  get replay() {
    return this.views[0].replay;
  }

  /** What the scene does at first, seen from a run ahead of it. */
  framingOf([replay]) {
    const { header, bodies, moving } = replay,
      frames = this.framesAhead();
    const coordinate = (frame, column, axis) => frames[frame][moving[column] * 7 + axis];
    return framing([{ header, bodies, moving, frames: frames.length, coordinate }]);
  }

  /** Poses; none where there is no room for a second world. */
  framesAhead() {
    const frames = [],
      begin = performance.now();
    let ahead = null;
    try {
      ahead = new LiveRun(this.run.engine, this.run.form);
      const seconds = Math.min(kAhead.seconds, ahead.form.header.seconds),
        stride = Math.max(1, Math.round(seconds / ahead.dt / kAhead.frames));
      while (frames.length < kAhead.frames && performance.now() - begin < kAhead.milliseconds) {
        frames.push(ahead.poses);
        for (let i = 0; i < stride; ++i) ahead.step();
      }
    } catch {
      // What stops the engine is said when the reader's run comes there.
    } finally {
      ahead?.world.destroy();
    }
    return frames;
  }

  async select(name) {
    const { playing } = this.clock;
    this.clock.pause();
    await super.select(name);
    if (!this.run || this.sceneName !== name) return;
    this.milliseconds = 0;
    this.panel.show(this.run);
    this.grab.attach(this.views[0]);
    this.renderOnce();
    if (playing) this.play();
  }

  advance() {
    try {
      const took = this.run.step();
      this.milliseconds += (took - this.milliseconds) * (this.run.steps < 2 ? 1 : kSmooth);
      this.replay.stepped(took);
    } catch (error) {
      this.pause();
      this.controls.say(`the engine stopped: ${error.message}`);
    }
  }

  stepFrames(count) {
    this.pause();
    for (let i = 0; i < count; ++i) this.advance();
    this.touch();
  }

  /** From the start, with what was changed. */
  reset() {
    this.run.reset();
    this.began();
  }

  /** From the start, with nothing changed. */
  anew() {
    return this.select(this.sceneName);
  }

  /** After something was changed, by which the run may have begun anew. */
  changed() {
    if (this.run.steps === 0) this.began();
    this.panel.refresh();
    this.touch();
  }

  began() {
    this.replay.began();
    this.curvesDrawn = 0;
    this.views[0].scene.shownFrame = -1;
    this.touch();
  }

  seek(time) {
    if (time === this.clock.begin) this.reset();
  }
  frame() {
    return this.run.steps;
  }

  draw() {
    this.widenColours();
    const now = performance.now();
    if (!(now - this.curvesDrawn < kCurvesEvery) || !this.clock.playing) {
      this.curvesDrawn = now;
      this.views[0].curves.build(this.controls.series(), { begin: this.replay.times[0], end: this.clock.end }, null);
    }
    this.grab.update();
    super.draw();
  }

  /** Colours mean numbers up to the largest that was seen. */
  widenColours() {
    const { context, replay } = this,
      ranges = { penetrationRange: 'penetration', forceRange: 'contacts/force', gapRange: 'joints/gap' };
    let grew = false;
    for (const [range, section] of Object.entries(ranges)) {
      const most = replay.sections[section]?.reduce((a, b) => (b > a ? b : a), 0) ?? 0;
      if (!(most > context[range])) continue;
      context[range] = most * kGrows;
      grew = true;
    }
    if (grew) this.applyLayers();
  }
}
