// Draw each figure when it is about to be seen. A page opened from a folder may not fetch files,
// so the data of a figure are a script, which calls showFigure.
"use strict";
const waiting = new Map();
// plotly.js offers to upload a chart unless it is told not to.
const config = { responsive: true, displaylogo: false, showSendToCloud: false };
window.showFigure = (name, figure) => {
  const plot = waiting.get(name);
  waiting.delete(name);
  if (plot) Plotly.newPlot(plot, figure.data, figure.layout, config).then(describeOnce);
};
// The figure's description says it in words; its tick labels, read one by one, would not.
const describeOnce = (plot) => {
  for (const drawing of plot.querySelectorAll(".main-svg")) drawing.ariaHidden = "true";
};
window.addEventListener("DOMContentLoaded", () => {
  const plots = [...document.querySelectorAll(".plot")];
  if (typeof Plotly === "undefined") {
    document.body.classList.add("without-plotly");
    return;
  }
  const draw = (plot) => {
    if (plot.dataset.asked) return;
    plot.dataset.asked = "yes";
    waiting.set(plot.dataset.figure, plot);
    const script = document.createElement("script");
    script.src = `figures/${plot.dataset.figure}.js`;
    document.head.append(script);
  };
  const seen = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) {
        if (entry.isIntersecting) {
          seen.unobserve(entry.target);
          draw(entry.target);
        }
      }
    },
    { rootMargin: "600px" },
  );
  plots.forEach((plot) => seen.observe(plot));
});
