// Finds the replays of the page, builds the viewer into #plumb-viewer and hands it out as window.plumbViewer.
import { apiOf } from './api.js';
import { Library } from './library.js';
import css from './viewer.css';
import { Viewer } from './viewer.js';

function start() {
  const place = document.getElementById('plumb-viewer');
  const scripts = document.querySelectorAll('script.plumb-replay');
  if (!place || window.plumbViewer) return;
  const style = document.createElement('style');
  style.textContent = css;
  document.head.append(style);
  window.plumbViewer = apiOf(new Viewer(place, new Library(scripts)));
}

if (document.readyState === 'loading') document.addEventListener('DOMContentLoaded', start);
else start();
