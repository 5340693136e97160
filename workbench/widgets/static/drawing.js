// A drawing with buttons that save it. The browser makes the PNG, so that no other program
// need be there.

const PNG_RATIO = 2; // pixels for each of the drawing, in both directions

class Drawing {
  constructor(model, root, signal) {
    this.model = model;
    const button = (text, act) => {
      const node = element("button", { type: "button", text });
      const tell = (error) => (this.note.textContent = `Not saved: ${error.message}`);
      node.addEventListener("click", () => act().catch(tell), { signal });
      return node;
    };
    this.title = element("span", { class: "wb-title" });
    this.buttons = [button("Save SVG", () => this.saveSvg()), button("Save PNG", () => this.savePng())];
    this.note = element("span", { class: "wb-hover", role: "status" });
    this.image = element("img", { class: "wb-player-picture" });
    root.append(element("div", { class: "wb-bar" }, [this.title, ...this.buttons, this.note]), this.image);
    onTraits(model, ["svg", "name", "title", "description"], () => this.read(), signal);
    signal.addEventListener("abort", () => URL.revokeObjectURL(this.image.src));
    this.read();
  }

  read() {
    const svg = this.model.get("svg");
    this.title.textContent = this.model.get("title");
    this.note.textContent = "";
    URL.revokeObjectURL(this.image.src);
    this.blob = new Blob([svg], { type: "image/svg+xml" });
    this.image.hidden = !svg;
    for (const button of this.buttons) button.disabled = !svg;
    if (!svg) return;
    this.image.src = URL.createObjectURL(this.blob);
    this.image.alt = this.model.get("description");
  }

  async saveSvg() {
    download(this.blob, `${this.model.get("name")}.svg`);
    this.note.textContent = "SVG saved";
  }

  async savePng() {
    await this.image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = this.image.naturalWidth * PNG_RATIO;
    canvas.height = this.image.naturalHeight * PNG_RATIO;
    canvas.getContext("2d").drawImage(this.image, 0, 0, canvas.width, canvas.height);
    const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
    download(blob, `${this.model.get("name")}.png`);
    this.note.textContent = "PNG saved";
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-player" });
    el.append(root);
    root.drawing = new Drawing(model, root, stop.signal);
    return () => stop.abort();
  },
};
