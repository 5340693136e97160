// What the pad says: to the eye below the plane, and to screen readers.

class PadWords {
  constructor(pad, hintId) {
    this.pad = pad;
    this.readout = element("span", { class: "wb-detail" });
    this.message = element("div", { class: "wb-pad-message", role: "status" });
    this.live = element("div", { class: "wb-live", role: "status", "aria-live": "polite" });
    this.legend = element("div", { class: "wb-sides wb-pad-legend" });
    this.hint = element("p", { class: "wb-hint", id: hintId });
  }

  /** Name the plane, and say what can be done there. */
  describe() {
    const { scene, mode, hand, plane } = this.pad;
    this.hint.textContent = `${hand.hint} ${PAD_HINT}`;
    this.tell();
    if (!scene) return;
    this.explain();
    const text = `Plane with ${scene.count} markers and a trajectory of ${scene.duration.toFixed(1)} seconds, mode ${PAD_MODES[mode][0]}`;
    plane.plot.setAttribute("aria-label", text);
  }

  /** Say what colours and marks in the plane mean. */
  explain() {
    const { scene, theme } = this.pad;
    const colours = ramp(TIME_STOPS[theme.name]).filter((_, i) => i % 9 === 0);
    const mark = (style, text) => element("span", {}, [element("i", { style }), text]);
    const entries = [mark(`background: linear-gradient(to right, ${colours.join(", ")}); width: 60px`, "trajectory, from start to end")];
    entries.push(element("span", {}, [element("i", { class: "wb-pad-dot", style: `background: ${colours[3]}` }), "key pose"]));
    if (scene.markerFrames.some((frame) => frame < 0)) entries.push(element("span", {}, [element("i", { class: "wb-pad-dot wb-pad-new", text: "+" }), "new pose"]));
    if (!scene.follows) entries.push(mark(`background: ${theme.text}; opacity: 0.4; height: 1px`, "the clip's frames"));
    this.legend.replaceChildren(...entries);
  }

  /** Say what is at the place that is looked at. */
  locate() {
    const { scene, place, plane, hovered, atTime } = this.pad;
    const frame = atTime || hovered >= 0 ? -1 : plane.nearestOn(scene.embedding, plane.toPixel(place));
    const near = frame >= 0 ? ` · near frame ${frame}, ${(frame * scene.frameTime).toFixed(2)} s` : "";
    const where = `${atTime ? "now at" : "place"} ${place.map((v) => brief(v)).join(", ")}${near}`;
    this.readout.textContent = hovered >= 0 ? `marker ${scene.nameOf(hovered)}` : where;
    if (scene.problem !== this.problem) this.tell();
  }

  /** Say something; `seen` keeps it below the plane until something else is done. */
  say(text, seen = false) {
    this.live.textContent = seen ? "" : text;
    this.remark = seen ? text : "";
    this.tell();
  }

  /** Show what stands in the way, what was said last and what Python says. */
  tell() {
    const { scene, model } = this.pad;
    this.problem = scene?.problem ?? "";
    const text = [scene ? this.problem : "No motion yet.", this.remark, model.get("message")].filter(Boolean).join(" ");
    if (this.message.textContent !== text) this.message.textContent = text;
  }
}
