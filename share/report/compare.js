// The comparison of several runs: sorted tables, chosen curves, paired settings, export as CSV.
(function () {
  'use strict';

  var element = document.getElementById('comparison');
  if (!element) return;
  var data = JSON.parse(element.textContent);

  function all(root, selector) { return Array.prototype.slice.call(root.querySelectorAll(selector)); }

  // ---- tables -----------------------------------------------------------------------------------

  // Numbers by their size, other texts by their letters; cells without a value come last.
  function before(a, b) {
    if (a === '' || b === '') return a === b ? 0 : a === '' ? 1 : -1;
    var x = Number(a), y = Number(b);
    if (!isNaN(x) && !isNaN(y)) return x - y;
    return a < b ? -1 : a > b ? 1 : 0;
  }

  function sort(table, column, header) {
    var down = header.getAttribute('aria-sort') === 'ascending';
    all(table, 'thead th').forEach(function (other) { other.removeAttribute('aria-sort'); });
    header.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    var body = table.tBodies[0];
    var rows = all(body, 'tr').map(function (row, place) {
      return {row: row, place: place, key: row.cells[column].getAttribute('data-key')};
    });
    rows.sort(function (a, b) {
      var order = before(a.key, b.key);
      if (down && a.key !== '' && b.key !== '') order = -order;
      return order || a.place - b.place;
    });
    rows.forEach(function (entry) { body.appendChild(entry.row); });
  }

  all(document, 'table.sortable').forEach(function (table) {
    all(table, 'thead th').forEach(function (header, column) {
      header.querySelector('button').addEventListener('click', function () { sort(table, column, header); });
    });
  });

  // ---- export -----------------------------------------------------------------------------------

  function cell(value) {
    var text = value === null ? '' : String(value);
    return /[",\r\n]/.test(text) ? '"' + text.replace(/"/g, '""') + '"' : text;
  }

  function csv(rows) {
    return rows.map(function (row) { return row.map(cell).join(',') + '\n'; }).join('');
  }

  function save(name, text) {
    var link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], {type: 'text/csv;charset=utf-8'}));
    link.download = name;
    document.body.appendChild(link);
    link.click();
    document.body.removeChild(link);
    setTimeout(function () { URL.revokeObjectURL(link.href); }, 10000);
  }

  all(document, 'button.export').forEach(function (button) {
    var table = button.getAttribute('data-table');
    button.addEventListener('click', function () { save(table + '.csv', csv(data[table])); });
  });

  // ---- curves -----------------------------------------------------------------------------------

  var chooser = document.querySelector('.chooser');
  if (chooser) {
    var most = Number(chooser.getAttribute('data-most'));
    var boxes = all(chooser, 'input'), slots = {};

    var colour = function () {
      var chosen = boxes.filter(function (box) { return box.checked; });
      Object.keys(slots).forEach(function (run) {
        if (!boxes[run].checked) delete slots[run];
      });
      chosen.forEach(function (box) {
        for (var slot = 0; slots[box.value] === undefined && slot < most; ++slot) {
          var taken = Object.keys(slots).some(function (run) { return slots[run] === slot; });
          if (!taken) slots[box.value] = slot;
        }
      });
      boxes.forEach(function (box) {
        var slot = slots[box.value];
        box.disabled = !box.checked && chosen.length >= most;
        box.parentNode.querySelector('i').className = slot === undefined ? 'off' : 'c' + slot;
      });
      all(document, '.plots [data-run]').forEach(function (mark) {
        var slot = slots[mark.getAttribute('data-run')];
        var kind = slot === undefined ? 'off' : 'c' + slot;
        var curve = mark.tagName.toLowerCase() === 'path';
        mark.setAttribute('class', curve ? 'curve ' + kind : kind);
        if (!curve) mark.parentNode.hidden = slot === undefined;
      });
    };
    chooser.addEventListener('change', colour);
    colour();
  }

  // ---- pairs ------------------------------------------------------------------------------------

  var pairs = document.getElementById('pairs');
  if (pairs) {
    var first = document.querySelector('select.first'), second = document.querySelector('select.second');

    // The texts are those of the smaller setting first; the other way round, the signs change.
    var swapped = function (text) {
      if (text === '-' || Number(text) === 0) return text;
      return text.charAt(0) === '-' ? text.slice(1) : '-' + text;
    };
    var turned = function (row) {
      var ends = row[5].split(' to '), signs = row[7].split(' / ');
      return [row[0], row[1], row[3], row[2], swapped(row[4]), swapped(ends[1]) + ' to ' + swapped(ends[0]),
        row[6], signs[1] + ' / ' + signs[0] + ' / ' + signs[2], row[8]];
    };
    var show = function () {
      var a = Number(first.value), b = Number(second.value);
      var rows = data.pairs[Math.min(a, b) + ',' + Math.max(a, b)] || [];
      var body = pairs.tBodies[0];
      body.textContent = '';
      rows.forEach(function (row) {
        var line = body.insertRow();
        (a > b ? turned(row) : row).forEach(function (text) { line.insertCell().textContent = text; });
      });
      if (rows.length) return;
      var note = body.insertRow().insertCell();
      note.colSpan = 9;
      note.textContent = a === b ? 'Choose two settings.' : 'These two settings have no pairs on this page.';
    };
    first.addEventListener('change', show);
    second.addEventListener('change', show);
    show();
  }
}());
