// The filter: words, a group, a result and the engines that are switched on. It lives in the address.
import { changeAddress, readAddress } from './address.js';

const field = (id) => document.getElementById(id);

export class Filter {
  constructor() {
    this.boxes = [...document.querySelectorAll('input[data-backend]')];
    this.listeners = new Set();
    let pending = 0;
    field('filter').addEventListener('input', () => {
      clearTimeout(pending);
      pending = setTimeout(() => this.write(), 120);
    });
    for (const control of [field('group'), field('result'), ...this.boxes])
      control.addEventListener('change', () => this.write());
    field('clear').addEventListener('click', () => this.set({}));
    this.read();
  }

  /** Calls back when something else is to be shown. */
  watch(listener) {
    this.listeners.add(listener);
  }

  /** Words, group, result and names of engines that are off; what is not given is "all". */
  set({ filter = '', group = '', result = '', hide = '' }) {
    const off = hide.split(',');
    field('filter').value = filter;
    field('group').value = group;
    field('result').value = result;
    for (const box of this.boxes) box.checked = !off.includes(box.value);
    this.write();
  }

  read() {
    this.set(readAddress());
  }

  write() {
    const words = field('filter').value,
      off = this.boxes.filter((box) => !box.checked);
    this.words = words.toLowerCase().split(/[\s,]+/).filter(Boolean);
    this.group = field('group').value;
    this.result = field('result').value;
    this.hidden = new Set(off.map((box) => Number(box.dataset.backend)));
    for (const box of this.boxes) document.documentElement.classList.toggle(`hide${box.dataset.backend}`, !box.checked);
    const hide = off.map((box) => box.value).join(',');
    changeAddress({ filter: words, group: this.group, result: this.result, hide });
    const said = [words, this.group, this.result, off.length ? `without ${off.map((box) => box.value).join(', ')}` : ''];
    document.querySelector('.filter summary').textContent = ['Filter', said.filter(Boolean).join('; ')].filter(Boolean).join(': ');
    document.querySelector('.filter').classList.toggle('active', said.some(Boolean));
    for (const listener of this.listeners) listener();
  }

  /** What the filter leaves: items have a key k, an engine e and a verdict, or not. */
  passes({ k, e, verdict }) {
    if (e !== undefined && this.hidden.has(e)) return false;
    if (verdict && this.result && verdict !== this.result) return false;
    if (k === undefined) return true;
    const key = ` ${k} `;
    return this.words.every((word) => key.includes(word)) && (!this.group || key.includes(` ${this.group} `));
  }
}
