// A plotly figure that is as wide as its place. Plotly's library of 5 MB is asked for when
// the first figure is drawn and shared by all in the page: a module that brought it along
// would take longer to start than a slow machine is given.

const CONFIG = { displaylogo: false, displayModeBar: false, responsive: false };

/** Give what the page's figures share: a promise of plotly.js, and whether it is there. */
function sharedLibrary() {
  // Each view has a module, and thus variables, of its own; only the page is common to all.
  if (!globalThis.workbenchPlotly) {
    const shared = { there: false };
    shared.ready = new Promise((resolve) => (shared.resolve = resolve));
    globalThis.workbenchPlotly = shared;
  }
  return globalThis.workbenchPlotly;
}

/**
 * Ask Python for plotly.js unless it is there. Each view asks for itself, and the first answer
 * serves all: a view that asked before may have lost its kernel.
 */
function loadPlotly(model, signal) {
  const shared = sharedLibrary();
  if (shared.there) return shared.ready;
  return new Promise((resolve, reject) => {
    shared.ready.then(resolve);
    const receive = async (content, buffers) => {
      if (content.kind !== "plotly.js") return;
      model.off("msg:custom", receive);
      if (shared.there) return;
      try {
        const packed = new Blob(buffers).stream().pipeThrough(new DecompressionStream("gzip"));
        const text = await new Response(packed).text();
        const module = new Blob([text, "\nexport default globalThis.Plotly;"], { type: "text/javascript" });
        shared.resolve((await import(URL.createObjectURL(module))).default);
        shared.there = true;
      } catch (error) {
        reject(error);
      }
    };
    model.on("msg:custom", receive);
    signal.addEventListener("abort", () => model.off("msg:custom", receive));
    model.send({ want: "plotly.js" });
  });
}

/** Fill in what depends on the page: size and colours. */
function suited({ data, layout }, root, width) {
  const theme = themeOf(root);
  const grid = theme.name === "dark" ? "#4a4a4a" : "#d8d8d8";
  const axis = { gridcolor: grid, zerolinecolor: grid, linecolor: grid };
  return {
    data: data.map((trace, i) => {
      const color = theme.palette[i % theme.palette.length];
      return { ...trace, line: { ...trace.line, color }, marker: { ...trace.marker, color } };
    }),
    layout: {
      ...layout,
      width,
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      font: { ...layout.font, color: theme.text },
      xaxis: { ...axis, ...layout.xaxis },
      yaxis: { ...axis, ...layout.yaxis },
    },
  };
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const place = element("div", { role: "img" });
    const note = element("div", { class: "wb-detail", text: "preparing the figure …" });
    const root = element("div", { class: "wb wb-figure" }, [note, place]);
    el.append(root);
    let width = 0;
    let library = null;

    const draw = async () => {
      place.setAttribute("aria-label", model.get("description"));
      width = place.clientWidth;
      if (!width) return;
      try {
        library ??= loadPlotly(model, stop.signal);
        const plotly = await library;
        if (stop.signal.aborted) return;
        const { data, layout } = suited(JSON.parse(model.get("figure")), root, width);
        await plotly.react(place, data, layout, CONFIG);
        note.remove();
      } catch (error) {
        library = null; // asked for again when the figure is drawn again
        note.textContent = `The figure cannot be drawn: ${error.message}`;
      }
    };
    onTraits(model, ["figure", "description"], draw, stop.signal);
    watchTheme(draw, stop.signal);
    const observer = new ResizeObserver(() => place.clientWidth !== width && draw());
    observer.observe(root);
    stop.signal.addEventListener("abort", () => {
      observer.disconnect();
      globalThis.Plotly?.purge(place);
    });
    draw();
    return () => stop.abort();
  },
};
