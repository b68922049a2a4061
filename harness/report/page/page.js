(function () {
  'use strict';
  var root = document.documentElement;
  var all = function (what, where) { return Array.prototype.slice.call((where || document).querySelectorAll(what)); };
  var make = function (tag, text, className) {
    var element = document.createElement(tag);
    if (text !== undefined && text !== null) element.textContent = text;
    if (className) element.className = className;
    return element;
  };

  // Numbers as the rest of the page writes them.
  function short(value, digits) {
    if (value === null || value === undefined) return '\u2013';
    if (typeof value !== 'number') return String(value);
    if (value === 0) return '0';
    var text = value.toExponential((digits || 3) - 1), exponent = Number(text.slice(text.indexOf('e') + 1));
    if (exponent < -3 || exponent >= 6) return text.replace(/\.?0*e\+?/, 'e');
    return value.toFixed(Math.max(0, (digits || 3) - 1 - exponent));
  }

  function limit(value) {
    var text = short(value);
    return /e/.test(text) || text.indexOf('.') < 0 ? text : text.replace(/\.?0+$/, '');
  }

  // ---- details of a run ----
  function table(head, rows, className) {
    var t = make('table', null, className);
    if (head) {
      var line = t.createTHead().insertRow();
      head.forEach(function (h) { line.appendChild(make('th', h)); });
    }
    var body = t.createTBody();
    rows.forEach(function (row) {
      var line = body.insertRow();
      row.cells.forEach(function (text) { line.appendChild(make('td', text)); });
      if (row.className) line.className = row.className;
      if (row.chip) {
        var last = line.lastChild;
        last.textContent = '';
        last.appendChild(make('span', row.chip, 'chip ' + row.chip));
      }
    });
    return t;
  }
  function pane(title, content, className) {
    var div = make('div', null, className);
    div.appendChild(make('h4', title));
    div.appendChild(content);
    return div;
  }
  function pairs(object, changed) {
    return table(null, Object.keys(object).map(function (name) {
      var value = object[name];
      return { cells: [name, typeof value === 'object' ? JSON.stringify(value) : String(value)],
               className: changed && changed.indexOf(name) >= 0 ? 'changed' : '' };
    }));
  }
  // Each machine has its own.
  function dataOf(element) {
    var machine = element.closest('.machine');
    if (!machine.plumbData) {
      var script = machine.querySelector('script.data');
      machine.plumbData = JSON.parse(script.textContent);
      machine.plumbData.first = Number(script.dataset.first);
    }
    return machine.plumbData;
  }
  function detailsOf(index) {
    var data = dataOf(document.getElementById('r' + index)), row = data.rows[index - data.first], panes = make('div', null, 'panes');
    panes.appendChild(pane('Run it again', make('code', row.c), 'whole'));
    if (row.o) panes.appendChild(pane('Contended: its times stand in no diagram', make('div', row.o), 'whole'));
    if (row.w) panes.appendChild(pane('Reason', make('div', row.w), 'whole'));
    if (row.m.length) {
      panes.appendChild(pane('Metrics', table(['metric', 'value', 'unit', 'truth', 'error', 'without known bias', 'threshold', 'gold', ''],
        row.m.map(function (m) {
          var of = data.metrics[m[0]];  // name, unit, truth, threshold, gold, note
          return { cells: [of[5] ? of[0] + ' (' + of[5] + ')' : of[0], short(m[1], 7), of[1], short(of[2], 7), short(m[2]), short(m[3]), limit(of[3]), limit(of[4]), ''], chip: m[4] };
        })), 'whole'));
    }
    var t = row.t, n = row.n, facts = [
      ['ms per step, median', short(t[0])], ['fastest to slowest', short(t[1]) + ' to ' + short(t[2])], ['99th percentile', short(t[3])],
      ['95 % interval', row.b ? short(row.b[0]) + ' to ' + short(row.b[1]) : null], ['set-up, ms', short(t[4])], ['steps', t[5]], ['timed steps', t[6] === null ? null : t[6] + ' to ' + t[7]]];
    row.p.forEach(function (p) { facts.push(['phase ' + p[0] + ', ms', short(p[1])]); });
    facts.push(['bodies', n[0]], ['most contacts', n[1]], ['dropped contacts', n[2]], ['bodies not finite', n[3]], ['peak memory, MB', short(n[4])], ['state hash', row.h], ['ran', row.a]);
    panes.appendChild(pane('Times and counts', table(null, facts.filter(function (f) { return f[1] !== null && f[1] !== ''; }).map(function (f) { return { cells: f }; }))));
    panes.appendChild(pane('Settings in force' + (row.d.length ? ' (changed ones bold)' : ''), pairs(data.settings[row.s], row.d)));
    panes.appendChild(pane('Machine', pairs(data.machines[row.x])));
    return panes;
  }
  function close(tr) {
    if (!tr.classList.contains('open')) return;
    tr.classList.remove('open');
    tr.parentNode.removeChild(tr.nextSibling);
  }
  function open(tr) {
    if (tr.classList.contains('open')) return;
    var line = make('tr', null, 'details'), cell = make('td');
    cell.colSpan = tr.cells.length;
    cell.appendChild(detailsOf(Number(tr.id.slice(1))));
    line.appendChild(cell);
    tr.parentNode.insertBefore(line, tr.nextSibling);
    tr.classList.add('open');
  }
  document.addEventListener('click', function (event) {
    var tr = event.target.closest && event.target.closest('.runs tbody > tr[id]');
    if (tr) tr.classList.contains('open') ? close(tr) : open(tr);
  });

  // ---- figures lead to their runs ----
  function follow() {
    var id = /^#(r\d+)/.exec(location.hash), tr = id && document.getElementById(id[1]);
    if (!tr) return;
    var machine = tr.closest('.machine');
    if (machine.hidden) choose(all('.machine').indexOf(machine));
    if (tr.hidden || tr.offsetParent === null) {
      document.getElementById('filter').value = document.getElementById('group').value = '';
      all('input[data-backend]').forEach(function (box) { box.checked = true; });
      hideBackends();
      filter();
    }
    open(tr);
    tr.scrollIntoView({ block: 'start' });
  }
  window.addEventListener('hashchange', follow);

  // ---- filter, groups, backends ----
  function label() {
    // The cell that names a problem stands in the first line that is shown, beside all of them.
    all('.costs tbody').forEach(function (body) {
      var name = body.querySelector('.label');
      var shown = Array.prototype.filter.call(body.rows, function (row) {
        var backend = /\be(\d+)\b/.exec(row.className);
        return !backend || !root.classList.contains('hide' + backend[1]);
      });
      if (!shown.length) return;
      name.rowSpan = shown.length;
      shown[0].insertBefore(name, shown[0].firstChild);
    });
  }
  function hideBackends() {
    all('input[data-backend]').forEach(function (box) { root.classList.toggle('hide' + box.dataset.backend, !box.checked); });
    label();
  }
  function filter() {
    var words = document.getElementById('filter').value.toLowerCase().split(/[\s,]+/).filter(Boolean), group = document.getElementById('group').value.toLowerCase();
    all('.runs tr.open').forEach(close);
    all('[data-k]').forEach(function (element) {
      var key = element.dataset.k + ' ';
      element.hidden = !(words.every(function (word) { return key.indexOf(word) >= 0; }) && (!group || key.indexOf(' ' + group + ' ') >= 0));
    });
    all('details.group').forEach(function (details) {
      details.hidden = !details.querySelector('[data-k]:not([hidden])');
    });
  }
  var pending = 0;
  document.getElementById('filter').addEventListener('input', function () { clearTimeout(pending); pending = setTimeout(filter, 120); });
  document.getElementById('group').addEventListener('change', filter);
  all('input[data-backend]').forEach(function (box) { box.addEventListener('change', hideBackends); });

  // ---- what a diagram shows, among all runs ----
  document.addEventListener('click', function (event) {
    var link = event.target.closest && event.target.closest('[data-show]');
    if (!link) return;
    event.preventDefault();
    document.getElementById('filter').value = link.dataset.show;
    document.getElementById('group').value = '';
    filter();
    document.querySelector(link.getAttribute('href')).scrollIntoView();
  });

  // ---- who is beaten by whom ----
  function name(index) {
    var row = document.getElementById('r' + index), link = make('a', row.cells[1].textContent + ' ' + row.cells[2].textContent);
    link.href = '#r' + index;
    return link;
  }
  document.addEventListener('toggle', function (event) {
    var details = event.target;
    if (!details.open || !details.dataset || !details.dataset.beaten || details.querySelector('ul')) return;
    var list = make('ul');
    details.dataset.beaten.split(';').forEach(function (text) {
      var parts = text.split(','), item = make('li');
      item.appendChild(name(parts[0]));
      item.appendChild(document.createTextNode(', ' + (parts[2] === '1.00' ? 'as dear as ' : parts[2] + '\u00d7 as dear as ')));
      item.appendChild(name(parts[1]));
      list.appendChild(item);
    });
    details.appendChild(list);
  }, true);

  // ---- sorting ----
  var collator = new Intl.Collator(undefined, { numeric: true });
  function makeSortable(sorted) {
    all('th[data-sort]', sorted).forEach(function (head) {
      head.addEventListener('click', function () {
        var up = head.getAttribute('aria-sort') !== 'ascending', column = head.cellIndex, body = sorted.tBodies[0];
        all('tr.open', body).forEach(close);
        all('th[data-sort]', sorted).forEach(function (other) { other.removeAttribute('aria-sort'); });
        head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
        var keyed = all('tr', body).map(function (row) {
          var cell = row.cells[column], value = cell.dataset.v;
          return { row: row, number: value === undefined ? NaN : Number(value), text: cell.textContent };
        });
        keyed.sort(function (a, b) {
          var missing = isNaN(a.number) - isNaN(b.number);
          if (missing) return missing;  // what has no number stays below, up or down
          var order = isNaN(a.number) ? collator.compare(a.text, b.text) : a.number - b.number;
          return up ? order : -order;
        });
        keyed.forEach(function (k) { body.appendChild(k.row); });
      });
    });
  }

  // ---- machines: one at a time ----
  function choose(index) {
    all('.machine').forEach(function (machine, i) { machine.hidden = i !== index; });
    all('.links a').forEach(function (link) {
      var at = link.getAttribute('href').replace(/-\d+$/, '') + (index ? '-' + index : '');
      link.hidden = !document.querySelector(at);
      if (!link.hidden) link.href = at;
    });
    document.getElementById('machine').value = String(index);
  }
  var machines = document.getElementById('machine');
  if (machines) {
    machines.addEventListener('change', function () { choose(Number(machines.value)); });
    choose(0);  // before the rest is unpacked, so that the others do not flash
  }

  // ---- theme ----
  document.getElementById('theme').addEventListener('click', function () {
    var dark = root.dataset.theme ? root.dataset.theme === 'dark' : window.matchMedia('(prefers-color-scheme: dark)').matches;
    root.dataset.theme = dark ? 'light' : 'dark';
    try { localStorage.setItem('plumb-theme', root.dataset.theme); } catch (refused) { return; }
  });

  // ---- what is packed: base64, zlib ----
  function unpack(script) {
    var bytes = Uint8Array.from(atob(script.textContent), function (c) { return c.charCodeAt(0); });
    var html = new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'))).text();
    return html.then(function (text) { script.outerHTML = text; });
  }
  function start() {
    all('.sortable').forEach(makeSortable);
    if (machines) choose(Number(machines.value));
    root.dataset.unpacked = '';
    var place = /^#[\w-]+$/.test(location.hash) && document.querySelector(location.hash);
    if (place) place.scrollIntoView();
    follow();
  }
  Promise.all(all('script.packed').map(unpack)).then(start, function (error) {
    document.querySelector('main').prepend(make('p', 'The tables and diagrams cannot be unpacked: ' + error.message, 'about'));
  });
})();
