"use strict";
(async () => {
  // Numbers and the program that draws lie in the page, compressed.
  const unpacked = async (id) => {
    const letters = document.getElementById(id).textContent.trim();
    const bytes = Uint8Array.from(atob(letters), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).text();
  };
  const program = document.createElement("script");
  program.textContent = await unpacked("packed-plotly");
  document.head.append(program);
  const data = JSON.parse(await unpacked("packed-numbers"));
  const fields = data.fields;
  // Figures need a place of a size to be drawn into.
  document.body.dataset.drawing = "yes";
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  const look = data.theme[dark ? "dark" : "light"];
  const { colours, scale } = look;
  const options = { responsive: true, displaylogo: false, displayModeBar: "hover", modeBarButtonsToRemove: ["lasso2d", "select2d"] };
  const layout = (x, y, more = {}) => ({
    margin: { l: 60, r: 12, t: 10, b: 56 },
    ...look.layout,
    xaxis: { ...look.layout.xaxis, title: { text: x, standoff: 6 }, zeroline: false },
    yaxis: { ...look.layout.yaxis, title: { text: y }, zeroline: false },
    legend: { orientation: "h", y: 1.12 },
    ...more,
  });
  const square = () => {
    const plane = layout("x [µm]", "y [µm]");
    plane.yaxis = { ...plane.yaxis, scaleanchor: "x", constrain: "domain" };
    plane.xaxis.constrain = "domain";
    return plane;
  };
  const map = (id, values, more) =>
    Plotly.react(id, [{ type: "heatmap", x: fields.x, y: fields.y, z: values, ...more }], square(), options);

  // A line contact has no map: pressure, size of the shear and zones along x.
  const alongX = (at) => {
    const profile = (id, y, label, largest) => {
      const axes = layout("x [µm]", label);
      axes.yaxis.range = [0, 1.05 * largest];
      Plotly.react(id, [{ x: fields.x, y, line: { color: colours.first }, showlegend: false }], axes, options);
    };
    profile("p", at.p[0], "p [MPa]", fields.largest.p);
    profile("q", at.q[0], "|q| [MPa]", fields.largest.q || 1);
    const bars = [["stick", 2], ["slip", 1]].map(([name, code]) => ({
      type: "bar", x: fields.x, name, marker: { color: colours[name], line: { width: 1, color: colours[name] } },
      y: at.p[0].map((p, k) => (at.zone[0][k] === code ? p : null)),
    }));
    const zones = layout("x [µm]", "p [MPa]", { barmode: "overlay", bargap: 0 });
    zones.yaxis.range = [0, 1.05 * fields.largest.p];
    Plotly.react("zone", bars, zones, options);
  };

  const show = (n) => {
    const at = fields.shown[n];
    document.getElementById("number").textContent = at.increment;
    document.getElementById("says").textContent = at.says;
    const bar = (title) => ({ title: { text: title, side: "right" }, thickness: 12 });
    if (fields.flat) {
      alongX(at);
    } else {
      map("p", at.p, { zmin: 0, zmax: fields.largest.p, colorscale: scale, colorbar: bar("p [MPa]") });
      map("q", at.q, { zmin: 0, zmax: fields.largest.q || 1, colorscale: scale, colorbar: bar("|q| [MPa]") });
      map("zone", at.zone, {
        zmin: 1, zmax: 2, showscale: false,
        colorscale: [[0, colours.slip], [0.5, colours.slip], [0.5, colours.stick], [1, colours.stick]],
        hovertemplate: "x %{x}, y %{y}<extra></extra>",
      });
    }
    const line = at.line;
    const on = fields.line;
    const shear = `q<sub>${on.component.slice(-1)}</sub>`;
    const lines = [
      { x: on.s, y: line.p, name: "p", line: { color: colours.first } },
      { x: on.s, y: line.q, name: shear, line: { color: colours.second } },
    ];
    if (line.bound) {
      const below = line.bound.map((v) => (v === null ? null : -v));
      const grey = { color: colours.bound, dash: "dot", width: 1 };
      lines.push({ x: on.s, y: line.bound, name: "±µp", line: grey });
      lines.push({ x: on.s, y: below, showlegend: false, line: grey });
    }
    Plotly.react("profile", lines, layout(`${on.along} [µm]`, "p, q [MPa]"), options);
    const place = data.loop.increment.indexOf(at.increment);
    const dot = place < 0 ? [[], []] : [[data.loop.x[place]], [data.loop.y[place]]];
    Plotly.react("loop", [
      { x: data.loop.x, y: data.loop.y, mode: "lines+markers", marker: { size: 4 }, line: { color: colours.first }, showlegend: false },
      { x: dot[0], y: dot[1], mode: "markers", marker: { size: 12, color: colours.second }, showlegend: false },
    ], layout(data.loop.labels[0], data.loop.labels[1]), options);
  };

  const which = document.getElementById("which");
  which.max = fields.shown.length - 1;
  which.value = which.max;
  which.addEventListener("input", () => show(Number(which.value)));
  show(fields.shown.length - 1);

  const stress = data.stress;
  if (stress) {
    const section = layout(`${stress.along} [µm]`, "z [µm]");
    section.yaxis.autorange = "reversed";
    if (stress.ticks) {
      // Thin layers have room, each on a scale of its own.
      section.yaxis.tickvals = stress.ticks[0];
      section.yaxis.ticktext = stress.ticks[1];
    }
    if (stress.equal) {
      section.yaxis = { ...section.yaxis, scaleanchor: "x", constrain: "domain" };
      section.xaxis.constrain = "domain";
    }
    section.shapes = stress.interfaces.map((z) => ({
      type: "line", xref: "paper", x0: 0, x1: 1, y0: z, y1: z, line: { dash: "dash", width: 1 },
    }));
    const [x, y, z] = stress.largest.at.map((of) => of.toPrecision(3));
    const crack = [];
    if (stress.crack) {
      const way = (of, line) => crack.push({ x: of.x, y: of.z, mode: "lines", line: { color: colours.ink, ...line }, hoverinfo: "skip", showlegend: false });
      way(stress.crack.grown, { width: 2.5 });
      way(stress.crack.rest, { width: 1, dash: "dash" });
      if (stress.crack.end) {
        crack.push({ x: stress.crack.end.x, y: stress.crack.end.z, mode: "markers", marker: { size: 8, color: colours.crack }, hoverinfo: "skip", showlegend: false });
      }
    }
    document.getElementById("body").textContent = stress.body;
    document.getElementById("plane").textContent = stress.plane;
    Plotly.newPlot("stress", [
      { type: "heatmap", x: stress.x, y: stress.place, z: stress.values, customdata: stress.z.map((z) => stress.x.map(() => z)), hovertemplate: stress.along + " %{x} µm, z %{customdata} µm: %{z} MPa<extra></extra>", colorscale: scale, colorbar: { title: { text: "von Mises [MPa]", side: "right" }, thickness: 12 } },
      { x: [stress.mark[0]], y: [stress.mark[1]], mode: "markers", marker: { symbol: "x-thin", size: 10, line: { width: 2, color: "black" } }, hoverinfo: "skip", showlegend: false },
      ...crack,
    ], section, options);
    document.getElementById("largest").textContent =
      `the cross marks the largest, ${stress.largest.value.replace("+-", "±")} MPa at x = ${x} µm, y = ${y} µm, z = ${z} µm${stress.crack ? `; the line is the crack${stress.crack.end ? `, dashed beyond the dot: it ${stress.crack.briefly}` : ""}` : ""}.${stress.interfaces.length ? " Each layer has a scale of depth of its own." : ""}`;
  } else {
    document.getElementById("below").remove();
  }
  for (const id of ["cracked", "worn"]) document.getElementById(id).hidden = false;
  if (data.crack) {
    const of = data.crack;
    document.getElementById("verdict").textContent = of.says;
    document.getElementById("length").textContent = of.length;
    const K = (name, label, color) => ({
      x: of.increment, y: of[name], name: label, line: { color },
      error_y: { type: "data", array: of[`${name}_error`], thickness: 1, width: 2 },
    });
    Plotly.newPlot("intensity", [K("K_I", "K<sub>I</sub>", colours.first), K("K_II", "K<sub>II</sub>", colours.second)], layout("increment", "K [MPa m<sup>1/2</sup>]"), options);
    if (of.kitagawa) {
      const { length, load, limit, smooth } = of.kitagawa;
      const axes = layout("crack length [µm]", "range of stress [MPa]");
      axes.xaxis = { ...axes.xaxis, type: "log", dtick: "D2" };
      axes.yaxis = { ...axes.yaxis, type: "log", dtick: "D2" };
      const lines = [
        { x: length, y: load, name: "load", line: { color: colours.first } },
        { x: length, y: limit, name: "limit", line: { color: colours.ink } },
      ];
      if (smooth !== null) {
        lines.push({ x: [length[0], length[length.length - 1]], y: [smooth, smooth], name: "fatigue limit", mode: "lines", line: { color: colours.bound, dash: "dot" } });
      }
      Plotly.newPlot("kitagawa", lines, axes, options);
    } else {
      document.getElementById("diagram").remove();
    }
  } else {
    document.getElementById("cracked").remove();
  }
  if (data.wear) {
    const bodies = ["upper body", "lower body"];
    const pair = (x, of) => bodies.map((name, n) => ({ x, y: of[n], name }));
    const downwards = layout(`${data.wear.along} [µm]`, "worn depth [µm]");
    downwards.yaxis.autorange = "reversed";
    Plotly.newPlot("depths", pair(data.wear.cycles, data.wear.depth), layout("cycles", "depth [µm]"), options);
    const third = data.wear.third.map((line) => ({ ...line, x: data.wear.x, line: { dash: "dot" } }));
    Plotly.newPlot("profiles", [...pair(data.wear.x, data.wear.profile), ...third], downwards, options);
    const loops = data.wear.loops.map((of, n) => ({ ...of, mode: "lines+markers", marker: { size: 4 }, line: { color: n ? colours.second : colours.first } }));
    Plotly.newPlot("loops", loops, layout(...data.wear.labels), options);
  } else {
    document.getElementById("worn").remove();
  }
  document.body.dataset.drawn = "yes";
})();
