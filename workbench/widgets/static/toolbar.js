// The tool bar: how to drag, which positions, what to save.

const SHAPES_OF_DRAG = { rectangle: "Rectangle", lasso: "Lasso" };
const MOVING = { move: "Move control points" };
const STAGES = { raw: "Before optimization", final: "Optimized" };

/** Buttons of which one is pressed. */
class Choice {
  constructor(label, texts, choose, signal) {
    this.buttons = Object.entries(texts).map(([key, text]) => {
      const button = element("button", { type: "button", text, "data-key": key });
      button.addEventListener("click", () => choose(key), { signal });
      return button;
    });
    this.node = element("span", { class: "wb-group", role: "group", "aria-label": label }, this.buttons);
  }

  show(chosen, offered = () => true) {
    for (const button of this.buttons) {
      button.setAttribute("aria-pressed", String(button.dataset.key === chosen));
      button.hidden = !offered(button.dataset.key);
    }
    this.node.hidden = this.buttons.every((button) => button.hidden);
  }
}

/** A button that shows and hides further buttons. */
class Menu {
  constructor(text, signal) {
    this.button = element("button", { type: "button", text, "aria-expanded": "false", class: "wb-more" });
    this.list = element("div", { class: "wb-menu-list", hidden: "" });
    this.node = element("span", { class: "wb-menu" }, [this.button, this.list]);
    this.button.addEventListener("click", () => this.open(this.list.hidden), { signal });
    this.node.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || this.list.hidden) return;
      this.open(false);
      this.button.focus();
      event.preventDefault();
    }, { signal });
    const elsewhere = ({ target }) => this.node.contains(target) || this.open(false);
    document.addEventListener("pointerdown", elsewhere, { signal, capture: true });
    this.node.addEventListener("focusout", ({ relatedTarget }) => {
      if (relatedTarget && !this.node.contains(relatedTarget)) this.open(false);
    }, { signal });
    this.signal = signal;
  }

  add(text, act) {
    const button = element("button", { type: "button", text });
    button.addEventListener("click", () => {
      this.open(false);
      this.button.focus();
      act();
    }, { signal: this.signal });
    this.list.append(button);
    return button;
  }

  open(shown) {
    this.list.hidden = !shown;
    this.list.classList.remove("wb-right");
    const room = this.node.closest(".wb").getBoundingClientRect().right;
    if (this.list.getBoundingClientRect().right > room) this.list.classList.add("wb-right");
    this.button.setAttribute("aria-expanded", String(shown));
  }
}

class Toolbar {
  constructor(view, signal) {
    const button = (text, act) => {
      const node = element("button", { type: "button", text });
      node.addEventListener("click", act, { signal });
      return node;
    };
    this.drags = new Choice("What dragging does", { ...SHAPES_OF_DRAG, ...MOVING }, (mode) => view.setMode(mode), signal);
    this.stages = new Choice("Positions", STAGES, (stage) => view.setStage(stage), signal);
    this.clearing = button("Clear selection", () => view.select([]));
    this.resetting = button("Reset control points", () => {
      this.drags.buttons.at(-1).focus(); // this button is about to be disabled
      view.mover.reset();
    });
    this.saving = new Menu("Save", signal);
    this.saving.add("Picture (PNG)", () => savePicture(view));
    this.saving.add("Table (CSV)", () => saveTable(view));
    this.page = this.saving.add("Interactive page (HTML)", () => savePage(view, signal));
    this.count = element("span", { class: "wb-count" });
    this.hovered = element("span", { class: "wb-hover" });
    const parts = [
      this.drags.node, this.stages.node, this.clearing, this.resetting, this.saving.node,
    ];
    this.node = element("div", { class: "wb-bar" }, parts);
    // A line of its own, so that nothing jumps when there is something to say.
    this.line = element("div", { class: "wb-line" }, [this.count, this.hovered]);
    this.node.addEventListener("keydown", (event) => {
      // JupyterLab would take them as commands to its cells.
      if (["Enter", " ", "Escape"].includes(event.key)) event.stopPropagation();
    }, { signal });
  }

  show({ state, mode, stage, chosen, mover }) {
    const { n, word } = state;
    this.drags.show(mode, (key) => key !== "move" || state.canMove);
    this.stages.show(stage, () => state.raw !== null && anyKnown(state.raw));
    this.clearing.hidden = mode === "move";
    this.clearing.disabled = chosen.length === 0;
    this.resetting.hidden = mode !== "move";
    this.resetting.disabled = !mover.anyMoved;
    this.page.hidden = !state.offersHtml;
    this.count.textContent = chosen.length ? `${chosen.length} of ${n} ${word}s selected` : "";
  }
}
