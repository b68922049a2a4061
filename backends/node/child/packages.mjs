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

/** Where a build of ours has put a package: written, by name, where this file was copied by a build. */
function built(name) {
  const noted = join(here, 'built.json');
  return existsSync(noted) ? JSON.parse(readFileSync(noted, 'utf8'))[name] : undefined;
}

function find(name) {
  const places = [...folders().map((folder) => join(folder, name)), built(name)];
  return places.find((place) => place !== undefined && existsSync(join(place, 'package.json'))) ?? null;
}

const remedyOf = (name) => `npm's package ${name} is not installed: ./dev deps field does it in a checkout, npm ci --prefix ${here} elsewhere; ` +
  'or set PLUMB_NODE_MODULES to the node_modules that has it';

/** Why a package cannot be used, or "". */
export function missing(name, remedy = remedyOf(name)) {
  return find(name) === null ? remedy : '';
}

export function versionOf(name) {
  const folder = find(name);
  return folder === null ? '' : JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')).version;
}

/** The path of a file of a package. */
export function fileOf(name, path, remedy) {
  const folder = find(name);
  if (folder === null) throw new Failure(-3, missing(name, remedy));
  return join(folder, path);
}

/** Imports a module of a package by its path inside, "dist/index.js". */
export const load = (name, path, remedy) => import(pathToFileURL(fileOf(name, path, remedy)).href);
