// What a live run was measured at over its time: columns that grow, thinned where they grow long.

const kMost = 4000; // rows: beyond, every second of them goes

export class History {
  constructor(names) {
    this.names = names;
    this.columns = Object.fromEntries(['time', ...names].map((name) => [name, new Float64Array(kMost)]));
    this.clear();
  }

  clear() {
    this.rows = 0;
    this.stride = 1;
    this.skipped = 0;
  }

  /** Takes every so many; the last is the row of the last call in any case. */
  add(row) {
    if (this.skipped > 0) --this.rows;
    this.skipped = (this.skipped + 1) % this.stride;
    if (this.rows === kMost) this.thin();
    for (const [name, column] of Object.entries(this.columns)) column[this.rows] = row[name];
    ++this.rows;
  }

  thin() {
    for (const column of Object.values(this.columns)) for (let i = 0; 2 * i < kMost; ++i) column[i] = column[2 * i];
    this.rows = kMost / 2;
    this.stride *= 2;
  }

  of(name) {
    return this.columns[name].subarray(0, this.rows);
  }
}
