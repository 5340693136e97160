// Make a plotly figure as wide as its place. Drawn before it is in the page, a figure is
// 700 pixels wide, and afterwards it listens to the window only, not to its surroundings.

function fitFigure(place) {
  const drawing = place.querySelector(".js-plotly-plot .svg-container");
  if (!drawing || !place.clientWidth) return;
  if (Math.abs(drawing.clientWidth - place.clientWidth) > 1) window.dispatchEvent(new Event("resize"));
}

export default {
  render({ model, el }) {
    el.style.display = "none";
    let observers = [];
    // The element is put into its place after it was rendered.
    const begin = requestAnimationFrame(() => {
      const place = el.closest(`.${model.get("place")}`);
      if (!place) return;
      let drawn = 0;
      const soon = () => {
        cancelAnimationFrame(drawn);
        drawn = requestAnimationFrame(() => fitFigure(place));
      };
      observers = [new ResizeObserver(soon), new MutationObserver(soon)];
      observers[0].observe(place);
      observers[1].observe(place, { childList: true, subtree: true });
    });
    return () => {
      cancelAnimationFrame(begin);
      observers.forEach((observer) => observer.disconnect());
    };
  },
};
