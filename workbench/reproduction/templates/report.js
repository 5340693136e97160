// Draw each figure when it is about to be seen, from the data that stand in the page:
// a page opened from a folder may not fetch files.
"use strict";
window.addEventListener("DOMContentLoaded", () => {
  const plots = [...document.querySelectorAll(".plot")];
  if (typeof Plotly === "undefined") {
    document.body.classList.add("without-plotly");
    return;
  }
  const draw = (plot) => {
    if (plot.dataset.drawn) return;
    plot.dataset.drawn = "yes";
    const figure = JSON.parse(document.getElementById(plot.dataset.content).textContent);
    Plotly.newPlot(plot, figure.data, figure.layout, { responsive: true, displaylogo: false });
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
  // Printing shows the still images where there are any, else the drawn figures.
  window.addEventListener("beforeprint", () => plots.forEach(draw));
});
