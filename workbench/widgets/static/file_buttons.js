// Buttons for files that Python makes: each asks, waits, and saves what comes. Others open a
// file and send it.

class FileButtons {
  constructor(model, root, signal) {
    this.model = model;
    this.signal = signal;
    this.waiting = new Map(); // what was asked for, and the timer that gives up
    this.bar = element("div", { class: "wb-bar", role: "group" });
    this.note = element("span", { class: "wb-detail", role: "status" });
    root.append(this.bar);
    const receive = (content, buffers) => this.receive(content, buffers);
    model.on("msg:custom", receive);
    signal.addEventListener("abort", () => {
      model.off?.("msg:custom", receive);
      for (const timer of this.waiting.values()) clearTimeout(timer);
    });
    onTraits(model, ["offers", "enabled", "label"], () => this.read(), signal);
    this.read();
  }

  read() {
    this.bar.setAttribute("aria-label", this.model.get("label"));
    const buttons = this.model.get("offers").map(({ want, text, hint, takes }) => {
      const button = element("button", { type: "button", text, title: hint });
      button.disabled = !takes && !this.model.get("enabled");
      const act = () => (takes ? this.choose(want, takes) : this.ask(want, text));
      button.addEventListener("click", act, { signal: this.signal });
      return button;
    });
    this.bar.replaceChildren(...buttons, this.note);
  }

  ask(want, text) {
    if (this.waiting.has(want)) return;
    const giveUp = () => this.end(want, "It did not come: Python is busy or has stopped. Try again.");
    this.waiting.set(want, setTimeout(giveUp, PATIENCE));
    this.note.textContent = `${text} …`;
    this.model.send({ want });
  }

  choose(given, accept) {
    // A new one each time: it tells of a file that was chosen before, too.
    const input = element("input", { type: "file", accept });
    input.addEventListener("change", async () => {
      const [file] = input.files;
      if (!file) return;
      this.note.textContent = `opening ${file.name} …`;
      this.model.send({ given, name: file.name }, undefined, [await file.arrayBuffer()]);
      this.note.textContent = "";
    });
    input.click();
  }

  receive({ answer, name, type, failure }, buffers) {
    if (!this.waiting.has(answer)) return;
    if (failure) return this.end(answer, `Not saved: ${failure}`);
    download(new Blob(buffers, { type }), name);
    this.end(answer, `saved: ${name}`);
  }

  end(want, words) {
    clearTimeout(this.waiting.get(want));
    this.waiting.delete(want);
    this.note.textContent = words;
  }
}

export default {
  render({ model, el }) {
    const stop = new AbortController();
    const root = element("div", { class: "wb wb-files" });
    el.append(root);
    new FileButtons(model, root, stop.signal);
    return () => stop.abort();
  },
};
