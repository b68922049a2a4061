// Numbers as the rest of the page writes them.

export function short(value, digits = 3) {
  if (value === null || value === undefined) return '\u2013';
  if (typeof value !== 'number') return String(value);
  if (value === 0) return '0';
  const text = value.toExponential(digits - 1),
    exponent = Number(text.slice(text.indexOf('e') + 1));
  if (exponent < -3 || exponent >= 6) return text.replace(/\.?0*e\+?/, 'e');
  return value.toFixed(Math.max(0, digits - 1 - exponent));
}

/** A number that somebody chose: 0.01, not 0.0100. */
export function limit(value) {
  const text = short(value);
  return /e/.test(text) || !text.includes('.') ? text : text.replace(/\.?0+$/, '');
}

const kRaised = { '-': '\u207b', ...Object.fromEntries([...'\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079'].map((c, i) => [i, c])) };

/** A tick's label: 0.01, 1, 100, 10⁻⁶. */
export function tickLabel(value) {
  if (value === 0) return '0';
  const exponent = Math.floor(Math.log10(Math.abs(value)) + 1e-9),
    mantissa = Number((value / 10 ** exponent).toPrecision(6));
  if (exponent >= -3 && exponent <= 4) return String(Number(value.toPrecision(6)));
  const power = `10${[...String(exponent)].map((c) => kRaised[c]).join('')}`;
  return mantissa === 1 ? power : `${mantissa}\u00d7${power}`;
}
