// Numbers as people read them: three digits and a unit with its prefix.

const kPrefixes = [
  [1e9, 'G'],
  [1e6, 'M'],
  [1e3, 'k'],
  [1, ''],
  [1e-3, 'm'],
  [1e-6, '\u00b5'],
  [1e-9, 'n'],
  [1e-12, 'p'],
];

export function digits(value, count = 3) {
  if (value === 0) return '0';
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'no number' : value > 0 ? '\u221e' : '\u2212\u221e';
  const rounded = value.toExponential(count - 1),
    exponent = Number(rounded.slice(rounded.indexOf('e') + 1));
  const text =
    exponent < -3 || exponent >= 6
      ? rounded.replace(/\.?0+e/, 'e').replace('e+', 'e')
      : value.toFixed(Math.min(Math.max(count - 1 - exponent, 0), 8));
  return text.replace('-', '\u2212');
}

/** "1.25 mm", "980 N"; a unit of "" or "1" has no prefix. */
export function quantity(value, unit) {
  if (Number.isNaN(value)) return digits(value);
  if (!unit || unit === '1' || value === 0 || !Number.isFinite(value))
    return `${digits(value)}${unit && unit !== '1' ? ` ${unit}` : ''}`;
  const size = Math.abs(value),
    [scale, prefix] = kPrefixes.find(([least]) => size >= least * 0.9995) ?? kPrefixes[kPrefixes.length - 1];
  return `${digits(value / scale)} ${prefix}${unit}`;
}
