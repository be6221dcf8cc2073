"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const place = (id) => document.getElementById(id);
  const ink = "#262626", faint = "#5f6670", blue = "#0072B2", warm = "#D55E00";
  // Scrolling with a finger must not zoom the figures.
  const byFinger = window.matchMedia("(pointer: coarse)").matches || window.innerWidth < 640;
  const config = {
    responsive: true, displaylogo: false, displayModeBar: byFinger ? false : "hover",
    doubleClick: "reset", modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
    toImageButtonOptions: { format: "svg" },
  };
  if (byFinger) place("zoom-hint")?.remove();
  const quiet = { ...config, displayModeBar: false };
  const axis = (title, more = {}) => ({
    title: { text: title, standoff: 8, font: { size: 12 } }, color: ink, tickfont: { size: 11 },
    gridcolor: "#e8ecef", zeroline: false, linecolor: "#9aa3ab", ticks: "outside", ticklen: 3,
    automargin: true, ...more,
  });
  const layout = (more) => ({
    font: { family: "system-ui, -apple-system, 'Segoe UI', Roboto, Arial, sans-serif", color: ink },
    margin: { l: 50, r: 24, t: 12, b: 42 }, paper_bgcolor: "#fff", plot_bgcolor: "#fff",
    dragmode: byFinger ? false : "zoom", hoverlabel: { bgcolor: "#fff", font: { color: ink } },
    showlegend: false, ...more,
  });

  // --- over time

  const time = data.time;
  let onLog = time.startsLog;
  const places = () => (onLog ? time.log : time.linear);
  const timeAxis = () => onLog
    ? axis(`${time.name} [${time.unit}], logarithmic`, { tickmode: "array", tickvals: time.ticks.at, ticktext: time.ticks.text })
    : axis(`${time.name} [${time.unit}]`, { rangemode: "tozero" });

  // A closed polygon for each run of instants whose error is known.
  function band(panel) {
    const x = [], y = [], at = places();
    let part = [];
    const close = () => {
      if (part.length > 1) {
        const low = part.map((i) => panel.value[i] - panel.half[i]);
        const high = part.map((i) => panel.value[i] + panel.half[i]);
        const there = part.map((i) => at[i]);
        x.push(...there, ...there.slice().reverse(), there[0], null);
        y.push(...high, ...low.reverse(), high[0], null);
      }
      part = [];
    };
    panel.value.forEach((value, i) => {
      if (value === null || panel.half[i] === null) close(); else part.push(i);
    });
    close();
    return { x, y, mode: "lines", fill: "toself", fillcolor: "rgba(0,114,178,0.22)", line: { width: 0 }, hoverinfo: "skip" };
  }

  // Words in place of a curve.
  const inWords = (text) => ({ text, showarrow: false, xref: "paper", yref: "paper", x: 0.5, y: 0.5, font: { size: 12, color: faint } });
  function drawPanel(panel) {
    const line = {
      x: places(), y: panel.value,
      mode: panel.value.length < 2 ? "markers" : time.marked ? "lines+markers" : "lines",
      line: { color: blue, width: 2 }, text: panel.hover,
      hovertemplate: "%{text}<extra></extra>",
    };
    return Plotly.react(place(`history-${panel.name}`), [band(panel), line], layout({
      xaxis: timeAxis(), yaxis: axis("", { range: panel.range, showticklabels: !panel.words }), hovermode: "x",
      annotations: panel.words ? [inWords(panel.words)] : [],
    }), quiet);
  }

  // Force over approach, resistance over position: earlier cycles thin, the last one bold.
  function drawLoop(loop) {
    const thin = { color: "#9aa3ab", width: 1 };
    const part = (from, to, look) => ({
      x: loop.position.slice(from, to), y: loop.values.slice(from, to), mode: "lines", text: loop.hover.slice(from, to),
      hovertemplate: `${loop.across} %{x:.4g} ${loop.unit}, %{text}<extra></extra>`, line: look,
    });
    return Plotly.newPlot(place(loop.name), [
      part(0, loop.last + 1, thin), part(loop.last, loop.end + 1, { color: blue, width: 2.2 }), part(loop.end, undefined, thin),
    ], layout({ xaxis: axis(`${loop.across} [${loop.unit}]`), yaxis: axis("", { zeroline: true, zerolinecolor: "#9aa3ab" }) }), quiet);
  }

  const panels = [...data.load, ...data.answers];
  const drawHistories = () => panels.forEach(drawPanel);
  const timeButton = place("time-scale");
  if (timeButton) {
    const name = () => { timeButton.textContent = onLog ? `Show linear ${time.name.toLowerCase()}` : `Show logarithmic ${time.name.toLowerCase()}`; };
    timeButton.addEventListener("click", () => { onLog = !onLog; name(); drawHistories(); });
    name();
  }

  // --- over the surface

  const map = data.map;
  const unpack = (text) => {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const parts = new DataView(bytes.buffer), rows = [];
    for (let j = 0, k = 0; j < map.y.length; j++) {
      const row = [];
      for (let i = 0; i < map.x.length; i++, k += 2) {
        const part = parts.getUint16(k, true);
        row.push(part ? (part / map.steps) * map.peak : null);
      }
      rows.push(row);
    }
    return rows;
  };
  const kept = new Map();
  const pressure = (index) => {
    if (!kept.has(index)) kept.set(index, unpack(map.parts[index]));
    return kept.get(index);
  };
  let shown = map ? map.start : 0;

  // The surface ends at the border of a period; elsewhere the plane continues.
  const constrain = map && map.periodic ? "domain" : "range";
  const planeAxes = () => ({
    xaxis: axis(`x [${map.unit}]`, { range: map.xRange, constrain, showgrid: false }),
    yaxis: axis(`y [${map.unit}]`, { range: map.yRange, constrain, showgrid: false, scaleanchor: "x", scaleratio: map.stretch }),
  });
  // Height for the true (or stated) aspect ratio at this width.
  function planeHeight(box, around, most) {
    const ratio = map.stretch * (map.yRange[1] - map.yRange[0]) / (map.xRange[1] - map.xRange[0]);
    return Math.round(Math.min(Math.max((box.clientWidth - 80) * ratio + around, around + 60), most));
  }

  // The axis of a moving body, and an arrow from it along the motion.
  const cross = ({ axis: [x, y] }) => ({
    x: [x], y: [y], mode: "markers", hovertemplate: `axis of the body: x %{x:.4g}, y %{y:.4g} ${map.unit}<extra></extra>`,
    marker: { symbol: "cross-thin", size: 9, line: { color: warm, width: 2 } },
  });
  function arrow({ axis: [x, y], direction }) {
    if (!direction) return [];
    const across = direction[0], up = map.stretch * direction[1], pixels = 34 / Math.hypot(across, up);
    return [{
      x, y, xref: "x", yref: "y", text: "", showarrow: true, arrowhead: 2, arrowwidth: 2.2, arrowcolor: warm,
      xshift: pixels * across, yshift: pixels * up, ax: -pixels * across, ay: pixels * up,
    }];
  }

  function drawMap() {
    const box = place("map");
    const heat = {
      type: "heatmap", x: map.x, y: map.y, z: pressure(shown), zmin: 0, zmax: map.peak,
      colorscale: [[0, "#f1f8c9"], [0.2, "#c7e9b4"], [0.4, "#7fcdbb"], [0.6, "#41b6c4"], [0.8, "#1d91c0"], [0.9, "#225ea8"], [1, "#0c2c84"]],
      hoverongaps: false, zsmooth: false,
      hovertemplate: `x %{x:.4g} ${map.unit}, y %{y:.4g} ${map.unit}<br>%{z:.4g} ${map.pressureUnit}<extra></extra>`,
      colorbar: { orientation: "h", thickness: 10, len: 0.9, x: 0.5, y: 1.0, yanchor: "bottom", outlinewidth: 0, tickfont: { size: 11 }, title: { text: `Pressure [${map.pressureUnit}]`, side: "top", font: { size: 12 } } },
    };
    const rim = { ...map.rims[shown], mode: "lines", line: { color: ink, width: 1 }, hoverinfo: "skip" };
    const body = map.body[shown];
    box.style.height = `${planeHeight(box, 130, 600)}px`;
    const plane = layout({ ...planeAxes(), margin: { l: 56, r: 24, t: 60, b: 58 }, annotations: body ? arrow(body) : [] });
    // Space for the tick labels, which Plotly omits beside a horizontal colour bar.
    plane.xaxis.title.standoff = 28;
    return Plotly.react(box, [heat, rim, ...(body ? [cross(body)] : [])], plane, config);
  }

  function drawOutlines() {
    const box = place("outlines"), width = box.clientWidth < 500 ? 1.2 : 2;
    const lines = map.outlines.map((index) => ({
      ...map.rims[index], mode: "lines", name: map.labels[index], line: { color: map.colours[index], width },
      hovertemplate: `x %{x:.4g} ${map.unit}, y %{y:.4g} ${map.unit}<extra>${map.labels[index]}</extra>`,
    }));
    box.style.height = `${planeHeight(box, 120, 440)}px`;
    return Plotly.newPlot(box, lines, layout({
      ...planeAxes(), showlegend: true, margin: { l: 56, r: 24, t: 44, b: 46 },
      legend: { orientation: "h", x: 0, y: 1.0, yanchor: "bottom", font: { size: 12 } },
    }), quiet);
  }

  const sectionLines = (section) => section.values.map((values, index) => ({
    x: section.position, y: values, mode: "lines", name: map.labels[index],
    line: index === shown ? { color: warm, width: 2.6 } : { color: map.colours[index], width: 1 },
    opacity: index === shown ? 1 : 0.55,
    hovertemplate: `${section.along} %{x:.4g} ${section.unit}: %{y:.4g} ${section.valueUnit}<extra>${map.labels[index]}</extra>`,
  }));
  // Leading (full) and trailing (hollow) edge at the instant shown.
  const edgeMarks = (section) => {
    const edges = section.edges?.[shown];
    return edges ? [{
      x: edges, y: [0, 0], mode: "markers", cliponaxis: false, text: ["leading edge", "trailing edge"],
      marker: { size: 8, color: [warm, "#fff"], line: { color: warm, width: 1.6 } },
      hovertemplate: `%{text}: ${section.along} %{x:.4g} ${section.unit}<extra></extra>`,
    }] : [];
  };
  function drawSections() {
    data.sections.forEach((section) => Plotly.react(place(section.name), [...sectionLines(section), ...edgeMarks(section)], layout({
      xaxis: axis(`${section.along} [${section.unit}]`), yaxis: axis(`${section.label} [${section.valueUnit}]`, { rangemode: "tozero" }),
    }), quiet));
  }

  function showInstant(index) {
    shown = index;
    const peak = map.peaks[shown], label = map.labels[shown];
    place("instant").value = `${time.symbol}${label}`;
    place("map-account").textContent = peak ? `Largest pressure ${peak}` : "No contact";
    place("slider").setAttribute("aria-valuetext", label);
    drawMap();
    drawSections();
  }

  function followSlider() {
    const slider = place("slider"), play = place("play");
    let clock = null;
    const stop = () => { clearInterval(clock); clock = null; play.textContent = "Play"; };
    slider.addEventListener("input", () => showInstant(Number(slider.value)));
    slider.addEventListener("pointerdown", stop);
    play.addEventListener("click", () => {
      if (clock !== null) { stop(); return; }
      if (shown === map.labels.length - 1) { slider.value = "0"; showInstant(0); }
      play.textContent = "Stop";
      clock = setInterval(() => {
        if (shown >= map.labels.length - 1) { stop(); return; }
        slider.value = String(shown + 1);
        showInstant(shown + 1);
      }, 800);
    });
  }

  if (map) followSlider();
  const figures = [...(map ? [() => showInstant(shown), drawOutlines] : []), ...panels.map((panel) => () => drawPanel(panel)), ...data.loops.map((loop) => () => drawLoop(loop))];
  const drawNext = () => {
    const draw = figures.shift();
    if (!draw) { document.documentElement.dataset.drawn = "yes"; return; }
    draw();
    setTimeout(drawNext);
  };
  // The text is shown first, then the figures from top to bottom.
  requestAnimationFrame(() => setTimeout(drawNext));
})();
