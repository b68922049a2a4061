// The time of a run: it goes on as the engine steps, as fast as the wall's or as the engine can.

const kMostWork = 0.025; // s of a picture that steps may take: beyond, the run goes slower than it should

export class LiveClock {
  /** viewer: its run, and advance(), which takes one step. */
  constructor(viewer) {
    this.viewer = viewer;
    this.speed = 1;
    this.playing = false;
    this.loop = false;
    this.begin = 0;
    this.owed = 0; // s of the scene
    this.late = false;
  }

  /** The run says what time it is. */
  setRange() {}
  seek() {}

  get shown() {
    return this.viewer.run?.time ?? 0;
  }
  get end() {
    return this.shown;
  }

  play() {
    this.playing = true;
    this.owed = 0;
  }
  pause() {
    this.playing = false;
  }

  /** Goes on by so many seconds of the wall; true where a step was taken. */
  tick(seconds) {
    if (!this.playing) return false;
    this.owed += seconds * this.speed;
    const begin = performance.now(),
      { dt } = this.viewer.run;
    let steps = 0;
    for (; this.owed >= dt && this.playing; ++steps) {
      if (performance.now() - begin > 1000 * kMostWork) break;
      this.viewer.advance();
      this.owed -= dt;
    }
    this.late = this.owed >= dt;
    if (this.late) this.owed = 0;
    return steps > 0;
  }
}
