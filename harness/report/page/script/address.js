// The address says where the reader is, what the filter leaves and which sections are folded:
// #runs&filter=D1+gold&group=stacking&hide=ode&folded=cost.

const kKeys = ['filter', 'group', 'result', 'hide', 'folded', 'machine', 'theme'];

/** {place, filter, group, result, hide, folded, machine, theme}, each "" where the address has none. */
export function readAddress(hash = location.hash) {
  const parts = hash.replace(/^#/, '').split('&'),
    place = parts[0].includes('=') ? '' : parts.shift(),
    said = new URLSearchParams(parts.join('&'));
  return { place, ...Object.fromEntries(kKeys.map((key) => [key, said.get(key) ?? ''])) };
}

export function addressOf(state) {
  const said = new URLSearchParams();
  for (const key of kKeys) if (state[key]) said.set(key, state[key]);
  return `#${[state.place, said.toString()].filter(Boolean).join('&')}`;
}

/** Takes over what is given and keeps the rest. A new place is a step that one can go back from; a filter is not. */
export function changeAddress(changes) {
  const before = readAddress(),
    hash = addressOf({ ...before, ...changes });
  if (hash === (location.hash || '#')) return;
  if (changes.place && changes.place !== before.place) history.pushState(null, '', hash);
  else history.replaceState(null, '', hash);
}
