// Playing the steps of an optimizer: buttons, a slider, a line of words, and the error curve.

const SPEEDS = [["slow", 2400], ["normal", 1100], ["fast", 350]];
const IDLE = 0.12;
const CURVE_HEIGHT = 120;
const CURVE = { left: 44, right: 10, top: 8, bottom: 22 };

class Stepper {
  /** `show(step, glide)` is called whenever another step, or part of a step, is to be seen. */
  constructor(show, chosen, signal) {
    Object.assign(this, { show, chosen, signal, steps: [], step: 0, speed: 1, frame: 0, playing: false });
    const button = (text, label, act) => {
      const node = element("button", { type: "button", text, "aria-label": label, title: label });
      node.addEventListener("click", act, { signal });
      return node;
    };
    this.first = button("First", "First step", () => this.go(0));
    this.back = button("Back", "Step back", () => this.go(this.step - 1));
    this.toggle = button("Play", "Play the steps", () => this.play(!this.playing));
    this.next = button("Next", "Step forward", () => this.go(this.step + 1));
    this.last = button("Last", "Last step", () => this.go(this.steps.length - 1));
    this.slider = element("input", { type: "range", min: "0", max: "0", value: "0", "aria-label": "Step" });
    this.slider.addEventListener("input", () => this.go(Number(this.slider.value)), { signal });
    for (const type of ["keydown", "keyup"]) {
      // JupyterLab would take the arrows as commands to its cells.
      this.slider.addEventListener(type, (event) => event.stopPropagation(), { signal });
    }
    this.count = element("span", { class: "wb-count" });
    const speed = element("select", { "aria-label": "Speed" }, SPEEDS.map(([name], i) => element("option", { value: String(i), text: name })));
    speed.value = String(this.speed);
    speed.addEventListener("change", () => (this.speed = Number(speed.value)), { signal });
    const buttons = element("span", { class: "wb-group", role: "group", "aria-label": "Steps" }, [this.first, this.back, this.toggle, this.next, this.last]);
    this.bar = element("div", { class: "wb-bar wb-land-steps" }, [buttons, this.slider, this.count, speed]);
    this.text = element("p", { class: "wb-land-text", role: "status" });
    this.curve = element("canvas", { class: "wb-land-curve", role: "img" });
    this.curve.addEventListener("click", (event) => this.go(this.stepAt(event.offsetX)), { signal });
    signal.addEventListener("abort", () => cancelAnimationFrame(this.frame));
  }

  /** Take the steps of the active optimizer, all traces for the curve, and which step to show. */
  take(traces, active, step) {
    this.traces = traces;
    this.active = active;
    this.steps = traces.find(({ name }) => name === active)?.steps ?? [];
    this.slider.max = String(Math.max(0, this.steps.length - 1));
    if (!this.steps.length) this.play(false);
    this.step = Math.max(0, Math.min(step, this.steps.length - 1));
    this.tell(1);
  }

  go(step) {
    this.play(false);
    this.move(step);
  }

  move(step) {
    const next = Math.max(0, Math.min(step, this.steps.length - 1));
    if (next === this.step) return;
    this.step = next;
    this.tell(1);
    this.chosen(next);
  }

  play(on) {
    if (on === this.playing || (on && this.steps.length < 2)) return;
    this.playing = on;
    this.toggle.textContent = on ? "Pause" : "Play";
    this.toggle.setAttribute("aria-label", on ? "Pause" : "Play the steps");
    // Spoken at every step only when someone steps by hand.
    this.text.setAttribute("aria-live", on ? "off" : "polite");
    cancelAnimationFrame(this.frame);
    if (!on) {
      if (this.steps.length) this.show(this.step, 1);
      return;
    }
    if (this.step >= this.steps.length - 1) this.step = 0;
    this.current = -1;
    this.began = performance.now();
    this.frame = requestAnimationFrame((now) => this.animate(now));
  }

  /** Show what is tried first, then the way there; then the next step begins. */
  animate(now) {
    if (!this.playing) return;
    const part = (now - this.began) / (SPEEDS[this.speed][1] * (this.idles(this.step + 1) ? IDLE : 1));
    if (this.current !== this.step + 1) {
      this.current = this.step + 1;
      this.tell(0, this.current);
    }
    if (part >= 1) {
      this.began = now;
      this.step = this.current;
      this.chosen(this.step);
      this.show(this.step, 1);
      if (this.step >= this.steps.length - 1) return this.play(false);
    } else this.show(this.current, matchMedia("(prefers-reduced-motion: reduce)").matches ? 0 : 2 * part - 1);
    this.frame = requestAnimationFrame((later) => this.animate(later));
  }

  /** Whether nothing moves in a step nor in the one before: such runs are played quickly. */
  idles(step) {
    const still = (i) => i > 0 && this.steps[i].x === this.steps[i - 1].x && this.steps[i].y === this.steps[i - 1].y;
    return still(step) && still(step - 1);
  }

  tell(glide, step = this.step) {
    const has = this.steps.length > 0;
    this.slider.value = String(step);
    this.slider.disabled = this.toggle.disabled = !has;
    this.first.disabled = this.back.disabled = !has || step === 0;
    this.last.disabled = this.next.disabled = !has || step === this.steps.length - 1;
    this.count.textContent = has ? `step ${step} of ${this.steps.length - 1}` : "";
    this.text.textContent = has ? this.steps[step].text : this.traces?.find(({ name }) => name === this.active)?.message ?? "";
    this.slider.setAttribute("aria-valuetext", has ? `step ${step}, error ${brief(this.steps[step].error)}` : "");
    this.drawCurve(step);
    this.show(step, glide);
  }

  stepAt(x) {
    const width = this.curve.clientWidth - CURVE.left - CURVE.right;
    return Math.round(((x - CURVE.left) / width) * this.longest());
  }

  longest() {
    return Math.max(1, ...(this.traces ?? []).map(({ steps }) => steps.length - 1));
  }

  drawCurve(step = this.step) {
    const width = this.curve.clientWidth;
    if (!width || !this.traces) return;
    const context = fitCanvas(this.curve, width, CURVE_HEIGHT);
    const theme = themeOf(this.bar.closest(".wb"));
    const errors = this.traces.flatMap(({ steps }) => steps.map(({ error }) => error));
    this.curve.setAttribute("aria-label", this.curveText());
    if (!errors.length) return;
    const high = Math.max(...errors) || 1;
    const [inner, tall] = [width - CURVE.left - CURVE.right, CURVE_HEIGHT - CURVE.top - CURVE.bottom];
    const at = (i, error) => [CURVE.left + (i / this.longest()) * inner, CURVE.top + (1 - error / high) * tall];
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = context.strokeStyle = theme.text;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const level of [0, ...roundLevels(0, high * 1.001, 3)]) {
      context.globalAlpha = 0.25;
      context.beginPath();
      context.moveTo(...at(0, level));
      context.lineTo(...at(this.longest(), level));
      context.stroke();
      context.globalAlpha = 0.9;
      context.fillText(brief(level), CURVE.left - 6, at(0, level)[1]);
    }
    context.textBaseline = "alphabetic";
    context.fillText(`step ${this.longest()}`, width - CURVE.right, CURVE_HEIGHT - 6);
    context.textAlign = "left";
    context.fillText("error, start", CURVE.left, CURVE_HEIGHT - 6);
    context.globalAlpha = 1;
    this.traces.forEach(({ steps, name }, index) => {
      context.beginPath();
      steps.forEach(({ error }, i) => context[i ? "lineTo" : "moveTo"](...at(i, error)));
      context.strokeStyle = onGround(wayOf(index), index, theme);
      context.setLineDash(wayOf(index).dash);
      context.lineWidth = name === this.active ? 2.4 : 1.4;
      context.stroke();
    });
    context.setLineDash([]);
    if (!this.steps.length) return;
    context.beginPath();
    context.arc(...at(step, this.steps[step].error), 4.5, 0, 2 * Math.PI);
    context.fillStyle = theme.text;
    context.fill();
  }

  curveText() {
    const ways = this.traces.filter(({ steps }) => steps.length).map(({ title, steps }) =>
      `${title} from ${brief(steps[0].error)} to ${brief(steps.at(-1).error)} in ${steps.length - 1} steps`);
    return `Error against step: ${ways.join("; ") || "no steps yet"}`;
  }
}

/** A way's colour beside the map: the map's own colours are for dark ground only. */
function onGround({ colour }, index, theme) {
  return theme.name === "dark" ? colour : [theme.text, "#b85000", "#b3007d", "#00708f"][index % 4];
}
