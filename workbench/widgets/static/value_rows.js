// The values of a row beside those rebuilt, each with both places in its column's range.

class ValueRows {
  constructor(columns, low, high) {
    this.low = low;
    this.high = high;
    const body = element("tbody");
    this.rows = columns.map((name) => {
      const [own, rebuilt] = [element("td", { class: "wb-number" }), element("td", { class: "wb-number" })];
      const [bar, mark] = [element("i", { class: "wb-rec-bar" }), element("i", { class: "wb-rec-own" })];
      const range = element("td", {}, [element("div", { class: "wb-rec-range", "aria-hidden": "true" }, [bar, mark])]);
      body.append(element("tr", {}, [element("th", { scope: "row", text: name }), own, rebuilt, range]));
      return { own, rebuilt, bar, mark };
    });
    const head = element("thead", {}, [element("tr", {}, ["", "sample", "rebuilt", ""].map((text) =>
      element(text ? "th" : "td", { ...(text ? { scope: "col" } : {}), text })))]);
    this.table = element("table", { "aria-label": "Values of the sample and those rebuilt" }, [head, body]);
  }

  show(original, rebuilt) {
    this.rows.forEach(({ own, rebuilt: cell, bar, mark }, i) => {
      own.textContent = valueText(original[i]);
      cell.textContent = rebuilt ? valueText(rebuilt[i]) : "";
      mark.style.left = `${this.share(original[i], i)}%`;
      bar.style.width = rebuilt ? `${this.share(rebuilt[i], i)}%` : "0";
    });
  }

  share(value, i) {
    const extent = this.high[i] - this.low[i];
    return extent ? Math.max(0, Math.min(100, (100 * (value - this.low[i])) / extent)) : 50;
  }
}

function valueText(value) {
  return value === undefined ? "" : Number(value.toPrecision(4)).toString();
}
