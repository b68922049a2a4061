// Where npm put an engine's package, and of which version it is. Nothing of it runs by being found.
import { readFileSync, existsSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { Failure } from './failure.mjs';

const here = dirname(fileURLToPath(import.meta.url));

/** Folders that may hold packages: the one that the environment names, then beside this file, then the source's. */
function folders() {
  const given = process.env.PLUMB_NODE_MODULES;
  const noted = join(here, 'node_modules.txt');  // written where this file was copied by a build
  return [...(given ? [given] : []), join(here, 'node_modules'), join(here, '..', 'node_modules'),
    ...(existsSync(noted) ? [readFileSync(noted, 'utf8').trim()] : [])];
}

function find(name) {
  for (const folder of folders()) if (existsSync(join(folder, name, 'package.json'))) return join(folder, name);
  return null;
}

/** Why a package cannot be used, or "". */
export function missing(name) {
  if (find(name) !== null) return '';
  return `npm's package ${name} is not installed: ./dev deps field does it in a checkout, npm ci --prefix ${here} elsewhere; ` +
    'or set PLUMB_NODE_MODULES to the node_modules that has it';
}

export function versionOf(name) {
  const folder = find(name);
  return folder === null ? '' : JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')).version;
}

/** The path of a file of a package. */
export function fileOf(name, path) {
  const folder = find(name);
  if (folder === null) throw new Failure(-3, missing(name));
  return join(folder, path);
}

/** Imports a module of a package by its path inside, "dist/index.js". */
export const load = (name, path) => import(pathToFileURL(fileOf(name, path)).href);
