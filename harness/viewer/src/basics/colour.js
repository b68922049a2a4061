// Colours that mean something: maps whose equal steps look equal (arcs of equal length in OKLab) and colours for kinds.
// OKLab: B. Ottosson, "A perceptual color space for image processing", 2020.

export function oklabToLinear(l, a, b) {
  const x = (l + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const y = (l - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const z = (l - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    4.0767416621 * x - 3.3077115913 * y + 0.2309699292 * z,
    -1.2684380046 * x + 2.6097574011 * y - 0.3413193965 * z,
    -0.0041960863 * x - 0.7034186147 * y + 1.707614701 * z,
  ].map((v) => Math.min(Math.max(v, 0), 1));
}

export function oklch(l, chroma, degrees) {
  const angle = (degrees * Math.PI) / 180;
  return oklabToLinear(l, chroma * Math.cos(angle), chroma * Math.sin(angle));
}

const toByte = (v) => Math.round(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055));
export const cssColour = (linear) => `rgb(${linear.map(toByte).join(' ')})`;

const kSteps = 256;

/** A map through the given OKLCH points, sampled at equal arc lengths in OKLab. */
export class ColourMap {
  constructor(points) {
    const fine = [];
    for (let i = 0; i + 1 < points.length; ++i) {
      for (let j = 0; j < 64; ++j) {
        const t = j / 64,
          [l, c, h] = points[i].map((from, k) => from + (points[i + 1][k] - from) * t);
        fine.push([l, c * Math.cos((h * Math.PI) / 180), c * Math.sin((h * Math.PI) / 180)]);
      }
    }
    const [l, c, h] = points[points.length - 1];
    fine.push([l, c * Math.cos((h * Math.PI) / 180), c * Math.sin((h * Math.PI) / 180)]);
    const lengths = [0];
    for (let i = 1; i < fine.length; ++i)
      lengths.push(lengths[i - 1] + Math.hypot(...fine[i].map((v, k) => v - fine[i - 1][k])));
    this.lab = new Float32Array(kSteps * 3);
    this.linear = new Float32Array(kSteps * 3);
    for (let i = 0, at = 0; i < kSteps; ++i) {
      const wanted = (lengths[lengths.length - 1] * i) / (kSteps - 1);
      while (at + 2 < lengths.length && lengths[at + 1] < wanted) ++at;
      const t = (wanted - lengths[at]) / (lengths[at + 1] - lengths[at]);
      const lab = fine[at].map((from, k) => from + (fine[at + 1][k] - from) * t);
      this.lab.set(lab, i * 3);
      this.linear.set(oklabToLinear(...lab), i * 3);
    }
  }

  /** Writes linear red, green, blue of t in 0..1 to out at offset. */
  write(t, out, offset) {
    const i = Math.round(Math.min(Math.max(t, 0), 1) * (kSteps - 1)) * 3;
    out[offset] = this.linear[i];
    out[offset + 1] = this.linear[i + 1];
    out[offset + 2] = this.linear[i + 2];
  }

  css(t) {
    const out = [0, 0, 0];
    this.write(t, out, 0);
    return cssColour(out);
  }

  gradient() {
    return `linear-gradient(to right, ${Array.from({ length: 17 }, (_, i) => this.css(i / 16)).join(', ')})`;
  }
}

/** Overlap: from deep blue over green to yellow. */
export const penetrationMap = new ColourMap([
  [0.4, 0.1, 285],
  [0.52, 0.115, 245],
  [0.63, 0.115, 190],
  [0.76, 0.16, 140],
  [0.93, 0.17, 103],
]);
/** Force: from black-violet over red to pale gold. */
export const forceMap = new ColourMap([
  [0.36, 0.1, 300],
  [0.47, 0.16, 335],
  [0.58, 0.2, 380],
  [0.74, 0.16, 412],
  [0.93, 0.09, 452],
]);

/** Gap of a joint: from blue over violet and red to bright amber. */
export const gapMap = new ColourMap([
  [0.5, 0.11, 250],
  [0.54, 0.17, 310],
  [0.62, 0.22, 380],
  [0.72, 0.18, 410],
  [0.88, 0.16, 450],
]);

/** The n-th of any number of kinds: hues by the golden angle, so that neighbours differ. */
export function kindColour(n, lightness = 0.7, chroma = 0.135) {
  return oklch(lightness, chroma, (n * 137.50776 + 25) % 360);
}

/** Bodies in their order along the scene, t in 0..1: warm sand over coral and plum to sea green. */
const bodyMap = new ColourMap([
  [0.83, 0.1, 88],
  [0.75, 0.135, 52],
  [0.68, 0.14, 22],
  [0.63, 0.12, -25],
  [0.62, 0.11, -75],
  [0.66, 0.1, -125],
  [0.76, 0.1, -180],
]);
export function writeBodyColour(t, shade, out, offset) {
  bodyMap.write(t, out, offset);
  for (let i = 0; i < 3; ++i) out[offset + i] = Math.min(out[offset + i] * shade, 1);
}
