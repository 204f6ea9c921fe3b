"use strict";
(() => {
  const figure = document.getElementById("figure");
  const cross = document.getElementById("cross");
  const readout = document.getElementById("readout");
  const { data, layout } = FIGURE;
  const names = layout.yaxis7.ticktext.slice();
  const titles = layout.annotations.map((note) => note.text);
  const [from, to] = layout.xaxis.range;

  // A narrow screen: shorter margins, and the legend of a row below its title.
  const fitted = (wide = figure.clientWidth) => {
    const small = wide < 720;
    return {
      "margin.l": small ? 104 : 168,
      "margin.r": small ? 26 : 44,
      "yaxis7.tickfont.size": small ? 8.5 : 11,
      "yaxis7.ticktext": small ? names.map((name) => (name.length > 19 && !name.startsWith("<b>") ? name.slice(0, 18) + "…" : name)) : names,
      annotations: layout.annotations.map((note, index) => ({ ...note, text: small ? titles[index].split("   ")[0].replace(/, time to.*right\]/, ", time [s]") : titles[index] })),
    };
  };
  // Words stand in a bar where they fit, and stay in sight while it does.
  const words = {
    type: "scatter", mode: "text", x: [], y: [], text: [], textposition: "middle right", hoverinfo: "skip",
    textfont: { size: 9.5, color: [] }, xaxis: "x", yaxis: "y7", showlegend: false,
  };
  const bars = data.filter((trace) => trace.type === "bar");
  data.push(words);
  const letter = 5.4;
  function label() {
    const axis = figure._fullLayout.xaxis;
    const [left, right] = axis.range;
    const pixels = axis._length / (right - left);
    const found = { x: [], y: [], text: [], color: [] };
    for (const trace of bars) {
      trace.text.forEach((text, index) => {
        const start = Math.max(left, trace.base[index]);
        const end = Math.min(right, trace.base[index] + trace.x[index]);
        if (text && (end - start) * pixels > text.length * letter + 10) {
          found.x.push(start);
          found.y.push(trace.y[index]);
          found.text.push(text);
          found.color.push(trace.textfont.color);
        }
      });
    }
    Plotly.restyle(figure, { x: [found.x], y: [found.y], text: [found.text], "textfont.color": [found.color] }, [data.length - 1]);
  }

  Plotly.newPlot(figure, data, layout, {
    ...FIGURE.config,
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"],
    toImageButtonOptions: { filename: document.title, scale: 2 },
  }).then(() => {
    let width = 0;
    const fit = () => {
      if (figure.clientWidth !== width) {
        width = figure.clientWidth;
        Plotly.relayout(figure, fitted());
      }
    };
    figure.on("plotly_relayout", label);
    fit();
    window.addEventListener("resize", fit);
    figure.on("plotly_doubleclick", () => { zoom(from, to); return false; });
  });
  window.addEventListener("beforeprint", () => Plotly.relayout(figure, { ...fitted(1000), width: 1000, autosize: false }));
  window.addEventListener("afterprint", () => Plotly.relayout(figure, { ...fitted(), width: null, autosize: true }));

  function zoom(a, b) {
    Plotly.relayout(figure, { "xaxis.range": [Math.max(from, a), Math.min(to, b)] });
  }

  // The last index whose time is not after t.
  function before(times, t) {
    let low = 0;
    let high = times.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (times[middle] <= t) low = middle + 1; else high = middle;
    }
    return low - 1;
  }

  const curves = data.filter((trace) => trace.type === "scatter" && trace.mode === "lines" && trace.name);
  const shown = ["seat", "mitigation level", "mode", "EPB given", "EPB confirmed", "gear confirmed", "K4 confirmed", "K1 confirmed"];
  const lanes = [];
  for (const trace of bars) {
    trace.y.forEach((y, index) => {
      const lane = shown.indexOf(names[y]);
      if (lane >= 0) (lanes[lane] ??= []).push([trace.base[index], trace.base[index] + trace.x[index], trace.hovertext[index]]);
    });
  }
  lanes.forEach((bars) => bars && bars.sort((a, b) => a[0] - b[0]));

  const starts = lanes.map((bars) => bars && bars.map((each) => each[0]));

  function at(t) {
    const parts = [`<span class="t">${t.toFixed(2)} s</span>`];
    for (const curve of curves) {
      const index = before(curve.x, t);
      const value = index < 0 ? null : curve.y[index];
      if (value !== null && value !== undefined) parts.push(`<span><em>${curve.name}</em> ${+value.toFixed(2)} ${curve.text}</span>`);
    }
    shown.forEach((name, lane) => {
      const bars = lanes[lane];
      if (!bars) return;
      const bar = bars[before(starts[lane], t)];
      if (bar && t < bar[1]) parts.push(`<span><em>${name}</em> ${bar[2].split("<br>")[1]}</span>`);
    });
    return parts.join("");
  }

  readout.innerHTML = '<em>Move across the figure to read every value at one time.</em>';
  figure.addEventListener("mousemove", (event) => {
    const full = figure._fullLayout;
    if (!full || !full.xaxis) return;
    const left = event.clientX - figure.getBoundingClientRect().left;
    const inside = left - full.margin.l;
    if (inside < 0 || inside > full.xaxis._length) { cross.style.display = "none"; return; }
    cross.style.display = "block";
    cross.style.left = `${left}px`;
    readout.innerHTML = at(full.xaxis.p2d(inside));
  });
  figure.addEventListener("mouseleave", () => { cross.style.display = "none"; });

  for (const row of document.querySelectorAll(".timeline tbody tr")) {
    row.title = "show in the figure";
    row.addEventListener("click", () => {
      const [a, b] = [Number(row.dataset.from), Number(row.dataset.to)];
      const edge = Math.max(1, (b - a) * 0.15);
      zoom(a - edge, b + edge);
      document.getElementById("readout").scrollIntoView({ behavior: "smooth" });
    });
  }
})();
