// Expressions of scene files over the time, as scene/expressions.hpp has them, made into functions. Numbers come out
// as there but for the last digit of sines and the like.

const kFunctions = {
  sin: Math.sin,
  cos: Math.cos,
  tan: Math.tan,
  asin: Math.asin,
  acos: Math.acos,
  atan: Math.atan,
  atan2: Math.atan2,
  sinh: Math.sinh,
  cosh: Math.cosh,
  tanh: Math.tanh,
  asinh: Math.asinh,
  acosh: Math.acosh,
  atanh: Math.atanh,
  sqrt: Math.sqrt,
  exp: Math.exp,
  ln: Math.log,
  log: Math.log,
  log2: Math.log2,
  log10: Math.log10,
  abs: Math.abs,
  min: Math.min,
  max: Math.max,
  sign: Math.sign,
  floor: Math.floor,
  ceil: Math.ceil,
  rint: (x) => (Math.abs(x % 1) === 0.5 ? 2 * Math.round(x / 2) : Math.round(x)),
  round: (x) => Math.sign(x) * Math.round(Math.abs(x)),
  mod: (a, b) => a - b * Math.floor(a / b),
  deg: (x) => (x * Math.PI) / 180,
  sum: (...all) => all.reduce((a, b) => a + b, 0),
  avg: (...all) => all.reduce((a, b) => a + b, 0) / all.length,
};
const kConstants = { pi: Math.PI, _pi: Math.PI, _e: Math.E };
const kToken =
  /\s*(\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?|[A-Za-z_]\w*|<=|>=|==|!=|&&|\|\||[-+*/^()?:,<>])/y;
const kLevels = [['||'], ['&&'], ['==', '!=', '<', '>', '<=', '>='], ['+', '-'], ['*', '/']];
const kOperators = {
  '||': (a, b) => (a || b ? 1 : 0),
  '&&': (a, b) => (a && b ? 1 : 0),
  '==': (a, b) => (a === b ? 1 : 0),
  '!=': (a, b) => (a !== b ? 1 : 0),
  '<': (a, b) => (a < b ? 1 : 0),
  '>': (a, b) => (a > b ? 1 : 0),
  '<=': (a, b) => (a <= b ? 1 : 0),
  '>=': (a, b) => (a >= b ? 1 : 0),
  '+': (a, b) => a + b,
  '-': (a, b) => a - b,
  '*': (a, b) => a * b,
  '/': (a, b) => a / b,
};

function tokensOf(text) {
  const tokens = [];
  kToken.lastIndex = 0;
  for (let end = 0; text.slice(end).trim() !== ''; end = kToken.lastIndex) {
    const found = kToken.exec(text);
    if (!found) throw new Error(`"${text}" is not an expression from "${text.slice(end).trim()}" on`);
    tokens.push(found[1]);
  }
  return tokens;
}

/** A function of the time; names: what the expression may use besides t. */
export function expression(text, names) {
  const tokens = tokensOf(text);
  let at = 0;
  const take = (token) => {
    if (tokens[at] !== token) return false;
    ++at;
    return true;
  };
  const need = (token) => {
    if (!take(token)) throw new Error(`"${text}" lacks a "${token}"`);
  };
  const choice = () => {
    const condition = binary(0);
    if (!take('?')) return condition;
    const yes = choice();
    need(':');
    const no = choice();
    return (t) => (condition(t) ? yes(t) : no(t));
  };
  const binary = (level) => {
    if (level === kLevels.length) return unary();
    let left = binary(level + 1);
    while (kLevels[level].includes(tokens[at])) {
      const apply = kOperators[tokens[at++]],
        a = left,
        b = binary(level + 1);
      left = (t) => apply(a(t), b(t));
    }
    return left;
  };
  const unary = () => {
    if (take('+')) return unary();
    if (!take('-')) return power();
    const value = unary();
    return (t) => -value(t);
  };
  /** Binds closer than a sign before it, and to the right. */
  const power = () => {
    const base = atom();
    if (!take('^')) return base;
    const exponent = unary();
    return (t) => Math.pow(base(t), exponent(t));
  };
  const atom = () => {
    if (take('(')) {
      const inner = choice();
      need(')');
      return inner;
    }
    const token = tokens[at++];
    if (/^[\d.]/.test(token ?? '')) {
      const number = Number(token);
      return () => number;
    }
    if (token === 't') return (t) => t;
    if (Object.hasOwn(names, token)) return () => names[token];
    if (Object.hasOwn(kConstants, token)) return () => kConstants[token];
    if (!Object.hasOwn(kFunctions, token)) throw new Error(`"${text}" uses "${token}", which a page does not know`);
    need('(');
    const given = [choice()];
    while (take(',')) given.push(choice());
    need(')');
    return (t) => kFunctions[token](...given.map((one) => one(t)));
  };
  const whole = choice();
  if (at < tokens.length) throw new Error(`"${text}" is not an expression from "${tokens[at]}" on`);
  return whole;
}
