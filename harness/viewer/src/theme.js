// The page's colours as the scenes need them, read from its style sheet whenever the theme changes.
import { Color } from 'three';

function variable(style, name, otherwise) {
  return style.getPropertyValue(name).trim() || otherwise;
}

export function readTheme(element) {
  const style = getComputedStyle(element);
  const paper = new Color(variable(style, '--paper', '#ffffff')),
    ink = new Color(variable(style, '--ink', '#1b1d20'));
  const dark = paper.getHSL({}).l < 0.5;
  return {
    dark,
    background: new Color(dark ? '#16181c' : '#f1f2f3'),
    horizon: new Color(dark ? '#16181c' : '#f1f2f3'),
    ground: new Color(dark ? '#272a30' : '#e9eaec'),
    gridLine: new Color(dark ? '#444a53' : '#c3c7cd'),
    edge: new Color(dark ? '#0b0c0e' : '#2a2522'),
    ink,
    mark: new Color(dark ? '#ffffff' : '#111111'),
    sky: dark ? 1.75 : 1.75,
    sun: dark ? 2 : 1.75,
  };
}

/** Calls back when the reader or the system changes between light and dark. */
export function watchTheme(callback) {
  new MutationObserver(callback).observe(document.documentElement, {
    attributes: true,
    attributeFilter: ['data-theme', 'class'],
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', callback);
}
