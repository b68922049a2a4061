// What the page carries as data: JSON, deflated, as base64 in a script element. Opened once, when it is first wanted.
import { bytesOfBase64, inflate } from '../../../viewer/src/data/bundle.js';

const kOpened = new WeakMap();

export function unpack(script) {
  if (!kOpened.has(script))
    kOpened.set(
      script,
      inflate(bytesOfBase64(script.textContent)).then((bytes) => {
        script.textContent = '';
        return JSON.parse(new TextDecoder().decode(bytes));
      }),
    );
  return kOpened.get(script);
}
