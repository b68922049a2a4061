/** Throw it to answer a call with a result of plumb.h: -3 unsupported, -1 invalid argument. */
export class Failure extends Error {
  constructor(result, text) {
    super(text);
    this.result = result;
  }
}
