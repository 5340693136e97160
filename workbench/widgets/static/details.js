// The values of the hovered row of a table, each with its place in its column's range.

const EMPTY = "Hover a sample, or move to one with the arrow keys, to see its values.";

class Details {
  constructor(model, root, signal) {
    this.model = model;
    this.caption = element("div", { class: "wb-detail", text: EMPTY });
    this.body = element("tbody");
    root.append(this.caption, element("table", { "aria-label": "Values of the hovered sample" }, [this.body]));
    this.read();
    onTraits(model, ["values", "columns", "classes", "class_names"], () => this.read(), signal);
    onHover(model, (sample) => sample >= 0 && this.show(sample), signal);
  }

  read() {
    this.values = typed(this.model.get("values"), Float32Array);
    this.columns = this.model.get("columns");
    this.classes = typed(this.model.get("classes"), Int32Array);
    const d = this.columns.length;
    this.low = new Array(d).fill(Infinity);
    this.high = new Array(d).fill(-Infinity);
    this.values.forEach((value, i) => {
      this.low[i % d] = Math.min(this.low[i % d], value);
      this.high[i % d] = Math.max(this.high[i % d], value);
    });
    this.caption.textContent = EMPTY;
    this.rows = this.columns.map((name) => this.row(name));
    this.body.replaceChildren(...this.rows.map(({ line }) => line));
  }

  row(name) {
    const number = element("td", { class: "wb-number" });
    const mark = element("i", { hidden: "" });
    const range = element("td", {}, [element("div", { class: "wb-range", "aria-hidden": "true" }, [mark])]);
    const line = element("tr", {}, [element("th", { scope: "row", text: name }), number, range]);
    return { line, number, mark };
  }

  show(sample) {
    const d = this.columns.length;
    if ((sample + 1) * d > this.values.length) return;
    const group = this.model.get("class_names")[this.classes[sample]];
    this.caption.textContent = [`sample ${sample}`, group].filter(Boolean).join(" · ");
    this.rows.forEach(({ number, mark }, column) => {
      const value = this.values[sample * d + column];
      number.textContent = Number(value.toPrecision(4)).toString();
      const extent = this.high[column] - this.low[column];
      mark.hidden = false;
      mark.style.left = `${extent ? (100 * (value - this.low[column])) / extent : 50}%`;
    });
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-details" });
    el.append(root);
    new Details(model, root, stop.signal);
    return () => stop.abort();
  },
};
