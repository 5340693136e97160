// The pad's tool bar: what the hand does, markers, undo and redo, and the view of the plane.

const PAD_MODES = {
  scrub: ["Scrub", "s", "See the pose at any place"],
  markers: ["Markers", "m", "Drag, add and delete markers"],
  deform: ["Deform", "d", "Drag the trajectory"],
  draw: ["Draw", "p", "Draw a new trajectory with its timing"],
};

class PadTools {
  constructor(pad, signal) {
    Object.assign(this, { pad, signal });
    this.modes = Object.entries(PAD_MODES).map(([mode, [text, key, tip]]) => {
      const button = this.button(text, `${tip} (${key.toUpperCase()})`, () => pad.change("mode", mode));
      button.dataset.mode = mode;
      return button;
    });
    this.add = this.button("Add marker", "Add a marker at the place kept in view, else where the trajectory is now (A)", () => pad.addMarker(pad.pinned ?? pad.place));
    this.remove = this.button("Delete marker", "Delete the selected marker (Delete)", () => pad.removeMarker());
    this.undo = this.button("Undo", "Undo", () => pad.tell("undo"));
    this.redo = this.button("Redo", "Redo", () => pad.tell("redo"));
    const group = (label, buttons) => element("span", { class: "wb-group", role: "group", "aria-label": label }, buttons);
    this.editing = [
      group("What the hand does", this.modes),
      group("Markers", [this.add, this.remove]),
      group("History", [this.undo, this.redo]),
    ];
    const view = group("Plane", [
      this.button("−", "Zoom out of the plane", () => pad.zoom(1 / 1.3)),
      this.button("+", "Zoom into the plane", () => pad.zoom(1.3)),
      this.button("Show all", "Show the whole plane (F)", () => pad.showAll()),
    ]);
    this.node = element("div", { class: "wb-bar wb-pad-tools" }, [...this.editing, view]);
    this.slider = element("input", { type: "range", min: "0", max: "100", step: "1", "aria-label": "Radius of the deformation" });
    this.slider.addEventListener("input", () => pad.setRadius(radiusAt(pad.scene, Number(this.slider.value) / 100)), { signal });
    this.slider.addEventListener("change", () => pad.save("radius", pad.radius), { signal });
    this.amount = element("span", { class: "wb-pad-amount" });
    this.radius = element("label", { class: "wb-pad-radius", hidden: "" }, [element("span", { text: "felt for" }), this.slider, this.amount]);
  }

  button(text, label, act) {
    const node = element("button", { type: "button", text, "aria-label": label, title: label });
    node.addEventListener("click", act, { signal: this.signal });
    return node;
  }

  show() {
    const { pad } = this;
    const { model, scene } = pad;
    const editable = model.get("editable");
    for (const node of this.editing) node.hidden = !editable;
    for (const button of this.modes) button.setAttribute("aria-pressed", String(button.dataset.mode === pad.mode));
    this.remove.disabled = pad.selected < 0 || !scene || scene.count <= FEWEST_MARKERS;
    this.add.disabled = !scene;
    for (const [button, name, label] of [[this.undo, "undo_label", "Undo"], [this.redo, "redo_label", "Redo"]]) {
      const what = model.get(name);
      button.disabled = !what;
      button.title = what ? `${label}: ${what} (${label === "Undo" ? "Ctrl+Z" : "Ctrl+Shift+Z"})` : `Nothing to ${label.toLowerCase()}`;
      button.setAttribute("aria-label", button.title);
    }
    this.radius.hidden = !editable || pad.mode !== "deform" || !scene;
    if (this.radius.hidden) return;
    this.slider.value = String(Math.round(100 * partOfRadius(scene, pad.radius)));
    this.amount.textContent = `${brief(100 * pad.radius / longestRadius(scene))} % of its length`;
  }
}
