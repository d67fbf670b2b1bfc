'use strict';
// Draws the charts of a report from the columns that are embedded in the page. Everything is also
// legible without colour: markers, dashes and lightness tell the parts of a chart apart.
(() => {
  const charts = JSON.parse(document.getElementById('report-data').textContent).charts;
  for (const chart of charts) {
    // The same name row after row is written once, with how often.
    chart.columns[0].values = chart.columns[0].values.flatMap(([name, times]) => Array(times).fill(name));
  }
  const library = document.createElement('script');
  library.textContent = inflatedText(document.getElementById('packed-plotly').textContent);
  document.head.append(library);
  const chartNamed = new Map(charts.map((chart) => [chart.name, chart]));
  const kInk = '#1a1a1a', kSoft = '#6b6b6b', kMark = '#0b4a80', kRule = '#dddddd';
  const kDashes = ['solid', 'dash', 'dot', 'dashdot', 'longdash', '8px,3px,2px,3px,2px,3px'];
  const kSymbols = ['circle', 'square', 'triangle-up', 'diamond-open', 'circle-open', 'cross', 'x', 'star'];
  const kTones = ['#1a1a1a', '#0b4a80', '#7a7a7a', '#3f6fa3', '#4d4d4d', '#999999'];
  const kConfig = {
    displaylogo: false, showSendToCloud: false, plotlyServerURL: '', responsive: false,
    modeBarButtonsToRemove: ['lasso2d', 'select2d', 'autoScale2d'], displayModeBar: 'hover',
  };

  // Plotly reads some markup in texts: names are shown as they are.
  const plain = (text) => String(text).replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;');
  const short = (text, most) => (text.length > most ? text.slice(0, most - 1) + '…' : text);
  // Titles are broken into lines that fit.
  const wrapped = (text, most, mostLines = 2) => {
    const lines = [''];
    for (const word of String(text).split(' ')) {
      const line = lines[lines.length - 1];
      if (line && line.length + word.length >= most) lines.push(word);
      else lines[lines.length - 1] = line ? `${line} ${word}` : word;
    }
    const kept = lines.slice(0, mostLines);
    if (kept.length < lines.length) kept[kept.length - 1] += ' …';
    return kept.map((line) => plain(short(line, most))).join('<br>');
  };

  const rowsOf = (chart, series) => {
    const names = chart.columns[0].values;
    const rows = [];
    for (let row = 0; row < names.length; ++row) if (names[row] === series) rows.push(row);
    return rows;
  };
  const valuesOf = (chart, rows, column) => rows.map((row) => chart.columns[column].values[row]);

  const traceMakers = {
    runs: (s) => [{mode: 'markers', marker: {symbol: 'circle-open', size: 6, color: kSoft, line: {width: 1}}, x: s.x, y: s.y, ...s.errors}],
    dots: (s) => [{mode: 'markers', marker: {symbol: 'circle', size: 9, color: kInk}, x: s.x, y: s.y, ...s.errors}],
    points: (s) => [{mode: 'lines+markers', marker: {symbol: kSymbols[s.index % kSymbols.length], size: 8, color: kInk},
      line: {color: kInk, width: 1.2, dash: kDashes[s.index % kDashes.length]}, x: s.x, y: s.y, ...s.errors}],
    fit: (s) => [{mode: 'lines', line: {color: kInk, width: 2.6}, x: s.x, y: s.y}],
    band: (s) => [{mode: 'lines', fill: 'toself', fillcolor: 'rgba(0,0,0,.16)', line: {width: 0}, hoverinfo: 'skip',
      x: [...s.x, ...s.x.slice().reverse()], y: [...s.low, ...s.high.slice().reverse()]}],
    scatter: (s) => [s.low, s.high].map((y, k) => ({mode: 'lines', line: {color: kSoft, width: 1.4, dash: 'dot'},
      x: s.x, y, showlegend: k === 0})),
    measured: (s) => [
      {mode: 'lines', fill: 'toself', fillcolor: 'rgba(11,74,128,.16)', line: {width: 0}, hoverinfo: 'skip', showlegend: false,
        x: [...s.x, ...s.x.slice().reverse()], y: [...s.low, ...s.high.slice().reverse()]},
      {mode: 'lines', line: {color: kMark, width: 2.2, dash: 'dash'}, x: s.x, y: s.y}],
    best: (s) => [{mode: 'markers', marker: {symbol: 'diamond', size: 12, color: '#fff', line: {color: kInk, width: 2.5}},
      error_x: {type: 'data', symmetric: false, color: kInk, thickness: 2,
        array: s.high.map((high, k) => (high ?? s.x[k]) - s.x[k]), arrayminus: s.low.map((low, k) => s.x[k] - (low ?? s.x[k]))},
      x: s.x, y: s.y}],
    limit: (s) => [{mode: 'lines', line: {color: kInk, width: 1.4, dash: 'longdashdot'}, x: s.x, y: s.y}],
    line: (s) => [{mode: 'lines+markers', line: {color: kTones[s.index % kTones.length], width: 1.8, dash: kDashes[s.index % kDashes.length]},
      marker: {symbol: kSymbols[s.index % kSymbols.length], size: 8}, x: s.x, y: s.y, ...s.errors}],
  };

  const seriesOf = (chart, layer, index) => {
    const rows = rowsOf(chart, layer.series);
    const column = (number) => (number < chart.columns.length ? valuesOf(chart, rows, number) : rows.map(() => null));
    const s = {index, x: column(1), y: column(2), low: column(3), high: column(4), errors: {}};
    if (s.low.some((value) => value !== null) && ['points', 'line', 'dots', 'runs'].includes(layer.look)) {
      s.errors = {error_y: {type: 'data', symmetric: false, thickness: 1, width: 3, color: kSoft,
        array: s.high.map((high, k) => high - s.y[k]), arrayminus: s.low.map((low, k) => s.y[k] - low)}};
    }
    return s;
  };

  const axis = (title, more) => ({
    title: {text: title, standoff: 8, font: {size: 13}}, automargin: true, gridcolor: kRule, linecolor: kInk, showline: true,
    zeroline: false, ticks: 'outside', ticklen: 4, ...more,
  });
  // A legend in columns as wide as its longest name, and its height below the chart.
  const legendHeight = (chart, width) => {
    const names = chart.layers.map(({series}) => Math.min(42, series.length));
    const columns = Math.max(1, Math.floor((width - 20) / (6.6 * Math.max(...names, 1) + 48)));
    return 20 * Math.ceil(names.length / columns) + 8;
  };
  const hasNames = (chart) => typeof chart.columns[1].values[0] === 'string';
  const kTickNames_px = 110;
  const spaceBelow = (chart, width) => legendHeight(chart, width) + (hasNames(chart) ? kTickNames_px : 52);
  const layoutOf = (chart, width) => {
    const chars = Math.max(18, Math.floor((width - 90) / 7.5));
    return {
      font: {family: getComputedStyle(document.body).fontFamily, size: 13, color: kInk},
      margin: {l: 56, r: 14, t: 30, b: spaceBelow(chart, width)}, paper_bgcolor: '#fff', plot_bgcolor: '#fff',
      legend: {orientation: 'h', yref: 'container', y: 0, yanchor: 'bottom', xref: 'container', x: 0, xanchor: 'left', font: {size: 12}},
      xaxis: axis(wrapped(chart.x_title, chars, 1), {automargin: false}),
      yaxis: axis(wrapped(chart.y_title, width < 500 ? 20 : 26), chart.y_range ? {range: chart.y_range} : {}),
      hovermode: 'closest', dragmode: window.matchMedia('(pointer: coarse)').matches ? false : 'zoom',
    };
  };

  const planeParts = (chart, width) => {
    const traces = chart.layers.flatMap((layer, index) =>
      traceMakers[layer.look](seriesOf(chart, layer, index)).map((trace) => ({
        type: 'scatter', name: plain(short(layer.series, 42)), cliponaxis: false, ...trace})));
    const layout = layoutOf(chart, width);
    layout.showlegend = true;
    if (hasNames(chart)) {
      layout.xaxis.tickangle = width < 500 ? -90 : -30;
      layout.xaxis.tickvals = [...new Set(chart.columns[1].values)];
      Object.assign(layout.xaxis, {categoryorder: 'array', categoryarray: layout.xaxis.tickvals});
      layout.xaxis.ticktext = layout.xaxis.tickvals.map((text) => wrapped(text, width < 500 ? 16 : 18));
      layout.xaxis.tickfont = {size: 11};
    }
    // Error bars beside each other.
    const numbered = traces.filter((trace) => trace.error_y && typeof trace.x[0] === 'number');
    numbered.forEach((trace, k) => { trace.x = trace.x.map((x) => x + .035 * (k - (numbered.length - 1) / 2)); });
    const xs = traces.flatMap((trace) => trace.x);
    if (chart.whole_x && xs.length) layout.xaxis.dtick = Math.max(1, Math.ceil((Math.max(...xs) - Math.min(...xs)) / 12));
    return {traces, layout};
  };

  // Heights over a grid from a tidy table.
  const gridOf = (chart) => {
    const layer = chart.layers.find(({look}) => look === 'grid');
    const rows = rowsOf(chart, layer.series);
    const [xs, ys, zs] = [1, 2, 3].map((column) => valuesOf(chart, rows, column));
    const x = [...new Set(xs)], y = [...new Set(ys)];
    const z = y.map(() => x.map(() => null));
    rows.forEach((row, k) => { z[y.indexOf(ys[k])][x.indexOf(xs[k])] = zs[k]; });
    const other = (look) => {
      const found = chart.layers.find((part) => part.look === look);
      if (!found) return null;
      const places = rowsOf(chart, found.series);
      if (!places.length) return null;
      return {name: plain(short(found.series, 42)), ...Object.fromEntries(['x', 'y', 'z'].map((key, k) => [key, valuesOf(chart, places, k + 1)]))};
    };
    return {x, y, z, ridge: other('ridge'), best: other('best')};
  };
  const kGreys = [[0, '#c4c4c4'], [1, '#ffffff']];

  const contourParts = (chart, width) => {
    const grid = gridOf(chart);
    const traces = [{type: 'contour', x: grid.x, y: grid.y, z: grid.z, colorscale: kGreys, showscale: false, ncontours: 9,
      line: {color: '#8c8c8c', width: .8}, contours: {showlabels: true, labelfont: {size: 11, color: kInk}}, showlegend: false,
      hovertemplate: '%{x:.3g}, %{y:.3g}: %{z:.4g}<extra></extra>'}];
    if (grid.ridge) {
      const level = grid.ridge.z[0];
      traces.push({type: 'contour', x: grid.x, y: grid.y, z: grid.z, showscale: false, hoverinfo: 'skip',
        contours: {start: level, end: level, size: 1, coloring: 'none'}, line: {color: kInk, width: 4, dash: 'solid'},
        autocontour: false, showlegend: true, name: grid.ridge.name});
    }
    if (grid.best) {
      traces.push({type: 'scatter', mode: 'markers', x: grid.best.x, y: grid.best.y, name: grid.best.name, cliponaxis: false,
        marker: {symbol: 'diamond', size: 12, color: '#fff', line: {color: kInk, width: 2.5}}});
    }
    const layout = layoutOf(chart, width);
    layout.xaxis.showgrid = layout.yaxis.showgrid = false;
    layout.showlegend = traces.length > 1;
    return {traces, layout};
  };

  const scene = (titles, more) => ({
    ...Object.fromEntries(['xaxis', 'yaxis', 'zaxis'].map((key, k) => [key,
      {title: {text: wrapped(titles[k], 24)}, gridcolor: '#c8c8c8', backgroundcolor: '#fff', showbackground: false, zeroline: false}])),
    dragmode: 'orbit', ...more,
  });
  const layout3d = (parts) => ({
    font: {family: getComputedStyle(document.body).fontFamily, size: 12, color: kInk},
    margin: {l: 0, r: 0, t: 0, b: 0}, paper_bgcolor: '#fff', showlegend: true,
    legend: {orientation: 'h', y: 0, yanchor: 'top', x: 0}, scene: parts,
  });

  const surfaceParts = (chart) => {
    const grid = gridOf(chart);
    const level = grid.ridge ? grid.ridge.z[0] : null;
    const traces = [{type: 'surface', x: grid.x, y: grid.y, z: grid.z, showscale: false, opacity: .96,
      colorscale: [[0, '#5d6f80'], [1, '#f4f1ea']], lighting: {ambient: .65, diffuse: .6, specular: .1},
      contours: {z: level === null ? {show: true, color: '#8c8c8c'} : {show: true, start: level, end: level, size: 1, color: '#000', width: 6}},
      hovertemplate: '%{x:.3g}, %{y:.3g}: %{z:.4g}<extra></extra>'}];
    if (grid.ridge) {
      traces.push({type: 'scatter3d', mode: 'markers', name: grid.ridge.name, x: grid.ridge.x, y: grid.ridge.y, z: grid.ridge.z,
        marker: {size: 2.6, color: '#000'}});
    }
    if (grid.best) {
      traces.push({type: 'scatter3d', mode: 'markers', name: grid.best.name, x: grid.best.x, y: grid.best.y, z: grid.best.z,
        marker: {symbol: 'diamond', size: 7, color: '#fff', line: {color: '#000', width: 2}}});
    }
    return {traces, layout: layout3d(scene([chart.x_title, chart.y_title, chart.z_title],
      {camera: {eye: {x: -1.5, y: -1.5, z: .9}}, aspectmode: 'cube'}))};
  };

  // Every grain is one of a few shapes, turned and moved.
  const heapParts = (chart) => {
    const [, kind, x, y, z, w, i, j, k] = chart.columns.map(({values}) => values);
    const corners = new Map(), triangles = new Map();
    const listed = (map, key) => map.get(key) ?? map.set(key, []).get(key);
    rowsOf(chart, 'corner').forEach((row) => listed(corners, kind[row]).push([x[row], y[row], z[row]]));
    rowsOf(chart, 'triangle').forEach((row) => listed(triangles, kind[row]).push([x[row], y[row], z[row]]));
    const mesh = {x: [], y: [], z: [], i: [], j: [], k: [], facecolor: []};
    rowsOf(chart, 'grain').forEach((row, number) => {
      const base = mesh.x.length;
      const [a, b, c, d] = [w[row], i[row], j[row], k[row]];
      for (const [px, py, pz] of corners.get(kind[row]) ?? []) {
        // v + 2 a (u x v) + 2 u x (u x v) for the unit quaternion (a, u).
        const tx = 2 * (c * pz - d * py), ty = 2 * (d * px - b * pz), tz = 2 * (b * py - c * px);
        mesh.x.push(x[row] + px + a * tx + c * tz - d * ty);
        mesh.y.push(y[row] + py + a * ty + d * tx - b * tz);
        mesh.z.push(z[row] + pz + a * tz + b * ty - c * tx);
      }
      const tone = (number * 0.61803398875) % 1;  // neighbours in the list differ
      const shade = (chart.colour ?? [.69, .55, .41]).map((part) => Math.min(255, Math.round(255 * part * (.82 + .36 * tone))));
      const colour = `rgb(${shade.join(',')})`;
      for (const [p, q, r] of triangles.get(kind[row]) ?? []) {
        mesh.i.push(base + p); mesh.j.push(base + q); mesh.k.push(base + r); mesh.facecolor.push(colour);
      }
    });
    const traces = [{type: 'mesh3d', ...mesh, flatshading: false, hoverinfo: 'skip', showlegend: false,
      lighting: {ambient: .45, diffuse: .8, specular: .15, roughness: .6}, lightposition: {x: -2000, y: -3000, z: 4000}}];
    const layout = layout3d(scene([chart.x_title, chart.y_title, chart.z_title], {aspectmode: 'data', camera: kCameras['oblique']}));
    layout.showlegend = false;
    return {traces, layout};
  };
  const kUp = {x: 0, y: 0, z: 1};
  const kCameras = {
    'oblique': {eye: {x: 1.2, y: -2.35, z: 1.05}, center: {x: 0, y: 0, z: -.12}, up: kUp},
    'from the side': {eye: {x: 0, y: -2, z: .05}, up: kUp},
    'from above': {eye: {x: 0, y: -.01, z: 2.2}, up: kUp},
  };

  const partsOf = {plane: planeParts, contour: contourParts, heap: heapParts};

  // Printed as wide as there is room, whatever width it was drawn at.
  const letScale = (plot) => {
    const box = plot.querySelector('.svg-container');
    if (!box) return;
    const [width, height] = [box.style.width, box.style.height].map(parseFloat);
    plot.style.setProperty('--ratio', `${width} / ${height}`);
    for (const drawing of box.querySelectorAll(':scope > .main-svg')) drawing.setAttribute('viewBox', `0 0 ${width} ${height}`);
  };

  // What is drawn with WebGL is printed as a picture.
  const keepPrintImage = async (plot) => {
    const uri = await Plotly.toImage(plot, {format: 'png', width: 900, height: 620});
    let image = plot.parentElement.querySelector('.print-image');
    if (!image) {
      image = document.createElement('img');
      image.className = 'print-image';
      image.alt = plot.getAttribute('aria-label');
      plot.after(image);
    }
    image.src = uri;
  };

  const button = (tools, text, action) => {
    const made = document.createElement('button');
    made.type = 'button';
    made.textContent = text;
    made.addEventListener('click', () => action(made));
    tools.append(made);
    return made;
  };

  const csvOf = (chart) => {
    const quoted = (cell) => {
      const text = cell === null ? '' : String(cell);
      return /[",\r\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
    };
    const head = chart.columns.map(({name, unit}) => quoted(unit ? `${name} [${unit}]` : name)).join(',');
    const rows = chart.columns[0].values.map((_, row) => chart.columns.map(({values}) => quoted(values[row])).join(','));
    return [head, ...rows].join('\n') + '\n';
  };

  const kMostRowsShown = 300;
  const dataTable = (chart) => {
    const table = document.createElement('table');
    const add = (cells, kind) => {
      const row = table.insertRow();
      for (const cell of cells) {
        const made = document.createElement(kind);
        made.textContent = cell === null ? '' : String(cell);
        row.append(made);
      }
    };
    add(chart.columns.map(({name, unit}) => (unit ? `${name} [${unit}]` : name)), 'th');
    const count = chart.columns[0].values.length;
    for (let row = 0; row < Math.min(count, kMostRowsShown); ++row) add(chart.columns.map(({values}) => values[row]), 'td');
    if (count > kMostRowsShown) add([`… ${count - kMostRowsShown} more rows in the CSV`], 'td');
    return table;
  };

  const addDataButton = (figure, tools, current) => {
    const panel = document.createElement('div');
    panel.className = 'data';
    panel.hidden = true;
    panel.tabIndex = 0;
    const toggle = button(tools, 'data', () => {
      panel.hidden = !panel.hidden;
      toggle.setAttribute('aria-expanded', String(!panel.hidden));
      if (!panel.hidden) panel.replaceChildren(dataTable(current()));
      panel.classList.toggle('scrolls', panel.scrollWidth > panel.clientWidth + 1);
    });
    toggle.setAttribute('aria-expanded', 'false');
    button(tools, 'CSV', () => {
      const link = document.createElement('a');
      link.href = URL.createObjectURL(new Blob([csvOf(current())], {type: 'text/csv'}));
      link.download = `${current().name}.csv`;
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    });
    figure.append(tools, panel);
  };

  const toolsOf = () => Object.assign(document.createElement('div'), {className: 'tools'});

  const addHeapButtons = (tools, plot) => {
    for (const [name, camera] of Object.entries(kCameras)) {
      button(tools, name, () => Plotly.relayout(plot, {'scene.camera': camera}));
    }
    let timer = null;
    const turn = button(tools, 'turn', () => {
      if (timer) {
        clearInterval(timer);
        timer = null;
      } else {
        let angle = -1.1;
        timer = setInterval(() => {
          angle += .04;
          Plotly.relayout(plot, {'scene.camera': {eye: {x: 2.05 * Math.cos(angle), y: 2.05 * Math.sin(angle), z: .85}, up: kUp}});
        }, 60);
      }
      turn.setAttribute('aria-pressed', String(timer !== null));
    });
  };

  const heightOf = (chart, width) => {
    if (chart.kind === 'heap') return Math.min(520, Math.max(300, .75 * width));
    return Math.min(360, Math.max(270, .55 * width)) + legendHeight(chart, width) + (hasNames(chart) ? kTickNames_px - 52 : 0);
  };

  const draw = async (figure) => {
    if (figure.dataset.state) return;
    figure.dataset.state = 'drawing';
    const chart = chartNamed.get(figure.dataset.chart);
    const plot = figure.querySelector('.plot');
    const tools = toolsOf();
    const width = plot.clientWidth;
    const {traces, layout} = partsOf[chart.kind](chart, width);
    const height = heightOf(chart, width);
    plot.style.minHeight = `${height}px`;
    try {
      const drawn = Plotly.newPlot(plot, traces, {...layout, width, height}, kConfig);
      letScale(plot);  // a page that is printed at once does not wait
      await drawn;
      letScale(plot);
      if (chart.kind === 'heap') {
        addHeapButtons(tools, plot);
        await keepPrintImage(plot);
      }
    } catch (fault) {
      plot.textContent = `This chart could not be drawn here (${fault.message}). Its numbers are under “data”.`;
    }
    addDataButton(figure, tools, () => chart);
    figure.dataset.state = 'drawn';
  };

  const drawSurfaces = async (figure) => {
    if (figure.dataset.state) return;
    figure.dataset.state = 'drawing';
    const contours = charts.filter(({kind}) => kind === 'contour');
    const plot = figure.querySelector('.plot');
    const tools = toolsOf();
    const choice = document.createElement('select');
    choice.setAttribute('aria-label', 'surface');
    contours.forEach((chart, k) => choice.append(new Option(chart.title, k)));
    let current = contours[0];
    const show = async () => {
      current = contours[choice.value];
      const {traces, layout} = surfaceParts(current);
      const width = plot.clientWidth;
      await Plotly.react(plot, traces, {...layout, width, height: Math.min(560, Math.max(320, .8 * width))}, kConfig);
      plot.setAttribute('aria-label', `${current.title}, as a surface`);
      await keepPrintImage(plot);
    };
    choice.addEventListener('change', show);
    tools.append(choice);
    try {
      await show();
    } catch (fault) {
      plot.textContent = `Surfaces could not be drawn here (${fault.message}).`;
    }
    addDataButton(figure, tools, () => current);
    figure.dataset.state = 'drawn';
  };

  const figures = [...document.querySelectorAll('.chart')];
  for (const figure of figures) figure.dataset.kind = chartNamed.get(figure.dataset.chart)?.kind ?? 'surface';
  const drawAny = (figure) => (figure.dataset.chart ? draw(figure) : drawSurfaces(figure));

  // What is on the screen first, the rest while nothing else is to be done.
  const seen = new IntersectionObserver((entries) => {
    for (const {isIntersecting, target} of entries) if (isIntersecting) drawAny(target);
  }, {rootMargin: '500px'});
  figures.forEach((figure) => seen.observe(figure));
  const later = window.requestIdleCallback ?? ((work) => setTimeout(work, 30));
  const drawRest = async () => {
    const next = figures.find((figure) => !figure.dataset.state);
    if (!next) return;
    await drawAny(next);
    later(drawRest);
  };
  window.addEventListener('load', () => later(drawRest));

  const fit = (figure, width) => {
    const plot = figure.querySelector('.plot');
    if (figure.dataset.state !== 'drawn' || !plot.layout || plot.layout.width === width) return;
    const chart = chartNamed.get(figure.dataset.chart);
    if (!chart || chart.kind === 'heap') {
      Plotly.relayout(plot, {width});
      return;
    }
    const height = heightOf(chart, width);
    plot.style.minHeight = `${height}px`;
    Plotly.relayout(plot, {width, height, 'margin.b': spaceBelow(chart, width)}).then(() => letScale(plot));
    letScale(plot);
  };
  const markScrolling = () => {
    for (const box of document.querySelectorAll('.table, .data')) box.classList.toggle('scrolls', box.scrollWidth > box.clientWidth + 1);
  };
  markScrolling();
  let resizing = null;
  window.addEventListener('resize', () => {
    clearTimeout(resizing);
    resizing = setTimeout(() => {
      markScrolling();
      figures.forEach((figure) => fit(figure, figure.querySelector('.plot').clientWidth));
    }, 150);
  });
  // A4 less its margins, at 96 pixels an inch; charts beside each other have half of it.
  const kPaper_px = 665, kPaperAlone_px = 490;
  window.addEventListener('beforeprint', () => {
    for (const figure of figures) {
      if (figure.dataset.kind !== 'plane' && figure.dataset.kind !== 'contour') continue;
      drawAny(figure);
      const alone = !figure.matches('.charts > .chart:not(:only-child)');
      fit(figure, alone ? kPaperAlone_px : kPaper_px / 2 - 10);
    }
  });
  window.addEventListener('afterprint', () => figures.forEach((figure) => fit(figure, figure.querySelector('.plot').clientWidth)));

  // Where one points in a measured picture, in its own pixels: as hints name places.
  for (const figure of document.querySelectorAll('[data-pixels]')) {
    const [wide, high, left, width, height] = figure.dataset.pixels.split(' ').map(Number);
    const picture = figure.querySelector('img'), said = figure.querySelector('.pixel');
    picture.addEventListener('pointermove', (event) => {
      const box = picture.getBoundingClientRect();
      const x = Math.floor(((event.clientX - box.left) / box.width - left) / width * wide);
      const y = Math.floor((event.clientY - box.top) / box.height / height * high);
      said.textContent = x >= 0 && y >= 0 && x < wide && y < high ? `at ${x}, ${y} px` : '';
    });
    picture.addEventListener('pointerleave', () => { said.textContent = ''; });
  }
  for (const copy of document.querySelectorAll('.copy')) {
    copy.addEventListener('click', () => {
      const text = copy.closest('.code').querySelector('pre');
      getSelection().selectAllChildren(text);
      document.execCommand('copy');
      copy.textContent = 'copied';
    });
  }
})();
