// The time that is shown: plays, loops, stops at the end. Seconds of the scene, not of the wall.

export const kSpeeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 4];

export class Clock {
  constructor() {
    this.begin = 0;
    this.end = 0;
    this.time = 0;
    this.speed = 1;
    this.loop = true;
    this.playing = false;
  }

  setRange(begin, end) {
    this.begin = begin;
    this.end = end;
    this.time = begin;
  }

  seek(time) {
    this.time = Math.min(Math.max(time, this.begin), this.end);
  }

  play() {
    if (this.time >= this.end) this.time = this.begin;
    this.playing = this.end > this.begin;
  }

  pause() {
    this.playing = false;
  }

  /** Goes on by so many seconds of the wall; true where the time has changed. */
  tick(seconds) {
    if (!this.playing) return false;
    const length = this.end - this.begin;
    this.time += seconds * this.speed;
    if (this.time >= this.end) {
      // A moment's rest at the end, so that a loop does not cut off what came out.
      if (this.loop && this.time >= this.end + Math.min(0.6 * this.speed, length)) this.time = this.begin;
      else if (!this.loop) {
        this.time = this.end;
        this.playing = false;
      }
    }
    return true;
  }

  /** The time to show, during the rest at the end, too. */
  get shown() {
    return Math.min(this.time, this.end);
  }
}
