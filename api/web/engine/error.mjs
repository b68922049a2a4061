export const INVALID = -1;

/** A failed call. code: PlumbResult, below 0. */
export class PlumbError extends Error {
  constructor(code, text) {
    super(text);
    this.name = 'PlumbError';
    this.code = code;
  }
}
