// Keeps a replay smooth on slow machines: when frames come too late, shadows go first, then fine pixels, then edges.

const kLate = 1 / 22; // s between two frames that are shown while playing
const kPatience = 10; // frames looked at before anything is given up
const kAway = 1; // s: who was away so long has not been slow
export const kLevels = 3;

export class Pace {
  constructor() {
    this.level = 0;
    this.forget();
  }

  forget() {
    this.sum = 0;
    this.count = 0;
  }

  /** Takes the time since the frame before; true where the next level is due. */
  late(seconds) {
    if (seconds > kAway) return false;
    this.sum += seconds;
    if (++this.count < kPatience) return false;
    const slow = this.sum / this.count > kLate;
    this.forget();
    if (!slow || this.level >= kLevels) return false;
    ++this.level;
    return true;
  }
}
